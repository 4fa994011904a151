// subsurface.so: the functions of stdlib/subsurface for shaders. Programs find it without being told where
// (slvm::standard_plugin_folder()).
#include "stdlib/dso/calls.h"

namespace {

using namespace subsurface_plugin;

const RslFunction kFunctions[] = {
    {"float opencache(uniform string file)", open_cache, NULL, NULL, NULL, NULL},
    {"varying float indexcache()", next_index, NULL, NULL, NULL, NULL},
    {"point getPcache(float index)", get_position, NULL, NULL, NULL, NULL},
    {"normal getNcache(float index)", get_normal, NULL, NULL, NULL, NULL},
    {"void accumcache(float index, color light)", accumulate, NULL, NULL, NULL, NULL},
    {"void writecache(uniform string file)", write_cache, NULL, NULL, NULL, NULL},

    {"void bakepoints(uniform string file, point P, normal N, color albedo)", bake_points, NULL, NULL, NULL,
     NULL},
    {"void bakepoints(uniform string file, point P, normal N, color albedo, color irradiance)", bake_points,
     NULL, NULL, NULL, NULL},
    {"void bakemesh(uniform string file, point P, normal N)", bake_mesh, NULL, NULL, NULL, NULL},

    {"color diffusion(point P, uniform string cloud, uniform string material, uniform float mm, uniform "
     "float "
     "epsilon)",
     diffusion_of_material, NULL, NULL, NULL, NULL},
    {"color diffusion(point P, uniform string cloud, uniform color albedo, uniform color freepath, uniform "
     "float eta, uniform float epsilon)",
     diffusion_of_appearance, NULL, NULL, NULL, NULL},
    {"color diffusion(point P, uniform string cloud, uniform color freepath, uniform float eta, uniform "
     "float "
     "epsilon)",
     diffusion_of_points, NULL, NULL, NULL, NULL},
    {"color diffusion(point P, uniform string[] clouds, uniform float[] radii, uniform color albedo, uniform "
     "color freepath, uniform float eta, uniform float epsilon)",
     diffusion_of_levels, NULL, NULL, NULL, NULL},
    {"color diffusion(point P, uniform string[] clouds, uniform float[] radii, uniform color freepath, "
     "uniform float eta, uniform float epsilon)",
     diffusion_of_point_levels, NULL, NULL, NULL, NULL},

    {"void surfacecells(uniform string cloud, point P, output float nearest, output float second, output "
     "point centre)",
     surface_cells, NULL, NULL, NULL, NULL},

    {"void ScatterDSOReadMap(uniform string map)", read_map, NULL, NULL, NULL, NULL},
    {"varying float ScatterDSOAddGridPoint(point P, float width)", add_grid_point, NULL, NULL, NULL, NULL},
    {"varying float ScatterDSOGetSample(output point P, output normal N, output float area)", get_sample,
     NULL, NULL, NULL, NULL},
    {"void ScatterDSOSaveIrradiance(color irradiance)", save_irradiance, NULL, NULL, NULL, NULL},
    {"color ScatterDSOScatter(float index, point P, normal N, float width, color tint)", scatter, NULL, NULL,
     NULL, NULL},
    {NULL, NULL, NULL, NULL, NULL, NULL}};

} // namespace

RSLEXPORT RslFunctionTable RslPublicFunctions(kFunctions);
