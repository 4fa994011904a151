// Functions of plug-ins: where they come from, and which arguments they may store to.
#include "slc/sema/checker.h"

namespace slc {

// `plugin "name";` makes all functions of the library known.
void Checker::load_plugins() {
  for (const PluginStatement& statement : unit_.plugins) {
    std::vector<std::string> trouble;
    slvm::PluginSource::Functions functions;
    bool usable = plugins_ && plugins_->load(statement.name, functions, trouble);
    if (!usable) {
      slvm::Diagnostic& d = report(diags_, Msg::kNoPlugin, statement.where, statement.name);
      if (!plugins_) d.notes.push_back({{}, "this program uses no plug-ins"});
      for (std::string& text : trouble)
        d.notes.push_back({{}, std::move(text)});
      continue;
    }
    loaded_plugins_.push_back(statement.name);
    for (auto& function : functions)
      plugin_functions_[function->name().function].push_back(std::move(function));
  }
}

const slvm::PluginSource::Functions& Checker::plugin_functions(const std::string& name, bool search) {
  slvm::PluginSource::Functions& known = plugin_functions_[name];
  if (!in_library_ && !loaded_plugins_.empty() && asked_loaded_.insert(name).second)
    for (const std::string& library : loaded_plugins_)
      for (auto& function : plugins_->find_in(library, name, plugin_trouble_[name]))
        known.push_back(std::move(function));
  if (search && known.empty() && plugins_ && !in_library_ && searched_.insert(name).second)
    known = plugins_->find(name, plugin_trouble_[name]);
  return known;
}

const slvm::PluginShadeop* Checker::array_function(const Expr* e) {
  const auto* call = e ? as<CallExpr>(e) : nullptr;
  if (!call || !scopes_.functions(call->name).empty() || !slvm::shadeop_overloads(call->name).empty())
    return nullptr;
  const auto& known = plugin_functions(call->name, true);
  return !known.empty() && known[0]->name().form == slvm::PluginForm::kGridArray ? known[0].get() : nullptr;
}

bool Checker::fill_array(Expr* value, const std::string& name) {
  if (!array_function(value)) return false;
  auto& call = *as<CallExpr>(value);
  auto target = std::make_unique<VariableExpr>(call.name_range);
  target->name = name;
  call.args.insert(call.args.begin(), std::move(target));
  call.fills_array = true;
  return true;
}

// A function that is called by point gets the addresses of its arguments. Unless its prototype says which it
// stores to, those that are variables of just the parameter's type are taken to be stored to. So are those of
// a function called by grid that gives nothing back otherwise: some renderers knew no `output` there.
void Checker::let_store(Candidate& chosen, const CallExpr& call) {
  const bool by_grid = chosen.plugin->name().form == slvm::PluginForm::kGrid;
  if (chosen.plugin->name().form != slvm::PluginForm::kPointwise &&
      !(by_grid && chosen.result() == Type::kVoid))
    return;
  std::vector<bool> stores(call.args.size());
  bool any = false;
  for (size_t i = 0; i < call.args.size(); ++i) {
    const Param p = chosen.param(i);
    if (p.output) return;
    const auto* name = as<VariableExpr>(call.args[i].get());
    const Variable* v = name ? name->variable : nullptr;
    if (!v || v->type != p.type || (v->array_length == kNotArray) != (p.array_length == kNotArray)) continue;
    const bool own = v->kind == VariableKind::kLocal || (v->output && v->kind != VariableKind::kGlobal);
    stores[i] = own && v->type != Type::kString;
    any |= stores[i];
  }
  if (any) chosen.plugin = chosen.plugin->storing_to(stores);
}

} // namespace slc
