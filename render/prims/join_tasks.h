// Small neighbours are diced and shaded together: for a mesh of tiny faces what each grid costs, however few
// its points are, would be most of the work.
#pragma once

#include "render/prims/primitive_list.h"
#include "render/prims/split.h"

#include <vector>

namespace render {

/// Joins tasks that came out of splitting `primitives` in order.
void join_tasks(const PrimitiveList& primitives, std::vector<GridTask>& tasks);

} // namespace render
