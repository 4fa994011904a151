// Which variables are set and read where, in the order of the text: for the warnings about unused and unset
// ones.
#pragma once

#include "slc/ast/unit.h"
#include "slvm/support/diagnostics.h"

#include <unordered_map>

namespace slc {

class Usage {
public:
  void declared(const Variable&);
  void read(const Variable&, SourceRange where);
  void written(const Variable&);
  /// Given to a call that stores to it: that counts as use and as setting.
  void passed(const Variable&);
  void enter_loop() { ++loops_; }
  void leave_loop() { --loops_; }
  /// Reads and writes in a nested function happen when it is called: their order in the text says nothing.
  void enter_function() { ++functions_; }
  void leave_function() { --functions_; }

  void report(slvm::Diagnostics&) const;

private:
  struct Use {
    const Variable* variable = nullptr;
    int loops = 0, functions = 0; // around the declaration
    bool read = false, written = false;
    SourceRange read_before_set; // the first read with no write before it in the text, outside inner loops
  };
  std::unordered_map<const Variable*, size_t> index_;
  std::vector<Use> uses_; // in order of declaration
  int loops_ = 0, functions_ = 0;
};

} // namespace slc
