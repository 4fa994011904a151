#include "stdlib/scattering/cloud_lookups.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace subsurface {
namespace {

using slvm::SubsurfaceLookup;
using Form = SubsurfaceLookup::Form;

constexpr float kUsualEta = 1.3f; // skin; the course's 4.2
constexpr const char* kUsualMaterial = "marble";

Color colour_at(const SubsurfaceLookup::Numbers (&values)[3], size_t point) {
  return {SubsurfaceLookup::at(values[0], point), SubsurfaceLookup::at(values[1], point),
          SubsurfaceLookup::at(values[2], point)};
}
bool varies(const SubsurfaceLookup::Numbers (&values)[3]) {
  return std::any_of(std::begin(values), std::end(values), [](const auto& v) { return v.size() > 1; });
}
bool above(Color c, float least) {
  return c.x > least && c.y > least && c.z > least && is_finite(c);
}

/// The points that are on, and what was found for each.
class Lookup {
public:
  Lookup(const SubsurfaceLookup& lookup, LitCloud& cloud) : lookup_(lookup), cloud_(cloud) {
    if (lookup.max_solid_angle >= 0) options_.epsilon = lookup.max_solid_angle;
    options_.smooth = lookup.smooth;
    options_.follow_topology = lookup.follow_topology;
    for (size_t i = 0; i < lookup.points; ++i) {
      if (!lookup.active(i)) continue;
      active_.push_back(i);
      x_.push_back({lookup.position[0][i], lookup.position[1][i], lookup.position[2][i]});
      if (!lookup.normal[0].empty())
        normals_.push_back(normalize({lookup.normal[0][i], lookup.normal[1][i], lookup.normal[2][i]}));
    }
    light_.resize(x_.size());
  }

  std::string run() {
    std::string problem;
    switch (lookup_.form) {
    case Form::kNamed: problem = named(); break;
    case Form::kCoefficients:
    case Form::kAppearance:
      problem = varies(lookup_.first) || varies(lookup_.second) ? by_point() : by_call();
      break;
    case Form::kOfPoints: problem = of_points(); break;
    }
    store();
    if (problem.empty() && options_.follow_topology > 0 && !cloud_.tree().has_normals())
      problem = "\"followtopology\" has no effect: the cloud has no normals";
    return problem;
  }

private:
  /// Lookups have Fdt in them, the light that gets in; shaders put Fresnel's terms in by themselves.
  void look_up(const DiffusionMaterial& material, float eta, size_t begin, size_t end) {
    LookupOptions options = options_;
    if (!normals_.empty()) options.normals = std::span(normals_).subspan(begin, end - begin);
    cloud_.tree().exitance(material, std::span(x_).subspan(begin, end - begin), options,
                           std::span(light_).subspan(begin, end - begin));
    const auto inside = static_cast<float>(1 / (1 - diffuse_fresnel(static_cast<double>(eta))));
    for (size_t k = begin; k < end; ++k)
      light_[k] *= inside;
  }

  float eta() const { return lookup_.eta > 0 ? lookup_.eta : kUsualEta; }

  std::string named() {
    auto material = find_material(lookup_.material.empty() ? kUsualMaterial : lookup_.material);
    if (!material) return material.error();
    if (lookup_.eta > 0) material->eta = static_cast<double>(lookup_.eta);
    look_up(DiffusionMaterial(dipole_of(medium_of(*material, 0, static_cast<double>(lookup_.millimetres)))),
            static_cast<float>(material->eta), 0, x_.size());
    return "";
  }

  /// Of what is said for a point. None: it cannot be.
  std::optional<DiffusionMaterial> material_at(size_t point) const {
    const Color first = colour_at(lookup_.first, point), second = colour_at(lookup_.second, point);
    if (lookup_.form == Form::kAppearance) {
      if (!above(second, 0) || !is_finite(first)) return {};
      return DiffusionMaterial(
          dipole_of(medium_of(first, second * (1 / lookup_.millimetres), 0, static_cast<double>(eta()))));
    }
    if (!(first.x >= 0 && first.y >= 0 && first.z >= 0 && second.x >= 0 && second.y >= 0 && second.z >= 0) ||
        !is_finite(first) || !is_finite(second))
      return {};
    const double scale = static_cast<double>(lookup_.millimetres);
    MediumRgb medium;
    for (int c = 0; c < 3; ++c)
      medium[static_cast<size_t>(c)] =
          medium_of_reduced(static_cast<double>(second[c]) * scale, static_cast<double>(first[c]) * scale, 0,
                            static_cast<double>(eta()));
    return DiffusionMaterial(dipole_of(medium));
  }
  std::string bad_material() const {
    return lookup_.form == Form::kAppearance
               ? "\"diffusemeanfreepath\" must be above 0 in each colour"
               : "\"scattering\" and \"absorption\" must be 0 or more in each colour";
  }

  std::string by_call() {
    const auto material = material_at(0);
    if (!material) return bad_material();
    look_up(*material, eta(), 0, x_.size());
    return "";
  }

  /// Another material at each point; where neighbours have the same it is made once.
  std::string by_point() {
    std::optional<DiffusionMaterial> material;
    std::array<Color, 2> of{};
    bool bad = false;
    for (size_t k = 0; k < x_.size(); ++k) {
      const std::array<Color, 2> here{colour_at(lookup_.first, active_[k]),
                                      colour_at(lookup_.second, active_[k])};
      if (k == 0 || here != of) material = material_at(active_[k]);
      of = here;
      if (material)
        look_up(*material, eta(), k, k + 1);
      else
        bad = true;
    }
    return bad ? bad_material() : "";
  }

  std::string of_points() {
    const Color path =
        colour_at(lookup_.second, active_.empty() ? 0 : active_[0]) * (1 / lookup_.millimetres);
    if (!above(path, 0)) return "\"diffusemeanfreepath\" must be above 0 in each colour";
    if (!cloud_.tree().has_albedo())
      return "the points of the cloud have no albedo: the call needs \"albedo\"";
    look_up(*cloud_.material(path, eta()), eta(), 0, x_.size());
    return "";
  }

  void store() const {
    for (size_t k = 0; k < active_.size(); ++k)
      for (int c = 0; c < 3; ++c)
        lookup_.result[c][active_[k]] = light_[k][c];
  }

  const SubsurfaceLookup& lookup_;
  LitCloud& cloud_;
  LookupOptions options_;
  std::vector<size_t> active_;
  std::vector<Vec3> x_, normals_;
  std::vector<Color> light_;
};

} // namespace

std::string CloudLookups::subsurface(const slvm::SubsurfaceLookup& lookup) {
  const auto found = clouds_.get(find_ ? find_(lookup.cloud) : std::string(lookup.cloud));
  if (!found) return found.error();
  const std::string problem = Lookup(lookup, *found->cloud).run();
  return problem.empty() ? found->warning : problem;
}

} // namespace subsurface
