// Embree, which is loaded when it is needed.
#include "render/rays/embree_library.h"
#include "render/rays/embree_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace render::testing {
namespace {

using ::testing::IsEmpty;
using ::testing::StartsWith;

class NoFaces : public ItemFaces {
public:
  const FaceScene* faces(uint32_t) override { return nullptr; }
  bool same_surface(uint32_t, uint32_t, uint32_t) const override { return false; }
  std::vector<uint32_t> bounding(uint32_t, const RayRule&, Vec3,
                                 std::span<const RayCrossing>) const override {
    return {};
  }
};

TEST(EmbreeLibrary, that_is_missing_is_told) {
  const EmbreeLibrary library("no_such_embree.so");
  EXPECT_THAT(library.problem,
              StartsWith("Embree cannot be loaded, and there are no rays: no_such_embree.so"));
  EXPECT_EQ(library.rtcNewDevice, nullptr);
}

TEST(EmbreeLibrary, that_is_another_is_told) {
  const EmbreeLibrary library("libm.so.6");
  EXPECT_THAT(library.problem, StartsWith("Embree cannot be loaded, and there are no rays: "));
  EXPECT_EQ(library.rtcIntersect1, nullptr);
}

TEST(EmbreeLibrary, of_this_build_has_all_functions) {
  EXPECT_THAT(embree().problem, IsEmpty());
#define SL_EXPECT(name) EXPECT_NE(embree().name, nullptr);
  SL_EMBREE(SL_EXPECT)
#undef SL_EXPECT
}

TEST(RayWorld, of_nothing_takes_no_device) {
  RayDevice device;
  NoFaces faces;
  const RayWorld world(device, {}, faces);
  const RaySegment ray{{0, 0, 0}, {0, 0, 1}};
  RayHit hit;
  std::vector<RayHit> hits;
  EXPECT_FALSE(world.nearest({}, ray, nullptr, hit));
  EXPECT_FALSE(world.any({}, ray));
  EXPECT_FALSE(world.all({}, ray, nullptr, 1, hits));
  EXPECT_EQ(device.bytes(), 0u);
  EXPECT_THAT(device.problem(), IsEmpty());
}

} // namespace
} // namespace render::testing
