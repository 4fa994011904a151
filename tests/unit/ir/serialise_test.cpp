// IR as bytes: what is written is read again; nothing that is read can do harm.
#include "slvm/ir/serialise.h"

#include "slvm/format/verify.h"
#include "slvm/ir/emit.h"
#include "slvm/ir/passes/passes.h"
#include "slvm/ir/print.h"
#include "slvm/ir/verify_ir.h"
#include "tests/unit/ir/samples.h"

#include <gtest/gtest.h>

namespace slvm::ir {
namespace {

TEST(Serialise, RoundTripKeepsEverything) {
  for (auto& [name, m] : samples()) {
    infer_detail(m);
    auto back = deserialise(serialise(m));
    ASSERT_TRUE(back) << name << ": " << back.error();
    EXPECT_EQ(print(*back), print(m)) << name;
    EXPECT_EQ(back->params, m.params) << name;
    EXPECT_EQ(back->slots, m.slots) << name;
    EXPECT_EQ(back->files, m.files) << name;
  }
}

TEST(Serialise, BytesDependOnContentOnly) {
  for (auto& [name, m] : samples()) {
    auto bytes = serialise(m);
    EXPECT_EQ(serialise(*deserialise(bytes)), bytes) << name;
  }
}

TEST(Serialise, SourcePositionsSurvive) {
  Module m = arithmetic();
  Module back = *deserialise(serialise(m));
  ASSERT_EQ(back.body.body.size(), m.body.body.size());
  for (size_t i = 0; i < m.body.body.size(); ++i)
    EXPECT_EQ(back.insts[back.body.body[i]].where, m.insts[m.body.body[i]].where);
}

TEST(Serialise, LeavesDeadInstructionsBehind) {
  Module m = arithmetic();
  size_t before = serialise(m).size();
  Region unused;
  Builder b(m);
  b.set_region(&unused);
  b.number(17);
  Module back = *deserialise(serialise(m));
  EXPECT_EQ(back.insts.size(), m.insts.size() - 1);
  EXPECT_LE(serialise(m).size(), before + 8); // the constant itself stays
}

TEST(Serialise, UnknownShadeopIsNamed) {
  auto bytes = serialise(varying_branch());
  std::string text(bytes.begin(), bytes.end());
  size_t at = text.find("operator<");
  ASSERT_NE(at, text.npos);
  bytes[at + 8] = '#';
  auto back = deserialise(bytes);
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error(),
            "intermediate code: the built-in 'operator#' with signature 'bool(float a, float b)' is not in "
            "this version");
}

TEST(Serialise, RefusesTruncationAtEveryByte) {
  for (auto& [name, m] : samples()) {
    auto bytes = serialise(m);
    for (size_t n = 0; n < bytes.size(); ++n)
      EXPECT_FALSE(deserialise(std::span(bytes).first(n))) << name << " at " << n;
    bytes.push_back(0);
    EXPECT_FALSE(deserialise(bytes)) << name;
  }
}

TEST(Serialise, RefusesDeepNesting) {
  Sketch s;
  auto nest = [&](auto&& self, int depth) -> void {
    if (depth > 0)
      s.branch(
          s.less(s.read("s"), s.read("t")), {},
          [&] {
            self(self, depth - 1);
            s.b.yield({});
          },
          [&] { s.b.yield({}); });
  };
  nest(nest, static_cast<int>(kMaxNesting) + 5);
  auto back = deserialise(serialise(s.finish()));
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error(), "intermediate code: regions nested too deeply");
}

// Whatever deserialise() lets through, passes and emission must cope with.
TEST(Serialise, DamagedBytesNeverDoHarm) {
  uint32_t seed = 1;
  auto next = [&](size_t below) {
    seed = seed * 1664525u + 1013904223u;
    return (seed >> 8) % below;
  };
  int accepted = 0;
  for (auto& [name, m] : samples()) {
    auto bytes = serialise(m);
    for (int round = 0; round < 3000; ++round) {
      auto damaged = bytes;
      for (size_t k = 0; k <= next(3); ++k)
        damaged[next(damaged.size())] ^= static_cast<uint8_t>(1u << next(8));
      auto back = deserialise(damaged);
      if (!back) continue;
      ++accepted;
      ASSERT_EQ(verify_module(*back), "") << name;
      optimise(*back, round % 3, nullptr);
      ASSERT_EQ(verify_module(*back), "") << name << ", after the passes:\n" << print(*back);
      Program program;
      program.kind = back->kind;
      emit(*back, program);
      ASSERT_EQ(verify_program(program), "") << name << ":\n" << print(*back);
    }
  }
  EXPECT_GT(accepted, 100); // the test reaches what it is about
}

} // namespace
} // namespace slvm::ir
