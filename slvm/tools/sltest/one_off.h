// The one-off form: run one shader, or --expr, and print or store what it computes.
#pragma once

#include "slvm/tools/sltest/library.h"
#include "slvm/tools/sltest/options.h"

namespace slvm::sltest {

struct Outcome {
  int status = kOk;
  std::string out, err;
};
Outcome run_one_off(const Options& options, ShaderLibrary& library);

} // namespace slvm::sltest
