// The rows of shadeops.def and tokens.def as data: overloads, flags, documentation. No kernels. PUBLIC.
// Semantic analysis, code generation, the verifier, the VM's kernel tables, sloinfo and the manual all read
// this.
#pragma once

#include "slvm/format/signature.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace slvm {

/// How a shadeop is carried out.
enum class ShadeopKind : uint8_t {
  kKernel,  ///< a SIMD kernel, run strip by strip; pure
  kGrid,    ///< a function over the whole grid (a barrier): derivatives, services, messages, printing
  kRsl,     ///< an RSL body in stdlib/builtins, inlined by slc; never appears in compiled code
  kPending, ///< known to the language and type-checked; binding a shader that still calls it is an error
            ///< naming it, or its results are 0 (MachineOptions::zero_for_unserved)
  kPlugin,  ///< a function of a plug-in, no row of the table: slvm/format/plugin_shadeop.h
};

/// Properties, or-ed in the flags column.
enum ShadeopFlags : uint32_t {
  kPure = 0,                ///< depends on its arguments only (default)
  kHiddenVarying = 1u << 0, ///< what it stores is varying even when all arguments are uniform (random, Du,
                            ///< messages); not a result declared uniform, nor strings
  kDerivative = 1u << 1,    ///< differentiates its first varying arguments along u and v
  kEffect = 1u << 2, ///< must be executed, in order, exactly where it stands (printf, messages that store)
  kReadsState = 1u << 3,    ///< reads state that effects may change: not merged across them
  kLights = 1u << 4,        ///< runs light shaders
  kFoldLeft = 1u << 5,      ///< f(a,b,c) means f(f(a,b),c): variadic in the language, binary in the kernel
  kInternal = 1u << 6,      ///< not callable from source: an operator, or a helper of an RSL body
  kNoFold = 1u << 7,        ///< never folded to a constant at compile time
  kSurfaceOnly = 1u << 8,   ///< not legal in light shaders
  kInIlluminance = 1u << 9, ///< legal inside an illuminance loop only
  kRays = 1u << 10,         ///< traces rays
  kTexture = 1u << 11,      ///< reads texture, environment or shadow maps
  kContextOut = 1u << 12,   ///< outputs keep their old value where the call finds nothing
  kMessage = 1u << 13,      ///< asks another shader for its parameter
  kTokenOut = 1u << 14,     ///< token-value pairs may name variables that are set: results behind the others
  kScattered = 1u << 15,    ///< differs from point to point by chance: its results have no derivatives
};

struct ShadeopInfo {
  std::string_view name;
  std::string_view signature_text;
  ShadeopKind kind;
  uint32_t flags;
  std::string_view doc;
  /// Of kernels: the greatest error of a result, in units in the last place of its own magnitude or, where
  /// terms cancel, of the terms'. 0: exact. Tests hold every kernel to it. Others: -1.
  double ulps;
  Signature signature;
};

using ShadeopId = uint16_t;
/// Ids from here on are functions of plug-ins: a program's or module's own list names them.
inline constexpr ShadeopId kFirstPluginShadeop = 0x8000;

/// All rows, in table order; a ShadeopId indexes it. Ids are not stable between versions: .slo files store
/// names and signatures.
std::span<const ShadeopInfo> shadeops();
const ShadeopInfo& shadeop(ShadeopId id);
/// Ids of all overloads of `name`, in table order; empty if unknown. O(log n).
std::span<const ShadeopId> shadeop_overloads(std::string_view name);
/// The row with exactly this name and signature text, or -1.
int find_shadeop(std::string_view name, std::string_view signature_text);

/// An optional token-value pair of a shadeop ("blur", "samples"...).
struct TokenInfo {
  std::string_view set; // the @set of signatures this belongs to
  std::string_view name;
  Type type;
  bool any;     // value of any type (outputs such as "surface:Ci")
  bool uniform; // the value must be uniform
  bool output;  // the value is a variable that is set
  std::string_view doc;
};
std::span<const TokenInfo> tokens();
/// The token `name` of `set`, or nullptr. A name with a "prefix:" matches the row "prefix:*".
const TokenInfo* find_token(std::string_view set, std::string_view name);

/// A predefined variable (globals.def) and how each kind of shader may use it.
struct GlobalInfo {
  std::string_view name;
  Type type;
  Detail detail;
  /// One letter for each ShaderKind in order (surface, displacement, light, volume, imager):
  /// 'r' readable, 'w' readable and writable, '-' not visible.
  std::string_view access;
  std::string_view doc;
};
enum class Global : uint8_t {
#define GLOBAL(name, type, detail, access, doc) k##name,
#include "slvm/format/globals.def"
#undef GLOBAL
  kCount
};
inline constexpr int kGlobalCount = static_cast<int>(Global::kCount);
const GlobalInfo& global_info(Global);
/// The predefined variable `name`, or Global::kCount.
Global find_global(std::string_view name);

} // namespace slvm
