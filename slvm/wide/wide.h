// Wide values: one value of the shading language for each lane of a vector register. Kernels are written in
// them. This header is compiled once per SIMD target (Highway), hence the unusual guard. Read next: lanes.h.
//
// Float is a float, Bool a truth value, Bits 32 bits (hashes, string ids), Vec3 a triple, Mat4 a matrix.
// Plain arithmetic here is IEEE 754 single precision without contraction, so that its results are the same on
// every target.
#if defined(SLVM_WIDE_WIDE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SLVM_WIDE_WIDE_H_
#undef SLVM_WIDE_WIDE_H_
#else
#define SLVM_WIDE_WIDE_H_
#endif

#include "slvm/wide/operand.h"

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, kMaxLanes>;
using BitsTag = hn::RebindToUnsigned<FloatTag>;
using IntTag = hn::RebindToSigned<FloatTag>;
/// Lanes computed at once on this target.
inline constexpr size_t kWidth = hn::MaxLanes(FloatTag());
static_assert(kMaxLanes % kWidth == 0);

struct Bool {
  hn::Mask<FloatTag> m;
};

struct Float {
  hn::Vec<FloatTag> v;

  Float() = default;
  HWY_INLINE Float(hn::Vec<FloatTag> value) : v(value) {}
  HWY_INLINE Float(float value) : v(hn::Set(FloatTag(), value)) {}
};

struct Bits {
  hn::Vec<BitsTag> v;

  Bits() = default;
  HWY_INLINE Bits(hn::Vec<BitsTag> value) : v(value) {}
  HWY_INLINE Bits(uint32_t value) : v(hn::Set(BitsTag(), value)) {}
};

struct Vec3 {
  Float x, y, z;

  Vec3() = default;
  HWY_INLINE Vec3(Float all) : x(all), y(all), z(all) {}
  HWY_INLINE Vec3(Float x_, Float y_, Float z_) : x(x_), y(y_), z(z_) {}
};

/// Row-major; row vectors: a point is transformed as p * M.
struct Mat4 {
  Float m[4][4];
};

// ---- Float
HWY_INLINE Float operator+(Float a, Float b) {
  return hn::Add(a.v, b.v);
}
HWY_INLINE Float operator-(Float a, Float b) {
  return hn::Sub(a.v, b.v);
}
HWY_INLINE Float operator*(Float a, Float b) {
  return hn::Mul(a.v, b.v);
}
HWY_INLINE Float operator/(Float a, Float b) {
  return hn::Div(a.v, b.v);
}
HWY_INLINE Float operator-(Float a) {
  return hn::Neg(a.v);
}
HWY_INLINE Bool operator==(Float a, Float b) {
  return {hn::Eq(a.v, b.v)};
}
/// True for NaN, on every target: the instructions Ne stands for differ in that.
HWY_INLINE Bool operator!=(Float a, Float b) {
  return {hn::Not(hn::Eq(a.v, b.v))};
}
HWY_INLINE Bool operator<(Float a, Float b) {
  return {hn::Lt(a.v, b.v)};
}
HWY_INLINE Bool operator<=(Float a, Float b) {
  return {hn::Le(a.v, b.v)};
}
HWY_INLINE Bool operator>(Float a, Float b) {
  return {hn::Gt(a.v, b.v)};
}
HWY_INLINE Bool operator>=(Float a, Float b) {
  return {hn::Ge(a.v, b.v)};
}

// ---- Bool
HWY_INLINE Bool operator&(Bool a, Bool b) {
  return {hn::And(a.m, b.m)};
}
HWY_INLINE Bool operator|(Bool a, Bool b) {
  return {hn::Or(a.m, b.m)};
}
HWY_INLINE Bool operator!(Bool a) {
  return {hn::Not(a.m)};
}
HWY_INLINE Bool operator!=(Bool a, Bool b) {
  return {hn::Xor(a.m, b.m)};
}

/// a where c holds, else b.
HWY_INLINE Float select(Bool c, Float a, Float b) {
  return hn::IfThenElse(c.m, a.v, b.v);
}
/// a where c holds, else 0.
HWY_INLINE Float keep_if(Bool c, Float a) {
  return hn::IfThenElseZero(c.m, a.v);
}
/// 0 where c holds, else a.
HWY_INLINE Float zero_if(Bool c, Float a) {
  return hn::IfThenZeroElse(c.m, a.v);
}

/// 1 where c holds, else 0.
HWY_INLINE Float truth(Bool c) {
  return keep_if(c, 1.0f);
}

// ---- Functions of Float
/// b when b < a, else a: defined for NaN and signed zeros, unlike the instruction.
HWY_INLINE Float min(Float a, Float b) {
  return select(b < a, b, a);
}
/// b when b > a, else a.
HWY_INLINE Float max(Float a, Float b) {
  return select(b > a, b, a);
}
HWY_INLINE Float abs(Float a) {
  return hn::Abs(a.v);
}
HWY_INLINE Float floor(Float a) {
  return hn::Floor(a.v);
}
HWY_INLINE Float ceil(Float a) {
  return hn::Ceil(a.v);
}
HWY_INLINE Float trunc(Float a) {
  return hn::Trunc(a.v);
}
HWY_INLINE Float sqrt(Float a) {
  return hn::Sqrt(a.v);
}
/// lo if a < lo, else hi if a > hi, else a.
HWY_INLINE Float clamp(Float a, Float lo, Float hi) {
  return select(a < lo, lo, select(a > hi, hi, a));
}

// ---- Bits
HWY_INLINE Bits operator+(Bits a, Bits b) {
  return hn::Add(a.v, b.v);
}
HWY_INLINE Bits operator*(Bits a, Bits b) {
  return hn::Mul(a.v, b.v);
}
HWY_INLINE Bits operator^(Bits a, Bits b) {
  return hn::Xor(a.v, b.v);
}
HWY_INLINE Bits operator&(Bits a, Bits b) {
  return hn::And(a.v, b.v);
}
HWY_INLINE Bits operator|(Bits a, Bits b) {
  return hn::Or(a.v, b.v);
}
template <int kBits> HWY_INLINE Bits shift_right(Bits a) {
  return hn::ShiftRight<kBits>(a.v);
}
template <int kBits> HWY_INLINE Bits shift_left(Bits a) {
  return hn::ShiftLeft<kBits>(a.v);
}
HWY_INLINE Bool operator==(Bits a, Bits b) {
  return {hn::RebindMask(FloatTag(), hn::Eq(a.v, b.v))};
}
HWY_INLINE Bits select(Bool c, Bits a, Bits b) {
  return hn::IfThenElse(hn::RebindMask(BitsTag(), c.m), a.v, b.v);
}
HWY_INLINE Bits bits_of(Float a) {
  return hn::BitCast(BitsTag(), a.v);
}
HWY_INLINE Float float_of_bits(Bits a) {
  return hn::BitCast(FloatTag(), a.v);
}
/// Two's complement of a truncated to an integer; |a| < 2^31.
HWY_INLINE Bits to_int(Float a) {
  return hn::BitCast(BitsTag(), hn::ConvertTo(IntTag(), a.v));
}
/// The value of a two's complement integer.
HWY_INLINE Float from_int(Bits a) {
  return hn::ConvertTo(FloatTag(), hn::BitCast(IntTag(), a.v));
}

// ---- Vec3
HWY_INLINE Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vec3 operator*(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
HWY_INLINE Vec3 operator/(Vec3 a, Vec3 b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}
HWY_INLINE Vec3 operator*(Vec3 a, Float s) {
  return {a.x * s, a.y * s, a.z * s};
}
HWY_INLINE Vec3 operator/(Vec3 a, Float s) {
  return {a.x / s, a.y / s, a.z / s};
}
HWY_INLINE Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}
HWY_INLINE Vec3 select(Bool c, Vec3 a, Vec3 b) {
  return {select(c, a.x, b.x), select(c, a.y, b.y), select(c, a.z, b.z)};
}
HWY_INLINE Vec3 keep_if(Bool c, Vec3 a) {
  return {keep_if(c, a.x), keep_if(c, a.y), keep_if(c, a.z)};
}
HWY_INLINE Float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE Float length(Vec3 a) {
  return sqrt(dot(a, a));
}
/// a divided by its length; 0 stays 0.
HWY_INLINE Vec3 normalized(Vec3 a) {
  Float squared = dot(a, a);
  return select(squared > 0.0f, a * (1.0f / sqrt(squared)), a);
}

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();

#endif // per-target guard
