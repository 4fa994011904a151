// Noise (RISpec 3.2, 15.1): gradient noise after K. Perlin ("Improving Noise", 2002) with fade curve
// 6t^5-15t^4+10t^3, hence a continuous second derivative. Range [0, 1], mean 0.5, exactly 0.5 at lattice
// points. Not Perlin's are:
//   - lattice coordinates are hashed by integer arithmetic: no table, no gathers, no period of 256;
//   - each dimension has 32 gradients of unit length whose second and fourth moments are those of a sphere
//   (in 3-D the
//     vertices of a dodecahedron and an icosahedron), so that no direction is preferred;
//   - components of triples share the lattice work and differ in the byte of the hash they take their
//   gradient from.
// The arithmetic is not contracted: results are the same bits on every target. Coordinates beyond 2^30,
// infinite or NaN count as 0.
//
// This header is compiled once per SIMD target, for the kernels of noise.cpp and for whoever needs noise
// inside a loop of wide values of his own.
#if defined(SLVM_KERNELS_GRADIENT_NOISE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SLVM_KERNELS_GRADIENT_NOISE_H_
#undef SLVM_KERNELS_GRADIENT_NOISE_H_
#else
#define SLVM_KERNELS_GRADIENT_NOISE_H_
#endif

#include "slvm/wide/wide.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- Lattices
inline constexpr uint32_t kPrimes[4] = {0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du, 0x27d4eb2fu};
inline constexpr float kFarthest = 0x1p30f;

/// One coordinate: where the point lies between two lattice points, and what these contribute to hashes.
struct Coordinate {
  Float fraction; // in [0, 1)
  Bits below, above;
};

HWY_INLINE Float finite(Float x) {
  return keep_if(abs(x) < kFarthest, x);
}

template <int kAxis> HWY_INLINE Coordinate coordinate(Float x) {
  Float within = finite(x), below = floor(within);
  Bits hash = to_int(below) * Bits(kPrimes[kAxis]);
  return {within - below, hash, hash + Bits(kPrimes[kAxis])};
}

/// Periods are rounded to integers from 1 on.
template <int kAxis> HWY_INLINE Coordinate coordinate(Float x, Float period) {
  Float p = max(floor(finite(period) + 0.5f), 1.0f);
  Float within = finite(x), below = floor(within);
  Float wrapped = below - p * floor(below / p);
  wrapped = select(wrapped < 0.0f, wrapped + p, wrapped);
  wrapped = zero_if(wrapped >= p, wrapped);
  Float next = zero_if(wrapped + 1.0f >= p, wrapped + 1.0f);
  return {within - below, to_int(wrapped) * Bits(kPrimes[kAxis]), to_int(next) * Bits(kPrimes[kAxis])};
}

// ---- Gradients
/// Components of 16 directions in units of 1/127; their opposites are the other 16.
template <int kDimension> struct Gradients;
template <> struct Gradients<2> {
  static constexpr int8_t kComponent[2][16] = {
      {126, 122, 112, 98, 81, 60, 37, 12, -12, -37, -60, -81, -98, -112, -122, -126},
      {12, 37, 60, 81, 98, 112, 122, 126, 126, 122, 112, 98, 81, 60, 37, 12}};
};
template <> struct Gradients<3> {
  static constexpr int8_t kComponent[3][16] = {
      {73, 73, 73, 73, 0, 45, 119, 0, 108, 67, 0, 45, -119, 0, 108, -67},
      {73, 73, -73, -73, 45, 119, 0, 108, 67, 0, 45, -119, 0, 108, -67, 0},
      {73, -73, 73, -73, 119, 0, 45, 67, 0, 108, -119, 0, 45, -67, 0, 108}};
};
/// Permutations of (0.827, 0.325, 0.325, 0.325) with signs chosen so that mixed fourth moments vanish.
template <> struct Gradients<4> {
  static constexpr int8_t kComponent[4][16] = {
      {105, 105, 105, 105, 41, 41, 41, 41, 41, 41, 41, 41, 41, 41, 41, 41},
      {41, 41, -41, -41, 105, 105, -105, -105, 41, 41, -41, -41, 41, 41, -41, -41},
      {41, -41, 41, -41, 41, -41, 41, -41, 105, -105, 105, -105, 41, -41, 41, -41},
      {41, -41, -41, 41, 41, -41, -41, 41, -41, 41, 41, -41, -105, 105, 105, -105}};
};

/// What maps sums of gradient products to [0, 1]: n (1 + c - c n^2) / 2 + 1/2 with n the sum over kGreatest,
/// the most it can be (found by search over the cell; half the root of the dimension for ideal gradients),
/// and c > 0 where the extremes are so rare that contrast would suffer: the standard deviation is 0.13 to
/// 0.15 in all dimensions.
template <int kDimension> struct Range;
template <> struct Range<1> { static constexpr float kGreatest = 0.5f, kContrast = 0.0f; };
template <> struct Range<2> { static constexpr float kGreatest = 0.7072f, kContrast = 0.0f; };
template <> struct Range<3> { static constexpr float kGreatest = 0.8661f, kContrast = 0.25f; };
template <> struct Range<4> { static constexpr float kGreatest = 0.9f, kContrast = 0.5f; };

/// Entry (bits 24 to 27 of each lane) of a table, as an integer in the topmost byte, the lower ones 0.
HWY_INLINE Bits lookup(const int8_t (&table)[16], Bits entry) {
#if HWY_TARGET == HWY_SCALAR
  return Bits(static_cast<uint32_t>(static_cast<uint8_t>(table[entry.v.raw >> 24 & 15])) << 24);
#else
  hn::Repartition<uint8_t, BitsTag> bytes;
  auto everywhere = hn::LoadDup128(bytes, reinterpret_cast<const uint8_t*>(table));
  Bits index = (entry & Bits(0x0f000000u)) | Bits(0x00808080u);
  return hn::BitCast(BitsTag(), hn::TableLookupBytesOr0(everywhere, hn::BitCast(bytes, index.v)));
#endif
}

/// The product of the gradient that the topmost byte of `hash` chooses with the offset from its lattice
/// point, in units of 2^-24/127.
template <int kDimension> HWY_INLINE Float gradient_product(Bits hash, const Float (&offset)[kDimension]) {
  if constexpr (kDimension == 1)
    return from_int(hash & Bits(0xff000000u)) * (127.0f / 128.0f) * offset[0];
  else {
    using G = Gradients<kDimension>;
    Float sum = from_int(lookup(G::kComponent[0], hash)) * offset[0];
    for (int i = 1; i < kDimension; ++i)
      sum = sum + from_int(lookup(G::kComponent[i], hash)) * offset[i];
    return float_of_bits(bits_of(sum) ^ (hash & Bits(0x80000000u)));
  }
}

// ---- Gradient noise
template <int kComponents> struct Values { Float value[kComponents]; };

template <int kDimension, int kComponents> struct GradientNoise {
  using Result = Values<kComponents>;
  const Coordinate (&at)[kDimension];

  HWY_INLINE Result corner(Bits lattice_hash, const Float (&offset)[kDimension]) const {
    // One round: pairs of neighbouring gradients are independent to within 0.2 % of their probability.
    Bits hash = (lattice_hash ^ shift_right<15>(lattice_hash)) * Bits(0x735a2d97u);
    Result r;
    r.value[0] = gradient_product(hash, offset);
    if constexpr (kComponents == 3) {
      hash = hash ^ shift_right<13>(hash);
      r.value[1] = gradient_product(shift_left<8>(hash), offset);
      r.value[2] = gradient_product(shift_left<16>(hash), offset);
    }
    return r;
  }

  /// Interpolates between the lattice points of axes 0 to kAxis; those of the other axes are in `hash` and
  /// `offset`.
  template <int kAxis> HWY_INLINE Result along(Bits hash, Float (&offset)[kDimension]) const {
    if constexpr (kAxis < 0)
      return corner(hash, offset);
    else {
      const Coordinate& c = at[kAxis];
      offset[kAxis] = c.fraction;
      Result a = along<kAxis - 1>(hash ^ c.below, offset);
      offset[kAxis] = c.fraction - 1.0f;
      Result b = along<kAxis - 1>(hash ^ c.above, offset);
      Float t = c.fraction, fade = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
      for (int i = 0; i < kComponents; ++i)
        a.value[i] = a.value[i] + fade * (b.value[i] - a.value[i]);
      return a;
    }
  }

  HWY_INLINE Result evaluate() const {
    using R = Range<kDimension>;
    Float offset[kDimension];
    Result r = along<kDimension - 1>(Bits(0x51ed270bu * kDimension), offset);
    for (Float& value : r.value) {
      Float n = value * (0x1p-24f / (127.0f * R::kGreatest));
      if constexpr (R::kContrast > 0.0f) n = n * ((1.0f + R::kContrast) - R::kContrast * (n * n));
      value = 0.5f + 0.5f * n;
    }
    return r;
  }
};

template <int kDimension> HWY_INLINE Float float_noise(const Coordinate (&at)[kDimension]) {
  return GradientNoise<kDimension, 1>{at}.evaluate().value[0];
}
template <int kDimension> HWY_INLINE Vec3 triple_noise(const Coordinate (&at)[kDimension]) {
  Values<3> r = GradientNoise<kDimension, 3>{at}.evaluate();
  return {r.value[0], r.value[1], r.value[2]};
}

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();

#endif // per-target guard
