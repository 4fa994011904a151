// Unused and unset variables.
#include "slc/sema/usage.h"

#include "slc/diag/messages.h"

namespace slc {

void Usage::declared(const Variable& v) {
  index_[&v] = uses_.size();
  uses_.push_back({&v, loops_, functions_, false, v.init != nullptr || v.kind != VariableKind::kLocal, {}});
}

void Usage::read(const Variable& v, SourceRange where) {
  auto it = index_.find(&v);
  if (it == index_.end()) return;
  Use& use = uses_[it->second];
  use.read = true;
  // A write further down can come first in an inner loop or before a call.
  bool ordered = loops_ == use.loops && functions_ == use.functions;
  if (!use.written && ordered && !use.read_before_set.valid()) use.read_before_set = where;
}

void Usage::written(const Variable& v) {
  auto it = index_.find(&v);
  if (it != index_.end()) uses_[it->second].written = true;
}

void Usage::passed(const Variable& v) {
  auto it = index_.find(&v);
  if (it != index_.end()) uses_[it->second].written = uses_[it->second].read = true;
}

void Usage::report(slvm::Diagnostics& diags) const {
  for (const Use& use : uses_) {
    const Variable& v = *use.variable;
    bool local = v.kind == VariableKind::kLocal;
    if (local && !use.read) {
      slc::report(diags, use.written ? Msg::kUnusedValue : Msg::kUnusedVariable, v.where, v.name);
    } else if (v.kind == VariableKind::kParameter && !use.read && !v.output && !v.name.starts_with("__")) {
      slc::report(diags, Msg::kUnusedParameter, v.where, v.name);
    } else if (local && use.read_before_set.valid()) {
      slc::report(diags, Msg::kUnsetVariable, use.read_before_set, v.name);
    }
  }
}

} // namespace slc
