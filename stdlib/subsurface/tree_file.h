// Trees of lit clouds on disk: with positions, areas, light, normals and colours of the samples, and for each
// node what stands for all of it (E, A, P; Jensen and Buhler 2002, 3), so that nothing of it need be computed
// again. A cache: of this machine's byte order, and good for one state of the cloud's file only.
#pragma once

#include "stdlib/subsurface/diffusion_tree.h"

namespace subsurface {

/// A file as it is: another one under its name has another stamp.
struct FileStamp {
  uint64_t bytes = 0;
  int64_t changed = 0; ///< in the file system's finest unit, since an epoch of its own
  uint64_t file = 0;   ///< its number on its device

  bool operator==(const FileStamp&) const = default;
};
/// The error names the path.
slvm::Result<FileStamp> stamp_of(const std::string& path);

class TreeFile {
public:
  /// Of the cloud whose file had this stamp.
  static std::vector<std::byte> format(const DiffusionTree& tree, const FileStamp& source);
  /// Nothing in the bytes is believed. Errors begin with `name`; "stale": they are of another stamp.
  static slvm::Result<DiffusionTree> parse(std::span<const std::byte> bytes, const FileStamp& source,
                                           const std::string& name);
};

} // namespace subsurface
