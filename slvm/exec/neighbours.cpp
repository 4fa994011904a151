// Reads bytecode. The pass derivatives_first (slvm/ir/passes) put it in an order that makes this part small.
#include "slvm/exec/neighbours.h"

#include "slvm/format/decode.h"

#include <algorithm>

namespace slvm {
namespace {

class Reader {
public:
  explicit Reader(const Program& p) : p_(p) {}

  NeighbourUse run() {
    NeighbourUse out;
    find_end();
    out.end = end_;
    if (end_ == 0) return out;
    if (plugins_) { // they may look at anything
      out.reads.predefined.set();
      for (const Slot& slot : p_.slots)
        if (slot.parameter) out.reads.parameters.push_back(slot.name);
      return out;
    }
    // Defaults of parameters are computed at all points.
    std::vector<bool> read(p_.slots.size());
    const uint32_t first_default = p_.sections.size() > 1 ? p_.sections[1] : size();
    for (uint32_t at = 0; at < size(); at = next(at)) {
      const bool runs_beside = at < end_ || at >= first_default;
      if (runs_beside || (at < last_ && is_derivative(at))) mark_slots(at, read);
      if (runs_beside) mark_unasked(at, out.reads.predefined);
    }
    for (size_t i = 0; i < read.size(); ++i) {
      if (!read[i]) continue;
      if (p_.slots[i].parameter)
        out.reads.parameters.push_back(p_.slots[i].name);
      else if (Global g = find_global(p_.slots[i].name); g != Global::kCount)
        out.reads.predefined.set(static_cast<size_t>(g));
    }
    // Read unasked: by textures without coordinates, by rays that stand for maps.
    for (Global g : {Global::ks, Global::kt, Global::kP})
      out.reads.predefined.set(static_cast<size_t>(g));
    return out;
  }

private:
  uint32_t size() const { return static_cast<uint32_t>(p_.code.size()); }
  uint32_t next(uint32_t at) const { return at + 1 + instruction_words(p_.code[at]); }
  bool is_call(uint32_t at) const { return instruction_opcode(p_.code[at]) >= kFirstShadeop; }
  ShadeopId called(uint32_t at) const { return p_.imports[instruction_opcode(p_.code[at]) - kFirstShadeop]; }
  bool is_plugin(uint32_t at) const { return is_call(at) && p_.plugins.find(called(at)); }
  bool is_derivative(uint32_t at) const {
    return is_call(at) && (p_.plugins.find(called(at)) || p_.plugins.info(called(at)).flags & kDerivative);
  }

  /// An instruction outside all regions, or a region.
  struct Item {
    uint32_t end = 0;
    bool single = true, derivative = false;
  };
  Item item_at(uint32_t at) {
    Item item;
    for (int depth = 0;; at = item.end) {
      item.end = next(at);
      item.derivative |= is_derivative(at);
      plugins_ |= is_plugin(at);
      if (!is_call(at)) {
        const uint8_t flags = opcode_info(static_cast<Opcode>(instruction_opcode(p_.code[at]))).flags;
        depth += ((flags & kOpen) != 0) - ((flags & kClose) != 0);
      }
      if (depth == 0) return item;
      item.single = false;
    }
  }

  /// Behind the last item that stores what a derivative may look at. Derivatives that follow each other need
  /// no neighbours of their own, unless one is of another's result.
  void find_end() {
    bool follows = false;         // only derivatives between end_ and here
    std::vector<uint32_t> stored; // by these
    const uint32_t code_end = static_cast<uint32_t>(Opcode::k_end);
    for (uint32_t at = p_.sections[0]; p_.code[at] != code_end;) {
      const Item item = item_at(at);
      if (!item.derivative) {
        follows = follows && item.single && stores_uniform_only(at);
      } else if (!item.single || plugins_) {
        end_ = item.end;
        follows = false;
      } else {
        if (!follows || reads_any(at, stored)) {
          end_ = at;
          stored.clear();
        }
        follows = true;
        store_of(at, stored);
      }
      if (item.derivative) last_ = item.end;
      at = item.end;
    }
  }

  std::span<const uint32_t> words(uint32_t at) const {
    return std::span(p_.code).subspan(at + 1, instruction_words(p_.code[at]));
  }
  const std::vector<CallOperand>& operands(uint32_t at) {
    uint32_t level = 0;
    decode_call(p_.plugins.info(called(at)), words(at), operands_, level);
    return operands_;
  }
  bool stores_uniform_only(uint32_t at) {
    if (!is_call(at)) {
      const std::string_view kinds =
          opcode_info(static_cast<Opcode>(instruction_opcode(p_.code[at]))).operands;
      const size_t stored = kinds.find('d');
      return stored != kinds.npos && operand_space(words(at)[stored]) == Space::kUniform;
    }
    const auto& all = operands(at);
    return std::all_of(all.begin(), all.end(), [](const CallOperand& o) {
      return !o.store || operand_space(o.word) == Space::kUniform;
    });
  }
  bool reads_any(uint32_t at, const std::vector<uint32_t>& stored) {
    const auto& all = operands(at);
    return std::any_of(all.begin(), all.end(), [&](const CallOperand& o) {
      return !o.store && std::find(stored.begin(), stored.end(), o.word) != stored.end();
    });
  }
  void store_of(uint32_t at, std::vector<uint32_t>& stored) {
    for (const CallOperand& o : operands(at))
      if (o.store) stored.push_back(o.word);
  }

  /// What is read besides operands: lights may look at anything, questions to the renderer at the ray.
  void mark_unasked(uint32_t at, std::bitset<kGlobalCount>& read) {
    if (!is_call(at)) {
      if (static_cast<Opcode>(instruction_opcode(p_.code[at])) == Opcode::k_illuminance) read.set();
      return;
    }
    const ShadeopInfo& info = p_.plugins.info(called(at));
    if (info.flags & kLights) read.set();
    if (info.kind == ShadeopKind::kKernel || is_derivative(at) || stores_uniform_only(at)) return;
    for (Global g : {Global::kI, Global::kN, Global::kNg})
      read.set(static_cast<size_t>(g));
  }

  void mark_slots(uint32_t at, std::vector<bool>& read) {
    auto mark = [&](uint32_t word) {
      if (operand_space(word) == Space::kSlot) read[operand_index(word)] = true;
      if (operand_space(word) != Space::kArray) return;
      const ArrayInfo& array = p_.arrays[operand_index(word)];
      if (array.space == Space::kSlot) read[array.index] = true;
    };
    if (is_call(at)) {
      for (const CallOperand& o : operands(at))
        mark(o.word);
      return;
    }
    const std::string_view kinds = opcode_info(static_cast<Opcode>(instruction_opcode(p_.code[at]))).operands;
    for (size_t i = 0; i < kinds.size(); ++i)
      if (std::string_view("dsba").find(kinds[i]) != std::string_view::npos) mark(words(at)[i]);
  }

  const Program& p_;
  uint32_t end_ = 0, last_ = 0; ///< last_: behind the last derivative
  bool plugins_ = false;
  std::vector<CallOperand> operands_;
};

} // namespace

NeighbourUse find_neighbour_use(const Program& program) {
  return Reader(program).run();
}

} // namespace slvm
