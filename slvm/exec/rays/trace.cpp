// trace(), visibility(), rayhittest(), fulltrace() and environment("raytrace"): the nearest surface along
// rays, as a mean over the rays of each point.
#include "slvm/exec/rays/ray_means.h"
#include "slvm/exec/rays/shooting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slvm {
namespace {

constexpr float kFar = 1e30f; ///< the distance of nothing

RaySpec spec_of(const GridCall& call, const CallTokens& tokens, const Operand& origin,
                const Operand& direction) {
  RaySpec spec;
  spec.origin = origin;
  spec.direction = direction;
  spec.angle = tokens.values("samplecone", 0);
  spec.samples = tokens.number("samples", 1);
  spec.bias = tokens.values("bias", -1);
  spec.max_distance = tokens.values("maxdist", std::numeric_limits<float>::infinity());
  spec.sample_base = tokens.values("samplebase", default_sample_base(call.run, spec.samples));
  spec.weight = tokens.weight();
  spec.differentials = true;
  return spec;
}

/// What one batch of rays brought.
struct Hits {
  std::vector<float> distance, colour, normal; ///< triples by component
  bool hit(size_t r) const {
    return distance[r] >= 0 && distance[r] < std::numeric_limits<float>::infinity();
  }
};

/// Shoots all rays of a source: f(rays, hits) for each batch.
class Tracer {
public:
  Tracer(const GridCall& call, const RaySpec& spec, const RayOptions& options)
      : call_(call), options_(options) {
    if (!meet_nothing(call.run)) source.begin(call, spec, options.seed);
  }

  template <class F> void run(bool wants_normal, F&& f) {
    if (source.size() == 0) return;
    RayServices* services = ray_services(call_.run, call_.code, source.size());
    for_each_batch(source, [&](const RayBuffer& rays) {
      const size_t count = rays.size();
      hits_.distance.assign(count, std::numeric_limits<float>::infinity());
      hits_.colour.assign(options_.shades ? 3 * count : 0, 0.0f);
      hits_.normal.assign(wants_normal ? 3 * count : 0, 0.0f);
      found_.assign(2 * count, 0);
      std::vector<RayOutput> outputs;
      if (options_.shades)
        outputs.push_back(
            {RayOutput::From::kShaded, "Ci", Type::kColor, 0, hits_.colour.data(), count, found_.data()});
      if (wants_normal)
        outputs.push_back({RayOutput::From::kPrimitive, "N", Type::kNormal, 0, hits_.normal.data(), count,
                           found_.data() + count});
      if (services && count)
        services->trace(call_.run.shading_state(), options_, rays.batch(), outputs, hits_.distance.data(),
                        nullptr);
      f(rays, hits_);
    });
  }

  RaySource source; ///< empty where no ray would meet anything

private:
  const GridCall& call_;
  RayOptions options_;
  Hits hits_;
  std::vector<uint8_t> found_;
};

/// Mean colour of what is seen along the rays; nothing is black.
void add_colours(Tracer& tracer, RayMeans& means) {
  tracer.run(false, [&](const RayBuffer& rays, const Hits& hits) {
    for (size_t r = 0; r < rays.size(); ++r)
      for (size_t c = 0; c < 3 && hits.hit(r); ++c)
        means.add(rays.place(r), c, hits.colour[c * rays.size() + r]);
  });
}

} // namespace

// A surface behind a mirror of four corners: the middle ray, in a cone that holds the corners.
void trace_environment(const GridCall& call) {
  const ShaderRun& run = call.run;
  const size_t corners = call.info.signature.param_count - 2u, points = run.pitch;
  const CallTokens tokens(call, 3 + corners);
  Operand direction = call.operands[3].planes;
  std::vector<float> mean, half_angle;
  if (corners == 4) {
    mean.resize(3 * points);
    half_angle.resize(points);
    direction = {mean.data(), points, 1, 1};
    mask_for_each(run.mask.current(), run.points, [&](size_t i) {
      half_angle[i] = cone_of_corners(std::span(call.operands).subspan(3, 4), i, mean.data() + i, points);
    });
  }
  const Planes& p = call.run.variable(Global::kP);
  RaySpec spec = spec_of(call, tokens, {p.data, p.pitch, p.step, 1}, direction);
  const PointValue cone = spec.angle, blur = tokens.values("blur", 0);
  std::vector<float> angle(points);
  mask_for_each(run.mask.current(), run.points, [&](size_t i) {
    angle[i] = cone.at(i) + std::numbers::pi_v<float> * blur.at(i) + (corners == 4 ? half_angle[i] : 0.0f);
  });
  spec.angle = PointValue(Operand{angle.data(), points, 1, 1});
  spec.differentials = corners == 1; // the cone is as wide as the four
  Tracer tracer(call, spec, tokens.ray_options(RayKind::kSpecular));
  RayMeans means(tracer.source, 3);
  add_colours(tracer, means);
  const GridOperand& out = call.operands[0];
  const float first = *call.operands[2].planes.data, missing = tokens.number("fill", 0);
  fill(run, out, 0);
  for (size_t c = 0; c < static_cast<size_t>(components(out.type)); ++c) {
    const float channel = first + static_cast<float>(c);
    if (channel >= 0 && channel < 3)
      for (size_t i = 0; i < tracer.source.size(); ++i)
        put(out.planes, c, tracer.source.point[i], means.mean(i, static_cast<size_t>(channel)));
    else
      mask_for_each(run.mask.current(), run.points, [&](size_t i) { put(out.planes, c, i, missing); });
  }
}

namespace grid_ops {

// Operands: result, P, R, pairs.
void trace_colour(const GridCall& call) {
  const CallTokens tokens(call, 3);
  Tracer tracer(call, spec_of(call, tokens, call.operands[1].planes, call.operands[2].planes),
                tokens.ray_options(RayKind::kSpecular));
  RayMeans means(tracer.source, 3);
  add_colours(tracer, means);
  fill(call.run, call.operands[0], 0);
  for (size_t i = 0; i < tracer.source.size(); ++i)
    for (size_t c = 0; c < 3; ++c)
      put(call.operands[0].planes, c, tracer.source.point[i], means.mean(i, c));
}

// The mean of the rays that hit.
void trace_distance(const GridCall& call) {
  const CallTokens tokens(call, 3);
  RayOptions options = tokens.ray_options(RayKind::kSpecular);
  options.shades = false;
  RaySpec spec = spec_of(call, tokens, call.operands[1].planes, call.operands[2].planes);
  spec.differentials = false;
  Tracer tracer(call, spec, options);
  RayMeans means(tracer.source, 2); // distances, hits
  tracer.run(false, [&](const RayBuffer& rays, const Hits& hits) {
    for (size_t r = 0; r < rays.size(); ++r) {
      if (!hits.hit(r)) continue;
      means.add(rays.place(r), 0, hits.distance[r]);
      means.add(rays.place(r), 1, 1);
    }
  });
  fill(call.run, call.operands[0], kFar);
  for (size_t i = 0; i < tracer.source.size(); ++i)
    if (means.sum(i, 1) > 0)
      put(call.operands[0].planes, 0, tracer.source.point[i],
          static_cast<float>(means.sum(i, 0) / means.sum(i, 1)));
}

// Operands: result, a, b.
void visibility(const GridCall& call) {
  RaySpec spec;
  spec.origin = call.operands[1].planes;
  spec.direction = call.operands[2].planes;
  spec.to_target = true;
  RayOptions options;
  options.kind = RayKind::kTransmission;
  options.shades = false;
  Tracer tracer(call, spec, options);
  fill(call.run, call.operands[0], 1);
  tracer.run(false, [&](const RayBuffer& rays, const Hits& hits) {
    for (size_t r = 0; r < rays.size(); ++r)
      for (size_t c = 0; c < static_cast<size_t>(components(call.operands[0].type)) && hits.hit(r); ++c)
        put(call.operands[0].planes, c, rays.point(r), 0);
  });
}

// Operands: distance, Ph, Nh; P, R. Where nothing is hit Ph is P and Nh 0.
void ray_hit_test(const GridCall& call) {
  const GridOperand *out = call.operands.data(), &p = call.operands[3];
  RaySpec spec;
  spec.origin = p.planes;
  spec.direction = call.operands[4].planes;
  RayOptions options;
  options.shades = false;
  Tracer tracer(call, spec, options);
  fill(call.run, out[2], 0);
  mask_for_each(call.run.mask.current(), call.run.points, [&](size_t point) {
    for (size_t c = 0; c < 3; ++c)
      put(out[1].planes, c, point, p.planes.plane(c)[p.planes.step ? point : 0]);
  });
  fill(call.run, out[0], kFar);
  tracer.run(true, [&](const RayBuffer& rays, const Hits& hits) {
    for (size_t r = 0; r < rays.size(); ++r) {
      if (!hits.hit(r)) continue;
      put(out[0].planes, 0, rays.point(r), hits.distance[r]);
      for (size_t c = 0; c < 3; ++c) {
        put(out[1].planes, c, rays.point(r), rays.origin(c, r) + hits.distance[r] * rays.direction(c, r));
        put(out[2].planes, c, rays.point(r), hits.normal[c * rays.size() + r]);
      }
    }
  });
}

// Operands: distance, hitcolor, hitdist, Phit, Nhit, Pmiss, Rmiss; P, R. Of a ray that hits Rmiss is 0.
void full_trace(const GridCall& call) {
  const GridOperand *out = call.operands.data(), &p = call.operands[7];
  RaySpec spec;
  spec.origin = p.planes;
  spec.direction = call.operands[8].planes;
  spec.differentials = true;
  Tracer tracer(call, spec, {});
  for (size_t i : {0, 2})
    fill(call.run, out[i], kFar);
  for (size_t i : {1, 4, 6})
    fill(call.run, out[i], 0);
  for (size_t i = 0; i < tracer.source.size(); ++i)
    for (size_t c = 0; c < 3; ++c) {
      const size_t point = tracer.source.point[i];
      put(out[3].planes, c, point, tracer.source.origin[c][i]);
      put(out[5].planes, c, point, tracer.source.origin[c][i]);
      put(out[6].planes, c, point, tracer.source.axis[c][i]);
    }
  tracer.run(true, [&](const RayBuffer& rays, const Hits& hits) {
    for (size_t r = 0; r < rays.size(); ++r) {
      if (!hits.hit(r)) continue;
      for (size_t i : {0, 2})
        put(out[i].planes, 0, rays.point(r), hits.distance[r]);
      for (size_t c = 0; c < 3; ++c) {
        put(out[1].planes, c, rays.point(r), hits.colour[c * rays.size() + r]);
        put(out[3].planes, c, rays.point(r), rays.origin(c, r) + hits.distance[r] * rays.direction(c, r));
        put(out[4].planes, c, rays.point(r), hits.normal[c * rays.size() + r]);
        put(out[6].planes, c, rays.point(r), 0);
      }
    }
  });
}

} // namespace grid_ops
} // namespace slvm
