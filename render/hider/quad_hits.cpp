// Edge functions (Pineda, 1988) in lanes of samples.
#include "render/hider/quad_hits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/hider/quad_hits.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/targets.h"

#include <hwy/highway.h>

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Micropolygons are small: of wider vectors most lanes would lie beyond them.
constexpr hn::CappedTag<float, 8> kWide;
constexpr hn::RebindToSigned<decltype(kWide)> kIndices;
constexpr size_t kLanes = hn::MaxLanes(kWide);
using V = hn::Vec<decltype(kWide)>;
using I = hn::Vec<decltype(kIndices)>;
using M = hn::Mask<decltype(kWide)>;

struct WideVec2 {
  V x, y;
};

/// Twice the signed area of a, b, p, computed the same way for b, a, p, so that of two triangles that share
/// an edge exactly one contains a sample on or near it.
struct WideEdge {
  WideVec2 a, d;
  M swapped;
  HWY_INLINE WideEdge(const WideVec2& from, const WideVec2& to) {
    swapped = hn::Or(hn::Lt(to.x, from.x), hn::And(hn::Eq(to.x, from.x), hn::Lt(to.y, from.y)));
    a = {hn::IfThenElse(swapped, to.x, from.x), hn::IfThenElse(swapped, to.y, from.y)};
    d = {hn::Sub(hn::IfThenElse(swapped, from.x, to.x), a.x),
         hn::Sub(hn::IfThenElse(swapped, from.y, to.y), a.y)};
  }
  HWY_INLINE V value(const WideVec2& p) const {
    return hn::Sub(hn::Mul(d.x, hn::Sub(p.y, a.y)), hn::Mul(d.y, hn::Sub(p.x, a.x)));
  }
  HWY_INLINE M left(V value) const { return hn::Xor(hn::Ge(value, hn::Zero(kWide)), swapped); }
};

/// Corners a, b, c, d; as many micropolygons as lanes, or one in all of them.
struct WideQuad {
  WideVec2 p[4];
  V z[4];
  WideEdge ab, bd, da, dc, ca;
  HWY_INLINE WideQuad(const WideVec2 (&at)[4], const V (&depth)[4])
      : p{at[0], at[1], at[2], at[3]}, z{depth[0], depth[1], depth[2], depth[3]}, ab(p[0], p[1]),
        bd(p[1], p[3]), da(p[3], p[0]), dc(p[3], p[2]), ca(p[2], p[0]) {}
};

class Finder {
public:
  HWY_INLINE Finder(bool both, const float* limit, QuadHit* out)
      : both_(both), limit_(limit), begin_(out), out_(out) {}
  size_t count() const { return static_cast<size_t>(out_ - begin_); }

  /// Samples at `at`, of those the ones in `in_box`. `samples`: their numbers.
  HWY_INLINE void find(const WideQuad& q, const WideVec2& at, M in_box, I samples) {
    V diagonal = q.da.value(at), a = q.ab.value(at), b = q.bd.value(at), d = q.dc.value(at),
      c = q.ca.value(at);
    M side = q.da.left(diagonal);
    M first = hn::AndNot(hn::Or(hn::Xor(q.ab.left(a), side), hn::Xor(q.bd.left(b), side)), in_box);
    M second = hn::And(hn::And(hn::Xor(q.dc.left(d), side), hn::Xor(q.ca.left(c), side)), in_box);
    if (!both_) second = hn::AndNot(first, second);
    if (!hn::AllFalse(kWide, first))
      add(first, samples, QuadPart::kFirst, {b, diagonal, a}, {q.z[0], q.z[1], q.z[3]});
    if (!hn::AllFalse(kWide, second))
      add(second, samples, QuadPart::kSecond, {d, c, diagonal}, {q.z[0], q.z[3], q.z[2]});
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

struct WideBox {
  WideVec2 low, high;
  HWY_INLINE WideBox(Vec2 from, Vec2 to)
      : low{hn::Set(kWide, from.x), hn::Set(kWide, from.y)}, high{hn::Set(kWide, to.x),
                                                                  hn::Set(kWide, to.y)} {}
  HWY_INLINE M contains(const WideVec2& p) const {
    return hn::And(hn::And(hn::Ge(p.x, low.x), hn::Le(p.x, high.x)),
                   hn::And(hn::Ge(p.y, low.y), hn::Le(p.y, high.y)));
  }
};

#if HWY_TARGET != HWY_SCALAR
constexpr hn::Half<decltype(kWide)> kHalf;
constexpr size_t kHalfLanes = hn::MaxLanes(kHalf);

/// For windows so narrow that two rows fit into a vector, as those of most micropolygons are.
HWY_INLINE void find_in_pairs_of_rows(const WideQuad& quad, const WideBox& box, const SampleField& field,
                                      const SampleWindow& window, Finder& finder) {
  const size_t columns = window.i1 - window.i0;
  constexpr auto kRow = static_cast<int32_t>(kHalfLanes);
  const I lanes = hn::Iota(kIndices, 0), upper = hn::Set(kIndices, kRow - 1);
  const auto in_upper = hn::Gt(lanes, upper);
  const I column = hn::Sub(lanes, hn::IfThenElseZero(in_upper, hn::Set(kIndices, kRow)));
  const auto in_window = hn::Lt(column, hn::Set(kIndices, static_cast<int32_t>(columns)));
  const I offset =
      hn::Add(column, hn::IfThenElseZero(in_upper, hn::Set(kIndices, static_cast<int32_t>(field.width))));
  for (size_t j = window.j0; j < window.j1; j += 2) {
    const bool two = j + 1 < window.j1;
    const size_t k = j * field.width + window.i0, next = two ? k + field.width : k;
    auto rows = [&](const float* of) {
      return hn::Combine(kWide, hn::LoadU(kHalf, of + next), hn::LoadU(kHalf, of + k));
    };
    const WideVec2 at{rows(field.x), rows(field.y)};
    M looked_at = hn::And(box.contains(at), hn::RebindMask(kWide, in_window));
    if (!two) looked_at = hn::And(looked_at, hn::FirstN(kWide, kHalfLanes));
    if (hn::AllFalse(kWide, looked_at)) continue;
    finder.find(quad, at, looked_at, hn::Add(hn::Set(kIndices, static_cast<int32_t>(k)), offset));
  }
}
#endif

size_t find_still(const Vec3 (&p)[4], bool both, const SampleField& field, const SampleWindow& window,
                  QuadHit* hits) {
  WideBox box(glm::min(glm::min(Vec2(p[0]), Vec2(p[1])), glm::min(Vec2(p[2]), Vec2(p[3]))),
              glm::max(glm::max(Vec2(p[0]), Vec2(p[1])), glm::max(Vec2(p[2]), Vec2(p[3]))));
  WideVec2 corners[4];
  V depths[4];
  for (size_t c = 0; c < 4; ++c) {
    corners[c] = {hn::Set(kWide, p[c].x), hn::Set(kWide, p[c].y)};
    depths[c] = hn::Set(kWide, p[c].z);
  }
  WideQuad quad(corners, depths);
  Finder finder(both, field.limit, hits);
#if HWY_TARGET != HWY_SCALAR
  if (window.i1 - window.i0 <= kHalfLanes) {
    find_in_pairs_of_rows(quad, box, field, window, finder);
    return finder.count();
  }
#endif
  for (size_t j = window.j0; j < window.j1; ++j)
    for (size_t i = window.i0; i < window.i1; i += hn::Lanes(kWide)) {
      size_t k = j * field.width + i;
      WideVec2 at{hn::LoadU(kWide, field.x + k), hn::LoadU(kWide, field.y + k)};
      M in_box = hn::And(box.contains(at), hn::FirstN(kWide, window.i1 - i));
      if (hn::AllFalse(kWide, in_box)) continue;
      finder.find(quad, at, in_box, hn::Iota(kIndices, static_cast<int32_t>(k)));
    }
  return finder.count();
}

size_t find_moving(const MovingQuad& q, bool both, const SampleField& field, const uint32_t* order,
                   size_t columns, const SampleWindow& window, QuadHit* hits) {
  WideBox box(q.low, q.high);
  const auto* lens = reinterpret_cast<const float*>(field.lens);
  V t0 = hn::Set(kWide, q.t0), t1 = hn::Set(kWide, q.t1), focus = hn::Set(kWide, field.focus),
    one = hn::Set(kWide, 1.0f);
  float rate = 1 / (q.t1 - q.t0);
  Finder finder(both, field.limit, hits);
  for (size_t j = window.j0; j < window.j1; ++j)
    for (size_t i = window.i0; i < window.i1; i += hn::Lanes(kWide)) {
      I samples = hn::LoadU(kIndices, reinterpret_cast<const int32_t*>(order) + j * columns + i);
      WideVec2 at{hn::GatherIndex(kWide, field.x, samples), hn::GatherIndex(kWide, field.y, samples)};
      M looked_at = hn::And(box.contains(at), hn::FirstN(kWide, window.i1 - i));
      if (hn::AllFalse(kWide, looked_at)) continue;
      V time = hn::GatherIndex(kWide, field.time, samples);
      looked_at = hn::And(looked_at, hn::And(hn::Ge(time, t0), hn::Lt(time, t1)));
      time = hn::Sub(time, t0);
      WideVec2 shift{hn::Zero(kWide), hn::Zero(kWide)};
      if (lens) {
        I pairs = hn::ShiftLeft<1>(samples);
        shift = {hn::GatherIndex(kWide, lens, pairs), hn::GatherIndex(kWide, lens + 1, pairs)};
      }
      WideVec2 corners[4];
      V depths[4];
      for (size_t c = 0; c < 4; ++c) {
        Vec3 from = q.from[c], speed = (q.to[c] - from) * rate;
        corners[c] = {hn::Add(hn::Set(kWide, from.x), hn::Mul(hn::Set(kWide, speed.x), time)),
                      hn::Add(hn::Set(kWide, from.y), hn::Mul(hn::Set(kWide, speed.y), time))};
        depths[c] = hn::Add(hn::Set(kWide, from.z), hn::Mul(hn::Set(kWide, speed.z), time));
        if (!lens) continue;
        V defocus = hn::Sub(focus, hn::Div(one, depths[c]));
        corners[c].x = hn::Add(corners[c].x, hn::Mul(shift.x, defocus));
        corners[c].y = hn::Add(corners[c].y, hn::Mul(shift.y, defocus));
      }
      finder.find(WideQuad(corners, depths), at, looked_at, samples);
    }
  return finder.count();
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
const auto kFindStill = SL_BEST(find_still);
const auto kFindMoving = SL_BEST(find_moving);

size_t quad_hits(const Vec3 (&p)[4], bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits) {
  return kFindStill(p, both, field, window, hits);
}

size_t moving_hits(const MovingQuad& quad, bool both, const SampleField& field, const uint32_t* order,
                   size_t columns, const SampleWindow& window, QuadHit* hits) {
  return kFindMoving(quad, both, field, order, columns, window, hits);
}

} // namespace render
#endif
