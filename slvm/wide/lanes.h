// The strip loop, written once: turns a function of wide values into a Kernel that runs over all lanes of
// operands.
//
//   Float smoothstep_fff(Float lo, Float hi, Float x);                        // result, then what is read
//   void fresnel_vvf(Float& kr, Float& kt, Vec3 i, Vec3 n, Float eta);        // references are stored only
//
// kernel_of<smoothstep_fff>() reads operands 1, 2, 3 and stores operand 0; the order is the one of operand.h.
// An inout parameter is the result (or a reference) and a parameter. A function that has the type of Kernel
// itself ("raw": arrays, any number of arguments, the context) is taken as it is.
#if defined(SLVM_WIDE_LANES_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SLVM_WIDE_LANES_H_
#undef SLVM_WIDE_LANES_H_
#else
#define SLVM_WIDE_LANES_H_
#endif

#include "slvm/wide/wide.h"

#include <algorithm>
#include <type_traits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- One vector's worth of a value, loaded from lane `lane` on or stored there. `first` is its first plane.
/// An operand ready for the loop over lanes.
struct Lanes {
  float* data;
  size_t pitch;
  /// Ands a lane of the call into the lane of the plane to load. Uniform operands (step 0) repeat their
  /// kMaxLanes equal values; a uniform call may store over them, so each vector reads the copies that only
  /// itself replaces.
  size_t wrap;

  HWY_INLINE Lanes(const Operand& o)
      : data(o.data), pitch(o.pitch), wrap((kMaxLanes - 1) | (size_t{0} - o.step)) {}
  HWY_INLINE float* plane(size_t i) const { return data + i * pitch; }
};

HWY_INLINE hn::Vec<FloatTag> load_plane(const Lanes& o, size_t plane, size_t lane) {
  return hn::Load(FloatTag(), o.plane(plane) + (lane & o.wrap));
}
HWY_INLINE void load(const Lanes& o, size_t lane, Float& value, size_t first = 0) {
  value.v = load_plane(o, first, lane);
}
HWY_INLINE void load(const Lanes& o, size_t lane, Bool& value) {
  value.m = hn::MaskFromVec(load_plane(o, 0, lane));
}
HWY_INLINE void load(const Lanes& o, size_t lane, Bits& value) {
  value.v = hn::BitCast(BitsTag(), load_plane(o, 0, lane));
}
HWY_INLINE void load(const Lanes& o, size_t lane, Vec3& value, size_t first = 0) {
  load(o, lane, value.x, first);
  load(o, lane, value.y, first + 1);
  load(o, lane, value.z, first + 2);
}
HWY_INLINE void load(const Lanes& o, size_t lane, Mat4& value) {
  for (size_t i = 0; i < 16; ++i)
    load(o, lane, value.m[i / 4][i % 4], i);
}

HWY_INLINE void store(const Lanes& o, size_t lane, Float value, size_t first = 0) {
  hn::Store(value.v, FloatTag(), o.plane(first) + lane);
}
HWY_INLINE void store(const Lanes& o, size_t lane, Bool value) {
  hn::Store(hn::VecFromMask(FloatTag(), value.m), FloatTag(), o.data + lane);
}
HWY_INLINE void store(const Lanes& o, size_t lane, Bits value) {
  store(o, lane, float_of_bits(value));
}
HWY_INLINE void store(const Lanes& o, size_t lane, Vec3 value) {
  store(o, lane, value.x, 0);
  store(o, lane, value.y, 1);
  store(o, lane, value.z, 2);
}
HWY_INLINE void store(const Lanes& o, size_t lane, const Mat4& value) {
  for (size_t i = 0; i < 16; ++i)
    store(o, lane, value.m[i / 4][i % 4], i);
}

template <class T> HWY_INLINE T loaded(const Lanes& o, size_t lane) {
  T value;
  load(o, lane, value);
  return value;
}

/// A parameter that is stored: a reference to non-const. Others are read: values and, for matrices, const
/// references.
template <class P>
inline constexpr bool kIsOutput =
    std::is_lvalue_reference_v<P> && !std::is_const_v<std::remove_reference_t<P>>;

/// The operand layout of a function of wide values.
template <class Function> struct Shape;
template <class R, class... A> struct Shape<R(A...)> {
  static constexpr bool kHasResult = !std::is_void_v<R>;
  static constexpr bool kOutput[sizeof...(A) + 1] = {kIsOutput<A>..., false};
  static constexpr size_t kStored = kHasResult + (size_t{kIsOutput<A>} + ... + 0);
  static constexpr size_t kOperands = kHasResult + sizeof...(A);

  /// Operand of parameter number `i`.
  static constexpr size_t operand_of(size_t i) {
    size_t at = kOutput[i] ? kHasResult : kStored;
    for (size_t k = 0; k < i; ++k)
      at += kOutput[k] == kOutput[i];
    return at;
  }

  template <size_t I> static constexpr size_t kOperandOf = operand_of(I);

  /// Calls visit.template operator()<T>(operand number) for the result and each parameter.
  template <class Visitor> static constexpr void visit_types(Visitor& visit) {
    if constexpr (kHasResult) visit.template operator()<R>(0);
    size_t i = 0;
    (visit.template operator()<std::remove_cvref_t<A>>(operand_of(i++)), ...);
  }

  /// What a parameter starts as: the loaded operand, or nothing for an output.
  template <class P> static HWY_INLINE std::remove_cvref_t<P> argument(const Lanes& o, size_t lane) {
    if constexpr (kIsOutput<P>)
      return {};
    else
      return loaded<std::remove_cvref_t<P>>(o, lane);
  }
  template <class P>
  static HWY_INLINE void put_output(const Lanes& o, size_t lane, const std::remove_cvref_t<P>& v) {
    if constexpr (kIsOutput<P>) store(o, lane, v);
  }

  template <auto kFunction, size_t... I>
  static HWY_INLINE void call(const Lanes* o, size_t lane, std::index_sequence<I...>,
                              std::remove_cvref_t<A>... arguments) {
    if constexpr (kHasResult)
      store(o[0], lane, kFunction(arguments...));
    else
      kFunction(arguments...);
    (put_output<A>(o[kOperandOf<I>], lane, arguments), ...);
  }
  // Lanes are a copy of the operands: vector stores may alias anything, and would have them read again for
  // each vector. Made member by member, it stays in registers.
  template <auto kFunction, size_t... O, size_t... I>
  static HWY_INLINE void strip(const Operand* operands, size_t begin, size_t end, std::index_sequence<O...>,
                               std::index_sequence<I...> parameters) {
    const Lanes o[] = {Lanes(operands[O])...};
    for (size_t lane = begin; lane < end; lane += kWidth)
      call<kFunction>(o, lane, parameters, argument<A>(o[kOperandOf<I>], lane)...);
  }
  template <auto kFunction>
  static HWY_FLATTEN void run(const Operand* operands, uint32_t, size_t lanes, const KernelContext& context) {
    strip<kFunction>(operands, context.begin, lanes, std::make_index_sequence<kOperands>(),
                     std::index_sequence_for<A...>());
  }
};

template <class Function> inline constexpr bool kIsRaw = std::is_same_v<Function*, Kernel>;

template <auto kFunction> constexpr Kernel kernel_of() {
  using Function = std::remove_pointer_t<decltype(kFunction)>;
  if constexpr (kIsRaw<Function>)
    return kFunction;
  else
    return &Shape<Function>::template run<kFunction>;
}

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();

#endif // per-target guard
