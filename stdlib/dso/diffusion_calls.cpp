// diffusion(): the light that a lit cloud gives a point by the dipoles of all its samples, far ones in groups
// (Jensen and Buhler 2002; the course's 4.4).
#include "stdlib/dso/calls.h"
#include "stdlib/dso/plugin_data.h"
#include "stdlib/subsurface/lit_cloud.h"

#include <fmt/format.h>
#include <mutex>
#include <optional>

namespace subsurface_plugin {
namespace {

using namespace subsurface;

/// The clouds of the run.
struct RunClouds {
  static constexpr const char* kName = "anemone.subsurface.clouds";
  void end(RixContext&) {}
  CloudCache cache;
};

/// Those of a frame, and what its options say about them.
struct CloudsOfFrame {
  static constexpr const char* kName = "anemone.subsurface.frame_clouds";
  void end(RixContext&) {}
  std::once_flag begun;
  std::optional<FrameClouds> clouds;
};

CloudCache::Settings settings_of_scene() {
  CloudCache::Settings settings;
  settings.most_bytes = octree_memory(settings.most_bytes);
  RxInfoType_t type;
  int count = 0;
  char* folder = nullptr;
  if (RxOption("subsurface:treefolder", &folder, sizeof folder, &type, &count) == 0 && folder)
    settings.folder = folder;
  return settings;
}

/// Null, with a message: it cannot be used.
std::shared_ptr<LitCloud> cloud_of(const RslContext& context, const char* file) {
  auto& frame = of_frame<CloudsOfFrame>(context);
  std::call_once(frame.begun, [&] {
    CloudCache& cache = of_run<RunClouds>(context).cache;
    cache.configure(settings_of_scene());
    frame.clouds.emplace(cache);
  });
  auto found = frame.clouds->get(file);
  if (!found) {
    complain(context, found.error());
    return nullptr;
  }
  if (!found->warning.empty()) complain(context, found->warning);
  return found->cloud;
}

/// Calls `lookup` for all points at once and stores what it finds. Lookups have Fdt in them, the light that
/// gets in; shaders put Fresnel's terms in by themselves.
template <class Lookup> int look_up(const RslArg* result, const RslArg* P, float eta, Lookup&& lookup) {
  RslColorIter out(result);
  RslPointIter at(P);
  const unsigned int count = result->NumValues();
  std::vector<Vec3> x(count);
  for (unsigned int i = 0; i < count; ++i, ++at)
    x[i] = vec3(*at);
  std::vector<Color> light(count);
  lookup(x, light);
  const auto inside = static_cast<float>(1 / (1 - diffuse_fresnel(static_cast<double>(eta))));
  for (unsigned int i = 0; i < count; ++i, ++out)
    store(light[i] * inside, *out);
  return 0;
}

/// A number that has to be above 0; false, with a message, if it is not.
bool positive(const RslContext& context, const char* name, float value) {
  if (value > 0) return true;
  complain(context, fmt::format("diffusion(): {} is {}, it must be above 0", name, value));
  return false;
}
bool positive(const RslContext& context, const char* name, Color value) {
  return positive(context, name, value.x) && positive(context, name, value.y) &&
         positive(context, name, value.z);
}

int nothing(const RslArg* result) {
  RslColorIter out(result);
  for (unsigned int i = 0; i < result->NumValues(); ++i, ++out)
    store(Color{}, *out);
  return 0;
}

} // namespace

// result, P, cloud, material, mm, epsilon
int diffusion_of_material(RslContext* context, int, const RslArg* argv[]) {
  RslStringIter file(argv[2]), name(argv[3]);
  RslFloatIter mm(argv[4]), epsilon(argv[5]);
  auto material = find_material(*name);
  if (!material) complain(*context, material.error());
  if (!material || !positive(*context, "mm", *mm)) return nothing(argv[0]);
  const auto cloud = cloud_of(*context, *file);
  if (!cloud) return nothing(argv[0]);
  const DiffusionMaterial dipoles(dipole_of(medium_of(*material, 0, static_cast<double>(*mm))));
  return look_up(argv[0], argv[1], static_cast<float>(material->eta), [&](auto& x, auto& light) {
    cloud->tree().exitance(dipoles, x, {*epsilon, {}}, light);
  });
}

// result, P, cloud, albedo, freepath, eta, epsilon
int diffusion_of_appearance(RslContext* context, int, const RslArg* argv[]) {
  RslStringIter file(argv[2]);
  RslColorIter albedo(argv[3]), free_path(argv[4]);
  RslFloatIter eta(argv[5]), epsilon(argv[6]);
  const Color path = vec3(*free_path);
  if (!positive(*context, "freepath", path) || !positive(*context, "eta", *eta)) return nothing(argv[0]);
  const auto cloud = cloud_of(*context, *file);
  if (!cloud) return nothing(argv[0]);
  const DiffusionMaterial dipoles(dipole_of(medium_of(vec3(*albedo), path, 0, static_cast<double>(*eta))));
  return look_up(argv[0], argv[1], *eta, [&](auto& x, auto& light) {
    cloud->tree().exitance(dipoles, x, {*epsilon, {}}, light);
  });
}

// result, P, cloud, freepath, eta, epsilon
int diffusion_of_points(RslContext* context, int, const RslArg* argv[]) {
  RslStringIter file(argv[2]);
  RslColorIter free_path(argv[3]);
  RslFloatIter eta(argv[4]), epsilon(argv[5]);
  const Color path = vec3(*free_path);
  if (!positive(*context, "freepath", path) || !positive(*context, "eta", *eta)) return nothing(argv[0]);
  const auto cloud = cloud_of(*context, *file);
  if (!cloud) return nothing(argv[0]);
  const auto dipoles = cloud->material(path, *eta);
  return look_up(argv[0], argv[1], *eta, [&](auto& x, auto& light) {
    cloud->tree().exitance(*dipoles, x, {*epsilon, {}}, light);
  });
}

namespace {

/// Levels from fine to coarse, and what they are made of; empty, with a message, if they cannot be used.
struct Levels {
  std::vector<std::shared_ptr<LitCloud>> clouds;
  std::vector<std::shared_ptr<const DiffusionMaterial>> materials;
  std::vector<CloudLevels::Level> levels;
};

/// `material_of` says how a cloud scatters.
template <class MaterialOf>
Levels levels_of(const RslContext& context, const RslArg* clouds, const RslArg* limits,
                 MaterialOf&& material_of) {
  RslStringArrayIter files(clouds);
  RslFloatArrayIter radii(limits);
  Levels made;
  for (int i = 0; i < files.GetLength(); ++i) {
    const bool last = i + 1 == files.GetLength();
    if (!last && (i >= radii.GetLength() || !(radii[i] > (i ? radii[i - 1] : 0)))) {
      complain(context, fmt::format("diffusion(): {} clouds need {} radii that rise, from fine to coarse",
                                    files.GetLength(), files.GetLength() - 1));
      return {};
    }
    auto cloud = cloud_of(context, files[i]);
    if (!cloud) return {};
    made.materials.push_back(material_of(*cloud));
    made.levels.push_back({&cloud->tree(), made.materials.back().get(), last ? 0 : radii[i]});
    made.clouds.push_back(std::move(cloud));
  }
  return made;
}

int look_up_levels(const RslArg* result, const RslArg* P, float eta, float epsilon, Levels made) {
  constexpr float kFade = 0.2f; // of each radius: where one level passes into the next
  if (made.levels.empty()) return nothing(result);
  const CloudLevels together(std::move(made.levels));
  return look_up(result, P, eta, [&](auto& x, auto& light) { together.exitance(x, epsilon, kFade, light); });
}

} // namespace

// result, P, clouds, radii, albedo, freepath, eta, epsilon
int diffusion_of_levels(RslContext* context, int, const RslArg* argv[]) {
  RslColorIter albedo(argv[4]), free_path(argv[5]);
  RslFloatIter eta(argv[6]), epsilon(argv[7]);
  const Color path = vec3(*free_path);
  if (!positive(*context, "freepath", path) || !positive(*context, "eta", *eta)) return nothing(argv[0]);
  const auto dipoles = std::make_shared<const DiffusionMaterial>(
      dipole_of(medium_of(vec3(*albedo), path, 0, static_cast<double>(*eta))));
  auto same = [&](const LitCloud&) { return dipoles; };
  return look_up_levels(argv[0], argv[1], *eta, *epsilon, levels_of(*context, argv[2], argv[3], same));
}

// result, P, clouds, radii, freepath, eta, epsilon
int diffusion_of_point_levels(RslContext* context, int, const RslArg* argv[]) {
  RslColorIter free_path(argv[4]);
  RslFloatIter eta(argv[5]), epsilon(argv[6]);
  const Color path = vec3(*free_path);
  if (!positive(*context, "freepath", path) || !positive(*context, "eta", *eta)) return nothing(argv[0]);
  auto own = [&](LitCloud& cloud) { return cloud.material(path, *eta); };
  return look_up_levels(argv[0], argv[1], *eta, *epsilon, levels_of(*context, argv[2], argv[3], own));
}

} // namespace subsurface_plugin
