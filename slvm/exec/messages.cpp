// Message passing and queries: values of other shaders' parameters, of attributes, options and the renderer.
#include "slvm/exec/query.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace slvm {
namespace {

/// The parameter asked for, or null where `other` has none that the variable can take.
const Planes* parameter_for(const Query& q, const ShaderRun* other) {
  const Planes* p = other ? other->parameter(q.name) : nullptr;
  bool fits = p && p->type == q.out.type && p->elements == q.elements() &&
              (q.out.planes.step || !p->step); // a uniform variable takes a uniform value
  return fits ? p : nullptr;
}

void message(const GridCall& call, const ShaderRun* other) {
  Query q(call);
  const Planes* p = parameter_for(q, other);
  if (!p) return q.not_found();
  q.give({p->data, p->pitch, p->step, std::max(p->elements, 1u)});
}

// Points that are seen from inside have the interior on the viewer's side, others the exterior. Each takes
// the value of its own volume; the result is 1 when one of them finds it. What is uniform follows the first
// point.
void volume_message(const GridCall& call, bool on_viewers_side) {
  Query q(call);
  ShaderRun& run = call.run;
  const Planes incident = run.variable(Global::kI), normal = run.variable(Global::kNg);
  auto seen_from_inside = [&](size_t point) {
    float cosine = 0;
    for (size_t c = 0; c < 3; ++c)
      cosine += incident.get(c, point) * normal.get(c, point);
    return cosine > 0;
  };
  const Planes *interior = parameter_for(q, run.state.interior),
               *exterior = parameter_for(q, run.state.exterior);
  q.not_found(); // points without keep what they had
  bool found = false;
  auto take = [&](size_t point, size_t lanes) {
    const Planes* p = seen_from_inside(point) == on_viewers_side ? interior : exterior;
    if (!p) return;
    found = true;
    for (size_t i = 0; i < q.planes(); ++i)
      std::fill_n(q.out.planes.plane(i) + (lanes > 1 ? 0 : point), lanes, p->get(i, point));
  };
  if (!q.out.planes.step)
    take(0, kMaxLanes);
  else
    mask_for_each(run.mask.current(), run.points, [&](size_t point) { take(point, 1); });
  q.result(found);
}

using Source = bool (RendererServices::*)(const ShadingState&, std::string_view, Value&);

void query(const GridCall& call, Source source) {
  Query q(call);
  Value value;
  if ((q.run.state.services.*source)(q.run.shading_state(), q.name, value))
    q.give(value);
  else
    q.not_found();
}

} // namespace

namespace grid_ops {

// In a light these mean the shaders of the surface being lit.
void surface_message(const GridCall& call) {
  const GridState& state = call.run.state;
  message(call, call.run.outer ? call.run.outer : state.surface);
}
void displacement_message(const GridCall& call) {
  message(call, call.run.state.displacement);
}
void atmosphere_message(const GridCall& call) {
  message(call, call.run.state.atmosphere);
}
void incident_message(const GridCall& call) {
  volume_message(call, true);
}
void opposite_message(const GridCall& call) {
  volume_message(call, false);
}
void lightsource_message(const GridCall& call) {
  const LitGrid* light = call.run.light_loop.current();
  message(call, light ? light->run.get() : nullptr);
}

void attribute_query(const GridCall& call) {
  query(call, &RendererServices::attribute);
}
void option_query(const GridCall& call) {
  query(call, &RendererServices::option);
}
void renderer_query(const GridCall& call) {
  query(call, &RendererServices::renderer_info);
}

void ray_query(const GridCall& call) {
  Query q(call);
  const RayFacts& ray = q.run.state.grid->ray;
  StringPool& strings = q.run.state.machine.strings();
  auto uniform = [&](Type type, float value) {
    if (q.out.type != type || q.out.array) return q.wrong_type(type);
    std::fill_n(q.out.planes.data, q.out.planes.step ? q.run.pitch : kMaxLanes, value);
    q.result(true);
  };
  auto number = [&](float value) { uniform(Type::kFloat, value); };
  auto text = [&](const std::string& value) {
    uniform(Type::kString, std::bit_cast<float>(strings.intern(value)));
  };
  // `at(incident ray, its length, component)` at each point; a uniform variable cannot hold it.
  auto varying = [&](Type type, auto&& at) {
    if (q.out.array || components(q.out.type) != components(type)) return q.wrong_type(type);
    if (!q.out.planes.step) return q.not_found();
    const Grid& grid = *q.run.state.grid;
    // The eye is at the origin: where the renderer gives no I, it is P.
    const Planes& incident = grid.variable(grid.variable(Global::kI).data ? Global::kI : Global::kP);
    for (size_t i = 0; i < q.run.points; ++i) {
      std::array<float, 3> ray_to{};
      for (size_t c = 0; c < 3 && incident.data; ++c)
        ray_to[c] = incident.get(c, i);
      float length = std::sqrt(ray_to[0] * ray_to[0] + ray_to[1] * ray_to[1] + ray_to[2] * ray_to[2]);
      for (size_t c = 0; c < q.planes(); ++c)
        q.out.planes.plane(c)[i] = at(ray_to, length, c, i);
    }
    q.result(true);
  };
  const Planes& p = q.run.state.grid->variable(Global::kP);
  if (q.name == "type") return text(ray.type);
  if (q.name == "label") return text(ray.label);
  if (q.name == "depth") return number(ray.depth);
  if (q.name == "speculardepth") return number(ray.specular_depth);
  if (q.name == "diffusedepth") return number(ray.diffuse_depth);
  if (q.name == "shadowdepth") return number(ray.shadow_depth);
  if (q.name == "weight" || q.name == "importance") {
    auto weight = [&](size_t c, size_t i) { return ray.weight[c] ? ray.weight[c][i] : 1.0f; };
    if (q.out.type == Type::kFloat) // of all colours
      return varying(Type::kFloat, [&](const auto&, float, size_t, size_t i) {
        return (weight(0, i) + weight(1, i) + weight(2, i)) / 3;
      });
    return varying(Type::kColor, [&](const auto&, float, size_t c, size_t i) { return weight(c, i); });
  }
  if (q.name == "length")
    return varying(Type::kFloat, [](const auto&, float length, size_t, size_t) { return length; });
  if (q.name == "direction")
    return varying(Type::kVector, [](const auto& to, float length, size_t c, size_t) {
      return length > 0 ? to[c] / length : 0.0f;
    });
  if (q.name == "origin")
    return varying(Type::kPoint, [&](const auto& to, float, size_t c, size_t i) {
      return (p.data ? p.get(c, i) : 0.0f) - to[c];
    });
  q.not_found();
}

void shader_name(const GridCall& call) {
  const ShaderSet& set = *call.run.state.shaders;
  const Instance* shader = &call.run.instance;
  StringPool& strings = call.run.state.machine.strings();
  if (call.operands.size() > 1) {
    std::string_view kind = strings.text(std::bit_cast<uint32_t>(*call.operands[1].planes.data));
    shader = kind == "surface"                                        ? set.surface
             : kind == "displacement"                                 ? set.displacement
             : kind == "atmosphere"                                   ? set.atmosphere
             : kind == "interior"                                     ? set.interior
             : kind == "exterior"                                     ? set.exterior
             : kind == "lightsource" && call.run.light_loop.current() ? call.run.light_loop.current()->light
                                                                      : nullptr;
  }
  uint32_t id = strings.intern(shader ? shader->shader().name() : "");
  std::fill_n(call.operands[0].planes.data, kMaxLanes, std::bit_cast<float>(id));
}

} // namespace grid_ops
} // namespace slvm
