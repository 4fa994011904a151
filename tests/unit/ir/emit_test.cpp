// Bytecode from IR: what emit() makes is sound and looks as it should.
#include "slvm/ir/emit.h"

#include "slvm/format/disasm.h"
#include "slvm/format/verify.h"
#include "tests/unit/ir/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slvm::ir {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Emit, SamplesAreSoundAtEveryLevel) {
  for (auto& [name, m] : samples())
    for (int level : {0, 1, 2}) {
      Program program = compile(m, level);
      EXPECT_EQ(verify_program(program), "") << name << " at level " << level << "\n" << disassemble(program);
    }
}

TEST(Emit, UniformCodeStandsBeforeTheStrips) {
  EXPECT_EQ(disassemble(compile(arithmetic())),
            "surface \"sample\": 2 uniform, 3 strip, 0 grid planes, mask depth 0\n"
            "main:\n"
            "    0   u0 = operator+ c1(1), c0(2)  ; line 2\n"
            "    4   u1 = operator* Kd, u0  ; line 3\n"
            "    8   strip ->23, 0  ; line 4\n"
            "   11     s0 = operator* N, u1  ; line 4\n"
            "   15     movm 3, Ci, s0  ; line 4\n"
            "   19     movm 3, Oi, Os  ; line 4\n"
            "   23   endstrip  ; line 4\n"
            "   24   end  ; line 4\n");
}

TEST(Emit, ALoopThatOnlyTestsBecomesAWhile) {
  std::string text = disassemble(compile(while_loop()));
  EXPECT_THAT(text, HasSubstr("while s1, ->24"));
  EXPECT_THAT(text, Not(HasSubstr("break")));
}

TEST(Emit, BarriersCutStripBlocks) {
  std::string text = disassemble(compile(messages()));
  size_t strip = text.find("strip ->"), derivative = text.find("Du"),
         second = text.find("strip ->", derivative);
  EXPECT_LT(strip, derivative);
  EXPECT_LT(derivative, second);
  EXPECT_THAT(text, HasSubstr("g1 = Du g0 at mask 0")); // its operand outlives the block
}

TEST(Emit, UniformCountersOfUniformLoopsTakeOneValue) {
  std::string text = disassemble(compile(array_sum()));
  EXPECT_THAT(text, HasSubstr("uwhile u"));
}

TEST(Emit, DefaultsAreSectionsOfTheirOwn) {
  Program program = compile(computed_default());
  ASSERT_EQ(program.sections.size(), 2u);
  EXPECT_EQ(program.params[0].init, 1);
  EXPECT_THAT(disassemble(program), HasSubstr("default of scale:"));
}

TEST(Emit, LinesFollowTheSource) {
  Program program = compile(arithmetic());
  ASSERT_FALSE(program.lines.empty());
  for (size_t i = 0; i < program.lines.size(); ++i) {
    EXPECT_EQ(program.lines[i].file, 1u);
    if (i == 0) continue;
    EXPECT_GT(program.lines[i].code, program.lines[i - 1].code);
  }
}

// Registers of one strip block are reused; a long sum does not take a plane for each term.
TEST(Emit, RegistersAreReused) {
  Sketch s;
  ValueId sum = s.read("s");
  for (int i = 0; i < 100; ++i)
    sum = s.add(s.multiply(sum, s.read("t")), s.read("s"));
  s.store("Ci", s.b.call("convert", "color(float x)", {sum}));
  Program program = compile(s.finish());
  EXPECT_EQ(verify_program(program), "");
  EXPECT_LE(program.strip_planes, 6u);
}

} // namespace
} // namespace slvm::ir
