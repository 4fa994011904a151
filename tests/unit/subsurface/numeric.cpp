#include "tests/unit/subsurface/numeric.h"

#include <cmath>

namespace subsurface::test {

double integral(const Function& f, double a, double b, int n) {
  const double h = (b - a) / n;
  double sum = f(a) + f(b);
  for (int i = 1; i < n; ++i)
    sum += f(a + i * h) * (i % 2 ? 4 : 2);
  return sum * h / 3;
}

double chi_square_uniform(const std::vector<size_t>& counts) {
  double total = 0, sum = 0;
  for (size_t c : counts)
    total += static_cast<double>(c);
  const double expected = total / static_cast<double>(counts.size());
  for (size_t c : counts)
    sum += (static_cast<double>(c) - expected) * (static_cast<double>(c) - expected) / expected;
  return sum;
}

double chi_square_limit(size_t bins) {
  const double k = static_cast<double>(bins) - 1, z = 3.0902;
  return k * std::pow(1 - 2 / (9 * k) + z * std::sqrt(2 / (9 * k)), 3);
}

} // namespace subsurface::test
