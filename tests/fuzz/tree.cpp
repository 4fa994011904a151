// Octrees of clouds from anywhere: as they are, and with a checksum that fits, so that damage gets past it.
// What is accepted is looked up.
#include "stdlib/subsurface/materials.h"
#include "stdlib/subsurface/tree_file.h"

#include <algorithm>
#include <cstring>

namespace {

using namespace subsurface;

// Of the header: nine words, the checksum is the last.
constexpr size_t kHeader = 72, kChecksumAt = 64;

void seal(std::vector<std::byte>& bytes) {
  if (bytes.size() < kHeader) return;
  uint64_t sum = 0xcbf29ce484222325;
  for (size_t i = kHeader; i < bytes.size(); i += 8) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<size_t>(8, bytes.size() - i));
    sum = (sum ^ word) * 0x100000001b3;
  }
  std::memcpy(bytes.data() + kChecksumAt, &sum, sizeof sum);
}

void use(const DiffusionTree& tree) {
  static const DiffusionMaterial marble(dipole_of(medium_of(*find_material("marble"))));
  const Vec3 normal[] = {{0, 0, 1}};
  LookupOptions options;
  options.normals = normal;
  options.follow_topology = 0.7f;
  for (float epsilon : {0.0f, 0.1f, 1e9f}) {
    options.epsilon = epsilon;
    options.smooth = !options.smooth;
    static_cast<void>(tree.exitance(marble, {0.5f, 0, 1}, options));
  }
  static_cast<void>(tree.exitance(DiffusionMaterial(tree, {1, 2, 3}, 1.3), {0, 0, 0}));
  static_cast<void>(tree.coarser(0.5f));
  std::vector<PointOctree::Near> near;
  tree.octree().nearest({1, 2, 3}, 5, near);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > 1 << 20) return 0;
  const auto raw = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(raw.begin(), raw.end());
  for (int k = 0; k < 2; ++k, seal(bytes))
    if (const auto tree = TreeFile::parse(bytes, {}, "fuzz.tree")) use(*tree);
  return 0;
}
