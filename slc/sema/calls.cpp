// Calls: candidates, arguments, token-value pairs.
#include "slc/sema/checker.h"
#include "slc/sema/hints.h"

namespace slc {
namespace {

constexpr size_t kMaxCandidateNotes = 8;

bool callable(ShadeopId id, bool in_library) {
  return in_library || (slvm::shadeop(id).flags & slvm::kInternal) == 0;
}

bool has_channel(std::string_view function) {
  std::span<const ShadeopId> rows = slvm::shadeop_overloads(function);
  return !rows.empty() && slvm::shadeop(rows[0]).signature.param_count > 1 &&
         slvm::shadeop(rows[0]).signature.params[1].name == "channel";
}

/// The tokens of a set, those that end in any name with that of `token`: "surface:*" as "surface:Ci" for
/// "surfce:Ci".
std::vector<std::string> tokens_like(std::string_view set, std::string_view token) {
  const size_t colon = token.rfind(':');
  std::vector<std::string> names;
  for (const slvm::TokenInfo& t : slvm::tokens()) {
    if (t.set != set) continue;
    std::string name(t.name);
    if (name.ends_with('*')) {
      if (colon == token.npos) continue;
      name.replace(name.size() - 1, 1, token.substr(colon + 1));
    }
    names.push_back(std::move(name));
  }
  return names;
}

} // namespace

// Makes the channel of texture("name"[2], ...), texture(name[2], ...) or texture(name, ...) an argument.
void Checker::take_channel(CallExpr& call) {
  if (!scopes_.functions(call.name).empty() || !has_channel(call.name)) {
    if (call.channel) report(diags_, Msg::kMisplacedChannel, call.channel->range, call.name);
    return;
  }
  if (call.args.empty()) return;
  if (auto* index = as<IndexExpr>(call.args[0].get()); index && !call.channel) {
    Variable* v = resolve(index->name, index->range);
    if (v && v->array_length == kNotArray) {
      call.channel = std::move(index->index);
      auto name = std::make_unique<VariableExpr>(index->range);
      name->name = index->name;
      replace(call.args[0], std::move(name));
    }
  }
  if (!call.channel) call.channel = std::make_unique<NumberExpr>(call.args[0]->range);
  call.args.insert(call.args.begin() + 1, std::move(call.channel));
}

// Functions of the source come first: one that can be called hides the built-ins of its name.
std::vector<Candidate> Checker::candidates(const CallExpr& call, const std::vector<Argument>& args) {
  std::vector<Candidate> user, rows;
  bool callable_user = false;
  for (const FunctionDef* f : scopes_.functions(call.name)) {
    user.push_back({f, kNoShadeop});
    callable_user |= call_cost(user.back(), args) < kImpossible;
  }
  if (callable_user) return user;
  for (ShadeopId id : slvm::shadeop_overloads(call.name))
    if (callable(id, in_library_)) rows.push_back({nullptr, id});
  user.insert(user.end(), rows.begin(), rows.end());
  for (const auto& function : plugin_functions(call.name, user.empty()))
    user.push_back({nullptr, kNoShadeop, function});
  return user;
}

TypeSet Checker::analyse_call(CallExpr& call) {
  take_channel(call);
  bool error = false;
  Resolution resolution;
  for (ExprPtr& arg : call.args) {
    error |= analyse(*arg).is_error();
    resolution.args.push_back(argument(*arg));
  }
  std::vector<Candidate> all = candidates(call, resolution.args);
  for (const FunctionDef* f : scopes_.functions(call.name))
    if (f->broken) return TypeSet::error(); // reported at its definition
  if (all.empty()) {
    report_unknown_function(call);
    return TypeSet::error();
  }
  if (!call.fills_array && array_function(&call)) {
    report(diags_, Msg::kArrayResult, call.name_range, call.name);
    return TypeSet::error();
  }
  resolution.viable = viable(all, resolution.args);
  if (resolution.viable.empty()) {
    if (!error) report_no_candidate(call, all, resolution.args);
    return TypeSet::error();
  }
  if (error) return TypeSet::error();
  TypeSet types;
  for (const Viable& v : resolution.viable)
    types.add(v.candidate.result());
  resolutions_[&call] = std::move(resolution);
  return types;
}

void Checker::report_unknown_function(const CallExpr& call) {
  if (std::string_view advice = function_hint(call.name); !advice.empty()) {
    report(diags_, Msg::kUnknownFunctionHint, call.name_range, call.name, advice);
    return;
  }
  if (!plugin_trouble_[call.name].empty()) { // it may be in one that cannot be used
    slvm::Diagnostic& d = report(diags_, Msg::kUnknownFunction, call.name_range, call.name);
    for (const std::string& trouble : plugin_trouble_[call.name])
      d.notes.push_back({{}, trouble});
    return;
  }
  if (unit_.misdeclared.contains(call.name)) return; // reported
  for (const FunctionDef& f : unit_.functions)
    if (f.name == call.name) {
      report(diags_, Msg::kFunctionTooLate, call.name_range, call.name)
          .notes.push_back({f.where, "it is defined here"});
      return;
    }
  if (const Variable* v = scopes_.find(call.name)) {
    report(diags_, Msg::kNotAFunction, call.name_range, call.name)
        .notes.push_back({v->where, "declared here"});
    return;
  }
  if (std::string_view header = header_defining(call.name); !header.empty() && !in_library_) {
    report(diags_, Msg::kUnknownFunctionHint, call.name_range, call.name,
           fmt::format("#include \"{}\" brings it", header));
    return;
  }
  std::vector<std::string_view> names = scopes_.visible_functions();
  for (const slvm::ShadeopInfo& info : slvm::shadeops())
    if ((info.flags & slvm::kInternal) == 0) names.push_back(info.name);
  for (Type t : {Type::kFloat, Type::kColor, Type::kPoint, Type::kVector, Type::kNormal, Type::kMatrix})
    names.push_back(slvm::type_name(t)); // casts look like calls
  std::string_view near = slvm::nearest_name(call.name, names);
  if (near.empty())
    report(diags_, Msg::kUnknownFunction, call.name_range, call.name);
  else
    report(diags_, Msg::kUnknownFunctionNear, call.name_range, call.name, near)
        .fixits.push_back({call.name_range, std::string(near)});
}

void Checker::report_no_candidate(const CallExpr& call, const std::vector<Candidate>& all,
                                  const std::vector<Argument>& args) {
  std::vector<const Candidate*> fitting; // in the number of arguments
  for (const Candidate& c : all)
    if (c.takes_count(args.size())) fitting.push_back(&c);
  // What the source does not show is not counted: the channel of texture functions.
  std::vector<Argument> shown = args;
  if (shown.size() > 1 && scopes_.functions(call.name).empty() && has_channel(call.name))
    shown.erase(shown.begin() + 1);
  if (call.fills_array) shown.erase(shown.begin());
  slvm::Diagnostic& d =
      fitting.empty()
          ? report(diags_, Msg::kWrongArity, call.name_range, call.name, counted(shown.size(), "argument"))
          : report(diags_, Msg::kNoCandidate, call.name_range, call.name, types_text(shown));
  for (size_t i = 0; i < all.size() && i < kMaxCandidateNotes; ++i)
    d.notes.push_back({{}, fmt::format("candidate: {}", all[i].text())});
  if (all.size() > kMaxCandidateNotes)
    d.notes.push_back({{}, fmt::format("and {} more", all.size() - kMaxCandidateNotes)});
  if (fitting.size() != 1) return;
  for (size_t i = 0; i < fitting[0]->positional(args.size()); ++i) {
    Param p = fitting[0]->param(i);
    if (argument_cost(p, args[i]) < kImpossible) continue;
    d.notes.push_back(
        {call.args[i]->range, fmt::format("'{}' is a {}{}, this is a {}", p.name, slvm::type_name(p.type),
                                          p.array_length == kNotArray ? "" : "[]", types_text({args[i]}))});
    return;
  }
}

void Checker::finish_call(ExprPtr& e, Type wanted) {
  auto& call = *as<CallExpr>(e.get());
  const Resolution& r = resolutions_.at(&call);
  std::vector<size_t> tied;
  size_t best = choose(r.viable, r.args, wanted, &tied);
  Candidate chosen = r.viable[best].candidate;
  // Equally good ones: an error among functions of the source, a warning where only the result's type was
  // open.
  bool open_result = false, open_function = false;
  for (size_t i : tied) {
    open_function |= chosen.function != nullptr;
    open_result |= r.viable[i].candidate.result() != chosen.result();
  }
  if (open_function) {
    slvm::Diagnostic& d = report(diags_, Msg::kAmbiguousCall, call.name_range, call.name);
    d.notes.push_back({chosen.function->where, fmt::format("candidate: {}", chosen.text())});
    for (size_t i : tied)
      d.notes.push_back({r.viable[i].candidate.function->where,
                         fmt::format("candidate: {}", r.viable[i].candidate.text())});
  }
  if (!chosen.function && open_result && wanted == Type::kVoid && set_of(call).has(Type::kFloat)) {
    for (size_t i : tied)
      if (r.viable[i].candidate.result() == Type::kFloat) chosen = r.viable[i].candidate;
    report(diags_, Msg::kAmbiguousResult, call.name_range, call.name);
  }
  if (chosen.plugin) {
    let_store(chosen, call);
    if (!called_plugins_.add(chosen.plugin))
      report(diags_, Msg::kTooManyPlugins, call.name_range, slvm::PluginShadeops::kMost);
  }
  call.function = chosen.function;
  call.shadeop = chosen.row;
  call.plugin = chosen.plugin;
  call.type = chosen.result();
  if (chosen.function && open_functions_.contains(chosen.function))
    report(diags_, Msg::kRecursion, call.range, call.name);
  size_t positional = chosen.positional(call.args.size());
  for (size_t i = 0; i < positional; ++i)
    finish_argument(call, i, chosen.param(i));
  finish_tokens(call, chosen);
  check_call_rules(call);
  use_library_body(call);
  fold_left(e);
}

void Checker::finish_argument(CallExpr& call, size_t i, const Param& p) {
  ExprPtr& arg = call.args[i];
  if (p.output) return finish_output(arg, p, call.name);
  if (p.array_length != kNotArray) return finish(arg, p.any ? Type::kVoid : p.type);
  if (!p.any) return finish_as(arg, p.type, {Purpose::kArgument, call.name});
  finish(arg, wanted_by_pattern(call, i));
  if (arg->type == Type::kBool) convert(arg, Type::kFloat, {Purpose::kArgument, call.name});
  if (arg->type == Type::kVoid && !set_of(*arg).is_error()) report(diags_, Msg::kVoidValue, arg->range);
}

// An argument that is stored to.
void Checker::finish_output(ExprPtr& arg, const Param& p, std::string_view callee) {
  if (set_of(*arg).is_error()) return finish(arg, p.type);
  Variable* v = nullptr;
  if (auto* name = as<VariableExpr>(arg.get())) v = name->variable;
  if (auto* element = as<IndexExpr>(arg.get())) v = element->variable;
  if (!v) {
    report(diags_, Msg::kOutputNotPlace, arg->range, p.name, callee);
    return finish(arg, p.type);
  }
  finish_place(arg);
  if (check_writable(*v, arg->range)) usage_.passed(*v);
  spaces_.erase(v);
}

void Checker::finish_tokens(CallExpr& call, const Candidate& chosen) {
  size_t positional = chosen.positional(call.args.size());
  for (size_t i = positional; i + 1 < call.args.size(); i += 2)
    finish_token(std::move(call.args[i]), std::move(call.args[i + 1]), chosen.token_set(), call.name,
                 call.tokens);
  call.args.resize(positional);
}

void Checker::finish_token(ExprPtr token, ExprPtr value, std::string_view set, std::string_view callee,
                           std::vector<TokenArg>& out) {
  finish(token, Type::kString);
  TokenArg pair;
  const auto* constant = as<StringExpr>(token.get());
  if (constant) {
    pair.info = slvm::find_token(set, constant->value);
    if (!pair.info) {
      const std::vector<std::string> known = tokens_like(set, constant->value);
      const std::vector<std::string_view> names(known.begin(), known.end());
      std::string_view near = slvm::nearest_name(constant->value, names);
      if (std::string_view advice = token_hint(set, constant->value); !advice.empty())
        report(diags_, Msg::kUnknownTokenHint, token->range, callee, constant->value, advice);
      else if (near.empty())
        report(diags_, Msg::kUnknownToken, token->range, callee, constant->value);
      else
        report(diags_, Msg::kUnknownTokenNear, token->range, callee, constant->value, near);
    }
  }
  if (pair.info && pair.info->output) {
    Param place{.type = pair.info->type, .any = pair.info->any, .output = true, .name = pair.info->name};
    bool fits = pair.info->any || conversion_cost(set_of(*value), pair.info->type) <= 1;
    finish_output(value, place, callee);
    if (!fits && !set_of(*value).is_error())
      report(diags_, Msg::kTokenType, value->range, constant->value, slvm::type_name(pair.info->type),
             slvm::type_name(value->type));
  } else if (pair.info && !pair.info->any) {
    finish_as(value, pair.info->type, {Purpose::kArgument, callee});
  } else {
    finish(value, Type::kVoid);
  }
  if (constant && !pair.info) {
    retired_.push_back(std::move(token));
    retired_.push_back(std::move(value));
    return;
  }
  pair.token = std::move(token);
  pair.value = std::move(value);
  out.push_back(std::move(pair));
}

// A row with an RSL body: call that, with the token-value pairs in its surplus formals.
void Checker::use_library_body(CallExpr& call) {
  if (call.plugin || call.shadeop == kNoShadeop || call.info().kind != slvm::ShadeopKind::kRsl) return;
  call.function = library_.body(call.shadeop);
  if (!call.function) {
    report(diags_, Msg::kNoBody, call.range, call.name);
    return;
  }
  const std::vector<Variable*>& formals = call.function->formals;
  for (size_t i = call.args.size(); i < formals.size(); ++i) {
    ExprPtr value;
    for (TokenArg& t : call.tokens)
      if (const auto* token = as<StringExpr>(t.token.get()); token && token->value == formals[i]->name)
        value = std::exchange(t.value, nullptr);
    if (!value) value = copy_constant(*formals[i]->init, call.range);
    call.args.push_back(std::move(value));
  }
  for (TokenArg& t : call.tokens) {
    retired_.push_back(std::move(t.token));
    retired_.push_back(std::move(t.value));
  }
  call.tokens.clear();
}

// min(a, b, c) becomes min(min(a, b), c).
void Checker::fold_left(ExprPtr& e) {
  auto& call = *as<CallExpr>(e.get());
  if (call.function || (call.info().flags & slvm::kFoldLeft) == 0) return;
  while (call.args.size() > 2) {
    auto inner = std::make_unique<CallExpr>(call.range);
    inner->name = call.name;
    inner->name_range = call.name_range;
    inner->shadeop = call.shadeop;
    inner->type = call.type;
    inner->args.push_back(std::move(call.args[0]));
    inner->args.push_back(std::move(call.args[1]));
    call.args.erase(call.args.begin());
    call.args[0] = std::move(inner);
  }
}

} // namespace slc
