// Lists of the samples that a micropolygon covers.
#include "render/hider/quad_hits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/hider/quad_hits.cpp"
#include <hwy/foreach_target.h>

#include "render/hider/quad_coverage.h"
#include "slvm/wide/targets.h"

#include <hwy/highway.h>

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

class Finder {
public:
  HWY_INLINE Finder(bool both, const float* limit, QuadHit* out)
      : both_(both), limit_(limit), begin_(out), out_(out) {}
  size_t count() const { return static_cast<size_t>(out_ - begin_); }

  HWY_INLINE void add(const WideQuad& q, const WideCoverage& in, I samples) {
    M second = both_ ? in.second : hn::AndNot(in.first, in.second);
    if (!hn::AllFalse(kWide, in.first))
      add(in.first, samples, QuadPart::kFirst, {in.bd, in.diagonal, in.ab}, {q.z[0], q.z[1], q.z[3]});
    if (!hn::AllFalse(kWide, second))
      add(second, samples, QuadPart::kSecond, {in.dc, in.ca, in.diagonal}, {q.z[0], q.z[3], q.z[2]});
  }

private:
  struct Corners {
    V a, b, c;
  };
  /// `areas` are those of the triangles opposite to the corners, which their weights are in proportion to.
  HWY_INLINE void add(M inside, I samples, QuadPart part, const Corners& areas, const Corners& depths) {
    V a = hn::Abs(areas.a), b = hn::Abs(areas.b), c = hn::Abs(areas.c);
    V sum = hn::Add(hn::Add(a, b), c);
    V scale = hn::Div(hn::Set(kWide, 1.0f), sum);
    a = hn::Mul(a, scale);
    b = hn::Mul(b, scale);
    c = hn::Mul(c, scale);
    // Differences, so that equal depths stay exactly what they are.
    V z = hn::Add(hn::Add(depths.a, hn::Mul(hn::Sub(depths.b, depths.a), b)),
                  hn::Mul(hn::Sub(depths.c, depths.a), c));
    M seen = hn::And(inside, hn::Gt(sum, hn::Zero(kWide)));
    if (limit_) seen = hn::AndNot(hn::Ge(z, hn::GatherIndex(kWide, limit_, samples)), seen);
    uint64_t bits = 0;
    hn::StoreMaskBits(kWide, seen, reinterpret_cast<uint8_t*>(&bits));
    if (bits == 0) return;
    HWY_ALIGN float weights[3][kLanes], depth[kLanes];
    HWY_ALIGN int32_t sample[kLanes];
    hn::Store(a, kWide, weights[0]);
    hn::Store(b, kWide, weights[1]);
    hn::Store(c, kWide, weights[2]);
    hn::Store(z, kWide, depth);
    hn::Store(samples, kIndices, sample);
    for (; bits != 0; bits &= bits - 1) {
      auto lane = static_cast<size_t>(std::countr_zero(bits));
      *out_++ = {static_cast<uint32_t>(sample[lane]),
                 part,
                 {weights[0][lane], weights[1][lane], weights[2][lane]},
                 depth[lane]};
    }
  }

  bool both_;
  const float* limit_;
  QuadHit *begin_, *out_;
};

size_t find_still(const Vec3 (&p)[4], bool both, const SampleField& field, const SampleWindow& window,
                  QuadHit* hits) {
  Finder finder(both, field.limit, hits);
  WideQuad quad;
  for (size_t c = 0; c < 4; ++c) {
    quad.p[c] = {hn::Set(kWide, p[c].x), hn::Set(kWide, p[c].y)};
    quad.z[c] = hn::Set(kWide, p[c].z);
  }
  for_covered(quad, field.x, field.y, field.width, window,
              [&](const auto& rows, const WideCoverage& covered)
                  HWY_ATTR { finder.add(quad, covered, rows.numbers()); });
  return finder.count();
}

/// A moving micropolygon as each lane's sample sees it: at its time, through its point of the lens.
class MovingFinder {
public:
  HWY_INLINE MovingFinder(const MovingQuad& q, bool both, const SampleField& field, QuadHit* hits)
      : finder_(both, field.limit, hits), box_(q.low, q.high), q_(q),
        lens_(reinterpret_cast<const float*>(field.lens)), focus_(field.focus) {
    const float rate = 1 / (q.t1 - q.t0);
    for (size_t c = 0; c < 4; ++c)
      speed_[c] = (q.to[c] - q.from[c]) * rate;
  }
  size_t count() const { return finder_.count(); }

  /// Those of `looked_at` that the box around all of the motion holds.
  HWY_INLINE M near(const WideVec2& at, M looked_at) const { return hn::And(box_.contains(at), looked_at); }
  HWY_INLINE void look(const WideVec2& at, V time, M looked_at, I samples) {
    const V t0 = hn::Set(kWide, q_.t0), one = hn::Set(kWide, 1.0f), focus = hn::Set(kWide, focus_);
    looked_at = hn::And(looked_at, hn::And(hn::Ge(time, t0), hn::Lt(time, hn::Set(kWide, q_.t1))));
    time = hn::Sub(time, t0);
    WideVec2 shift{hn::Zero(kWide), hn::Zero(kWide)}; // of what has a defocus of 1
    if (lens_) {
      const I pairs = hn::ShiftLeft<1>(samples);
      shift = {hn::GatherIndex(kWide, lens_, pairs), hn::GatherIndex(kWide, lens_ + 1, pairs)};
    }
    WideQuad quad;
    for (size_t c = 0; c < 4; ++c) {
      const Vec3 from = q_.from[c], speed = speed_[c];
      WideVec2& p = quad.p[c];
      p = {hn::Add(hn::Set(kWide, from.x), hn::Mul(hn::Set(kWide, speed.x), time)),
           hn::Add(hn::Set(kWide, from.y), hn::Mul(hn::Set(kWide, speed.y), time))};
      quad.z[c] = hn::Add(hn::Set(kWide, from.z), hn::Mul(hn::Set(kWide, speed.z), time));
      if (!lens_) continue;
      const V defocus = hn::Sub(focus, hn::Div(one, quad.z[c]));
      p.x = hn::Add(p.x, hn::Mul(shift.x, defocus));
      p.y = hn::Add(p.y, hn::Mul(shift.y, defocus));
    }
    finder_.add(quad, quad.cover(at, looked_at), samples);
  }

private:
  Finder finder_;
  WideBox box_;
  const MovingQuad& q_;
  const float* lens_; ///< null: none
  Vec3 speed_[4];
  float focus_;
};

size_t find_moving(const MovingQuad& q, bool both, const SampleField& field, const uint32_t* order,
                   size_t columns, const SampleWindow& window, QuadHit* hits) {
  MovingFinder finder(q, both, field, hits);
  for (size_t j = window.j0; j < window.j1; ++j)
    for (size_t i = window.i0; i < window.i1; i += hn::Lanes(kWide)) {
      const I samples = hn::LoadU(kIndices, reinterpret_cast<const int32_t*>(order) + j * columns + i);
      const WideVec2 at{hn::GatherIndex(kWide, field.x, samples), hn::GatherIndex(kWide, field.y, samples)};
      const M looked_at = finder.near(at, hn::FirstN(kWide, window.i1 - i));
      if (!hn::AllFalse(kWide, looked_at))
        finder.look(at, hn::GatherIndex(kWide, field.time, samples), looked_at, samples);
    }
  return finder.count();
}

size_t find_slow(const MovingQuad& q, bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits) {
  MovingFinder finder(q, both, field, hits);
  for_window(field.width, window, [&](const auto& rows, M in_window) HWY_ATTR {
    const WideVec2 at{rows.load(field.x), rows.load(field.y)};
    const M looked_at = finder.near(at, in_window);
    if (!hn::AllFalse(kWide, looked_at)) finder.look(at, rows.load(field.time), looked_at, rows.numbers());
  });
  return finder.count();
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
const auto kFindStill = SL_BEST(find_still);
const auto kFindMoving = SL_BEST(find_moving);
const auto kFindSlow = SL_BEST(find_slow);

size_t quad_hits(const Vec3 (&p)[4], bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits) {
  return kFindStill(p, both, field, window, hits);
}

size_t moving_hits(const MovingQuad& quad, bool both, const SampleField& field, const uint32_t* order,
                   size_t columns, const SampleWindow& window, QuadHit* hits) {
  return kFindMoving(quad, both, field, order, columns, window, hits);
}

size_t slow_hits(const MovingQuad& quad, bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits) {
  return kFindSlow(quad, both, field, window, hits);
}

} // namespace render
#endif
