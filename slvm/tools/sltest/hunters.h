// Observers that look for mistakes: where numbers that are not finite arise, and where variables are read
// that were never set.
#pragma once

#include "slvm/tools/sltest/mark_observer.h"
#include "slvm/tools/sltest/point_set.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace slvm::sltest {

/// Calls that are given finite numbers and store one that is not; and parameters and variables that are not
/// finite where they are read. What follows from such a number is not reported.
class NanHunter final : public MarkObserver {
public:
  explicit NanHunter(const Instrumenter& instrumenter) : instrumenter_(instrumenter) {}
  void after(const ExecutionStep& step) override;
  /// One text for each place, in the order in which they were met.
  std::vector<std::string> findings() const;

protected:
  void marked(uint32_t, const ExecutionStep&, std::span<const StepOperand>) override {}

private:
  struct Finding {
    std::string head, tail; ///< before and behind the points
    PointSet points;
    size_t nu = 1;
  };
  Finding& finding(const ExecutionStep& step, const std::string& what);
  /// `variable` was read, which gave `value`.
  void read(const ExecutionStep& step, std::string_view variable, const StepOperand& value);

  const Instrumenter& instrumenter_;
  std::vector<Finding> findings_;
  std::map<std::string, size_t> known_; ///< by head
};

class UninitHunter final : public MarkObserver {
public:
  explicit UninitHunter(const Instrumenter& instrumenter) : instrumenter_(instrumenter) {}
  std::vector<std::string> findings() const;

protected:
  void marked(uint32_t number, const ExecutionStep& step, std::span<const StepOperand> values) override;

private:
  const Instrumenter& instrumenter_;
  std::map<std::string, PointSet> reads_; ///< by line and variable
  std::vector<std::string> order_;
  size_t nu_ = 1;
};

} // namespace slvm::sltest
