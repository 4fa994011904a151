// What rays see of an object and what its own rays are like: Attributes "visibility", "trace", "shade",
// "grouping" and "irradiance". Names and defaults of PRMan 12, and the older forms of "visibility" beside
// them.
#pragma once

#include "slvm/value.h"

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace render {

/// How much light an object lets through to shadows.
enum class RayOpacity : uint8_t {
  kTransparent, ///< all: transmission rays do not see it
  kOpaque,      ///< none
  kOs,          ///< 1 - Os of the hit
  kShader,      ///< 1 - Oi, after its shaders ran
};

/// How the file of an irradiance cache is used.
enum class CacheMode : uint8_t {
  kNone,         ///< "": not at all
  kSeed,         ///< "r": what it holds is used, the rest is computed
  kWrite,        ///< "w": begun anew, and written at the end of the frame
  kSeedAndWrite, ///< "rw": both
  kOnly,         ///< "R": nothing is computed
};

/// What a photon does at a surface.
enum class PhotonModel : uint8_t { kMatte, kTranslucent, kChrome, kGlass, kWater, kTransparent };

struct RayAttributes {
  // "visibility"
  bool camera = true, specular = false, diffuse = false, photon = true;
  RayOpacity transmission = RayOpacity::kTransparent;
  // "shade": whether shaders run where rays hit, or Cs and Os are used.
  bool specular_shaded = true, diffuse_shaded = true, transmission_shaded = true;
  // "trace"
  float bias = 0.01f;
  int max_specular_depth = 2, max_diffuse_depth = 1;
  bool displacements = false, sample_motion = false;
  // "irradiance"
  float max_error = 0.5f, max_pixel_distance = 30;
  std::string irradiance_file; ///< "handle"
  CacheMode irradiance_mode = CacheMode::kNone;
  // "photon"
  std::string global_map, caustic_map; ///< files
  PhotonModel photon_model = PhotonModel::kMatte;
  float photon_ior = 0;       ///< of glass and water; 0: as they have it
  int photon_estimator = 100; ///< photons that radiance is computed of
  /// "grouping" "membership": names with single spaces between.
  std::string groups;

  auto operator<=>(const RayAttributes&) const = default;

  bool seen_by_rays() const { return specular || diffuse || transmission != RayOpacity::kTransparent; }
  /// `transmission`, where "shade" "transmissionhitmode" "primitive" spares the shaders.
  RayOpacity shadow() const {
    return transmission == RayOpacity::kShader && !transmission_shaded ? RayOpacity::kOs : transmission;
  }
};

/// Takes a parameter of Attribute `category`. Nothing: it is none of these. Else "" or what is wrong with the
/// value.
std::optional<std::string> set_ray_attribute(RayAttributes& a, std::string_view category,
                                             std::string_view name, const slvm::Value& value);

/// What a parameter comes to, by its name as attribute() takes it ("trace:bias"), whether it was given or
/// not.
std::optional<slvm::Value> ray_attribute_value(const RayAttributes& a, std::string_view name);

/// The words of a list apart by spaces or commas.
std::vector<std::string_view> words_of(std::string_view list);

} // namespace render
