// Materials of three wavelengths, and those that have been measured, by name.
#pragma once

#include "slvm/support/result.h"
#include "stdlib/subsurface/dipole.h"

#include <array>
#include <span>
#include <string_view>

namespace subsurface {

using MediumRgb = std::array<Medium, 3>;
using DipoleRgb = std::array<Dipole, 3>;

/// A row of figure 5 of Jensen et al. 2001: measured, in 1/mm.
struct MeasuredMaterial {
  std::string_view name;
  std::array<double, 3> reduced_scattering; ///< sigma_s' [1/mm], red, green, blue
  std::array<double, 3> absorption;         ///< sigma_a [1/mm]
  /// Total diffuse reflectance: measured, too, and a constraint of the fit. diffuse_albedo() agrees to 0.01
  /// but for the blue of Chicken1, 0.126 instead of 0.10.
  std::array<double, 3> reflectance;
  double eta;
};

/// All of them, in the order of the figure: Apple, Chicken1, Chicken2, Cream, Ketchup, Marble, Potato,
/// Skimmilk, Skin1, Skin2, Spectralon, Wholemilk.
std::span<const MeasuredMaterial> measured_materials();
/// By name, without regard to case. The error names one with a similar name, or all.
slvm::Result<MeasuredMaterial> find_material(std::string_view name);

/// As coefficients. The table gives no g; `scale`: units in a mm (0.1 for scenes in cm, so that coefficients
/// are in 1/cm).
MediumRgb medium_of(const MeasuredMaterial& material, double g = 0, double scale = 1);
/// From what is seen, by wavelength (2002, 4).
MediumRgb medium_of(Color albedo, Color mean_free_path, double g, double eta,
                    DiffuseFresnel how = DiffuseFresnel::kFit);
DipoleRgb dipole_of(const MediumRgb& medium, DiffuseFresnel how = DiffuseFresnel::kFit);

} // namespace subsurface
