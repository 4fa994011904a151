// photonmap(): arguments become a PhotonLookup, which the renderer answers.
#include "slvm/photon_map.h"

#include "slvm/exec/rays/call_tokens.h"
#include "slvm/exec/spaces.h"

#include <cmath>
#include <fmt/format.h>

namespace slvm {
namespace {

std::array<float, 3> triple(const Operand& o, size_t i) {
  const size_t at = o.step ? i : 0;
  return {o.plane(0)[at], o.plane(1)[at], o.plane(2)[at]};
}

/// f(point) as planes, for active points.
template <class F> void read_triples(const ShaderRun& run, std::vector<float> (&to)[3], F&& f) {
  for (std::vector<float>& component : to)
    component.resize(run.points);
  mask_for_each(run.mask.current(), run.points, [&](size_t i) {
    const std::array<float, 3> value = f(i);
    for (size_t c = 0; c < 3; ++c)
      to[c][i] = value[c];
  });
}

/// "" or what is wrong with the call.
std::string look_up(const GridCall& call, const CallTokens& tokens, size_t arguments, PhotonLookup& lookup) {
  const ShaderRun& run = call.run;
  PhotonMapServices* services = run.state.services.photon_maps();
  if (!services) return "there is nobody here who keeps photon maps";
  const std::string_view type = tokens.text("lookuptype");
  if (!type.empty() && type != "irradiance" && type != "radiance")
    return fmt::format("\"lookuptype\" is \"irradiance\" or \"radiance\", not \"{}\"", type);
  lookup.radiance = type == "radiance";
  lookup.photons = sample_count(tokens.number("estimator", 50));
  lookup.min_depth = tokens.number("mindepth", 0);
  lookup.max_distance = tokens.number("maxdist", lookup.max_distance);
  const Matrix4 to_world = current_to_world(run);
  read_triples(run, lookup.position,
               [&](size_t i) { return transform_point(to_world, triple(call.operands[2].planes, i)); });
  if (arguments > 2)
    read_triples(run, lookup.normal, [&](size_t i) {
      std::array<float, 3> n = transform_normal(to_world, triple(call.operands[3].planes, i));
      const float length = std::hypot(n[0], n[1], n[2]);
      for (float& x : n)
        x = length > 0 ? x / length : 0;
      return n;
    });
  return services->photon_map(lookup);
}

} // namespace

namespace grid_ops {

// Operands: result, file, P, N (not in the form without), token-value pairs.
void photon_map(const GridCall& call) {
  const ShaderRun& run = call.run;
  const auto arguments = static_cast<size_t>(call.info.signature.param_count);
  const CallTokens tokens(call, 1 + arguments);
  std::vector<float> result(3 * run.points);
  PhotonLookup lookup;
  lookup.file = text_of(run, call.operands[1].planes);
  lookup.points = run.points;
  lookup.mask = run.mask.current();
  for (size_t c = 0; c < 3; ++c)
    lookup.result[c] = result.data() + c * run.points;
  const std::string problem =
      lookup.file.empty() ? "it needs the name of a file" : look_up(call, tokens, arguments, lookup);
  if (!problem.empty())
    run.report(call.code, MessageSeverity::kWarning, fmt::format("{}: {}", call.info.name, problem),
               mask_count(run.mask.current(), run.points));
  store_planes(run, call.operands[0], result);
}

} // namespace grid_ops
} // namespace slvm
