// Watching requests for what sizes depend on.
#include "render/ri/size_tracker.h"

#include "render/ri/further_parameters.h"
#include "render/rib/parameters.h"
#include "render/state/interpreter.h"

#include <fmt/format.h>

namespace render::ri {

namespace {

/// Whose standard parameters a request takes: "limits" of Option "limits", else "Display".
std::string category(const RequestCall& call) {
  bool named = call.id == RequestId::kOption || call.id == RequestId::kAttribute;
  return std::string(call.info().name) + (named ? " " + call.text(0) : "");
}

std::string key(std::string_view category, std::string_view name) {
  std::string out = fmt::format("{}:{}", category, name);
  for (char& c : out) // one word
    if (c == ' ') c = '/';
  return out;
}

} // namespace

SizeTracker::SizeTracker() {
  for (const ParameterInfo& p : parameters()) {
    if (p.name == "*" || p.type == "any") continue;
    std::string category(request_info(p.request).name);
    if (p.request == RequestId::kOption || p.request == RequestId::kAttribute)
      category += " " + std::string(p.category);
    (void)standard_.declare(key(category, p.name), p.type);
  }
  for (const FurtherParameter& p : further_parameters())
    (void)standard_.declare(key(p.category, p.name), p.declaration);
}

void SizeTracker::request(const RequestCall& call) {
  using enum RequestId;
  switch (call.id) {
  case kDeclare:
    if (declarations_.declare(call.text(0), call.text(1))) own_.insert(call.text(0));
    break;
  case kBasis: steps_ = {call.integer(1), call.integer(3)}; break;
  case kFrameBegin:
  case kWorldBegin:
  case kAttributeBegin:
  case kObjectBegin: saved_.push_back(steps_); break;
  case kFrameEnd:
  case kWorldEnd:
  case kAttributeEnd:
  case kObjectEnd:
    if (saved_.empty()) break;
    steps_ = saved_.back();
    saved_.pop_back();
    break;
  default: break;
  }
}

slvm::Result<Declaration> SizeTracker::resolve(const RequestCall& call, std::string_view token) const {
  if (!is_primitive(call.id) && !own_.contains(token)) {
    const Declaration* standard = standard_.find(key(category(call), token));
    if (standard) return *standard;
  }
  auto found = declarations_.resolve(token);
  if (found || !more_) return found;
  auto more = more_->resolve(token);
  return more ? more : found;
}

} // namespace render::ri
