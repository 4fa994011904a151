// Matrices between named coordinate systems, and the table of grid ops.
#include "slvm/exec/spaces.h"

#include "slvm/exec/run.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace slvm {

bool named_space(const ShaderRun& run, std::string_view space, bool forward, Matrix4& m) {
  auto known = [&](const Matrix4& to_current) {
    if (forward)
      m = to_current;
    else
      invert(to_current, m); // singular: all zeros
    return true;
  };
  if (space == "current" || space.empty()) return known(Matrix4{});
  if (space == "shader") {
    m = forward ? run.instance.shader_to_current() : run.instance.current_to_shader();
    return true;
  }
  if (space == "object") return known(run.state.grid->object_to_current);
  ShadingState state = run.shading_state();
  return forward ? run.state.services.space_to_current(state, space, m)
                 : run.state.services.current_to_space(state, space, m);
}

Matrix4 current_to_world(const ShaderRun& run) {
  Matrix4 m;
  run.state.services.current_to_space(run.shading_state(), "world", m);
  return m;
}

namespace {

std::string_view text_of(const GridCall& call, size_t operand) {
  return call.run.state.machine.strings().text(std::bit_cast<uint32_t>(*call.operands[operand].planes.data));
}

// The matrix from the space named by operand 1 to that named by operand 2. An unknown space counts as
// "current".
Matrix4 matrix_between(const GridCall& call) {
  Matrix4 total;
  for (size_t i : {1u, 2u}) {
    std::string_view name = text_of(call, i);
    Matrix4 m;
    if (named_space(call.run, name, i == 1, m))
      total = total * m;
    else
      call.run.report(call.code, MessageSeverity::kError,
                      fmt::format("unknown coordinate system \"{}\"", name), call.run.points);
  }
  return total;
}

} // namespace

namespace grid_ops {

void space_matrix(const GridCall& call) {
  Matrix4 m = matrix_between(call);
  for (size_t i = 0; i < 16; ++i)
    std::fill_n(call.operands[0].planes.plane(i), kMaxLanes, m.m[i]);
}

// The image of v at P, for spaces with perspective: image of P + v less image of P.
void project_vector(const GridCall& call) {
  const Operand &out = call.operands[0].planes, &v = call.operands[3].planes;
  const Planes& p = call.run.state.grid->variable(Global::kP);
  Matrix4 m = matrix_between(call), to_from;
  named_space(call.run, text_of(call, 1), false, to_from);
  size_t points = out.step ? call.run.points : 1;
  for (size_t i = 0; i < points; ++i) {
    std::array<float, 3> at{}, tip;
    for (size_t c = 0; c < 3; ++c)
      at[c] = p.data ? p.get(c, i) : 0.0f;
    at = transform_point(to_from, at);
    for (size_t c = 0; c < 3; ++c)
      tip[c] = at[c] + v.plane(c)[v.step * i];
    at = transform_point(m, at);
    tip = transform_point(m, tip);
    for (size_t c = 0; c < 3; ++c) {
      if (out.step)
        out.plane(c)[i] = tip[c] - at[c];
      else
        std::fill_n(out.plane(c), kMaxLanes, tip[c] - at[c]);
    }
  }
}

} // namespace grid_ops

GridOp grid_op(ShadeopId id) {
  static constexpr GridOp kOps[] = {
#define SHADEOP(name, signature, kernel, flags, ulps, doc) nullptr,
#define GRIDOP(name, signature, function, flags, doc) grid_ops::function,
#define RSLOP(name, signature, flags, doc) nullptr,
#define PENDING(name, signature, flags, doc) nullptr,
#include "slvm/format/shadeops.def"
#undef SHADEOP
#undef GRIDOP
#undef RSLOP
#undef PENDING
  };
  return kOps[id];
}

} // namespace slvm
