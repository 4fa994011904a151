// Random calls: every kind of argument of requests.def with hostile values among the plain ones.
#include "tests/render/random_calls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <limits>

namespace render::testing {

float RandomCalls::number() {
  constexpr float kSpecial[] = {0,           -0.0f,         1,
                                -1,          0.1f,          1e-38f,
                                1e38f,       3.4028235e38f, 1e-45f,
                                16777216,    123456.0f,     1e6f,
                                33554430.0f, 0.3f,          std::numeric_limits<float>::infinity()};
  switch (random_() % 4) {
  case 0: return kSpecial[random_() % std::size(kSpecial)];
  case 1: return static_cast<float>(static_cast<int>(random_() % 2001) - 1000);
  case 2: return static_cast<float>(static_cast<int>(random_() % 200001) - 100000) / 1000;
  default: // any bits
    for (;;) {
      auto x = std::bit_cast<float>(static_cast<uint32_t>(random_()));
      if (x == x) return x;
    }
  }
}

std::string RandomCalls::text() {
  constexpr const char* kTexts[] = {"",
                                    "a",
                                    "12",
                                    "007",
                                    "C:\\tex\\wood.tif",
                                    "say \"hi\"",
                                    "two\nlines\r\n\ttab",
                                    "#no comment [ ]",
                                    "$user:pass",
                                    "\x01\x7f\x80\xff"
                                    "7",
                                    "uniform float x"};
  return random_() % 3 == 0 ? std::string(random_() % 40, static_cast<char>('a' + random_() % 26))
                            : kTexts[random_() % std::size(kTexts)];
}

void RandomCalls::argument(const ArgumentInfo& info, Argument& a) {
  auto count = static_cast<size_t>(info.count > 0 ? info.count : static_cast<int>(random_() % 5));
  auto integer = [&] { return static_cast<int>(flip() ? random_() % 300 : random_()); };
  a.present = true;
  switch (info.kind) {
  case ArgumentKind::kFloat:
  case ArgumentKind::kFloats:
    for (size_t i = 0; i < count; ++i)
      a.numbers.push_back(number());
    break;
  case ArgumentKind::kInt:
  case ArgumentKind::kInts:
    for (size_t i = 0; i < count; ++i)
      a.ints.push_back(integer());
    break;
  case ArgumentKind::kString: a.strings = {text()}; break;
  case ArgumentKind::kStrings:
    for (size_t i = 0; i < count; ++i)
      a.strings.push_back(text());
    break;
  case ArgumentKind::kHandle: a.strings = {flip() ? std::to_string(random_() % 1000) : text()}; break;
  case ArgumentKind::kBasis:
    if (flip()) {
      a.strings = {text()};
      break;
    }
    for (int i = 0; i < 16; ++i)
      a.numbers.push_back(number());
    break;
  case ArgumentKind::kDash: break;
  }
}

void RandomCalls::param(RequestCall& call) {
  Param& p = call.params.emplace_back();
  p.token = fmt::format("p{} {}", random_() % 100, text());
  size_t count = random_() % 30;
  bool strings = flip();
  p.integers = strings || flip() || count == 0;
  for (size_t i = 0; i < count; ++i)
    if (strings)
      p.strings.push_back(text());
    else
      p.numbers.push_back(p.integers ? static_cast<float>(static_cast<int>(random_())) : number());
}

RequestCall RandomCalls::make(RequestId id) {
  RequestCall call;
  call.id = id;
  const RequestInfo& info = call.info();
  call.arguments.resize(info.arguments.size());
  bool optional = true; // present up to some point, as the parser takes them
  for (size_t i = 0; i < info.arguments.size(); ++i) {
    if (info.arguments[i].optional && id != RequestId::kDepthOfField)
      optional = optional && (i > 3 || flip());
    if (!info.arguments[i].optional || (optional && id != RequestId::kDepthOfField))
      argument(info.arguments[i], call.arguments[i]);
  }
  if (id == RequestId::kDepthOfField && flip())
    argument(info.arguments[0], call.arguments[0]);
  else if (id == RequestId::kDepthOfField)
    for (size_t i = 1; i < 4; ++i)
      argument(info.arguments[i], call.arguments[i]);
  // A list after a name that is left out would be taken for the name.
  bool ambiguous = id == RequestId::kProjection && !call.has(0);
  for (size_t n = info.params && !ambiguous ? random_() % 4 : 0; n > 0; --n)
    param(call);
  return call;
}

CallList parse_calls(const std::string& text, std::string* messages) {
  CallList list;
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  parse_rib(text, sources.add("t.rib", text), list, diagnostics);
  if (messages) *messages = format_diagnostics(diagnostics, sources);
  return list;
}

namespace {

/// Equal to the bit: 0 is not -0.
bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
    return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y);
  });
}

} // namespace

std::string difference(const RequestCall& a, const RequestCall& b) {
  if (a.id != b.id) return fmt::format("{} became {}", a.info().name, b.info().name);
  for (size_t i = 0; i < a.arguments.size(); ++i) {
    const Argument &x = a.arguments[i], &y = b.arguments[i];
    if (x.present != y.present)
      return fmt::format("argument {}: present {} became {}", i, x.present, y.present);
    if (!same(x.numbers, y.numbers) || x.ints != y.ints || x.strings != y.strings)
      return fmt::format("argument {}: {} {} {} became {} {} {}", i, x.numbers, x.ints, x.strings, y.numbers,
                         y.ints, y.strings);
  }
  if (a.params.size() != b.params.size())
    return fmt::format("{} parameters became {}", a.params.size(), b.params.size());
  for (size_t i = 0; i < a.params.size(); ++i) {
    const Param &x = a.params[i], &y = b.params[i];
    if (x.token != y.token || !same(x.numbers, y.numbers) || x.strings != y.strings ||
        x.integers != y.integers)
      return fmt::format("\"{}\" {} {} {} became \"{}\" {} {} {}", x.token, x.numbers, x.strings, x.integers,
                         y.token, y.numbers, y.strings, y.integers);
  }
  return a.data == b.data ? "" : "the data differs";
}

} // namespace render::testing
