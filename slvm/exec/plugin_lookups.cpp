// Lookups in maps that plug-ins ask for during a call: one region at a time, any number of channels.
#include "slvm/exec/lookup_region.h"
#include "slvm/exec/plugin_call.h"
#include "slvm/exec/run.h"
#include "slvm/exec/spaces.h"

#include <algorithm>
#include <fmt/format.h>

namespace slvm {
namespace {

constexpr int kMostChannels = 1024;

/// The lookup with its region and optional arguments, but for channels and result.
TextureLookup make_lookup(const GridCall& call, const AnemoneLookup& asked, MapKind kind,
                          const uint64_t* mask) {
  const size_t dimensions = kind == MapKind::kTexture ? 2 : 3;
  TextureLookup lookup;
  lookup.map = asked.map;
  lookup.points = 1;
  lookup.mask = mask;
  float corners[4][3] = {};
  for (size_t c = 0; c < dimensions; ++c) {
    lookup.centre[c] = lookup.along_u[c] = lookup.along_v[c] = {0};
    for (size_t k = 0; k < 4; ++k)
      corners[k][c] = asked.corners[k][c];
  }
  set_region(lookup, 0, dimensions, corners);
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
      asked->first_channel < 0 || asked->channels < 1 || asked->channels > kMostChannels)
    return -1;
  std::fill_n(asked->result, asked->channels, 0.0f);
  if (!*asked->map) return -1;
  const auto kind = static_cast<MapKind>(asked->kind);
  const uint64_t one_point = 1;
  TextureLookup lookup = make_lookup(*call, *asked, kind, &one_point);
  for (int done = 0; done < asked->channels;) {
    lookup.channels = asked->channels - done >= 3 ? 3 : 1;
    lookup.first_channel = static_cast<uint32_t>(asked->first_channel + done);
    for (uint32_t c = 0; c < lookup.channels; ++c)
      lookup.result[c] = asked->result + done + c;
    const std::string problem = look_up(call->run.state.services.textures(), kind, lookup);
    if (!problem.empty()) {
      call->run.report(call->code, MessageSeverity::kWarning,
                       fmt::format("{} of a plug-in, \"{}\": {}", asked->function, asked->map, problem), 1);
      return -1;
    }
    done += static_cast<int>(lookup.channels);
  }
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
