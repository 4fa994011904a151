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
  if (name == "rgb" || name == "Ci") return AovChannel{"Ci", 3, 0, Source::kColor, {}, {1, 1}};
  if (name == "Oi") return AovChannel{"Oi", 3, 0, Source::kOpacity, {}, {1, 1}};
  if (name == "a" || name == "alpha") return AovChannel{"a", 1, 0, Source::kAlpha, {}, {1, 1}};
  if (name == "z") return AovChannel{"z", 1, 0, Source::kDepth, {}, {1, 1}};
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

/// How a Display or a DisplayChannel wants its pixels; what it does not say is decided elsewhere.
struct PixelSettings {
  std::optional<PixelFilter> filter;
  std::optional<std::array<float, 2>> exposure; ///< gain and gamma
  std::optional<Quantization> quantize;
  std::optional<float> dither;

  void add(const PixelSettings& other) {
    if (!filter) filter = other.filter;
    if (!exposure) exposure = other.exposure;
    if (!quantize) quantize = other.quantize;
    if (!dither) dither = other.dither;
  }
};

/// The interpreter has seen to it that there are as many numbers as there must be.
slvm::Result<PixelSettings> parse_settings(const std::map<std::string, slvm::Value>& params) {
  PixelSettings out;
  auto filter = parse_filter(params);
  if (!filter) return slvm::Error{filter.error()};
  out.filter = *filter;
  auto numbers = [&](const char* name) {
    auto it = params.find(name);
    return it == params.end() ? nullptr : it->second.numbers.data();
  };
  if (const float* n = numbers("exposure")) {
    if (!(n[1] > 0)) return slvm::Error{"\"exposure\" takes gain and a gamma above 0"};
    out.exposure = {n[0], n[1]};
  }
  if (const float* n = numbers("dither")) out.dither = n[0];
  if (const float* n = numbers("quantize")) {
    if (n[2] > n[3])
      return slvm::Error{"\"quantize\" takes what 0 and 1 become, the smallest and the largest value"};
    auto whole = [&](size_t i) { return static_cast<int>(std::clamp(n[i], -1e9f, 1e9f)); };
    // Four zeros, or equal ends: floats.
    out.quantize = Quantization{whole(1), whole(2), whole(3), 0.5f, true, whole(0)};
  }
  return out;
}

/// One channel of a mode.
struct WantedChannel {
  AovChannel aov;
  PixelSettings settings;
};

/// One name of a mode: a composited channel, a DisplayChannel, a variable with its type, a known variable; a
/// name declared nowhere is a colour. `display`: what the Display says.
slvm::Result<WantedChannel> parse_channel(const Options& options, const std::string& name,
                                          const PixelSettings& display) {
  auto channel = options.channels.find(name);
  const std::string& text = channel == options.channels.end() ? name : channel->second.declaration;
  WantedChannel out;
  out.aov.name = text;
  auto declared = Declarations().resolve(text);
  if (declared) {
    if (declared->type == slvm::Type::kString || declared->type == slvm::Type::kMatrix ||
        declared->elements > 0)
      return slvm::Error{fmt::format("\"{}\" cannot be shown as an image", text)};
    out.aov.name = declared->name;
    out.aov.components = slvm::components(declared->type);
  } else if (text.find_first_of(" \t[") != std::string::npos) {
    return slvm::Error{declared.error()};
  } else if (slvm::Global g = slvm::find_global(text); g != slvm::Global::kCount) {
    out.aov.components = slvm::components(slvm::global_info(g).type);
  }
  if (auto known = composited(out.aov.name)) out.aov = *known;
  if (channel != options.channels.end()) {
    auto own = parse_settings(channel->second.params);
    if (!own) return slvm::Error{fmt::format("channel \"{}\": {}", name, own.error())};
    out.settings = *own;
  }
  out.settings.add(display);
  out.aov.filter = out.settings.filter;
  bool variable = out.aov.source == Source::kVariable;
  out.aov.exposure = out.settings.exposure.value_or(variable ? std::array{1.0f, 1.0f}
                                                             : std::array{options.gain, options.gamma});
  return out;
}

/// The channels of a mode. Standard modes without own filter and exposure need none.
slvm::Result<std::vector<WantedChannel>> parse_mode(const Options& options, const DisplayRequest& d,
                                                    const PixelSettings& settings) {
  std::vector<std::string> names;
  if (is_standard_mode(d.mode)) {
    if (!settings.filter && !settings.exposure) return std::vector<WantedChannel>{};
    if (d.mode.find("rgb") != std::string::npos) names.emplace_back("rgb");
    if (d.mode.find('a') != std::string::npos) names.emplace_back("a");
    if (d.mode.find('z') != std::string::npos) names.emplace_back("z");
  } else {
    names = split(d.mode);
    if (names.empty()) return slvm::Error{fmt::format("unknown mode \"{}\"", d.mode)};
  }
  std::vector<WantedChannel> out;
  for (const std::string& name : names) {
    auto channel = parse_channel(options, name, settings);
    if (!channel) return slvm::Error{channel.error()};
    out.push_back(*channel);
  }
  return out;
}

bool same(const AovChannel& a, const AovChannel& b) {
  return a.name == b.name && a.source == b.source && a.components == b.components &&
         a.exposure == b.exposure && a.filter == b.filter;
}

/// What a channel's numbers become: by its own settings, by a Quantize of its name, by that of its kind.
/// Variables of shaders are floats, as depths are.
Quantization quantization_of(const Options& options, const std::string& name, Source source,
                             const PixelSettings& settings) {
  bool color = source != Source::kVariable && source != Source::kDepth;
  Quantization q = color ? options.rgba : options.z;
  if (auto it = options.channel_quantization.find(name); it != options.channel_quantization.end())
    q = it->second;
  if (settings.quantize) q = *settings.quantize;
  if (settings.dither) q.dither = *settings.dither;
  return q;
}

std::vector<FileChannel> standard_channels(const Options& options, const std::string& mode,
                                           const PixelSettings& settings) {
  std::vector<FileChannel> out;
  auto add = [&](std::string name, int source, Source kind) {
    out.push_back({std::move(name), source, quantization_of(options, "", kind, settings)});
  };
  if (mode.find("rgb") != std::string::npos)
    for (int c = 0; c < 3; ++c)
      add(std::string(1, "RGB"[c]), Image::kCi + c, Source::kColor);
  if (mode.find('a') != std::string::npos) add("A", Image::kAlpha, Source::kAlpha);
  if (mode.find('z') != std::string::npos) add("Z", Image::kZ, Source::kDepth);
  return out;
}

/// The first colour of a file is R, G, B, as programs expect; others bear their names.
std::string channel_name(const AovChannel& a, int component, bool first) {
  if (a.source == Source::kAlpha) return "A";
  if (a.source == Source::kDepth) return "Z";
  if (a.components == 1) return a.name;
  std::string letter(1, "RGB"[component]);
  return first ? letter : a.name + "." + letter;
}

class AovList {
public:
  void add(AovChannel c) {
    if (std::any_of(list_.begin(), list_.end(), [&](const AovChannel& a) { return same(a, c); })) return;
    c.first = floats_;
    floats_ += c.components;
    list_.push_back(std::move(c));
  }
  /// The colour, opacity and alpha of the picture that a channel is part of.
  void add_picture(const AovChannel& c) {
    if (c.source == Source::kVariable || c.source == Source::kDepth) return;
    for (const char* name : {"Ci", "Oi", "a"}) {
      AovChannel part = *composited(name);
      part.filter = c.filter;
      part.exposure = c.exposure;
      add(part);
    }
  }
  std::vector<AovChannel> take() { return std::move(list_); }

private:
  std::vector<AovChannel> list_;
  int floats_ = 0;
};

} // namespace

std::vector<AovChannel> display_aovs(const Options& options, slvm::Diagnostics& diagnostics) {
  AovList out;
  for (const DisplayRequest& d : options.displays) {
    if (d.type == "null") continue;
    auto settings = parse_settings(d.params);
    auto channels = settings ? parse_mode(options, d, *settings) : slvm::Error{settings.error()};
    if (!channels) {
      diagnostics.error(d.where, "Display: " + channels.error());
      continue;
    }
    for (const WantedChannel& c : *channels) {
      out.add(c.aov);
      if (options.imager) out.add_picture(c.aov);
    }
  }
  std::vector<AovChannel> list = out.take();
  for (const auto& quantization : options.channel_quantization) {
    const std::string& name = quantization.first;
    if (std::none_of(list.begin(), list.end(), [&](const AovChannel& a) { return a.name == name; }))
      diagnostics.warning(
          {}, "display",
          fmt::format("Quantize \"{0}\" has no effect: no Display shows a channel \"{0}\"; known "
                      "for all are \"rgba\" and \"z\"",
                      name));
  }
  return list;
}

std::vector<FileChannel> file_channels(const Options& options, const DisplayRequest& d,
                                       const std::vector<AovChannel>& aovs) {
  auto settings = parse_settings(d.params);
  if (!settings) return {};
  auto wanted = parse_mode(options, d, *settings);
  if (!wanted) return {};
  if (wanted->empty()) return standard_channels(options, d.mode, *settings);
  std::vector<FileChannel> out;
  bool first = true;
  for (const WantedChannel& w : *wanted)
    for (const AovChannel& a : aovs) {
      if (!same(a, w.aov)) continue;
      Quantization q = quantization_of(options, a.name, a.source, w.settings);
      for (int c = 0; c < a.components; ++c)
        out.push_back({channel_name(a, c, first), Image::kAov + a.first + c, q});
      if (a.components == 3) first = false;
    }
  return out;
}

Image::StandardChannels shown_channels(const Options& options, const std::vector<AovChannel>& aovs) {
  Image::StandardChannels out;
  if (options.imager) out.set().reset(Image::kZ);
  for (const DisplayRequest& d : options.displays) {
    if (d.type == "null") continue;
    for (const FileChannel& c : file_channels(options, d, aovs))
      if (c.source < Image::kAov) out.set(static_cast<size_t>(c.source));
  }
  return out;
}

} // namespace render
