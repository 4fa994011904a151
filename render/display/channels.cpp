// Modes and parameters of Display requests.
#include "render/display/channels.h"

#include "render/state/declaration.h"
#include "slvm/format/shadeop_info.h"

#include <fmt/format.h>

#include <algorithm>

namespace render {

namespace {

using Source = AovChannel::Source;

bool is_standard_mode(std::string_view mode) {
  if (mode.empty()) return false;
  if (mode.starts_with("rgb")) mode.remove_prefix(3);
  if (mode.starts_with("a")) mode.remove_prefix(1);
  if (mode.starts_with("z")) mode.remove_prefix(1);
  return mode.empty();
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> out;
  for (size_t at = 0; at <= list.size();) {
    size_t comma = std::min(list.find(',', at), list.size());
    std::string item = list.substr(at, comma - at);
    item.erase(0, item.find_first_not_of(" \t"));
    item.erase(item.find_last_not_of(" \t") + 1);
    if (!item.empty()) out.push_back(item);
    at = comma + 1;
  }
  return out;
}

/// The composited picture under the names of its channels.
std::optional<AovChannel> composited(const std::string& name) {
  if (name == "rgb" || name == "Ci") return AovChannel{"Ci", 3, 0, Source::kColor, {}};
  if (name == "Oi") return AovChannel{"Oi", 3, 0, Source::kOpacity, {}};
  if (name == "a" || name == "alpha") return AovChannel{"a", 1, 0, Source::kAlpha, {}};
  if (name == "z") return AovChannel{"z", 1, 0, Source::kDepth, {}};
  return {};
}

slvm::Result<std::optional<PixelFilter>> parse_filter(const std::map<std::string, slvm::Value>& params) {
  auto name = params.find("filter"), width = params.find("filterwidth");
  if (name == params.end() && width == params.end()) return std::optional<PixelFilter>{};
  PixelFilter f;
  if (name != params.end()) {
    auto kind = name->second.strings.size() == 1 ? find_filter(name->second.strings[0]) : std::nullopt;
    if (!kind) return slvm::Error{fmt::format("\"filter\" takes one of {}", filter_names())};
    f.kind = *kind;
  }
  if (width != params.end()) {
    const auto& n = width->second.numbers;
    constexpr float kWidest = 32;
    if (n.size() != 2 || !(n[0] > 0) || !(n[1] > 0) || n[0] > kWidest || n[1] > kWidest)
      return slvm::Error{
          fmt::format("\"filterwidth\" takes two widths above 0 and up to {} pixels", kWidest)};
    f.xwidth = n[0];
    f.ywidth = n[1];
  }
  return std::optional(f);
}

/// One name of a mode: a composited channel, a DisplayChannel, a variable with its type, a known variable; a
/// name declared nowhere is a colour.
slvm::Result<AovChannel> parse_channel(const Options& options, const std::string& name) {
  auto channel = options.channels.find(name);
  const std::string& text = channel == options.channels.end() ? name : channel->second.declaration;
  AovChannel out{text, 3, 0, Source::kVariable, {}};
  auto declared = Declarations().resolve(text);
  if (declared) {
    if (declared->type == slvm::Type::kString || declared->type == slvm::Type::kMatrix ||
        declared->elements > 0)
      return slvm::Error{fmt::format("\"{}\" cannot be shown as an image", text)};
    out.name = declared->name;
    out.components = slvm::components(declared->type);
  } else if (text.find_first_of(" \t[") != std::string::npos) {
    return slvm::Error{declared.error()};
  } else if (slvm::Global g = slvm::find_global(text); g != slvm::Global::kCount) {
    out.components = slvm::components(slvm::global_info(g).type);
  }
  if (auto known = composited(out.name)) out = *known;
  if (channel != options.channels.end()) {
    auto filter = parse_filter(channel->second.params);
    if (!filter) return slvm::Error{fmt::format("channel \"{}\": {}", name, filter.error())};
    out.filter = *filter;
  }
  return out;
}

/// The channels of a mode. Standard modes without own filter and exposure need none.
slvm::Result<std::vector<AovChannel>> parse_mode(const Options& options, const DisplayRequest& d) {
  auto settings = display_settings(d);
  if (!settings) return slvm::Error{settings.error()};
  std::vector<std::string> names;
  if (is_standard_mode(d.mode)) {
    if (!settings->filter && !settings->exposure) return std::vector<AovChannel>{};
    if (d.mode.find("rgb") != std::string::npos) names.emplace_back("rgb");
    if (d.mode.find('a') != std::string::npos) names.emplace_back("a");
    if (d.mode.find('z') != std::string::npos) names.emplace_back("z");
  } else {
    names = split(d.mode);
    if (names.empty()) return slvm::Error{fmt::format("unknown mode \"{}\"", d.mode)};
  }
  std::vector<AovChannel> out;
  for (const std::string& name : names) {
    auto channel = parse_channel(options, name);
    if (!channel) return slvm::Error{channel.error()};
    if (!channel->filter) channel->filter = settings->filter;
    out.push_back(*channel);
  }
  return out;
}

bool same(const AovChannel& a, const AovChannel& b) {
  if (a.name != b.name || a.source != b.source || a.components != b.components) return false;
  if (a.filter.has_value() != b.filter.has_value()) return false;
  return !a.filter || (a.filter->kind == b.filter->kind && a.filter->xwidth == b.filter->xwidth &&
                       a.filter->ywidth == b.filter->ywidth);
}

std::vector<FileChannel> standard_channels(const std::string& mode) {
  std::vector<FileChannel> out;
  using Group = FileChannel::Group;
  if (mode.find("rgb") != std::string::npos)
    for (int c = 0; c < 3; ++c)
      out.push_back({std::string(1, "RGB"[c]), Image::kCi + c, Group::kColor});
  if (mode.find('a') != std::string::npos) out.push_back({"A", Image::kAlpha, Group::kColor});
  if (mode.find('z') != std::string::npos) out.push_back({"Z", Image::kZ, Group::kDepth});
  return out;
}

FileChannel::Group group_of(Source source) {
  if (source == Source::kVariable) return FileChannel::Group::kVariable;
  return source == Source::kDepth ? FileChannel::Group::kDepth : FileChannel::Group::kColor;
}

/// The first colour of a file is R, G, B, as programs expect; others bear their names.
std::string channel_name(const AovChannel& a, int component, bool first) {
  if (a.source == Source::kAlpha) return "A";
  if (a.source == Source::kDepth) return "Z";
  if (a.components == 1) return a.name;
  std::string letter(1, "RGB"[component]);
  return first ? letter : a.name + "." + letter;
}

} // namespace

slvm::Result<DisplaySettings> display_settings(const DisplayRequest& d) {
  DisplaySettings out;
  auto filter = parse_filter(d.params);
  if (!filter) return slvm::Error{filter.error()};
  out.filter = *filter;
  auto numbers = [&](const char* name) {
    auto it = d.params.find(name);
    return it == d.params.end() ? nullptr : &it->second.numbers;
  };
  if (const auto* n = numbers("exposure")) {
    if (n->size() != 2 || !((*n)[1] > 0)) return slvm::Error{"\"exposure\" takes gain and a gamma above 0"};
    out.exposure = {(*n)[0], (*n)[1]};
  }
  if (const auto* n = numbers("dither")) {
    if (n->size() != 1) return slvm::Error{"\"dither\" takes one number"};
    out.dither = (*n)[0];
  }
  if (const auto* n = numbers("quantize")) {
    if (n->size() != 4 || (*n)[2] > (*n)[3])
      return slvm::Error{"\"quantize\" takes what 0 and 1 become, the smallest and the largest value"};
    auto whole = [&](size_t i) { return static_cast<int>((*n)[i]); };
    // Four zeros, or equal ends: floats.
    out.quantize = Quantization{whole(1), whole(2), whole(3), 0.5f, true, whole(0)};
  }
  return out;
}

std::vector<AovChannel> display_aovs(const Options& options, slvm::Diagnostics& diagnostics) {
  std::vector<AovChannel> out;
  int floats = 0;
  for (const DisplayRequest& d : options.displays) {
    if (d.type == "null") continue;
    auto channels = parse_mode(options, d);
    if (!channels) {
      diagnostics.error(d.where, "Display: " + channels.error());
      continue;
    }
    for (AovChannel& c : *channels) {
      if (std::any_of(out.begin(), out.end(), [&](const AovChannel& a) { return same(a, c); })) continue;
      c.first = floats;
      floats += c.components;
      out.push_back(c);
    }
  }
  return out;
}

std::vector<FileChannel> file_channels(const Options& options, const DisplayRequest& d,
                                       const std::vector<AovChannel>& aovs) {
  auto wanted = parse_mode(options, d);
  if (!wanted) return {};
  if (wanted->empty()) return standard_channels(d.mode);
  std::vector<FileChannel> out;
  bool first = true;
  for (const AovChannel& w : *wanted)
    for (const AovChannel& a : aovs) {
      if (!same(a, w)) continue;
      for (int c = 0; c < a.components; ++c)
        out.push_back({channel_name(a, c, first), Image::kAov + a.first + c, group_of(a.source)});
      if (a.components == 3) first = false;
    }
  return out;
}

} // namespace render
