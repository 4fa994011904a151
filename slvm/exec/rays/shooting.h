// Small things that all who shoot rays need: who traces them, which kind they are, what attributes say.
#pragma once

#include "slvm/exec/rays/call_tokens.h"

namespace slvm {

/// Who traces rays; null, with a run-time message for so many points, where nobody does.
RayServices* ray_services(const ShaderRun& run, uint32_t code, size_t points);
/// Whether all rays are known to meet nothing.
bool meet_nothing(const ShaderRun& run);
/// Rays in narrow cones are specular, in wide ones diffuse: option trace:specularthreshold, in degrees.
RayKind kind_for_cone(const ShaderRun& run, const PointValue& angle);
/// Where samples are several, each has a part of the element of its own.
float default_sample_base(const ShaderRun& run, const PointValue& samples);
/// Attribute trace:bias.
float bias_attribute(const ShaderRun& run);

} // namespace slvm
