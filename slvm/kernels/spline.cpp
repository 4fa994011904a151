// spline() (RISpec 3.2, 15.1) for any basis and number of knots, the knots as arguments or in an array. These
// kernels are raw: lanes fall into different segments. Knots that are the same in all lanes, as most are,
// give a table of each segment's coefficients; of varying ones each lane collects its own four.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/spline.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"

#include "slvm/kernels/rows.h"
#include "slvm/kernels/spline_basis.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

/// The operands from `first` on: one array, or one knot each.
struct Knots {
  const Operand* first;
  uint32_t operands;
  uint32_t most = ~0u; ///< how many count

  uint32_t count() const { return std::min(operands == 1 ? first->elements : operands, most); }
  bool uniform() const {
    return std::all_of(first, first + operands, [](const Operand& o) { return o.step == 0; });
  }
  float value(uint32_t knot, size_t component, size_t components, size_t lane) const {
    const Operand& o = operands == 1 ? *first : first[knot];
    size_t element = operands == 1 ? knot : 0;
    return o.plane(element * components + component)[lane & Lanes(o).wrap];
  }
};

/// Coefficients of t^3, t^2, t and 1 of one component in one segment.
template <class T> struct Cubic {
  T coefficient[4];

  HWY_INLINE Cubic() = default;
  HWY_INLINE Cubic(const SplineBasis& basis, const T (&knot)[4]) {
    for (int p = 0; p < 4; ++p) {
      const float(&row)[4] = basis.matrix[p];
      coefficient[p] = knot[0] * row[0] + knot[1] * row[1] + knot[2] * row[2] + knot[3] * row[3];
    }
  }
  HWY_INLINE T at(T t) const {
    return ((coefficient[0] * t + coefficient[1]) * t + coefficient[2]) * t + coefficient[3];
  }
};

template <size_t kComponents> class Spline {
public:
  Spline(const SplineBasis& basis, Knots knots)
      : basis_(basis), knots_(knots), segments_(basis.segments(knots.count())),
        use_table_(segments_ <= kMostInTable && knots.uniform()) {
    if (use_table_) fill_table();
  }

  void run(const Operand& result, const Operand& x, size_t begin, size_t lanes) const {
    for (size_t lane = begin; lane < lanes; lane += kWidth) {
      Float along = loaded<Float>(x, lane);
      Point r = basis_.solve ? solved(along, lane) : at(along, lane);
      for (size_t c = 0; c < kComponents; ++c)
        store(result, lane, r.value[c], c);
    }
  }

private:
  struct Point {
    Float value[kComponents];
  };

  /// The spline at x, clamped to [0, 1], for the lanes from `lane` on. 0 with less than four knots.
  HWY_INLINE Point at(Float x, size_t lane) const {
    if (segments_ == 0) return zero();
    Float along = keep_if(x > 0.0f, min(x, 1.0f)) * static_cast<float>(segments_);
    Float segment = min(floor(along), static_cast<float>(segments_ - 1));
    Point r;
    for (size_t c = 0; c < kComponents; ++c)
      r.value[c] = (use_table_ ? looked_up(to_int(segment), c) : collected(to_int(segment), c, lane))
                       .at(along - segment);
    return r;
  }

  void fill_table() {
    for (uint32_t segment = 0; segment < segments_; ++segment)
      for (size_t c = 0; c < kComponents; ++c) {
        float knot[4];
        for (uint32_t k = 0; k < 4; ++k)
          knot[k] = knots_.value(segment * basis_.step + k, c, kComponents, 0);
        Cubic<float> cubic(basis_, knot);
        for (size_t p = 0; p < 4; ++p)
          table_[c][p][segment] = cubic.coefficient[p];
      }
  }

  HWY_INLINE Cubic<Float> looked_up(Bits segment, size_t component) const {
    Cubic<Float> cubic;
    auto index = hn::BitCast(IntTag(), segment.v);
    for (size_t p = 0; p < 4; ++p) {
      const float* row = table_[component][p];
      if (segments_ <= kWidth)
        cubic.coefficient[p] =
            hn::TableLookupLanes(hn::Load(FloatTag(), row), hn::IndicesFromVec(FloatTag(), index));
      else
        cubic.coefficient[p] = hn::GatherIndex(FloatTag(), row, index);
    }
    return cubic;
  }

  HWY_INLINE Cubic<Float> collected(Bits segment, size_t component, size_t lane) const {
    HWY_ALIGN uint32_t first_knot[kWidth];
    hn::Store((segment * Bits(basis_.step)).v, BitsTag(), first_knot);
    HWY_ALIGN float values[4][kWidth];
    for (size_t i = 0; i < kWidth; ++i)
      for (uint32_t k = 0; k < 4; ++k)
        values[k][i] = knots_.value(first_knot[i] + k, component, kComponents, lane + i);
    Float knot[4];
    for (int k = 0; k < 4; ++k)
      knot[k] = hn::Load(FloatTag(), values[k]);
    return Cubic<Float>(basis_, knot);
  }

  /// The x in [0, 1] where a monotonic spline has the value y, by bisection to 2^-25.
  HWY_INLINE Point solved(Float y, size_t lane) const {
    if (segments_ == 0) return zero();
    constexpr int kSteps = 25;
    Float low = 0.0f, high = 1.0f;
    Bool rising = at(0.0f, lane).value[0] <= at(1.0f, lane).value[0];
    for (int i = 0; i < kSteps; ++i) {
      Float middle = 0.5f * (low + high), value = at(middle, lane).value[0];
      Bool right = (rising & (value < y)) | ((!rising) & (value > y));
      low = select(right, middle, low);
      high = select(right, high, middle);
    }
    Point r = zero();
    r.value[0] = 0.5f * (low + high);
    return r;
  }

  static HWY_INLINE Point zero() {
    Point r;
    for (Float& value : r.value)
      value = 0.0f;
    return r;
  }

  static constexpr uint32_t kMostInTable = 64;

  SplineBasis basis_;
  Knots knots_;
  uint32_t segments_;
  bool use_table_;
  HWY_ALIGN float table_[kComponents][4][kMostInTable] = {};
};

inline void spline_f(const Operand* o, uint32_t count, size_t lanes, const KernelContext& context) {
  Spline<1>(kCatmullRom, {o + 2, count - 2}).run(o[0], o[1], context.begin, lanes);
}
inline void spline_v(const Operand* o, uint32_t count, size_t lanes, const KernelContext& context) {
  Spline<3>(kCatmullRom, {o + 2, count - 2}).run(o[0], o[1], context.begin, lanes);
}
inline void basisspline_f(const Operand* o, uint32_t count, size_t lanes, const KernelContext& context) {
  SplineBasis basis = spline_basis(string_operand(o[1], context));
  Spline<1>(basis, {o + 3, count - 3}).run(o[0], o[2], context.begin, lanes);
}
/// Triples have no inverse: "solve" is ignored.
inline void basisspline_v(const Operand* o, uint32_t count, size_t lanes, const KernelContext& context) {
  SplineBasis basis = spline_basis(string_operand(o[1], context));
  basis.solve = false;
  Spline<3>(basis, {o + 3, count - 3}).run(o[0], o[2], context.begin, lanes);
}

/// The first n of an array's knots, n a uniform operand.
inline Knots first_knots(const Operand& n, const Operand* array) {
  const float count = *n.data;
  return {array, 1, count >= 1 ? static_cast<uint32_t>(std::min(count, 1e9f)) : 0};
}
inline void countspline_f(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  Spline<1>(kCatmullRom, first_knots(o[2], o + 3)).run(o[0], o[1], context.begin, lanes);
}
inline void countspline_v(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  Spline<3>(kCatmullRom, first_knots(o[2], o + 3)).run(o[0], o[1], context.begin, lanes);
}
inline void basiscountspline_f(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  SplineBasis basis = spline_basis(string_operand(o[1], context));
  Spline<1>(basis, first_knots(o[3], o + 4)).run(o[0], o[2], context.begin, lanes);
}
inline void basiscountspline_v(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  SplineBasis basis = spline_basis(string_operand(o[1], context));
  basis.solve = false;
  Spline<3>(basis, first_knots(o[3], o + 4)).run(o[0], o[2], context.begin, lanes);
}

#define SL_FAMILY fill_spline
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
