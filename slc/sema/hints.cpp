// The table of names that are common elsewhere.
#include "slc/sema/hints.h"

#include "slc/embedded.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

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
    {"luminance", "use comp() and the weights of your color space"},
    {"rgb2hsv", "use ctransform(\"rgb\", \"hsv\", c)"},
    {"hsv2rgb", "use ctransform(\"hsv\", \"rgb\", c)"},
    {"print", "use printf(\"%f\", x)"},
    {"vec2", "use two floats, or a triple"},
    {"vec3", "write color(x, y, z), vector(x, y, z), point(x, y, z) or normal(x, y, z)"},
    {"float3", "write color(x, y, z), vector(x, y, z), point(x, y, z) or normal(x, y, z)"},
    {"vector3", "write vector(x, y, z)"},
    {"vec4", "use a color and a float"},
    {"float4", "use a color and a float"},
    {"rgb", "write color(r, g, b)"},
    {"rgba", "write color(r, g, b); opacity is a color of its own"},
    {"int", "use floor(x), or round(x)"},
    {"not", "logical 'not' is !"},
    {"mul", "use transform(m, p), vtransform(m, v) or ntransform(m, n)"},
    {"transformPoint", "use transform(m, p)"},
    {"texture2D", "use texture(name, s, t)"},
    {"tex", "use texture(name, s, t)"},
    {"emission", "add the color to Ci"},
    {"transparent", "set Oi to the opacity, and multiply Ci by it"},
    {"strcat", "use concat(a, b)"},
    {"sprintf", "use format(pattern, values...)"},
    {"array_length", "use arraylength(a)"},
    {"sizeof", "use arraylength(a)"},
    {"getattribute", "use attribute(name, variable)"},
    {"getmessage", "use surface(), displacement() or lightsource()"},
    {"setmessage", "declare an 'output' parameter"},
};

constexpr std::string_view kAsString = "names of spaces are strings and stand in quotes";
constexpr Hint kVariables[] = {
    {"true", "write 1"},
    {"TRUE", "write 1"},
    {"false", "write 0"},
    {"FALSE", "write 0"},
    {"NULL", "nothing is null; the empty string is \"\""},
    {"M_PI", "the constant is PI"},
    {"pi", "the constant is PI"},
    {"Pi", "the constant is PI"},
    {"gl_FragColor", "surfaces set Ci and Oi"},
    {"gl_FragCoord", "transform P to \"raster\" space"},
    {"gl_Position", "displacements set P"},
    {"uv", "the parameters are u and v, the texture coordinates s and t"},
    {"world", kAsString},
    {"object", kAsString},
    {"shader", kAsString},
    {"camera", kAsString},
    {"screen", kAsString},
    {"raster", kAsString},
    {"NDC", kAsString},
    {"current", kAsString},
};

} // namespace

std::string_view function_hint(std::string_view name) {
  for (const Hint& hint : kHints)
    if (hint.name == name) return hint.advice;
  return {};
}

// A definition begins its line with a type, or is a macro.
std::string_view header_defining(std::string_view name) {
  std::string call = fmt::format(" {}(", name);
  for (const EmbeddedText& header : standard_headers())
    for (size_t at = header.text.find(call); at != std::string_view::npos;
         at = header.text.find(call, at + 1)) {
      size_t line = header.text.rfind('\n', at) + 1; // npos + 1 is 0
      std::string_view before = header.text.substr(line, at - line);
      for (std::string_view word :
           {"float", "color", "point", "vector", "normal", "matrix", "void", "#define"})
        if (before == word) return header.name;
    }
  return {};
}

std::string_view variable_hint(std::string_view name) {
  for (const Hint& hint : kVariables)
    if (hint.name == name) return hint.advice;
  return {};
}

// What shaders of other renderers give to calls that shoot rays.
constexpr Hint kRayTokens[] = {
    {"adaptive", "all rays are shot"},
    {"axis", "rays go about the direction that the call says"},
    {"brightnesswarp",
     "directions as the light of a map comes are had from gather, with \"distribution\" and the map's name"},
    {"hitmode", "what is there blocks, whatever its opacity, and no shader runs"}, // occlusion only
    {"gridcontrol", "Attribute \"irradiance\" \"maxerror\" and \"maxpixeldist\" say where rays are shot"},
};
constexpr std::string_view kRayTokenSets[] = {"trace",           "transmission", "occlusion",
                                              "indirectdiffuse", "gather",       "traverse"};

std::string_view token_hint(std::string_view set, std::string_view token) {
  if (std::find(std::begin(kRayTokenSets), std::end(kRayTokenSets), set) != std::end(kRayTokenSets))
    for (const Hint& hint : kRayTokens)
      if (hint.name == token) return hint.advice;
  if ((set == "gather" || set == "traverse") && token.starts_with("light:"))
    return "rays hit surfaces, not lights; let the surface keep what its light loop finds in an output "
           "parameter, "
           "and ask for that by \"surface:NAME\"";
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
