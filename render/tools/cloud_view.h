// Clouds of points to look at: what is in them, and pictures of them. For slcloud.
#pragma once

#include "render/caches/point_table.h"
#include "stdlib/subsurface/point_cloud.h"

#include <string>

namespace render::tools {

/// An irradiance cache, a photon map, or a cloud or mesh in a PLY file: the vertices with all that they have.
/// Every table has the column "P". Errors name the file.
slvm::Result<PointTable> read_cloud(const std::string& path);

/// Kind, number of points, bounds; of each column the least, the greatest and the mean value.
std::string describe(const PointTable& table, const std::string& name);

struct ViewSettings {
  std::string show;         ///< a column of one or three components; "": what is most likely wanted
  bool discs = false;       ///< lying on the surface, not points
  float scale = 1;          ///< of points and discs
  float turn = 0, tilt = 0; ///< degrees: round the upright axis, then up or down
  float zoom = 1;
  float gain = 1; ///< multiplies what is shown
  int width = 512, height = 512;
};

/// A scene that looks at the whole cloud and ends in the picture `display`: linear as OpenEXR, else for the
/// screen. The error tells what cannot be shown.
slvm::Result<std::string> scene_of(const PointTable& table, const ViewSettings& settings,
                                   const std::string& display);

/// The same as a cloud of subsurface's, for PLY files: columns that clouds have no place for are channels,
/// three of them for three components. Radii become areas.
subsurface::PointCloud cloud_of(const PointTable& table);

} // namespace render::tools
