// subsurface(): arguments become a SubsurfaceLookup, which the renderer answers.
#include "slvm/subsurface.h"

#include "slvm/exec/rays/call_tokens.h"
#include "slvm/exec/spaces.h"

#include <cmath>
#include <fmt/format.h>

namespace slvm {
namespace {

using Form = SubsurfaceLookup::Form;

class SubsurfaceCall {
public:
  explicit SubsurfaceCall(const GridCall& call)
      : call_(call), run_(call.run), out_(call.operands[0]),
        positional_(static_cast<size_t>(call.info.signature.param_count)), tokens_(call, 1 + positional_) {
    lookup_.points = out_.planes.step ? run_.points : 1;
    for (size_t c = 0; c < 3; ++c)
      lookup_.result[c] = out_.planes.plane(c);
    fill(run_, out_, 0);
  }

  void run() {
    lookup_.cloud = tokens_.text("filename");
    if (lookup_.cloud.empty())
      return complain("it needs a \"filename\", that of a cloud of points with light");
    if (!read_places() || !read_material()) return;
    uint64_t one_point = run_.mask.any();
    lookup_.mask = out_.planes.step ? run_.mask.current() : &one_point;
    SubsurfaceServices* services = run_.state.services.subsurface();
    if (!services) return complain("there is nobody here who looks up clouds of points");
    if (const std::string problem = services->subsurface(lookup_); !problem.empty()) complain(problem);
    if (!out_.planes.step)
      for (size_t c = 0; c < 3; ++c)
        std::fill_n(out_.planes.plane(c), kMaxLanes, *out_.planes.plane(c));
  }

private:
  void complain(std::string_view text) const {
    run_.report(call_.code, MessageSeverity::kWarning, fmt::format("{}: {}", call_.info.name, text),
                lookup_.points);
  }
  bool has(std::string_view token) const { return tokens_.has(token); }

  // ---- Where.

  /// P and N in the space of the cloud, "world" unless the call names another.
  bool read_places() {
    Matrix4 to_cloud = current_to_world(run_);
    if (const std::string_view space = tokens_.text("coordsystem");
        !space.empty() && !named_space(run_, space, false, to_cloud)) {
      complain(fmt::format("there is no space \"{}\", in which the cloud is to be", space));
      return false;
    }
    read_points(call_.operands[1].planes, to_cloud);
    lookup_.follow_topology = std::clamp(tokens_.number("followtopology", 0), 0.0f, 1.0f);
    if (lookup_.follow_topology == 0) return true;
    Matrix4 back;
    if (positional_ < 2) complain("\"followtopology\" needs a normal: subsurface(P, N, ...)");
    if (positional_ >= 2 && invert(to_cloud, back))
      read_normals(call_.operands[2].planes, back);
    else
      lookup_.follow_topology = 0;
    return true;
  }

  void read_points(const Operand& p, const Matrix4& m) {
    for (std::vector<float>& component : lookup_.position)
      component.resize(lookup_.points);
    for (size_t i = 0; i < lookup_.points; ++i)
      put_triple(lookup_.position, i, transform_point(m, triple(p, i)));
  }

  /// Normals go by the transpose of the way back.
  void read_normals(const Operand& n, const Matrix4& back) {
    Matrix4 transposed;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        transposed(i, j) = back(j, i);
    for (std::vector<float>& component : lookup_.normal)
      component.resize(lookup_.points);
    for (size_t i = 0; i < lookup_.points; ++i)
      put_triple(lookup_.normal, i, transform_vector(transposed, triple(n, i)));
  }

  static std::array<float, 3> triple(const Operand& o, size_t i) {
    const size_t at = o.step ? i : 0;
    return {o.plane(0)[at], o.plane(1)[at], o.plane(2)[at]};
  }
  static void put_triple(std::vector<float> (&to)[3], size_t i, std::array<float, 3> value) {
    for (size_t c = 0; c < 3; ++c)
      to[c][i] = value[c];
  }

  // ---- Of what.

  /// False, with a message: the call contradicts itself, or says what cannot be.
  bool read_material() {
    if (!choose_form()) return false;
    lookup_.eta = tokens_.number("ior", 0);
    if (has("ior") && !(lookup_.eta > 0)) return bad_number("ior", lookup_.eta);
    lookup_.millimetres = tokens_.number("unitlength", 1);
    if (!(lookup_.millimetres > 0)) return bad_number("unitlength", lookup_.millimetres);
    if (has("scale")) {
      const float scale = tokens_.number("scale", 1);
      if (!(scale > 0)) return bad_number("scale", scale);
      lookup_.millimetres /= scale;
    }
    if (has("maxsolidangle")) {
      lookup_.max_solid_angle = tokens_.number("maxsolidangle", 0);
      if (!(lookup_.max_solid_angle >= 0)) return bad_number("maxsolidangle", lookup_.max_solid_angle);
    }
    lookup_.smooth = tokens_.number("smooth", 0) != 0;
    return true;
  }

  bool choose_form() {
    const bool named = has("material"), coefficients = has("scattering") || has("absorption"),
               appearance = has("albedo") || has("diffusemeanfreepath");
    if (named + coefficients + appearance > 1) {
      complain("the material is said in several ways: take one of \"material\", \"scattering\" with "
               "\"absorption\", \"albedo\" with \"diffusemeanfreepath\"");
      return false;
    }
    if (coefficients) {
      lookup_.form = Form::kCoefficients;
      return read_pair("scattering", "absorption");
    }
    if (!appearance) {
      lookup_.material = tokens_.text("material");
      return true;
    }
    if (has("albedo")) {
      lookup_.form = Form::kAppearance;
      return read_pair("albedo", "diffusemeanfreepath");
    }
    lookup_.form = Form::kOfPoints;
    return read_colour("diffusemeanfreepath", lookup_.second);
  }

  /// Two colours, of which neither is anything without the other.
  bool read_pair(const char* first, const char* second) {
    for (const auto& [name, other] : {std::pair(first, second), std::pair(second, first)})
      if (!has(name)) {
        complain(fmt::format("\"{}\" needs \"{}\" with it", other, name));
        return false;
      }
    return read_colour(first, lookup_.first) && read_colour(second, lookup_.second);
  }

  bool read_colour(const char* name, SubsurfaceLookup::Numbers (&to)[3]) {
    const GridOperand* o = tokens_.find(name);
    if (!o || o->array || components(o->type) != 3) {
      complain(fmt::format("\"{}\" takes a color", name));
      return false;
    }
    for (size_t c = 0; c < 3; ++c) {
      to[c].resize(o->planes.step ? lookup_.points : 1);
      for (size_t i = 0; i < to[c].size(); ++i)
        to[c][i] = o->planes.plane(c)[o->planes.step ? i : 0];
    }
    return true;
  }

  bool bad_number(const char* name, float value) const {
    complain(fmt::format("\"{}\" is {}, it must be {}", name, value,
                         std::string_view(name) == "maxsolidangle" ? "0 or more" : "above 0"));
    return false;
  }

  const GridCall& call_;
  const ShaderRun& run_;
  const GridOperand& out_;
  size_t positional_;
  CallTokens tokens_;
  SubsurfaceLookup lookup_;
};

} // namespace

namespace grid_ops {

// Operands: result, P, N (not in the form without), token-value pairs.
void subsurface_lookup(const GridCall& call) {
  SubsurfaceCall(call).run();
}

} // namespace grid_ops
} // namespace slvm
