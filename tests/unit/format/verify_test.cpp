// The bytecode verifier: accepts what emit() makes, refuses each kind of damage with its own text.
#include "slvm/format/verify.h"

#include "slvm/format/decode.h"
#include "slvm/format/disasm.h"
#include "tests/unit/ir/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slvm {
namespace {

using testing::HasSubstr;

/// The word where the first instruction `op` begins.
uint32_t find(const Program& p, Opcode op) {
  for (uint32_t at = 0; at < p.code.size(); at += 1 + instruction_words(p.code[at]))
    if (instruction_opcode(p.code[at]) == static_cast<uint16_t>(op)) return at;
  throw std::logic_error("the sample has no such instruction");
}
uint32_t find_call(const Program& p) {
  for (uint32_t at = 0; at < p.code.size(); at += 1 + instruction_words(p.code[at]))
    if (instruction_opcode(p.code[at]) >= kFirstShadeop) return at;
  throw std::logic_error("the sample calls nothing");
}
/// Operand `i` of the first `op`.
uint32_t& operand(Program& p, Opcode op, uint32_t i) {
  return p.code[find(p, op) + 1 + i];
}
void replace(Program& p, Opcode op, Opcode by) {
  uint32_t& head = p.code[find(p, op)];
  head = (head & 0xffff0000u) | static_cast<uint32_t>(by);
}

struct Case {
  const char* what;
  ir::Module (*make)();
  void (*damage)(Program&);
  const char* expected;
};

class Damage : public testing::TestWithParam<Case> {};

TEST_P(Damage, IsRefused) {
  Program program = ir::compile(GetParam().make());
  ASSERT_EQ(verify_program(program), "");
  GetParam().damage(program);
  EXPECT_THAT(verify_program(program), HasSubstr(GetParam().expected)) << GetParam().what;
}

const Case kCases[] = {
    // Tables.
    {"TooManyRegisters", ir::arithmetic, [](Program& p) { p.grid_planes = kMaxPlanes + 1; },
     "more registers than allowed"},
    {"TooDeepMasks", ir::arithmetic, [](Program& p) { p.mask_depth = kMaxMaskDepth + 1; },
     "masks nested deeper than allowed"},
    {"SlotOfNoType", ir::arithmetic, [](Program& p) { p.slots[0].type = Type::kBool; },
     "variable 'Kd' has no type"},
    {"SlotOfUnknownName", ir::arithmetic, [](Program& p) { p.slots[1].name = "Q"; },
     "'Q' is not a predefined variable"},
    {"DefaultOfAnotherSize", ir::arithmetic,
     [](Program& p) { p.params[0].default_value.numbers.push_back(1); }, "default of parameter 'Kd'"},
    {"ParamOfAnotherDetail", ir::arithmetic, [](Program& p) { p.params[0].varying = true; },
     "parameter 'Kd' does not agree"},
    {"ParamWithoutDefault", ir::arithmetic, [](Program& p) { p.params[0].default_known = false; },
     "parameter 'Kd' has no default"},
    {"DefaultWithoutCode", ir::computed_default, [](Program& p) { p.params[0].init = 7; },
     "the default of parameter 'scale' has no code"},
    {"StringOutOfBounds", ir::messages, [](Program& p) { p.string_constants[0].second = 99; },
     "a string constant out of bounds"},
    {"ArrayOutOfBounds", ir::array_sum, [](Program& p) { p.arrays[0].elements = 5000; },
     "an array out of bounds"},
    {"LineInNoFile", ir::arithmetic, [](Program& p) { p.lines[0].file = 50; },
     "a line table entry names no file"},
    {"NoCode", ir::arithmetic, [](Program& p) { p.sections.clear(); }, "no code"},
    {"SectionOutOfBounds", ir::arithmetic, [](Program& p) { p.sections.push_back(5000); },
     "a code section out of bounds"},
    // Instructions.
    {"UnknownInstruction", ir::arithmetic, [](Program& p) { replace(p, Opcode::k_strip, Opcode::kCount); },
     "no such instruction"},
    {"InstructionTooLong", ir::arithmetic, [](Program& p) { p.code[find(p, Opcode::k_end)] |= 7u << 16; },
     "the instruction does not fit"},
    {"WrongOperandCount", ir::arithmetic, [](Program& p) { replace(p, Opcode::k_strip, Opcode::k_mov); },
     "wrong number of operands"},
    {"NoEnd", ir::arithmetic, [](Program& p) { p.code.pop_back(); }, "the section does not end"},
    {"CodeAfterEnd", ir::arithmetic, [](Program& p) { p.code.push_back(0); }, "code after the end"},
    {"NotClosed", ir::arithmetic,
     [](Program& p) { p.code.erase(p.code.begin() + find(p, Opcode::k_endstrip)); },
     "a region is not closed"},
    {"EndOfNothing", ir::arithmetic, [](Program& p) { replace(p, Opcode::k_end, Opcode::k_endstrip); },
     "the end of a region that is not open"},
    {"ElseWithoutIf", ir::while_loop, [](Program& p) { replace(p, Opcode::k_loop, Opcode::k_else); },
     "an else without if"},
    {"StripInStrip", ir::varying_branch, [](Program& p) { replace(p, Opcode::k_if, Opcode::k_strip); },
     "an instruction for whole grids in a strip block"},
    {"MasksDeeperThanDeclared", ir::varying_branch, [](Program& p) { p.mask_depth = 0; },
     "masks nest deeper than declared"},
    {"LightLoopInLight", ir::illuminance_loop, [](Program& p) { p.kind = ShaderKind::kLight; },
     "a light loop in a light"},
    {"ConeInSurface", ir::cone_light, [](Program& p) { p.kind = ShaderKind::kSurface; },
     "a light cone in a shader that is no light"},
    {"RaysOfNoCall", ir::gather_loop,
     [](Program& p) {
       for (ShadeopId& id : p.imports)
         if (shadeop(id).name == "gather") id = shadeop_overloads("traverse")[0]; // takes other operands
     },
     "operands do not fit 'traverse'"},
    {"LoopOverNoRays", ir::arithmetic,
     [](Program& p) {
       p.code.insert(p.code.begin(), {static_cast<uint32_t>(Opcode::k_gather) | 2u << 16, 0, 0});
     },
     "a loop over the rays of no call"},
    // Operands.
    {"RegisterOutOfBounds", ir::while_loop, [](Program& p) { p.strip_planes = 1; },
     "a register out of bounds"},
    {"ConstantOutOfBounds", ir::arithmetic, [](Program& p) { p.constants.pop_back(); },
     "a constant out of bounds"},
    {"StoreToConstant", ir::arithmetic,
     [](Program& p) { operand(p, Opcode::k_mov, 1) = make_operand(Space::kConstant, 0); },
     "a store to a constant"},
    {"StoreToReadOnly", ir::arithmetic,
     [](Program& p) {
       for (Slot& s : p.slots)
         s.stored = false;
     },
     "a store to a read-only variable"},
    {"VariableOfAnotherSize", ir::arithmetic, [](Program& p) { operand(p, Opcode::k_mov, 0) = 1; },
     "a variable out of bounds"},
    {"CopyOfNoPlanes", ir::arithmetic, [](Program& p) { operand(p, Opcode::k_mov, 0) = 0; },
     "a copy of no or too many planes"},
    {"StripRegisterOutside", ir::computed_default,
     [](Program& p) {
       p.strip_planes = 1;
       p.code[p.code.size() - 2] = make_operand(Space::kStrip, 0);
     },
     "a strip register outside strips"},
    {"OperandInNoSpace", ir::arithmetic, [](Program& p) { operand(p, Opcode::k_mov, 2) = 7u << 29; },
     "an operand in no known space"},
    {"VaryingUniformCondition", ir::array_sum,
     [](Program& p) { operand(p, Opcode::k_uwhile, 0) = make_operand(Space::kStrip, 0); },
     "a varying value where a uniform one must be"},
    {"ElementsOfAnotherSize", ir::array_sum, [](Program& p) { operand(p, Opcode::k_aload, 0) = 3; },
     "elements of another size"},
    {"LoadToVariable", ir::array_sum,
     [](Program& p) {
       p.slots[0].stored = true;
       operand(p, Opcode::k_aload, 1) = make_operand(Space::kSlot, 0);
     },
     "a load to a variable"},
    // Calls.
    {"CallOfNoImport", ir::arithmetic, [](Program& p) { p.imports.clear(); }, "a call of no import"},
    {"CallOfRslBody", ir::arithmetic, [](Program& p) { p.imports[0] = shadeop_overloads("Deriv")[0]; },
     "has no code of its own"},
    {"CallOfAnotherSignature", ir::arithmetic,
     [](Program& p) { p.imports[0] = shadeop_overloads("smoothstep")[0]; },
     "operands do not fit 'smoothstep'"},
    {"GridCallInStrip", ir::messages,
     [](Program& p) {
       for (ShadeopId& i : p.imports)
         if (shadeop(i).name == "operator+") i = shadeop_overloads("Du")[0];
     },
     "a call for whole grids in a strip block"},
    {"GridCallToVariable", ir::messages,
     [](Program& p) {
       for (uint32_t at = 0; at < p.code.size(); at += 1 + instruction_words(p.code[at])) {
         uint16_t opcode = instruction_opcode(p.code[at]);
         if (opcode >= kFirstShadeop && shadeop(p.imports[opcode - kFirstShadeop]).name == "Du")
           for (uint32_t slot = 0; slot < p.slots.size(); ++slot)
             if (p.slots[slot].name == "s")
               p.slots[slot].stored = true, p.code[at + 1] = make_operand(Space::kSlot, slot);
       }
     },
     "a call for whole grids that stores to a variable"},
    {"UniformResultOfVarying", ir::arithmetic,
     [](Program& p) { p.code[find_call(p) + 2] = make_operand(Space::kSlot, 1); },
     "a variable out of bounds"},
    // Jumps.
    {"JumpIntoTheBlue", ir::varying_branch, [](Program& p) { operand(p, Opcode::k_if, 1) = 1; },
     "a jump to where it must not go"},
    {"BackJumpElsewhere", ir::while_loop, [](Program& p) { operand(p, Opcode::k_endloop, 0) += 4; },
     "a jump to where it must not go"},
    {"BreakOutOfTooMuch", ir::nested_exits, [](Program& p) { operand(p, Opcode::k_break, 0) = 9; },
     "an exit from more loops than are open"},
    {"BreakOutOfNothing", ir::nested_exits, [](Program& p) { operand(p, Opcode::k_break, 0) = 0; },
     "an exit from more loops than are open"},
    {"WhileOutsideLoop", ir::while_loop,
     [](Program& p) {
       replace(p, Opcode::k_loop, Opcode::k_block);
       replace(p, Opcode::k_endloop, Opcode::k_endblock);
     },
     "wrong number of operands"},
};

INSTANTIATE_TEST_SUITE_P(VerifyProgram, Damage, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.what); });

// Any single changed word either is refused or leaves a program that can be read: the verifier itself is
// robust.
TEST(VerifyProgram, SurvivesEveryChangedWord) {
  constexpr uint32_t kValues[] = {0, 1, 2, 0xffff, 0x10000, 0x7fffffff, 0x80000000, 0xffffffff};
  for (auto& [name, m] : ir::samples()) {
    Program program = ir::compile(m);
    for (uint32_t& word : program.code)
      for (uint32_t value : kValues)
        for (uint32_t changed : {value, word ^ value, word + value}) {
          uint32_t kept = word;
          word = changed;
          if (verify_program(program).empty()) disassemble(program);
          word = kept;
        }
  }
}

} // namespace
} // namespace slvm
