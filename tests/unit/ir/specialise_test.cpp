// Binding starts from the IR that a file carries. What is wrong with it must not reach the machine: the
// program as it was compiled runs instead.
#include "slvm/format/slo.h"
#include "slvm/machine.h"
#include "tests/unit/ir/samples.h"

#include <gtest/gtest.h>

namespace slvm {
namespace {

std::unique_ptr<Instance> bind(const Program& program) {
  Machine machine;
  auto shader = machine.load(write_slo(program));
  EXPECT_TRUE(shader) << shader.error();
  auto instance = machine.instantiate(*shader, {});
  EXPECT_TRUE(instance) << instance.error();
  return std::move(*instance);
}

TEST(Specialise, FoldsParametersIn) {
  Program program = ir::compile(ir::arithmetic());
  auto instance = bind(program);
  EXPECT_NE(instance->program().code, program.code);
  EXPECT_LT(instance->program().code.size(), program.code.size());
}

TEST(Specialise, IgnoresDamagedIr) {
  Program program = ir::compile(ir::arithmetic());
  program.ir.resize(program.ir.size() / 2);
  EXPECT_EQ(bind(program)->program().code, program.code);
}

TEST(Specialise, IgnoresTheIrOfAnotherShader) {
  Program program = ir::compile(ir::arithmetic());
  program.ir = ir::compile(ir::varying_branch()).ir;
  EXPECT_EQ(bind(program)->program().code, program.code);
}

TEST(Instance, SaysWhatItsDerivativesDependOn) {
  ir::Sketch s;
  ir::ValueId rest = s.multiply(s.read("u"), s.b.slot(s.param("rest", Type::kFloat, {1}, true)));
  ir::ValueId slope = s.b.call("Du", "float(float x)",
                               {s.multiply(s.read("v"), s.b.slot(s.param("near", Type::kFloat, {1}, true)))});
  s.store("Ci", s.b.call("convert", "color(float x)", {s.add(rest, slope)}));
  auto instance = bind(ir::compile(s.finish()));
  const BesideReads& beside = instance->reads_beside();
  auto reads = [&](Global g) { return beside.predefined[static_cast<size_t>(g)]; };
  EXPECT_TRUE(reads(Global::kv));
  EXPECT_FALSE(reads(Global::ku));
  EXPECT_FALSE(reads(Global::kN));
  EXPECT_EQ(beside.parameters, std::vector<std::string>{"near"});
}

TEST(Instance, DerivativesOfLightDependOnAllThatLightsRead) {
  ir::Sketch s;
  ir::ValueId light =
      s.b.call("comp", "float(color c, float i)", {s.b.call("ambient", "color()", {}), s.number(0)});
  s.store("Ci", s.b.call("convert", "color(float x)", {s.b.call("Du", "float(float x)", {light})}));
  auto instance = bind(ir::compile(s.finish()));
  EXPECT_TRUE(instance->reads_beside().predefined.all());
}

TEST(Instance, WithoutDerivativesReadsNothingBeside) {
  auto instance = bind(ir::compile(ir::arithmetic()));
  EXPECT_TRUE(instance->reads_beside().predefined.none());
  EXPECT_TRUE(instance->reads_beside().parameters.empty());
}

} // namespace
} // namespace slvm
