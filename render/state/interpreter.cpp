// The dispatch of requests: which member function carries out which, where they are legal, messages. The
// requests themselves: interpreter_blocks.cpp, _solids.cpp, _motion.cpp, _archives.cpp, _conditions.cpp,
// _options.cpp, _parameters.cpp, _attributes.cpp, _detail.cpp, _transforms.cpp, _geometry.cpp.
#include "render/state/interpreter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace render {

Interpreter::Interpreter(slvm::SourceManager& sources, slvm::Diagnostics& diagnostics,
                         std::function<void(Scene&)> render_world)
    : sources_(sources), diagnostics_(diagnostics), render_world_(std::move(render_world)),
      attributes_(std::make_shared<Attributes>()) {}

Interpreter::~Interpreter() = default;

Interpreter::Handler Interpreter::handler(RequestId id) {
  using I = Interpreter;
  static const auto kHandlers = [] {
    std::array<Handler, kRequestCount> h{};
    auto set = [&](RequestId r, Handler f) { h[static_cast<size_t>(r)] = f; };
    using enum RequestId;
    set(kFrameBegin, &I::frame_begin), set(kFrameEnd, &I::frame_end);
    set(kWorldBegin, &I::world_begin), set(kWorldEnd, &I::world_end);
    set(kAttributeBegin, &I::attribute_begin), set(kAttributeEnd, &I::attribute_end);
    set(kTransformBegin, &I::transform_begin), set(kTransformEnd, &I::transform_end);
    set(kSolidBegin, &I::solid_begin), set(kSolidEnd, &I::solid_end);
    set(kMotionBegin, &I::motion_begin), set(kMotionEnd, &I::motion_end);
    set(kObjectBegin, &I::object_begin), set(kObjectEnd, &I::recording_end);
    set(kObjectInstance, &I::object_instance);
    set(kArchiveBegin, &I::archive_begin), set(kArchiveEnd, &I::recording_end);
    set(kArchiveInstance, &I::archive_instance), set(kReadArchive, &I::read_archive);
    set(kIfBegin, &I::if_begin), set(kElseIf, &I::else_branch), set(kElse, &I::else_branch),
        set(kIfEnd, &I::if_end);
    set(kDeclare, &I::declare), set(kversion, &I::version), set(kBound, &I::accept);
    set(kProcedural, &I::procedural);
    set(kErrorHandler, &I::error_handler);

    set(kFormat, &I::format), set(kFrameAspectRatio, &I::frame_aspect_ratio);
    set(kScreenWindow, &I::screen_window), set(kCropWindow, &I::crop_window);
    set(kProjection, &I::projection), set(kClipping, &I::clipping), set(kClippingPlane, &I::clipping_plane),
        set(kShutter, &I::shutter);
    set(kPixelSamples, &I::pixel_samples), set(kPixelFilter, &I::pixel_filter), set(kExposure, &I::exposure);
    set(kImager, &I::imager), set(kQuantize, &I::quantize), set(kDisplay, &I::display),
        set(kDisplayChannel, &I::display_channel);
    set(kDepthOfField, &I::depth_of_field), set(kHider, &I::hider), set(kOption, &I::option);
    set(kRelativeDetail, &I::relative_detail), set(kDetail, &I::detail), set(kDetailRange, &I::detail_range);
    set(kGeometricApproximation, &I::geometric_approximation);

    set(kMakeTexture, &I::make_request), set(kMakeShadow, &I::make_request), set(kMakeBump, &I::make_request);
    set(kMakeLatLongEnvironment, &I::make_request), set(kMakeCubeFaceEnvironment, &I::make_request);

    set(kAttribute, &I::attribute), set(kColor, &I::color), set(kOpacity, &I::opacity);
    set(kTextureCoordinates, &I::texture_coordinates);
    set(kLightSource, &I::light_source), set(kAreaLightSource, &I::light_source),
        set(kIlluminate, &I::illuminate);
    set(kSurface, &I::shader), set(kDisplacement, &I::shader), set(kAtmosphere, &I::shader);
    set(kInterior, &I::shader), set(kExterior, &I::shader);
    set(kShadingRate, &I::shading_rate), set(kShadingInterpolation, &I::shading_interpolation);
    set(kMatte, &I::matte), set(kOrientation, &I::orientation);
    set(kReverseOrientation, &I::reverse_orientation), set(kSides, &I::sides), set(kBasis, &I::basis);

    set(kIdentity, &I::identity), set(kTransform, &I::transform), set(kConcatTransform, &I::concat_transform);
    set(kPerspective, &I::perspective), set(kTranslate, &I::translate), set(kRotate, &I::rotate);
    set(kScale, &I::scale), set(kSkew, &I::skew), set(kCoordinateSystem, &I::coordinate_system);
    set(kScopedCoordinateSystem, &I::scoped_coordinate_system),
        set(kCoordSysTransform, &I::coord_sys_transform);

    for (RequestId r : {kSphere, kCone, kCylinder, kHyperboloid, kParaboloid, kDisk, kTorus})
      set(r, &I::quadric);
    set(kPolygon, &I::polygon), set(kPointsPolygons, &I::points_polygons), set(kPatch, &I::patch);
    set(kGeneralPolygon, &I::polygon), set(kPointsGeneralPolygons, &I::points_polygons);
    set(kPatchMesh, &I::patch), set(kGeometry, &I::geometry);
    set(kNuPatch, &I::nu_patch), set(kTrimCurve, &I::trim_curve);
    set(kSubdivisionMesh, &I::subdivision_mesh);
    set(kCurves, &I::curves), set(kPoints, &I::points);
    set(kBlobby, &I::blobby);
    return h;
  }();
  return kHandlers[static_cast<size_t>(id)];
}

void Interpreter::request(const RequestCall& call) {
  if (stopped(call) || in_unwanted_frame(call) || record(call) || skipped(call)) return;
  if (auto substituted = substitute(call))
    carry_out(*substituted);
  else
    carry_out(call);
}

void Interpreter::carry_out(const RequestCall& call) {
  const RequestInfo& info = call.info();
  if (!info.lacks.empty())
    warn_once(std::string(info.name), call.where, "rib-unsupported",
              fmt::format("{} is not supported yet: {}", info.name, info.lacks));
  if (!legal(call)) return;
  if (in_motion_ && call.id != RequestId::kMotionEnd)
    if (moved_by_motion_block(call)) return;
  if (!motion_.empty() && is_transformation(call.id))
    transform_request(call);
  else
    call_handler(call);
}

void Interpreter::call_handler(const RequestCall& call) {
  if ((is_primitive(call.id) || call.id == RequestId::kProcedural) && out_of_detail()) return;
  Handler h = handler(call.id);
  if (h && solid_.in_operation() && is_primitive(call.id))
    call_in_operation(call);
  else if (h)
    (this->*h)(call);
}

bool Interpreter::legal(const RequestCall& call) {
  const RequestInfo& info = call.info();
  if (in_world_ ? info.world : info.outside) return true;
  if (in_world_)
    error(call, "options cannot change inside a world block; the request is skipped", RiError::kNotOptions);
  else
    error(call, "this belongs between WorldBegin and WorldEnd; the request is skipped",
          is_primitive(call.id) ? RiError::kNotPrimitives : RiError::kIllegalState);
  return false;
}

void Interpreter::finish() {
  if (recording_.depth > 0)
    diagnostics_.error(recording_.where,
                       fmt::format("{} \"{}\" is not closed by {}", request_info(recording_.begin).name,
                                   recording_.name, request_info(recording_.end).name));
  for (const Block& b : blocks_)
    diagnostics_.error(b.where, "this block is not closed before the end of the file");
  if (unwanted_frame_)
    diagnostics_.error(*unwanted_frame_,
                       "this block, which is left out, is not closed before the end of the file");
  if (recording_.depth > 0 || !blocks_.empty()) error_kind_ = RiError::kNesting;
  if (in_world_) diagnostics_.error(blocks_.front().where, "nothing is rendered: WorldEnd is missing");
}

namespace {

/// Requests of later releases than the language here, and what the picture is without them.
std::string_view later_request(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kLater[] = {
      {"ShaderLayer", "shaders are not put together of layers; the last Surface, Displacement ... counts"},
      {"ConnectShaderLayers",
       "shaders are not put together of layers; the last Surface, Displacement ... counts"},
      {"Layer", "shaders are not put together of layers; the last Surface, Displacement ... counts"},
      {"Shader", "shaders that others call as objects are not known"},
      {"VPSurface", "volumes have the shaders of Interior, Exterior and Atmosphere"},
      {"VPInterior", "volumes have the shaders of Interior, Exterior and Atmosphere"},
      {"VPAtmosphere", "volumes have the shaders of Interior, Exterior and Atmosphere"},
      {"Volume", "there are no volumes as primitives"},
      {"Resource", "nothing is kept or brought back"},
      {"ResourceBegin", "nothing is kept or brought back"},
      {"ResourceEnd", "nothing is kept or brought back"},
      {"HierarchicalSubdivisionMesh", "the surface is not drawn; a SubdivisionMesh would be"},
      {"EditBegin", "pictures are rendered once"},
      {"EditEnd", "pictures are rendered once"},
      {"Camera", "there is one camera, that of the transformation before WorldBegin"},
      {"Bxdf", "materials are Surface shaders"},
      {"Pattern", "materials are Surface shaders"},
      {"Integrator", "light is what shaders compute"},
      {"MakeTextureV", "a texture is made by MakeTexture"},
      {"System", "scenes run no programs by themselves"}};
  for (const auto& [known, text] : kLater)
    if (known == name) return text;
  return {};
}

} // namespace

void Interpreter::unknown_request(std::string_view name, std::string_view suggestion,
                                  slvm::SourceRange where) {
  if (const std::string_view instead = later_request(name); !instead.empty()) {
    warn_once(fmt::format("unknown {}", name), where, "rib-unsupported",
              fmt::format("{} is of later releases and is skipped: {}", name, instead));
    return;
  }
  std::string hint = suggestion.empty() ? "" : fmt::format("; did you mean {}?", suggestion);
  warn_once(fmt::format("unknown {}", name), where, "rib-unknown",
            fmt::format("unknown request {}{}", name, hint));
}

void Interpreter::error(const RequestCall& call, std::string_view text, RiError kind) {
  error_at(call.where, call, text, kind);
}

void Interpreter::error_at(slvm::SourceRange where, const RequestCall& call, std::string_view text,
                           RiError kind) {
  if (error_handler_ == ErrorHandling::kIgnore) return;
  error_kind_ = kind;
  diagnostics_.error(where, fmt::format("{}: {}", call.info().name, text));
}

void Interpreter::warn(const RequestCall& call, std::string_view text) {
  warn_at(call.where, call, text);
}

void Interpreter::warn_at(slvm::SourceRange where, const RequestCall& call, std::string_view text) {
  if (error_handler_ == ErrorHandling::kIgnore) return;
  diagnostics_.warning(where, "rib", fmt::format("{}: {}", call.info().name, text));
}

void Interpreter::warn_once(std::string key, slvm::SourceRange where, std::string_view name,
                            std::string text) {
  if (error_handler_ == ErrorHandling::kIgnore) return;
  if (warned_.insert(std::move(key)).second) diagnostics_.warning(where, name, std::move(text));
}

void Interpreter::accept(const RequestCall&) {}

void Interpreter::error_handler(const RequestCall& call) {
  constexpr std::pair<std::string_view, ErrorHandling> kNames[] = {
      {"ignore", ErrorHandling::kIgnore}, {"print", ErrorHandling::kPrint}, {"abort", ErrorHandling::kAbort}};
  for (auto [name, value] : kNames)
    if (name == call.text(0)) {
      error_handler_ = value;
      return;
    }
  warn_at(call.arguments[0].where, call,
          fmt::format("unknown handler \"{}\"; known are ignore, print, abort", call.text(0)));
}

/// After an error under ErrorHandler "abort", and when archives have replayed more than anyone can want.
bool Interpreter::stopped(const RequestCall& call) {
  if (error_handler_ == ErrorHandling::kAbort && diagnostics_.has_errors() && !stopped_) {
    stopped_ = true;
    warn(call, "after an error ErrorHandler \"abort\" ends the scene here; the rest is not read");
  }
  if (depth_ > 0 && !stopped_ && ++replayed_ > most_replayed) {
    stopped_ = true;
    error(call,
          fmt::format("archives and instances have repeated more than {} requests; the rest is not read",
                      most_replayed));
  }
  return stopped_;
}

void Interpreter::declare(const RequestCall& call) {
  auto d = declarations_.declare(call.text(0), call.text(1));
  if (!d) error_at(call.arguments[1].where, call, d.error(), RiError::kSyntax);
}

void Interpreter::version(const RequestCall& call) {
  constexpr float kNewest = 3.045f;
  if (call.number(0) > kNewest)
    warn_once("version", call.where, "rib",
              fmt::format("RIB version {:g} is newer than 3.04; read as 3.04", call.number(0)));
}

} // namespace render
