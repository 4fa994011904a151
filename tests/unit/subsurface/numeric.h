// Numeric tools of the subsurface tests.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace subsurface::test {

using Function = std::function<double(double)>;

/// Simpson's rule with n (even) pieces.
double integral(const Function& f, double a, double b, int n = 4000);

/// Chi-square of counts against equal expectations, and the value that it exceeds with probability 0.001
/// (Wilson and Hilferty's approximation).
double chi_square_uniform(const std::vector<size_t>& counts);
double chi_square_limit(size_t bins);

} // namespace subsurface::test
