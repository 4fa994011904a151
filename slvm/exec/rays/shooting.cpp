// What all who shoot rays need.
#include "slvm/exec/rays/shooting.h"

#include <algorithm>
#include <numbers>

namespace slvm {
namespace {

float greatest(const ShaderRun& run, const PointValue& value) {
  float most = 0;
  mask_for_each(run.mask.current(), run.points,
                [&](size_t point) { most = std::max(most, value.at(point)); });
  return most;
}

bool is_number(const Value& value) {
  return value.type == Type::kFloat && value.numbers.size() == 1;
}

} // namespace

RayServices* ray_services(const ShaderRun& run, uint32_t code, size_t points) {
  RayServices* services = run.state.services.rays();
  if (!services && points)
    run.report(code, MessageSeverity::kWarning, "nobody traces rays here: they hit nothing", points);
  return services;
}

bool meet_nothing(const ShaderRun& run) {
  RayServices* services = run.state.services.rays();
  return services && services->is_empty();
}

RayKind kind_for_cone(const ShaderRun& run, const PointValue& angle) {
  float threshold = 10;
  Value value;
  if (run.state.services.option(run.shading_state(), "trace:specularthreshold", value) && is_number(value))
    threshold = value.numbers[0];
  return greatest(run, angle) < threshold * (std::numbers::pi_v<float> / 180) ? RayKind::kSpecular
                                                                              : RayKind::kDiffuse;
}

float default_sample_base(const ShaderRun& run, const PointValue& samples) {
  // What a diffuse ray covers is wider than surfaces are flat: rays would begin beside them, behind walls.
  if (run.state.grid->ray.type == "diffuse") return 0;
  return greatest(run, samples) >= 1.5f ? 1.0f : 0.0f;
}

float bias_attribute(const ShaderRun& run) {
  constexpr float kDefault = 0.01f;
  Value value;
  const bool given =
      run.state.services.attribute(run.shading_state(), "trace:bias", value) && is_number(value);
  return given ? value.numbers[0] : kDefault;
}

} // namespace slvm
