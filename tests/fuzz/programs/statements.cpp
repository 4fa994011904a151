// Random statements and declarations; see program(), at the end, for the whole.
#include "tests/fuzz/programs/generator.h"
#include "tests/fuzz/programs/writer.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace slvm::test {

namespace {

constexpr int kDepth = 4;   // of expressions
constexpr int kNesting = 5; // of blocks
constexpr int kMaxStatements = 60;

constexpr Type kVariableTypes[] = {Type::kFloat,  Type::kColor,  Type::kPoint, Type::kVector,
                                   Type::kNormal, Type::kMatrix, Type::kString};

} // namespace

Type ProgramWriter::some_type() {
  // Floats are what most programs are about.
  return choose_.chance(50) ? kVariableTypes[choose_.below(std::size(kVariableTypes))] : Type::kFloat;
}

void ProgramWriter::line(const std::string& text) {
  out_.append(static_cast<size_t>(indent_) * 2, ' ');
  out_ += text;
  out_ += '\n';
}

std::vector<const Variable*> ProgramWriter::variables(Type t, bool uniform, bool set, bool arrays) const {
  std::vector<const Variable*> found;
  for (const Variable& v : scope_)
    if (v.type == t && (v.elements > 0) == arrays && (!uniform || v.uniform) && (!set || v.assignable) &&
        !(set && v.uniform && divergent()) && (!inputs_only_ || v.input))
      found.push_back(&v);
  return found;
}

void ProgramWriter::declaration() {
  Variable v;
  v.type = some_type();
  v.name = fmt::format("{}{}", type_name(v.type)[0], next_name_++);
  v.uniform = v.type == Type::kString || (!divergent() && choose_.chance(20));
  std::string type =
      fmt::format("{}{}", v.uniform && v.type != Type::kString ? "uniform " : "", type_name(v.type));
  if (v.type != Type::kString && choose_.chance(20)) {
    v.elements = 1 + static_cast<int>(choose_.below(5));
    std::string values;
    for (int i = 0; i < v.elements; ++i)
      values += (i ? ", " : "") + expression(v.type, 2, v.uniform);
    line(fmt::format("{} {}[{}] = {{{}}};", type, v.name, v.elements, values));
  } else {
    line(fmt::format("{} {} = {};", type, v.name, expression(v.type, kDepth, v.uniform)));
  }
  // Strings that a condition could set at some points only would be varying.
  v.assignable = v.type != Type::kString;
  scope_.push_back(v);
}

void ProgramWriter::assignment() {
  Type t = some_type();
  bool array = choose_.chance(25);
  std::vector<const Variable*> targets = variables(t, false, true, array);
  if (targets.empty()) targets = variables(t = Type::kFloat, false, true, array = false);
  if (targets.empty()) return;
  const Variable v = *one_of(targets);
  constexpr const char* kOperators[] = {"=", "+=", "-=", "*=", "/="};
  const char* op = kOperators[choose_.below(std::size(kOperators))];
  // What the operator gives must be of the variable's type.
  if (t == Type::kPoint || t == Type::kNormal) op = "=";
  if (t == Type::kMatrix && (op[0] == '+' || op[0] == '-')) op = "=";
  std::string place = array ? element(v, v.uniform ? 0 : 2) : v.name;
  line(fmt::format("{} {} {};", place, op, expression(t, kDepth, v.uniform)));
}

void ProgramWriter::if_statement() {
  bool uniform = choose_.chance(25);
  line(fmt::format("if ({}) {{", condition(3, uniform)));
  divergence_ += !uniform;
  block(1 + static_cast<int>(choose_.below(3)));
  if (choose_.chance(50)) {
    line("} else {");
    block(1 + static_cast<int>(choose_.below(3)));
  }
  line("}");
  divergence_ -= !uniform;
}

// A counter that nothing else sets ends each loop.
void ProgramWriter::loop() {
  Variable counter{fmt::format("i{}", next_name_++), Type::kFloat, 0, false, false};
  bool uniform = !divergent() && choose_.chance(30);
  size_t rounds = 1 + choose_.below(5);
  std::string bound = uniform ? std::to_string(rounds)
                              : fmt::format("min({}, {})", rounds, expression(Type::kFloat, 2, false));
  bool is_for = choose_.chance(50);
  std::string more = uniform || choose_.chance(70) ? "" : " && " + condition(2, false);
  line(fmt::format("{}float {} = 0;", uniform ? "uniform " : "", counter.name));
  if (is_for) {
    line(fmt::format("for ({0} = 0; {0} < {1}{2}; {0} += 1) {{", counter.name, bound, more));
  } else {
    line(fmt::format("while ({} < {}{}) {{", counter.name, bound, more));
    line(fmt::format("  {} += 1;", counter.name));
  }
  // A break or continue under a varying condition makes the rest of any loop divergent.
  bool jumps = !uniform || !more.empty() || choose_.chance(50);
  counter.uniform = !jumps;
  without_jumps_ += !jumps;
  divergence_ += jumps;
  scope_.push_back(counter);
  ++loops_;
  block(1 + static_cast<int>(choose_.below(4)));
  --loops_;
  divergence_ -= jumps;
  without_jumps_ -= !jumps;
  line("}");
}

void ProgramWriter::jump() {
  if (in_function_ && choose_.chance(30)) {
    line(returns_ == Type::kVoid ? "return;" : fmt::format("return {};", expression(returns_, 2, false)));
    return;
  }
  if (loops_ == 0 || without_jumps_ > 0) return assignment();
  size_t levels = 1 + choose_.below(static_cast<size_t>(loops_));
  std::string level = levels > 1 ? fmt::format(" {}", levels) : "";
  line(fmt::format("if ({}) {}{};", condition(2, false), choose_.chance(50) ? "continue" : "break", level));
}

void ProgramWriter::illuminance() {
  if (in_illuminance_ || in_function_ || in_light_ || loops_ > 0) return assignment();
  std::string head = choose_.chance(30) ? "\"key\", " : choose_.chance(20) ? "\"-key\", " : "";
  head += expression(Type::kPoint, 2, false);
  if (choose_.chance(50))
    head += fmt::format(", {}, {}", expression(Type::kVector, 2, false), expression(Type::kFloat, 2, false));
  if (choose_.chance(20)) head += fmt::format(", \"send:light:w\", {}", expression(Type::kFloat, 2, false));
  line(fmt::format("illuminance ({}) {{", head));
  in_illuminance_ = true;
  ++divergence_;
  if (const std::vector<const Variable*> targets = variables(Type::kFloat, false, true);
      choose_.chance(30) && !targets.empty())
    line(fmt::format("  lightsource(\"w\", {});", one_of(targets)->name));
  scope_.push_back({"Cl", Type::kColor, 0, false, false});
  scope_.push_back({"L", Type::kVector, 0, false, false});
  ++loops_;
  block(1 + static_cast<int>(choose_.below(4)));
  --loops_;
  --divergence_;
  in_illuminance_ = false;
  line("}");
  // Cl and L end with the loop: block() restores the scope only to its own beginning.
  std::erase_if(scope_, [](const Variable& v) { return v.name == "Cl" || v.name == "L"; });
}

// Variables that the rays of a loop set, as pairs.
std::string ProgramWriter::ray_outputs() {
  constexpr std::pair<const char*, Type> kOutputs[] = {
      {"surface:w", Type::kFloat},      {"surface:Ci", Type::kColor},  {"primitive:P", Type::kPoint},
      {"ray:direction", Type::kVector}, {"ray:length", Type::kFloat},  {"surface:none", Type::kColor},
      {"ray:origin", Type::kPoint},     {"primitive:N", Type::kNormal}};
  std::string pairs;
  std::vector<std::string> taken; // two outputs to one variable: which comes last is not defined
  for (auto [name, type] : kOutputs) {
    if (!choose_.chance(30)) continue;
    std::vector<const Variable*> fitting = variables(type, false, true);
    std::erase_if(fitting, [&](const Variable* v) {
      return v->uniform || std::find(taken.begin(), taken.end(), v->name) != taken.end();
    });
    if (fitting.empty()) continue;
    taken.push_back(one_of(fitting)->name);
    pairs += fmt::format(", \"{}\", {}", name, taken.back());
  }
  return pairs;
}

// A float that rays bring. Under a condition "samplebase" would differentiate the position.
std::string ProgramWriter::ray_function() {
  const std::string p = expression(Type::kPoint, 2, false), d = expression(Type::kVector, 2, false);
  const std::string samples =
      pointwise_
          ? ""
          : fmt::format(", \"samples\", {}, \"samplecone\", 0.3, \"samplebase\", 0", 1 + choose_.below(4));
  switch (choose_.below(5)) {
  case 0: return fmt::format("(float trace({}, {}{}))", p, d, samples);
  case 1: return fmt::format("comp(trace({}, {}{}), {})", p, d, samples, choose_.below(3));
  case 2: return fmt::format("(float transmission({}, {} + {}{}))", p, p, d, samples);
  case 3: return fmt::format("occlusion({}, normal {}, 4)", p, d);
  default: return fmt::format("(float visibility({}, {}))", p, expression(Type::kPoint, 1, false));
  }
}

// A loop over rays, or a call that shoots some. Where a point must not depend on its grid nothing is left to
// chance.
void ProgramWriter::rays() {
  std::vector<const Variable*> floats = variables(Type::kFloat, false, true);
  std::erase_if(floats, [](const Variable* v) { return v->uniform; });
  if (choose_.chance(35) && !floats.empty()) {
    const std::string target = one_of(floats)->name;
    return line(fmt::format("{} = {};", target, ray_function()));
  }
  if (nesting_ >= kNesting || loops_ > 2) return assignment();
  const bool traverse = choose_.chance(35);
  std::string head = fmt::format("\"{}\", {}, {}", choose_.chance(20) ? "occlusion" : "",
                                 expression(Type::kPoint, 2, false), expression(Type::kVector, 2, false));
  if (!traverse) {
    head += fmt::format(", {}", pointwise_ || choose_.chance(40) ? "0" : "0.6");
    head += choose_.chance(60) ? fmt::format(", {}", 1 + choose_.below(4))
                               : fmt::format(", min(3, {})", expression(Type::kFloat, 2, false));
    head += ", \"samplebase\", 0";
    if (choose_.chance(30)) head += ", \"distribution\", \"cosine\"";
  }
  if (choose_.chance(20)) head += fmt::format(", \"maxdist\", {}", expression(Type::kFloat, 2, false));
  ++divergence_;
  head += ray_outputs();
  line(fmt::format("{} ({}) {{", traverse ? "traverse" : "gather", head));
  ++loops_;
  block(1 + static_cast<int>(choose_.below(4)));
  if (choose_.chance(50)) {
    line("} else {");
    block(1 + static_cast<int>(choose_.below(3)));
  }
  --loops_;
  --divergence_;
  line("}");
}

void ProgramWriter::print() {
  // Some texts only: a print in every round of every point would be most of the work. How often a light runs
  // is nobody's business.
  if (loops_ > 0 || in_function_ || in_light_) return assignment();
  line(fmt::format("printf(\"%f %c %s\\n\", {}, {}, {});", expression(Type::kFloat, 2, false),
                   expression(Type::kColor, 2, false), expression(Type::kString, 2, true)));
}

// A function in the shader that reads and sets one of its variables.
void ProgramWriter::nested_function() {
  std::vector<const Variable*> targets = variables(Type::kFloat, false, true);
  std::erase_if(targets, [](const Variable* v) { return v->uniform; });
  if (nesting_ != 1 || in_function_ || in_light_ || targets.empty()) return assignment();
  const std::string name = one_of(targets)->name, function = fmt::format("nested{}", next_name_++);
  line(fmt::format(
      "float {}(float x) {{ extern float {}; if (x > {}) {{ {} = x; return x * 2; }} {} -= 1; return {}; }}",
      function, name, name, name, name, name));
  functions_.push_back({function, Type::kFloat, {{"x", Type::kFloat, 0, false, false, false}}});
}

void ProgramWriter::call_statement() {
  std::vector<ShadeopId> known = rows(Type::kVoid, false);
  std::vector<const Function*> fitting;
  for (const Function& f : functions_)
    if (f.result == Type::kVoid) fitting.push_back(&f);
  std::string text;
  if (!fitting.empty() && choose_.chance(60)) {
    text = call(*one_of(fitting), kDepth);
  } else {
    ShadeopId id = one_of(known);
    std::vector<std::string> args;
    if (arguments(id, 3, false, args)) text = fmt::format("{}({})", shadeop(id).name, fmt::join(args, ", "));
  }
  if (text.empty()) return assignment();
  line(text + ";");
}

void ProgramWriter::statement() {
  if (statements_left_-- <= 0 || choose_.at_end()) return;
  bool deep = nesting_ >= kNesting;
  switch (choose_.below(15)) {
  case 0:
  case 1:
  case 2: return assignment();
  case 3:
  case 4: return declaration();
  case 5:
  case 6: return deep ? assignment() : if_statement();
  case 7:
  case 8: return deep || loops_ > 2 ? assignment() : loop();
  case 9: return jump();
  case 10: return call_statement();
  case 11: return deep ? assignment() : illuminance();
  case 12: return print();
  case 13: return nested_function();
  case 14: return rays();
  }
}

void ProgramWriter::block(int statements) {
  size_t known = scope_.size();
  ++indent_;
  ++nesting_;
  for (int i = 0; i < statements; ++i)
    statement();
  --nesting_;
  --indent_;
  scope_.resize(std::min(known, scope_.size()));
}

void ProgramWriter::function(const std::string& name) {
  Function f{name, choose_.chance(30) ? Type::kVoid : some_type(), {}};
  if (f.result == Type::kString) f.result = Type::kFloat;
  std::string formals;
  for (size_t i = choose_.below(4); i > 0; --i) {
    Variable v{fmt::format("a{}", next_name_++), some_type(), 0, false, false};
    v.uniform = v.type == Type::kString || choose_.chance(15);
    if (!v.uniform && choose_.chance(40)) v.assignable = true;
    const char* class_of = v.assignable ? "output " : v.uniform && v.type != Type::kString ? "uniform " : "";
    formals += fmt::format("{}{}{} {}", formals.empty() ? "" : "; ", class_of, type_name(v.type), v.name);
    f.formals.push_back(v);
  }
  line(fmt::format("{} {}({}) {{", type_name(f.result), name, formals));
  std::vector<Variable> outside = std::exchange(scope_, f.formals);
  in_function_ = true;
  returns_ = f.result;
  ++divergence_; // a return under a varying condition makes the rest divergent
  block(1 + static_cast<int>(choose_.below(5)));
  scope_ = f.formals;
  if (f.result != Type::kVoid) line(fmt::format("  return {};", expression(f.result, 3, false)));
  --divergence_;
  in_function_ = false;
  scope_ = std::move(outside);
  line("}");
  functions_.push_back(f);
}

std::string ProgramWriter::program(bool pointwise) {
  pointwise_ = pointwise;
  statements_left_ = kMaxStatements;
  for (size_t i = choose_.below(4); i > 0; --i)
    function(fmt::format("fn{}", i));
  line("surface t(");
  line("  float pf = 0.5; uniform float pu = 3; color pc = color (0.2, 0.4, 0.8); string ps = \"abc\";");
  line("  varying float pv = 0.25; float pa[3] = {1, -2, 0.5};");
  line("  output varying float of = 0; output varying color oc = 0; output varying point op = 0;");
  line("  output varying vector ov = 0; output varying normal on = 0; output varying matrix om = 1;");
  line("  output varying float oa[3] = {0, 0, 0};) {");
  auto add = [&](const char* name, Type t, bool uniform, bool assignable, int elements = 0) {
    scope_.push_back({name, t, elements, uniform, assignable, !assignable && elements == 0});
  };
  for (const char* name : {"pv", "s", "t"})
    add(name, Type::kFloat, false, false);
  add("pf", Type::kFloat, true, false);
  add("pu", Type::kFloat, true, false);
  add("pc", Type::kColor, true, false);
  add("ps", Type::kString, true, false);
  add("pa", Type::kFloat, true, false, 3);
  add("P", Type::kPoint, false, false);
  add("N", Type::kNormal, false, false);
  add("of", Type::kFloat, false, true);
  add("oc", Type::kColor, false, true);
  add("op", Type::kPoint, false, true);
  add("ov", Type::kVector, false, true);
  add("on", Type::kNormal, false, true);
  add("om", Type::kMatrix, false, true);
  add("oa", Type::kFloat, false, true, 3);
  add("Ci", Type::kColor, false, true);
  add("Oi", Type::kColor, false, true);
  block(20);
  line("}");
  return std::move(out_);
}

// Some code, an illuminate or solar with more, and some behind it.
std::string ProgramWriter::light(bool pointwise) {
  pointwise_ = pointwise;
  in_light_ = true;
  statements_left_ = kMaxStatements / 3;
  line("light l(varying float w = 2; varying color tint = color (1, 0.5, 0.25);) {");
  auto add = [&](const char* name, Type t, bool uniform, bool assignable) {
    scope_.push_back({name, t, 0, uniform, assignable, !assignable});
  };
  add("w", Type::kFloat, false, false);
  add("tint", Type::kColor, false, false);
  add("Ps", Type::kPoint, false, false);
  add("Ns", Type::kNormal, false, false);
  add("s", Type::kFloat, false, false);
  add("Cl", Type::kColor, false, true);
  add("Ol", Type::kColor, false, true);
  block(4);
  const bool cone = choose_.chance(50);
  std::string head = choose_.chance(50)
                         ? ""
                         : expression(Type::kVector, 2, false) + ", " + expression(Type::kFloat, 2, false);
  if (cone) head = expression(Type::kPoint, 2, false) + (head.empty() ? "" : ", " + head);
  line(fmt::format("  {} ({}) {{", cone ? "illuminate" : "solar", head));
  divergence_ += 1;
  ++loops_; // no prints, no light loops
  without_jumps_ += 1;
  add("L", Type::kVector, false, false);
  block(4);
  line(fmt::format("    Cl = {};", expression(Type::kColor, 3, false)));
  scope_.pop_back();
  without_jumps_ -= 1;
  --loops_;
  divergence_ -= 1;
  line("  }");
  block(2);
  line("}");
  return std::move(out_);
}

RandomProgram random_program(Choices& choices) {
  RandomProgram p;
  p.pointwise = choices.below(2) == 0;
  p.source = ProgramWriter(choices).program(p.pointwise);
  p.light = ProgramWriter(choices).light(p.pointwise);
  return p;
}

} // namespace slvm::test
