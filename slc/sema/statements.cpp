// Statements.
#include "slc/sema/checker.h"

namespace slc {

void Checker::check_statement(Stmt& s) {
  switch (s.kind) {
  case StmtKind::kEmpty: return;
  case StmtKind::kBlock: return check_block(*as<BlockStmt>(&s));
  case StmtKind::kDeclaration: {
    auto& declaration = *as<DeclarationStmt>(&s);
    for (Variable*& v : declaration.variables) {
      if (declaration.is_extern)
        declare_extern(v);
      else
        declare_local(*v);
    }
    return;
  }
  case StmtKind::kFunction: return check_function(*as<FunctionStmt>(&s)->function);
  case StmtKind::kExpression:
    for (ExprPtr& e : as<ExpressionStmt>(&s)->expressions) {
      bool error = analyse(*e).is_error();
      if (!error && e->kind != ExprKind::kAssign && e->kind != ExprKind::kCall && e->kind != ExprKind::kCast)
        report(diags_, Msg::kNoEffect, e->range);
      // Whatever an overloaded call would return is thrown away.
      finish(e, set_of(*e).preferred());
    }
    return;
  case StmtKind::kIf: {
    auto& branch = *as<IfStmt>(&s);
    check_condition(branch.condition);
    check_scoped(branch.then_branch);
    check_scoped(branch.else_branch);
    return;
  }
  case StmtKind::kLoop: return check_loop(*as<LoopStmt>(&s));
  case StmtKind::kJump: return check_jump(*as<JumpStmt>(&s));
  case StmtKind::kReturn: return check_return(*as<ReturnStmt>(&s));
  case StmtKind::kIlluminance: return check_illuminance(*as<IlluminanceStmt>(&s));
  case StmtKind::kEmission: return check_emission(*as<EmissionStmt>(&s));
  case StmtKind::kGather: return check_gather(*as<GatherStmt>(&s));
  }
}

void Checker::check_block(BlockStmt& block) {
  scopes_.enter();
  for (StmtPtr& s : block.statements)
    check_statement(*s);
  scopes_.leave();
}

// A branch or body: a scope of its own. What a variable's space is afterwards depends on whether it ran.
void Checker::check_scoped(StmtPtr& s) {
  if (!s) return;
  scopes_.enter();
  check_statement(*s);
  scopes_.leave();
  spaces_.clear();
}

void Checker::check_loop_body(StmtPtr& body) {
  ++loops_;
  usage_.enter_loop();
  check_scoped(body);
  usage_.leave_loop();
  --loops_;
}

void Checker::check_loop(LoopStmt& loop) {
  scopes_.enter();
  if (loop.init) check_statement(*loop.init);
  if (loop.condition) check_condition(loop.condition);
  check_loop_body(loop.body);
  for (ExprPtr& step : loop.steps) {
    analyse(*step);
    if (step->kind != ExprKind::kAssign && step->kind != ExprKind::kCall)
      report(diags_, Msg::kNoEffect, step->range);
    finish(step, set_of(*step).preferred());
  }
  scopes_.leave();
}

void Checker::check_jump(JumpStmt& jump) {
  std::string_view word = jump.is_break ? "break" : "continue";
  if (loops_ == 0)
    report(diags_, Msg::kJumpOutsideLoop, jump.range, word);
  else if (jump.levels > loops_)
    report(diags_, Msg::kJumpTooFar, jump.range, word, jump.levels,
           counted(static_cast<size_t>(loops_), "loop"));
}

void Checker::check_return(ReturnStmt& s) {
  if (s.value) analyse(*s.value);
  if (!function_) {
    if (!s.value) return;
    report(diags_, Msg::kReturnInShader, s.range);
    return finish(s.value, Type::kVoid);
  }
  if (!s.value) {
    if (function_->result != Type::kVoid && function_->result_given)
      report(diags_, Msg::kReturnWithoutValue, s.range, function_->name, slvm::type_name(function_->result));
    return;
  }
  returned_value_ = true;
  if (function_->result == Type::kVoid) {
    report(diags_, Msg::kReturnFromVoid, s.value->range, function_->name);
    return finish(s.value, Type::kVoid);
  }
  finish_as(s.value, function_->result, {Purpose::kReturn, function_->name});
}

// [category,] position [, axis, angle] [, tokens]
void Checker::check_illuminance(IlluminanceStmt& s) {
  for (ExprPtr& e : s.args)
    analyse(*e);
  size_t first = !s.args.empty() && set_of(*s.args[0]).only(Type::kString) ? 1 : 0;
  size_t positional = first + 1;
  if (positional < s.args.size() && !set_of(*s.args[positional]).only(Type::kString)) positional += 2;
  if (s.broken) {
    // reported by the parser
  } else if (positional > s.args.size()) {
    report(diags_, Msg::kIlluminanceArguments, s.range);
  } else {
    if (first == 1) {
      finish_as(s.args[0], Type::kString, {Purpose::kArgument, "illuminance"});
      s.category = std::move(s.args[0]);
    }
    finish_as(s.args[first], Type::kPoint, {Purpose::kArgument, "illuminance"});
    s.position = std::move(s.args[first]);
    if (positional == first + 3) check_axis_and_angle(s.args, first + 1, s.axis, s.angle);
    split_tokens(s.args, positional, "illuminance", "illuminance", s.tokens);
    for (const TokenArg& t : s.tokens)
      if (!t.info) report(diags_, Msg::kTokenConstant, t.token->range, "illuminance");
  }
  s.args.clear();
  ++light_loops_;
  check_loop_body(s.body);
  --light_loops_;
}

void Checker::check_axis_and_angle(std::vector<ExprPtr>& args, size_t first, ExprPtr& axis, ExprPtr& angle) {
  finish_as(args[first], Type::kVector, {Purpose::kArgument, "axis"});
  finish_as(args[first + 1], Type::kFloat, {Purpose::kArgument, "angle"});
  axis = std::move(args[first]);
  angle = std::move(args[first + 1]);
}

// illuminate(position [, axis, angle]), solar([axis, angle])
void Checker::check_emission(EmissionStmt& s) {
  for (ExprPtr& e : s.args)
    analyse(*e);
  size_t first = s.is_solar ? 0 : 1;
  if (s.broken) {
    // reported by the parser
  } else if (s.args.size() != first && s.args.size() != first + 2) {
    if (s.is_solar)
      report(diags_, Msg::kSolarArguments, s.range);
    else
      report(diags_, Msg::kIlluminateArguments, s.range);
  } else {
    if (!s.is_solar) {
      finish_as(s.args[0], Type::kPoint, {Purpose::kArgument, "illuminate"});
      s.position = std::move(s.args[0]);
    }
    if (s.args.size() == first + 2) check_axis_and_angle(s.args, first, s.axis, s.angle);
  }
  s.args.clear();
  ++light_loops_;
  check_scoped(s.body);
  --light_loops_;
}

// gather(category, position, direction, angle, samples [, tokens]), traverse(category, position, direction [,
// tokens])
void Checker::check_gather(GatherStmt& s) {
  std::string_view name = s.is_traverse ? "traverse" : "gather";
  for (ExprPtr& e : s.args)
    analyse(*e);
  size_t positional = s.is_traverse ? 3 : 5;
  if (s.broken) {
    // reported by the parser
  } else if (s.args.size() < positional) {
    report(diags_, s.is_traverse ? Msg::kTraverseArguments : Msg::kGatherArguments, s.range);
  } else {
    auto take = [&](size_t i, Type type) {
      finish_as(s.args[i], type, {Purpose::kArgument, name});
      return std::move(s.args[i]);
    };
    s.category = take(0, Type::kString);
    s.position = take(1, Type::kPoint);
    s.direction = take(2, Type::kVector);
    if (!s.is_traverse) {
      s.angle = take(3, Type::kFloat);
      s.samples = take(4, Type::kFloat);
    }
    split_tokens(s.args, positional, name, name, s.tokens);
  }
  s.args.clear();
  check_loop_body(s.body);
  check_loop_body(s.else_body);
}

void Checker::split_tokens(std::vector<ExprPtr>& args, size_t positional, std::string_view set,
                           std::string_view statement, std::vector<TokenArg>& tokens) {
  for (size_t i = positional; i < args.size(); i += 2) {
    if (!set_of(*args[i]).only(Type::kString) && !set_of(*args[i]).is_error()) {
      report(diags_, Msg::kTokenExpected, args[i]->range, statement);
      return;
    }
    if (i + 1 == args.size()) {
      report(diags_, Msg::kTokenWithoutValue, args[i]->range, statement);
      return;
    }
    finish_token(std::move(args[i]), std::move(args[i + 1]), set, statement, tokens);
  }
}

void Checker::check_condition(ExprPtr& e) {
  analyse(*e);
  finish_condition(e);
}

void Checker::finish_condition(ExprPtr& e) {
  TypeSet types = set_of(*e);
  if (types.is_error()) return finish(e, Type::kBool);
  if (e->kind == ExprKind::kAssign && types.only(Type::kFloat)) {
    SourceRange equals = as<AssignExpr>(e.get())->op_range;
    report(diags_, Msg::kAssignedCondition, e->range).fixits.push_back({equals, "=="});
    finish(e, Type::kFloat);
    return insert_conversion(e, Type::kBool);
  }
  if (e->array_length != kNotArray || conversion_cost(types, Type::kBool) >= kImpossible) {
    report(diags_, Msg::kBadCondition, e->range, slvm::type_name(types.preferred()));
    return finish(e, Type::kVoid);
  }
  finish_as(e, Type::kBool, {Purpose::kOperand, ""});
}

} // namespace slc
