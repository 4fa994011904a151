// Programs as text: one instruction a line, registers named by space (c constant, u uniform, s strip, g grid,
// slots by name, @ arrays), regions indented.
#include "slvm/format/disasm.h"

#include "slvm/format/decode.h"

#include <algorithm>
#include <fmt/format.h>

namespace slvm {
namespace {

class Disassembler {
public:
  Disassembler(const Program& p, const LineText& text) : p_(p), text_(text) {}

  std::string run() {
    out_ = fmt::format("{} \"{}\": {} uniform, {} strip, {} grid planes, mask depth {}\n",
                       shader_kind_name(p_.kind), p_.name, p_.uniform_planes, p_.strip_planes, p_.grid_planes,
                       p_.mask_depth);
    size_t line = 0;
    for (uint32_t at = 0; at < p_.code.size();) {
      if (auto it = std::find(p_.sections.begin(), p_.sections.end(), at); it != p_.sections.end())
        section(it - p_.sections.begin());
      while (line < p_.lines.size() && p_.lines[line].code <= at)
        ++line;
      const LineEntry* entry = line ? &p_.lines[line - 1] : nullptr;
      if (text_ && entry) source_line(*entry);
      at += instruction(at, entry && !text_ ? entry->line : 0);
    }
    return std::move(out_);
  }

private:
  void section(std::ptrdiff_t index) {
    indent_ = 1;
    shown_ = {};
    if (index == 0) out_ += "main:\n";
    for (const Param& param : p_.params)
      if (index > 0 && param.init == index) out_ += fmt::format("default of {}:\n", param.name);
  }

  void source_line(const LineEntry& entry) {
    if (entry.file == shown_.file && entry.line == shown_.line) return;
    shown_ = entry;
    std::string_view file = entry.file < p_.files.size() ? std::string_view(p_.files[entry.file]) : "";
    std::string text = text_(entry.file, entry.line);
    out_ += fmt::format("; {}:{}{}{}\n", file, entry.line, text.empty() ? "" : ": ", text);
  }

  std::string operand(uint32_t word) const {
    uint32_t index = operand_index(word);
    switch (operand_space(word)) {
    case Space::kConstant:
      for (auto [plane, text] : p_.string_constants)
        if (plane == index) return fmt::format("\"{}\"", p_.strings[text]);
      return fmt::format("c{}({})", index, p_.constants[index]);
    case Space::kUniform: return fmt::format("u{}", index);
    case Space::kStrip: return fmt::format("s{}", index);
    case Space::kGrid: return fmt::format("g{}", index);
    case Space::kSlot: return p_.slots[index].name;
    case Space::kArray: return fmt::format("@{}[{}]", index, p_.arrays[index].elements);
    }
    return "?";
  }

  uint32_t instruction(uint32_t at, uint32_t line) {
    uint16_t opcode = instruction_opcode(p_.code[at]);
    uint32_t count = instruction_words(p_.code[at]);
    auto words = std::span(p_.code).subspan(at + 1, count);
    std::string text;
    int indent = indent_;
    if (opcode < kFirstShadeop) {
      const OpcodeInfo& info = opcode_info(static_cast<Opcode>(opcode));
      if (info.flags & (kClose | kMiddle)) indent = --indent_;
      if (info.flags & (kOpen | kMiddle)) ++indent_;
      text = info.name;
      for (size_t i = 0; i < words.size(); ++i) {
        char kind = info.operands[i];
        text += i ? ", " : " ";
        text += kind == 't'                  ? fmt::format("->{}", words[i])
                : kind == 'n' || kind == 'p' ? fmt::format("{}", words[i])
                                             : operand(words[i]);
      }
    } else {
      text = call(opcode, words);
    }
    out_ += fmt::format("{:5} {:{}}{:<60}", at, "", indent * 2, text);
    while (out_.back() == ' ')
      out_.pop_back();
    if (line) out_ += fmt::format("  ; line {}", line);
    out_ += '\n';
    return 1 + count;
  }

  std::string call(uint16_t opcode, std::span<const uint32_t> words) {
    const ShadeopInfo& info = p_.plugins.info(p_.imports[opcode - kFirstShadeop]);
    uint32_t level = 0;
    std::string stores, reads;
    if (!decode_call(info, words, operands_, level)) return std::string(info.name) + " ?";
    for (const CallOperand& o : operands_) {
      std::string& list = o.store ? stores : reads;
      list += (list.empty() ? "" : ", ") + operand(o.word);
    }
    std::string text = stores.empty() ? "" : stores + " = ";
    text += fmt::format("{} {}", info.name, reads);
    if (info.flags & kDerivative) text += fmt::format(" at mask {}", level);
    return text;
  }

  const Program& p_;
  const LineText& text_;
  LineEntry shown_; // the source line shown last
  std::string out_;
  std::vector<CallOperand> operands_;
  int indent_ = 1;
};

} // namespace

std::string disassemble(const Program& program, const LineText& text) {
  return Disassembler(program, text).run();
}

} // namespace slvm
