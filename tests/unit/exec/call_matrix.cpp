#include "tests/unit/exec/call_matrix.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace slvm::test {
namespace {

constexpr uint32_t kKnots = 7;

bool is_operator(const ShadeopInfo& row) {
  return row.name.starts_with("operator");
}

// Strings mean something by the name of the parameter they are for.
std::string text_for(std::string_view parameter) {
  if (parameter == "basis") return "bspline";
  if (parameter == "strategy") return "shading";
  if (parameter == "filter") return "box";
  if (parameter == "pattern") return "a+";
  return parameter == "fromspace" ? "tilted" : parameter == "tospace" ? "current" : "tilted";
}

std::string literal(const MatrixOperand& o) {
  if (o.type == Type::kString) return fmt::format("\"{}\"", o.text);
  const auto count = static_cast<size_t>(components(o.type));
  std::vector<std::string> values;
  for (size_t e = 0; e < std::max(o.elements, 1u); ++e) {
    const std::vector<float> part(o.first.begin() + static_cast<ptrdiff_t>(e * count),
                                  o.first.begin() + static_cast<ptrdiff_t>((e + 1) * count));
    values.push_back(count == 1 ? fmt::format("{}", part[0])
                                : fmt::format("{} ({})", type_name(o.type), fmt::join(part, ", ")));
  }
  return o.elements ? fmt::format("{{{}}}", fmt::join(values, ", ")) : values[0];
}

// Another value at every point; the first point has first[k].
float varied(float first, size_t k, size_t point) {
  const auto turn = static_cast<float>((point * 7 + k * 3) % 23);
  return point == 0 ? first : first + 0.37f * turn - 0.011f * static_cast<float>(point % 300);
}

} // namespace

// Left out: what cannot be bound, and what asks a scene or another shader (maps, rays, messages), whose own tests go
// through masks, strips and targets: texture tests, gather_test.cpp and trace_test.cpp, lights_test.cpp.
bool MatrixCall::can_call(ShadeopId id) {
  const ShadeopInfo& row = shadeop(id);
  if (row.kind == ShadeopKind::kPending ||
      (row.flags & (kTexture | kRays | kMessage | kEffect | kInIlluminance)))
    return false;
  if ((row.flags & kInternal) && !is_operator(row)) return false;
  const Signature& s = row.signature;
  for (int i = 0; i < s.param_count; ++i)
    if (const SignatureParam& p = s.params[static_cast<size_t>(i)];
        p.any || (p.array && p.type == Type::kString))
      return false;
  return s.result != Type::kString && row.name != "ctransform";
}

MatrixCall::MatrixCall(ShadeopId id, std::mt19937& random) : row_(id) {
  const ShadeopInfo& row = shadeop(id);
  const Signature& s = row.signature;
  std::uniform_real_distribution<float> draw(-3, 3);
  if (s.result != Type::kVoid) results_.push_back(s.result);
  for (int i = 0; i < s.param_count; ++i) {
    const SignatureParam& p = s.params[static_cast<size_t>(i)];
    if (p.output) results_.push_back(p.type);
    MatrixOperand o{p.type == Type::kBool ? Type::kFloat : p.type, p.array ? kKnots : 0, p.uniform, {}, {}};
    if (o.type == Type::kString) o.text = text_for(p.name);
    for (uint32_t k = p.variadic ? (row.name == "spline" ? kKnots : 3) : 1; k > 0; --k) {
      o.first.clear();
      for (size_t n = static_cast<size_t>(components(o.type)) * std::max(o.elements, 1u); n > 0; --n)
        o.first.push_back(draw(random));
      operands_.push_back(o);
    }
  }
}

std::string MatrixCall::source(const std::vector<OperandClass>& classes) const {
  const ShadeopInfo& row = shadeop(row_);
  const Signature& s = row.signature;
  std::string params = "varying float m = 1;", locals, stores;
  std::vector<std::string> args;
  size_t next_result = s.result == Type::kVoid ? 0 : 1;
  for (size_t i = 0; i < results_.size(); ++i)
    params += fmt::format(" output varying {0} r{1} = 7;",
                          results_[i] == Type::kBool ? "float" : type_name(results_[i]), i);
  for (size_t i = 0; i < operands_.size(); ++i) {
    const MatrixOperand& o = operands_[i];
    const SignatureParam& p = s.param(static_cast<int>(i));
    const std::string name = fmt::format("a{}", i),
                      length = o.elements ? fmt::format("[{}]", o.elements) : "";
    if (o.type == Type::kString) {
      args.push_back(literal(o));
      continue;
    }
    if (classes[i] != OperandClass::kConstant)
      params += fmt::format(" {} {} {}{} = {};", classes[i] == OperandClass::kUniform ? "uniform" : "varying",
                            type_name(o.type), name, length, literal(o));
    else if (o.elements)
      locals += fmt::format(" {} {}{} = {};", type_name(o.type), name, length, literal(o));
    const std::string value = classes[i] == OperandClass::kConstant && !o.elements ? literal(o) : name;
    if (p.output) { // reads and stores a variable
      args.push_back(fmt::format("r{}", next_result++));
      if (p.input) stores += fmt::format(" {} = {};", args.back(), value);
    } else {
      args.push_back(p.type == Type::kBool ? fmt::format("({} > 0)", value) : value);
    }
  }
  std::string call;
  if (row.name == "operator?:")
    call = fmt::format("({} ? {} : {})", args[0], args[1], args[2]);
  else if (is_operator(row))
    call = args.size() == 1 ? fmt::format("({} {})", row.name.substr(8), args[0])
                            : fmt::format("({} {} {})", args[0], row.name.substr(8), args[1]);
  else
    call = fmt::format("{}({})", row.name, fmt::join(args, ", "));
  if (s.result == Type::kBool)
    call = fmt::format("if ({}) r0 = 1; else r0 = 0;", call);
  else if (s.result != Type::kVoid)
    call = fmt::format("r0 = {}({});", type_name(s.result), call);
  else
    call += ";";
  return fmt::format("surface t({}) {{{} if (m > 0.5) {{{} {} }} }}", params, locals, stores, call);
}

void MatrixCall::fill(Grid& grid, const std::vector<OperandClass>& values) const {
  for (size_t i = 0; i < operands_.size(); ++i) {
    const MatrixOperand& o = operands_[i];
    if (o.type == Type::kString) continue;
    float* planes = grid.add_varying_primvar(fmt::format("a{}", i), o.type, o.elements);
    for (size_t k = 0; k < o.first.size(); ++k)
      for (size_t point = 0; point < grid.points(); ++point)
        planes[k * grid.pitch() + point] =
            values[i] == OperandClass::kVarying ? varied(o.first[k], k, point) : o.first[k];
  }
}

} // namespace slvm::test
