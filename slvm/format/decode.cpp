// Operands of shadeop calls, by their signatures; the table of core instructions.
#include "slvm/format/decode.h"

namespace slvm {

const OpcodeInfo& opcode_info(Opcode op) {
  static constexpr OpcodeInfo kInfos[] = {
#define OPCODE(name, operands, flags, synopsis) {#name, operands, flags, synopsis},
#include "slvm/format/opcodes.def"
#undef OPCODE
  };
  return kInfos[static_cast<size_t>(op)];
}

namespace {

class CallDecoder {
public:
  CallDecoder(std::span<const uint32_t> words, std::vector<CallOperand>& out) : words_(words), out_(out) {}

  bool decode(const ShadeopInfo& info, uint32_t& level) {
    level = 0;
    if (info.flags & kDerivative) {
      if (words_.empty()) return false;
      level = words_.back();
      words_ = words_.first(words_.size() - 1);
    }
    uint32_t token_outputs = 0;
    if (info.flags & kTokenOut) {
      if (words_.empty()) return false;
      token_outputs = words_.back();
      words_ = words_.first(words_.size() - 1);
    }
    const Signature& s = info.signature;
    if (s.result != Type::kVoid && !take({0, s.result, true, false, s.uniform_result, 0}, false))
      return false;
    for (int i = 0; i < s.param_count; ++i) {
      const SignatureParam& p = s.param(i);
      if (p.output && !take({0, p.type, true, p.array, p.uniform, p.elements}, p.any)) return false;
    }
    for (; token_outputs > 0; --token_outputs)
      if (!take({0, Type::kFloat, true, false, false, 0}, true)) return false;
    for (int i = 0; i < s.param_count; ++i) {
      const SignatureParam& p = s.param(i);
      if (!p.input) continue;
      do {
        if (!take({0, p.type, false, p.array, p.uniform, p.elements}, p.any)) return false;
      } while (p.variadic && !words_.empty());
    }
    while (!s.token_set.empty() && !words_.empty())
      if (!take({0, Type::kString, false, false, true, 0}, false) ||
          !take({0, Type::kFloat, false, false, false, 0}, true))
        return false;
    return words_.empty();
  }

private:
  bool take(CallOperand operand, bool any) {
    if (any) {
      if (words_.size() < 2 || words_[0] >= kTypeCount) return false;
      operand.type = static_cast<Type>(words_[0]);
      words_ = words_.subspan(1);
      if (operand.type == Type::kVoid) return false;
    }
    if (words_.empty()) return false;
    operand.word = words_[0];
    words_ = words_.subspan(1);
    out_.push_back(operand);
    return true;
  }

  std::span<const uint32_t> words_;
  std::vector<CallOperand>& out_;
};

} // namespace

bool decode_call(const ShadeopInfo& info, std::span<const uint32_t> words, std::vector<CallOperand>& operands,
                 uint32_t& level) {
  operands.clear();
  return CallDecoder(words, operands).decode(info, level);
}

} // namespace slvm
