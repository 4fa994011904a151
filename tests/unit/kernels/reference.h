// What kernels should compute, written independently in scalar double precision, with the error each may
// have. The bounds here are those the kernels' comments state.
#pragma once

#include "slvm/format/shadeop_info.h"

#include <cmath>
#include <span>

namespace slvm::test {

/// An expected number and the magnitude its error is measured against: its own, or that of terms that cancel.
struct Expected {
  double value = 0, magnitude = 0;

  Expected() = default;
  Expected(double v) : value(v), magnitude(std::abs(v)) {}
  Expected(double v, double m) : value(v), magnitude(std::max(std::abs(v), m)) {}
};

/// Row: types. In: all components read, in operand order, bools as 0 and 1. Out: all components stored.
using Row = const Signature&;
using In = const double*;
using Out = Expected*;
using ReferenceFunction = void (*)(Row, In in, Out out);

struct Reference {
  std::string_view name;
  int planes_read; ///< -1: any
  ReferenceFunction function;
  double ulps;                     ///< greatest error in units in the last place of the magnitude; 0: exact
  double low = -10.0, high = 10.0; ///< range the arguments are drawn from
};

/// Functions of floats and truth values, and those of triples and matrices.
std::span<const Reference> scalar_references();
std::span<const Reference> triple_references();

/// The reference of a row, or nullptr: then the kernel has a test of its own, see kTestedElsewhere.
const Reference* find_reference(ShadeopId row);

/// Made from functions of SLEEF: targets with and without fused multiply-add differ in the last bits.
bool is_transcendental(std::string_view name);

} // namespace slvm::test
