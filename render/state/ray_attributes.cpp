// The parameters by name.
#include "render/state/ray_attributes.h"

#include <algorithm>
#include <fmt/format.h>

namespace render {

namespace {

std::string set_flag(bool& out, const slvm::Value& value) {
  if (value.numbers.size() != 1) return "takes one number";
  out = value.numbers[0] != 0;
  return "";
}

std::string set_number(float& out, const slvm::Value& value) {
  if (value.numbers.size() != 1 || !(value.numbers[0] >= 0)) return "takes one number, 0 or more";
  out = value.numbers[0];
  return "";
}

std::string set_depth(int& out, const slvm::Value& value) {
  if (value.numbers.size() != 1 || !(value.numbers[0] >= 0)) return "takes one number, 0 or more";
  out = static_cast<int>(std::min(value.numbers[0], 1000.0f));
  return "";
}

std::string set_hit_mode(bool& shaded, const slvm::Value& value) {
  if (value.strings.size() != 1 || (value.strings[0] != "shader" && value.strings[0] != "primitive"))
    return "is \"primitive\" or \"shader\"";
  shaded = value.strings[0] == "shader";
  return "";
}

std::string set_transmission(RayOpacity& out, const slvm::Value& value) {
  if (value.numbers.size() == 1) {
    out = value.numbers[0] != 0 ? RayOpacity::kShader : RayOpacity::kTransparent;
    return "";
  }
  constexpr std::pair<std::string_view, RayOpacity> kNames[] = {{"transparent", RayOpacity::kTransparent},
                                                                {"opaque", RayOpacity::kOpaque},
                                                                {"Os", RayOpacity::kOs},
                                                                {"shader", RayOpacity::kShader}};
  for (auto [name, opacity] : kNames)
    if (value.strings.size() == 1 && value.strings[0] == name) {
      out = opacity;
      return "";
    }
  return "is \"transparent\", \"opaque\", \"Os\", \"shader\", 0 or 1";
}

std::optional<std::string> set_visibility(RayAttributes& a, std::string_view name, const slvm::Value& value) {
  if (name == "camera") return set_flag(a.camera, value);
  if (name == "specular") return set_flag(a.specular, value);
  if (name == "diffuse") return set_flag(a.diffuse, value);
  if (name == "photon") return set_flag(a.photon, value);
  if (name == "transmission") return set_transmission(a.transmission, value);
  if (name != "trace") return {};
  std::string problem = set_flag(a.specular, value);
  if (problem.empty()) a.diffuse = a.specular;
  return problem;
}

std::optional<std::string> set_trace(RayAttributes& a, std::string_view name, const slvm::Value& value) {
  if (name == "bias") return set_number(a.bias, value);
  if (name == "maxspeculardepth") return set_depth(a.max_specular_depth, value);
  if (name == "maxdiffusedepth") return set_depth(a.max_diffuse_depth, value);
  if (name == "displacements") return set_flag(a.displacements, value);
  if (name == "samplemotion") return set_flag(a.sample_motion, value);
  return {};
}

std::optional<std::string> set_shade(RayAttributes& a, std::string_view name, const slvm::Value& value) {
  if (name == "specularhitmode") return set_hit_mode(a.specular_shaded, value);
  if (name == "diffusehitmode") return set_hit_mode(a.diffuse_shaded, value);
  if (name == "transmissionhitmode") return set_hit_mode(a.transmission_shaded, value);
  return {};
}

std::string set_text(std::string& out, const slvm::Value& value) {
  if (value.strings.size() != 1) return "takes one string";
  out = value.strings[0];
  return "";
}

/// By CacheMode.
constexpr std::string_view kCacheModes[] = {"", "r", "w", "rw", "R"};

std::optional<std::string> set_irradiance(RayAttributes& a, std::string_view name, const slvm::Value& value) {
  if (name == "maxerror") return set_number(a.max_error, value);
  if (name == "maxpixeldist") return set_number(a.max_pixel_distance, value);
  if (name == "handle") return set_text(a.irradiance_file, value);
  if (name != "filemode") return {};
  for (size_t i = 0; i < std::size(kCacheModes) && value.strings.size() == 1; ++i)
    if (value.strings[0] == kCacheModes[i]) {
      a.irradiance_mode = static_cast<CacheMode>(i);
      return "";
    }
  return "is \"\", \"r\", \"w\", \"rw\" or \"R\"";
}

/// By PhotonModel.
constexpr std::string_view kPhotonModels[] = {"matte", "translucent", "chrome",
                                              "glass", "water",       "transparent"};

std::optional<std::string> set_photon(RayAttributes& a, std::string_view name, const slvm::Value& value) {
  if (name == "globalmap") return set_text(a.global_map, value);
  if (name == "causticmap") return set_text(a.caustic_map, value);
  if (name == "estimator") {
    if (value.numbers.size() != 1 || !(value.numbers[0] >= 1)) return "takes one number, 1 or more";
    a.photon_estimator = static_cast<int>(std::min(value.numbers[0], 1e6f));
    return "";
  }
  if (name == "ior") {
    if (value.numbers.size() != 1 || !(value.numbers[0] >= 1)) return "takes one number, 1 or more";
    a.photon_ior = value.numbers[0];
    return "";
  }
  if (name != "shadingmodel") return {};
  if (value.strings.size() != 1) return "takes one string";
  // Later releases: "refractive:ior=1.4", and names of their own for what refracts.
  std::string_view text = value.strings[0], model = text.substr(0, text.find(':'));
  if (constexpr std::string_view kIor = ":ior="; text.substr(model.size()).starts_with(kIor)) {
    const float ior = std::strtof(value.strings[0].c_str() + model.size() + kIor.size(), nullptr);
    if (!(ior >= 1)) return "has an index of refraction of 1 or more";
    a.photon_ior = ior;
  }
  if (model == "refractive" || model == "dielectric") model = "glass";
  for (size_t i = 0; i < std::size(kPhotonModels); ++i)
    if (model == kPhotonModels[i]) {
      a.photon_model = static_cast<PhotonModel>(i);
      return "";
    }
  return fmt::format("\"{}\" is not known; known are \"{}\"; photons go on as before it", model,
                     fmt::join(kPhotonModels, "\", \""));
}

/// "a b" replaces the groups; "+a" joins one, "-a" leaves one.
std::string set_groups(std::string& groups, const slvm::Value& value) {
  if (value.strings.size() != 1) return "takes one string";
  std::vector<std::string> members;
  std::vector<std::string_view> wanted = words_of(value.strings[0]);
  auto changes = [](std::string_view word) { return word[0] == '+' || word[0] == '-'; };
  if (!wanted.empty() && std::all_of(wanted.begin(), wanted.end(), changes))
    for (std::string_view word : words_of(groups))
      members.emplace_back(word);
  for (std::string_view word : wanted) {
    std::string name(changes(word) ? word.substr(1) : word);
    std::erase(members, name);
    if (word[0] != '-' && !name.empty()) members.push_back(name);
  }
  groups = fmt::format("{}", fmt::join(members, " "));
  return "";
}

} // namespace

std::optional<slvm::Value> ray_attribute_value(const RayAttributes& a, std::string_view name) {
  auto number = [](float x) { return slvm::Value{slvm::Type::kFloat, 0, {x}, {}}; };
  auto text = [](std::string_view s) { return slvm::Value{slvm::Type::kString, 0, {}, {std::string(s)}}; };
  auto mode = [&](bool shaded) { return text(shaded ? "shader" : "primitive"); };
  constexpr std::string_view kOpacities[] = {"transparent", "opaque", "Os", "shader"};
  if (name == "visibility:camera") return number(a.camera);
  if (name == "visibility:specular") return number(a.specular);
  if (name == "visibility:diffuse") return number(a.diffuse);
  if (name == "visibility:trace") return number(a.specular && a.diffuse);
  if (name == "visibility:photon") return number(a.photon);
  if (name == "visibility:transmission") return text(kOpacities[static_cast<size_t>(a.transmission)]);
  if (name == "shade:specularhitmode") return mode(a.specular_shaded);
  if (name == "shade:diffusehitmode") return mode(a.diffuse_shaded);
  if (name == "shade:transmissionhitmode") return mode(a.transmission_shaded);
  if (name == "trace:bias") return number(a.bias);
  if (name == "trace:maxspeculardepth") return number(static_cast<float>(a.max_specular_depth));
  if (name == "trace:maxdiffusedepth") return number(static_cast<float>(a.max_diffuse_depth));
  if (name == "trace:displacements") return number(a.displacements);
  if (name == "trace:samplemotion") return number(a.sample_motion);
  if (name == "irradiance:maxerror") return number(a.max_error);
  if (name == "irradiance:maxpixeldist") return number(a.max_pixel_distance);
  if (name == "irradiance:handle") return text(a.irradiance_file);
  if (name == "irradiance:filemode") return text(kCacheModes[static_cast<size_t>(a.irradiance_mode)]);
  if (name == "photon:globalmap") return text(a.global_map);
  if (name == "photon:causticmap") return text(a.caustic_map);
  if (name == "photon:shadingmodel") return text(kPhotonModels[static_cast<size_t>(a.photon_model)]);
  if (name == "photon:ior") return number(a.photon_ior);
  if (name == "photon:estimator") return number(static_cast<float>(a.photon_estimator));
  if (name == "grouping:membership") return text(a.groups);
  return {};
}

std::vector<std::string_view> words_of(std::string_view list) {
  constexpr std::string_view kApart = " ,\t\n\r";
  std::vector<std::string_view> out;
  for (size_t at = list.find_first_not_of(kApart); at != std::string_view::npos;) {
    size_t end = std::min(list.find_first_of(kApart, at), list.size());
    out.push_back(list.substr(at, end - at));
    at = list.find_first_not_of(kApart, end);
  }
  return out;
}

std::optional<std::string> set_ray_attribute(RayAttributes& a, std::string_view category,
                                             std::string_view name, const slvm::Value& value) {
  if (category == "visibility") return set_visibility(a, name, value);
  if (category == "trace") return set_trace(a, name, value);
  if (category == "shade") return set_shade(a, name, value);
  if (category == "grouping" && name == "membership") return set_groups(a.groups, value);
  if (category == "photon") return set_photon(a, name, value);
  if (category == "irradiance") return set_irradiance(a, name, value);
  return {};
}

} // namespace render
