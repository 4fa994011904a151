// ScatterDSOReadMap, ScatterDSOAddGridPoint, ScatterDSOGetSample, ScatterDSOSaveIrradiance,
// ScatterDSOScatter: scattering by scatter maps, whose samples are lit when they are first needed (E. Tomson,
// the course's 5.3).
#include "stdlib/dso/calls.h"
#include "stdlib/dso/plugin_data.h"
#include "stdlib/dso/scatter_images.h"
#include "stdlib/subsurface/scatter_cache.h"

#include <mutex>

namespace subsurface_plugin {
namespace {

/// Of the run: the maps, and what light their samples have got.
struct RunMaps {
  static constexpr const char* kName = "anemone.subsurface.maps";
  void end(RixContext&) {}
  subsurface::ScatterMaps maps{read_scatter_map, stamps_of_scatter_map};
};

/// A frame begins without light, and with the files as they are; its options say how much memory there is.
struct FrameMaps {
  static constexpr const char* kName = "anemone.subsurface.frame_maps";
  void end(RixContext& context) {
    if (const std::string problem = maps ? maps->pool().problem() : ""; !problem.empty())
      complain(context, problem);
  }
  std::once_flag begun;
  subsurface::ScatterMaps* maps = nullptr;
};

subsurface::ScatterMaps& maps_of_frame(const RslContext& context) {
  auto& frame = of_frame<FrameMaps>(context);
  std::call_once(frame.begun, [&] {
    frame.maps = &of_run<RunMaps>(context).maps;
    frame.maps->forget_light();
    frame.maps->pool().set_limit(octree_memory(subsurface::ScatterMaps::kUsualBytes));
  });
  return *frame.maps;
}

/// Of a grid. Made by the first ScatterDSOReadMap().
struct GridScatter {
  static constexpr const char* kName = "anemone.subsurface.scatter";
  void end(RixContext&) {}
  std::unique_ptr<subsurface::ScatterGrid> grid;
};

subsurface::ScatterGrid* begun(const RslContext& context, const char* function) {
  subsurface::ScatterGrid* grid = of_grid<GridScatter>(context).grid.get();
  if (!grid)
    complain(context, std::string(function) + " is called without a map: call ScatterDSOReadMap() first");
  return grid;
}

} // namespace

int read_map(RslContext* context, int, const RslArg* argv[]) {
  RslStringIter name(argv[1]);
  auto& grid = of_grid<GridScatter>(*context).grid;
  if (!grid) grid = std::make_unique<subsurface::ScatterGrid>(maps_of_frame(*context));
  if (auto read = grid->read_map(*name); !read) complain(*context, read.error());
  return 0;
}

int add_grid_point(RslContext* context, int argc, const RslArg* argv[]) {
  RslFloatIter result(argv[0]), width(argv[2]);
  RslPointIter P(argv[1]);
  auto* grid = begun(*context, "ScatterDSOAddGridPoint()");
  for (unsigned int i = 0; i < RslArg::NumValues(argc, argv); ++i, ++result, ++P, ++width)
    *result = grid ? static_cast<float>(grid->add_grid_point(vec3(*P), *width)) : 0.0f;
  return 0;
}

int get_sample(RslContext* context, int argc, const RslArg* argv[]) {
  RslFloatIter result(argv[0]), area(argv[3]);
  RslPointIter P(argv[1]);
  RslNormalIter N(argv[2]);
  auto* grid = begun(*context, "ScatterDSOGetSample()");
  for (unsigned int i = 0; i < RslArg::NumValues(argc, argv); ++i, ++result, ++P, ++N, ++area) {
    subsurface::Vec3 p, n;
    float a = 0;
    const bool got = grid && grid->get_sample(p, n, a);
    *result = got;
    if (!got) continue;
    store(p, *P);
    store(n, *N);
    *area = a;
  }
  return 0;
}

int save_irradiance(RslContext* context, int, const RslArg* argv[]) {
  RslColorIter irradiance(argv[1]);
  auto* grid = begun(*context, "ScatterDSOSaveIrradiance()");
  // The same light for all samples comes once.
  const size_t count = !grid ? 0 : argv[1]->IsVarying() ? argv[1]->NumValues() : grid->in_flight();
  for (size_t i = 0; i < count; ++i, ++irradiance)
    grid->save_irradiance(vec3(*irradiance));
  return 0;
}

int scatter(RslContext* context, int argc, const RslArg* argv[]) {
  RslColorIter result(argv[0]), tint(argv[5]);
  RslFloatIter index(argv[1]), width(argv[4]);
  RslPointIter P(argv[2]);
  RslNormalIter N(argv[3]);
  auto* grid = begun(*context, "ScatterDSOScatter()");
  for (unsigned int i = 0; i < RslArg::NumValues(argc, argv);
       ++i, ++result, ++index, ++P, ++N, ++width, ++tint) {
    const bool known = grid && *index >= 0 && *index < static_cast<float>(grid->grid_points());
    store(known ? grid->scatter(static_cast<uint32_t>(*index), vec3(*P), vec3(*N), *width, vec3(*tint))
                : subsurface::Color{},
          *result);
  }
  return 0;
}

} // namespace subsurface_plugin
