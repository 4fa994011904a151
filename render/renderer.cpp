// The steps of a frame, from scene to files.
#include "render/renderer.h"

#include "render/caches/cache_files.h"
#include "render/display/output.h"
#include "render/display/preview.h"
#include "render/hider/frame.h"
#include "render/map_requests.h"
#include "render/photons/photon_maps.h"
#include "render/photons/photon_tracer.h"
#include "render/rays/ray_tracer.h"
#include "render/shading/vm_shading.h"
#include "render/state/interpreter.h"
#include "render/state/search_path.h"
#include "render/statistics.h"
#include "render/texture/depth_image.h"
#include "render/texture/find_image.h"
#include "render/texture/texture_maps.h"
#include "stdlib/scattering/baked_clouds.h"
#include "stdlib/scattering/cloud_lookups.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <optional>
#include <set>
#include <tuple>
#include <unistd.h>

namespace render {

struct Renderer::Impl {
  Impl(slvm::SourceManager& sources, slvm::Diagnostics& d, RendererSettings s)
      : diagnostics(d), settings(std::move(s)),
        machine({.zero_for_unserved = true, .plugin_folders = settings.plugin_folders}),
        cache(machine, settings.shader_loader), interpreter(sources, d, [this](Scene& scene) {
          render(scene);
          end_plugins();
        }) {
    interpreter.override_options = settings.override_options;
    interpreter.wants_frame = settings.wants_frame;
    interpreter.allow_programs = settings.allow_programs;
    interpreter.program_limits.seconds = settings.program_seconds;
    interpreter.procedural_folders = settings.procedural_folders;
    interpreter.around_plug_in = settings.around_plug_in;
    interpreter.make_map = make_map;
  }

  void render(Scene& scene);
  void emit_photons(Scene& scene);
  void report_runtime_messages();
  void report_pixels(const FrameSettings& s, const FrameReport& report);
  void report_replaced(TextureMaps& textures);
  void write_points(subsurface::BakedClouds& baked);
  void end_plugins();
  bool load_mask(const Options& options, DepthMask& mask);
  void make_what_rays_see(Scene& scene);
  void report_rays(const RayTracer& rays);
  void flush() {
    if (settings.flush_messages) settings.flush_messages();
  }

  slvm::Diagnostics& diagnostics;
  RendererSettings settings;
  slvm::Machine machine;
  ShaderCache cache;
  Interpreter interpreter;
  subsurface::CloudCache clouds;
  std::vector<std::string> written;
  /// Run-time messages already shown, by file, line, shader and text.
  std::set<std::string> replaced; ///< names of textures whose replacements were reported
  std::set<std::tuple<std::string, uint32_t, std::string, std::string>> shown;
};

namespace {

TextureMaps::Settings texture_settings(const Options& options) {
  TextureMaps::Settings s;
  if (auto it = options.search_paths.find("texture"); it != options.search_paths.end())
    s.folders = it->second;
  auto named = [&](const char* name, float otherwise) {
    auto it = options.named.find(name);
    return it == options.named.end() ? otherwise : it->second.numbers[0];
  };
  s.shadow_bias = named("shadow:bias", s.shadow_bias);
  // bias0 and bias1 are the ends of a range.
  if (options.named.contains("shadow:bias0") && options.named.contains("shadow:bias1")) {
    s.shadow_bias = named("shadow:bias0", 0);
    s.shadow_bias_spread = named("shadow:bias1", 0) - s.shadow_bias;
  }
  s.memory_megabytes = options.texture_megabytes;
  return s;
}

/// Turns the name of a file that is read into a path; the options must live as long.
std::function<std::string(std::string_view)> texture_finder(const Options& options) {
  return [&options](std::string_view name) {
    const auto folders = options.search_paths.find("texture");
    if (folders == options.search_paths.end()) return std::string(name);
    return find_file(name, folders->second).value_or(std::string(name));
  };
}

/// For a frame; the options must live as long.
subsurface::CloudLookups cloud_lookups(subsurface::CloudCache& clouds, const Options& options) {
  subsurface::CloudCache::Settings s;
  s.most_bytes = static_cast<size_t>(options.octree_megabytes * (1 << 20));
  if (auto it = options.named.find("subsurface:treefolder"); it != options.named.end())
    s.folder = it->second.strings[0];
  clouds.configure(std::move(s));
  return subsurface::CloudLookups(clouds, texture_finder(options));
}

/// What shaders of a frame ask. All arguments must outlive this.
struct FrameServices {
  FrameServices(const Scene& frame, const slvm::Machine& machine, const BoundShaders& shaders,
                subsurface::CloudCache& clouds, const std::function<void(std::string_view)>& print)
      : textures(texture_settings(frame.options)), lookups(cloud_lookups(clouds, frame.options)),
        baked(texture_finder(frame.options)), caches(texture_finder(frame.options)),
        photons(texture_finder(frame.options)), services(frame, shaders, textures, lookups, baked, print),
        rays(frame, machine, shaders, services) {
    services.set_rays(&rays);
    services.set_irradiance_caches(&caches);
    services.set_photon_maps(&photons);
    rays.set_cache_files(&caches);
    rays.set_photon_maps(&photons);
  }

  TextureMaps textures;
  subsurface::CloudLookups lookups;
  subsurface::BakedClouds baked;
  CacheFiles caches;
  PhotonMaps photons;
  SceneServices services;
  RayTracer rays;
};

} // namespace

/// Instead of a picture: Hider "photon".
void Renderer::Impl::emit_photons(Scene& frame) {
  make_what_rays_see(frame);
  BoundShaders shaders(frame, machine, cache, diagnostics);
  flush();
  FrameServices all(frame, machine, shaders, clouds, settings.print);
  all.rays.show_to_photons();
  PhotonTracer tracer(frame, machine, shaders, all.services, all.rays);
  const int threads = thread_count(settings.threads > 0 ? settings.threads : frame.options.threads);
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    const PhotonReport report = tracer.run(frame.options.photons);
    for (const std::string& problem : report.problems)
      diagnostics.warning({}, "photon", problem);
    if (settings.photons) settings.photons(report);
    if (tracer.maps().empty())
      diagnostics.warning(
          {}, "photon",
          "no photon was stored: surfaces need Attribute \"photon\" \"globalmap\" or \"causticmap\"");
    for (const std::string& problem : tracer.write())
      diagnostics.error({}, problem);
  });
  report_rays(all.rays);
  write_points(all.baked);
  report_runtime_messages();
  flush();
}

namespace {

/// Why the picture cannot be held, or nothing: rather now than after hours, or with the machine brought to a
/// halt.
std::string too_large(const Options& options, const FrameSettings& settings) {
  const PixelRect crop = Camera(options).crop();
  const double samples = options.subpixel ? options.xsamples * options.ysamples : 1;
  auto floats = static_cast<double>(settings.shown.count());
  if (!settings.aovs.empty()) floats += settings.aovs.back().first + settings.aovs.back().components;
  const double bytes = samples * crop.width() * crop.height() * floats * sizeof(float);
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (bytes < memory) return {};
  return fmt::format(
      "a picture of {} x {} pixels takes {:.0f} GB, and this machine has {:.0f}; parts of it can be "
      "rendered with CropWindow or --crop",
      crop.width(), crop.height(), bytes * 1e-9, memory * 1e-9);
}

} // namespace

void Renderer::Impl::render(Scene& frame) {
  if (frame.options.no_image) return;
  if (frame.options.photons > 0) return emit_photons(frame);
  if (frame.options.displays.empty()) frame.options.displays.push_back({"ri.tif", "file", "rgba", {}, {}});
  FrameSettings s;
  s.threads = settings.threads > 0 ? settings.threads : frame.options.threads;
  s.aovs = display_aovs(frame.options, diagnostics);
  s.shown = shown_channels(frame.options, s.aovs);
  s.progress = settings.progress;
  using Clock = std::chrono::steady_clock;
  auto seconds_since = [](Clock::time_point from) {
    return std::chrono::duration<double>(Clock::now() - from).count();
  };
  FrameStatistics statistics;
  auto started = Clock::now();
  make_what_rays_see(frame);
  BoundShaders shaders(frame, machine, cache, diagnostics);
  flush();
  if (s.progress) s.progress(0);
  FrameServices all(frame, machine, shaders, clouds, settings.print);
  if (thread_count(s.threads) == 1) all.rays.set_alone();
  VmShading shading(machine, shaders, all.services);
  s.make_content = [&](const Procedural& p, float area) {
    SceneContent content = interpreter.make_content(p, area);
    shaders.add(content.primitives);
    all.services.add_spaces(content.spaces);
    return content;
  };
  DepthMask mask;
  if (load_mask(frame.options, mask)) s.mask = &mask;
  FrameReport& report = statistics.report;
  statistics.bind_seconds = seconds_since(started);
  started = Clock::now();
  std::optional<Preview> preview;
  if (!settings.preview.empty()) {
    preview.emplace(frame.options, s.aovs, settings.preview);
    for (size_t c = 0; c < 3; ++c)
      s.shown.set(Image::kCi + c);
    s.finished = [&](const Image& pixels, const PixelRect& rect) { preview->add(pixels, rect); };
  }
  if (std::string why = too_large(frame.options, s); !why.empty()) {
    diagnostics.error({}, why);
    return;
  }
  Image image = render_frame(frame, shading, s, report);
  statistics.render_seconds = seconds_since(started);
  if (preview)
    if (std::string why = preview->finish(); !why.empty())
      diagnostics.error({}, fmt::format("cannot write the preview \"{}\": {}", settings.preview, why));
  report_runtime_messages();
  report_rays(all.rays);
  write_points(all.baked);
  report_replaced(all.textures);
  for (const std::string& problem : all.photons.problems())
    diagnostics.warning({}, "photon", problem);
  report_pixels(s, report);
  started = Clock::now();
  for (std::string& name : write_displays(frame, image, s.aovs, diagnostics))
    written.push_back(std::move(name));
  for (const std::string& problem : all.caches.write())
    diagnostics.error({}, problem);
  statistics.write_seconds = seconds_since(started);
  if (settings.statistics) {
    const Options& o = frame.options;
    statistics.frame = o.frame;
    if (auto it = o.named.find("statistics:endofframe"); it != o.named.end() && !it->second.numbers.empty())
      statistics.asked_for = it->second.numbers[0] > 0;
    statistics.width = image.rect.width();
    statistics.height = image.rect.height();
    statistics.samples_per_pixel = o.xsamples * o.ysamples;
    statistics.threads = thread_count(s.threads);
    auto [files, bytes] = all.textures.usage();
    statistics.rays = all.rays.usage();
    statistics.texture_files = files;
    statistics.texture_bytes = bytes;
    statistics.peak_bytes = peak_memory();
    settings.statistics(statistics);
  }
  flush();
}

void Renderer::Impl::report_rays(const RayTracer& rays) {
  if (std::string why = rays.problem(); !why.empty()) diagnostics.error({}, why);
}

/// Rays come from everywhere: procedurals they can hit are made before the first one is shot.
void Renderer::Impl::make_what_rays_see(Scene& scene) {
  Camera camera(scene.options);
  for (size_t i = 0; i < scene.procedurals.size();) {
    const RayAttributes& rays = scene.procedurals[i].attributes->rays;
    if (!rays.seen_by_rays() && !(scene.options.photons > 0 && rays.photon)) {
      ++i;
      continue;
    }
    Procedural p = std::move(scene.procedurals[i]);
    scene.procedurals.erase(scene.procedurals.begin() + static_cast<std::ptrdiff_t>(i));
    auto seen = seen_bound(p, camera, Vec2(0.0f));
    SceneContent content = interpreter.make_content(p, seen ? seen->area : 0);
    scene.primitives.append(std::move(content.primitives));
    scene.procedurals.insert(scene.procedurals.end(), std::make_move_iterator(content.procedurals.begin()),
                             std::make_move_iterator(content.procedurals.end()));
    scene.spaces.insert(content.spaces.begin(), content.spaces.end());
  }
}

/// The depth image of Hider "depthmask". False: there is none, or (reported) it cannot be had.
bool Renderer::Impl::load_mask(const Options& options, DepthMask& mask) {
  if (!options.depth_mask) return false;
  const DepthMaskRequest& request = *options.depth_mask;
  std::vector<std::string> folders;
  if (auto it = options.search_paths.find("texture"); it != options.search_paths.end()) folders = it->second;
  auto found = find_image(request.file, folders);
  std::string problem = "no such file in the texture search path";
  DepthImage image;
  if (found) problem = read_depth_image(*found, image);
  if (!problem.empty()) {
    diagnostics.error(request.where, fmt::format("Hider: \"{}\": {}", request.file, problem));
    return false;
  }
  mask = {image.width, image.height, std::move(image.depth), request.reverse, request.bias};
  return true;
}

/// The machine's own "file:line: text (shader, n of m points)", each once.
void Renderer::Impl::report_runtime_messages() {
  for (const slvm::RuntimeMessage& m : machine.messages()) {
    if (!shown.emplace(m.file, m.line, m.shader, m.text).second) continue;
    std::string text =
        fmt::format("{}:{}: {} ({}, {} of {} points)", m.file, m.line, m.text, m.shader, m.points, m.total);
    if (m.severity == slvm::MessageSeverity::kError)
      diagnostics.error({}, text);
    else
      diagnostics.warning({}, "runtime", text);
  }
}

void Renderer::Impl::write_points(subsurface::BakedClouds& baked) {
  for (std::string& problem : baked.finish())
    diagnostics.error({}, std::move(problem));
}

/// What cannot be right in the picture.
void Renderer::Impl::report_pixels(const FrameSettings& s, const FrameReport& report) {
  for (size_t a = 0; a < std::min<size_t>(s.aovs.size(), 64) && report.shaded_grids > 0; ++a)
    if (s.aovs[a].source == AovChannel::Source::kVariable && !(report.variables >> a & 1))
      diagnostics.warning(
          {}, "display",
          fmt::format("no surface in the picture has a variable \"{}\"; its channels are 0", s.aovs[a].name));
  if (report.bad_colours > 0)
    diagnostics.warning({}, "nan",
                        fmt::format("{} shading points have a colour that is not a finite number; "
                                    "they are drawn black",
                                    report.bad_colours));
}

void Renderer::Impl::report_replaced(TextureMaps& textures) {
  for (const auto& [wanted, used] : textures.replaced())
    if (replaced.insert(wanted).second)
      diagnostics.warning({}, "texture",
                          fmt::format("texture \"{}\" is missing: \"{}\" is used", wanted, used));
}

/// When nothing of the frame is left: plug-ins may have something to say then, too.
void Renderer::Impl::end_plugins() {
  const std::string told = machine.end_plugins();
  if (!told.empty() && settings.plugin_statistics) settings.plugin_statistics(told);
  report_runtime_messages();
  flush();
}

Renderer::Renderer(slvm::SourceManager& sources, slvm::Diagnostics& diagnostics, RendererSettings settings)
    : impl_(std::make_unique<Impl>(sources, diagnostics, std::move(settings))) {}

Renderer::~Renderer() = default;

bool Renderer::read_file(const std::string& name) {
  return impl_->interpreter.read_file(name);
}
void Renderer::read_text(std::string name, std::string text) {
  impl_->interpreter.read_text(std::move(name), std::move(text));
}
void Renderer::finish() {
  impl_->interpreter.finish();
}
Interpreter& Renderer::interpreter() {
  return impl_->interpreter;
}
Options& Renderer::options() {
  return impl_->interpreter.options();
}
void Renderer::set_standard_path(const std::string& kind, std::vector<std::string> directories) {
  impl_->interpreter.options().search_paths[kind] = directories;
  impl_->interpreter.standard_paths[kind] = std::move(directories);
}
const std::vector<std::string>& Renderer::written() const {
  return impl_->written;
}

} // namespace render
