// How many values the parameters of a request hold: the sizes of the storage classes uniform, varying, vertex
// and facevarying for each primitive (RISpec 3.2, sections 5.1 to 5.6). Read by the interpreter to check
// lists and by the C interface to know how far its arrays reach.
#pragma once

#include "render/rib/request.h"
#include "render/state/declaration.h"

#include <optional>
#include <string>

namespace render {

/// Values of each storage class; constant ones are always 1.
struct ClassSizes {
  size_t uniform = 1, varying = 4, vertex = 4, facevarying = 4;

  size_t of(StorageClass) const;
};

/// Steps of the current basis (request Basis), on which sizes of cubic meshes and curves depend.
struct BasisSteps {
  int u = 3, v = 3;
};

struct SizesOfRequest {
  ClassSizes sizes;
  std::string error; ///< empty: the sizes hold
  int argument = -1; ///< which argument is wrong; -1: the request as a whole

  bool ok() const { return error.empty(); }
};

/// The sizes for a primitive, from its arguments; what its arguments' counts contradict is an error. Other
/// requests hold one value of each class. `vertices`: of Polygon and Points, where it is an argument of the C
/// call and follows from "P" in a RIB file.
SizesOfRequest class_sizes(const RequestCall& call, BasisSteps steps, std::optional<size_t> vertices = {});

} // namespace render
