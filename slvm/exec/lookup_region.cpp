#include "slvm/exec/lookup_region.h"

namespace slvm {
namespace {

float enclosed(const float (&u)[3], const float (&v)[3]) {
  float x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  return x * x + y * y + z * z;
}

} // namespace

std::string look_up(TextureServices* textures, MapKind kind, const TextureLookup& lookup) {
  if (!textures) return "there are no textures here";
  return kind == MapKind::kTexture       ? textures->texture(lookup)
         : kind == MapKind::kEnvironment ? textures->environment(lookup)
                                         : textures->shadow(lookup);
}

void set_region(TextureLookup& lookup, size_t point, size_t dimensions, const float (&k)[4][3]) {
  float rows_u[3] = {}, rows_v[3] = {}, turn_u[3] = {}, turn_v[3] = {};
  for (size_t c = 0; c < dimensions; ++c) {
    lookup.centre[c][point] = 0.25f * (k[0][c] + k[1][c] + k[2][c] + k[3][c]);
    rows_u[c] = 0.5f * (k[1][c] - k[0][c] + k[3][c] - k[2][c]);
    rows_v[c] = 0.5f * (k[2][c] - k[0][c] + k[3][c] - k[1][c]);
    turn_u[c] = 0.5f * (k[1][c] - k[0][c] + k[2][c] - k[3][c]);
    turn_v[c] = 0.5f * (k[3][c] - k[0][c] + k[2][c] - k[1][c]);
  }
  const bool rows = enclosed(rows_u, rows_v) >= enclosed(turn_u, turn_v);
  for (size_t c = 0; c < dimensions; ++c) {
    lookup.along_u[c][point] = rows ? rows_u[c] : turn_u[c];
    lookup.along_v[c][point] = rows ? rows_v[c] : turn_v[c];
  }
}

void scale_region(TextureLookup& lookup, size_t dimensions, const LookupWidths& widths) {
  for (size_t c = 0; c < dimensions; ++c) {
    const std::vector<float>& width = c == 1 && dimensions == 2 ? widths.t : widths.s;
    if (width.empty()) continue;
    for (size_t i = 0; i < lookup.points; ++i) {
      const float scale = TextureLookup::at(width, i);
      lookup.along_u[c][i] *= scale;
      lookup.along_v[c][i] *= scale;
    }
  }
}

bool set_lookup_option(TextureLookup& lookup, LookupWidths& widths, std::string_view token,
                       std::vector<float> values) {
  if (token == "blur")
    lookup.sblur = lookup.tblur = std::move(values);
  else if (token == "sblur")
    lookup.sblur = std::move(values);
  else if (token == "tblur")
    lookup.tblur = std::move(values);
  else if (token == "width")
    widths.s = widths.t = std::move(values);
  else if (token == "swidth")
    widths.s = std::move(values);
  else if (token == "twidth")
    widths.t = std::move(values);
  else if (token == "bias")
    lookup.bias = std::move(values);
  else if (token == "samples")
    lookup.options.samples = values[0];
  else if (token == "fill")
    lookup.options.fill = values[0];
  else if (token == "ignoreabove")
    lookup.options.ignore_above = values[0];
  else if (token == "lerp")
    lookup.options.between_levels = values[0] != 0;
  else
    return false;
  return true;
}

} // namespace slvm
