// Sets of types, and what converts to what at which cost. An expression whose type depends on its context (a
// call of an overloaded function, a bare triple) has a set of possible types until the context picks one.
#pragma once

#include "slvm/format/types.h"

#include <cstdint>

namespace slc {

using slvm::Type;

/// A set of types, one bit each.
class TypeSet {
public:
  constexpr TypeSet() = default;
  constexpr TypeSet(Type t) : bits_(bit(t)) {}
  /// The set of an expression with an error in it: it fits everywhere, so that nothing more is reported.
  static constexpr TypeSet error() {
    TypeSet s;
    s.bits_ = kErrorBit;
    return s;
  }
  static constexpr TypeSet triples() {
    TypeSet s(Type::kColor);
    for (Type t : {Type::kPoint, Type::kVector, Type::kNormal})
      s.add(t);
    return s;
  }

  constexpr void add(Type t) { bits_ |= bit(t); }
  constexpr bool has(Type t) const { return (bits_ & bit(t)) != 0; }
  constexpr bool is_error() const { return (bits_ & kErrorBit) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool single() const { return bits_ != 0 && (bits_ & (bits_ - 1)) == 0; }
  constexpr bool only(Type t) const { return bits_ == bit(t); }
  /// What is taken when nothing chooses: float if possible, else point, else the first.
  constexpr Type preferred() const {
    if (has(Type::kFloat)) return Type::kFloat;
    if (has(Type::kPoint)) return Type::kPoint;
    for (int i = 0; i < slvm::kTypeCount; ++i)
      if (has(static_cast<Type>(i))) return static_cast<Type>(i);
    return Type::kVoid;
  }

private:
  static constexpr uint32_t bit(Type t) { return 1u << static_cast<unsigned>(t); }
  static constexpr uint32_t kErrorBit = 1u << 31;
  uint32_t bits_ = 0;
};

/// Cost of an impossible conversion; sums of it stay in range.
inline constexpr int kImpossible = 10000;

/// Cost of the implicit conversion: 0 none, 1 among point, vector and normal, 2 float to a triple or matrix,
/// 3 between bool and float.
constexpr int conversion_cost(Type from, Type to) {
  if (from == to) return 0;
  if (slvm::is_geometric(from) && slvm::is_geometric(to)) return 1;
  if (from == Type::kFloat && (slvm::is_triple(to) || to == Type::kMatrix)) return 2;
  if ((from == Type::kBool && to == Type::kFloat) || (from == Type::kFloat && to == Type::kBool)) return 3;
  return kImpossible;
}

/// The cheapest conversion from any member of the set.
constexpr int conversion_cost(TypeSet from, Type to) {
  if (from.is_error()) return 0;
  int best = kImpossible;
  for (int i = 0; i < slvm::kTypeCount; ++i)
    if (from.has(static_cast<Type>(i))) {
      int cost = conversion_cost(static_cast<Type>(i), to);
      if (cost < best) best = cost;
    }
  return best;
}

} // namespace slc
