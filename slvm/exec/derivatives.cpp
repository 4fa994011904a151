// Differences over the grid: Du, Dv, area, calculatenormal.
//
// Inside, differences are centred; where only one neighbour holds a value (the edges of the grid, lanes
// beside others that have none) one-sided; 0 where none does, and for all of a grid without extent in that
// direction. RISpec 3.2 leaves the scheme open; this is PRMan's default ("derivatives" "centered" 1).
#include "slvm/exec/run.h"

#include <algorithm>
#include <cmath>

namespace slvm {
namespace {

/// How one lane takes its difference: value[hi] - value[lo], over this many steps of the grid. hi == lo: no
/// neighbour.
struct Neighbours {
  size_t lo, hi;
};

class Differences {
public:
  Differences(const GridCall& call)
      : grid_(*call.run.state.grid), valid_(call.run.mask.at_level(call.level)),
        everywhere_(call.level == 0) {}

  /// Calls store(lane, lo, hi) for every point. along_u: neighbours in the row, else in the column.
  template <class F> void for_each(bool along_u, F&& store) const {
    int nu = grid_.nu(), nv = grid_.nv();
    int n = along_u ? nu : nv;
    size_t stride = along_u ? 1 : static_cast<size_t>(nu);
    for (int iv = 0; iv < nv; ++iv)
      for (int iu = 0; iu < nu; ++iu) {
        size_t lane = static_cast<size_t>(iv) * static_cast<size_t>(nu) + static_cast<size_t>(iu);
        int at = along_u ? iu : iv;
        size_t lo = lane, hi = lane;
        if (grid_.derivatives) {
          if (at > 0 && holds(lane - stride)) lo = lane - stride;
          if (at + 1 < n && holds(lane + stride)) hi = lane + stride;
        }
        store(lane, lo, hi, (hi - lo) / stride);
      }
  }

private:
  bool holds(size_t lane) const { return everywhere_ || mask_test(valid_, lane); }

  const Grid& grid_;
  const MaskWord* valid_;
  bool everywhere_;
};

/// du or dv of the grid.
struct StepSize {
  StepSize(const ShaderRun& run, bool along_u) {
    const Planes& p = run.state.grid->variable(along_u ? Global::kdu : Global::kdv);
    planes = p;
    int n = along_u ? run.state.grid->nu() : run.state.grid->nv();
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
  Differences(call).for_each(along_u, [&](size_t lane, size_t lo, size_t hi, size_t steps) {
    float scale = steps ? 1.0f / (static_cast<float>(steps) * step.at(lane)) : 0.0f;
    for (size_t c = 0; c < count; ++c)
      out.plane(c)[lane] = steps ? (in.plane(c)[hi] - in.plane(c)[lo]) * scale : 0.0f;
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
      differences.for_each(along_u, [&](size_t lane, size_t lo, size_t hi, size_t steps) {
        for (size_t c = 0; c < 3; ++c)
          out[c][lane] = steps ? (p.plane(c)[hi] - p.plane(c)[lo]) / static_cast<float>(steps) : 0.0f;
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
  for (size_t i = 0; i < call.run.points; ++i) {
    float n[3];
    edges.cross(i, n);
    float scale = sign / (du.at(i) * dv.at(i));
    for (size_t c = 0; c < 3; ++c)
      out.plane(c)[i] = n[c] * scale;
  }
}

} // namespace grid_ops
} // namespace slvm
