// Every shadeop that needs no scene, called in a shader: operands constant, uniform, varying and mixed; under
// masks of all, no, one, every other and random points; on grids around the width of a vector; in strips of
// several widths; on every target. All must agree, to the bit, with the plainest way: varying operands, no
// mask, one strip.
#include "tests/unit/exec/call_matrix.h"
#include "tests/unit/exec/shading.h"

#include "slvm/kernels/table.h"

#include <bit>
#include <cmath>

namespace slvm {
namespace {

using namespace test;
using Classes = std::vector<OperandClass>;

struct Mask {
  const char* name;
  bool (*on)(size_t point, size_t points);
};
constexpr Mask kMasks[] = {
    {"all", [](size_t, size_t) { return true; }},
    {"none", [](size_t, size_t) { return false; }},
    {"one", [](size_t i, size_t n) { return i == n / 2; }},
    {"alternate", [](size_t i, size_t) { return i % 2 == 0; }},
    {"random", [](size_t i, size_t) { return (i * 2654435761u >> 13 & 3) == 0; }},
};

class CallMatrix : public testing::TestWithParam<const char*> {
protected:
  CallMatrix() {
    services_.spaces["tilted"] = {{0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0, 0, 0, 2, 0, 1, -1, 3, 1}};
    const auto width = static_cast<uint32_t>(kernel_table().width);
    for (uint32_t strip : {width < 16 ? 16u : width, 128u, 4096u})
      machines_.push_back(std::make_unique<Machine>(
          MachineOptions{.strip_points = strip, .target = GetParam(), .specialise = false}));
    sizes_ = {{1, 1}, {15, 1}, {16, 1}, {17, 1}, {25, 12}};
  }

  using Results = std::vector<std::vector<float>>; // by result, then component planes

  Results run(const Machine& machine, const Instance& instance, const MatrixCall& call, const Classes& values,
              std::pair<int, int> size, const Mask& mask) {
    Grid grid = square(size.first, size.second);
    grid.id = 3;
    call.fill(grid, values);
    float* m = grid.add_varying_primvar("m", Type::kFloat);
    for (size_t i = 0; i < grid.points(); ++i)
      m[i] = mask.on(i, grid.points()) ? 1.0f : 0.0f;
    ShadingContext context(machine, services_);
    context.shade({.surface = &instance}, grid);
    Results results;
    for (size_t r = 0; r < call.results().size(); ++r) {
      const Planes& planes = *context.output(instance, "r" + std::to_string(r));
      results.emplace_back();
      for (size_t c = 0; c < static_cast<size_t>(components(planes.type)); ++c)
        for (size_t i = 0; i < grid.points(); ++i)
          results.back().push_back(planes.get(c, i));
    }
    return results;
  }

  static void compare(const Results& expected, const Results& got, const MatrixCall& call, size_t points,
                      const Mask& mask, const std::string& what) {
    for (size_t r = 0; r < expected.size(); ++r)
      for (size_t k = 0; k < expected[r].size(); ++k) {
        const size_t point = k % points, component = k / points;
        const bool untouched_is_seven = call.results()[r] != Type::kMatrix || component % 5 == 0;
        const float wanted = mask.on(point, points) ? expected[r][k] : untouched_is_seven ? 7.0f : 0.0f;
        const float found = got[r][k];
        ASSERT_TRUE(std::bit_cast<uint32_t>(wanted) == std::bit_cast<uint32_t>(found) ||
                    (std::isnan(wanted) && std::isnan(found)))
            << what << ": r" << r << " component " << component << " at point " << point << " of " << points
            << " is " << found << ", not " << wanted;
      }
  }

  void check(ShadeopId id) {
    std::mt19937 random(id + 1u);
    const MatrixCall call(id, random);
    const Classes varying = adjusted(call, Classes(call.operands(), OperandClass::kVarying));
    const std::string reference_source = call.source(varying);
    auto reference = instantiate(*machines_.back(), reference_source);
    ASSERT_NE(reference, nullptr) << reference_source;
    for (Classes classes : combinations(call)) {
      const std::string source = call.source(classes);
      const auto slo = compile(source);
      for (size_t s = 0; s < sizes_.size(); ++s) {
        const Results expected = run(*machines_.back(), *reference, call, classes, sizes_[s], kMasks[0]);
        const auto& machine = machines_[s % machines_.size()];
        auto instance = machine->instantiate(*machine->load(slo), {}, {});
        ASSERT_TRUE(instance) << source << instance.error();
        for (const Mask& mask : kMasks)
          compare(expected, run(*machine, **instance, call, classes, sizes_[s], mask), call,
                  static_cast<size_t>(sizes_[s].first * sizes_[s].second), mask,
                  source + " under mask " + mask.name);
        if (HasFatalFailure()) return;
      }
    }
  }

  static Classes adjusted(const MatrixCall& call, Classes classes) {
    for (size_t i = 0; i < classes.size(); ++i) {
      OperandClass& c = classes[i];
      // Folded constants are those of the best target.
      if (c == OperandClass::kConstant && std::string_view(GetParam()) != kernel_targets()[0])
        c = OperandClass::kUniform;
      if (c == OperandClass::kVarying && call.operand(i).must_be_uniform) c = OperandClass::kUniform;
    }
    return classes;
  }

  // All of one class, and two mixtures.
  static std::vector<Classes> combinations(const MatrixCall& call) {
    std::vector<Classes> out;
    for (int mix = 0; mix < 5; ++mix) {
      Classes classes;
      for (size_t i = 0; i < call.operands(); ++i)
        classes.push_back(static_cast<OperandClass>(mix < 3 ? mix : (static_cast<int>(i) + mix) % 3));
      classes = adjusted(call, std::move(classes));
      if (std::find(out.begin(), out.end(), classes) == out.end()) out.push_back(classes);
    }
    return out;
  }

  TableServices services_;
  std::vector<std::unique_ptr<Machine>> machines_;
  std::vector<std::pair<int, int>> sizes_;
};

TEST_P(CallMatrix, AllWaysAgree) {
  size_t rows = 0;
  for (size_t i = 0; i < shadeops().size(); ++i) {
    if (!MatrixCall::can_call(static_cast<ShadeopId>(i))) continue;
    check(static_cast<ShadeopId>(i));
    if (HasFatalFailure()) return;
    ++rows;
  }
  EXPECT_GT(rows, 300u);
}

INSTANTIATE_TEST_SUITE_P(Targets, CallMatrix,
                         testing::ValuesIn(kernel_targets().begin(), kernel_targets().end()),
                         [](const auto& target) { return std::string(target.param); });

} // namespace
} // namespace slvm
