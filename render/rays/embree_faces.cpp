// The faces of an item: quadrilaterals in a scene of their own.
#include "render/rays/embree_faces.h"
#include "render/rays/embree_calls.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

/// How far the third corner of a face is from where a parallelogram would have it, in its first and last
/// sides. Two bytes, for these are read at random; where they are not enough there are none.
class Skew {
public:
  Skew(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const Vec3 x = b - a, y = d - a, off = c - b - y;
    const float xx = glm::dot(x, x), xy = glm::dot(x, y), yy = glm::dot(y, y);
    const float dx = glm::dot(off, x), dy = glm::dot(off, y), determinant = xx * yy - xy * xy;
    const float s = (dx * yy - dy * xy) / determinant * kSteps,
                t = (dy * xx - dx * xy) / determinant * kSteps;
    if (!(std::abs(s) < 127 && std::abs(t) < 127)) return;
    along_first_ = static_cast<int8_t>(std::lround(s));
    along_last_ = static_cast<int8_t>(std::lround(t));
  }
  float along_first() const { return along_first_ / kSteps; }
  float along_last() const { return along_last_ / kSteps; }

private:
  static constexpr float kSteps = 64;
  int8_t along_first_ = 0, along_last_ = 0;
};

class EmbreeFaces final : public FaceScene {
public:
  EmbreeFaces(RTCScene s, const QuadMesh& mesh) : scene(s) {
    skews_.reserve(mesh.faces.size());
    for (const auto& [a, b, c, d] : mesh.faces)
      skews_.emplace_back(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
  }
  ~EmbreeFaces() override { embree().rtcReleaseScene(scene); }
  RTCScene scene;

  /// One step of Newton's method.
  Vec2 on_patch(const RayHit& hit) const override {
    const float s = skews_[hit.face].along_first(), t = skews_[hit.face].along_last();
    // u v in the triangle at the first corner, (1 - u) (1 - v) in the other one, where u + v > 1.
    const float off = hit.u * hit.v - std::max(hit.u + hit.v - 1, 0.0f);
    // Of triangles it is exact as far as to the corner their last side is.
    const float least = s == -1 && t == 0 ? 1e-6f : 0.1f;
    const float by = off / std::max(1 + hit.v * s + hit.u * t, least);
    return {hit.u - by * s, hit.v - by * t};
  }

private:
  std::vector<Skew> skews_;
};

} // namespace

RTCScene scene_of(const FaceScene* faces) {
  return static_cast<const EmbreeFaces*>(faces)->scene;
}

void commit_scene(RTCScene scene) {
  tbb::this_task_arena::isolate([&] { embree().rtcCommitScene(scene); });
}

RayDevice::RayDevice(bool alone) : impl_(std::make_unique<Impl>()) {
  impl_->alone = alone;
}
RayDevice::~RayDevice() = default;
const std::string& RayDevice::problem() const {
  return impl_->problem;
}
size_t RayDevice::bytes() const {
  return static_cast<size_t>(std::max<int64_t>(impl_->bytes, 0));
}

std::unique_ptr<const FaceScene> RayDevice::build(const QuadMesh& mesh) const {
  RTCDevice device = mesh.faces.empty() ? nullptr : impl_->get();
  if (!device) return nullptr;
  RTCScene scene = embree().rtcNewScene(device);
  embree().rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | kFilterFlag));
  RTCGeometry g = embree().rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  allow_filter(g);
  size_t points = mesh.points.size() / mesh.times;
  embree().rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(mesh.times));
  for (size_t t = 0; t < mesh.times; ++t) {
    auto* to = static_cast<float*>(embree().rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(t), RTC_FORMAT_FLOAT3, 3 * sizeof(float), points));
    for (size_t i = 0; i < points; ++i)
      for (int c = 0; c < 3; ++c)
        *to++ = mesh.points[t * points + i][c];
  }
  auto* index = static_cast<uint32_t*>(embree().rtcSetNewGeometryBuffer(
      g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(uint32_t), mesh.faces.size()));
  for (const auto& face : mesh.faces)
    index = std::copy(face.begin(), face.end(), index);
  embree().rtcCommitGeometry(g);
  embree().rtcAttachGeometry(scene, g);
  embree().rtcReleaseGeometry(g);
  commit_scene(scene);
  return std::make_unique<EmbreeFaces>(scene, mesh);
}

} // namespace render
