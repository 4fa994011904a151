// The optional arguments of a call, by name. What they mean is the same for everything that shoots rays: this
// is where it is read.
#pragma once

#include "slvm/exec/grid_ops.h"
#include "slvm/exec/run.h"
#include "slvm/rays.h"

#include <string_view>
#include <utility>
#include <vector>

namespace slvm {

/// A value at each point: an operand, or a number that is the same everywhere.
struct PointValue {
  PointValue(float everywhere = 0) : otherwise(everywhere) {}
  explicit PointValue(const Operand& o) : operand(o), given(true) {}

  float at(size_t point, size_t component = 0) const {
    return given ? operand.plane(component)[operand.step ? point : 0] : otherwise;
  }

  Operand operand;
  bool given = false;
  float otherwise = 0;
};

class CallTokens {
public:
  /// Pairs from operand `first` of the call on. Of a token given twice the last one counts.
  CallTokens(const GridCall& call, size_t first);

  const GridOperand* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// "" when not given, or no string.
  std::string_view text(std::string_view name) const;
  /// At each point; `otherwise` when not given.
  PointValue values(std::string_view name, float otherwise) const;
  /// The same at all points: of a varying value that of the first active point.
  float number(std::string_view name, float otherwise) const;
  /// "minsamples", unless "adaptive" says that all rays are shot; 0: all.
  float fewest_samples() const;
  /// "weight", by its other name "importance".
  PointValue weight() const;
  /// What is the same for all rays. Messages tell of a name that is none of those there are.
  RayOptions ray_options(RayKind kind) const;

  /// f(name, operand), in order.
  template <class F> void for_each(F&& f) const {
    for (const auto& [name, operand] : pairs_)
      f(name, *operand);
  }

private:
  /// Which of `names` the token says; 0, with a message, when none.
  size_t choice(std::string_view token, std::initializer_list<std::string_view> names) const;

  const GridCall& call_;
  std::vector<std::pair<std::string_view, const GridOperand*>> pairs_;
};

/// A variable that a token names, and what becomes of it.
struct TokenOutput {
  std::string_view token;
  const GridOperand* to = nullptr;
  std::vector<float> values; ///< component c of point i at [c * points + i]; at first what the variable holds
};

/// The variables that the tokens of a call name (kTokenOut): those stored operands that follow the
/// signature's.
class TokenOutputs {
public:
  TokenOutputs(const GridCall& call, const CallTokens& tokens);
  std::span<TokenOutput> list() { return list_; }
  std::span<const TokenOutput> list() const { return list_; }
  /// Gives the variables their values, at active points.
  void store() const;

private:
  const ShaderRun& run_;
  std::vector<TokenOutput> list_;
};

/// How many of the operands are stored.
size_t count_stores(const GridCall& call);
/// Values as those of a TokenOutput, at active points; 0 elsewhere.
void store_planes(const ShaderRun& run, const GridOperand& out, std::span<const float> values);

/// The text of a string operand, at the first active point.
std::string_view text_of(const ShaderRun& run, const Operand& o);
/// The first active point.
size_t first_point(const ShaderRun& run);
/// A whole number of samples, at least 1; bounded, as a shader may ask for anything.
uint32_t sample_count(float asked);

/// Puts a number into a component of a result, at one point.
inline void put(const Operand& out, size_t component, size_t point, float value) {
  if (out.step)
    out.plane(component)[point] = value;
  else
    std::fill_n(out.plane(component), kMaxLanes, value);
}
/// All of it the same.
void fill(const ShaderRun& run, const GridOperand& out, float value);

} // namespace slvm
