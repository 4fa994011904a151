// Arguments of the Make requests. Images are looked for like textures.
#include "render/map_requests.h"

#include "render/texture/find_image.h"
#include "render/texture/make_maps.h"

#include <fmt/format.h>

namespace render {

namespace {

std::string locate(const std::string& name, const Options& options) {
  std::vector<std::string> folders;
  if (auto it = options.search_paths.find("texture"); it != options.search_paths.end()) folders = it->second;
  return find_image(name, folders).value_or(name);
}

/// The filters of pixels that are known between levels of a map, too.
std::string settings_of(const RequestCall& call, int swrap, int filter, MakeSettings& out) {
  for (int i = swrap; swrap >= 0 && i < swrap + 2; ++i) {
    const std::optional<TextureWrap> wrap = find_wrap(call.text(i));
    if (!wrap) return fmt::format("unknown wrap \"{}\"; known are black, periodic, clamp", call.text(i));
    (i == swrap ? out.swrap : out.twrap) = *wrap;
  }
  constexpr std::string_view kFilters[] = {"box",      "triangle", "catmull-rom",
                                           "b-spline", "gaussian", "mitchell",
                                           "sinc",     "disk",     "blackman-harris"};
  const std::string& name = call.text(filter);
  if (std::find(std::begin(kFilters), std::end(kFilters), name) == std::end(kFilters))
    return fmt::format("unknown filter \"{}\"; known are {}", name, fmt::join(kFilters, ", "));
  out.filter = *find_filter(name);
  for (auto [width, what] : {std::pair(&out.swidth, "swidth"), {&out.twidth, "twidth"}}) {
    *width = call.number(++filter);
    if (!(*width > 0) || *width > 1e5f)
      return fmt::format("{} is a number of pixels above 0, found {:g}", what, *width);
  }
  return {};
}

} // namespace

std::string make_map(const RequestCall& call, const Options& options) {
  MakeSettings settings;
  switch (call.id) {
  case RequestId::kMakeTexture:
    if (std::string why = settings_of(call, 2, 4, settings); !why.empty()) return why;
    return make_texture(locate(call.text(0), options), call.text(1), settings);
  case RequestId::kMakeBump:
    if (std::string why = settings_of(call, 2, 4, settings); !why.empty()) return why;
    return make_bump(locate(call.text(0), options), call.text(1), settings);
  case RequestId::kMakeLatLongEnvironment:
    settings.swrap = TextureWrap::kPeriodic;
    settings.twrap = TextureWrap::kClamp;
    if (std::string why = settings_of(call, -1, 2, settings); !why.empty()) return why;
    return make_latlong(locate(call.text(0), options), call.text(1), settings);
  case RequestId::kMakeCubeFaceEnvironment: {
    settings.swrap = TextureWrap::kPeriodic;
    settings.twrap = TextureWrap::kClamp;
    if (std::string why = settings_of(call, -1, 8, settings); !why.empty()) return why;
    float fov = call.number(7);
    if (!(fov >= 90) || !(fov < 180))
      return fmt::format("the faces need 90 degrees or a little more, found {:g}", fov);
    std::array<std::string, 6> faces;
    for (int i = 0; i < 6; ++i)
      faces[static_cast<size_t>(i)] = locate(call.text(i), options);
    return make_cube_environment(faces, call.text(6), fov, settings);
  }
  default: return make_shadow(locate(call.text(0), options), call.text(1));
  }
}

} // namespace render
