// Comparing the values of one variable, point by point.
#pragma once

#include "slvm/tools/sltest/grid_data.h"
#include "slvm/tools/sltest/test_case.h"

#include <string>
#include <vector>

namespace slvm::sltest {

/// Collects comparisons; text() describes the worst.
class Deviation {
public:
  explicit Deviation(const Tolerance& tolerance) : tolerance_(tolerance) {}

  /// Compares all numbers of a point.
  void add(size_t point, const std::vector<float>& expected, const std::vector<float>& got);
  bool ok() const { return failed_ == 0; }
  /// "expected 1 0 0, got 1 0 0.5 at (3, 1), u = 0.75, v = 0.5; worst deviation 0.5 (component 2); 4 of 16
  /// points are off (abs 1e-06, rel 1e-05)".
  std::string text(const GridData& grid) const;

private:
  Tolerance tolerance_;
  size_t compared_ = 0, failed_ = 0, worst_point_ = 0, worst_component_ = 0;
  double worst_ = -1;
  std::vector<float> worst_expected_, worst_got_;
};

/// "(3, 1), u = 0.75, v = 0.5".
std::string point_text(const GridData& grid, size_t point);
/// Numbers in as many digits as tell them apart.
std::string exact_text(const std::vector<float>& numbers);

} // namespace slvm::sltest
