// Point clouds: samples of a surface, each with the piece of surface that it stands for. They are kept in PLY
// files, which other programs (MeshLab, CloudCompare, Blender) show and change.
//
// The space is the caller's, usually world space; lengths as in the medium that is used with them.
#pragma once

#include "slvm/support/result.h"
#include "stdlib/subsurface/vec3.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace subsurface {

/// A number for each point, with a name of its own ("thickness").
struct Channel {
  std::string name;
  std::vector<float> values;
};

/// Columns; those that are not known are empty, the others have one entry for each point.
struct PointCloud {
  std::vector<Vec3> position;
  std::vector<Vec3> normal;      ///< unit, outward
  std::vector<float> area;       ///< surface that the point stands for [length^2], 0 or more
  std::vector<Color> irradiance; ///< E, diffuse light that arrives there [power/length^2]
  std::vector<Color> albedo;     ///< colour under diffuse light (a texture's)
  std::vector<Channel> channels;

  size_t size() const { return position.size(); }
  const Channel* find(std::string_view channel) const;
  /// Sum of all areas.
  double total_area() const;
};

/// What is wrong with a cloud, "" if nothing: columns of different lengths, positions that are not finite,
/// areas that are negative or not finite, irradiance, albedo, normals or channels that are not finite.
std::string check(const PointCloud& cloud);

/// The points of `from` behind those of `to`, which has the same columns, channels in the same order; or
/// none.
void append(PointCloud& to, const PointCloud& from);
/// Orders points by place, normal and area, whatever order they came in.
void sort_points(PointCloud& cloud);

/// In a PLY file the element "vertex" has the properties x y z; nx ny nz; area; irradiance_r irradiance_g
/// irradiance_b; albedo_r albedo_g albedo_b; all others that are no lists are channels. Without albedo_* the
/// colours red green blue, which scanners and painters write, serve as albedo (bytes: divided by 255). Fails
/// on what check() finds.
slvm::Result<PointCloud> read_point_cloud(const std::string& path);
slvm::Result<PointCloud> parse_point_cloud(std::span<const std::byte> bytes, const std::string& name);

enum class PlyEncoding { kBinary, kAscii };

/// The cloud as the bytes of a PLY file; the albedo once more as red green blue (bytes, clamped), for
/// viewers. Numbers as text read back as they were. Fails on what check() finds, and on channel names that
/// PLY cannot hold.
slvm::Result<std::vector<std::byte>> format_point_cloud(const PointCloud& cloud,
                                                        PlyEncoding encoding = PlyEncoding::kBinary);
/// The same into a file: a temporary one, then renamed, so that readers never see half a cloud.
slvm::Result<bool> write_point_cloud(const std::string& path, const PointCloud& cloud,
                                     PlyEncoding encoding = PlyEncoding::kBinary);

} // namespace subsurface
