#include "stdlib/subsurface/materials.h"

#include "slvm/support/diagnostics.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace subsurface {
namespace {

constexpr MeasuredMaterial kMaterials[] = {
    {"Apple", {2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, {0.85, 0.84, 0.53}, 1.3},
    {"Chicken1", {0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}, {0.31, 0.15, 0.10}, 1.3},
    {"Chicken2", {0.19, 0.25, 0.32}, {0.018, 0.088, 0.20}, {0.32, 0.16, 0.10}, 1.3},
    {"Cream", {7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, {0.98, 0.90, 0.73}, 1.3},
    {"Ketchup", {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, {0.16, 0.01, 0.00}, 1.3},
    {"Marble", {2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, {0.83, 0.79, 0.75}, 1.5},
    {"Potato", {0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}, {0.77, 0.62, 0.21}, 1.3},
    {"Skimmilk", {0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, {0.81, 0.81, 0.69}, 1.3},
    {"Skin1", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, {0.44, 0.22, 0.13}, 1.3},
    {"Skin2", {1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, {0.63, 0.44, 0.34}, 1.3},
    {"Spectralon", {11.6, 20.4, 14.9}, {0, 0, 0}, {1.00, 1.00, 1.00}, 1.3},
    {"Wholemilk", {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, {0.91, 0.88, 0.76}, 1.3},
};

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

} // namespace

std::span<const MeasuredMaterial> measured_materials() {
  return kMaterials;
}

slvm::Result<MeasuredMaterial> find_material(std::string_view name) {
  std::vector<std::string> names;
  for (const MeasuredMaterial& m : kMaterials) {
    names.push_back(lower(m.name));
    if (names.back() == lower(name)) return m;
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  if (std::string_view near = slvm::nearest_name(lower(name), candidates); !near.empty())
    return slvm::Error{fmt::format("unknown material '{}'; did you mean '{}'?", name, near)};
  return slvm::Error{fmt::format("unknown material '{}'; there are: {}", name, fmt::join(names, ", "))};
}

MediumRgb medium_of(const MeasuredMaterial& material, double g, double scale) {
  MediumRgb out;
  for (size_t c = 0; c < 3; ++c)
    out[c] = medium_of_reduced(material.absorption[c] / scale, material.reduced_scattering[c] / scale, g,
                               material.eta);
  return out;
}

MediumRgb medium_of(Color albedo, Color mean_free_path, double g, double eta, DiffuseFresnel how) {
  MediumRgb out;
  for (int c = 0; c < 3; ++c)
    out[static_cast<size_t>(c)] = medium_of(Appearance{albedo[c], mean_free_path[c]}, g, eta, how);
  return out;
}

DipoleRgb dipole_of(const MediumRgb& medium, DiffuseFresnel how) {
  return {Dipole(medium[0], how), Dipole(medium[1], how), Dipole(medium[2], how)};
}

} // namespace subsurface
