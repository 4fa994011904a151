// The two forms of statistics.
#include "render/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <sys/resource.h>
#include <vector>

namespace render {

namespace {

constexpr double kMega = 1 << 20;

/// The costliest first.
std::vector<std::pair<std::string, ShaderCost>> sorted(const FrameReport& report) {
  std::vector<std::pair<std::string, ShaderCost>> out(report.shaders.begin(), report.shaders.end());
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
  return out;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      out += c;
  }
  return out + "\"";
}

} // namespace

std::string format_text(const FrameStatistics& s) {
  const FrameReport& r = s.report;
  std::string out = fmt::format("frame {}: {} x {} pixels, {} samples each, {} thread{}\n", s.frame, s.width,
                                s.height, s.samples_per_pixel, s.threads, s.threads == 1 ? "" : "s");
  out += fmt::format("  seconds         {:10.3f}  shaders bound {:.3f}, rendered {:.3f}, written {:.3f}\n",
                     s.bind_seconds + s.render_seconds + s.write_seconds, s.bind_seconds, s.render_seconds,
                     s.write_seconds);
  out += fmt::format("  primitives      {:10}  {} split\n", r.primitives, r.split_primitives);
  out += fmt::format("  grids           {:10}  {} shaded\n", r.grids, r.shaded_grids);
  out += fmt::format("  micropolygons   {:10}  {} points shaded\n", r.micropolygons, r.shaded_points);
  if (const RayUsage& y = s.rays; y.all() > 0) {
    out += fmt::format("  rays            {:10}  {} of them for shadows, {} for {} hemispheres\n", y.all(),
                       y.shadow_rays, y.hemisphere_rays, y.hemispheres);
    out += fmt::format("  ray hits        {:10}  points shaded in {} grids; {} faces made, {:.1f} MB\n",
                       y.hit_points, y.hit_grids, y.geometry.faces,
                       static_cast<double>(y.geometry.bytes) / kMega);
  }
  out += fmt::format("  textures        {:10}  files, {:.1f} MB of tiles\n", s.texture_files,
                     static_cast<double>(s.texture_bytes) / kMega);
  out += fmt::format("  memory          {:10.1f}  MB at most\n", static_cast<double>(s.peak_bytes) / kMega);
  for (const auto& [name, cost] : sorted(r))
    out += fmt::format("  shading         {:10.3f}  seconds \"{}\", {} grids, {} points\n", cost.seconds,
                       name, cost.grids, cost.points);
  return out;
}

std::string format_json(const FrameStatistics& s) {
  const FrameReport& r = s.report;
  std::string shaders;
  for (const auto& [name, cost] : sorted(r))
    shaders += fmt::format("{}{{\"name\":{},\"seconds\":{:.6f},\"grids\":{},\"points\":{}}}",
                           shaders.empty() ? "" : ",", quoted(name), cost.seconds, cost.grids, cost.points);
  return fmt::format(
      "{{\"version\":{},\"frame\":{},\"width\":{},\"height\":{},\"samples_per_pixel\":{},"
      "\"threads\":{},\"seconds\":{{\"bind\":{:.6f},\"render\":{:.6f},\"write\":{:.6f}}},"
      "\"primitives\":{},\"split_primitives\":{},\"grids\":{},\"shaded_grids\":{},\"micropolygons\":{},"
      "\"shaded_points\":{},\"texture_files\":{},\"texture_bytes\":{},\"peak_bytes\":{},"
      "\"rays\":{{\"all\":{},\"shadow\":{},\"hemisphere\":{},\"hemispheres\":{},\"hit_grids\":{},"
      "\"hit_points\":{},\"faces\":{},\"bytes\":{}}},\"shaders\":[{}]}}",
      FrameStatistics::kVersion, s.frame, s.width, s.height, s.samples_per_pixel, s.threads, s.bind_seconds,
      s.render_seconds, s.write_seconds, r.primitives, r.split_primitives, r.grids, r.shaded_grids,
      r.micropolygons, r.shaded_points, s.texture_files, s.texture_bytes, s.peak_bytes, s.rays.all(),
      s.rays.shadow_rays, s.rays.hemisphere_rays, s.rays.hemispheres, s.rays.hit_grids, s.rays.hit_points,
      s.rays.geometry.faces, s.rays.geometry.bytes, shaders);
}

long long peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<long long>(usage.ru_maxrss) * 1024;
}

} // namespace render
