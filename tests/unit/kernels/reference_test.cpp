// Every kernel against its reference in double precision, within the error the table states.
#include "tests/unit/kernels/harness.h"
#include "tests/unit/kernels/reference.h"

#include <algorithm>
#include <bit>

#include <gtest/gtest.h>

namespace slvm::test {
namespace {

/// Kernels without a reference, and the file that tests them.
constexpr std::string_view kTestedElsewhere[] = {
    "random",  "randomgrid", "randomvarying", "randomuniform", // random_test.cpp
    "concat",  "match",      "arraylength",                    // string_test.cpp
    "sixteen",                                                 // below
};

double ulp_of(double magnitude) {
  constexpr double kSmallest = 0x1p-126;
  int exponent;
  std::frexp(std::max(magnitude, kSmallest), &exponent);
  return std::ldexp(1.0, exponent - 24);
}

double number(const Value& v, size_t lane, size_t plane) {
  uint32_t bits = v.bits[lane][plane];
  if (v.type == Type::kBool) return bits != 0;
  return v.type == Type::kString ? double(bits) : double(std::bit_cast<float>(bits));
}

/// Half of the lanes get arguments from the reference's own range.
void draw_from_range(Arguments& arguments, const Reference& reference, std::mt19937& random) {
  std::uniform_real_distribution<float> draw(static_cast<float>(reference.low),
                                             static_cast<float>(reference.high));
  for (size_t i = 0; i < arguments.values.size(); ++i)
    if (Value& v = arguments.values[i];
        v.type != Type::kBool && v.type != Type::kString && !arguments.must_be_uniform[i])
      for (size_t lane = 0; lane < arguments.lanes; lane += 2)
        for (size_t p = 0; p < v.planes(); ++p)
          v.set(lane, p, draw(random));
}

void compare(ShadeopId row, const Reference& reference, const KernelTable& table, uint32_t seed) {
  StringPool strings;
  std::mt19937 random(seed);
  Arguments arguments = make_arguments(row, 1024, Values::kModerate, random, strings);
  draw_from_range(arguments, reference, random);
  std::vector<Value> got = call(table, row, arguments, strings);
  for (size_t lane = 0; lane < arguments.lanes; ++lane) {
    std::vector<double> in;
    for (const Value& v : arguments.values)
      for (size_t p = 0; p < v.planes(); ++p)
        in.push_back(number(v, lane, p));
    Expected expected[32];
    reference.function({shadeop(row).signature, &strings, in.size()}, in.data(), expected);
    const Expected* next = expected;
    for (const Value& v : got)
      for (size_t p = 0; p < v.planes(); ++p, ++next) {
        double result = number(v, lane, p);
        if (result == next->value || (std::isnan(result) && std::isnan(next->value))) continue;
        if (next->magnitude > 1e8 && !std::isinf(next->magnitude)) continue; // ill-conditioned: no claim
        ASSERT_LE(std::abs(result - next->value), (shadeop(row).ulps + 1e-6) * ulp_of(next->magnitude))
            << row_name(row) << " on " << table.target << ", component " << p << ": " << result
            << " instead of " << next->value << " for " << testing::PrintToString(in);
      }
  }
}

TEST(Reference, EveryKernelHasOneOrATestOfItsOwn) {
  for (ShadeopId row : kernel_rows()) {
    bool elsewhere = std::find(std::begin(kTestedElsewhere), std::end(kTestedElsewhere), shadeop(row).name) !=
                     std::end(kTestedElsewhere);
    EXPECT_NE(find_reference(row) != nullptr, elsewhere) << row_name(row);
  }
}

class ReferenceOn : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceOn, KernelsAreWithinTheirBounds) {
  for (ShadeopId row : kernel_rows())
    if (const Reference* reference = find_reference(row))
      // A call has one value of each string: several calls see them all.
      for (uint32_t seed = 1;
           seed <= (shadeop(row).signature_text.find("string") == std::string_view::npos ? 2 : 24); ++seed) {
        compare(row, *reference, *find_kernel_table(GetParam()), seed);
        if (HasFatalFailure()) return;
      }
}

INSTANTIATE_TEST_SUITE_P(Kernels, ReferenceOn,
                         testing::ValuesIn(kernel_targets().begin(), kernel_targets().end()),
                         [](const auto& target) { return std::string(target.param); });

TEST(Reference, SixteenElementsMakeAMatrixRowByRow) {
  std::vector<float> elements;
  for (int i = 0; i < 16; ++i)
    elements.push_back(static_cast<float>(i));
  EXPECT_EQ(call_floats("sixteen", "matrix(float elements...)", elements), elements);
}

// ---- The rules of the language that random arguments would miss

float one(std::string_view name, std::string_view signature, const std::vector<float>& arguments) {
  return call_floats(name, signature, arguments)[0];
}
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Rules, ModIsNeverNegativeAndStaysBelowAPositiveDivisor) {
  auto mod = [](float a, float b) { return one("mod", "float(float a, float b)", {a, b}); };
  EXPECT_EQ(mod(7, 3), 1);
  EXPECT_EQ(mod(-7, 3), 2);
  EXPECT_EQ(mod(6, 3), 0);
  EXPECT_EQ(mod(7, -3), -2);
  EXPECT_EQ(mod(-1e-10f, 1), 0);
  EXPECT_EQ(mod(0.3f, 0.1f), 0.3f - 3 * 0.1f + (0.3f - 3 * 0.1f < 0 ? 0.1f : 0));
  EXPECT_TRUE(std::isnan(mod(1, 0)));
  for (float a = -5; a < 5; a += 0.0371f) {
    EXPECT_GE(mod(a, 0.7f), 0);
    EXPECT_LT(mod(a, 0.7f), 0.7f);
  }
}
TEST(Rules, RootsOfNegativeNumbersAreZero) {
  EXPECT_EQ(one("sqrt", "float(float x)", {-4}), 0);
  EXPECT_EQ(one("inversesqrt", "float(float x)", {-4}), 0);
  EXPECT_EQ(one("inversesqrt", "float(float x)", {0}), 0);
  EXPECT_EQ(one("inversesqrt", "float(float x)", {4}), 0.5f);
}
TEST(Rules, PowersWithoutRealAnswerAreZero) {
  auto pow = [](float x, float y) { return one("pow", "float(float x, float y)", {x, y}); };
  EXPECT_EQ(pow(0, 0), 1);
  EXPECT_EQ(pow(-8, 1.0f / 3), 0);
  EXPECT_EQ(pow(-2, 3), -8);
  EXPECT_EQ(pow(0, -1), kInfinity);
  EXPECT_EQ(pow(2, 0.5f), std::sqrt(2.0f));
}
TEST(Rules, InverseSinesClampTheirArgument) {
  EXPECT_FLOAT_EQ(one("asin", "float(float a)", {1.5f}), 1.57079633f);
  EXPECT_EQ(one("acos", "float(float a)", {1.5f}), 0);
}
TEST(Rules, HalvesRoundUpwards) {
  auto round = [](float x) { return one("round", "float(float x)", {x}); };
  EXPECT_EQ(round(2.5f), 3);
  EXPECT_EQ(round(-2.5f), -2);
  EXPECT_EQ(round(0.49999997f), 0);
  EXPECT_EQ(round(8388609), 8388609);
  EXPECT_EQ(round(-kInfinity), -kInfinity);
}
TEST(Rules, SignOfZeroIsZero) {
  EXPECT_EQ(one("sign", "float(float x)", {0}), 0);
  EXPECT_EQ(one("sign", "float(float x)", {-0.1f}), -1);
}
TEST(Rules, ClampWithCrossedBoundsTestsTheLowerOneFirst) {
  auto clamp = [](float x) { return one("clamp", "float(float a, float lo, float hi)", {x, 2, 1}); };
  EXPECT_EQ(clamp(0), 2);
  EXPECT_EQ(clamp(1.5f), 2);
  EXPECT_EQ(clamp(3), 1);
}
TEST(Rules, SmoothstepOfEqualEdgesIsAStep) {
  auto smoothstep = [](float x) {
    return one("smoothstep", "float(float min, float max, float x)", {1, 1, x});
  };
  EXPECT_EQ(smoothstep(0.5f), 0);
  EXPECT_EQ(smoothstep(1), 1);
  EXPECT_EQ(smoothstep(2), 1);
}
TEST(Rules, SingularMatricesInvertToZero) {
  std::vector<float> arguments(17, 1.0f);
  for (float x : call_floats("operator/", "matrix(float a, matrix b)", arguments))
    EXPECT_EQ(x, 0);
}
TEST(Rules, TheZeroVectorStaysZeroWhenNormalized) {
  EXPECT_EQ(call_floats("normalize", "vector(vector v)", {0, 0, 0}), (std::vector<float>{0, 0, 0}));
}
TEST(Rules, FresnelReflectsEverythingBeyondTheCriticalAngle) {
  // Straight on between air and glass: ((n-1)/(n+1))^2 = 0.04 for n = 1.5.
  auto fresnel = [](float angle, float eta) {
    float s = std::sin(angle), c = std::cos(angle);
    return call_floats("fresnel", "void(vector I, vector N, float eta, output float Kr, output float Kt)",
                       {s, -c, 0, 0, 1, 0, eta});
  };
  EXPECT_NEAR(fresnel(0, 1 / 1.5f)[0], 0.04f, 1e-6f);
  EXPECT_NEAR(fresnel(0, 1 / 1.5f)[1], 0.96f, 1e-6f);
  EXPECT_EQ(fresnel(1.2f, 1.5f)[0], 1);
  EXPECT_EQ(fresnel(1.2f, 1.5f)[1], 0);
}

} // namespace
} // namespace slvm::test
