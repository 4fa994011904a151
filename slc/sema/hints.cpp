// The table of names that are common elsewhere.
#include "slc/sema/hints.h"

namespace slc {
namespace {

struct Hint {
  std::string_view name, advice;
};
constexpr Hint kHints[] = {
    {"dot", "RSL writes the dot product a . b"},
    {"cross", "RSL writes the cross product a ^ b"},
    {"lerp", "use mix(a, b, t)"},
    {"saturate", "use clamp(x, 0, 1)"},
    {"fract", "use mod(x, 1)"},
    {"frac", "use mod(x, 1)"},
    {"fmod", "use mod(a, b)"},
    {"atan2", "use atan(y, x)"},
    {"fabs", "use abs(x)"},
    {"ln", "use log(x)"},
    {"log2", "use log(x, 2)"},
    {"log10", "use log(x, 10)"},
    {"exp2", "use pow(2, x)"},
    {"rsqrt", "use inversesqrt(x)"},
    {"hypot", "use length() or sqrt(x*x + y*y)"},
    {"square", "write x*x"},
    {"inverse", "RSL writes the inverse of a matrix 1/m"},
    {"transpose", "there is none; build the matrix from comp()"},
    {"ddx", "use Du(x)"},
    {"ddy", "use Dv(x)"},
    {"dFdx", "use Du(x)"},
    {"dFdy", "use Dv(x)"},
    {"fwidth", "use abs(Du(x)*du) + abs(Dv(x)*dv)"},
    {"tex2D", "use texture(name, s, t)"},
    {"rand", "use random()"},
    {"snoise", "use 2*noise(p) - 1"},
    {"luminance", "use comp() and the weights of your color space"},
    {"rgb2hsv", "use ctransform(\"rgb\", \"hsv\", c)"},
    {"hsv2rgb", "use ctransform(\"hsv\", \"rgb\", c)"},
    {"print", "use printf(\"%f\", x)"},
};

} // namespace

std::string_view function_hint(std::string_view name) {
  for (const Hint& hint : kHints)
    if (hint.name == name) return hint.advice;
  return {};
}

ExprPtr copy_constant(const Expr& e, SourceRange range) {
  if (const auto* text = as<StringExpr>(&e)) {
    auto copy = std::make_unique<StringExpr>(range);
    copy->value = text->value;
    copy->type = Type::kString;
    return copy;
  }
  auto copy = std::make_unique<NumberExpr>(range);
  if (const auto* number = as<NumberExpr>(&e)) copy->value = number->value;
  copy->type = Type::kFloat;
  return copy;
}

} // namespace slc
