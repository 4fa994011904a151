#include "stdlib/subsurface/tree_file.h"

#include "stdlib/subsurface/ply.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <sys/stat.h>
#include <system_error>

namespace subsurface {
namespace {

/// In front of everything. The last two digits are the version, the zeros tell byte orders apart.
constexpr uint64_t kMagic = 0x5343'4154'0000'0001;

struct Header {
  uint64_t magic = kMagic;
  FileStamp source;
  uint64_t points = 0, nodes = 0;
  uint64_t normals = 0, albedo = 0; ///< whether there are any
  uint64_t checksum = 0;            ///< of all that follows
};

/// FNV-1a, eight bytes at a time: against damage, not against forgery, which checks of the structure meet.
uint64_t checksum_of(std::span<const std::byte> bytes) {
  uint64_t sum = 0xcbf29ce484222325;
  for (size_t i = 0; i < bytes.size(); i += 8) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<size_t>(8, bytes.size() - i));
    sum = (sum ^ word) * 0x100000001b3;
  }
  return sum;
}

/// Columns of numbers, one after another.
class Writer {
public:
  template <class T> void column(std::span<const T> values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, float> ||
                  std::is_same_v<T, Vec3>);
    const auto raw = std::as_bytes(values);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }
  /// Of each row of a table, what `get` says.
  template <class Row, class Get> void column(std::span<const Row> rows, Get get) {
    std::vector<std::decay_t<std::invoke_result_t<Get, const Row&>>> values;
    values.reserve(rows.size());
    for (const Row& row : rows)
      values.push_back(get(row));
    column(std::span(std::as_const(values)));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

private:
  std::vector<std::byte> bytes_;
};

class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T> std::vector<T> column(size_t count) {
    std::vector<T> out;
    if (fine_ && count <= (bytes_.size() - at_) / sizeof(T)) {
      out.resize(count);
      if (count) std::memcpy(static_cast<void*>(out.data()), bytes_.data() + at_, count * sizeof(T));
      at_ += count * sizeof(T);
    } else {
      fine_ = false;
    }
    return out;
  }
  template <class T, class Row, class Set> void column(std::vector<Row>& rows, Set set) {
    const std::vector<T> values = column<T>(rows.size());
    for (size_t i = 0; i < values.size(); ++i)
      set(rows[i], values[i]);
  }
  /// All was there, and nothing else.
  bool complete() const { return fine_ && at_ == bytes_.size(); }

private:
  std::span<const std::byte> bytes_;
  size_t at_ = 0;
  bool fine_ = true;
};

template <class T> bool all_finite(const std::vector<T>& values) {
  return std::all_of(values.begin(), values.end(), [](const T& v) {
    if constexpr (std::is_same_v<T, float>)
      return std::isfinite(v);
    else
      return is_finite(v);
  });
}

using Node = PointOctree::Node;
using Group = DiffusionTree::Group;

} // namespace

slvm::Result<FileStamp> stamp_of(const std::string& path) {
  struct stat s;
  if (stat(path.c_str(), &s) != 0)
    return slvm::Error{fmt::format("cannot open '{}': {}", path, std::generic_category().message(errno))};
  return FileStamp{static_cast<uint64_t>(s.st_size),
                   static_cast<int64_t>(s.st_mtim.tv_sec) * 1'000'000'000 + s.st_mtim.tv_nsec,
                   static_cast<uint64_t>(s.st_ino)};
}

std::vector<std::byte> TreeFile::format(const DiffusionTree& tree, const FileStamp& source) {
  Writer w;
  const auto nodes = tree.octree_.nodes();
  w.column(nodes, [](const Node& n) { return n.centre; });
  w.column(nodes, [](const Node& n) { return n.half; });
  w.column(nodes, [](const Node& n) { return n.begin; });
  w.column(nodes, [](const Node& n) { return n.end; });
  w.column(nodes, [](const Node& n) { return n.first_child; });
  w.column(nodes, [](const Node& n) { return uint32_t{n.children}; });
  const std::span<const Group> groups(tree.groups_);
  w.column(groups, [](const Group& g) { return g.position; });
  w.column(groups, [](const Group& g) { return g.area; });
  w.column(groups, [](const Group& g) { return g.flux; });
  w.column(groups, [](const Group& g) { return uint32_t{g.dark}; });
  w.column(groups, [](const Group& g) { return g.normal; });
  w.column(tree.octree_.order());
  w.column(tree.octree_.positions());
  w.column(std::span<const float>(tree.area_));
  w.column(std::span<const Color>(tree.flux_));
  w.column(std::span<const Vec3>(tree.normal_));
  w.column(std::span<const Color>(tree.albedo_));
  const std::vector<std::byte> body = w.take();
  Header header;
  header.source = source;
  header.points = tree.size();
  header.nodes = nodes.size();
  header.normals = !tree.normal_.empty();
  header.albedo = !tree.albedo_.empty();
  header.checksum = checksum_of(body);
  std::vector<std::byte> bytes(sizeof header + body.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::copy(body.begin(), body.end(), bytes.begin() + sizeof header);
  return bytes;
}

slvm::Result<DiffusionTree> TreeFile::parse(std::span<const std::byte> bytes, const FileStamp& source,
                                            const std::string& name) {
  auto error = [&](std::string_view text) { return slvm::Error{fmt::format("{}: {}", name, text)}; };
  Header header;
  if (bytes.size() < sizeof header) return error("this is no tree of a cloud");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != kMagic) return error("this is no tree of a cloud, or of another version");
  if (!(header.source == source)) return error("stale: the cloud has changed");
  if (header.points > kMostPlyBytes || header.nodes > kMostPlyBytes || header.normals > 1 ||
      header.albedo > 1 || checksum_of(bytes.subspan(sizeof header)) != header.checksum)
    return error("it is damaged");
  Reader r(bytes.subspan(sizeof header));
  if (header.nodes > bytes.size()) return error("it is damaged");
  std::vector<Node> nodes(header.nodes);
  r.column<Vec3>(nodes, [](Node& n, Vec3 v) { n.centre = v; });
  r.column<float>(nodes, [](Node& n, float v) { n.half = v; });
  r.column<uint32_t>(nodes, [](Node& n, uint32_t v) { n.begin = v; });
  r.column<uint32_t>(nodes, [](Node& n, uint32_t v) { n.end = v; });
  r.column<uint32_t>(nodes, [](Node& n, uint32_t v) { n.first_child = v; });
  r.column<uint32_t>(nodes,
                     [](Node& n, uint32_t v) { n.children = static_cast<uint8_t>(std::min(v, 255u)); });
  DiffusionTree tree;
  tree.groups_.resize(header.nodes);
  r.column<Vec3>(tree.groups_, [](Group& g, Vec3 v) { g.position = v; });
  r.column<float>(tree.groups_, [](Group& g, float v) { g.area = v; });
  r.column<Color>(tree.groups_, [](Group& g, Color v) { g.flux = v; });
  r.column<uint32_t>(tree.groups_, [](Group& g, uint32_t v) { g.dark = v != 0; });
  r.column<Vec3>(tree.groups_, [](Group& g, Vec3 v) { g.normal = v; });
  std::vector<uint32_t> order = r.column<uint32_t>(header.points);
  std::vector<Vec3> positions = r.column<Vec3>(header.points);
  tree.area_ = r.column<float>(header.points);
  tree.flux_ = r.column<Color>(header.points);
  if (header.normals) tree.normal_ = r.column<Vec3>(header.points);
  if (header.albedo) tree.albedo_ = r.column<Color>(header.points);
  if (!r.complete() || !all_finite(positions) || !all_finite(tree.area_) || !all_finite(tree.flux_) ||
      !all_finite(tree.normal_) || !all_finite(tree.albedo_))
    return error("it is damaged");
  auto octree = PointOctree::of_parts(std::move(nodes), std::move(order), std::move(positions));
  if (!octree) return error(octree.error());
  tree.octree_ = std::move(*octree);
  return tree;
}

} // namespace subsurface
