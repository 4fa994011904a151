// Pictures that results are compared with: `expect.image.NAME`.
#pragma once

#include "slvm/tools/sltest/expect.h"

namespace slvm::sltest {

struct GoldenOptions {
  bool update = false;                      ///< write pictures that are missing or differ, instead of failing
  std::string failures = "sltest-failures"; ///< folder for what differs: the result and the difference
};

/// Compares as OpenImageIO's idiff does: a value fails when it is off by more than `failthresh` and by more
/// than `failrelative` times its size; so many percent of the pixels may. None may be off by `hardfail` and
/// that much. `updated`: files that were written.
std::vector<CheckFailure> check_goldens(const Case& c, const Prepared& prepared, const RunResult& result,
                                        const GoldenOptions& options, std::vector<std::string>& updated);

} // namespace slvm::sltest
