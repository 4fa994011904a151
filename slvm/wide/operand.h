// How compiled code hands values to kernels: the binary interface between interpreter and kernels.
// Read next: lanes.h (typed access to operands), slvm/kernels/table.h (where kernels are found).
//
// A value is a set of float planes (structure of arrays). A varying value has one float per lane in each
// plane; a uniform value is stored as kMaxLanes equal floats in each plane, and `step` 0 makes every vector
// load of any width read those. Kernels therefore never ask whether an operand is uniform: they advance by
// step.
#pragma once

#include <cstddef>
#include <cstdint>

namespace slvm {

/// Lanes of the widest vector any target uses; counts and plane starts are multiples of it.
inline constexpr size_t kMaxLanes = 16;
/// Alignment of every plane in bytes.
inline constexpr size_t kPlaneAlign = 64;

struct Operand {
  float* data = nullptr; ///< lane 0 of plane 0
  size_t pitch = 0;      ///< floats from one plane to the next
  uint32_t step = 0;     ///< 1: one value per lane; 0: uniform, kMaxLanes equal values per plane
  uint32_t elements = 1; ///< elements of an array; element e, component c is plane e * components + c

  float* plane(size_t i) const { return data + i * pitch; }
};

class StringPool;

/// What a kernel may know beyond its operands.
struct KernelContext {
  StringPool* strings = nullptr;
  uint64_t seed = 0;        ///< of random(): differs between grids
  uint32_t first_point = 0; ///< grid index of lane 0 of this strip
  /// Lanes before this one (a multiple of kMaxLanes) need not be computed: none of them is active.
  size_t begin = 0;
};

/// `operands`: first what the call stores (the result unless the shadeop is void, then every output and inout
/// parameter in order), then what it reads (every parameter but the pure outputs, in order; all of a variadic
/// one's arguments). The stored and the read side of an inout parameter are different operands: values are in
/// SSA form. `lanes` is a multiple of kMaxLanes; kMaxLanes for a uniform call. Kernels compute all lanes,
/// active or not, and stored operands never overlap read ones partially: they are the same planes or
/// disjoint.
using Kernel = void (*)(const Operand* operands, uint32_t count, size_t lanes, const KernelContext&);

} // namespace slvm
