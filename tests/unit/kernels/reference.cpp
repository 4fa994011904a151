#include "tests/unit/kernels/reference.h"

#include <algorithm>
#include <iterator>
#include <numbers>

namespace slvm::test {
namespace {

constexpr double kPi = std::numbers::pi;

double clamp_as_the_language(double a, double lo, double hi) {
  return a < lo ? lo : a > hi ? hi : a;
}

#define SL_UNARY(expression)                                                                                 \
  [](Row, In in, Out out) {                                                                                  \
    double x = in[0];                                                                                        \
    out[0] = expression;                                                                                     \
  }
#define SL_BINARY(expression)                                                                                \
  [](Row, In in, Out out) {                                                                                  \
    double a = in[0], b = in[1];                                                                             \
    out[0] = expression;                                                                                     \
  }

// clang-format off: a row a line
constexpr Reference kScalars[] = {
    {"operator+", 2, SL_BINARY(a + b)},
    {"operator-", 2, SL_BINARY(a - b)},
    {"operator*", 2, SL_BINARY(a * b)},
    {"operator/", 2, SL_BINARY(a / b)},
    {"operator-", 1, SL_UNARY(-x)},
    {"operator==", 2, SL_BINARY(a == b)},
    {"operator!=", 2, SL_BINARY(a != b)},
    {"operator<", 2, SL_BINARY(a < b)},
    {"operator<=", 2, SL_BINARY(a <= b)},
    {"operator>", 2, SL_BINARY(a > b)},
    {"operator>=", 2, SL_BINARY(a >= b)},
    {"operator&&", 2, SL_BINARY(a != 0 && b != 0)},
    {"operator||", 2, SL_BINARY(a != 0 || b != 0)},
    {"operator!", 1, SL_UNARY(x == 0)},
    {"operator?:", 3, [](Row, In in, Out out) { out[0] = in[0] != 0 ? in[1] : in[2]; }},
    {"radians", 1, SL_UNARY(x * kPi / 180)},
    {"degrees", 1, SL_UNARY(x * 180 / kPi)},
    {"sin", 1, SL_UNARY(std::sin(x)), -1e5, 1e5},
    {"cos", 1, SL_UNARY(std::cos(x)), -1e5, 1e5},
    {"tan", 1, SL_UNARY(std::tan(x)), -1e5, 1e5},
    {"asin", 1, SL_UNARY(std::asin(std::clamp(x, -1.0, 1.0))), -1.1, 1.1},
    {"acos", 1, SL_UNARY(std::acos(std::clamp(x, -1.0, 1.0))), -1.1, 1.1},
    {"atan", 1, SL_UNARY(std::atan(x))},
    {"atan", 2, SL_BINARY(std::atan2(a, b))},
    {"pow", 2, SL_BINARY(a < 0 && b != std::floor(b) ? 0.0 : std::pow(a, b))},
    {"exp", 1, SL_UNARY(std::exp(x)), -80, 80},
    {"log", 1, SL_UNARY(std::log(x)), 0, 1e6},
    {"log", 2, SL_BINARY(std::log(a) / std::log(b)), 0, 100},
    {"sqrt", 1, SL_UNARY(x < 0 ? 0 : std::sqrt(x))},
    {"inversesqrt", 1, SL_UNARY(x > 0 ? 1 / std::sqrt(x) : 0)},
    // Two roundings of the product and the difference, in units of the greater operand.
    {"mod", 2, SL_BINARY(Expected(a - b * std::floor(a / b), std::max(std::abs(a), std::abs(b))))},
    {"abs", 1, SL_UNARY(std::abs(x))},
    {"sign", 1, SL_UNARY(x > 0 ? 1 : x < 0 ? -1 : 0)},
    {"floor", 1, SL_UNARY(std::floor(x))},
    {"ceil", 1, SL_UNARY(std::ceil(x))},
    {"round", 1, SL_UNARY(std::floor(x + 0.5))},
    {"erf", 1, SL_UNARY(std::erf(x)), -4, 4},
    {"erfc", 1, SL_UNARY(std::erfc(x)), -4, 8},
    {"min", 2, SL_BINARY(std::min(a, b))},
    {"max", 2, SL_BINARY(std::max(a, b))},
    {"clamp", 3, [](Row, In in, Out out) { out[0] = clamp_as_the_language(in[0], in[1], in[2]); }},
    {"muladd", 3, [](Row, In in, Out out) { out[0] = Expected(in[0] * in[1] + in[2], std::abs(in[0] * in[1])); }},
    {"mix", 3,
     [](Row, In in, Out out) {
       double a = (1 - in[2]) * in[0], b = in[2] * in[1];
       out[0] = Expected(a + b, std::abs(in[0]) * (1 + std::abs(in[2])) + std::abs(b));
     }},
    {"step", 2, SL_BINARY(b < a ? 0 : 1)},
    {"smoothstep", 3,
     [](Row, In in, Out out) {
       double y = (in[2] - in[0]) / (in[1] - in[0]);
       out[0] = in[2] < in[0] ? 0 : in[2] >= in[1] ? 1 : Expected(y * y * (3 - 2 * y), 1);
     }},
    {"convert", 1,
     [](Row s, In in, Out out) {
       for (int i = 0; i < components(s.result); ++i)
         out[i] = in[0];
       if (s.result == Type::kMatrix)
         for (int i = 0; i < 16; ++i)
           out[i] = i % 5 == 0 ? in[0] : 0;
       if (s.result == Type::kBool) out[0] = in[0] != 0;
     }},
}
;
// clang-format on
#undef SL_UNARY
#undef SL_BINARY

int planes_read(const Signature& s) {
  int planes = 0;
  for (int i = 0; i < s.param_count; ++i)
    if (s.params[i].input) planes += components(s.params[i].type);
  return planes;
}

} // namespace

std::span<const Reference> scalar_references() {
  return kScalars;
}

const Reference* find_reference(ShadeopId row) {
  const ShadeopInfo& info = shadeop(row);
  int planes = planes_read(info.signature);
  for (std::span<const Reference> list : {scalar_references(), triple_references(), pattern_references()})
    for (const Reference& r : list)
      if (r.name == info.name && (r.planes_read == planes || r.planes_read < 0)) return &r;
  return nullptr;
}

bool is_transcendental(std::string_view name) {
  constexpr std::string_view kNames[] = {"sin", "cos", "tan", "asin", "acos", "atan",
                                         "pow", "exp", "log", "erf",  "erfc", "rotate"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

} // namespace slvm::test
