// Trees on disk: what is read back looks up the same to the last bit; what is stale, damaged or hostile is
// refused.
#include "stdlib/subsurface/tree_file.h"
#include "tests/temp_folder.h"
#include "tests/unit/subsurface/surfaces.h"

#include <cstring>
#include <fstream>
#include <gmock/gmock.h>

namespace subsurface::test {
namespace {

using ::testing::EndsWith;
using ::testing::StartsWith;

constexpr FileStamp kStamp{1000, 123456789, 42};
// Where in the file things are: the header has nine words.
constexpr size_t kHeader = 9 * 8;

DiffusionTree painted_ball(size_t n) {
  PointCloud cloud = ball(n, 2);
  for (Vec3 p : cloud.position)
    cloud.albedo.push_back({0.5f + p.x / 5, 0.4f, 0.3f});
  return *DiffusionTree::build(cloud);
}

TEST(TreeFile, ReadsBackTheSameTree) {
  const DiffusionTree tree = painted_ball(3000);
  const auto again = TreeFile::parse(TreeFile::format(tree, kStamp), kStamp, "a.tree");
  ASSERT_TRUE(again) << again.error();
  EXPECT_EQ(again->size(), tree.size());
  EXPECT_EQ(again->bytes(), tree.bytes());
  EXPECT_TRUE(again->has_normals() && again->has_albedo());
  const DiffusionMaterial marble(dipole_of(medium_of(*find_material("marble")))), paint(tree, {1, 2, 3}, 1.3),
      paint_again(*again, {1, 2, 3}, 1.3);
  LookupOptions options;
  const Vec3 n[] = {{0, 0, 1}};
  options.normals = n;
  options.follow_topology = 0.5f;
  for (const Vec3 x : {Vec3{0, 0, 2}, Vec3{2, 0, 0}, Vec3{0.1f, 0.2f, 0.3f}}) {
    EXPECT_EQ(tree.exitance(marble, x, options), again->exitance(marble, x, options));
    EXPECT_EQ(tree.exitance(paint, x), again->exitance(paint_again, x));
  }
  for (size_t i = 0; i < tree.groups().size(); ++i) {
    ASSERT_EQ(tree.groups()[i].flux, again->groups()[i].flux);
    ASSERT_EQ(tree.groups()[i].area, again->groups()[i].area);
    ASSERT_EQ(tree.groups()[i].position, again->groups()[i].position);
  }
}

TEST(TreeFile, AnEmptyCloudIsATreeToo) {
  const auto again = TreeFile::parse(TreeFile::format(DiffusionTree(), kStamp), kStamp, "a.tree");
  ASSERT_TRUE(again) << again.error();
  EXPECT_EQ(again->size(), 0u);
}

TEST(TreeFile, IsStaleWhenTheCloudIsAnother) {
  const auto bytes = TreeFile::format(painted_ball(100), kStamp);
  for (FileStamp other :
       {FileStamp{1001, 123456789, 42}, FileStamp{1000, 123456790, 42}, FileStamp{1000, 123456789, 43}}) {
    const auto read = TreeFile::parse(bytes, other, "a.tree");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error(), "a.tree: stale: the cloud has changed");
  }
}

TEST(TreeFile, DamageIsFound) {
  const auto whole = TreeFile::format(painted_ball(200), kStamp);
  auto error = [&](std::span<const std::byte> bytes) {
    const auto read = TreeFile::parse(bytes, kStamp, "a.tree");
    return read ? std::string() : read.error();
  };
  EXPECT_EQ(error({}), "a.tree: this is no tree of a cloud");
  for (size_t at : {kHeader, whole.size() / 2, whole.size() - 1}) {
    auto bytes = whole;
    bytes[at] ^= std::byte{1};
    EXPECT_EQ(error(bytes), "a.tree: it is damaged") << at;
  }
  auto other = whole;
  other[0] ^= std::byte{2};
  EXPECT_EQ(error(other), "a.tree: this is no tree of a cloud, or of another version");
  EXPECT_EQ(error(std::span(whole).first(whole.size() - 4)), "a.tree: it is damaged");
}

TEST(Octree, PartsThatAreNoTreeAreRefused) {
  using Node = PointOctree::Node;
  const PointOctree sound(ball(100, 1).position);
  const std::vector<Node> nodes(sound.nodes().begin(), sound.nodes().end());
  const std::vector<uint32_t> order(sound.order().begin(), sound.order().end());
  const std::vector<Vec3> positions(sound.positions().begin(), sound.positions().end());
  EXPECT_TRUE(PointOctree::of_parts(nodes, order, positions));
  EXPECT_TRUE(PointOctree::of_parts({}, {}, {}));
  auto refused = [&](auto change) {
    auto n = nodes;
    auto o = order;
    auto p = positions;
    change(n, o, p);
    const auto tree = PointOctree::of_parts(n, o, p);
    return tree ? std::string() : tree.error();
  };
  const std::string no_tree = "its nodes are no tree";
  EXPECT_EQ(refused([](auto& n, auto&, auto&) { n[0].first_child = 0; }), no_tree); // a child of itself
  EXPECT_EQ(refused([](auto& n, auto&, auto&) { n[0].children = 9; }), no_tree);
  EXPECT_EQ(refused([](auto& n, auto&, auto&) { n[0].end += 1; }), no_tree);
  EXPECT_EQ(refused([](auto& n, auto&, auto&) { n.back().begin = n.back().end; }), no_tree);
  EXPECT_EQ(refused([](auto& n, auto&, auto&) { n.push_back(n.back()); }), no_tree); // nobody's child
  EXPECT_EQ(refused([](auto& n, auto&, auto&) { n.resize(1); }), no_tree);
  EXPECT_EQ(refused([](auto& n, auto&, auto&) { n.clear(); }), no_tree);
  EXPECT_EQ(refused([](auto&, auto& o, auto&) { o[0] = o[1]; }), "the tree leaves points out");
  EXPECT_EQ(refused([](auto&, auto& o, auto&) { o[0] = 100; }), "the tree leaves points out");
  EXPECT_EQ(refused([](auto&, auto&, auto& p) { p.pop_back(); }), "the tree has an order of other points");
}

TEST(FileStamp, ChangesWithTheFile) {
  anemone::test::TempFolder folder;
  const std::string path = (folder / "a").string();
  EXPECT_THAT(stamp_of(path).error(), StartsWith("cannot open '" + path + "': No such file"));
  std::ofstream(path) << "one";
  const auto first = stamp_of(path);
  ASSERT_TRUE(first);
  EXPECT_EQ(*first, *stamp_of(path));
  std::ofstream(path) << "another";
  EXPECT_FALSE(*first == *stamp_of(path));
}

} // namespace
} // namespace subsurface::test
