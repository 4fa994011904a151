// Lists of variables.
#include "render/prims/patch_vars.h"

namespace render {

namespace {

class OwnVars final : public VarSource {
public:
  size_t count() const override { return vars_.size(); }
  PatchVar make(size_t var, uint32_t) const override { return vars_[var]; }
  bool append(PatchVar& var) override {
    vars_.push_back(std::move(var));
    return true;
  }

private:
  std::vector<PatchVar> vars_;
};

} // namespace

void PatchVars::push_back(PatchVar var) {
  if (source_ && source_.use_count() == 1 && source_->append(var)) return;
  auto own = std::make_shared<OwnVars>();
  for (PatchVar v : *this)
    own->append(v);
  own->append(var);
  *this = PatchVars(std::move(own), 0);
}

} // namespace render
