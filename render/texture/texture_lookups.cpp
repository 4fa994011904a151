#include "render/texture/texture_lookups.h"

#include "render/texture/copy_values.h"
#include "render/texture/latlong.h"
#include "render/texture/open_texture.h"

#include <algorithm>
#include <fmt/format.h>

namespace render {

using slvm::TextureLookup;
using slvm::Type;
using slvm::Value;

namespace {

constexpr size_t kBlock = TextureRegions::kBlock;

/// Looks up every active point; `find(first, count, regions)` gives the regions of some, whose blur is there
/// already.
template <class F>
std::string look_up(const TextureImage& image, const TextureLookup& l, TextureWrap swrap, TextureWrap twrap,
                    F&& find) {
  TextureFilter filter(image, l, swrap, twrap);
  TextureRegions regions;
  TextureFilter::Means means;
  for (size_t first = 0; first < l.points; first += kBlock) {
    const size_t count = std::min(kBlock, l.points - first);
    const uint32_t active =
        static_cast<uint32_t>(l.mask[first / 64] >> first % 64) & static_cast<uint32_t>((1ull << count) - 1);
    if (active == 0) continue;
    copy_values(l.sblur, first, count, regions.sblur);
    copy_values(l.tblur, first, count, regions.tblur);
    find(first, count, regions);
    if (!filter.means(regions, active, means)) return image.problem();
    for (size_t c = 0; c < l.channels; ++c)
      for (size_t k = 0; k < count; ++k)
        if (active >> k & 1) l.result[c][first + k] = means[c][k];
  }
  return {};
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
  return look_up(*image, l, image->header().swrap, image->header().twrap,
                 [&](size_t first, size_t count, TextureRegions& out) {
                   copy_values(l.centre[0], first, count, out.s);
                   copy_values(l.centre[1], first, count, out.t);
                   copy_values(l.along_u[0], first, count, out.s_u);
                   copy_values(l.along_u[1], first, count, out.t_u);
                   copy_values(l.along_v[0], first, count, out.s_v);
                   copy_values(l.along_v[1], first, count, out.t_v);
                 });
}

std::string TextureLookups::environment(const std::string& file, const TextureLookup& l) {
  std::string problem;
  const auto image = find(file, problem);
  if (!image) return problem;
  Directions directions;
  return look_up(*image, l, TextureWrap::kPeriodic, TextureWrap::kClamp,
                 [&](size_t first, size_t count, TextureRegions& out) {
                   for (size_t c = 0; c < 3; ++c) {
                     copy_values(l.centre[c], first, count, directions.centre[c]);
                     copy_values(l.along_u[c], first, count, directions.along_u[c]);
                     copy_values(l.along_v[c], first, count, directions.along_v[c]);
                   }
                   find_latlong(directions, out);
                 });
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

std::string TextureLookups::texels(const std::string& file, size_t level, slvm::TextureTexels& out) {
  std::string problem;
  const auto image = find(file, problem);
  if (!image) return problem;
  if (level >= image->levels())
    return fmt::format("it has the levels 0 to {}, and no level {}", image->levels() - 1, level);
  FloatImage numbers;
  if (!image->numbers(level, numbers)) return image->problem();
  out.width = static_cast<size_t>(numbers.width);
  out.height = static_cast<size_t>(numbers.height);
  out.channels = numbers.channels;
  out.values = std::move(numbers.numbers);
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
