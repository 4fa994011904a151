// The intermediate representation: one shader, typed, in SSA form, with structured regions instead of jumps.
// Read next: build.h (making it), print.h (its text form), passes/ (what is done to it), emit.h (bytecode
// from it).
//
// A value is defined once, by an instruction or as a region's parameter, and visible from there to the end of
// its region, nested regions included. What flows out of a region does so as a result of the instruction that
// owns it:
//
//   %5 = if %4 {              both branches end in a yield (of as many values as there are results), a break
//   or
//     yield %2                a continue
//   } else {
//     yield %3
//   }
//   %6, %7 = loop %0, %1 -> (%8, %9) {    %8, %9 hold the carried values: first the arguments, then those of
//   the
//     ...                                 continue that ended the round; the results are those of the break
//     by which break 0, %8, %9                     a lane left continue 0, %10, %11                a loop
//     body ends in a continue or break, a block's in a break
//   }
//
// break and continue name their loop by how many enclosing loops, blocks, illuminance and gather loops lie
// between. Variables of the language are gone: arrays alone are memory, loaded and stored element by element.
#pragma once

#include "slvm/format/program.h"
#include "slvm/support/source.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace slvm::ir {

using ValueId = uint32_t;
using InstId = uint32_t;
inline constexpr ValueId kNoValue = ~0u;

enum class Op : uint8_t {
  kConstant,    ///< index: into constants
  kSlot,        ///< reads external variable `index`. L, Cl and Ol are those of the enclosing light loop
  kStore,       ///< args: value. Stores to external variable `index`
  kCall,        ///< calls shadeop `index` (Module::called); results: what it stores; args: what it reads, and
                ///< token-value pairs
  kRetype,      ///< args: value. The same components under another type (point, vector, normal, color)
  kArray,       ///< the array `index` as an argument of calls; yields no code
  kArrayClear,  ///< fills array `index` with zeros
  kArrayLoad,   ///< args: subscript
  kArrayStore,  ///< args: subscript, value
  kIf,          ///< args: condition; two regions
  kLoop,        ///< args: carried values; one region with as many parameters
  kBlock,       ///< one region, run once; break leaves it
  kIlluminance, ///< args: category, position, axis, angle, then carried values; index: 1 when axis and angle
                ///< count
  kIlluminate,  ///< args: from, axis, angle, then the results' values for lanes the light does not reach;
                ///< index as above
  kSolar,       ///< args: axis, angle, then the same
  kYield,       ///< args: results of the enclosing if, illuminate or solar
  kBreak,       ///< index: level; args: results of that loop
  kContinue,    ///< index: level; args: carried values of that loop
  kGather,      ///< index: the row of gather or traverse; args: what that row reads, then carried values. One
                ///< region, run for each ray; its calls of gatherhit and gathered tell of the ray
};
inline constexpr int kOpCount = 19;
std::string_view op_name(Op);
/// Their index is a row of shadeops.def.
constexpr bool names_shadeop(Op op) {
  return op == Op::kCall || op == Op::kGather;
}
constexpr bool is_light_statement(Op op) {
  return op == Op::kIlluminance || op == Op::kIlluminate || op == Op::kSolar;
}
constexpr bool is_terminator(Op op) {
  return op == Op::kYield || op == Op::kBreak || op == Op::kContinue;
}
/// Loops in the sense of break and continue levels.
constexpr bool is_loop(Op op) {
  return op == Op::kLoop || op == Op::kBlock || op == Op::kIlluminance || op == Op::kGather;
}

struct Region {
  std::vector<ValueId> params;
  std::vector<InstId> body;
};

struct Inst {
  Op op = Op::kConstant;
  uint32_t index = 0;
  SourceRange where;
  std::vector<ValueId> args, results;
  std::vector<Region> regions;
};

/// How many args stand before carried values: 4 for illuminance, 3 illuminate, 2 solar, what its row reads
/// for gather, else 0.
inline uint32_t fixed_args(const Inst& inst) {
  switch (inst.op) {
  case Op::kIlluminance: return 4;
  case Op::kIlluminate: return 3;
  case Op::kSolar: return 2;
  case Op::kGather:
    return static_cast<uint32_t>(inst.args.size() - std::min(inst.args.size(), inst.results.size()));
  default: return 0;
  }
}

struct ValueInfo {
  Type type = Type::kFloat;
  int32_t array = -1;   ///< kArray: which one
  bool varying = false; ///< as computed by infer_detail
};

struct Constant {
  Type type = Type::kFloat;
  std::vector<float> numbers; ///< components() of them; none for strings
  std::string text;
  bool operator==(const Constant&) const = default;
};

struct Array {
  Type type = Type::kFloat;
  uint32_t elements = 0;
  int32_t slot = -1;    ///< the external variable it is, or -1: local
  bool varying = false; ///< as computed by infer_detail
};

struct Module {
  ShaderKind kind = ShaderKind::kSurface;
  std::string name;
  std::vector<Param> params; ///< slot and init (index into inits) filled in
  std::vector<Slot> slots;
  std::vector<Array> arrays;
  std::vector<Constant> constants;
  std::vector<ValueInfo> values;
  std::vector<Inst> insts;        ///< all, in no order; dead ones may linger
  Region body;                    ///< ends in a yield without arguments
  std::vector<Region> inits;      ///< defaults of parameters: each yields the value (arrays: the elements)
  std::vector<std::string> files; ///< by the FileId of source ranges
  PluginShadeops plugins;         ///< those that calls may name

  Type type(ValueId v) const { return values[v].type; }
  /// What a call calls.
  const ShadeopInfo& called(const Inst& call) const { return plugins.info(call.index); }
  bool varying(ValueId v) const { return values[v].varying; }
};

/// Walks all instructions of a region and its nested regions, outer before inner. f(InstId).
template <class F> void for_each_inst(const Module& m, const Region& region, F&& f) {
  for (InstId id : region.body) {
    f(id);
    for (const Region& nested : m.insts[id].regions)
      for_each_inst(m, nested, f);
  }
}
/// Calls f on the body and on every init.
template <class F> void for_each_root(Module& m, F&& f) {
  f(m.body);
  for (Region& r : m.inits)
    f(r);
}

/// What an instruction does beside computing its results from its arguments.
enum class Effect : uint8_t {
  kNone,   ///< may be removed, merged with an equal one, moved
  kReads,  ///< may be removed; depends on memory or state that stores and effects change
  kWrites, ///< stays where it is
};
Effect effect_of(const Module&, const Inst&);

} // namespace slvm::ir
