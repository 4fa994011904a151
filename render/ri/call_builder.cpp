// Building calls. Pointers are checked for null and counts for their sign; that arrays are as long as they
// should be is the program's word.
#include "render/ri/call_builder.h"

#include "render/ri/filters.h"
#include "render/ri/tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace render::ri {

CallBuilder::CallBuilder(RequestId id, slvm::SourceRange where) {
  call_.id = id;
  call_.where = where;
  call_.arguments.resize(call_.info().arguments.size());
  for (Argument& a : call_.arguments)
    a.where = where;
}

Argument& CallBuilder::next() {
  Argument& a = call_.arguments[next_++];
  a.present = true;
  return a;
}

void CallBuilder::fail(RiError kind, std::string text) {
  if (problem_.text.empty()) problem_ = {kind, std::move(text)};
}

/// Whether an array can be read.
bool CallBuilder::check(const void* values, RtInt count) {
  if (count < 0)
    fail(RiError::kRange, fmt::format("the number of elements of '{}' is {}", info().name, count));
  else if (count > 0 && !values)
    fail(RiError::kMissingData, fmt::format("'{}' is a null pointer", info().name));
  return count >= 0 && (values || count == 0);
}

void CallBuilder::add(RtFloat value) {
  next().numbers.push_back(value);
}

void CallBuilder::add(RtInt value) {
  bool whole = info().kind == ArgumentKind::kInt;
  Argument& a = next();
  if (whole)
    a.ints.push_back(value);
  else
    a.numbers.push_back(static_cast<float>(value));
}

void CallBuilder::add(RtToken text) {
  if (!text) fail(RiError::kMissingData, fmt::format("'{}' is a null pointer", info().name));
  next().strings.emplace_back(text ? text : "");
}

void CallBuilder::add(Ints a) {
  bool good = check(a.values, a.count);
  Argument& out = next();
  if (good) out.ints.assign(a.values, a.values + a.count);
}

void CallBuilder::add(Floats a) {
  bool good = check(a.values, a.count);
  Argument& out = next();
  if (good) out.numbers.assign(a.values, a.values + a.count);
}

void CallBuilder::add(Texts a) {
  bool good = check(a.values, a.count);
  std::string_view name = info().name;
  Argument& out = next();
  for (RtInt i = 0; good && i < a.count; ++i) {
    if (!a.values[i]) fail(RiError::kMissingData, fmt::format("'{}' holds a null pointer", name));
    out.strings.emplace_back(a.values[i] ? a.values[i] : "");
  }
}

void CallBuilder::add(Point p) {
  bool good = check(p.values, 3);
  for (int i = 0; i < 3; ++i)
    next().numbers.push_back(good ? p.values[i] : 0);
}

void CallBuilder::add(Basis b) {
  bool good = check(b.matrix, 1);
  Argument& out = next();
  if (!good) return;
  if (std::string_view name = basis_name(b.matrix); !name.empty())
    out.strings.emplace_back(name);
  else
    out.numbers.assign(&b.matrix[0][0], &b.matrix[0][0] + 16);
}

void CallBuilder::add(Filter f) {
  std::string_view name = f.function ? filter_name(f.function) : "box";
  if (name.empty())
    fail(RiError::kIncapable, fmt::format("'{}' is a function of the program's own; expected one of ri.h, "
                                          "such as RiGaussianFilter",
                                          info().name));
  next().strings.emplace_back(name);
}

void CallBuilder::add(Handle h) {
  next().strings.push_back(fmt::format("{}", reinterpret_cast<uintptr_t>(h.handle)));
}

void CallBuilder::add(Optional o) {
  if (o.text)
    add(o.text);
  else
    ++next_;
}

void CallBuilder::add(Dash d) {
  if (d.present)
    next();
  else
    ++next_;
}

void CallBuilder::add(Vertices v) {
  if (v.count < 0)
    fail(RiError::kRange, fmt::format("the number of vertices is {}", v.count));
  else
    vertices_ = static_cast<size_t>(v.count);
}

SizesOfRequest CallBuilder::sizes_for(const ParameterList& list, const SizeTracker& tracker) {
  if (list.count < 0)
    fail(RiError::kRange, fmt::format("the number of parameters is {}", list.count));
  else if (list.count > 0 && (!list.tokens || !list.values))
    fail(RiError::kMissingData, "the parameter list is a null pointer");
  if (!problem_.text.empty()) return {};
  SizesOfRequest sizes = class_sizes(call_, tracker.steps(), vertices_);
  if (!sizes.ok()) fail(RiError::kConsistency, sizes.error);
  return sizes;
}

CallProblem CallBuilder::param(RtToken token, RtPointer values, const ClassSizes& sizes,
                               const SizeTracker& tracker) {
  if (!token) return {RiError::kBadToken, "a token of the parameter list is a null pointer"};
  auto declared = tracker.resolve(call_, token);
  if (!declared)
    return {RiError::kBadToken, declared.error() + "; RiDeclare says its type, or the token: \"float x\""};
  const Declaration& d = *declared;
  if (!values) return {RiError::kMissingData, fmt::format("the values of \"{}\" are a null pointer", token)};
  size_t count = sizes.of(d.storage) * static_cast<size_t>(d.width());
  Param p;
  p.token = token;
  p.where = call_.where;
  if (d.type == slvm::Type::kString) {
    auto texts = static_cast<const RtString*>(values);
    for (size_t i = 0; i < count; ++i) {
      if (!texts[i]) return {RiError::kMissingData, fmt::format("a text of \"{}\" is a null pointer", token)};
      p.strings.emplace_back(texts[i]);
    }
  } else if (d.integer) {
    auto ints = static_cast<const RtInt*>(values);
    p.numbers.assign(ints, ints + count);
  } else {
    auto floats = static_cast<const RtFloat*>(values);
    p.numbers.assign(floats, floats + count);
  }
  p.integers = d.integer || p.numbers.empty();
  call_.params.push_back(std::move(p));
  return {};
}

namespace {

RtInt sum(const RtInt* counts, int64_t n, int64_t step) {
  int64_t out = 0;
  for (int64_t i = 0; counts && i < n; ++i)
    out += std::max(counts[i * step], 0);
  return static_cast<RtInt>(std::min<int64_t>(out, std::numeric_limits<RtInt>::max()));
}

} // namespace

RtInt sum(const RtInt* counts, RtInt n) {
  return sum(counts, n, 1);
}

RtInt sum_of_every_second(const RtInt* counts, RtInt n, int first) {
  return sum(counts ? counts + first : nullptr, n, 2);
}

} // namespace render::ri
