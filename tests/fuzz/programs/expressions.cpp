// Random expressions, by the type that is wanted. Rows of the table give operators and functions alike.
#include "tests/fuzz/programs/writer.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace slvm::test {

std::string ProgramWriter::literal(Type t) {
  constexpr const char* kNumbers[] = {"1", "0",    "0.5", "2",      "-1",  "0.25",
                                      "3", "1e-3", "7.5", "-0.125", "1e6", "PI"};
  auto number = [&] { return std::string(kNumbers[choose_.below(std::size(kNumbers))]); };
  switch (t) {
  case Type::kFloat: return number();
  case Type::kString: return text_literal("");
  case Type::kMatrix: {
    if (!choose_.chance(30)) return fmt::format("(matrix {})", number());
    std::string list = number();
    for (int i = 1; i < 16; ++i)
      list += ", " + number();
    return fmt::format("(matrix ({}))", list);
  }
  default: break;
  }
  if (choose_.chance(30)) return fmt::format("({} {})", type_name(t), number());
  return fmt::format("({} ({}, {}, {}))", type_name(t), number(), number(), number());
}

// Strings mean something by the name of the parameter they are for.
std::string ProgramWriter::text_literal(std::string_view purpose) {
  auto pick = [&](std::initializer_list<const char*> from) {
    return fmt::format("\"{}\"", from.begin()[choose_.below(from.size())]);
  };
  if (purpose == "basis") return pick({"linear", "catmull-rom", "bezier", "bspline", "hermite"});
  if (purpose.find("space") != purpose.npos) return pick({"shader", "current", "object", "tilted"});
  if (purpose == "from" || purpose == "to") return pick({"rgb", "hsv", "hsl", "YIQ", "xyz", "xyY"});
  if (purpose == "strategy") return pick({"shading", "dicing"});
  if (purpose == "pattern") return pick({"a", "[a-c]+", "^x.*y$", "b*"});
  return pick({"a", "", "abc", "xay", "b b", "hsv"});
}

std::string ProgramWriter::leaf(Type t, bool uniform) {
  std::vector<const Variable*> known = variables(t, uniform, false);
  if (known.empty() || choose_.chance(25)) return literal(t);
  return one_of(known)->name;
}

std::string ProgramWriter::element(const Variable& v, int depth) {
  // Most of the time within bounds; a constant must be.
  if (!choose_.chance(55))
    return fmt::format("{}[{}]", v.name, choose_.below(static_cast<size_t>(v.elements)));
  const std::string index = expression(Type::kFloat, depth - 1, v.uniform);
  if (!v.uniform && choose_.chance(25)) return fmt::format("{}[s + {}]", v.name, index);
  return fmt::format("{}[clamp({}, 0, {})]", v.name, index, v.elements - 1);
}

std::string ProgramWriter::cast(Type t, const std::string& text) const {
  return t == Type::kString || t == Type::kVoid ? text : fmt::format("({} {})", type_name(t), text);
}

std::vector<ShadeopId> ProgramWriter::rows(Type result, bool uniform) const {
  std::vector<ShadeopId> found;
  for (size_t i = 0; i < shadeops().size(); ++i) {
    const ShadeopInfo& row = shadeops()[i];
    const Signature& s = row.signature;
    bool is_operator = row.name.starts_with("operator");
    if (s.result != result || row.kind == ShadeopKind::kPending) continue;
    if ((row.flags & kInternal) && !is_operator) continue;
    constexpr uint32_t kScene = kTexture | kRays | kMessage | kInIlluminance | kEffect;
    const bool lights =
        (row.flags & kLights) && !in_illuminance_ && !in_function_ && !in_light_ && !inputs_only_;
    const bool area = row.name == "area" || row.name == "calculatenormal";
    if ((row.flags & kScene) || ((row.flags & (kReadsState | kLights)) && !lights && !area)) continue;
    if (pointwise_ && ((row.flags & kDerivative) || row.name.starts_with("random"))) continue;
    if (uniform && (row.flags & (kHiddenVarying | kDerivative))) continue;
    if (inputs_only_ && (row.name == "operator?:" || row.kind == ShadeopKind::kRsl)) continue;
    bool takes_any = false;
    for (int p = 0; p < s.param_count; ++p)
      takes_any |= s.params[static_cast<size_t>(p)].any;
    if (!takes_any) found.push_back(static_cast<ShadeopId>(i));
  }
  return found;
}

// False: there is no variable for an output, or no array.
bool ProgramWriter::arguments(ShadeopId id, int depth, bool uniform, std::vector<std::string>& out) {
  const Signature& s = shadeop(id).signature;
  for (int i = 0; i < s.param_count; ++i) {
    const SignatureParam& p = s.param(i);
    bool wants_uniform = uniform || p.uniform;
    if (p.output || p.array) {
      std::vector<const Variable*> fitting = variables(p.type, wants_uniform && !p.output, p.output, p.array);
      // What is stored may be varying.
      std::erase_if(fitting, [&](const Variable* v) {
        return (p.output && v->uniform) || (shadeop(id).name == "spline" && v->elements < 4);
      });
      if (p.variadic || fitting.empty()) return false;
      const Variable* v = one_of(fitting);
      // The same variable twice: which store comes last is not defined.
      if (p.output && std::find(out.begin(), out.end(), v->name) != out.end()) return false;
      out.push_back(v->name);
      continue;
    }
    size_t times =
        p.variadic ? (shadeop(id).name == "spline" ? 4 + choose_.below(5) : 1 + choose_.below(3)) : 1;
    if (p.variadic && p.type == Type::kFloat && s.result == Type::kMatrix) times = 16;
    for (size_t k = 0; k < times; ++k)
      if (p.type == Type::kString && !p.name.empty() && p.name != "a" && p.name != "b" && choose_.chance(90))
        out.push_back(text_literal(p.name));
      else if (p.type == Type::kBool)
        out.push_back(condition(depth - 1, wants_uniform));
      else
        out.push_back(expression(p.type, depth - 1, wants_uniform));
  }
  return true;
}

std::string ProgramWriter::call(ShadeopId id, int depth, bool uniform) {
  const ShadeopInfo& row = shadeop(id);
  std::vector<std::string> args;
  const bool outside = inputs_only_;
  inputs_only_ |= divergent() && (row.flags & kDerivative);
  const bool complete = arguments(id, depth, uniform, args);
  inputs_only_ = outside;
  if (!complete) return leaf(row.signature.result, uniform);
  if (row.name.starts_with("operator")) {
    std::string_view op = row.name.substr(8);
    if (op == "?:") return fmt::format("({} ? {} : {})", args[0], args[1], args[2]);
    return args.size() == 1 ? fmt::format("({} {})", op, args[0])
                            : fmt::format("({} {} {})", args[0], op, args[1]);
  }
  return cast(row.signature.result, fmt::format("{}({})", row.name, fmt::join(args, ", ")));
}

std::string ProgramWriter::call(const Function& f, int depth) {
  std::vector<std::string> args;
  for (const Variable& formal : f.formals) {
    if (!formal.assignable) {
      args.push_back(expression(formal.type, depth - 1, formal.uniform));
      continue;
    }
    std::vector<const Variable*> fitting = variables(formal.type, false, true);
    std::erase_if(fitting, [&](const Variable* v) {
      return v->uniform || std::find(args.begin(), args.end(), v->name) != args.end();
    });
    if (fitting.empty()) return f.result == Type::kVoid ? "" : leaf(f.result, false);
    args.push_back(one_of(fitting)->name);
  }
  return cast(f.result, fmt::format("{}({})", f.name, fmt::join(args, ", ")));
}

std::string ProgramWriter::expression(Type t, int depth, bool uniform) {
  if (depth <= 0 || choose_.at_end()) return leaf(t, uniform);
  switch (choose_.below(10)) {
  case 0:
  case 1: return leaf(t, uniform);
  case 2: { // an element of an array
    std::vector<const Variable*> arrays = variables(t, uniform, false, true);
    return arrays.empty() ? leaf(t, uniform) : element(*one_of(arrays), uniform ? 0 : depth);
  }
  case 3: { // a function of the program
    std::vector<const Function*> fitting;
    for (const Function& f : functions_)
      if (f.result == t) fitting.push_back(&f);
    if (uniform || inputs_only_ || fitting.empty()) return leaf(t, uniform);
    return call(*one_of(fitting), depth);
  }
  case 4: // a conversion
    if (is_geometric(t)) {
      Type from = static_cast<Type>(static_cast<size_t>(Type::kPoint) + choose_.below(3));
      return cast(t, expression(from, depth - 1, uniform));
    }
    if (t == Type::kColor || t == Type::kMatrix) return cast(t, expression(Type::kFloat, depth - 1, uniform));
    return leaf(t, uniform);
  case 5: // components put together
    if (is_triple(t)) {
      auto part = [&] { return expression(Type::kFloat, depth - 1, uniform); };
      const char* space = t == Type::kColor ? (choose_.chance(20) ? " \"hsv\"" : "")
                                            : (choose_.chance(20) ? " \"tilted\"" : "");
      return fmt::format("({}{} ({}, {}, {}))", type_name(t), space, part(), part(), part());
    }
    [[fallthrough]];
  default: {
    std::vector<ShadeopId> known = rows(t, uniform);
    return known.empty() ? leaf(t, uniform) : call(one_of(known), depth, uniform);
  }
  }
}

std::string ProgramWriter::condition(int depth, bool uniform) {
  constexpr const char* kRelations[] = {"<", ">", "<=", ">=", "==", "!="};
  if (depth > 1 && choose_.chance(50)) {
    std::vector<ShadeopId> known = rows(Type::kBool, uniform);
    return call(one_of(known), depth - 1, uniform);
  }
  const char* relation = kRelations[choose_.below(std::size(kRelations))];
  std::string left = expression(Type::kFloat, depth - 1, uniform);
  return fmt::format("({} {} {})", left, relation, expression(Type::kFloat, depth - 1, uniform));
}

} // namespace slvm::test
