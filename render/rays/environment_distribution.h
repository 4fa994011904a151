// Directions as the light of an environment map comes: a table of the map's brightness, inverted row by row.
#pragma once

#include "render/state/math.h"
#include "slvm/rays.h"
#include "slvm/textures.h"

#include <memory>
#include <string>
#include <vector>

namespace render {

class EnvironmentDistribution {
public:
  /// Looks the map up in all directions. `problem`: why that cannot be done.
  EnvironmentDistribution(slvm::TextureServices& textures, std::string_view map, std::string& problem);

  /// The direction that two numbers from 0 to 1 stand for, the map's colour there and the density of
  /// directions.
  void sample(float row, float column, Vec3& direction, Color& colour, float& density) const;

private:
  static constexpr size_t kRows = 128, kColumns = 256;
  std::vector<Color> colours_;
  std::vector<double> rows_;    ///< brightness of the rows up to each, from 0
  std::vector<double> columns_; ///< of the texels of a row up to each, from 0
};

} // namespace render
