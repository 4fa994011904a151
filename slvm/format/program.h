// A compiled shader in memory: what a .slo file holds. PUBLIC. Shared contract of slc (which makes it) and
// slvm (which runs it). Read next: opcodes.def (the instructions), slo.h (file form), verify.h (what a loader
// may rely on).
#pragma once

#include "slvm/format/plugin_shadeop.h"
#include "slvm/format/shadeop_info.h"
#include "slvm/value.h"

#include <cstdint>
#include <string>
#include <vector>

namespace slvm {

/// Core instructions; shadeop calls are numbered from kFirstShadeop on.
enum class Opcode : uint16_t {
#define OPCODE(name, operands, flags, synopsis) k_##name,
#include "slvm/format/opcodes.def"
#undef OPCODE
  kCount
};
inline constexpr uint16_t kFirstShadeop = 64;
static_assert(static_cast<int>(Opcode::kCount) <= kFirstShadeop);

enum OpcodeFlags : uint8_t { kGridOnly = 1, kOpen = 2, kMiddle = 4, kClose = 8, kLoops = 16 };

struct OpcodeInfo {
  std::string_view name, operands;
  uint8_t flags;
  std::string_view synopsis;
};
const OpcodeInfo& opcode_info(Opcode);

/// Where a register lives. A register operand is one word: space in the top 3 bits, index of its first plane
/// below.
enum class Space : uint8_t {
  kConstant, ///< the program's constants: uniform, never stored to
  kUniform,  ///< one value
  kStrip,    ///< varying, within one strip block
  kGrid,     ///< varying, the whole grid
  kSlot,     ///< an external variable: index of the slot
  kArray,    ///< an array: index into Program::arrays
};
inline constexpr int kSpaceCount = 6;
constexpr uint32_t make_operand(Space space, uint32_t index) {
  return static_cast<uint32_t>(space) << 29 | index;
}
constexpr Space operand_space(uint32_t word) {
  return static_cast<Space>(word >> 29);
}
constexpr uint32_t operand_index(uint32_t word) {
  return word & 0x1fffffffu;
}

/// An external variable: a predefined one, or a parameter.
struct Slot {
  std::string name;
  Type type = Type::kFloat;
  uint32_t elements = 0; ///< array length; 0: not an array
  bool parameter = false;
  bool varying = false;
  bool stored = false; ///< the program stores to it
  bool operator==(const Slot&) const = default;
};

struct Param {
  std::string name;
  Type type = Type::kFloat;
  uint32_t elements = 0;
  bool varying = false;
  bool output = false;
  /// The default as written, when it is a constant: in space `default_space` ("" where the type has none).
  bool default_known = false;
  Value default_value;
  std::string default_space;
  /// Slot of this parameter, or -1: the program does not use it.
  int32_t slot = -1;
  /// Code section that computes the default and stores it to the slot, or -1: the default is default_value as
  /// it is.
  int32_t init = -1;
  bool operator==(const Param&) const = default;
};

/// A local array, or (slot >= 0) an external one.
struct ArrayInfo {
  Type type = Type::kFloat;
  uint32_t elements = 0;
  Space space = Space::kUniform; ///< kUniform, kGrid or kSlot
  uint32_t index = 0;            ///< first plane, or the slot
  bool operator==(const ArrayInfo&) const = default;
};

/// From `code` on, instructions belong to this source position.
struct LineEntry {
  uint32_t code = 0;
  uint32_t file = 0; ///< index into Program::files
  uint32_t line = 0, column = 0;
  bool operator==(const LineEntry&) const = default;
};

struct Annotation {
  std::string id, text;
  bool operator==(const Annotation&) const = default;
};

/// A call of a built-in in the source, of which code is left. Built-ins with RSL bodies are inlined: the code
/// does not show them.
struct SourceCall {
  ShadeopId shadeop = 0;
  uint32_t file = 0; ///< index into Program::files
  uint32_t line = 0, column = 0;
  bool operator==(const SourceCall&) const = default;
};

/// A file the shader was made from, by the name under which the compiler found it.
struct SourceFile {
  std::string name;
  uint64_t hash = 0; ///< FNV-1a of its contents
  bool operator==(const SourceFile&) const = default;
};

/// What introspection tells about a shader beside its parameters.
struct Facts {
  bool derivatives = false, lights = false, textures = false, rays = false;
  std::vector<std::string> messages_read; ///< "surface:name", "lightsource:name"...
  std::vector<std::string> texture_names; ///< constant ones
  std::vector<std::string> shadeops;      ///< names of the built-ins called, sorted
  std::vector<std::string> plugins;       ///< DSO shadeops' libraries
  std::vector<SourceCall> calls;          ///< in the order of the code
  bool operator==(const Facts&) const = default;
};

struct Program {
  ShaderKind kind = ShaderKind::kSurface;
  std::string name;
  std::string source_name;
  uint64_t source_hash = 0; ///< FNV-1a of the preprocessed text
  /// The main file, then those it includes, without the headers built into the compiler: what stale.h
  /// compares. Empty in files of older compilers.
  std::vector<SourceFile> sources;
  std::string compiler; ///< name and version of what made it, "" if unknown
  std::vector<Annotation> annotations;
  std::vector<Param> params;
  Facts facts;

  std::vector<ShadeopId> imports; ///< in files by name and signature
  PluginShadeops plugins;         ///< functions of plug-ins among imports and facts.calls
  std::vector<Slot> slots;
  std::vector<float> constants;     ///< one a plane
  std::vector<std::string> strings; ///< constant strings
  /// Planes of `constants` that stand for strings: plane index, and index into strings.
  std::vector<std::pair<uint32_t, uint32_t>> string_constants;
  std::vector<ArrayInfo> arrays;
  uint32_t uniform_planes = 0, strip_planes = 0, grid_planes = 0;
  uint32_t mask_depth = 0; ///< deepest nesting of regions that change the mask

  std::vector<uint32_t> code;
  std::vector<uint32_t>
      sections; ///< where code sections begin: 0 the shader, then the defaults of parameters
  std::vector<std::string> files;
  std::vector<LineEntry> lines;

  /// The optimised IR, serialised (slvm/ir/serialise.h): specialisation starts from it.
  std::vector<uint8_t> ir;

  bool operator==(const Program&) const = default;
};

} // namespace slvm
