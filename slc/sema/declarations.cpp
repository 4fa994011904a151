// Functions, shaders and variables.
#include "slc/sema/checker.h"

#include <cmath>

namespace slc {
namespace {

constexpr float kMaxArrayLength = 1'000'000;

std::string variable_type(const Variable& v) {
  std::string text(slvm::type_name(v.type));
  if (v.array_length == kOpenArray)
    text += "[]";
  else if (v.array_length > 0)
    text += fmt::format("[{}]", v.array_length);
  return text;
}

} // namespace

void Checker::check_unit() {
  scopes_.enter();
  load_plugins();
  std::set<std::string_view> shader_names;
  for (Definition& d : unit_.definitions) {
    if (d.function) check_function(*d.function);
    if (!d.shader) continue;
    if (!shader_names.insert(d.shader->name).second)
      report(diags_, Msg::kDuplicateShader, d.shader->where, d.shader->name);
    check_shader(*d.shader);
  }
  scopes_.leave();
  if (!in_library_ && !diags_.has_true_errors()) usage_.report(diags_);
}

Variable* Checker::global_variable(Global g) {
  Variable*& slot = globals_[static_cast<size_t>(g)];
  if (!slot) {
    const slvm::GlobalInfo& info = slvm::global_info(g);
    slot = &unit_.variables.emplace_back();
    slot->kind = VariableKind::kGlobal;
    slot->name = info.name;
    slot->type = info.type;
    slot->detail = info.detail;
    slot->detail_given = true;
    slot->global = g;
  }
  return slot;
}

void Checker::report_duplicate(const FunctionDef& f) {
  for (const FunctionDef* other : scopes_.own_functions(f.name))
    if (other != &f && same_types(*other, f))
      report(diags_, Msg::kDuplicateFunction, f.where, f.name)
          .notes.push_back({other->where, "the other one"});
}

void Checker::check_function(FunctionDef& f) {
  if (!f.result_given) report(diags_, Msg::kImplicitReturn, f.where, f.name);
  bool is_row_body = in_library_ && f.shadeop != kNoShadeop;
  report_duplicate(f);
  if (!is_row_body) scopes_.declare(&f); // bodies of built-ins are called through their rows
  open_functions_.insert(&f);
  const FunctionDef* outer = std::exchange(function_, &f);
  bool outer_returned = std::exchange(returned_value_, false);
  int outer_loops = std::exchange(loops_, 0);
  auto outer_spaces = std::exchange(spaces_, {});
  usage_.enter_function();
  check_function_body(f);
  check_result(f);
  usage_.leave_function();
  spaces_ = std::move(outer_spaces);
  loops_ = outer_loops;
  returned_value_ = outer_returned;
  function_ = outer;
  open_functions_.erase(&f);
}

void Checker::check_function_body(FunctionDef& f) {
  scopes_.enter(true);
  for (Variable* v : f.formals)
    declare_formal(*v);
  if (f.body)
    for (StmtPtr& s : f.body->statements)
      check_statement(*s);
  scopes_.leave();
}

void Checker::check_result(FunctionDef& f) {
  if (f.result == Type::kVoid || returned_value_) return;
  if (f.result_given) {
    report(diags_, Msg::kNoReturn, f.where, f.name, slvm::type_name(f.result));
  } else {
    f.result = Type::kVoid; // without a type and without a return, nothing was meant to be returned
  }
}

void Checker::check_shader(Shader& shader) {
  scopes_.enter();
  spaces_.clear();
  for (Variable* v : shader.params)
    declare_parameter(*v, shader);
  scopes_.enter();
  if (shader.body)
    for (StmtPtr& s : shader.body->statements)
      check_statement(*s);
  scopes_.leave();
  scopes_.leave();
}

void Checker::declare(Variable& v) {
  if (Variable* other = scopes_.declare(v.name, &v))
    report(diags_, Msg::kDuplicateVariable, v.where, v.name).notes.push_back({other->where, "the other one"});
  usage_.declared(v);
}

void Checker::declare_parameter(Variable& v, const Shader& shader) {
  check_array_length(v);
  if (v.array_length == kOpenArray) report(diags_, Msg::kArrayLengthMissing, v.where, v.name);
  if (!v.init) {
    bool text = v.type == Type::kString;
    report(diags_, Msg::kNoDefault, v.where, v.name, shader.name, text ? "\"\"" : "0");
    if (text)
      v.init = std::make_unique<StringExpr>(v.where);
    else
      v.init = std::make_unique<NumberExpr>(v.where);
  }
  check_initialiser(v);
  declare(v);
}

void Checker::declare_formal(Variable& v) {
  check_array_length(v);
  if (v.init && !in_library_) report(diags_, Msg::kFormalDefault, v.where, v.name);
  if (in_library_) check_initialiser(v);
  declare(v);
}

void Checker::declare_local(Variable& v) {
  check_array_length(v);
  if (const auto* function = array_function(v.init.get()); function && v.array_length == kOpenArray)
    if (const uint32_t length = function->info().signature.param(0).elements)
      v.array_length = static_cast<int>(length);
  if (v.array_length == kOpenArray) report(diags_, Msg::kArrayLengthMissing, v.where, v.name);
  if (v.array_length != kNotArray && fill_array(v.init.get(), v.name)) {
    declare(v); // its call stores to it
    analyse(*v.init);
    finish(v.init, Type::kVoid);
    return;
  }
  check_initialiser(v); // before the name is known: it may mention an outer variable of this name
  declare(v);
  if (v.init) spaces_[&v] = space_of(*v.init);
}

void Checker::check_array_length(Variable& v) {
  if (v.length_expr) {
    float length = 0;
    bool fine = constant_value(*v.length_expr, length) && length >= 1 && length <= kMaxArrayLength &&
                std::floor(length) == length;
    if (!fine) report(diags_, Msg::kArrayLength, v.length_expr->range, v.name);
    v.array_length = fine ? static_cast<int>(length) : 1;
    v.length_expr.reset();
  }
  // `float a[] = {1, 2}` takes its length from the list.
  if (auto* list = as<ArrayInitExpr>(v.init.get()); list && v.array_length == kOpenArray)
    v.array_length = static_cast<int>(list->elements.size());
}

void Checker::check_initialiser(Variable& v) {
  if (!v.init) return;
  if (auto* list = as<ArrayInitExpr>(v.init.get())) return finish_array_init(*list, v);
  analyse(*v.init);
  if (auto* cast = as<CastExpr>(v.init.get()); cast && cast->has_space) v.init_space = cast->space;
  finish_as(v.init, v.type, {Purpose::kInitialiser, v.name});
}

// `extern float x`: the declaration's placeholder gives way to the variable meant.
void Checker::declare_extern(Variable*& slot) {
  Variable& wanted = *slot;
  Variable* found = scopes_.find_outside(wanted.name);
  if (!found && !scopes_.in_function()) found = scopes_.find(wanted.name);
  Global global = slvm::find_global(wanted.name);
  if (!found && global != Global::kCount) found = global_variable(global);
  check_array_length(wanted);
  if (!found) {
    if (wanted.name == "PI") return;
    report(diags_, Msg::kExternUnknown, wanted.where, wanted.name);
    declare(wanted);
    usage_.passed(wanted);
    return;
  }
  if (found->type != wanted.type ||
      (found->array_length == kNotArray) != (wanted.array_length == kNotArray)) {
    bool close = slvm::is_geometric(found->type) && slvm::is_geometric(wanted.type);
    report(diags_, close ? Msg::kExternTypeLint : Msg::kExternType, wanted.where, wanted.name,
           variable_type(*found));
  }
  slot = found;
  if (wanted.name != "PI") scopes_.declare(wanted.name, found);
}

bool constant_value(const Expr& e, float& value) {
  if (const auto* number = as<NumberExpr>(&e)) {
    value = number->value;
    return true;
  }
  const auto* op = as<OperatorExpr>(&e);
  float a = 0, b = 0;
  if (!op || !constant_value(*op->operands[0], a)) return false;
  if (op->operands.size() == 2 && !constant_value(*op->operands[1], b)) return false;
  switch (op->op) {
  case Operator::kAdd: value = a + b; return true;
  case Operator::kSub: value = a - b; return true;
  case Operator::kMul: value = a * b; return true;
  case Operator::kDiv: value = a / b; return true;
  case Operator::kNegate: value = -a; return true;
  default: return false;
  }
}

} // namespace slc
