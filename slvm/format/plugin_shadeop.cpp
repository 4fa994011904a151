// Functions of plug-ins as rows beside the table of built-ins.
#include "slvm/format/plugin_shadeop.h"

#include <algorithm>
#include <set>

namespace slvm {
namespace {

constexpr std::string_view kVaryingResult = "varying ";

bool sensible(const Signature& s) {
  bool ok = s.ok && s.token_set.empty() && s.result != Type::kBool;
  for (int i = 0; i < s.param_count; ++i) {
    const SignatureParam& p = s.param(i);
    ok &= !p.any && !p.variadic && p.input && p.type != Type::kBool && (p.array || p.elements == 0);
  }
  return ok;
}

} // namespace

std::shared_ptr<const PluginShadeop> PluginShadeop::make(PluginFunctionName name) {
  std::shared_ptr<PluginShadeop> made(new PluginShadeop(std::move(name)));
  std::string_view text = made->name_.signature;
  bool varying = text.starts_with(kVaryingResult);
  if (varying) text.remove_prefix(kVaryingResult.size());
  made->params_.resize(kMaxPluginParams);
  made->info_.name = made->name_.function;
  made->info_.signature_text = made->name_.signature;
  made->info_.kind = ShadeopKind::kPlugin;
  // Whatever it does, it does where and when the source says so.
  made->info_.flags = kEffect | (varying ? kHiddenVarying : 0u);
  made->info_.doc = "a function of a plug-in";
  made->info_.ulps = -1;
  made->info_.signature = parse_signature(text, made->params_);
  if (made->name_.function.empty() || !sensible(made->info_.signature)) return nullptr;
  return made;
}

std::shared_ptr<const PluginShadeop> PluginShadeop::storing_to(const std::vector<bool>& params) const {
  const Signature& s = info_.signature;
  PluginFunctionName changed = name_;
  const size_t open = changed.signature.find('(');
  std::string text = changed.signature.substr(0, open + 1);
  for (int i = 0; i < s.param_count; ++i) {
    const SignatureParam& p = s.param(i);
    if (i) text += ", ";
    const auto at = static_cast<size_t>(i);
    if (p.output || (at < params.size() && params[at])) text += "inout ";
    if (p.uniform) text += "uniform ";
    text += type_name(p.type);
    if (p.array) text += p.elements ? "[" + std::to_string(p.elements) + "]" : "[]";
    (text += ' ') += p.name;
  }
  changed.signature = text + ')';
  return make(std::move(changed));
}

std::optional<ShadeopId> PluginShadeops::add(std::shared_ptr<const PluginShadeop> function) {
  auto it =
      std::find_if(list_.begin(), list_.end(), [&](const auto& f) { return f->name() == function->name(); });
  const auto index = static_cast<size_t>(it - list_.begin());
  if (it == list_.end()) {
    if (list_.size() == kMost) return std::nullopt;
    list_.push_back(std::move(function));
  }
  return static_cast<ShadeopId>(kFirstPluginShadeop + index);
}

std::vector<std::string> PluginShadeops::libraries() const {
  std::set<std::string> paths;
  for (const auto& f : list_)
    paths.insert(f->name().library);
  return {paths.begin(), paths.end()};
}

bool PluginShadeops::operator==(const PluginShadeops& other) const {
  return std::equal(list_.begin(), list_.end(), other.list_.begin(), other.list_.end(),
                    [](const auto& a, const auto& b) { return a->name() == b->name(); });
}

} // namespace slvm
