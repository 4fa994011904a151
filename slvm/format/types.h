// The types of the shading language and what each is made of. PUBLIC.
#pragma once

#include <cstdint>
#include <string_view>

namespace slvm {

/// kBool is the type of relations: it exists between operators and conditions, never in a variable.
enum class Type : uint8_t { kVoid, kBool, kFloat, kColor, kPoint, kVector, kNormal, kMatrix, kString };
inline constexpr int kTypeCount = 9;

enum class Detail : uint8_t { kUniform, kVarying };

enum class ShaderKind : uint8_t { kSurface, kDisplacement, kLight, kVolume, kImager };
inline constexpr int kShaderKindCount = 5;

/// Float planes (structure of arrays) one value occupies. A bool is one plane of all-ones or all-zero bit
/// patterns; a string is one plane holding the bits of its id in the machine's string table.
constexpr int components(Type t) {
  switch (t) {
  case Type::kVoid: return 0;
  case Type::kBool:
  case Type::kFloat:
  case Type::kString: return 1;
  case Type::kColor:
  case Type::kPoint:
  case Type::kVector:
  case Type::kNormal: return 3;
  case Type::kMatrix: return 16;
  }
  return 0;
}

constexpr bool is_triple(Type t) {
  return t == Type::kColor || t == Type::kPoint || t == Type::kVector || t == Type::kNormal;
}
/// point, vector or normal.
constexpr bool is_geometric(Type t) {
  return t == Type::kPoint || t == Type::kVector || t == Type::kNormal;
}

constexpr std::string_view type_name(Type t) {
  constexpr std::string_view kNames[kTypeCount] = {"void",   "bool",   "float",  "color", "point",
                                                   "vector", "normal", "matrix", "string"};
  return kNames[static_cast<int>(t)];
}
constexpr std::string_view shader_kind_name(ShaderKind k) {
  constexpr std::string_view kNames[kShaderKindCount] = {"surface", "displacement", "light", "volume",
                                                         "imager"};
  return kNames[static_cast<int>(k)];
}

} // namespace slvm
