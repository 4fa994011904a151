// Requests that set attributes, shaders and lights.
#include "render/state/interpreter.h"

#include "render/state/transforms.h"

#include <fmt/format.h>

namespace render {

/// The attributes, copied first when a primitive or an open block holds on to them.
Attributes& Interpreter::edit() {
  if (attributes_.use_count() > 1) attributes_ = std::make_shared<Attributes>(*attributes_);
  return *attributes_;
}

void Interpreter::attribute(const RequestCall& call) {
  const std::string& category = call.text(0);
  for (const Param& p : call.params) {
    auto named = named_value_of(call, category, p);
    if (!named) continue;
    edit().named[category + ":" + named->first] = named->second;
    if (auto problem = set_ray_attribute(edit().rays, category, named->first, named->second);
        problem && !problem->empty()) {
      const std::string text = fmt::format("\"{}\" {}", named->first, *problem);
      if (named->first == "shadingmodel") // each release has other ones
        warn_once(fmt::format("shadingmodel {}", fmt::join(named->second.strings, " ")), p.where, "rib",
                  fmt::format("Attribute: {}", text));
      else
        error_at(p.where, call, text);
    }
    attribute_parameter(call, p, named->first, named->second);
  }
}

/// The values that are not only for shaders to read.
void Interpreter::attribute_parameter(const RequestCall& call, const Param& p, const std::string& name,
                                      const slvm::Value& value) {
  const std::string& category = call.text(0);
  if (!value.strings.empty()) {
    if (category == "identifier" && name == "name") edit().name = value.strings[0];
    if (category == "displacementbound" && name == "coordinatesystem")
      edit().displacement_space = value.strings[0];
    if (category == "trimcurve" && name == "sense" && value.strings[0] != "inside" &&
        value.strings[0] != "outside")
      error_at(p.where, call, fmt::format("\"{}\" is not \"inside\" or \"outside\"", value.strings[0]));
    return;
  }
  float number = value.numbers[0];
  if (category == "displacementbound" && name == "sphere") {
    if (number >= 0)
      edit().displacement_sphere = number;
    else
      error_at(p.where, call, "\"sphere\" takes one number, 0 or more");
  } else if (category == "cull" && name == "hidden") {
    edit().cull_hidden = number != 0;
  } else if (category == "cull" && name == "backfacing") {
    edit().cull_backfacing = number != 0;
  } else if (category == "stitch" && name == "enable") {
    edit().stitch = number != 0;
  } else if (category == "sides" && name == "backfacetolerance") {
    edit().back_face_tolerance = std::clamp(number, 0.0f, 90.0f);
  } else if (category == "dice") {
    dice_parameter(name, number);
  }
}

void Interpreter::dice_parameter(const std::string& name, float value) {
  Dicing& dicing = edit().dicing;
  if (name == "rasterorient")
    dicing.raster_oriented = value != 0;
  else if (name == "binary")
    dicing.binary = value != 0;
  else if (name == "hair")
    dicing.hair = value != 0;
  else if (name == "minlength")
    dicing.shortest = std::max(value, 0.0f);
}

void Interpreter::geometric_approximation(const RequestCall& call) {
  const std::string& type = call.text(0);
  float value = call.number(1);
  edit().named["GeometricApproximation:" + type] = {slvm::Type::kFloat, 0, {value}, {}};
  if (!check_parameter(call, {call.id, "", call.where}, type, edit().named["GeometricApproximation:" + type]))
    return;
  if (type != "motionfactor" && type != "focusfactor") return;
  if (value < 0) {
    error_at(call.arguments[1].where, call, fmt::format("\"{}\" takes one number, 0 or more", type));
    return;
  }
  (type == "motionfactor" ? edit().dicing.motion_factor : edit().dicing.focus_factor) = value;
}

void Interpreter::color(const RequestCall& call) {
  auto c = call.numbers(0);
  edit().color = {c[0], c[1], c[2]};
}

void Interpreter::opacity(const RequestCall& call) {
  auto o = call.numbers(0);
  edit().opacity = {o[0], o[1], o[2]};
}

void Interpreter::texture_coordinates(const RequestCall& call) {
  auto& tc = edit().texture_coordinates;
  for (int i = 0; i < 8; ++i)
    tc[static_cast<size_t>(i)] = call.number(i);
}

std::shared_ptr<ShaderRequest> Interpreter::make_shader(const RequestCall& call) {
  auto shader = std::make_shared<ShaderRequest>();
  shader->kind = call.id;
  shader->name = call.text(0);
  shader->shader_to_camera = ctm_;
  shader->where = call.where;
  for (const Param& p : call.params) {
    ShaderParam& out = shader->params.emplace_back();
    out.numbers = p.numbers;
    out.strings = p.strings;
    out.where = p.where;
    auto declared = declarations_.resolve(p.token);
    if (declared) {
      out.declaration = *declared;
      out.name = declared->name;
    } else if (p.token.find_first_of(" \t[") == std::string::npos) {
      out.name = p.token; // the shader's own declaration decides
    } else {
      error_at(p.where, call, declared.error());
      shader->params.pop_back();
    }
  }
  return shader;
}

/// Surface, Displacement, Atmosphere, Interior, Exterior.
void Interpreter::shader(const RequestCall& call) {
  auto shader = call.text(0) == "null" ? nullptr : make_shader(call);
  Attributes& a = edit();
  switch (call.id) {
  case RequestId::kSurface:
    // "null" as a surface is a shader that draws nothing, unlike no surface, which is drawn by the default
    // one.
    a.surface = shader ? shader : make_shader(call);
    break;
  case RequestId::kDisplacement: a.displacement = shader; break;
  case RequestId::kInterior: a.interior = shader; break;
  case RequestId::kExterior: a.exterior = shader; break;
  default: a.atmosphere = shader; break;
  }
}

namespace {

/// As BMRT and its kin call it; "samples" is the younger name.
uint32_t area_light_samples(const Attributes& attributes) {
  constexpr float kMost = 65536;
  for (const char* name : {"light:nsamples", "light:samples"})
    if (auto it = attributes.named.find(name); it != attributes.named.end())
      return static_cast<uint32_t>(std::clamp(it->second.numbers[0], 1.0f, kMost));
  return ShaderRequest().samples;
}

} // namespace

void Interpreter::light_source(const RequestCall& call) {
  const bool area = call.id == RequestId::kAreaLightSource;
  if (call.text(0) == "null") {
    if (area) edit().area_light = nullptr;
    return;
  }
  auto light = make_shader(call);
  light->handle = call.text(1);
  if (area) {
    light->samples = area_light_samples(*attributes_);
    edit().area_light = light;
  }
  // A handle that is used again names the new light from here on; the old one goes on shining.
  lights_[light->handle] = light;
  edit().lights.push_back(light);
}

void Interpreter::illuminate(const RequestCall& call) {
  const std::string& handle = call.text(0);
  auto it = lights_.find(handle);
  if (it == lights_.end()) {
    error_at(call.arguments[0].where, call, fmt::format("no light has the handle \"{}\"", handle),
             RiError::kBadHandle);
    return;
  }
  auto& on = edit().lights;
  std::erase(on, it->second);
  if (call.integer(1) != 0) on.push_back(it->second);
}

void Interpreter::shading_rate(const RequestCall& call) {
  constexpr float kFinest = 1e-4f;
  if (call.number(0) > 0)
    edit().shading_rate = std::max(call.number(0), kFinest);
  else
    error(call, "the shading rate must be positive", RiError::kRange);
}

void Interpreter::shading_interpolation(const RequestCall& call) {
  if (call.text(0) == "smooth")
    edit().smooth_shading = true;
  else if (call.text(0) == "constant")
    edit().smooth_shading = false;
  else
    error(call, fmt::format("\"{}\" is not \"constant\" or \"smooth\"", call.text(0)));
}

void Interpreter::matte(const RequestCall& call) {
  if (call.integer(0) != 0 && call.integer(0) != 1)
    warn(call, fmt::format("{} is taken as 1: there is one kind of hole", call.integer(0)));
  edit().matte = call.integer(0) != 0;
}

void Interpreter::orientation(const RequestCall& call) {
  constexpr std::pair<std::string_view, Orientation> kNames[] = {{"outside", Orientation::kOutside},
                                                                 {"inside", Orientation::kInside},
                                                                 {"lh", Orientation::kLeftHanded},
                                                                 {"rh", Orientation::kRightHanded}};
  for (auto [name, value] : kNames)
    if (name == call.text(0)) {
      edit().orientation = value;
      return;
    }
  error(call, fmt::format("\"{}\" is not \"outside\", \"inside\", \"lh\" or \"rh\"", call.text(0)));
}

void Interpreter::reverse_orientation(const RequestCall&) {
  Orientation& o = edit().orientation;
  switch (o) {
  case Orientation::kOutside: o = Orientation::kInside; break;
  case Orientation::kInside: o = Orientation::kOutside; break;
  case Orientation::kLeftHanded: o = Orientation::kRightHanded; break;
  case Orientation::kRightHanded: o = Orientation::kLeftHanded; break;
  }
}

void Interpreter::sides(const RequestCall& call) {
  if (call.integer(0) == 1 || call.integer(0) == 2)
    edit().sides = call.integer(0);
  else
    error(call, "a surface has 1 or 2 sides", RiError::kRange);
}

namespace {

struct NamedBasis {
  std::string_view name;
  CubicBasis basis;
};

/// RISpec 3.2, section 5.3: rows hold the coefficients of t^3, t^2, t and 1.
const NamedBasis* find_basis(std::string_view name) {
  constexpr float k6 = 1.0f / 6;
  static const NamedBasis kBases[] = {
      {"bezier", bezier_basis()},
      {"b-spline",
       {{{-k6, 3 * k6, -3 * k6, k6, 3 * k6, -6 * k6, 3 * k6, 0, -3 * k6, 0, 3 * k6, 0, k6, 4 * k6, k6, 0}},
        1}},
      {"catmull-rom", {{{-.5f, 1.5f, -1.5f, .5f, 1, -2.5f, 2, -.5f, -.5f, 0, .5f, 0, 0, 1, 0, 0}}, 1}},
      {"hermite", {{{2, 1, -2, 1, -3, -2, 3, -1, 0, 1, 0, 0, 1, 0, 0, 0}}, 2}},
      {"power", {{}, 4}}};
  for (const NamedBasis& b : kBases)
    if (b.name == name) return &b;
  return nullptr;
}

} // namespace

void Interpreter::basis(const RequestCall& call) {
  for (int side : {0, 1}) {
    const Argument& a = call.arguments[static_cast<size_t>(2 * side)];
    CubicBasis basis{{}, call.integer(2 * side + 1)};
    if (!a.numbers.empty()) {
      basis.matrix = matrix_from(a.numbers);
    } else if (const NamedBasis* named = find_basis(a.strings[0])) {
      basis.matrix = named->basis.matrix;
    } else {
      error_at(a.where, call,
               fmt::format("unknown basis \"{}\"; known are bezier, b-spline, catmull-rom, hermite, "
                           "power, or 16 numbers",
                           a.strings[0]));
      return;
    }
    (side == 0 ? edit().ubasis : edit().vbasis) = basis;
  }
}

} // namespace render
