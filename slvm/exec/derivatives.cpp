// Du, Dv, area, calculatenormal.
#include "slvm/exec/differences.h"

#include <algorithm>
#include <cmath>

namespace slvm {
namespace {

/// du or dv of the grid.
struct StepSize {
  StepSize(const ShaderRun& run, bool along_u) {
    const Planes& p = run.state.grid->variable(along_u ? Global::kdu : Global::kdv);
    planes = p;
    int n = along_u ? run.state.grid->nu() : run.state.grid->rows_of_piece();
    fallback = n > 1 ? 1.0f / static_cast<float>(n - 1) : 1.0f;
  }
  float at(size_t lane) const { return planes.data ? planes.data[planes.step ? lane : 0] : fallback; }
  Planes planes;
  float fallback;
};

void clear(const Operand& out, size_t components, size_t lanes) {
  for (size_t c = 0; c < components; ++c)
    std::fill_n(out.plane(c), out.step ? lanes : kMaxLanes, 0.0f);
}

/// Change of the operand's components per unit of u or v.
void derivative(const GridCall& call, bool along_u) {
  const Operand &out = call.operands[0].planes, &in = call.operands[1].planes;
  auto count = static_cast<size_t>(components(call.operands[0].type));
  if (!in.step || !out.step) return clear(out, count, call.run.pitch);
  StepSize step(call.run, along_u);
  Differences(call).for_each_run(along_u, [&](const Differences::Run& run) {
    auto scale = [&](size_t lane) { return 1.0f / (static_cast<float>(run.steps) * step.at(lane)); };
    const float same = run.steps ? scale(run.first) : 0.0f; // where the step is
    for (size_t c = 0; c < count; ++c) {
      float* to = out.plane(c) + run.first;
      const float *lo = in.plane(c) + run.lo, *hi = in.plane(c) + run.hi;
      if (run.steps == 0)
        std::fill_n(to, run.count, 0.0f);
      else if (!step.planes.step)
        for (size_t i = 0; i < run.count; ++i)
          to[i] = (hi[i] - lo[i]) * same;
      else
        for (size_t i = 0; i < run.count; ++i)
          to[i] = (hi[i] - lo[i]) * scale(run.first + i);
    }
  });
}

/// Change of a point over one step of the grid, in both directions.
struct ElementEdges {
  std::vector<float> u[3], v[3];

  ElementEdges(const GridCall& call, const Operand& p) {
    for (auto& plane : u)
      plane.assign(call.run.pitch, 0.0f);
    for (auto& plane : v)
      plane.assign(call.run.pitch, 0.0f);
    if (!p.step) return;
    Differences differences(call);
    auto take = [&](std::vector<float>* out, bool along_u) {
      differences.for_each_run(along_u, [&](const Differences::Run& run) {
        if (run.steps == 0) return;
        const float per_step = 1 / static_cast<float>(run.steps);
        for (size_t c = 0; c < 3; ++c) {
          float* to = out[c].data() + run.first;
          const float *lo = p.plane(c) + run.lo, *hi = p.plane(c) + run.hi;
          for (size_t i = 0; i < run.count; ++i)
            to[i] = (hi[i] - lo[i]) * per_step;
        }
      });
    };
    take(u, true);
    take(v, false);
  }

  void cross(size_t i, float out[3]) const {
    out[0] = u[1][i] * v[2][i] - u[2][i] * v[1][i];
    out[1] = u[2][i] * v[0][i] - u[0][i] * v[2][i];
    out[2] = u[0][i] * v[1][i] - u[1][i] * v[0][i];
  }
};

} // namespace

namespace grid_ops {

void derivative_u(const GridCall& call) {
  derivative(call, true);
}
void derivative_v(const GridCall& call) {
  derivative(call, false);
}

// |Du(p) du ^ Dv(p) dv|: the parallelogram of one element. Strategy "dicing" measures the same edges here:
// the grid's own; "shading" differs from it only for renderers that shade at other points than they dice.
void area(const GridCall& call) {
  const Operand& out = call.operands[0].planes;
  if (!out.step) return clear(out, 1, call.run.pitch);
  ElementEdges edges(call, call.operands[1].planes);
  for (size_t i = 0; i < call.run.points; ++i) {
    float n[3];
    edges.cross(i, n);
    out.data[i] = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
}

// Du(p) ^ Dv(p), turned so that it agrees with the orientation of the surface.
void calculate_normal(const GridCall& call) {
  const Operand& out = call.operands[0].planes;
  if (!out.step) return clear(out, 3, call.run.pitch);
  ElementEdges edges(call, call.operands[1].planes);
  StepSize du(call.run, true), dv(call.run, false);
  float sign = call.run.state.grid->flip_normals ? -1.0f : 1.0f;
  float *x = out.plane(0), *y = out.plane(1), *z = out.plane(2);
  for (size_t i = 0; i < call.run.points; ++i) {
    float n[3];
    edges.cross(i, n);
    float scale = sign / (du.at(i) * dv.at(i));
    x[i] = n[0] * scale;
    y[i] = n[1] * scale;
    z[i] = n[2] * scale;
  }
}

} // namespace grid_ops
} // namespace slvm
