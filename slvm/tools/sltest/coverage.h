// Which lines of the tested shaders ran, and which ways their conditions went.
#pragma once

#include "slvm/support/result.h"
#include "slvm/tools/sltest/mark_observer.h"

#include <map>
#include <string>
#include <vector>

namespace slvm::sltest {

/// A condition of an if, a loop or ?:.
struct BranchCoverage {
  uint32_t line = 0, column = 0;
  std::string what;         ///< "if", "for", "while" or "?:"
  uint64_t yes = 0, no = 0; ///< points for which it held, and did not
};

struct FileCoverage {
  std::string file, text;
  std::map<uint32_t, uint64_t> lines; ///< by line with a statement: points that ran it
  std::vector<BranchCoverage> branches;

  size_t lines_run() const;
  size_t ways_taken() const; ///< of the two each branch has
};

class Coverage final : public MarkObserver {
public:
  explicit Coverage(const Instrumenter& instrumenter) : instrumenter_(instrumenter) {}
  /// Source files of shaders, in order of their names. Code in test files and built-in headers is none.
  std::vector<FileCoverage> files() const;

protected:
  void marked(uint32_t number, const ExecutionStep& step, std::span<const StepOperand> values) override;

private:
  struct Count {
    uint64_t points = 0, yes = 0;
  };
  const Instrumenter& instrumenter_;
  std::vector<Count> counts_; ///< by mark
};

/// A few lines for each file.
std::string coverage_text(const std::vector<FileCoverage>& files);
/// One page for each file, and index.html.
Result<bool> write_coverage_pages(const std::string& folder, const std::vector<FileCoverage>& files);

} // namespace slvm::sltest
