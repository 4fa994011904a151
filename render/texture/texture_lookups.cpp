#include "render/texture/texture_lookups.h"

#include "render/texture/image_module.h"
#include "render/texture/texture_filter.h"
#include "render/texture/texture_tiff.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <numbers>

namespace render {

using slvm::TextureLookup;
using slvm::Type;
using slvm::Value;

namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// PRMan's format before it took TIFF, in either order of bytes. It is not public.
bool is_early_prman(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const int first = in.get(), second = in.get();
  return (first == 0xfa && second == 0xce) || (first == 0xce && second == 0xfa);
}

std::unique_ptr<TextureReader> open_texture(const std::string& file, std::string& problem) {
  if (auto reader = open_tiff_texture(file)) return reader;
  if (is_early_prman(file)) {
    problem = "it is in PRMan's own format of before TIFF; make it anew of its image, by MakeTexture";
    return nullptr;
  }
  const ImageModule& module = image_module();
  if (!module.problem.empty()) {
    problem = module.problem;
    return nullptr;
  }
  return module.open_texture(file, problem);
}

/// Looks up every active point; `at(point)` gives its region, without blur.
template <class F>
std::string look_up(const TextureImage& image, const TextureLookup& l, TextureWrap swrap, TextureWrap twrap,
                    F&& at) {
  const TextureFilter filter(image, l, swrap, twrap);
  for (size_t i = 0; i < l.points; ++i) {
    if (!l.active(i)) continue;
    TextureRegion region = at(i);
    region.sblur = TextureLookup::at(l.sblur, i);
    region.tblur = TextureLookup::at(l.tblur, i);
    float result[TextureLookup::kMost] = {};
    const bool has_place = std::isfinite(region.s) && std::isfinite(region.t);
    if (has_place && !filter.mean(region, result)) return image.problem();
    for (size_t c = 0; c < l.channels; ++c)
      l.result[c][i] = result[c];
  }
  return {};
}

/// Latitude-longitude coordinates of a direction and of how it changes.
TextureRegion latlong(const TextureLookup& l, size_t i) {
  float x = l.centre[0][i], y = l.centre[1][i], z = l.centre[2][i];
  float across = x * x + y * y, flat = std::sqrt(across), square = across + z * z;
  float longitude = std::atan2(y, x), latitude = std::atan2(z, flat);
  if (longitude < 0) longitude += kTurn;
  auto change = [&](const std::vector<float>(&d)[3], float& s, float& t) {
    float dx = d[0][i], dy = d[1][i], dz = d[2][i];
    s = across > 0 ? (x * dy - y * dx) / (across * kTurn) : 0;
    t = flat > 0 && square > 0 ? -(flat * dz - z * (x * dx + y * dy) / flat) / square * 2 / kTurn : 0;
    s = std::clamp(s, -1.0f, 1.0f); // next to a pole
  };
  TextureRegion r{longitude / kTurn, 0.5f - latitude * 2 / kTurn, 0, 0, 0, 0};
  change(l.along_u, r.s_u, r.t_u);
  change(l.along_v, r.s_v, r.t_v);
  return r;
}

/// From current space. Empty: the file has no such matrix.
Value matrix_value(const slvm::Matrix4& current_to_world, const std::vector<float>& from_world) {
  slvm::Matrix4 m;
  std::copy_n(from_world.begin(), 16, m.m.begin());
  m = current_to_world * m;
  return {Type::kMatrix, 0, {m.m.begin(), m.m.end()}, {}};
}

} // namespace

TextureLookups::TextureLookups(float memory_megabytes)
    : most_bytes_(static_cast<long long>(static_cast<double>(memory_megabytes) * 1048576)) {}

std::shared_ptr<const TextureImage> TextureLookups::find(const std::string& file, std::string& problem) {
  std::lock_guard lock(mutex_);
  Entry& entry = entries_[file];
  entry.last_use = ++uses_;
  if (!entry.image && entry.problem.empty())
    if (auto reader = open_texture(file, entry.problem))
      entry.image = std::make_shared<const TextureImage>(std::move(reader), bytes_);
  if (bytes_ > most_bytes_) make_room(entry);
  problem = entry.problem;
  return entry.image;
}

/// Called with the lock. Lookups that are under way keep what they look at.
void TextureLookups::make_room(const Entry& wanted) {
  while (bytes_ > most_bytes_) {
    Entry* oldest = nullptr;
    for (auto& [name, e] : entries_)
      if (e.image && &e != &wanted && (!oldest || e.last_use < oldest->last_use)) oldest = &e;
    if (!oldest) return;
    oldest->image.reset();
  }
}

std::string TextureLookups::texture(const std::string& file, const TextureLookup& l) {
  std::string problem;
  const auto image = find(file, problem);
  if (!image) return problem;
  return look_up(*image, l, image->header().swrap, image->header().twrap, [&](size_t i) {
    return TextureRegion{l.centre[0][i],  l.centre[1][i],  l.along_u[0][i],
                         l.along_u[1][i], l.along_v[0][i], l.along_v[1][i]};
  });
}

std::string TextureLookups::environment(const std::string& file, const TextureLookup& l) {
  std::string problem;
  const auto image = find(file, problem);
  if (!image) return problem;
  return look_up(*image, l, TextureWrap::kPeriodic, TextureWrap::kClamp,
                 [&](size_t i) { return latlong(l, i); });
}

bool TextureLookups::info(const std::string& file, std::string_view field,
                          const slvm::Matrix4& current_to_world, Value& out) {
  std::string problem;
  const auto image = find(file, problem);
  if (!image) return false;
  const TextureHeader& h = image->header();
  if (field == "resolution") {
    out = {
        Type::kFloat, 2, {static_cast<float>(h.levels[0].width), static_cast<float>(h.levels[0].height)}, {}};
  } else if (field == "channels") {
    out = {Type::kFloat, 0, {static_cast<float>(h.channels)}, {}};
  } else if (field == "type") {
    std::string name = h.format == "Shadow"                    ? "shadow"
                       : h.format.find("Env") != h.format.npos ? "environment"
                                                               : "texture";
    out = {Type::kString, 0, {}, {name}};
  } else if (field == "viewingmatrix" && !h.world_to_camera.empty()) {
    out = matrix_value(current_to_world, h.world_to_camera);
  } else if (field == "projectionmatrix" && !h.world_to_screen.empty()) {
    // From the image plane of "screen" space to x right and y up, -1 to 1 in the picture: "screen" is so
    // already.
    out = matrix_value(current_to_world, h.world_to_screen);
  } else {
    return false;
  }
  return true;
}

namespace {

template <class T> void as_numbers(const std::byte* from, std::vector<float>& to) {
  constexpr float kMost = std::is_same_v<T, float> ? 1.0f : static_cast<float>(std::numeric_limits<T>::max());
  for (float& value : to) {
    T stored;
    std::memcpy(&stored, from, sizeof stored);
    from += sizeof stored;
    value = static_cast<float>(stored) / kMost;
  }
}

} // namespace

std::string TextureLookups::texels(const std::string& file, size_t level, slvm::TextureTexels& out) {
  std::string problem;
  const auto image = find(file, problem);
  if (!image) return problem;
  if (level >= image->levels())
    return fmt::format("it has the levels 0 to {}, and no level {}", image->levels() - 1, level);
  const TextureImage::Level found = image->level(level);
  if (!found.texels) return image->problem();
  out.width = static_cast<size_t>(found.width);
  out.height = static_cast<size_t>(found.height);
  out.channels = static_cast<size_t>(image->header().channels);
  out.values.resize(out.width * out.height * out.channels);
  switch (image->header().type) {
  case TexelType::kByte: as_numbers<uint8_t>(found.texels, out.values); break;
  case TexelType::kShort: as_numbers<uint16_t>(found.texels, out.values); break;
  case TexelType::kFloat: as_numbers<float>(found.texels, out.values); break;
  }
  return {};
}

std::pair<long long, long long> TextureLookups::usage() {
  std::lock_guard lock(mutex_);
  long long files = 0;
  for (const auto& [name, e] : entries_)
    files += e.problem.empty();
  return {files, bytes_};
}

} // namespace render
