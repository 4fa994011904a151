// Matrices between named coordinate systems, and the table of grid ops.
#include "slvm/exec/run.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace slvm {
namespace {

// `forward`: space to current; else current to space.
bool named_space(const ShaderRun& run, std::string_view space, bool forward, Matrix4& m) {
  auto known = [&](const Matrix4& to_current) {
    if (forward) m = to_current;
    else invert(to_current, m); // singular: all zeros
    return true;
  };
  if (space == "current" || space.empty()) return known(Matrix4{});
  if (space == "shader") return known(run.instance.shader_to_current());
  if (space == "object") return known(run.state.grid->object_to_current);
  ShadingState state = run.shading_state();
  return forward ? run.state.services.space_to_current(state, space, m)
                 : run.state.services.current_to_space(state, space, m);
}

} // namespace

namespace grid_ops {

void space_matrix(const GridCall& call) {
  ShaderRun& run = call.run;
  Matrix4 total;
  for (size_t i : {1u, 2u}) {
    std::string_view name = run.state.machine.strings().text(std::bit_cast<uint32_t>(*call.operands[i].planes.data));
    Matrix4 m;
    if (named_space(run, name, i == 1, m)) total = total * m;
    else run.report(call.code, MessageSeverity::kError, fmt::format("unknown coordinate system \"{}\"", name), run.points);
  }
  for (size_t i = 0; i < 16; ++i) std::fill_n(call.operands[0].planes.plane(i), kMaxLanes, total.m[i]);
}

} // namespace grid_ops

GridOp grid_op(ShadeopId id) {
  static constexpr GridOp kOps[] = {
#define SHADEOP(name, signature, kernel, flags, doc) nullptr,
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
