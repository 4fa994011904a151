// Lit clouds that are kept: in memory between frames, on disk between runs, no longer than they are good.
#include "stdlib/subsurface/lit_cloud.h"
#include "tests/temp_folder.h"
#include "tests/unit/subsurface/surfaces.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <thread>

namespace subsurface::test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Clouds : public ::testing::Test {
protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string save(const std::string& name, size_t points) {
    EXPECT_TRUE(write_point_cloud(path(name), ball(points, 2)));
    return path(name);
  }
  size_t trees() const {
    std::error_code ec;
    size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "trees", ec))
      count += entry.path().extension() == ".tree";
    return count;
  }
  static void expect(const CloudCache& cache, uint64_t in_memory, uint64_t on_disk, uint64_t built) {
    const CloudCache::Counts c = cache.counts();
    EXPECT_EQ(c.in_memory, in_memory);
    EXPECT_EQ(c.on_disk, on_disk);
    EXPECT_EQ(c.built, built);
  }
  anemone::test::TempFolder folder_;
};

TEST_F(Clouds, AreReadOnceWhileTheirFileIsTheSame) {
  const std::string file = save("lit.ply", 500);
  CloudCache cache;
  const auto first = cache.get(file), again = cache.get(file);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->cloud, again->cloud);
  expect(cache, 1, 0, 1);
  save("lit.ply", 600);
  const auto other = cache.get(file);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->cloud->tree().size(), 600u);
  EXPECT_EQ(first->cloud->tree().size(), 500u); // whoever has it keeps it
  expect(cache, 1, 0, 2);
}

TEST_F(Clouds, AreOneForAllThreads) {
  const std::string file = save("lit.ply", 20000);
  CloudCache cache;
  std::vector<std::shared_ptr<LitCloud>> got(8);
  std::vector<std::thread> threads;
  for (auto& slot : got)
    threads.emplace_back([&] { slot = cache.get(file)->cloud; });
  for (std::thread& t : threads)
    t.join();
  for (const auto& cloud : got)
    EXPECT_EQ(cloud, got[0]);
  expect(cache, 7, 0, 1);
}

TEST_F(Clouds, AreKeptOnDiskUntilTheirFileChanges) {
  const std::string file = save("lit.ply", 500);
  const CloudCache::Settings settings{size_t{1} << 30, path("trees")};
  const DiffusionMaterial marble(dipole_of(medium_of(*find_material("marble"))));
  auto look = [&](CloudCache& cache) {
    cache.configure(settings);
    const auto found = cache.get(file);
    EXPECT_TRUE(found) << (found ? "" : found.error());
    EXPECT_EQ(found->warning, "");
    return found->cloud->tree().exitance(marble, {0, 0, 2});
  };
  CloudCache one, two, three;
  const Color fresh = look(one);
  expect(one, 0, 0, 1);
  EXPECT_EQ(trees(), 1u);
  EXPECT_EQ(look(two), fresh);
  expect(two, 0, 1, 0);
  save("lit.ply", 700);
  EXPECT_FALSE(look(three) == fresh);
  expect(three, 0, 0, 1);
  EXPECT_EQ(trees(), 1u); // the new one in place of the old
  CloudCache four;
  look(four);
  expect(four, 0, 1, 0);
}

TEST_F(Clouds, ADamagedTreeIsMadeAnew) {
  const std::string file = save("lit.ply", 500);
  CloudCache one, two;
  one.configure({size_t{1} << 30, path("trees")});
  two.configure({size_t{1} << 30, path("trees")});
  ASSERT_TRUE(one.get(file));
  for (const auto& entry : fs::directory_iterator(folder_ / "trees"))
    fs::resize_file(entry.path(), 1000);
  ASSERT_TRUE(two.get(file));
  expect(two, 0, 0, 1);
}

TEST_F(Clouds, AFolderThatCannotBeWrittenIsAWarning) {
  const std::string file = save("lit.ply", 50);
  std::ofstream(path("occupied")) << "no folder";
  CloudCache cache;
  cache.configure({size_t{1} << 30, path("occupied")});
  const auto found = cache.get(file);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cloud->tree().size(), 50u);
  EXPECT_THAT(found->warning, HasSubstr("cannot write '" + path("occupied")));
}

TEST_F(Clouds, TheLeastRecentlyUsedGoWhenMemoryIsShort) {
  CloudCache cache;
  const std::string a = save("a.ply", 1000), b = save("b.ply", 1000), c = save("c.ply", 1000);
  const size_t one = cache.get(a)->cloud->bytes();
  cache.configure({5 * one / 2, ""}); // two, not three
  ASSERT_TRUE(cache.get(b));
  ASSERT_TRUE(cache.get(a)); // now b is the oldest
  ASSERT_TRUE(cache.get(c));
  EXPECT_LE(cache.bytes(), 5 * one / 2);
  EXPECT_EQ(cache.counts().given_up, 1u);
  ASSERT_TRUE(cache.get(a));
  expect(cache, 2, 0, 3);
  ASSERT_TRUE(cache.get(b));
  expect(cache, 2, 0, 4);
}

TEST_F(Clouds, InUseTheyStay) {
  CloudCache cache;
  cache.configure({1, ""});
  const auto held = cache.get(save("a.ply", 1000));
  const std::string b = save("b.ply", 1000), c = save("c.ply", 1000);
  ASSERT_TRUE(cache.get(b));
  ASSERT_TRUE(cache.get(c));
  EXPECT_EQ(cache.get(path("a.ply"))->cloud, held->cloud);
  EXPECT_EQ(cache.counts().given_up, 1u);
}

TEST_F(Clouds, AFrameSeesOneStateOfAFile) {
  const std::string file = save("lit.ply", 500);
  CloudCache cache;
  FrameClouds frame(cache);
  ASSERT_TRUE(frame.get(file));
  save("lit.ply", 600);
  EXPECT_EQ(frame.get(file)->cloud->tree().size(), 500u);
  EXPECT_EQ(FrameClouds(cache).get(file)->cloud->tree().size(), 600u);
  EXPECT_THAT(frame.get(path("none.ply")).error(), HasSubstr("cannot open '" + path("none.ply")));
}

TEST_F(Clouds, MaterialsAreKeptAFewAtATime) {
  PointCloud cloud = ball(300, 1);
  cloud.albedo.assign(cloud.size(), {0.5f, 0.5f, 0.5f});
  LitCloud lit(*DiffusionTree::build(cloud));
  const size_t bare = lit.bytes();
  const auto first = lit.material({1, 1, 1}, 1.3f);
  EXPECT_EQ(lit.material({1, 1, 1}, 1.3f), first);
  EXPECT_NE(lit.material({1, 1, 1}, 1.4f), first);
  const size_t with_two = lit.bytes();
  EXPECT_GT(with_two, bare);
  for (int i = 2; i < 30; ++i)
    static_cast<void>(lit.material({static_cast<float>(i), 1, 1}, 1.3f));
  EXPECT_EQ(lit.bytes(), bare + 2 * (with_two - bare));
}

} // namespace
} // namespace subsurface::test
