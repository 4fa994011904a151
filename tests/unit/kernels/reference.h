// What kernels should compute, written independently in scalar double precision. The error each may have
// stands in the table (ShadeopInfo::ulps).
#pragma once

#include "slvm/format/shadeop_info.h"
#include "slvm/support/string_pool.h"

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

/// What a reference may ask of the call beside its numbers.
struct CallFacts : Signature {
  const StringPool* strings; ///< strings are given by their number in it
  size_t planes;             ///< how many numbers there are
};

/// Row: types. In: all components read, in operand order, bools as 0 and 1. Out: all components stored.
using Row = const CallFacts&;
using In = const double*;
using Out = Expected*;
using ReferenceFunction = void (*)(Row, In in, Out out);

struct Reference {
  std::string_view name;
  int planes_read; ///< -1: any
  ReferenceFunction function;
  double low = -10.0, high = 10.0; ///< range the arguments are drawn from
};

/// Functions of floats and truth values; those of triples and matrices; noise, splines and colour spaces.
std::span<const Reference> scalar_references();
std::span<const Reference> triple_references();
std::span<const Reference> pattern_references();

/// The reference of a row, or nullptr: then the kernel has a test of its own, see kTestedElsewhere.
const Reference* find_reference(ShadeopId row);

/// Made from functions of SLEEF: targets with and without fused multiply-add differ in the last bits.
bool is_transcendental(std::string_view name);

} // namespace slvm::test
