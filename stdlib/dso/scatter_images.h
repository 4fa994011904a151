// Scatter maps in files.
#pragma once

#include "stdlib/subsurface/point_cloud.h"

namespace subsurface_plugin {

/// A file whose name ends in .ply: a point cloud. Any other name stands for the three TIFF files of a scatter
/// map (the course's 5.4): "skin.tiff" for skinP.tiff, skinN.tiff and skinA.tiff, positions, normals and
/// areas in world space as 32-bit floats. The error names the file.
slvm::Result<subsurface::PointCloud> read_scatter_map(const std::string& name);

} // namespace subsurface_plugin
