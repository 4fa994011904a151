// Scatter maps in files.
#pragma once

#include "stdlib/subsurface/tree_file.h"

namespace subsurface_plugin {

/// A file whose name ends in .ply: a point cloud. Any other name stands for the TIFF files of a scatter map
/// (the course's 5.4): "skin.tiff" for skinP.tiff, skinN.tiff and skinA.tiff, positions, normals and areas in
/// world space as 32-bit floats; and, if there is one, skinF.tiff, numbers of faces (5.5). The error names
/// the file.
slvm::Result<subsurface::PointCloud> read_scatter_map(const std::string& name);
/// Of these files, as they are.
std::vector<subsurface::FileStamp> stamps_of_scatter_map(const std::string& name);

} // namespace subsurface_plugin
