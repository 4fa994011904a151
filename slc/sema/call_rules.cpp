// What single functions ask for beyond the types of their arguments: print patterns, names of spaces, knots
// of splines.
#include "slc/sema/checker.h"

namespace slc {
namespace {

constexpr std::string_view kColourSpaces[] = {"rgb", "RGB", "hsv", "HSV", "hsl", "HSL",
                                              "YIQ", "yiq", "xyz", "XYZ", "xyY", "xyy"};
constexpr std::string_view kSpaces[] = {"current", "object", "shader", "world", "camera",
                                        "screen",  "raster", "NDC",    "eye"};

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool takes_pattern(std::string_view function) {
  return function == "printf" || function == "format" || function == "error" || function == "warning";
}

struct Conversion {
  size_t at = 0; // of the '%'
  std::string text;
  char letter = 0;
};

// The conversions of a pattern that take a value; %% is none.
std::vector<Conversion> conversions(std::string_view pattern) {
  std::vector<Conversion> found;
  for (size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') continue;
    size_t end = i + 1;
    while (end < pattern.size() &&
           std::string_view("+-# .0123456789").find(pattern[end]) != std::string_view::npos)
      ++end;
    char letter = end < pattern.size() ? pattern[end] : '\0';
    size_t length = std::min(end + 1, pattern.size()) - i;
    if (letter != '%') found.push_back({i, std::string(pattern.substr(i, length)), letter});
    i += length - 1;
  }
  return found;
}

// The type a conversion prints; kVoid: there is no such conversion.
Type conversion_type(char letter) {
  switch (letter) {
  case 'f':
  case 'd':
  case 'i':
  case 'g':
  case 'e': return Type::kFloat;
  case 'p':
  case 'v':
  case 'n':
  case 'h': return Type::kPoint;
  case 'c': return Type::kColor;
  case 'm': return Type::kMatrix;
  case 's': return Type::kString;
  default: return Type::kVoid;
  }
}

bool prints(char letter, Type type) {
  Type expected = conversion_type(letter);
  return expected == type || (expected == Type::kPoint && slvm::is_geometric(type)) ||
         (letter == 'h' && type == Type::kColor);
}

} // namespace

Type Checker::wanted_by_pattern(const CallExpr& call, size_t arg) const {
  if (!takes_pattern(call.name) || arg == 0) return Type::kVoid;
  const auto* pattern = as<StringExpr>(call.args[0].get());
  if (!pattern) return Type::kVoid;
  std::vector<Conversion> list = conversions(pattern->value);
  Type wanted = arg <= list.size() ? conversion_type(list[arg - 1].letter) : Type::kVoid;
  return set_of(*call.args[arg]).has(wanted) ? wanted : Type::kVoid;
}

void Checker::check_call_rules(CallExpr& call) {
  if (call.function || call.plugin) return;
  if (takes_pattern(call.name)) return check_print_pattern(call);
  if (call.name == "ctransform")
    for (const ExprPtr& arg : call.args)
      check_colour_space(*arg);
  if (call.name == "transform" || call.name == "vtransform" || call.name == "ntransform") {
    for (const ExprPtr& arg : call.args)
      check_space(*arg);
    check_transform_source(call);
  }
  if (call.name == "spline") {
    size_t first = call.args[0]->type == Type::kString ? 2 : 1; // of the knots
    size_t knots = call.args.size() - first;
    bool counted = knots == 2 && call.args[first + 1]->array_length != kNotArray; // spline(x, n, array)
    int array = call.args[first + counted]->array_length;
    if (array == kNotArray ? knots < 4 : array > 0 && array < 4)
      report(diags_, Msg::kTooFewKnots, call.range, array == kNotArray ? static_cast<int>(knots) : array);
  }
}

void Checker::check_print_pattern(CallExpr& call) {
  const auto* pattern = as<StringExpr>(call.args[0].get());
  if (!pattern) return;
  std::vector<Conversion> list = conversions(pattern->value);
  size_t values = call.args.size() - 1;
  for (const Conversion& c : list)
    if (conversion_type(c.letter) == Type::kVoid)
      return void(report(diags_, Msg::kBadConversion, pattern->range, c.text));
  if (list.size() != values) {
    report(diags_, Msg::kPatternCount, call.range, counted(list.size(), "conversion"),
           counted(values, "value"));
    return;
  }
  for (size_t i = 0; i < values; ++i) {
    const Expr& value = *call.args[i + 1];
    if (!set_of(value).is_error() && !prints(list[i].letter, value.type))
      report(diags_, Msg::kPatternType, value.range, list[i].text, slvm::type_name(value.type));
  }
}

void Checker::check_colour_space(const Expr& name) {
  const auto* constant = as<StringExpr>(&name);
  if (!constant || contains(kColourSpaces, constant->value)) return;
  report(diags_, Msg::kUnknownColourSpace, name.range, constant->value);
}

// Scenes can name spaces of their own: only what looks like a slip is reported.
void Checker::check_space(const Expr& name) {
  const auto* constant = as<StringExpr>(&name);
  if (!constant) return;
  std::string_view near = slvm::nearest_name(constant->value, kSpaces);
  if (!near.empty() && !contains(kSpaces, constant->value))
    report(diags_, Msg::kUnknownSpace, name.range, constant->value, near);
}

// The space the value of an expression was transformed to; "" when nothing is known.
std::string Checker::space_of(const Expr& e) const {
  if (const auto* name = as<VariableExpr>(&e)) {
    auto it = spaces_.find(name->variable);
    return it == spaces_.end() ? "" : it->second;
  }
  const auto* call = as<CallExpr>(&e);
  if (!call || call->args.empty() ||
      (call->name != "transform" && call->name != "vtransform" && call->name != "ntransform"))
    return "";
  bool names_both = call->args.size() == 3;
  const auto* to = as<StringExpr>(call->args[names_both ? 1 : 0].get());
  return to ? to->value : "";
}

// A value that was transformed to one space is transformed again as if it were in another.
void Checker::check_transform_source(const CallExpr& call) {
  const auto* value = as<VariableExpr>(call.args.back().get());
  if (!value || call.args[0]->type != Type::kString) return;
  std::string known = space_of(*value);
  if (known.empty()) return;
  std::string from = "current";
  if (call.args.size() == 3) {
    const auto* name = as<StringExpr>(call.args[0].get());
    from = name ? name->value : "";
  }
  if (from != known) report(diags_, Msg::kSpaceLint, value->range, value->name, known);
}

} // namespace slc
