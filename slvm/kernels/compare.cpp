// Relations, logic, choice and conversions: kernels that make or use truth values, or only move values.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/compare.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"

#include "slvm/kernels/rows.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- Relations. NaN is unequal to everything.
inline Bool eq_ff(Float a, Float b) {
  return a == b;
}
inline Bool ne_ff(Float a, Float b) {
  return a != b;
}
inline Bool lt_ff(Float a, Float b) {
  return a < b;
}
inline Bool le_ff(Float a, Float b) {
  return a <= b;
}
inline Bool gt_ff(Float a, Float b) {
  return a > b;
}
inline Bool ge_ff(Float a, Float b) {
  return a >= b;
}
inline Bool eq_vv(Vec3 a, Vec3 b) {
  return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
}
inline Bool ne_vv(Vec3 a, Vec3 b) {
  return !eq_vv(a, b);
}
inline Bool eq_ss(Bits a, Bits b) {
  return a == b;
}
inline Bool ne_ss(Bits a, Bits b) {
  return !(a == b);
}

inline Bool eq_mm(const Mat4& a, const Mat4& b) {
  Bool equal = a.m[0][0] == b.m[0][0];
  for (int i = 1; i < 16; ++i)
    equal = equal & (a.m[i / 4][i % 4] == b.m[i / 4][i % 4]);
  return equal;
}
inline Bool ne_mm(const Mat4& a, const Mat4& b) {
  return !eq_mm(a, b);
}

// ---- Logic
inline Bool and_bb(Bool a, Bool b) {
  return a & b;
}
inline Bool or_bb(Bool a, Bool b) {
  return a | b;
}
inline Bool not_b(Bool a) {
  return !a;
}

// ---- Choice
inline Float select_f(Bool c, Float a, Float b) {
  return select(c, a, b);
}
inline Vec3 select_v(Bool c, Vec3 a, Vec3 b) {
  return select(c, a, b);
}
inline Bits select_s(Bool c, Bits a, Bits b) {
  return select(c, a, b);
}
inline Bool select_b(Bool c, Bool a, Bool b) {
  return (c & a) | ((!c) & b);
}
inline Mat4 select_m(Bool c, const Mat4& a, const Mat4& b) {
  Mat4 r;
  for (int i = 0; i < 16; ++i)
    r.m[i / 4][i % 4] = select(c, a.m[i / 4][i % 4], b.m[i / 4][i % 4]);
  return r;
}

// ---- Conversions and construction
inline Float truth_f(Bool b) {
  return truth(b);
}
inline Bool nonzero_b(Float x) {
  return x != 0.0f;
}
inline Vec3 splat_v(Float x) {
  return x;
}
inline Vec3 triple_v(Float a, Float b, Float c) {
  return {a, b, c};
}

/// Raw: the number of elements, which the operand knows.
inline void arraylength_a(const Operand* operands, uint32_t, size_t lanes, const KernelContext&) {
  for (size_t lane = 0; lane < lanes; lane += kWidth)
    store(operands[0], lane, Float(static_cast<float>(operands[1].elements)));
}

#define SL_FAMILY fill_compare
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
