// Makes IR: values, instructions, regions. Used by slc/lower and by passes that add instructions.
#pragma once

#include "slvm/ir/ir.h"

#include <initializer_list>
#include <span>

namespace slvm::ir {

/// Appends to one region at a time. Instructions may be added to a region before it hangs in an instruction.
class Builder {
public:
  explicit Builder(Module& m) : m_(m) {}

  Module& module() { return m_; }
  SourceRange where; ///< given to instructions made from now on

  /// Where instructions go. The region must outlive its use here.
  void set_region(Region* region) { region_ = region; }
  Region* region() const { return region_; }
  /// True once the current region has its terminator: nothing more may be added.
  bool terminated() const;

  ValueId constant(Constant c);
  ValueId number(float x) { return constant({Type::kFloat, {x}, {}}); }
  ValueId triple(Type t, float x, float y, float z) { return constant({t, {x, y, z}, {}}); }
  ValueId string(std::string text) { return constant({Type::kString, {}, std::move(text)}); }

  ValueId slot(uint32_t slot);
  void store(uint32_t slot, ValueId value);
  /// The results of a call, in the order of operand.h: the function's result first, then outputs.
  std::vector<ValueId> call(ShadeopId id, std::span<const ValueId> args, std::span<const Type> result_types);
  /// A call of the row `name` with exactly this signature text, which must exist and store one value.
  ValueId call(std::string_view name, std::string_view signature, std::initializer_list<ValueId> args);
  ValueId retype(Type t, ValueId value);
  ValueId array(uint32_t array);
  void array_clear(uint32_t array);
  ValueId array_load(uint32_t array, ValueId subscript);
  void array_store(uint32_t array, ValueId subscript, ValueId value);

  /// Adds an instruction with regions; results get these types.
  InstId region_inst(Op op, uint32_t index, std::vector<ValueId> args, std::vector<Region> regions,
                     std::span<const Type> result_types);
  void yield(std::vector<ValueId> args) { terminator(Op::kYield, 0, std::move(args)); }
  InstId break_out(uint32_t level, std::vector<ValueId> args) {
    return terminator(Op::kBreak, level, std::move(args));
  }
  InstId next_round(uint32_t level, std::vector<ValueId> args) {
    return terminator(Op::kContinue, level, std::move(args));
  }
  ValueId new_value(Type t);
  uint32_t add_array(Type t, uint32_t elements, int32_t slot = -1);

private:
  InstId add(Inst inst);
  InstId terminator(Op op, uint32_t level, std::vector<ValueId> args);

  Module& m_;
  Region* region_ = nullptr;
};

/// Replaces every use of each key value by its mapped value (chains followed) in a region and all nested
/// ones.
void replace_uses(Module&, Region&, const std::vector<ValueId>& replacement);

} // namespace slvm::ir
