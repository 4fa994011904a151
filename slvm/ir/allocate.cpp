// Registers to planes: live ranges over the list of instructions, then a linear scan in each space.
#include "slvm/ir/emit_internal.h"

#include <algorithm>

namespace slvm::ir {
namespace {

class Allocator {
public:
  Allocator(LowCode& code, Program& program) : code_(code), program_(program) {}

  void run() {
    find_ranges();
    extend_over_rounds();
    for (LowReg& r : code_.regs)
      if (r.varying) r.space = r.block >= 0 ? Space::kStrip : Space::kGrid;
    scan();
    drop_empty_strips();
  }

private:
  void find_ranges() {
    int32_t block = -1, blocks = 0;
    for (uint32_t i = 0; i < code_.insts.size(); ++i) {
      auto op = static_cast<Opcode>(code_.insts[i].opcode);
      if (op == Opcode::k_strip) {
        block = blocks++;
        strip_begin_ = i;
      }
      for (uint32_t reg : code_.insts[i].begins)
        refer(reg, i, block);
      for (const LowOperand& o : code_.insts[i].operands)
        if (o.kind == LowOperand::Kind::kReg) refer(o.value, i, block);
      if (op == Opcode::k_endstrip) {
        strips_.emplace_back(strip_begin_, i);
        block = -1;
      }
    }
  }

  void refer(uint32_t reg, uint32_t inst, int32_t block) {
    LowReg& r = code_.regs[reg];
    if (r.first == ~0u) {
      r.first = inst;
      r.block = block >= 0 ? block : -2;
    }
    r.last = inst;
    if (block < 0 || r.block != block) r.block = -2;
  }

  // What is defined before a loop and read in it must last to its end, and so must what a light loop is
  // given: it looks at axis and angle for each light. A strip block is a loop over strips for the uniform
  // registers: those are the same for all strips. Inner loops stand before outer ones in the list.
  void extend_over_rounds() {
    auto extend = [&](std::pair<uint32_t, uint32_t> loop, bool uniform_only) {
      for (LowReg& r : code_.regs)
        if (r.first < loop.first && r.last >= loop.first && r.last < loop.second &&
            !(uniform_only && r.varying))
          r.last = loop.second;
    };
    for (auto loop : code_.loops)
      extend(loop, false);
    for (auto strip : strips_)
      extend(strip, true);
    for (auto loop : code_.loops)
      extend(loop, false);
  }

  struct Pool {
    std::vector<uint32_t> free_from; // by plane: the instruction after which it is free
  };

  // Lowest run of planes that are all free before `at`.
  uint32_t take(Pool& pool, uint32_t base, const LowReg& r) const {
    uint32_t run = 0;
    for (uint32_t i = base;; ++i) {
      if (i >= pool.free_from.size()) pool.free_from.resize(i + 1, 0);
      run = pool.free_from[i] <= r.first ? run + 1 : 0;
      if (run == r.planes) return i + 1 - run;
    }
  }

  void scan() {
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < code_.regs.size(); ++i)
      if (code_.regs[i].first != ~0u) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return code_.regs[a].first < code_.regs[b].first; });
    Pool pools[kSpaceCount];
    // Arrays stand at the beginning of their spaces.
    uint32_t base[kSpaceCount] = {};
    base[static_cast<size_t>(Space::kUniform)] = program_.uniform_planes;
    base[static_cast<size_t>(Space::kGrid)] = program_.grid_planes;
    for (uint32_t i : order) {
      LowReg& r = code_.regs[i];
      auto space = static_cast<size_t>(r.space);
      Pool& pool = pools[space];
      r.index = reuse_source(i) ? r.index : take(pool, base[space], r);
      if (pool.free_from.size() < r.index + r.planes) pool.free_from.resize(r.index + r.planes, 0);
      for (uint32_t k = 0; k < r.planes; ++k)
        pool.free_from[r.index + k] = r.last + 1;
    }
    program_.uniform_planes =
        std::max<uint32_t>(program_.uniform_planes, plane_count(pools, Space::kUniform));
    program_.grid_planes = std::max<uint32_t>(program_.grid_planes, plane_count(pools, Space::kGrid));
    program_.strip_planes = plane_count(pools, Space::kStrip);
  }
  static uint32_t plane_count(const Pool* pools, Space s) {
    return static_cast<uint32_t>(pools[static_cast<size_t>(s)].free_from.size());
  }

  // A register that begins as a copy of one that ends there takes its planes, and the copy goes.
  bool reuse_source(uint32_t reg) {
    LowReg& r = code_.regs[reg];
    LowInst& inst = code_.insts[r.first];
    auto op = static_cast<Opcode>(inst.opcode);
    if ((op != Opcode::k_mov && op != Opcode::k_movm) ||
        inst.operands[1] != LowOperand{LowOperand::Kind::kReg, reg})
      return false;
    if (inst.operands[2].kind != LowOperand::Kind::kReg) return false;
    const LowReg& source = code_.regs[inst.operands[2].value];
    if (source.last != r.first || source.space != r.space || source.planes != r.planes) return false;
    r.index = source.index;
    inst.removed = true;
    return true;
  }

  void drop_empty_strips() {
    for (auto [begin, end] : strips_) {
      bool empty = true;
      for (uint32_t i = begin + 1; i < end; ++i)
        empty &= code_.insts[i].removed;
      if (empty) code_.insts[begin].removed = code_.insts[end].removed = true;
    }
  }

  LowCode& code_;
  Program& program_;
  std::vector<std::pair<uint32_t, uint32_t>> strips_;
  uint32_t strip_begin_ = 0;
};

} // namespace

void allocate(LowCode& code, Program& program) {
  Allocator(code, program).run();
}

} // namespace slvm::ir
