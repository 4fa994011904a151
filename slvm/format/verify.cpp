// The bytecode verifier. Tables first, then each code section in one walk that matches brackets and checks
// operands, and a second that checks jump targets against the brackets found.
#include "slvm/format/verify.h"

#include "slvm/format/decode.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace slvm {
namespace {

struct Failure {
  std::string text;
};

class TableVerifier {
public:
  explicit TableVerifier(const Program& p) : p_(p) {}

  void run() const {
    if (p_.uniform_planes > kMaxUniformPlanes || p_.strip_planes > kMaxPlanes || p_.grid_planes > kMaxPlanes)
      throw Failure{"more registers than allowed"};
    if (p_.mask_depth > kMaxMaskDepth) throw Failure{"masks nested deeper than allowed"};
    for (const Slot& s : p_.slots)
      check_slot(s);
    for (const Param& param : p_.params)
      check_param(param);
    for (auto [plane, text] : p_.string_constants)
      if (plane >= p_.constants.size() || text >= p_.strings.size())
        throw Failure{"a string constant out of bounds"};
    for (const ArrayInfo& a : p_.arrays)
      check_array(a);
    for (const LineEntry& l : p_.lines)
      if (l.file >= std::max<size_t>(p_.files.size(), 1)) throw Failure{"a line table entry names no file"};
    for (ShadeopId id : p_.imports)
      if (!p_.plugins.knows(id)) throw Failure{"an import of no shadeop"};
    for (const SourceCall& c : p_.facts.calls)
      if (c.file >= std::max<size_t>(p_.files.size(), 1)) throw Failure{"a call in the source names no file"};
    for (const SourceCall& c : p_.facts.calls)
      if (!p_.plugins.knows(c.shadeop)) throw Failure{"a call in the source of no shadeop"};
  }

private:
  void check_slot(const Slot& s) const {
    if (s.type == Type::kVoid || s.type == Type::kBool)
      throw Failure{fmt::format("variable '{}' has no type", s.name)};
    if (s.elements > kMaxUniformPlanes) throw Failure{fmt::format("array '{}' is too long", s.name)};
    if (s.parameter) return;
    Global g = find_global(s.name);
    if (g == Global::kCount || global_info(g).type != s.type || s.elements != 0)
      throw Failure{fmt::format("'{}' is not a predefined variable of this type", s.name)};
  }

  void check_param(const Param& p) const {
    if (p.type == Type::kVoid || p.type == Type::kBool || p.elements > kMaxUniformPlanes)
      throw Failure{fmt::format("parameter '{}' has no proper type", p.name)};
    if (!default_fits(p))
      throw Failure{fmt::format("the default of parameter '{}' does not fit its type", p.name)};
    if (p.slot < -1 || p.slot >= static_cast<int32_t>(p_.slots.size()))
      throw Failure{"a parameter without variable"};
    if (p.slot >= 0) {
      const Slot& s = p_.slots[static_cast<size_t>(p.slot)];
      if (!s.parameter || s.type != p.type || s.elements != p.elements || s.varying != p.varying)
        throw Failure{fmt::format("parameter '{}' does not agree with its variable", p.name)};
    }
    if (p.init == 0 || p.init < -1 || p.init >= static_cast<int32_t>(p_.sections.size()) ||
        (p.init > 0 && p.slot < 0))
      throw Failure{fmt::format("the default of parameter '{}' has no code", p.name)};
    if (p.init < 0 && !p.default_known) throw Failure{fmt::format("parameter '{}' has no default", p.name)};
  }

  void check_array(const ArrayInfo& a) const {
    uint64_t planes = uint64_t{a.elements} * static_cast<uint64_t>(components(a.type));
    bool ok = a.elements > 0 && planes > 0 && planes <= kMaxUniformPlanes;
    if (a.space == Space::kSlot)
      ok = ok && a.index < p_.slots.size() && p_.slots[a.index].elements == a.elements &&
           p_.slots[a.index].type == a.type;
    else if (a.space == Space::kUniform)
      ok = ok && a.index + planes <= p_.uniform_planes;
    else
      ok = ok && a.space == Space::kGrid && a.index + planes <= p_.grid_planes;
    if (!ok) throw Failure{"an array out of bounds"};
  }

  const Program& p_;
};

/// An open bracket, and after the walk a region.
struct Region {
  Opcode open;
  uint32_t begin = 0, middle = 0, end = 0; ///< words; middle 0: no else
  uint32_t body = 0;                       ///< first word after the opening instruction
  int32_t parent = -1;
};

class CodeVerifier {
public:
  CodeVerifier(const Program& p, uint32_t begin, uint32_t end) : p_(p), begin_(begin), section_end_(end) {}

  void run() {
    walk([this](uint32_t at, std::span<const uint32_t> words) { check_instruction(at, words); });
    if (!open_.empty()) fail(begin_, "a region is not closed");
    if (last_opcode_ != static_cast<uint16_t>(Opcode::k_end)) fail(section_end_, "the section does not end");
    walk([this](uint32_t at, std::span<const uint32_t> words) { check_targets(at, words); });
  }

private:
  [[noreturn]] void fail(uint32_t at, std::string_view what) const {
    throw Failure{fmt::format("code word {}: {}", at, what)};
  }

  template <class F> void walk(F&& visit) {
    for (uint32_t at = begin_; at < section_end_;) {
      uint32_t words = instruction_words(p_.code[at]);
      if (words >= section_end_ - at) fail(at, "the instruction does not fit");
      last_opcode_ = instruction_opcode(p_.code[at]);
      visit(at, std::span(p_.code).subspan(at + 1, words));
      at += 1 + words;
      if (last_opcode_ == static_cast<uint16_t>(Opcode::k_end) && at != section_end_)
        fail(at, "code after the end");
    }
  }

  // ---- First walk: brackets and operands.

  bool in_strip() const {
    for (int32_t r : open_)
      if (regions_[static_cast<size_t>(r)].open == Opcode::k_strip) return true;
    return false;
  }

  void check_instruction(uint32_t at, std::span<const uint32_t> words) {
    uint16_t opcode = instruction_opcode(p_.code[at]);
    if (opcode >= kFirstShadeop) return check_call(at, opcode, words);
    if (opcode >= static_cast<uint16_t>(Opcode::kCount)) fail(at, "no such instruction");
    auto op = static_cast<Opcode>(opcode);
    const OpcodeInfo& info = opcode_info(op);
    if (info.operands.size() != words.size()) fail(at, "wrong number of operands");
    if ((info.flags & kGridOnly) && in_strip()) fail(at, "an instruction for whole grids in a strip block");
    if (info.flags & kOpen)
      open_region(at, op, words);
    else if (info.flags & kMiddle)
      middle(at, op);
    else if (info.flags & kClose)
      close_region(at, op);
    check_operands(at, op, words);
    ray_call_before_ = false;
  }

  void open_region(uint32_t at, Opcode op, std::span<const uint32_t> words) {
    bool emitter = op == Opcode::k_illuminate || op == Opcode::k_solar;
    if (emitter && p_.kind != ShaderKind::kLight) fail(at, "a light cone in a shader that is no light");
    if (op == Opcode::k_illuminance && p_.kind == ShaderKind::kLight) fail(at, "a light loop in a light");
    if (is_light_statement(op))
      for (int32_t r : open_)
        if (is_light_statement(regions_[static_cast<size_t>(r)].open))
          fail(at, "light statements do not nest");
    if (op == Opcode::k_gather && !ray_call_before_) fail(at, "a loop over the rays of no call");
    if (emitter)
      for (Global g : {Global::kL, Global::kPs, Global::kNs})
        if (std::none_of(p_.slots.begin(), p_.slots.end(),
                         [&](const Slot& s) { return !s.parameter && s.name == global_info(g).name; }))
          fail(at, "a light cone without L, Ps and Ns");
    Region region{
        op, at, 0, 0, at + 1 + static_cast<uint32_t>(words.size()), open_.empty() ? -1 : open_.back()};
    open_.push_back(static_cast<int32_t>(regions_.size()));
    regions_.push_back(region);
    at_region_[at] = open_.back();
    uint32_t depth = 0;
    for (int32_t r : open_)
      depth += changes_mask(regions_[static_cast<size_t>(r)].open);
    if (depth > p_.mask_depth) fail(at, "masks nest deeper than declared");
  }
  static bool is_light_statement(Opcode op) {
    return op == Opcode::k_illuminance || op == Opcode::k_illuminate || op == Opcode::k_solar;
  }
  static bool changes_mask(Opcode op) { return op != Opcode::k_strip && op != Opcode::k_uif; }

  void middle(uint32_t at, Opcode op) {
    Opcode expected = op == Opcode::k_else ? Opcode::k_if : Opcode::k_uif;
    if (open_.empty()) fail(at, "an else without if");
    Region& r = regions_[static_cast<size_t>(open_.back())];
    if (r.open != expected || r.middle) fail(at, "an else without if");
    r.middle = at;
    at_region_[at] = open_.back();
  }

  void close_region(uint32_t at, Opcode op) {
    static constexpr std::pair<Opcode, Opcode> kPairs[] = {{Opcode::k_endstrip, Opcode::k_strip},
                                                           {Opcode::k_endif, Opcode::k_if},
                                                           {Opcode::k_uendif, Opcode::k_uif},
                                                           {Opcode::k_endloop, Opcode::k_loop},
                                                           {Opcode::k_endblock, Opcode::k_block},
                                                           {Opcode::k_endilluminance, Opcode::k_illuminance},
                                                           {Opcode::k_endilluminate, Opcode::k_illuminate},
                                                           {Opcode::k_endsolar, Opcode::k_solar},
                                                           {Opcode::k_endgather, Opcode::k_gather}};
    Opcode expected =
        std::find_if(std::begin(kPairs), std::end(kPairs), [&](auto p) { return p.first == op; })->second;
    if (open_.empty() || regions_[static_cast<size_t>(open_.back())].open != expected)
      fail(at, "the end of a region that is not open");
    regions_[static_cast<size_t>(open_.back())].end = at;
    at_region_[at] = open_.back();
    open_.pop_back();
  }

  // ---- Operands.

  bool is_varying(uint32_t at, uint32_t word) const {
    switch (operand_space(word)) {
    case Space::kConstant:
    case Space::kUniform: return false;
    case Space::kStrip:
    case Space::kGrid: return true;
    case Space::kSlot: return p_.slots[operand_index(word)].varying;
    case Space::kArray: {
      const ArrayInfo& a = p_.arrays[operand_index(word)];
      return a.space == Space::kSlot ? p_.slots[a.index].varying : a.space == Space::kGrid;
    }
    }
    fail(at, "an operand in no known space");
  }

  // Code sections behind the first store the default of their parameter, whatever the shader does with it.
  bool computes_default_of(uint32_t slot) const {
    for (const Param& param : p_.params)
      if (param.slot == static_cast<int32_t>(slot) && param.init > 0 &&
          p_.sections[static_cast<size_t>(param.init)] == begin_)
        return true;
    return false;
  }

  void check_register(uint32_t at, uint32_t word, uint32_t planes, bool stored) const {
    uint64_t end = uint64_t{operand_index(word)} + planes;
    uint32_t index = operand_index(word);
    switch (operand_space(word)) {
    case Space::kConstant:
      if (stored || end > p_.constants.size())
        fail(at, stored ? "a store to a constant" : "a constant out of bounds");
      return;
    case Space::kUniform:
      if (end > p_.uniform_planes) fail(at, "a register out of bounds");
      return;
    case Space::kStrip:
      if (end > p_.strip_planes) fail(at, "a register out of bounds");
      if (!in_strip()) fail(at, "a strip register outside strips");
      return;
    case Space::kGrid:
      if (end > p_.grid_planes) fail(at, "a register out of bounds");
      return;
    case Space::kSlot:
      if (index >= p_.slots.size() || p_.slots[index].elements ||
          static_cast<uint32_t>(components(p_.slots[index].type)) != planes)
        fail(at, "a variable out of bounds");
      if (stored && !p_.slots[index].stored && !computes_default_of(index))
        fail(at, "a store to a read-only variable");
      return;
    case Space::kArray: break;
    }
    fail(at, "an operand in no known space");
  }

  const ArrayInfo& check_array(uint32_t at, uint32_t word) const {
    if (operand_space(word) != Space::kArray || operand_index(word) >= p_.arrays.size())
      fail(at, "an array out of bounds");
    return p_.arrays[operand_index(word)];
  }

  void check_uniform(uint32_t at, uint32_t word) const {
    if (is_varying(at, word)) fail(at, "a varying value where a uniform one must be");
  }

  void check_operands(uint32_t at, Opcode op, std::span<const uint32_t> w) {
    switch (op) {
    case Opcode::k_mov:
    case Opcode::k_movm:
      if (w[0] == 0 || w[0] > 16) fail(at, "a copy of no or too many planes");
      check_register(at, w[1], w[0], true);
      check_register(at, w[2], w[0], false);
      if (!is_varying(at, w[1])) {
        check_uniform(at, w[2]);
        if (op == Opcode::k_movm) fail(at, "a masked copy to a uniform register");
      }
      return;
    case Opcode::k_first:
      if (w[0] == 0 || w[0] > 16) fail(at, "a copy of no or too many planes");
      check_register(at, w[1], w[0], true);
      check_register(at, w[2], w[0], false);
      check_uniform(at, w[1]);
      return;
    case Opcode::k_astart: check_writable_array(at, w[0]); return;
    case Opcode::k_aload: {
      const ArrayInfo& a = check_array(at, w[2]);
      if (w[0] != static_cast<uint32_t>(components(a.type))) fail(at, "elements of another size");
      check_register(at, w[1], w[0], true);
      check_register(at, w[3], 1, false);
      if (operand_space(w[1]) == Space::kSlot) fail(at, "a load to a variable");
      if (!is_varying(at, w[1]) && (is_varying(at, w[2]) || is_varying(at, w[3])))
        fail(at, "a varying element to a uniform register");
      return;
    }
    case Opcode::k_astore: {
      const ArrayInfo& a = check_writable_array(at, w[1]);
      if (w[0] != static_cast<uint32_t>(components(a.type))) fail(at, "elements of another size");
      check_register(at, w[2], 1, false);
      check_register(at, w[3], w[0], false);
      if (!is_varying(at, w[1])) check_uniform(at, w[2]), check_uniform(at, w[3]);
      return;
    }
    case Opcode::k_if:
    case Opcode::k_while: check_register(at, w[0], 1, false); return;
    case Opcode::k_uif:
    case Opcode::k_uwhile:
      check_register(at, w[0], 1, false);
      check_uniform(at, w[0]);
      return;
    case Opcode::k_illuminance:
      check_register(at, w[2], 1, false);
      check_uniform(at, w[2]);
      check_register(at, w[3], 3, false);
      check_register(at, w[4], 3, false);
      check_register(at, w[5], 1, false);
      return;
    case Opcode::k_illuminate:
      check_register(at, w[2], 3, false);
      check_register(at, w[3], 3, false);
      check_register(at, w[4], 1, false);
      return;
    case Opcode::k_solar:
      check_register(at, w[2], 3, false);
      check_register(at, w[3], 1, false);
      return;
    default: return;
    }
  }

  const ArrayInfo& check_writable_array(uint32_t at, uint32_t word) const {
    const ArrayInfo& a = check_array(at, word);
    if (a.space == Space::kSlot && !p_.slots[a.index].stored && !computes_default_of(a.index))
      fail(at, "a store to a read-only array");
    return a;
  }

  void check_call(uint32_t at, uint16_t opcode, std::span<const uint32_t> words) {
    size_t import = opcode - kFirstShadeop;
    if (import >= p_.imports.size()) fail(at, "a call of no import");
    const ShadeopInfo& info = p_.plugins.info(p_.imports[import]);
    if (info.kind == ShadeopKind::kRsl) fail(at, "a call of a function that has no code of its own");
    if (info.kind != ShadeopKind::kKernel && in_strip()) fail(at, "a call for whole grids in a strip block");
    uint32_t level = 0;
    if (!decode_call(info, words, operands_, level))
      fail(at, fmt::format("operands do not fit '{}'", info.name));
    if ((level & ~kScatteredLevel) > open_.size()) fail(at, "a mask level that is not open");
    ray_call_before_ = info.name == "gather" || info.name == "traverse";
    bool uniform_store = false;
    for (const CallOperand& o : operands_) {
      bool is_array = operand_space(o.word) == Space::kArray;
      if (o.array || is_array) {
        const ArrayInfo& a = check_array(at, o.word);
        if (components(a.type) != components(o.type) || (!o.array && info.kind == ShadeopKind::kKernel) ||
            (o.elements && o.elements != a.elements))
          fail(at, fmt::format("an array that does not fit '{}'", info.name));
        if (o.store) check_writable_array(at, o.word);
      } else {
        check_register(at, o.word, static_cast<uint32_t>(components(o.type)), o.store);
        if (o.store && operand_space(o.word) == Space::kSlot && info.kind != ShadeopKind::kKernel)
          fail(at, "a call for whole grids that stores to a variable");
      }
      // Of an array that varies a plug-in that wants a uniform one gets the first point's.
      if (o.uniform && !(is_array && info.kind == ShadeopKind::kPlugin)) check_uniform(at, o.word);
      if (o.store) uniform_store |= !is_varying(at, o.word);
      // Kernels run for as many lanes as what they store to has. Of an array, arraylength reads no lane at
      // all.
      else if (uniform_store && info.kind == ShadeopKind::kKernel && !is_array)
        check_uniform(at, o.word);
    }
    if (info.kind == ShadeopKind::kKernel) {
      size_t stores = 0, varying_stores = 0;
      for (const CallOperand& o : operands_)
        if (o.store) ++stores, varying_stores += is_varying(at, o.word);
      if (stores == 0 || (varying_stores != 0 && varying_stores != stores))
        fail(at, "results of mixed detail");
    }
  }

  // ---- Second walk: jump targets.

  // The word where the part of region `r` that `at` is in ends: its else, or its end.
  uint32_t part_end(int32_t r, uint32_t at) const {
    if (r < 0) return section_end_ - 1;
    const Region& region = regions_[static_cast<size_t>(r)];
    return region.middle > at ? region.middle : region.end;
  }

  void expect(uint32_t at, uint32_t target, uint32_t expected) const {
    if (target != expected) fail(at, "a jump to where it must not go");
  }

  void check_targets(uint32_t at, std::span<const uint32_t> w) {
    uint16_t opcode = instruction_opcode(p_.code[at]);
    if (opcode >= kFirstShadeop) return;
    auto op = static_cast<Opcode>(opcode);
    auto it = at_region_.find(at);
    const Region* own = it == at_region_.end() ? nullptr : &regions_[static_cast<size_t>(it->second)];
    uint8_t flags = opcode_info(op).flags;
    if (flags & kOpen) {
      open_.push_back(it->second);
      bool conditional = op == Opcode::k_if || op == Opcode::k_uif;
      expect(at, w[conditional ? 1 : 0], conditional && own->middle ? own->middle : own->end);
    } else if (flags & kMiddle) {
      expect(at, w[0], own->end);
    } else if (flags & kClose) {
      open_.pop_back();
      bool rounds = op == Opcode::k_endloop || op == Opcode::k_endilluminance || op == Opcode::k_endgather;
      if (rounds) expect(at, w[0], own->body);
      if (op != Opcode::k_endstrip) expect(at, w[rounds ? 1 : 0], part_end(own->parent, at));
    } else if (op == Opcode::k_while || op == Opcode::k_uwhile) {
      if (open_.empty() || regions_[static_cast<size_t>(open_.back())].open != Opcode::k_loop)
        fail(at, "a while outside a loop");
      expect(at, w[1], part_end(open_.back(), at));
    } else if (op == Opcode::k_break || op == Opcode::k_continue) {
      check_exit(at, op, w);
    }
  }

  void check_exit(uint32_t at, Opcode op, std::span<const uint32_t> w) {
    uint32_t to_pass = w[0];
    for (size_t i = open_.size(); i-- > 0 && to_pass > 0;) {
      Opcode open = regions_[static_cast<size_t>(open_[i])].open;
      if (open == Opcode::k_strip) break;
      if (!(opcode_info(open).flags & kLoops)) continue;
      if (--to_pass == 0 && op == Opcode::k_continue && open == Opcode::k_block)
        fail(at, "the next round of no loop");
    }
    if (w[0] == 0 || to_pass > 0) fail(at, "an exit from more loops than are open");
    expect(at, w[1], part_end(open_.empty() ? -1 : open_.back(), at));
  }

  const Program& p_;
  uint32_t begin_, section_end_;
  uint16_t last_opcode_ = 0;
  bool ray_call_before_ = false; // the instruction before is a call of gather or traverse
  std::vector<Region> regions_;
  std::vector<int32_t> open_;
  std::map<uint32_t, int32_t> at_region_;
  std::vector<CallOperand> operands_;
};

} // namespace

bool default_fits(const Param& param) {
  if (!param.default_known) return true;
  const Value& v = param.default_value;
  size_t count = param.elements ? param.elements : 1;
  size_t numbers = param.type == Type::kString ? 0 : count * static_cast<size_t>(components(param.type));
  size_t strings = param.type == Type::kString ? count : 0;
  return v.type == param.type && v.elements == param.elements && v.numbers.size() == numbers &&
         v.strings.size() == strings;
}

std::string verify_program(const Program& program) {
  try { // exceptions stay inside this function: the checks are many and nested
    TableVerifier(program).run();
    if (program.sections.empty() || program.sections[0] != 0) throw Failure{"no code"};
    for (size_t i = 0; i < program.sections.size(); ++i) {
      size_t end = i + 1 < program.sections.size() ? program.sections[i + 1] : program.code.size();
      if (end <= program.sections[i] || end > program.code.size())
        throw Failure{"a code section out of bounds"};
      CodeVerifier(program, program.sections[i], static_cast<uint32_t>(end)).run();
    }
  } catch (const Failure& failure) {
    return failure.text;
  }
  return "";
}

} // namespace slvm
