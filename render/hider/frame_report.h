// What is counted while a frame is rendered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace render {

/// What the grids of one surface shader cost, displacement and lights included, on all threads together.
struct ShaderCost {
  double seconds = 0;
  size_t grids = 0, points = 0;
};

/// What a user should be told about a frame.
struct FrameReport {
  size_t primitives = 0, split_primitives = 0, grids = 0, shaded_grids = 0, shaded_points = 0,
         micropolygons = 0;
  std::map<std::string, ShaderCost> shaders; ///< by name of the surface shader
  uint64_t variables =
      0; ///< a bit for each of the first 64 FrameSettings::aovs that some grid had a value for
  size_t bad_colours = 0; ///< shading points whose colour was not a finite number

  /// Adds all that a thread counts while it shades: not primitives, nor grids that are not shaded.
  void add_shading(const FrameReport& thread) {
    shaded_grids += thread.shaded_grids;
    shaded_points += thread.shaded_points;
    micropolygons += thread.micropolygons;
    variables |= thread.variables;
    bad_colours += thread.bad_colours;
    for (const auto& [name, cost] : thread.shaders) {
      ShaderCost& sum = shaders[name];
      sum.seconds += cost.seconds;
      sum.grids += cost.grids;
      sum.points += cost.points;
    }
  }
};

} // namespace render
