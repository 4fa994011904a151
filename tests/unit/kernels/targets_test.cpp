// What holds for every kernel on every target, whatever it computes: the table is complete, targets agree,
// uniform and varying operands mix freely, results may overwrite operands, lanes do not depend on each other.
#include "tests/unit/kernels/harness.h"
#include "tests/unit/kernels/reference.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace slvm::test {
namespace {

void expect_same(const std::vector<Value>& a, const std::vector<Value>& b, double max_ulps,
                 const std::string& what) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t lane = 0; lane < a[i].bits.size(); ++lane)
      for (size_t p = 0; p < a[i].planes(); ++p) {
        if (same_bits(a[i].bits[lane][p], b[i].bits[lane][p], a[i].type)) continue;
        ASSERT_LE(ulps_between(a[i].at(lane, p), b[i].at(lane, p)), max_ulps)
            << what << ": lane " << lane << " component " << p << ": " << a[i].at(lane, p) << " and "
            << b[i].at(lane, p);
      }
}

/// Strings in pools differ in id when interned in another order: reuse one pool in a test.
struct Bench {
  StringPool strings;
  std::mt19937 random{7};
};

/// Targets with and without fused multiply-add differ in functions made from SLEEF's.
double ulps_across_targets(ShadeopId row) {
  if (!is_transcendental(shadeop(row).name)) return 0;
  return shadeop(row).name == "rotate" ? 1e9 : 4; // rotate cancels: the reference test bounds its error
}

TEST(Table, EveryTargetHasEveryKernelAndNoOther) {
  ASSERT_FALSE(kernel_targets().empty());
  EXPECT_STREQ(kernel_table().target, kernel_targets()[0]);
  for (const char* target : kernel_targets()) {
    const KernelTable& table = *find_kernel_table(target);
    for (size_t i = 0; i < kShadeopCount; ++i) {
      auto row = static_cast<ShadeopId>(i);
      EXPECT_EQ(table[row] != nullptr, shadeop(row).kind == ShadeopKind::kKernel)
          << target << ": " << row_name(row);
    }
    EXPECT_EQ(kMaxLanes % table.width, 0u);
  }
}

TEST(Table, TargetsAreFoundByNameInAnyCase) {
  EXPECT_EQ(find_kernel_table("avx9"), nullptr);
  EXPECT_EQ(find_kernel_table("scalar"), find_kernel_table("SCALAR"));
}

TEST(Table, TheWidestTargetComesFirst) {
  for (const char* target : kernel_targets())
    EXPECT_LE(find_kernel_table(target)->width, kernel_table().width);
}

class EveryTarget : public testing::TestWithParam<const char*> {
protected:
  const KernelTable& table = *find_kernel_table(GetParam());
  const KernelTable& scalar = *find_kernel_table(kernel_targets().back());
};

TEST_P(EveryTarget, AgreesWithTheScalarOne) {
  for (Values values : {Values::kModerate, Values::kEdges})
    for (ShadeopId row : kernel_rows()) {
      Bench bench;
      Arguments arguments = make_arguments(row, 304, values, bench.random, bench.strings);
      expect_same(call(table, row, arguments, bench.strings), call(scalar, row, arguments, bench.strings),
                  ulps_across_targets(row), row_name(row));
      if (HasFatalFailure()) return;
    }
}

TEST_P(EveryTarget, TakesUniformOperandsInAnyMix) {
  for (ShadeopId row : kernel_rows()) {
    Bench bench;
    for (int trial = 0; trial < 12; ++trial) {
      auto set = static_cast<uint32_t>(bench.random());
      Arguments arguments = make_arguments(row, 48, Values::kEdges, bench.random, bench.strings, set);
      expect_same(call(table, row, arguments, bench.strings, {.uniform_set = set}),
                  call(table, row, arguments, bench.strings), 0, row_name(row));
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(EveryTarget, UniformCallsFillAllCopiesWithTheVaryingResult) {
  constexpr uint32_t kAll = ~0u;
  for (ShadeopId row : kernel_rows()) {
    if (shadeop(row).flags & kHiddenVarying) continue;
    Bench bench;
    Arguments arguments = make_arguments(row, kMaxLanes, Values::kEdges, bench.random, bench.strings, kAll);
    std::vector<Value> uniform = call(table, row, arguments, bench.strings, {.uniform_set = kAll});
    expect_same(uniform, call(table, row, arguments, bench.strings), 0, row_name(row));
    for (const Value& v : uniform)
      for (const auto& lane : v.bits)
        ASSERT_EQ(lane.size(), v.bits[0].size());
    for (const Value& v : uniform)
      for (const auto& lane : v.bits)
        for (size_t p = 0; p < lane.size(); ++p)
          ASSERT_TRUE(same_bits(lane[p], v.bits[0][p], v.type)) << row_name(row);
    if (HasFatalFailure()) return;
  }
}

TEST_P(EveryTarget, MayStoreOverAnOperand) {
  for (uint32_t uniform_set : {0u, ~0u})
    for (ShadeopId row : kernel_rows()) {
      Bench bench;
      size_t lanes = uniform_set ? kMaxLanes : 64;
      Arguments arguments =
          make_arguments(row, lanes, Values::kModerate, bench.random, bench.strings, uniform_set);
      expect_same(call(table, row, arguments, bench.strings, {.uniform_set = uniform_set, .in_place = true}),
                  call(table, row, arguments, bench.strings, {.uniform_set = uniform_set}), 0, row_name(row));
      if (HasFatalFailure()) return;
    }
}

TEST_P(EveryTarget, LanesDoNotDependOnTheirNumberOrPlace) {
  for (ShadeopId row : kernel_rows()) {
    Bench bench;
    Arguments whole = make_arguments(row, 304, Values::kModerate, bench.random, bench.strings);
    std::vector<Value> expected = call(table, row, whole, bench.strings);
    for (size_t lanes : {16, 32, 48, 64, 128}) {
      Arguments part = whole;
      size_t begin = 304 - lanes;
      part.lanes = lanes;
      for (Value& v : part.values)
        v.bits.erase(v.bits.begin(), v.bits.begin() + static_cast<ptrdiff_t>(begin));
      std::vector<Value> expected_part = expected;
      for (Value& v : expected_part)
        v.bits.erase(v.bits.begin(), v.bits.begin() + static_cast<ptrdiff_t>(begin));
      expect_same(call(table, row, part, bench.strings, {.first_point = static_cast<uint32_t>(begin)}),
                  expected_part, 0, row_name(row));
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(EveryTarget, MayLeaveOutTheFirstLanes) {
  for (ShadeopId row : kernel_rows()) {
    Bench bench;
    Arguments arguments = make_arguments(row, 64, Values::kModerate, bench.random, bench.strings);
    std::vector<Value> whole = call(table, row, arguments, bench.strings);
    std::vector<Value> rest = call(table, row, arguments, bench.strings, {.begin = 32});
    for (std::vector<Value>* results : {&whole, &rest})
      for (Value& v : *results)
        v.bits.erase(v.bits.begin(), v.bits.begin() + 32);
    expect_same(rest, whole, 0, row_name(row));
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EveryTarget,
                         testing::ValuesIn(kernel_targets().begin(), kernel_targets().end()),
                         [](const auto& target) { return std::string(target.param); });

TEST(Targets, FusedOnesAgreeToTheBitWithEachOther) {
  const KernelTable *avx2 = find_kernel_table("AVX2"), *avx3 = find_kernel_table("AVX3");
  if (!avx2 || !avx3) GTEST_SKIP() << "needs AVX2 and AVX-512";
  for (ShadeopId row : kernel_rows()) {
    Bench bench;
    Arguments arguments = make_arguments(row, 304, Values::kEdges, bench.random, bench.strings);
    expect_same(call(*avx2, row, arguments, bench.strings), call(*avx3, row, arguments, bench.strings), 0,
                row_name(row));
    if (HasFatalFailure()) return;
  }
}

} // namespace
} // namespace slvm::test
