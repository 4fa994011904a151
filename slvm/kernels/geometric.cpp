// Arithmetic of triples and the geometric functions (RISpec 3.2, 15.2). Colours are triples as well.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/geometric.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"
#include "slvm/wide/transcendental.h"

#include "slvm/kernels/rows.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- Operators
inline Vec3 add_vv(Vec3 a, Vec3 b) {
  return a + b;
}
inline Vec3 sub_vv(Vec3 a, Vec3 b) {
  return a - b;
}
inline Vec3 mul_vv(Vec3 a, Vec3 b) {
  return a * b;
}
inline Vec3 mul_vf(Vec3 a, Float b) {
  return a * b;
}
inline Vec3 mul_fv(Float a, Vec3 b) {
  return b * a;
}
inline Vec3 muladd_vvv(Vec3 a, Vec3 b, Vec3 c) {
  return a * b + c;
}
inline Vec3 muladd_vfv(Vec3 a, Float b, Vec3 c) {
  return a * b + c;
}
inline Vec3 div_vv(Vec3 a, Vec3 b) {
  return a / b;
}
inline Vec3 div_vf(Vec3 a, Float b) {
  return a / b;
}
inline Vec3 neg_v(Vec3 a) {
  return -a;
}
inline Float dot_vv(Vec3 a, Vec3 b) {
  return dot(a, b);
}
inline Vec3 cross_vv(Vec3 a, Vec3 b) {
  return cross(a, b);
}
// Without division: dot / (|axis| |direction|) >= cosine. A zero direction is inside.
inline Bool incone_vvf(Vec3 axis, Vec3 direction, Float cosine) {
  return dot(axis, direction) >= cosine * sqrt(dot(axis, axis) * dot(direction, direction));
}

// ---- Choice and blending, by component
inline Vec3 min_vv(Vec3 a, Vec3 b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
inline Vec3 max_vv(Vec3 a, Vec3 b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
inline Vec3 clamp_vvv(Vec3 a, Vec3 lo, Vec3 hi) {
  return {clamp(a.x, lo.x, hi.x), clamp(a.y, lo.y, hi.y), clamp(a.z, lo.z, hi.z)};
}
inline Vec3 mix_vvf(Vec3 a, Vec3 b, Float t) {
  return a * (1.0f - t) + b * t;
}
inline Vec3 mix_vvv(Vec3 a, Vec3 b, Vec3 t) {
  return a * (Vec3(1.0f) - t) + b * t;
}

// ---- Components
inline Float xcomp_v(Vec3 p) {
  return p.x;
}
inline Float ycomp_v(Vec3 p) {
  return p.y;
}
inline Float zcomp_v(Vec3 p) {
  return p.z;
}
inline Vec3 setxcomp_vf(Vec3 p, Float x) {
  return {x, p.y, p.z};
}
inline Vec3 setycomp_vf(Vec3 p, Float y) {
  return {p.x, y, p.z};
}
inline Vec3 setzcomp_vf(Vec3 p, Float z) {
  return {p.x, p.y, z};
}

/// Component i counted from 0, i truncated; outside 0..2 the answer is 0.
inline Float comp_vf(Vec3 p, Float i) {
  Float n = trunc(i);
  return keep_if(n == 0.0f, p.x) + keep_if(n == 1.0f, p.y) + keep_if(n == 2.0f, p.z);
}
inline Vec3 setcomp_vff(Vec3 p, Float i, Float value) {
  Float n = trunc(i);
  return {select(n == 0.0f, value, p.x), select(n == 1.0f, value, p.y), select(n == 2.0f, value, p.z)};
}

// ---- Lengths and distances
inline Float length_v(Vec3 v) {
  return length(v);
}
inline Vec3 normalize_v(Vec3 v) {
  return normalized(v);
}
inline Float distance_vv(Vec3 a, Vec3 b) {
  return length(a - b);
}

/// Distance of q to the segment from p0 to p1: to an end point where the foot of the perpendicular lies
/// outside.
inline Float ptlined_vvv(Vec3 p0, Vec3 p1, Vec3 q) {
  Vec3 axis = p1 - p0, from_start = q - p0;
  Float squared = dot(axis, axis);
  Float along = keep_if(squared > 0.0f, dot(from_start, axis) / squared);
  return length(from_start - axis * clamp(along, 0.0f, 1.0f));
}

/// q turned by `angle` about the axis from p0 to p1 (Rodrigues' formula); unmoved when the axis has no
/// direction.
inline Vec3 rotate_vfvv(Vec3 q, Float angle, Vec3 p0, Vec3 p1) {
  Vec3 axis = normalized(p1 - p0), arm = q - p0;
  Float c = cos(angle), s = sin(angle);
  Vec3 turned = arm * c + cross(axis, arm) * s + axis * (dot(axis, arm) * (1.0f - c));
  return select(dot(axis, axis) > 0.0f, p0 + turned, q);
}

// ---- Directions at a surface
inline Vec3 faceforward_vvv(Vec3 n, Vec3 i, Vec3 reference) {
  return select(dot(i, reference) > 0.0f, -n, n);
}
inline Vec3 reflect_vv(Vec3 i, Vec3 n) {
  return i - n * (2.0f * dot(i, n));
}

/// Snell's law for unit i and n; eta is the index outside over the index inside. 0 on total reflection.
inline Vec3 refract_vvf(Vec3 i, Vec3 n, Float eta) {
  Float d = dot(i, n);
  Float k = 1.0f - eta * eta * (1.0f - d * d);
  return keep_if(k >= 0.0f, i * eta - n * (eta * d + sqrt(k)));
}

/// Reflected part of unpolarised light at a dielectric (RISpec 3.2, 15.2; Cook and Torrance 1982),
/// transmitted the rest.
inline void fresnel_vvf(Float& kr, Float& kt, Vec3 i, Vec3 n, Float eta) {
  Float c = abs(dot(i, n)), e = 1.0f / eta;
  Float g_squared = e * e + c * c - 1.0f;
  Float g = sqrt(g_squared);
  Float a = (g - c) / (g + c);
  Float b = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
  Float reflected = clamp(0.5f * a * a * (1.0f + b * b), 0.0f, 1.0f);
  kr = select(g_squared > 0.0f, reflected, 1.0f);
  kt = 1.0f - kr;
}
inline void fresnel_vvf_rt(Float& kr, Float& kt, Vec3& r, Vec3& t, Vec3 i, Vec3 n, Float eta) {
  fresnel_vvf(kr, kt, i, n, eta);
  r = reflect_vv(i, n);
  t = refract_vvf(i, n, eta);
}

#define SL_FAMILY fill_geometric
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
