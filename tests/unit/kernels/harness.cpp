#include "tests/unit/kernels/harness.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

namespace slvm::test {

std::string row_name(ShadeopId row) {
  return std::string(shadeop(row).name) + " " + std::string(shadeop(row).signature_text);
}

std::vector<ShadeopId> kernel_rows() {
  std::vector<ShadeopId> rows;
  for (size_t i = 0; i < kShadeopCount; ++i)
    if (shadeops()[i].kind == ShadeopKind::kKernel) rows.push_back(static_cast<ShadeopId>(i));
  return rows;
}

ShadeopId row_of(std::string_view name, std::string_view signature) {
  int row = find_shadeop(name, signature);
  EXPECT_GE(row, 0) << "no row " << name << " " << signature;
  return static_cast<ShadeopId>(std::max(row, 0));
}

float Value::at(size_t lane, size_t plane) const {
  return std::bit_cast<float>(bits[lane][plane]);
}
void Value::set(size_t lane, size_t plane, float value) {
  bits[lane][plane] = std::bit_cast<uint32_t>(value);
}

namespace {

float random_float(Values values, std::mt19937& random) {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  static constexpr float kEdgeValues[] = {
      0.0f,    -0.0f,  1.0f,       -1.0f,       0.5f,          -0.5f,          2.0f,       1e-40f,
      -1e-40f, 1e-30f, -1e30f,     3.4e38f,     kInfinity,     -kInfinity,     NAN,        1e9f,
      -3e9f,   1e20f,  8388607.5f, 16777216.0f, 2147483648.0f, -2147483904.0f, 0.49999997f};
  switch (random() % 4) {
  case 0: return static_cast<float>(static_cast<int>(random() % 21) - 10);
  case 1: return static_cast<float>(static_cast<int>(random() % 41) - 20) * 0.5f;
  case 2:
    if (values == Values::kEdges) return kEdgeValues[random() % std::size(kEdgeValues)];
    [[fallthrough]];
  default: return std::uniform_real_distribution<float>(-10.0f, 10.0f)(random);
  }
}

uint32_t random_string(std::mt19937& random, StringPool& strings) {
  static constexpr std::string_view kTexts[] = {"hsv",         "XYZ",  "rgb",     "bezier",  "catmull-rom",
                                                "solvelinear", "a+b*", "bspline", "hermite", "linear"};
  return strings.intern(kTexts[random() % std::size(kTexts)]);
}

uint32_t random_bits(Type type, Values values, std::mt19937& random, StringPool& strings) {
  if (type == Type::kBool) return random() % 2 ? ~0u : 0u;
  if (type == Type::kString) return random_string(random, strings);
  return std::bit_cast<uint32_t>(random_float(values, random));
}

Value random_value(Type type, uint32_t elements, size_t lanes, bool uniform, Values values,
                   std::mt19937& random, StringPool& strings) {
  Value v{type, elements, {}};
  v.bits.resize(lanes);
  for (size_t lane = 0; lane < lanes; ++lane) {
    if (uniform && lane > 0) {
      v.bits[lane] = v.bits[0];
      continue;
    }
    for (size_t p = 0; p < v.planes(); ++p)
      v.bits[lane].push_back(random_bits(type, values, random, strings));
  }
  return v;
}

/// Planes of one operand, aligned as kernels ask for.
class Planes {
public:
  Planes(size_t planes, size_t lanes, uint32_t step, uint32_t elements) : lanes_(lanes) {
    size_t bytes = std::max<size_t>(planes, 1) * lanes * sizeof(float);
    memory_.reset(static_cast<float*>(std::aligned_alloc(kPlaneAlign, bytes)));
    operand = {memory_.get(), lanes, step, elements};
  }
  void fill(const Value& v) {
    for (size_t p = 0; p < v.planes(); ++p)
      for (size_t lane = 0; lane < lanes_; ++lane)
        operand.plane(p)[lane] = std::bit_cast<float>(v.bits[lane % v.bits.size()][p]);
  }
  Operand operand;

private:
  struct Free {
    void operator()(float* p) const { std::free(p); }
  };
  size_t lanes_;
  std::unique_ptr<float, Free> memory_;
};

Value read_back(const Operand& o, Type type, size_t lanes) {
  Value v{type, 1, {}};
  v.bits.resize(lanes);
  for (size_t lane = 0; lane < lanes; ++lane)
    for (size_t p = 0; p < v.planes(); ++p)
      v.bits[lane].push_back(std::bit_cast<uint32_t>(o.plane(p)[lane]));
  return v;
}

} // namespace

std::vector<Type> stored_types(ShadeopId row) {
  const Signature& s = shadeop(row).signature;
  std::vector<Type> types;
  if (s.result != Type::kVoid) types.push_back(s.result);
  for (int i = 0; i < s.param_count; ++i)
    if (s.params[i].output) types.push_back(s.params[i].type);
  return types;
}

Arguments make_arguments(ShadeopId row, size_t lanes, Values values, std::mt19937& random,
                         StringPool& strings, uint32_t uniform_set) {
  const Signature& s = shadeop(row).signature;
  Arguments arguments{lanes, {}, {}};
  for (int i = 0; i < s.param_count; ++i) {
    const SignatureParam& p = s.params[i];
    if (!p.input) continue;
    uint32_t copies = !p.variadic ? 1 : shadeop(row).name == "sixteen" ? 16 : kManyKnots;
    for (uint32_t k = 0; k < copies; ++k) {
      bool uniform = p.uniform || (uniform_set >> arguments.values.size() & 1);
      arguments.values.push_back(
          random_value(p.type, p.array ? kManyKnots : 1, lanes, uniform, values, random, strings));
      arguments.must_be_uniform.push_back(p.uniform);
    }
  }
  return arguments;
}

std::vector<Value> call(const KernelTable& table, ShadeopId row, const Arguments& arguments,
                        StringPool& strings, const CallOptions& options) {
  std::vector<Planes> read, stored;
  for (size_t i = 0; i < arguments.values.size(); ++i) {
    const Value& v = arguments.values[i];
    bool uniform = arguments.must_be_uniform[i] || (options.uniform_set >> i & 1);
    read.emplace_back(v.planes(), uniform ? kMaxLanes : arguments.lanes, uniform ? 0 : 1, v.elements);
    read.back().fill(v);
  }
  std::vector<Operand> operands;
  std::vector<Type> types = stored_types(row);
  for (Type type : types) {
    stored.emplace_back(size_t(components(type)), arguments.lanes, 1, 1);
    operands.push_back(stored.back().operand);
  }
  for (size_t i = 0; i < read.size(); ++i) {
    operands.push_back(read[i].operand);
    bool fits = components(arguments.values[i].type) == components(types[0]) &&
                arguments.values[i].elements == 1 &&
                (read[i].operand.step == 1 || arguments.lanes == kMaxLanes);
    if (options.in_place && fits && operands[0].data == stored[0].operand.data) operands[0] = read[i].operand;
  }
  KernelContext context{&strings, options.seed, options.first_point, options.begin};
  table[row](operands.data(), static_cast<uint32_t>(operands.size()), arguments.lanes, context);
  std::vector<Value> results;
  for (size_t i = 0; i < types.size(); ++i)
    results.push_back(read_back(operands[i], types[i], arguments.lanes));
  return results;
}

bool same_bits(uint32_t a, uint32_t b, Type type) {
  if (a == b) return true;
  bool number = type != Type::kBool && type != Type::kString;
  return number && std::isnan(std::bit_cast<float>(a)) && std::isnan(std::bit_cast<float>(b));
}

double ulps_between(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  if (!std::isfinite(a) || !std::isfinite(b)) return 1e30;
  auto place = [](float x) {
    auto bits = std::bit_cast<int32_t>(x);
    return bits < 0 ? -double(bits & 0x7fffffff) : double(bits);
  };
  return std::abs(place(a) - place(b));
}

std::vector<float> call_floats(std::string_view name, std::string_view signature,
                               const std::vector<float>& flat) {
  StringPool strings;
  std::mt19937 random(1);
  ShadeopId row = row_of(name, signature);
  Arguments arguments = make_arguments(row, kMaxLanes, Values::kModerate, random, strings);
  size_t next = 0;
  for (Value& v : arguments.values)
    for (size_t p = 0; p < v.planes(); ++p, ++next)
      for (size_t lane = 0; lane < kMaxLanes; ++lane)
        v.set(lane, p, flat.at(next));
  std::vector<float> results;
  for (const Value& v : call(kernel_table(), row, arguments, strings))
    for (size_t p = 0; p < v.planes(); ++p)
      results.push_back(v.at(0, p));
  return results;
}

} // namespace slvm::test
