// RelativeDetail, Detail, DetailRange: which versions of an object are drawn.
#include "render/state/interpreter.h"

#include <fmt/format.h>

namespace render {

namespace {

/// The RISpec's RI_INFINITY is 1e38.
float or_infinite(float x) {
  constexpr float kHuge = 1e30f;
  return x >= kHuge ? kInfinity : x;
}

} // namespace

void Interpreter::relative_detail(const RequestCall& call) {
  if (call.number(0) >= 0)
    options_.relative_detail = call.number(0);
  else
    error(call, "expected a factor of 0 or more");
}

void Interpreter::detail(const RequestCall& call) {
  auto b = call.numbers(0);
  LevelOfDetail& level = edit().detail;
  level.bound.reset();
  level.size = kInfinity;
  Box box{{b[0], b[2], b[4]}, {b[1], b[3], b[5]}};
  if (box.empty()) {
    error(call, "the bound is empty; expected xmin xmax ymin ymax zmin zmax");
    return;
  }
  // An infinite bound is infinitely large.
  for (float x : b)
    if (or_infinite(std::abs(x)) == kInfinity) return;
  level.bound.emplace();
  for (int i = 0; i < 8; ++i)
    (*level.bound)[static_cast<size_t>(i)] = transform_point(ctm_, box.corner(i));
  measure_detail();
}

/// Outside the world the camera is not yet known for good: WorldBegin measures again.
void Interpreter::measure_detail() {
  const LevelOfDetail& level = attributes_->detail;
  if (!level.bound || !in_world_) return;
  float size = raster_area(Camera(scene_.options), *level.bound) * scene_.options.relative_detail;
  edit().detail.size = size;
}

void Interpreter::detail_range(const RequestCall& call) {
  std::array<float, 4> range;
  for (int i = 0; i < 4; ++i)
    range[static_cast<size_t>(i)] = or_infinite(call.number(i));
  bool ordered = range[0] >= 0 && range[0] <= range[1] && range[1] <= range[2] && range[2] <= range[3];
  if (ordered)
    edit().detail.range = range;
  else
    error(call, fmt::format("expected 0 <= offlow <= onlow <= onhigh <= offhigh, found {:g}",
                            fmt::join(range, " ")));
}

bool Interpreter::out_of_detail() const {
  return attributes_->detail.part().empty();
}

} // namespace render
