// The functions that shaders call, family by family; the table of plugin.cpp gives their prototypes, and
// docs/subsurface.md tells what they do. All positions are in world space.
#pragma once

#include "RslPlugin.h"

namespace subsurface_plugin {

#define ANEMONE_CALL(name) int name(RslContext* context, int argc, const RslArg* argv[])

// point_cache_calls.cpp: lighting the points of a cloud (the course's 4.4).
ANEMONE_CALL(open_cache);
ANEMONE_CALL(next_index);
ANEMONE_CALL(get_position);
ANEMONE_CALL(get_normal);
ANEMONE_CALL(accumulate);
ANEMONE_CALL(write_cache);

// bake_calls.cpp: clouds and meshes of grids.
ANEMONE_CALL(bake_points);
ANEMONE_CALL(bake_mesh);

// diffusion_calls.cpp: lookups in lit clouds.
ANEMONE_CALL(diffusion_of_material);
ANEMONE_CALL(diffusion_of_appearance);
ANEMONE_CALL(diffusion_of_points);
ANEMONE_CALL(diffusion_of_levels);
ANEMONE_CALL(diffusion_of_point_levels);

// surface_cells.cpp: the points nearest to a place (the course's 5.5).
ANEMONE_CALL(surface_cells);

// scatter_calls.cpp: scatter maps (the course's chapter 5).
ANEMONE_CALL(read_map);
ANEMONE_CALL(add_grid_point);
ANEMONE_CALL(get_sample);
ANEMONE_CALL(save_irradiance);
ANEMONE_CALL(scatter);

#undef ANEMONE_CALL

} // namespace subsurface_plugin
