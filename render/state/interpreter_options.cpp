// Requests that set options.
#include "render/state/interpreter.h"
#include "render/state/search_path.h"
#include "render/texture/make_maps.h"

#include <fmt/format.h>

#include <cmath>

namespace render {

void Interpreter::format(const RequestCall& call) {
  constexpr int kMaxResolution = 1 << 16;
  for (int i : {0, 1})
    if (call.integer(i) > kMaxResolution) {
      error(call, fmt::format("{} pixels are more than the {} an image may have in one direction",
                              call.integer(i), kMaxResolution));
      return;
    }
  if (call.integer(0) > 0) options_.xres = call.integer(0);
  if (call.integer(1) > 0) options_.yres = call.integer(1);
  if (call.number(2) > 0) options_.pixel_aspect = call.number(2);
}

void Interpreter::frame_aspect_ratio(const RequestCall& call) {
  if (call.number(0) > 0)
    options_.frame_aspect = call.number(0);
  else
    error(call, "the aspect ratio must be positive");
}

void Interpreter::screen_window(const RequestCall& call) {
  std::array w{call.number(0), call.number(1), call.number(2), call.number(3)};
  if (w[0] == w[1] || w[2] == w[3])
    error(call, "the window has no area");
  else
    options_.screen_window = w;
}

void Interpreter::crop_window(const RequestCall& call) {
  std::array c{call.number(0), call.number(1), call.number(2), call.number(3)};
  if (c[0] >= c[1] || c[2] >= c[3])
    error(call, "the window is empty; expected xmin < xmax and ymin < ymax");
  else
    options_.crop = c;
}

void Interpreter::projection(const RequestCall& call) {
  std::string name = call.has(0) ? call.text(0) : "null";
  if (name == "perspective") {
    options_.projection = ProjectionKind::kPerspective;
  } else if (name == "orthographic" || name == "null") {
    options_.projection = ProjectionKind::kOrthographic;
  } else {
    error_at(call.arguments[0].where, call,
             fmt::format("unknown projection \"{}\"; expected \"perspective\" or \"orthographic\"", name));
    return;
  }
  for (const Param& p : call.params) {
    bool is_fov = call.find_param("fov") == &p;
    if (!is_fov) {
      diagnostics_.warning(p.where, "rib-unused",
                           fmt::format("Projection: \"{}\" has no meaning here", p.token));
    } else if (p.numbers.size() != 1 || !(p.numbers[0] > 0) || !(p.numbers[0] < 180)) {
      error_at(p.where, call, "\"fov\" takes one number between 0 and 180 degrees");
    } else {
      options_.fov = p.numbers[0];
    }
  }
  // Camera space starts here; what came before acts on the projected image.
  options_.screen_transform = ctm_;
  ctm_ = {};
}

void Interpreter::clipping(const RequestCall& call) {
  float near = call.number(0), far = call.number(1);
  if (!(near < far)) {
    error(call, fmt::format("the near plane ({:g}) is not in front of the far one ({:g})", near, far));
    return;
  }
  constexpr float kNearest = 1e-6f;
  options_.near_plane = std::max(near, kNearest);
  options_.far_plane = far;
}

void Interpreter::clipping_plane(const RequestCall& call) {
  auto normal = slvm::transform_normal(ctm_, {call.number(3), call.number(4), call.number(5)});
  ClippingPlane plane{transform_point(ctm_, Vec3(call.number(0), call.number(1), call.number(2))),
                      {normal[0], normal[1], normal[2]}};
  if (glm::dot(plane.normal, plane.normal) > 0)
    options_.clipping_planes.push_back(plane);
  else
    error(call, "the normal has no length");
}

void Interpreter::shutter(const RequestCall& call) {
  if (call.number(1) < call.number(0)) warn(call, "it closes before it opens: nothing moves");
  options_.shutter_open = call.number(0);
  options_.shutter_close = call.number(1);
}

void Interpreter::pixel_samples(const RequestCall& call) {
  constexpr float kMost = 64;
  float x = call.number(0), y = call.number(1);
  if (!(x >= 1) || !(y >= 1) || x > kMost || y > kMost)
    error(call, fmt::format("expected 1 to {} samples in each direction", kMost));
  options_.xsamples = static_cast<int>(std::clamp(std::round(x), 1.0f, kMost));
  options_.ysamples = static_cast<int>(std::clamp(std::round(y), 1.0f, kMost));
  if (x != std::round(x) || y != std::round(y))
    warn(call, fmt::format("{:g} by {:g} samples are rounded to {} by {}", x, y, options_.xsamples,
                           options_.ysamples));
}

void Interpreter::pixel_filter(const RequestCall& call) {
  constexpr float kWidest = 32;
  float x = call.number(1), y = call.number(2);
  if (!(x > 0) || !(y > 0) || x > kWidest || y > kWidest) {
    error(call, fmt::format("expected widths above 0 and up to {} pixels", kWidest));
    return;
  }
  if (auto kind = find_filter(call.text(0)))
    options_.filter = {*kind, x, y};
  else
    error_at(call.arguments[0].where, call,
             fmt::format("unknown filter \"{}\"; known are {}", call.text(0), filter_names()));
}

void Interpreter::exposure(const RequestCall& call) {
  if (!(call.number(1) > 0)) {
    error(call, "gamma must be positive");
    return;
  }
  options_.gain = call.number(0);
  options_.gamma = call.number(1);
}

void Interpreter::imager(const RequestCall& call) {
  // An option, but scenes have it among their surfaces, too.
  if (in_world_) warn(call, "it is an option and holds for the whole frame: it belongs before WorldBegin");
  auto& frame_imager = in_world_ ? scene_.options.imager : options_.imager;
  frame_imager = nullptr;
  if (call.text(0) == "null") return;
  auto imager = make_shader(call);
  // Where the background is built in, its parameter is "color", which no parameter of a shader can be called.
  for (ShaderParam& p : imager->params)
    if (imager->name == "background" && p.name == "color") p.name = "bgcolor";
  frame_imager = imager;
}

void Interpreter::quantize(const RequestCall& call) {
  Quantization q{call.integer(1), call.integer(2), call.integer(3), call.number(4), true};
  if (q.min > q.max) {
    error(call, "min is larger than max");
    return;
  }
  if (call.text(0) == "rgba" || call.text(0) == "rgb" || call.text(0) == "a")
    options_.rgba = q;
  else if (call.text(0) == "z")
    options_.z = q;
  else
    options_.channel_quantization[call.text(0)] = q;
}

void Interpreter::display(const RequestCall& call) {
  DisplayRequest d{call.text(0), call.text(1), call.text(2), {}, call.where};
  constexpr std::string_view kModes[] = {"rgb", "rgba", "rgbz", "rgbaz", "a", "z", "az"};
  auto is_mode = [&](const std::string& s) {
    return std::find(std::begin(kModes), std::end(kModes), s) != std::end(kModes);
  };
  if (is_mode(d.type) && !is_mode(d.mode)) {
    error_at(call.arguments[1].where, call,
             fmt::format("\"{0}\" is a mode; the type is missing, as in Display \"{1}\" \"tiff\" \"{0}\"",
                         d.type, d.name));
    return;
  }
  for (const Param& p : call.params)
    if (auto named = named_value_of(call, "", p)) d.params[named->first] = named->second;
  if (d.type == "deepshad" || d.type == "tsm") {
    // A map of one depth is looked up in the same way.
    warn_once(
        "deepshad", call.where, "rib-unsupported",
        fmt::format("Display \"{}\": maps of more than one depth are not made; a shadow map of the first "
                    "opaque surfaces is, and what is transparent casts no shadow",
                    d.type));
    d.type = "shadow";
    d.mode = "z";
  }
  bool add = d.name.starts_with('+');
  if (add)
    d.name.erase(0, 1);
  else
    options_.displays.clear();
  options_.displays.push_back(std::move(d));
}

void Interpreter::display_channel(const RequestCall& call) {
  auto declared = declarations_.resolve(call.text(0));
  if (!declared && call.text(0).find_first_of(" \t[") != std::string::npos) {
    error_at(call.arguments[0].where, call, declared.error());
    return;
  }
  ChannelRequest channel{call.text(0), {}, call.where};
  for (const Param& p : call.params)
    if (auto named = named_value_of(call, "", p)) channel.params[named->first] = named->second;
  options_.channels[declared ? declared->name : call.text(0)] = std::move(channel);
}

/// "-" or nothing: a pinhole.
void Interpreter::depth_of_field(const RequestCall& call) {
  if (!call.has(1) || call.number(1) > 1e20f) {
    options_.fstop = kInfinity;
    return;
  }
  if (!call.has(3) || !(call.number(1) > 0) || !(call.number(2) > 0) || !(call.number(3) > 0)) {
    error(call, "expected f-stop, focal length and focal distance above 0, or - for a pinhole");
    return;
  }
  options_.fstop = call.number(1);
  options_.focal_length = call.number(2);
  options_.focal_distance = call.number(3);
}

void Interpreter::hider(const RequestCall& call) {
  const std::string& type = call.text(0);
  if (type == "paint")
    warn_once("Hider paint", call.where, "rib-unsupported",
              "Hider \"paint\" is not supported: surfaces hide each other by depth, as by \"hidden\"");
  else if (type != "hidden" && type != "depthmask" && type != "null" && type != "photon")
    warn_once("Hider " + type, call.where, "rib-unsupported",
              fmt::format("Hider \"{}\" is not supported yet: \"hidden\" is used", type));
  constexpr size_t kUsualPhotons = 10000;
  options_.photons = type == "photon" ? kUsualPhotons : 0;
  options_.no_image = type == "null";
  options_.depth_mask.reset();
  if (type == "depthmask") options_.depth_mask = DepthMaskRequest{{}, false, 0.01f, call.where};
  for (const Param& p : call.params)
    if (auto named = named_value_of(call, type, p)) hider_parameter(call, named->first, named->second);
  if (options_.depth_mask && options_.depth_mask->file.empty()) {
    error(call, "\"depthmask\" needs \"zfile\", the depth image to compare with");
    options_.depth_mask.reset();
  }
}

void Interpreter::hider_parameter(const RequestCall& call, const std::string& name,
                                  const slvm::Value& value) {
  if (!value.strings.empty()) {
    if (name == "zfile" && options_.depth_mask) options_.depth_mask->file = value.strings[0];
    if (name == "depthfilter") depth_filter(call, value.strings[0]);
    return;
  }
  float number = value.numbers[0];
  if (name == "emit" && options_.photons > 0)
    options_.photons = static_cast<size_t>(std::clamp(number, 1.0f, 1e9f));
  else if (name == "jitter")
    options_.jitter = number != 0;
  else if (name == "subpixel")
    options_.subpixel = number != 0;
  else if (name == "samplemotion")
    options_.sample_motion = number != 0;
  else if (name == "reversesign" && options_.depth_mask)
    options_.depth_mask->reverse = number != 0;
  else if (name == "depthbias" && options_.depth_mask)
    options_.depth_mask->bias = number;
}

void Interpreter::depth_filter(const RequestCall& call, const std::string& name) {
  constexpr std::pair<std::string_view, DepthFilter> kNames[] = {{"min", DepthFilter::kMin},
                                                                 {"max", DepthFilter::kMax},
                                                                 {"average", DepthFilter::kAverage},
                                                                 {"midpoint", DepthFilter::kMidpoint}};
  for (auto [known, filter] : kNames)
    if (known == name) {
      options_.depth_filter = filter;
      return;
    }
  error(call, fmt::format("unknown depthfilter \"{}\"; known are min, max, average, midpoint", name));
}

void Interpreter::option(const RequestCall& call) {
  const std::string& category = call.text(0);
  if (in_world_ && category != "user") {
    error(call, "options cannot change inside a world block; the request is skipped");
    return;
  }
  for (const Param& p : call.params) {
    auto named = named_value_of(call, category, p);
    if (!named) continue;
    const auto& [name, value] = *named;
    if (category == "blobby" && name == "codes" && value.strings[0] != "rispec" &&
        value.strings[0] != "note31") {
      error(call, fmt::format("\"codes\" is \"rispec\" or \"note31\", found \"{}\"", value.strings[0]));
      continue;
    }
    const std::string full = fmt::format("{}:{}", category, name);
    options_.named[full] = value;
    if (in_world_) scene_.options.named[full] = value;
    if (category == "searchpath" && !value.strings.empty())
      search_path(name, value);
    else if (category == "limits" && !value.numbers.empty())
      limit(name, value);
    else if (category == "hider")
      hider_parameter(call, name, value);
    else if (category == "shutter" && name == "offset")
      options_.shutter_offset = value.numbers[0];
  }
}

namespace {

/// Whether a map's filter is given a width that has no effect. Filter, swidth and twidth stand before the
/// parameters.
bool width_is_lost(const RequestCall& call) {
  if (call.id == RequestId::kMakeShadow) return false;
  bool flat = call.id == RequestId::kMakeTexture || call.id == RequestId::kMakeBump;
  int filter = flat ? 4 : call.id == RequestId::kMakeLatLongEnvironment ? 2 : 8;
  const std::optional<FilterKind> kind = find_filter(call.text(filter));
  return !(kind && has_width(*kind)) && call.number(filter + 1) * call.number(filter + 2) != 1;
}

} // namespace

void Interpreter::make_request(const RequestCall& call) {
  if (!make_map) return;
  if (width_is_lost(call))
    warn_once("make widths", call.where, "rib-unsupported",
              "this filter of maps has a width of its own: swidth and twidth have no effect; they count for "
              "box, triangle and gaussian");
  no_parameters(call);
  if (std::string why = make_map(call, options_); !why.empty()) error(call, why);
}

void Interpreter::search_path(const std::string& kind, const slvm::Value& value) {
  auto& current = options_.search_paths[kind];
  current = parse_search_path(value.strings[0], current, standard_paths[kind]);
}

void Interpreter::limit(const std::string& name, const slvm::Value& value) {
  const std::vector<float>& n = value.numbers;
  auto clamp = [](float x, float low, float high) { return static_cast<int>(std::clamp(x, low, high)); };
  auto colour = [&] { return n.size() == 3 ? Color(n[0], n[1], n[2]) : Color(n[0]); };
  if (name == "bucketsize") {
    options_.bucket_width = clamp(n[0], 4, 1024);
    options_.bucket_height = clamp(n[1], 4, 1024);
  } else if (name == "gridsize") {
    constexpr float kLeast = 64; // what makes a grid costs as much as shading so many points
    options_.grid_size = clamp(n[0], kLeast, 65536);
  } else if (name == "eyesplits") {
    options_.eye_splits = clamp(n[0], 0, 24);
  } else if (name == "othreshold") {
    options_.opacity_threshold = colour();
  } else if (name == "zthreshold") {
    options_.depth_threshold = colour();
  } else if (name == "threads") {
    options_.threads = clamp(n[0], 0, 4096);
  } else if (name == "texturememory") {
    options_.texture_megabytes = std::clamp(n[0] / 1024, 1.0f, 1e6f);
  } else if (name == "octreememory") {
    options_.octree_megabytes = std::clamp(n[0] / 1024, 1.0f, 1e6f);
  }
}

} // namespace render
