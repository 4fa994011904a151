// Lookups in maps that plug-ins ask for during a call: any number of regions and of channels.
#include "slvm/exec/lookup_region.h"
#include "slvm/exec/plugin_call.h"
#include "slvm/exec/run.h"
#include "slvm/exec/spaces.h"

#include <algorithm>
#include <fmt/format.h>

namespace slvm {
namespace {

constexpr int kMostChannels = 1024, kMostPoints = 1 << 24;

/// The lookup with its regions and optional arguments, but for channels, mask and result.
TextureLookup make_lookup(const GridCall& call, const AnemoneLookup& asked, MapKind kind) {
  const size_t dimensions = kind == MapKind::kTexture ? 2 : 3;
  TextureLookup lookup;
  lookup.map = asked.map;
  lookup.points = static_cast<size_t>(asked.points);
  for (size_t c = 0; c < dimensions; ++c)
    for (auto* values : {&lookup.centre[c], &lookup.along_u[c], &lookup.along_v[c]})
      values->assign(lookup.points, 0.0f);
  for (size_t i = 0; i < lookup.points; ++i) {
    float corners[4][3] = {};
    for (size_t c = 0; c < dimensions; ++c)
      for (size_t k = 0; k < 4; ++k)
        corners[k][c] = asked.corner[k][c][i * static_cast<size_t>(asked.stride)];
    set_region(lookup, i, dimensions, corners);
  }
  LookupWidths widths;
  for (int i = 0; i < asked.tokens; ++i) {
    // Types may stand before the name, as in calls of Ri functions.
    std::string_view token = asked.token[i] ? asked.token[i] : "";
    token.remove_prefix(token.find_last_of(' ') + 1);
    const void* value = asked.value[i];
    if (!value) continue;
    if (token == "filter") {
      if (const char* name = *static_cast<char* const*>(value)) lookup.options.filter = name;
    } else if (!set_lookup_option(lookup, widths, token, {*static_cast<const float*>(value)})) {
      call.run.report(call.code, MessageSeverity::kWarning,
                      fmt::format("{} of a plug-in: \"{}\" has no effect", asked.function, token), 1);
    }
  }
  scale_region(lookup, dimensions, widths);
  if (kind == MapKind::kShadow) lookup.current_to_world = current_to_world(call.run);
  return lookup;
}

} // namespace

int plugin_lookup(void* context, const AnemoneLookup* asked) {
  const GridCall* call = call_of(context);
  if (!call || !asked->map || !asked->result || asked->kind < 0 || asked->kind > 2 ||
      asked->first_channel < 0 || asked->channels < 1 || asked->channels > kMostChannels ||
      asked->points < 0 || asked->points > kMostPoints)
    return -1;
  const auto channels = static_cast<size_t>(asked->channels), points = static_cast<size_t>(asked->points);
  std::fill_n(asked->result, channels * points, 0.0f);
  if (!*asked->map) return -1;
  const auto kind = static_cast<MapKind>(asked->kind);
  TextureLookup lookup = make_lookup(*call, *asked, kind);
  const std::vector<uint64_t> all(points / 64 + 1, ~uint64_t{0});
  lookup.mask = all.data();
  std::vector<float> planes[TextureLookup::kMost];
  for (size_t c = 0; c < TextureLookup::kMost; ++c) {
    planes[c].resize(points);
    lookup.result[c] = planes[c].data();
  }
  for (size_t done = 0; done < channels; done += lookup.channels) {
    lookup.channels = channels - done >= 3 ? 3 : 1;
    lookup.first_channel = static_cast<uint32_t>(static_cast<size_t>(asked->first_channel) + done);
    const std::string problem = look_up(call->run.state.services.textures(), kind, lookup);
    if (!problem.empty()) {
      call->run.report(call->code, MessageSeverity::kWarning,
                       fmt::format("{} of a plug-in, \"{}\": {}", asked->function, asked->map, problem), 1);
      return -1;
    }
    for (size_t c = 0; c < lookup.channels; ++c)
      for (size_t i = 0; i < points; ++i)
        asked->result[i * channels + done + c] = planes[c][i];
  }
  return 0;
}

int plugin_texels(void* context, const char* map, int channels, const int* channel, int level, int face,
                  float* result) {
  const GridCall* call = call_of(context);
  if (!call || !map || !*map || channels < 1 || !channel || level < 0 || !result) return -1;
  TextureServices* textures = call->run.state.services.textures();
  TextureTexels texels;
  std::string problem = !textures   ? "this program has no textures"
                        : face != 0 ? fmt::format("it has one face, number 0, and no face {}", face)
                                    : textures->texels(map, static_cast<size_t>(level), texels);
  for (int c = 0; c < channels && problem.empty(); ++c)
    if (channel[c] < 0 || static_cast<size_t>(channel[c]) >= texels.channels)
      problem = fmt::format("it has {} channels, and no channel {}", texels.channels, channel[c]);
  if (!problem.empty()) {
    call->run.report(call->code, MessageSeverity::kWarning,
                     fmt::format("RxTextureGetData of a plug-in, \"{}\": {}", map, problem), 1);
    return -1;
  }
  for (size_t i = 0; i < texels.width * texels.height; ++i)
    for (int c = 0; c < channels; ++c)
      *result++ = texels.values[i * texels.channels + static_cast<size_t>(channel[c])];
  return 0;
}

int plugin_texture_info(void* context, const char* map, const char* name, void* result, int length,
                        RxInfoType_t* type, int* count) {
  const GridCall* call = call_of(context);
  TextureServices* textures = call ? call->run.state.services.textures() : nullptr;
  Value value;
  if (!textures || !map || !*map || !name || !result ||
      !textures->info(map, name, current_to_world(call->run), value))
    return -1;
  return give_value(*call, value, result, length, type, count);
}

} // namespace slvm
