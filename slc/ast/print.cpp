// The text form of the tree: one function per kind of node.
#include "slc/ast/print.h"

#include <fmt/format.h>

namespace slc {
namespace {

std::string quoted(std::string_view text) {
  std::string out(1, '"');
  for (char c : text) {
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (c == '"' || c == '\\')
      (out += '\\') += c;
    else
      out += c;
  }
  out += '"';
  return out;
}

std::string type_text(Type type, int array_length) {
  std::string text(slvm::type_name(type));
  if (array_length == kOpenArray)
    text += "[]";
  else if (array_length != kNotArray)
    text += fmt::format("[{}]", array_length);
  return text;
}

class Printer {
public:
  std::string take() { return std::move(out_); }

  void unit(const TranslationUnit& unit) {
    for (const Annotation& a : unit.annotations)
      line(fmt::format("annotation {} {}", quoted(a.id), quoted(a.text)));
    for (const FunctionDef& f : unit.functions)
      function(f);
    for (const Shader& s : unit.shaders)
      shader(s);
  }
  void expression(const Expr& e);

private:
  // A line at the current depth.
  void line(std::string_view text) { out_ += fmt::format("{:{}}{}\n", "", 2 * depth_, text); }
  template <class F> void nested(F&& f) {
    ++depth_;
    f();
    --depth_;
  }
  void child(const ExprPtr& e) {
    if (e) nested([&] { expression(*e); });
  }
  void children(const std::vector<ExprPtr>& list) {
    for (const ExprPtr& e : list)
      child(e);
  }
  void labelled(std::string_view label, const ExprPtr& e) {
    if (!e) return;
    nested([&] {
      line(label);
      child(e);
    });
  }
  void labelled(std::string_view label, const StmtPtr& s) {
    if (!s) return;
    nested([&] {
      line(label);
      nested([&] { statement(*s); });
    });
  }
  void token_args(const std::vector<TokenArg>& list) {
    for (const TokenArg& t : list) {
      labelled(t.info && t.info->output ? "token, output" : "token", t.token);
      nested([&] { child(t.value); });
    }
  }
  // "head : uniform float", without the type as long as there is none.
  void typed(const Expr& e, std::string head) {
    if (e.type != Type::kVoid)
      head += fmt::format(" : {} {}", e.detail == Detail::kUniform ? "uniform" : "varying",
                          type_text(e.type, e.array_length));
    line(head);
  }
  static std::string row(const CallExpr& call) {
    return call.plugin ? fmt::format(" [{} {} of {}]", call.plugin->info().name,
                                     call.plugin->info().signature_text, call.plugin->name().library)
                       : row(call.shadeop);
  }
  static std::string row(ShadeopId id) {
    if (id == kNoShadeop) return "";
    const slvm::ShadeopInfo& info = slvm::shadeop(id);
    return fmt::format(" [{} {}]", info.name, info.signature_text);
  }
  void variable(const Variable& v, std::string_view what);
  void function(const FunctionDef& f);
  void shader(const Shader& s);
  void statement(const Stmt& s);
  void light_loop(const IlluminanceStmt& s);
  void emission(const EmissionStmt& s);
  void gather(const GatherStmt& s);

  std::string out_;
  int depth_ = 0;
};

void Printer::expression(const Expr& e) {
  switch (e.kind) {
  case ExprKind::kNumber: return typed(e, fmt::format("{}", as<NumberExpr>(&e)->value));
  case ExprKind::kString: return typed(e, quoted(as<StringExpr>(&e)->value));
  case ExprKind::kVariable: return typed(e, as<VariableExpr>(&e)->name);
  case ExprKind::kIndex: typed(e, as<IndexExpr>(&e)->name + "[]"); return child(as<IndexExpr>(&e)->index);
  case ExprKind::kTuple:
    typed(e, "tuple" + row(as<TupleExpr>(&e)->shadeop));
    return children(as<TupleExpr>(&e)->elements);
  case ExprKind::kArrayInit: typed(e, "elements"); return children(as<ArrayInitExpr>(&e)->elements);
  case ExprKind::kOperator:
    typed(e, std::string(operator_text(as<OperatorExpr>(&e)->op)) + row(as<OperatorExpr>(&e)->shadeop));
    return children(as<OperatorExpr>(&e)->operands);
  case ExprKind::kLogical:
    typed(e, as<LogicalExpr>(&e)->is_and ? "&&" : "||");
    child(as<LogicalExpr>(&e)->left);
    return child(as<LogicalExpr>(&e)->right);
  case ExprKind::kConditional:
    typed(e, "?:");
    child(as<ConditionalExpr>(&e)->condition);
    child(as<ConditionalExpr>(&e)->then_value);
    return child(as<ConditionalExpr>(&e)->else_value);
  case ExprKind::kConvert:
    typed(e, (as<ConvertExpr>(&e)->shadeop == kNoShadeop ? "retype" : "convert") +
                 row(as<ConvertExpr>(&e)->shadeop));
    return child(as<ConvertExpr>(&e)->operand);
  case ExprKind::kCast: {
    const auto& cast = *as<CastExpr>(&e);
    typed(e, fmt::format("cast {}{}", slvm::type_name(cast.target),
                         cast.has_space ? fmt::format(" {}", quoted(cast.space)) : ""));
    return child(cast.operand);
  }
  case ExprKind::kCall: {
    const auto& call = *as<CallExpr>(&e);
    typed(e, fmt::format("call {}{}{}", call.name, call.function ? " inlined" : "", row(call)));
    labelled("channel", call.channel);
    children(call.args);
    return token_args(call.tokens);
  }
  case ExprKind::kAssign: {
    const auto& assign = *as<AssignExpr>(&e);
    typed(e, fmt::format("{}=", assign.compound ? operator_text(assign.op) : ""));
    child(assign.target);
    return child(assign.value);
  }
  case ExprKind::kTargetValue: return typed(e, "old value");
  }
}

void Printer::variable(const Variable& v, std::string_view what) {
  line(fmt::format("{}{}{} {} {}", what, v.output ? " output" : "",
                   v.detail_given ? (v.detail == Detail::kUniform ? " uniform" : " varying") : "",
                   type_text(v.type, v.array_length), v.name));
  labelled("length", v.length_expr);
  if (!v.init_space.empty()) nested([&] { line(fmt::format("space {}", quoted(v.init_space))); });
  child(v.init);
}

void Printer::function(const FunctionDef& f) {
  line(fmt::format("function {}{}{} {}", f.result_given ? "" : "(implicit) ",
                   f.result_uniform ? "uniform " : "", slvm::type_name(f.result), f.name));
  nested([&] {
    for (const Variable* v : f.formals)
      variable(*v, "formal");
    if (f.body) statement(*f.body);
  });
}

void Printer::shader(const Shader& s) {
  line(fmt::format("{} {}", slvm::shader_kind_name(s.kind), s.name));
  nested([&] {
    for (const Annotation& a : s.annotations)
      line(fmt::format("annotation {} {}", quoted(a.id), quoted(a.text)));
    for (const Variable* v : s.params)
      variable(*v, "parameter");
    if (s.body) statement(*s.body);
  });
}

void Printer::light_loop(const IlluminanceStmt& s) {
  line("illuminance");
  children(s.args);
  labelled("category", s.category);
  labelled("position", s.position);
  labelled("axis", s.axis);
  labelled("angle", s.angle);
  token_args(s.tokens);
  labelled("body", s.body);
}

void Printer::emission(const EmissionStmt& s) {
  line(s.is_solar ? "solar" : "illuminate");
  children(s.args);
  labelled("position", s.position);
  labelled("axis", s.axis);
  labelled("angle", s.angle);
  labelled("body", s.body);
}

void Printer::gather(const GatherStmt& s) {
  line(s.is_traverse ? "traverse" : "gather");
  children(s.args);
  labelled("category", s.category);
  labelled("position", s.position);
  labelled("direction", s.direction);
  labelled("angle", s.angle);
  labelled("samples", s.samples);
  token_args(s.tokens);
  labelled("body", s.body);
  labelled("else", s.else_body);
}

void Printer::statement(const Stmt& s) {
  switch (s.kind) {
  case StmtKind::kEmpty: return line("empty");
  case StmtKind::kBlock:
    line("block");
    return nested([&] {
      for (const StmtPtr& child : as<BlockStmt>(&s)->statements)
        statement(*child);
    });
  case StmtKind::kDeclaration:
    for (const Variable* v : as<DeclarationStmt>(&s)->variables)
      variable(*v, as<DeclarationStmt>(&s)->is_extern ? "extern" : "local");
    return;
  case StmtKind::kFunction: return line(fmt::format("function {}", as<FunctionStmt>(&s)->function->name));
  case StmtKind::kExpression:
    for (const ExprPtr& e : as<ExpressionStmt>(&s)->expressions)
      expression(*e);
    return;
  case StmtKind::kIf:
    line("if");
    child(as<IfStmt>(&s)->condition);
    labelled("then", as<IfStmt>(&s)->then_branch);
    return labelled("else", as<IfStmt>(&s)->else_branch);
  case StmtKind::kLoop: {
    const auto& loop = *as<LoopStmt>(&s);
    line(loop.is_for ? "for" : "while");
    labelled("init", loop.init);
    labelled("condition", loop.condition);
    for (const ExprPtr& step : loop.steps)
      labelled("step", step);
    return labelled("body", loop.body);
  }
  case StmtKind::kJump:
    return line(
        fmt::format("{} {}", as<JumpStmt>(&s)->is_break ? "break" : "continue", as<JumpStmt>(&s)->levels));
  case StmtKind::kReturn: line("return"); return child(as<ReturnStmt>(&s)->value);
  case StmtKind::kIlluminance: return light_loop(*as<IlluminanceStmt>(&s));
  case StmtKind::kEmission: return emission(*as<EmissionStmt>(&s));
  case StmtKind::kGather: return gather(*as<GatherStmt>(&s));
  }
}

} // namespace

std::string print_ast(const TranslationUnit& unit) {
  Printer printer;
  printer.unit(unit);
  return printer.take();
}

std::string print_ast(const Expr& e) {
  Printer printer;
  printer.expression(e);
  return printer.take();
}

} // namespace slc
