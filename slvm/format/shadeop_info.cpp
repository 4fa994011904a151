// The .def files as data: their expansion, and indexes by name. Everything is made at compile time; a
// signature that does not parse is a compile error.
#include "slvm/format/shadeop_info.h"

#include <algorithm>
#include <array>

namespace slvm {
namespace {

constexpr ShadeopInfo make_row(std::string_view name, std::string_view signature, ShadeopKind kind,
                               uint32_t flags, std::string_view doc, double ulps = -1) {
  return {name, signature, kind, flags, doc, ulps, parse_signature(signature)};
}

constexpr ShadeopInfo kRows[] = {
#define SHADEOP(name, signature, kernel, flags, ulps, doc)                                                   \
  make_row(name, signature, ShadeopKind::kKernel, flags, doc, ulps),
#define GRIDOP(name, signature, function, flags, doc)                                                        \
  make_row(name, signature, ShadeopKind::kGrid, flags, doc),
#define RSLOP(name, signature, flags, doc) make_row(name, signature, ShadeopKind::kRsl, flags, doc),
#define PENDING(name, signature, flags, doc) make_row(name, signature, ShadeopKind::kPending, flags, doc),
#include "slvm/format/shadeops.def"
#undef SHADEOP
#undef GRIDOP
#undef RSLOP
#undef PENDING
};
constexpr size_t kRowCount = std::size(kRows);
static_assert(kRowCount < kFirstPluginShadeop, "ids above are those of plug-ins");

/// The first row whose signature does not parse, or kRowCount.
constexpr size_t first_bad_row() {
  for (size_t i = 0; i < kRowCount; ++i)
    if (!kRows[i].signature.ok) return i;
  return kRowCount;
}
static_assert(first_bad_row() == kRowCount, "a signature in shadeops.def does not follow the grammar");

/// Row ids ordered by name, then by table order.
constexpr std::array<ShadeopId, kRowCount> sort_by_name() {
  std::array<ShadeopId, kRowCount> ids{};
  for (size_t i = 0; i < kRowCount; ++i)
    ids[i] = static_cast<ShadeopId>(i);
  std::sort(ids.begin(), ids.end(), [](ShadeopId a, ShadeopId b) {
    return kRows[a].name != kRows[b].name ? kRows[a].name < kRows[b].name : a < b;
  });
  return ids;
}
constexpr std::array<ShadeopId, kRowCount> kByName = sort_by_name();

// The columns of tokens.def.
struct AnyType {};
enum class TokenClass { kVaryingIn, kUniformIn, kOut };

constexpr TokenInfo make_token(std::string_view set, std::string_view name, Type type, TokenClass use,
                               std::string_view doc) {
  return {set, name, type, false, use == TokenClass::kUniformIn, use == TokenClass::kOut, doc};
}
constexpr TokenInfo make_token(std::string_view set, std::string_view name, AnyType, TokenClass use,
                               std::string_view doc) {
  return {set, name, Type::kVoid, true, use == TokenClass::kUniformIn, use == TokenClass::kOut, doc};
}

namespace token_columns {
using enum Type;
using enum TokenClass;
constexpr AnyType kAnyType;

constexpr TokenInfo kTokens[] = {
#define TOKEN(set, name, type, use, doc) make_token(set, name, type, use, doc),
#include "slvm/format/tokens.def"
#undef TOKEN
};
} // namespace token_columns

constexpr GlobalInfo kGlobals[] = {
#define GLOBAL(name, type, detail, access, doc) {#name, Type::type, Detail::detail, access, doc},
#include "slvm/format/globals.def"
#undef GLOBAL
};
static_assert(std::all_of(std::begin(kGlobals), std::end(kGlobals), [](const GlobalInfo& g) {
  return g.access.size() == kShaderKindCount && g.access.find_first_not_of("rw-") == std::string_view::npos;
}));

/// `pattern` ends in '*': the rest is a prefix of the name; otherwise they are equal.
bool matches(std::string_view pattern, std::string_view name) {
  return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1)) : name == pattern;
}

} // namespace

std::span<const ShadeopInfo> shadeops() {
  return kRows;
}

const ShadeopInfo& shadeop(ShadeopId id) {
  return kRows[id];
}

std::span<const ShadeopId> shadeop_overloads(std::string_view name) {
  auto first = std::lower_bound(kByName.begin(), kByName.end(), name,
                                [](ShadeopId id, std::string_view n) { return kRows[id].name < n; });
  auto last = std::upper_bound(first, kByName.end(), name,
                               [](std::string_view n, ShadeopId id) { return n < kRows[id].name; });
  return {first, last};
}

int find_shadeop(std::string_view name, std::string_view signature_text) {
  for (ShadeopId id : shadeop_overloads(name))
    if (kRows[id].signature_text == signature_text) return id;
  return -1;
}

std::span<const TokenInfo> tokens() {
  return token_columns::kTokens;
}

const TokenInfo* find_token(std::string_view set, std::string_view name) {
  auto found = std::find_if(tokens().begin(), tokens().end(),
                            [&](const TokenInfo& t) { return t.set == set && matches(t.name, name); });
  return found == tokens().end() ? nullptr : &*found;
}

const GlobalInfo& global_info(Global global) {
  return kGlobals[static_cast<size_t>(global)];
}

Global find_global(std::string_view name) {
  auto found = std::find_if(std::begin(kGlobals), std::end(kGlobals),
                            [&](const GlobalInfo& g) { return g.name == name; });
  return static_cast<Global>(found - std::begin(kGlobals));
}

} // namespace slvm
