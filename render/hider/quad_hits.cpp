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

/// Samples in time, and what the lens does to each of them.
struct WideSample {
  V time;
  WideVec2 shift; ///< of what has a defocus of 1
  I numbers;
};

/// A micropolygon as each lane's sample sees it: at its time, through its point of the lens. kStill: it does
/// not move.
template <bool kStill> class MovingFinder {
public:
  HWY_INLINE MovingFinder(const MovingQuad& q, bool both, const SampleField& field, QuadHit* hits)
      : finder_(both, field.limit, hits), box_(q.low, q.high), q_(q), lens_(field.lens_x != nullptr),
        focus_(field.focus) {
    const float rate = 1 / (q.t1 - q.t0);
    for (size_t c = 0; c < 4; ++c) {
      speed_[c] = (q.to[c] - q.from[c]) * rate;
      defocus_[c] = focus_ - 1 / q.from[c].z;
    }
  }
  size_t count() const { return finder_.count(); }

  /// For samples at `at`; `fetch` gets the rest of them, where they may be in it.
  template <class Fetch> HWY_INLINE void look(const WideVec2& at, M looked_at, Fetch&& fetch) {
    looked_at = hn::And(box_.contains(at), looked_at);
    if (hn::AllFalse(kWide, looked_at)) return;
    WideSample sample;
    fetch(sample);
    const V t0 = hn::Set(kWide, q_.t0);
    looked_at =
        hn::And(looked_at, hn::And(hn::Ge(sample.time, t0), hn::Lt(sample.time, hn::Set(kWide, q_.t1))));
    const WideQuad quad = seen(sample, hn::Sub(sample.time, t0));
    finder_.add(quad, quad.cover(at, looked_at), sample.numbers);
  }

private:
  /// `time`: since t0.
  HWY_INLINE WideQuad seen(const WideSample& sample, V time) const {
    WideQuad quad;
    for (size_t c = 0; c < 4; ++c) {
      const Vec3 from = q_.from[c], speed = speed_[c];
      WideVec2& p = quad.p[c];
      p = {hn::Set(kWide, from.x), hn::Set(kWide, from.y)};
      quad.z[c] = hn::Set(kWide, from.z);
      if constexpr (!kStill) {
        p.x = hn::Add(p.x, hn::Mul(hn::Set(kWide, speed.x), time));
        p.y = hn::Add(p.y, hn::Mul(hn::Set(kWide, speed.y), time));
        quad.z[c] = hn::Add(quad.z[c], hn::Mul(hn::Set(kWide, speed.z), time));
      }
      if (!lens_) continue;
      V defocus = hn::Set(kWide, defocus_[c]);
      if constexpr (!kStill)
        defocus = hn::Sub(hn::Set(kWide, focus_), hn::Div(hn::Set(kWide, 1.0f), quad.z[c]));
      p.x = hn::Add(p.x, hn::Mul(sample.shift.x, defocus));
      p.y = hn::Add(p.y, hn::Mul(sample.shift.y, defocus));
    }
    return quad;
  }

  Finder finder_;
  WideBox box_;
  const MovingQuad& q_;
  bool lens_;
  Vec3 speed_[4];
  float defocus_[4]; ///< of what is still
  float focus_;
};

/// `numbers` tells those of samples.
template <bool kStill, class Numbers>
size_t find_moving(const MovingQuad& q, bool both, const SampleField& field, const SampleWindow& window,
                   QuadHit* hits, Numbers&& numbers) {
  MovingFinder<kStill> finder(q, both, field, hits);
  for_window(field.width, window, [&](const auto& rows, M in_window) HWY_ATTR {
    finder.look({rows.load(field.x), rows.load(field.y)}, in_window, [&](WideSample& sample) HWY_ATTR {
      sample.time = rows.load(field.time);
      sample.shift = {hn::Zero(kWide), hn::Zero(kWide)};
      if (field.lens_x) sample.shift = {rows.load(field.lens_x), rows.load(field.lens_y)};
      sample.numbers = numbers(rows);
    });
  });
  return finder.count();
}

size_t find_in_stratum(const MovingQuad& q, bool both, const StratumField& field, const SampleWindow& window,
                       QuadHit* hits) {
  auto numbers = [&](const auto& rows) HWY_ATTR {
    return hn::BitCast(kIndices, rows.load(reinterpret_cast<const float*>(field.numbers)));
  };
  return q.still() ? find_moving<true>(q, both, field, window, hits, numbers)
                   : find_moving<false>(q, both, field, window, hits, numbers);
}

size_t find_slow(const MovingQuad& q, bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits) {
  auto numbers = [](const auto& rows) HWY_ATTR { return rows.numbers(); };
  return q.still() ? find_moving<true>(q, both, field, window, hits, numbers)
                   : find_moving<false>(q, both, field, window, hits, numbers);
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
const auto kFindStill = SL_BEST(find_still);
const auto kFindInStratum = SL_BEST(find_in_stratum);
const auto kFindSlow = SL_BEST(find_slow);

size_t quad_hits(const Vec3 (&p)[4], bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits) {
  return kFindStill(p, both, field, window, hits);
}

size_t moving_hits(const MovingQuad& quad, bool both, const StratumField& field, const SampleWindow& window,
                   QuadHit* hits) {
  return kFindInStratum(quad, both, field, window, hits);
}

size_t slow_hits(const MovingQuad& quad, bool both, const SampleField& field, const SampleWindow& window,
                 QuadHit* hits) {
  return kFindSlow(quad, both, field, window, hits);
}

} // namespace render
#endif
