// The surfaces of one request that share its data: each Primitive points to a small piece of the mesh, which
// the mesh keeps side by side, and to its place among the variables.
#pragma once

#include "render/prims/primitive.h"

namespace render {

/// Appends a primitive for each element of mesh->patches(), a span of some kind of Geometry.
template <class Mesh>
std::span<Primitive> add_pieces(const std::shared_ptr<Mesh>& mesh,
                                const std::shared_ptr<const PrimitiveState>& state,
                                std::vector<Primitive>& out) {
  size_t before = out.size(), count = mesh->patches().size();
  out.resize(before + count);
  std::span<Primitive> made = std::span(out).subspan(before);
  for (size_t i = 0; i < count; ++i) {
    made[i].state = state;
    made[i].geometry = std::shared_ptr<const Geometry>(mesh, &mesh->patches()[i]);
    if (mesh->count() > 0) made[i].vars = PatchVars(mesh, static_cast<uint32_t>(i));
  }
  return made;
}

} // namespace render
