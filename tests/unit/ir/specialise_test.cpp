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

} // namespace
} // namespace slvm
