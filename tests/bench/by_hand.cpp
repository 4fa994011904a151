// Compiled once for each SIMD target and dispatched at run time, as the kernels are.
#include "tests/bench/by_hand.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/by_hand.cpp"
#include <hwy/foreach_target.h>

#include "slvm/kernels/gradient_noise.h"
#include "slvm/wide/targets.h"
#include "slvm/wide/transcendental.h"
#include "slvm/wide/wide.h"

HWY_BEFORE_NAMESPACE();
namespace bench {
namespace HWY_NAMESPACE {

using namespace slvm::HWY_NAMESPACE;

HWY_INLINE Float load(const float* plane, size_t at) {
  return hn::Load(FloatTag(), plane + at);
}
HWY_INLINE Vec3 load(const float* const (&planes)[3], size_t at) {
  return {load(planes[0], at), load(planes[1], at), load(planes[2], at)};
}
HWY_INLINE void store(const Points& points, size_t at, Vec3 colour) {
  hn::Store(colour.x.v, FloatTag(), points.ci[0] + at);
  hn::Store(colour.y.v, FloatTag(), points.ci[1] + at);
  hn::Store(colour.z.v, FloatTag(), points.ci[2] + at);
}
HWY_INLINE Vec3 triple(const float (&x)[3]) {
  return {Float(x[0]), Float(x[1]), Float(x[2])};
}

HWY_INLINE Float noise(Vec3 p) {
  return float_noise({coordinate<0>(p.x), coordinate<1>(p.y), coordinate<2>(p.z)});
}

// ---- plastic: diffuse and specular in one loop over the lights.
struct Lit {
  Float diffuse, specular; // all lights are white
};

HWY_INLINE void add_light(Lit& sum, Vec3 to_light, Float intensity, Vec3 n, Vec3 v) {
  Vec3 l = normalized(to_light);
  Float cosine = dot(l, n);
  Bool lit = cosine >= 0.0f;
  Float highlight = pow(max(0.0f, dot(n, normalized(l + v))), 80.0f);
  sum.diffuse = sum.diffuse + keep_if(lit, intensity * cosine);
  sum.specular = sum.specular + keep_if(lit, intensity * highlight);
}

HWY_FLATTEN void plastic(const Points& points, const Lights& lights) {
  Vec3 from = triple(lights.point_from), towards = -triple(lights.direction);
  for (size_t at = 0; at < points.count; at += kWidth) {
    Vec3 p = load(points.p, at), i = load(points.i, at), n = normalized(load(points.n, at));
    n = select(dot(i, n) > 0.0f, -n, n);
    Vec3 v = -normalized(i), arm = from - p;
    Lit sum{Float(0.0f), Float(0.0f)};
    add_light(sum, arm, Float(lights.point_intensity) / dot(arm, arm), n, v);
    add_light(sum, towards, lights.distant_intensity, n, v);
    store(points, at, Vec3(0.5f * sum.diffuse + 0.5f * sum.specular));
  }
}

// ---- fbm
HWY_FLATTEN void fbm(const Points& points) {
  for (size_t at = 0; at < points.count; at += kWidth) {
    Vec3 p = load(points.p, at) * 4.0f;
    Float sum = 0.0f, amplitude = 1.0f;
    for (int octave = 0; octave < 6; ++octave) {
      sum = sum + amplitude * (2.0f * noise(p) - 1.0f);
      p = p * 2.0f;
      amplitude = amplitude * 0.5f;
    }
    store(points, at, Vec3(0.5f + 0.5f * sum));
  }
}

// ---- marble: the ramp by gathers from a table of knots.
HWY_ALIGN constexpr float kRamp[3][16] = {
    {0.10f, 0.10f, 0.22f, 0.40f, 0.62f, 0.70f, 0.78f, 0.82f, 0.86f, 0.90f, 0.93f, 0.96f, 0.96f},
    {0.10f, 0.10f, 0.21f, 0.38f, 0.60f, 0.68f, 0.76f, 0.80f, 0.85f, 0.89f, 0.92f, 0.96f, 0.96f},
    {0.14f, 0.14f, 0.26f, 0.42f, 0.60f, 0.66f, 0.73f, 0.77f, 0.82f, 0.87f, 0.91f, 0.95f, 0.95f}};

HWY_INLINE Vec3 ramp(Float x) {
  constexpr float kSegments = 10;
  Float along = x * kSegments, segment = min(floor(along), kSegments - 1), t = along - segment;
  auto first = hn::ConvertTo(IntTag(), segment.v);
  Float weight[4] = {((-0.5f * t + 1.0f) * t - 0.5f) * t, (1.5f * t - 2.5f) * t * t + 1.0f,
                     ((-1.5f * t + 2.0f) * t + 0.5f) * t, (0.5f * t - 0.5f) * t * t};
  Float result[3];
  for (int c = 0; c < 3; ++c) {
    result[c] = 0.0f;
    for (int k = 0; k < 4; ++k)
      result[c] = result[c] + weight[k] * Float(hn::GatherIndex(FloatTag(), kRamp[c] + k, first));
  }
  return {result[0], result[1], result[2]};
}

HWY_FLATTEN void marble(const Points& points) {
  for (size_t at = 0; at < points.count; at += kWidth) {
    Vec3 p = load(points.p, at) * 3.0f;
    Float turbulence = 0.0f;
    float scale = 1;
    for (int octave = 0; octave < 4; ++octave, scale *= 2)
      turbulence = turbulence + abs(2.0f * noise(p * scale) - 1.0f) * (1.0f / scale);
    store(points, at, ramp(clamp(turbulence, 0.0f, 1.0f)));
  }
}

// ---- divergent: rounds until no lane of the vector is left; the other branch only where some lane takes it.
HWY_INLINE Float rounds(Bool active, Float s, Float t) {
  Float x = 0.0f, y = 0.0f, count = 0.0f;
  Float cx = 3.0f * s - 2.2f, cy = 2.4f * t - 1.2f;
  for (int round = 0; round < 24; ++round) {
    active = active & (x * x + y * y < 4.0f);
    if (hn::AllFalse(FloatTag(), active.m)) break;
    Float next = x * x - y * y + cx;
    y = select(active, 2.0f * x * y + cy, y);
    x = select(active, next, x);
    count = count + truth(active);
  }
  return count;
}

HWY_FLATTEN void divergent(const Points& points) {
  for (size_t at = 0; at < points.count; at += kWidth) {
    Float s = load(points.s, at), t = load(points.t, at);
    Bool inner = noise(load(points.p, at) * 4.0f) > 0.5f;
    Float shade = rounds(inner, s, t) * (1.0f / 24);
    if (!hn::AllTrue(FloatTag(), inner.m))
      shade = select(inner, shade, 0.5f + 0.5f * sin(20.0f * s) * cos(20.0f * t));
    store(points, at, {shade, shade * shade, 1.0f - shade});
  }
}

} // namespace HWY_NAMESPACE
} // namespace bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bench {

const auto kPlastic = SL_BEST(plastic);
const auto kFbm = SL_BEST(fbm);
const auto kMarble = SL_BEST(marble);
const auto kDivergent = SL_BEST(divergent);

void plastic_by_hand(const Points& points, const Lights& lights) {
  kPlastic(points, lights);
}
void fbm_by_hand(const Points& points) {
  kFbm(points);
}
void marble_by_hand(const Points& points) {
  kMarble(points);
}
void divergent_by_hand(const Points& points) {
  kDivergent(points);
}

} // namespace bench
#endif
