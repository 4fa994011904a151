#include "slvm/tools/sltest/deviation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slvm::sltest {

std::string exact_text(const std::vector<float>& numbers) {
  return numbers_text(numbers, 8);
}

std::string point_text(const GridData& grid, size_t point) {
  const size_t nu = static_cast<size_t>(grid.nu);
  std::string text = fmt::format("({}, {})", point % nu, point / nu);
  const Variable *u = grid.find("u"), *v = grid.find("v");
  if (u && v) text += fmt::format(", u = {:.6g}, v = {:.6g}", u->get(0, point), v->get(0, point));
  return text;
}

void Deviation::add(size_t point, const std::vector<float>& expected, const std::vector<float>& got) {
  ++compared_;
  bool off = false;
  for (size_t k = 0; k < expected.size(); ++k) {
    const double e = expected[k], g = k < got.size() ? got[k] : std::numeric_limits<double>::quiet_NaN();
    if (e == g || (std::isnan(e) && std::isnan(g))) continue;
    double deviation = std::abs(e - g);
    if (std::isnan(deviation)) deviation = std::numeric_limits<double>::infinity();
    if (deviation <= std::max(tolerance_.abs, tolerance_.rel * std::abs(e)) && std::isfinite(e)) continue;
    off = true;
    if (deviation <= worst_) continue;
    worst_ = deviation;
    worst_point_ = point;
    worst_component_ = k;
    worst_expected_ = expected;
    worst_got_ = got;
  }
  failed_ += off;
}

std::string Deviation::text(const GridData& grid) const {
  std::string text =
      fmt::format("expected {}, got {} at {}; worst deviation {:.3g}", exact_text(worst_expected_),
                  exact_text(worst_got_), point_text(grid, worst_point_), worst_);
  if (worst_expected_.size() > 1) text += fmt::format(" (component {})", worst_component_);
  return text + fmt::format("; {} of {} points off (abs {:g}, rel {:g})", failed_, compared_, tolerance_.abs,
                            tolerance_.rel);
}

} // namespace slvm::sltest
