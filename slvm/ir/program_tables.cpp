#include "slvm/ir/program_tables.h"

#include "slvm/format/decode.h"

#include <algorithm>

namespace slvm::ir {

ProgramTables::ProgramTables(const Module& m, Program& p)
    : m_(m), p_(p), constant_words_(m.constants.size(), ~0u) {
  p.slots = m.slots;
  p.params = m.params;
  for (Param& param : p.params)
    if (param.init >= 0) ++param.init; // section 0 is the shader itself
  for (const Array& a : m.arrays) {
    ArrayInfo info{a.type, a.elements, Space::kSlot, static_cast<uint32_t>(a.slot)};
    if (a.slot < 0) {
      const uint32_t planes = a.elements * static_cast<uint32_t>(components(a.type));
      info.space = a.varying ? Space::kGrid : Space::kUniform;
      uint32_t& count = a.varying ? p.grid_planes : p.uniform_planes;
      info.index = count;
      count += planes;
    }
    p.arrays.push_back(info);
  }
}

LowOperand ProgramTables::constant(uint32_t index) {
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

LowOperand ProgramTables::number(float x) {
  auto it = std::find(p_.constants.begin(), p_.constants.end(), x);
  const auto index = static_cast<uint32_t>(it - p_.constants.begin());
  if (it == p_.constants.end()) p_.constants.push_back(x);
  return word(make_operand(Space::kConstant, index));
}

uint16_t ProgramTables::import(uint32_t shadeop_id) {
  auto id = static_cast<ShadeopId>(shadeop_id);
  if (m_.plugins.find(id)) id = *p_.plugins.add(m_.plugins.list()[id - kFirstPluginShadeop]);
  auto it = std::find(p_.imports.begin(), p_.imports.end(), id);
  const auto index = static_cast<uint16_t>(it - p_.imports.begin());
  if (it == p_.imports.end()) p_.imports.push_back(id);
  return static_cast<uint16_t>(kFirstShadeop + index);
}

} // namespace slvm::ir
