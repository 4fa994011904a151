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
            "surface \"sample\": 2 uniform, 0 strip, 0 grid planes, mask depth 0\n"
            "main:\n"
            "    0   u0 = operator+ c1(1), c0(2)  ; line 2\n"
            "    4   u1 = operator* Kd, u0  ; line 3\n"
            "    8   strip ->19, 0  ; line 4\n"
            "   11     Ci = operator* N, u1  ; line 4\n"
            "   15     mov 3, Oi, Os  ; line 4\n"
            "   19   endstrip  ; line 4\n"
            "   20   end  ; line 4\n");
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

// x, y = x + y, 2 x y while x < 8: x is read after its next value is known, which therefore is computed last.
TEST(Emit, CarriedValuesAreComputedInPlace) {
  Sketch s;
  auto out = s.loop({s.read("s"), s.read("t"), s.number(0)}, [&](const std::vector<ValueId>& carried) {
    s.branch(
        s.less(carried[0], s.number(8)), {}, [&] { s.b.yield({}); }, [&] { s.b.break_out(0, carried); });
    ValueId x = s.add(carried[0], carried[1]);
    ValueId y = s.multiply(s.multiply(carried[0], carried[0]), carried[1]);
    s.b.next_round(0, {x, y, s.add(carried[2], s.read("s"))});
  });
  s.store("Ci", s.b.call("convert", "color(float x)", {out[2]}));
  std::string text = disassemble(compile(s.finish()));
  std::string round = text.substr(text.find("loop ->"));
  EXPECT_THAT(round, HasSubstr("s1 = operator* s3, s1")) << text;
  EXPECT_THAT(round, HasSubstr("s0 = operator+")) << text;
  size_t copy = round.find("mov");
  EXPECT_EQ(round.find("mov", copy + 4), std::string::npos) << text; // only what is read afterwards is copied
  EXPECT_THAT(round, HasSubstr("movm 1, s2, ")) << text;
}

// With two ways to the next round, lanes that took the first must keep their values: masked copies, all of
// them.
TEST(Emit, CarriedValuesOfLanesThatContinuedAreKept) {
  std::string text = disassemble(compile(nested_exits()));
  EXPECT_THAT(text, HasSubstr("continue"));
  EXPECT_THAT(text, HasSubstr("movm"));
}

TEST(Emit, QuestionsToTheSceneDoNotCutStripBlocks) {
  Sketch s;
  ValueId x = s.multiply(s.read("s"), s.read("t"));
  ValueId m = s.b.call("spacematrix", "uniform matrix(uniform string from, uniform string to)",
                       {s.b.string("world"), s.b.string("current")});
  ValueId p = s.b.call("transform", "point(matrix m, point p)", {m, s.read("P")});
  s.store("Ci", s.binary("operator*", "color(color a, float b)", s.b.retype(Type::kColor, p), x));
  std::string text = disassemble(compile(s.finish()));
  EXPECT_LT(text.find("spacematrix"), text.find("strip ->")) << text;
  EXPECT_EQ(text.find("strip ->"), text.rfind("strip ->")) << text;
}

TEST(Emit, LoopsOverRaysAreACallAndABracket) {
  std::string text = disassemble(compile(gather_loop()));
  const size_t call = text.find("gather \"\", P, N"), loop = text.find("gather ->"),
               break_out = text.find("break 1");
  EXPECT_LT(call, loop) << text;
  EXPECT_LT(loop, break_out);
  EXPECT_NE(text.find("gatherhit"), std::string::npos);
  EXPECT_NE(text.find("= gathered \"surface:Ci\""), std::string::npos);
  EXPECT_THAT(text, HasSubstr(", 1")); // lanes leave early
}

TEST(Emit, LoopsThatNobodyLeavesTraceAhead) {
  Module m = gather_loop();
  for (Inst& inst : m.insts)
    if (inst.op == Op::kBreak) inst = {Op::kYield, 0, {}, inst.args, {}, {}};
  std::string text = disassemble(compile(m));
  const size_t loop = text.find("gather ->");
  ASSERT_NE(loop, std::string::npos);
  EXPECT_EQ(text.substr(text.find(',', loop), 3), ", 0") << text;
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
