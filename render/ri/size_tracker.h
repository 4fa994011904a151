// What the lengths of parameter lists in C depend on: declarations, and the steps of the current basis. It
// watches the requests that go by, also those that are only recorded or written to a file.
#pragma once

#include "render/prims/class_sizes.h"
#include "render/rib/request.h"
#include "render/state/declaration.h"

#include <set>
#include <vector>

namespace render::ri {

class SizeTracker {
public:
  SizeTracker();
  void request(const RequestCall& call);

  BasisSteps steps() const { return steps_; }
  /// After files were read, which are not watched.
  void set_steps(BasisSteps steps) { steps_ = steps; }
  /// Declarations to look in after the own ones; they must outlive the tracker.
  void set_more(const Declarations* more) { more_ = more; }
  /// A token in the list of this request: declared by the program, in the token, or a standard parameter of
  /// the option, attribute or request (further_parameters.h). The error names the nearest declared name.
  slvm::Result<Declaration> resolve(const RequestCall& call, std::string_view token) const;

private:
  Declarations declarations_, standard_;
  std::set<std::string, std::less<>> own_; ///< what the program declared
  const Declarations* more_ = nullptr;
  BasisSteps steps_;
  std::vector<BasisSteps> saved_; ///< by the blocks that are open
};

} // namespace render::ri
