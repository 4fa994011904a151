// The step from structured IR to a list of instructions on virtual registers: what its parts share.
//
// At grid level, runs of instructions that need no whole grid are gathered into strip blocks; uniform
// instructions go in front of the block being gathered (they depend on nothing in it); a barrier ends it.
// Merges become registers: one for each result of an if, one shared by parameter and result of a loop,
// written by masked copies where the branches and rounds end; unmasked ones where no lane that is off keeps a
// value that somebody reads.
#pragma once

#include "slvm/format/decode.h"
#include "slvm/ir/program_tables.h"

#include <span>

namespace slvm::ir {

inline uint16_t code_of(Opcode op) {
  return static_cast<uint16_t>(op);
}

class Scheduler {
public:
  Scheduler(const Module& m, Program& p);

  LowCode run();

private:
  struct Frame { // an open region, for the terminators inside
    const Inst* inst;
    std::vector<LowOperand> merge; // registers of results (loops: of carried values)
  };

  // ---- Registers.

  LowOperand new_reg(Type t, bool varying);
  LowOperand define(ValueId v) { return locations_[v] = new_reg(m_.type(v), m_.varying(v)); }
  LowOperand use(ValueId v) const { return locations_[v]; }

  /// A value that must be uniform. One that only control made varying (a string chosen in a loop that lanes
  /// leave one by one) is that of the first active lane.
  LowOperand use_uniform(ValueId v);

  // ---- Instructions. Those of a strip block wait in pending_ until something ends the block.

  LowInst make(uint16_t opcode, std::vector<LowOperand> operands, uint32_t first_store = 0,
               uint32_t stores = 0) const {
    return {opcode, stores, first_store, std::move(operands), where_, {}, false};
  }
  uint32_t add(LowInst inst) {
    out_.insts.push_back(std::move(inst));
    return static_cast<uint32_t>(out_.insts.size() - 1);
  }
  uint32_t add(Opcode op, std::vector<LowOperand> operands) {
    return add(make(code_of(op), std::move(operands)));
  }

  /// Grid level: ends the block being gathered. Inside a strip block there is nothing to end.
  void flush();

  // What waits for its strip block: an instruction of the IR, or copies into merge registers.
  struct InstAction {
    InstId inst = ~0u;
    std::vector<LowOperand> to;
    std::vector<ValueId> from, results;
    bool masked = false;
    SourceRange where;
  };
  void perform(const InstAction& action);

  /// Copies that happen at once, of the values of one detail: a source that is also a target is saved first.
  void copy_now(const InstAction& c, bool varying);
  void copy_one(LowOperand to, LowOperand from, Type t, bool masked);

  /// Copies into merge registers. At grid level the varying ones join the strips being gathered, the uniform
  /// ones come after them: strips gathered so far read the old values.
  void merge(std::vector<LowOperand> to, std::vector<ValueId> from, const std::vector<ValueId>& results,
             bool masked);

  /// At a break: what nobody reads after the loop needs no copy.
  void merge_used(const Frame& loop, const std::vector<ValueId>& args);

  // ---- Where instructions go.

  void place(InstId id);

  /// A question to the scene that needs nothing from the strips being gathered: asked in front of them, it
  /// does not cut them in two.
  bool can_overtake(InstId id) const;

  static bool begins_with_copies(Op op) { return is_loop(op) || op == Op::kIlluminate || op == Op::kSolar; }

  /// Instructions that only name something: no code, in any place.
  bool is_alias(InstId id) const;
  bool is_located(ValueId v) const { return locations_[v].kind != LowOperand::Kind::kTarget; }
  bool args_located(InstId id) const;

  // ---- One instruction.

  void emit_inst(InstId id);
  void emit_slot(const Inst& inst);
  void emit_store(const Inst& inst);
  void emit_call(const Inst& inst);

  /// A derivative reads lanes that are off here: strips that computed its operands must not have been
  /// skipped.
  void keep_strips_below(uint32_t level);

  // ---- Regions.

  struct Level { // an open region at grid level
    uint32_t depth = 0;
    std::vector<uint32_t> strips;
  };
  uint32_t depth() const { return grid_depth_; }

  // Jumps to the end of the region being emitted are patched when it closes.
  struct Patch {
    uint32_t inst, operand;
  };
  void jump_to_end(uint32_t inst, uint32_t operand) { ends_.back().push_back({inst, operand}); }
  void close(uint32_t end);

  void emit_region(const Region& region);
  void open_mask();
  void close_mask();

  void emit_section(const Region& region, const Param* param);
  std::vector<LowOperand> define_results(const Inst& inst);

  /// `if (!c) break;` with nothing else: lanes leave by one instruction.
  bool emit_while(const Inst& inst);

  void emit_if(InstId id);

  /// Registers of what a loop carries, with their first values.
  std::vector<LowOperand> begin_carried(const Inst& inst);

  void emit_loop(InstId id);

  /// The body of a loop or block that begins with instruction `begin`, and its end.
  void emit_rounds(const Inst& inst, uint32_t begin, Opcode end_opcode);

  void emit_illuminance(InstId id);

  /// The call says what rays there are, the loop runs for each.
  void emit_gather(InstId id);

  void emit_emitter(InstId id);

  void emit_exit(const Inst& inst);
  void emit_yield(const Inst& inst);
  void emit_init_result(const Inst& inst);

  const Module& m_;
  ProgramTables tables_;
  LowCode out_;
  std::vector<LowOperand> locations_;  // by value
  std::vector<uint32_t> level_;        // by value: the mask level whose lanes hold it
  std::vector<bool> used_;             // by value: an argument of something
  std::vector<bool> lanes_off_matter_; // by result of a loop: copies to it are masked
  std::vector<InstAction> pending_;
  std::vector<Frame> frames_;
  std::vector<Level> levels_;
  std::vector<std::vector<Patch>> ends_;
  const Param* init_param_ = nullptr;
  SourceRange where_;
  bool in_strip_ = false;
  uint32_t grid_depth_ = 0, mask_depth_ = 0;
};

} // namespace slvm::ir
