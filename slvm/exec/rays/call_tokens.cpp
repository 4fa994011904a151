// Optional arguments, by name.
#include "slvm/exec/rays/call_tokens.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace slvm {

std::string_view text_of(const ShaderRun& run, const Operand& o) {
  return run.state.machine.strings().text(std::bit_cast<uint32_t>(o.data[o.step ? first_point(run) : 0]));
}

size_t first_point(const ShaderRun& run) {
  const MaskWord* mask = run.mask.current();
  for (size_t i = 0; i < run.mask.words(); ++i)
    if (mask[i]) return i * kMaskWordLanes + static_cast<size_t>(std::countr_zero(mask[i]));
  return 0;
}

uint32_t sample_count(float asked) {
  constexpr float kMost = 1 << 20;
  return asked >= 1 ? static_cast<uint32_t>(std::min(std::floor(asked + 0.5f), kMost)) : 1;
}

void fill(const ShaderRun& run, const GridOperand& out, float value) {
  for (size_t c = 0; c < static_cast<size_t>(components(out.type)); ++c)
    std::fill_n(out.planes.plane(c), out.planes.step ? run.pitch : kMaxLanes, value);
}

size_t count_stores(const GridCall& call) {
  return static_cast<size_t>(std::count_if(call.operands.begin(), call.operands.end(),
                                           [](const GridOperand& o) { return o.store; }));
}

void store_planes(const ShaderRun& run, const GridOperand& out, std::span<const float> values) {
  fill(run, out, 0);
  for (size_t c = 0; c < static_cast<size_t>(components(out.type)); ++c)
    mask_for_each(run.mask.current(), run.points,
                  [&](size_t i) { put(out.planes, c, i, values[c * run.points + i]); });
}

TokenOutputs::TokenOutputs(const GridCall& call, const CallTokens& tokens) : run_(call.run) {
  const size_t stores = count_stores(call), points = run_.points;
  size_t next = 1;
  tokens.for_each([&](std::string_view name, const GridOperand& before) {
    const TokenInfo* token = find_token(call.info.signature.token_set, name);
    if (!token || !token->output || next >= stores) return;
    const GridOperand& to = call.operands[next++];
    if (to.array || components(to.type) != components(token->type)) return;
    TokenOutput& o = list_.emplace_back(TokenOutput{name, &to, {}});
    // What is not asked for keeps its value.
    o.values.resize(static_cast<size_t>(components(to.type)) * points);
    for (size_t c = 0; c < static_cast<size_t>(components(to.type)); ++c)
      for (size_t i = 0; i < points; ++i)
        o.values[c * points + i] = before.planes.plane(c)[before.planes.step ? i : 0];
  });
}

void TokenOutputs::store() const {
  for (const TokenOutput& o : list_)
    store_planes(run_, *o.to, o.values);
}

CallTokens::CallTokens(const GridCall& call, size_t first) : call_(call) {
  for (size_t i = first; i + 1 < call.operands.size(); i += 2)
    pairs_.emplace_back(text_of(call.run, call.operands[i].planes), &call.operands[i + 1]);
}

const GridOperand* CallTokens::find(std::string_view name) const {
  for (size_t i = pairs_.size(); i-- > 0;)
    if (pairs_[i].first == name) return pairs_[i].second;
  return nullptr;
}

std::string_view CallTokens::text(std::string_view name) const {
  const GridOperand* o = find(name);
  return o && o->type == Type::kString && !o->array ? text_of(call_.run, o->planes) : std::string_view();
}

PointValue CallTokens::values(std::string_view name, float otherwise) const {
  const GridOperand* o = find(name);
  return o && o->type == Type::kFloat && !o->array ? PointValue(o->planes) : PointValue(otherwise);
}

float CallTokens::number(std::string_view name, float otherwise) const {
  return values(name, otherwise).at(first_point(call_.run));
}

float CallTokens::fewest_samples() const {
  return number("adaptive", 1) != 0 ? std::max(number("minsamples", 0), 0.0f) : 0.0f;
}

PointValue CallTokens::weight() const {
  const GridOperand* o = find("weight");
  if (!o) o = find("importance");
  return o && is_triple(o->type) && !o->array ? PointValue(o->planes) : PointValue(1);
}

size_t CallTokens::choice(std::string_view token, std::initializer_list<std::string_view> names) const {
  const std::string_view given = text(token);
  if (given.empty()) return 0;
  const auto* it = std::find(names.begin(), names.end(), given);
  if (it != names.end()) return static_cast<size_t>(it - names.begin());
  call_.run.report(
      call_.code, MessageSeverity::kWarning,
      fmt::format("{}: \"{}\" is {}, not \"{}\"", call_.info.name, token, fmt::join(names, " or "), given),
      mask_count(call_.run.mask.current(), call_.run.points));
  return 0;
}

RayOptions CallTokens::ray_options(RayKind kind) const {
  RayOptions o;
  o.kind = kind;
  constexpr HitSides kSides[] = {HitSides::kBoth, HitSides::kFront, HitSides::kBack};
  o.sides = kSides[choice("hitsides", {"both", "front", "back"})];
  constexpr HitMode kModes[] = {HitMode::kDefault, HitMode::kPrimitive, HitMode::kShader};
  o.mode = kModes[choice("hitmode", {"default", "primitive", "shader"})];
  o.label = text("label");
  o.subset = text("subset");
  const float calls = number(":call", 0); // the compiler counts them
  o.seed = calls >= 0 && calls < 0x1p31f ? static_cast<uint32_t>(calls) : 0;
  o.seed ^= std::bit_cast<uint32_t>(number("seed", 0)) * 0x9e3779b1u; // odd: no two numbers fall together
  return o;
}

} // namespace slvm
