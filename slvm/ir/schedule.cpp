// From structured IR to a list of instructions on virtual registers.
//
// At grid level, runs of instructions that need no whole grid are gathered into strip blocks; uniform
// instructions go in front of the block being gathered (they depend on nothing in it); a barrier ends it.
// Merges become registers: one for each result of an if, one shared by parameter and result of a loop,
// written by masked copies where the branches and rounds end; unmasked ones where no lane that is off keeps a
// value that somebody reads.
#include "slvm/format/decode.h"
#include "slvm/ir/emit_internal.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

namespace slvm::ir {
namespace {

LowOperand word(uint32_t w) {
  return {LowOperand::Kind::kWord, w};
}
LowOperand target(uint32_t index) {
  return {LowOperand::Kind::kTarget, index};
}
uint16_t code_of(Opcode op) {
  return static_cast<uint16_t>(op);
}

class Scheduler {
public:
  Scheduler(const Module& m, Program& p) : m_(m), p_(p) {
    locations_.assign(m.values.size(), target(0)); // a target: not located yet
    level_.assign(m.values.size(), 0);
    constant_words_.assign(m.constants.size(), ~0u);
    used_.assign(m.values.size(), false);
    lanes_off_matter_.assign(m.values.size(), true);
    for (const Inst& inst : m.insts)
      for (ValueId a : inst.args)
        used_[a] = true;
  }

  LowCode run() {
    prepare_externals();
    out_.sections.push_back(0);
    emit_section(m_.body, nullptr);
    for (size_t i = 0; i < m_.inits.size(); ++i) {
      out_.sections.push_back(static_cast<uint32_t>(out_.insts.size()));
      emit_section(m_.inits[i], param_of_init(static_cast<int32_t>(i)));
    }
    return std::move(out_);
  }

private:
  struct Frame { // an open region, for the terminators inside
    const Inst* inst;
    std::vector<LowOperand> merge; // registers of results (loops: of carried values)
  };

  // ---- What the program refers to.

  void prepare_externals() {
    p_.slots = m_.slots;
    p_.params = m_.params;
    for (Param& param : p_.params)
      if (param.init >= 0) ++param.init; // section 0 is the shader itself
    for (const Array& a : m_.arrays) {
      ArrayInfo info{a.type, a.elements, Space::kSlot, static_cast<uint32_t>(a.slot)};
      if (a.slot < 0) {
        uint32_t planes = a.elements * static_cast<uint32_t>(components(a.type));
        info.space = a.varying ? Space::kGrid : Space::kUniform;
        uint32_t& count = a.varying ? p_.grid_planes : p_.uniform_planes;
        info.index = count;
        count += planes;
      }
      p_.arrays.push_back(info);
    }
  }

  const Param* param_of_init(int32_t init) const {
    for (const Param& param : m_.params)
      if (param.init == init) return &param;
    return nullptr;
  }

  LowOperand constant(uint32_t index) {
    uint32_t& at = constant_words_[index];
    if (at != ~0u) return word(at);
    const Constant& c = m_.constants[index];
    at = make_operand(Space::kConstant, static_cast<uint32_t>(p_.constants.size()));
    if (c.type == Type::kString) {
      auto it = std::find(p_.strings.begin(), p_.strings.end(), c.text);
      p_.string_constants.emplace_back(p_.constants.size(), it - p_.strings.begin());
      if (it == p_.strings.end()) p_.strings.push_back(c.text);
      p_.constants.push_back(0);
    } else {
      p_.constants.insert(p_.constants.end(), c.numbers.begin(), c.numbers.end());
    }
    return word(at);
  }

  LowOperand number(float x) {
    for (size_t i = 0; i < p_.constants.size(); ++i)
      if (p_.constants[i] == x) return word(make_operand(Space::kConstant, static_cast<uint32_t>(i)));
    p_.constants.push_back(x);
    return word(make_operand(Space::kConstant, static_cast<uint32_t>(p_.constants.size() - 1)));
  }

  uint16_t import(uint32_t shadeop_id) {
    auto id = static_cast<ShadeopId>(shadeop_id);
    if (m_.plugins.find(id)) id = *p_.plugins.add(m_.plugins.list()[id - kFirstPluginShadeop]);
    auto it = std::find(p_.imports.begin(), p_.imports.end(), id);
    auto index = static_cast<uint16_t>(it - p_.imports.begin());
    if (it == p_.imports.end()) p_.imports.push_back(id);
    return static_cast<uint16_t>(kFirstShadeop + index);
  }

  // ---- Registers.

  LowOperand new_reg(Type t, bool varying) {
    LowReg reg;
    reg.planes = static_cast<uint32_t>(components(t));
    reg.varying = varying;
    out_.regs.push_back(reg);
    return {LowOperand::Kind::kReg, static_cast<uint32_t>(out_.regs.size() - 1)};
  }
  LowOperand define(ValueId v) { return locations_[v] = new_reg(m_.type(v), m_.varying(v)); }
  LowOperand use(ValueId v) const { return locations_[v]; }

  /// A value that must be uniform. One that only control made varying (a string chosen in a loop that lanes
  /// leave one by one) is that of the first active lane.
  LowOperand use_uniform(ValueId v) {
    if (!m_.varying(v) || m_.values[v].array >= 0) return use(v);
    LowOperand reg = new_reg(m_.type(v), false);
    add(make(code_of(Opcode::k_first), {word(static_cast<uint32_t>(components(m_.type(v)))), reg, use(v)}, 1,
             1));
    return reg;
  }

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
  void flush() {
    if (in_strip_ || pending_.empty()) return;
    std::vector<InstAction> actions = std::exchange(pending_, {});
    const SourceRange where = where_; // of the instruction before which this is done
    uint32_t begin = add(Opcode::k_strip, {target(0), word(0)});
    in_strip_ = true;
    ends_.push_back({});
    for (const InstAction& action : actions)
      perform(action);
    in_strip_ = false;
    if (out_.insts.size() == begin + 1) { // all of it was copies of values to themselves
      out_.insts.pop_back();
      ends_.pop_back();
      where_ = where;
      return;
    }
    uint32_t end = add(Opcode::k_endstrip, {});
    close(end);
    where_ = where;
    out_.insts[begin].operands[0] = target(end);
    if (!levels_.empty()) levels_.back().strips.push_back(begin);
  }

  // What waits for its strip block: an instruction of the IR, or copies into merge registers.
  struct InstAction {
    InstId inst = ~0u;
    std::vector<LowOperand> to;
    std::vector<ValueId> from, results;
    bool masked = false;
    SourceRange where;
  };
  void perform(const InstAction& action) {
    where_ = action.where;
    if (action.inst != ~0u)
      emit_inst(action.inst);
    else
      copy_now(action, true);
  }

  /// Copies that happen at once, of the values of one detail: a source that is also a target is saved first.
  void copy_now(const InstAction& c, bool varying) {
    struct Move {
      LowOperand to, from;
      Type type;
      bool masked;
    };
    std::vector<Move> moves;
    for (size_t i = 0; i < c.to.size(); ++i)
      if (m_.varying(c.results[i]) == varying && c.to[i] != use(c.from[i]))
        moves.push_back({c.to[i], use(c.from[i]), m_.type(c.results[i]),
                         c.masked && varying && lanes_off_matter_[c.results[i]]});
    for (size_t i = 0; i < moves.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        if (moves[j].to != moves[i].from) continue;
        LowOperand saved = new_reg(moves[i].type, varying);
        copy_one(saved, moves[i].from, moves[i].type, false);
        moves[i].from = saved;
        break;
      }
    for (const Move& move : moves)
      copy_one(move.to, move.from, move.type, move.masked);
  }
  void copy_one(LowOperand to, LowOperand from, Type t, bool masked) {
    add(make(code_of(masked ? Opcode::k_movm : Opcode::k_mov),
             {word(static_cast<uint32_t>(components(t))), to, from}, 1, 1));
  }

  /// Copies into merge registers. At grid level the varying ones join the strips being gathered, the uniform
  /// ones come after them: strips gathered so far read the old values.
  void merge(std::vector<LowOperand> to, std::vector<ValueId> from, const std::vector<ValueId>& results,
             bool masked) {
    InstAction c{~0u, std::move(to), std::move(from), results, masked, where_};
    if (in_strip_) {
      copy_now(c, true);
      copy_now(c, false);
      return;
    }
    bool some_varying = false, some_uniform = false;
    for (ValueId v : results)
      (m_.varying(v) ? some_varying : some_uniform) = true;
    if (some_varying) pending_.push_back(c);
    if (!some_uniform) return;
    flush();
    copy_now(c, false);
  }

  /// At a break: what nobody reads after the loop needs no copy.
  void merge_used(const Frame& loop, const std::vector<ValueId>& args) {
    std::vector<LowOperand> to;
    std::vector<ValueId> from, results;
    for (size_t i = 0; i < args.size(); ++i) {
      if (!used_[loop.inst->results[i]]) continue;
      to.push_back(loop.merge[i]);
      from.push_back(args[i]);
      results.push_back(loop.inst->results[i]);
    }
    merge(std::move(to), std::move(from), results, true);
  }

  // ---- Where instructions go.

  /// True when everything in it can run strip by strip: no barrier, and no exit to a loop outside it.
  bool strippable(InstId id, uint32_t depth = 0) const {
    const Inst& inst = m_.insts[id];
    switch (inst.op) {
    case Op::kIlluminance:
    case Op::kIlluminate:
    case Op::kSolar:
    case Op::kGather: return false;
    case Op::kBreak:
    case Op::kContinue: return inst.index < depth;
    case Op::kCall: return m_.called(inst).kind == ShadeopKind::kKernel;
    // Stores to what all strips share would be done once for each strip.
    case Op::kStore: return m_.slots[inst.index].varying;
    case Op::kArrayStore:
    case Op::kArrayClear: return m_.arrays[inst.index].varying;
    default: break;
    }
    for (const Region& r : inst.regions)
      for (InstId nested : r.body)
        if (!strippable(nested, depth + is_loop(inst.op))) return false;
    return true;
  }

  /// True when nothing in it is varying: it runs once, at grid level.
  bool all_uniform(InstId id) const {
    const Inst& inst = m_.insts[id];
    for (ValueId v : inst.results)
      if (m_.varying(v)) return false;
    for (ValueId v : inst.args)
      if (m_.varying(v)) return false;
    for (const Region& r : inst.regions)
      for (InstId nested : r.body)
        if (!all_uniform(nested)) return false;
    return true;
  }

  void place(InstId id) {
    where_ = m_.insts[id].where;
    if (in_strip_ || is_alias(id) || is_terminator(m_.insts[id].op)) {
      emit_inst(id);
    } else if (can_overtake(id)) {
      emit_inst(id);
    } else if (!strippable(id)) {
      // Loops and light blocks begin with copies, which join the strips gathered so far.
      if (!begins_with_copies(m_.insts[id].op)) flush();
      emit_inst(id);
    } else if (all_uniform(id)) {
      // A uniform value can come out of the strips being gathered, and loads of arrays stay behind stores.
      if (!args_located(id) || effect_of(m_, m_.insts[id]) != Effect::kNone) flush();
      emit_inst(id);
    } else {
      pending_.push_back({id, {}, {}, {}, false, where_});
    }
  }

  /// A question to the scene that needs nothing from the strips being gathered: asked in front of them, it
  /// does not cut them in two.
  bool can_overtake(InstId id) const {
    const Inst& inst = m_.insts[id];
    if (inst.op != Op::kCall || !inst.regions.empty() || !args_located(id)) return false;
    const ShadeopInfo& info = m_.called(inst);
    if (info.kind != ShadeopKind::kGrid || info.flags & kDerivative || effect_of(m_, inst) == Effect::kWrites)
      return false;
    return std::none_of(pending_.begin(), pending_.end(), [&](const InstAction& a) {
      return a.inst == ~0u || effect_of(m_, m_.insts[a.inst]) == Effect::kWrites;
    });
  }

  static bool begins_with_copies(Op op) { return is_loop(op) || op == Op::kIlluminate || op == Op::kSolar; }

  /// Instructions that only name something: no code, in any place.
  bool is_alias(InstId id) const {
    const Inst& inst = m_.insts[id];
    return inst.op == Op::kConstant || inst.op == Op::kArray ||
           (inst.op == Op::kSlot && !m_.slots[inst.index].stored) ||
           (inst.op == Op::kRetype && is_located(inst.args[0]));
  }
  bool is_located(ValueId v) const { return locations_[v].kind != LowOperand::Kind::kTarget; }
  bool args_located(InstId id) const {
    const Inst& inst = m_.insts[id];
    return inst.regions.empty() &&
           std::all_of(inst.args.begin(), inst.args.end(), [&](ValueId v) { return is_located(v); });
  }

  // ---- One instruction.

  void emit_inst(InstId id) {
    const Inst& inst = m_.insts[id];
    switch (inst.op) {
    case Op::kConstant: locations_[inst.results[0]] = constant(inst.index); break;
    case Op::kSlot: emit_slot(inst); break;
    case Op::kStore: emit_store(inst); break;
    case Op::kCall: emit_call(inst); break;
    case Op::kRetype:
      locations_[inst.results[0]] = use(inst.args[0]);
      level_[inst.results[0]] = level_[inst.args[0]];
      break;
    case Op::kArray: locations_[inst.results[0]] = word(make_operand(Space::kArray, inst.index)); break;
    case Op::kArrayClear:
      add(make(code_of(Opcode::k_astart), {word(make_operand(Space::kArray, inst.index))}, 0, 1));
      break;
    case Op::kArrayLoad: {
      level_[inst.results[0]] = depth();
      LowOperand subscript = use(inst.args[0]);
      auto planes = static_cast<uint32_t>(components(m_.type(inst.results[0])));
      add(make(
          code_of(Opcode::k_aload),
          {word(planes), define(inst.results[0]), word(make_operand(Space::kArray, inst.index)), subscript},
          1, 1));
      break;
    }
    case Op::kArrayStore: {
      auto planes = static_cast<uint32_t>(components(m_.arrays[inst.index].type));
      add(make(
          code_of(Opcode::k_astore),
          {word(planes), word(make_operand(Space::kArray, inst.index)), use(inst.args[0]), use(inst.args[1])},
          1, 1));
      break;
    }
    case Op::kIf: emit_if(id); break;
    case Op::kLoop:
    case Op::kBlock: emit_loop(id); break;
    case Op::kIlluminance: emit_illuminance(id); break;
    case Op::kIlluminate:
    case Op::kSolar: emit_emitter(id); break;
    case Op::kGather: emit_gather(id); break;
    case Op::kBreak:
    case Op::kContinue: emit_exit(inst); break;
    case Op::kYield: emit_yield(inst); break;
    }
  }

  void emit_slot(const Inst& inst) {
    LowOperand slot = word(make_operand(Space::kSlot, inst.index));
    if (!m_.slots[inst.index].stored) {
      locations_[inst.results[0]] = slot;
      return;
    }
    // The variable is stored to somewhere: take its value now.
    auto planes = static_cast<uint32_t>(components(m_.type(inst.results[0])));
    add(make(code_of(Opcode::k_mov), {word(planes), define(inst.results[0]), slot}, 1, 1));
  }

  void emit_store(const Inst& inst) {
    const Slot& slot = m_.slots[inst.index];
    bool masked = slot.varying && mask_depth_ > 0;
    add(make(code_of(masked ? Opcode::k_movm : Opcode::k_mov),
             {word(static_cast<uint32_t>(components(slot.type))),
              word(make_operand(Space::kSlot, inst.index)),
              slot.varying ? use(inst.args[0]) : use_uniform(inst.args[0])},
             1, 1));
  }

  /// The mask that tells the lanes where both hold a value.
  static uint32_t common_level(uint32_t a, uint32_t b) {
    return std::max(a & ~kScatteredLevel, b & ~kScatteredLevel) | ((a | b) & kScatteredLevel);
  }

  void emit_call(const Inst& inst) {
    const ShadeopInfo& info = m_.called(inst);
    const std::span<const ValueId> args(inst.args.data(),
                                        inst.op == Op::kGather ? fixed_args(inst) : inst.args.size());
    uint32_t level = 0;
    for (ValueId a : args)
      level = common_level(level, level_[a]);
    std::vector<LowOperand> reads, operands;
    const Signature& signature = info.signature;
    size_t positional = 0; // arguments before token-value pairs
    for (int i = 0; i < signature.param_count; ++i)
      positional += signature.param(i).input;
    int param = 0;
    for (size_t i = 0; i < args.size(); ++i, ++param) {
      while (param < signature.param_count && !signature.param(param).input)
        ++param;
      bool is_token_value = !signature.variadic() && i >= positional && (i - positional) % 2 == 1;
      bool is_positional = signature.variadic() || i < positional;
      if (is_token_value || (is_positional && signature.param(param).any))
        reads.push_back(word(static_cast<uint32_t>(m_.type(args[i]))));
      bool must_be_uniform = is_positional && signature.param(param).uniform;
      reads.push_back(must_be_uniform ? use_uniform(args[i]) : use(args[i]));
    }
    size_t result = 0;
    auto store = [&](bool any) {
      ValueId r = inst.results[result++];
      if (any) operands.push_back(word(static_cast<uint32_t>(m_.type(r))));
      // An array that a call stores to is one operand, written and read in place.
      operands.push_back(m_.values[r].array >= 0
                             ? word(make_operand(Space::kArray, static_cast<uint32_t>(m_.values[r].array)))
                             : define(r));
      const bool everywhere = info.flags & kDerivative && !(info.flags & (kTexture | kRays));
      level_[r] = info.kind == ShadeopKind::kKernel || everywhere ? level : depth();
      if (info.flags & kScattered) level_[r] |= kScatteredLevel;
    };
    if (signature.result != Type::kVoid) store(false);
    for (int i = 0; i < signature.param_count; ++i)
      if (signature.param(i).output) store(signature.param(i).any);
    uint32_t token_outputs = 0;
    for (; info.flags & kTokenOut && result < inst.results.size(); ++token_outputs)
      store(true);
    auto stores = static_cast<uint32_t>(operands.size());
    operands.insert(operands.end(), reads.begin(), reads.end());
    if (info.flags & kTokenOut) operands.push_back(word(token_outputs));
    if (info.flags & kDerivative) {
      operands.push_back(word(level));
      keep_strips_below(level & ~kScatteredLevel);
    }
    add(make(import(inst.index), std::move(operands), 0, stores));
  }

  /// A derivative reads lanes that are off here: strips that computed its operands must not have been
  /// skipped.
  void keep_strips_below(uint32_t level) {
    for (Level& l : levels_)
      if (l.depth > level)
        for (uint32_t strip : l.strips)
          out_.insts[strip].operands[1] = word(1);
  }

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
  void close(uint32_t end) {
    for (Patch p : ends_.back())
      out_.insts[p.inst].operands[p.operand] = target(end);
    ends_.pop_back();
  }

  void emit_region(const Region& region) {
    for (InstId id : region.body)
      place(id);
    flush();
  }

  void open_mask() {
    ++mask_depth_;
    out_.mask_depth = std::max(out_.mask_depth, mask_depth_);
    if (in_strip_) return;
    ++grid_depth_;
    levels_.push_back({grid_depth_, {}});
  }
  void close_mask() {
    --mask_depth_;
    if (in_strip_) return;
    --grid_depth_;
    levels_.pop_back();
  }

  void emit_section(const Region& region, const Param* param) {
    ends_.push_back({});
    init_param_ = param;
    emit_region(region);
    close(add(Opcode::k_end, {}));
  }

  std::vector<LowOperand> define_results(const Inst& inst) {
    std::vector<LowOperand> regs;
    for (ValueId r : inst.results) {
      regs.push_back(define(r));
      level_[r] = depth();
    }
    return regs;
  }

  // `if (!c) break;` with nothing else: lanes leave by one instruction.
  bool emit_while(const Inst& inst) {
    if (frames_.empty() || frames_.back().inst->op != Op::kLoop || !inst.results.empty()) return false;
    const Inst& else_end = m_.insts[inst.regions[1].body.back()];
    if (inst.regions[0].body.size() != 1 || m_.insts[inst.regions[0].body[0]].op != Op::kYield) return false;
    if (inst.regions[1].body.size() != 1 || else_end.op != Op::kBreak || else_end.index != 0) return false;
    for (size_t i = 0; i < else_end.args.size(); ++i)
      if (used_[frames_.back().inst->results[i]] && use(else_end.args[i]) != frames_.back().merge[i])
        return false;
    bool varying = m_.varying(inst.args[0]);
    uint32_t at = add(varying ? Opcode::k_while : Opcode::k_uwhile, {use(inst.args[0]), target(0)});
    jump_to_end(at, 1);
    return true;
  }

  void emit_if(InstId id) {
    const Inst& inst = m_.insts[id];
    if (emit_while(inst)) return;
    bool varying = m_.varying(inst.args[0]);
    LowOperand condition = use(inst.args[0]);
    frames_.push_back({&inst, define_results(inst)});
    for (ValueId r : inst.results)
      level_[r] |= level_[inst.args[0]] & kScatteredLevel;
    uint32_t begin = add(varying ? Opcode::k_if : Opcode::k_uif, {condition, target(0)});
    if (varying) open_mask();
    ends_.push_back({});
    emit_region(inst.regions[0]);
    const Region& other = inst.regions[1];
    if (other.body.size() > 1 || !m_.insts[other.body[0]].args.empty() ||
        m_.insts[other.body[0]].op != Op::kYield) {
      uint32_t middle = add(varying ? Opcode::k_else : Opcode::k_uelse, {target(0)});
      close(middle);
      out_.insts[begin].operands[1] = target(middle);
      ends_.push_back({});
      jump_to_end(middle, 0);
      emit_region(other);
    } else {
      jump_to_end(begin, 1);
    }
    uint32_t end = add(varying ? Opcode::k_endif : Opcode::k_uendif, {target(0)});
    close(end);
    jump_to_end(end, 0);
    if (varying) close_mask();
    frames_.pop_back();
  }

  std::vector<LowOperand> begin_carried(const Inst& inst) {
    const std::vector<ValueId>& params = inst.regions[0].params;
    uint32_t fixed = fixed_args(inst);
    std::vector<LowOperand> regs = define_results(inst);
    std::vector<ValueId> initial(inst.args.begin() + fixed, inst.args.end());
    if (!params.empty()) merge(regs, initial, inst.results, false);
    flush();
    for (size_t i = 0; i < params.size(); ++i)
      locations_[params[i]] = regs[i];
    return regs;
  }

  /// How many ways there are to the next round of the loop around `region`.
  uint32_t continues(const Region& region, uint32_t depth = 0) const {
    uint32_t count = 0;
    for (InstId id : region.body) {
      const Inst& inst = m_.insts[id];
      count += inst.op == Op::kContinue && inst.index == depth;
      for (const Region& r : inst.regions)
        count += continues(r, depth + is_loop(inst.op));
    }
    return count;
  }

  void emit_loop(InstId id) {
    const Inst& inst = m_.insts[id];
    frames_.push_back({&inst, begin_carried(inst)});
    bool is_block = inst.op == Op::kBlock;
    // Where all lanes go to the next round together, the others have left the loop.
    if (!is_block && continues(inst.regions[0]) == 1)
      for (ValueId r : inst.results)
        lanes_off_matter_[r] = used_[r];
    uint32_t begin = add(is_block ? Opcode::k_block : Opcode::k_loop, {target(0)});
    if (is_block)
      for (const LowOperand& r : frames_.back().merge)
        out_.insts[begin].begins.push_back(r.value);
    emit_rounds(inst, begin, is_block ? Opcode::k_endblock : Opcode::k_endloop);
  }

  /// The body of a loop or block that begins with instruction `begin`, and its end.
  void emit_rounds(const Inst& inst, uint32_t begin, Opcode end_opcode) {
    const bool once = end_opcode == Opcode::k_endblock;
    open_mask();
    for (ValueId p : inst.regions[0].params)
      level_[p] = depth();
    ends_.push_back({});
    emit_region(inst.regions[0]);
    where_ = inst.where;
    uint32_t end = once ? add(end_opcode, {target(0)}) : add(end_opcode, {target(begin + 1), target(0)});
    close(end);
    out_.insts[begin].operands[0] = target(end);
    jump_to_end(end, once ? 0 : 1);
    if (!once) out_.loops.emplace_back(begin, end);
    close_mask();
    frames_.pop_back();
  }

  void emit_illuminance(InstId id) {
    const Inst& inst = m_.insts[id];
    frames_.push_back({&inst, begin_carried(inst)});
    std::vector<LowOperand> fixed{use_uniform(inst.args[0])};
    for (uint32_t i = 1; i < 4; ++i)
      fixed.push_back(use(inst.args[i]));
    uint32_t begin =
        add(Opcode::k_illuminance, {target(0), word(inst.index), fixed[0], fixed[1], fixed[2], fixed[3]});
    emit_rounds(inst, begin, Opcode::k_endilluminance);
  }

  /// Whether lanes can leave the loop that owns `region` before its last round.
  bool lanes_leave(const Region& region, uint32_t depth = 0) const {
    for (InstId id : region.body) {
      const Inst& inst = m_.insts[id];
      if (inst.op == Op::kBreak && inst.index >= depth) return true;
      if (inst.op == Op::kContinue && inst.index > depth) return true;
      for (const Region& nested : inst.regions)
        if (lanes_leave(nested, depth + is_loop(inst.op))) return true;
    }
    return false;
  }

  // The call says what rays there are, the loop runs for each.
  void emit_gather(InstId id) {
    const Inst& inst = m_.insts[id];
    frames_.push_back({&inst, begin_carried(inst)});
    emit_call(inst);
    uint32_t begin = add(Opcode::k_gather, {target(0), word(lanes_leave(inst.regions[0]))});
    emit_rounds(inst, begin, Opcode::k_endgather);
  }

  void emit_emitter(InstId id) {
    const Inst& inst = m_.insts[id];
    uint32_t fixed_count = fixed_args(inst);
    std::vector<LowOperand> regs = define_results(inst);
    std::vector<ValueId> otherwise(inst.args.begin() + fixed_count, inst.args.end());
    merge(regs, otherwise, inst.results, false);
    flush();
    std::vector<LowOperand> operands{target(0), word(inst.index)};
    for (uint32_t i = 0; i < fixed_count; ++i)
      operands.push_back(use(inst.args[i]));
    frames_.push_back({&inst, regs});
    bool cone = inst.op == Op::kIlluminate;
    uint32_t begin = add(cone ? Opcode::k_illuminate : Opcode::k_solar, operands);
    open_mask();
    ends_.push_back({});
    emit_region(inst.regions[0]);
    uint32_t end = add(cone ? Opcode::k_endilluminate : Opcode::k_endsolar, {target(0)});
    close(end);
    out_.insts[begin].operands[0] = target(end);
    jump_to_end(end, 0);
    close_mask();
    frames_.pop_back();
  }

  void emit_exit(const Inst& inst) {
    uint32_t level = inst.index;
    size_t f = frames_.size();
    while (true) {
      --f;
      if (is_loop(frames_[f].inst->op) && level-- == 0) break;
    }
    const Frame loop = frames_[f]; // a copy: what flush() performs opens frames of its own
    if (inst.op == Op::kContinue)
      merge(loop.merge, inst.args, loop.inst->results, true);
    else
      merge_used(loop, inst.args);
    flush();
    // The end of the body is the next round by itself.
    if (f == frames_.size() - 1 && inst.op == Op::kContinue) return;
    if (f == frames_.size() - 1 && inst.op == Op::kBreak && loop.inst->op == Op::kBlock) return;
    uint32_t at =
        add(inst.op == Op::kBreak ? Opcode::k_break : Opcode::k_continue, {word(inst.index + 1), target(0)});
    jump_to_end(at, 1);
  }

  void emit_yield(const Inst& inst) {
    if (frames_.empty()) {
      if (init_param_) emit_init_result(inst);
      return;
    }
    const Inst& owner = *frames_.back().inst;
    bool masked = owner.op != Op::kIf || m_.varying(owner.args[0]);
    for (size_t i = 0; i < inst.args.size(); ++i)
      level_[owner.results[i]] |= level_[inst.args[i]] & kScatteredLevel;
    merge(frames_.back().merge, inst.args, owner.results, masked);
  }

  void emit_init_result(const Inst& inst) {
    auto slot = static_cast<uint32_t>(init_param_->slot);
    auto planes = static_cast<uint32_t>(components(init_param_->type));
    flush();
    if (init_param_->elements == 0) {
      add(make(code_of(Opcode::k_mov),
               {word(planes), word(make_operand(Space::kSlot, slot)), use(inst.args[0])}, 1, 1));
      return;
    }
    uint32_t array = 0;
    while (m_.arrays[array].slot != init_param_->slot)
      ++array;
    for (size_t i = 0; i < inst.args.size(); ++i)
      add(make(code_of(Opcode::k_astore),
               {word(planes), word(make_operand(Space::kArray, array)), number(static_cast<float>(i)),
                use(inst.args[i])},
               1, 1));
  }

  const Module& m_;
  Program& p_;
  LowCode out_;
  std::vector<LowOperand> locations_; // by value
  std::vector<uint32_t> level_;       // by value: the mask level whose lanes hold it
  std::vector<uint32_t> constant_words_;
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

} // namespace

LowCode schedule(const Module& m, Program& program) {
  return Scheduler(m, program).run();
}

} // namespace slvm::ir
