// irradiancecache(): arguments become an IrradianceInsert or an IrradianceQuery, which the renderer answers.
#include "slvm/irradiance_cache.h"

#include "slvm/exec/rays/call_tokens.h"
#include "slvm/exec/spaces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace slvm {
namespace {

using Triple = std::array<float, 3>;

class IrradianceCall {
public:
  explicit IrradianceCall(const GridCall& call)
      : call_(call), run_(call.run), first_(count_stores(call)), tokens_(call, first_ + 5),
        outputs_(call, tokens_) {}

  void run() {
    fill(run_, call_.operands[0], 0);
    const std::string_view operation = text_of(run_, operand(0)), mode = text_of(run_, operand(2));
    const bool inserts = operation == "insert", queries = operation == "query";
    if (queries) // whatever goes wrong
      for (TokenOutput& o : outputs_.list())
        std::fill(o.values.begin(), o.values.end(), 0.0f);
    if (!inserts && !queries)
      complain(fmt::format("it can \"insert\" or \"query\", not \"{}\"", operation));
    else if (inserts ? mode != "w" && mode != "rw" : mode != "r" && mode != "R" && mode != "rw")
      complain(fmt::format("the mode of \"{}\" is {}, not \"{}\"", operation,
                           inserts ? "\"w\" or \"rw\"" : "\"r\"", mode));
    else
      ask(inserts, mode);
    if (!call_.operands[0].planes.step) // for all there is one
      fill(run_, call_.operands[0], *call_.operands[0].planes.plane(0));
    outputs_.store();
  }

private:
  const Operand& operand(size_t i) const { return call_.operands[first_ + i].planes; }
  void complain(std::string_view text) const {
    run_.report(call_.code, MessageSeverity::kWarning, fmt::format("{}: {}", call_.info.name, text),
                mask_count(run_.mask.current(), run_.points));
  }

  void ask(bool inserts, std::string_view mode) {
    if (text_of(run_, operand(1)).empty()) return complain("it needs the name of a file");
    IrradianceCacheServices* services = run_.state.services.irradiance_caches();
    if (!services) return complain("there is nobody here who keeps irradiance caches");
    if (tokens_.has("maxpixeldist"))
      complain("\"maxpixeldist\" has no effect: data are as dense as they were kept");
    if (!read_spaces()) return;
    if (inserts)
      insert(*services, mode);
    else
      query(*services);
  }

  // ---- Where.

  /// "world", unless the call names another space.
  bool read_spaces() {
    to_cache_ = current_to_world(run_);
    const std::string_view space = tokens_.text("coordsystem");
    if (!space.empty() && !named_space(run_, space, false, to_cache_)) {
      complain(fmt::format("there is no space \"{}\", in which the data are to be", space));
      return false;
    }
    if (invert(to_cache_, from_cache_)) return true;
    complain(fmt::format("the space \"{}\" is flat: nothing can be kept in it", space));
    return false;
  }

  void read_points(IrradiancePoints& to) const {
    to.file = text_of(run_, operand(1));
    to.points = run_.points;
    to.mask = run_.mask.current();
    for (auto* planes : {&to.position, &to.normal})
      for (std::vector<float>& component : *planes)
        component.resize(run_.points);
    mask_for_each(run_.mask.current(), run_.points, [&](size_t i) {
      put_triple(to.position, i, transform_point(to_cache_, triple(operand(3), i)));
      Triple n = transform_normal(to_cache_, triple(operand(4), i));
      const float length = std::hypot(n[0], n[1], n[2]);
      for (float& x : n)
        x = length > 0 && std::isfinite(length) ? x / length : 0;
      put_triple(to.normal, i, n);
    });
  }

  static Triple triple(const Operand& o, size_t i) {
    const size_t at = o.step ? i : 0;
    return {o.plane(0)[at], o.plane(1)[at], o.plane(2)[at]};
  }
  static void put_triple(std::vector<float> (&to)[3], size_t i, const Triple& value) {
    for (size_t c = 0; c < 3; ++c)
      to[c][i] = value[c];
  }

  /// From each point to the farthest one beside or across from it that the call runs for, too.
  std::vector<float> spacing_of(const IrradiancePoints& p) const {
    const Grid& grid = *run_.state.grid;
    std::vector<float> out(run_.points);
    if (grid.lattice == Lattice::kHits) return out;
    const int nu = grid.nu(), rows = grid.rows_of_piece();
    mask_for_each(run_.mask.current(), run_.points, [&](size_t i) {
      const int x = static_cast<int>(i) % nu, y = static_cast<int>(i) / nu, piece = y / rows * rows;
      for (int v = std::max(piece, y - 1); v <= std::min(piece + rows - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(nu - 1, x + 1); ++u) {
          const auto k = static_cast<size_t>(v * nu + u);
          if (k < run_.points && p.active(k))
            out[i] = std::max(out[i], std::hypot(p.position[0][k] - p.position[0][i],
                                                 p.position[1][k] - p.position[1][i],
                                                 p.position[2][k] - p.position[2][i]));
        }
    });
    return out;
  }

  // ---- What.

  std::vector<float> values_of(const TokenOutput& o, size_t component) const {
    const auto at = o.values.begin() + static_cast<std::ptrdiff_t>(component * run_.points);
    return {at, at + static_cast<std::ptrdiff_t>(run_.points)};
  }

  void insert(IrradianceCacheServices& services, std::string_view mode) {
    // Hits of rays are as dense as rays are: what is kept are the points of the picture's own grids.
    if (run_.state.grid->ray.depth > 0) return;
    IrradianceInsert out;
    read_points(out);
    out.keeps = mode == "rw";
    out.spacing = spacing_of(out);
    for (const TokenOutput& o : outputs_.list()) {
      if (o.token == "occlusion") out.occlusion = values_of(o, 0);
      if (o.token == "irradiance")
        for (size_t c = 0; c < 3; ++c)
          out.irradiance[c] = values_of(o, c);
      if (o.token != "environmentdir") continue;
      for (size_t c = 0; c < 3; ++c)
        out.direction[c].resize(run_.points);
      mask_for_each(run_.mask.current(), run_.points, [&](size_t i) {
        put_triple(out.direction, i,
                   transform_vector(to_cache_,
                                    {o.values[i], o.values[run_.points + i], o.values[2 * run_.points + i]}));
      });
    }
    if (out.occlusion.empty() && out.irradiance[0].empty() && out.direction[0].empty())
      return complain("\"insert\" needs \"occlusion\", \"irradiance\" or \"environmentdir\"");
    if (const std::string problem = services.insert(out); !problem.empty()) return complain(problem);
    mask_for_each(run_.mask.current(), run_.points,
                  [&](size_t i) { put(call_.operands[0].planes, 0, i, 1); });
  }

  void query(IrradianceCacheServices& services) {
    IrradianceQuery out;
    read_points(out);
    out.max_error = tokens_.number("maxerror", tokens_.number("maxvariation", -1));
    std::vector<float> found(run_.points);
    out.found = found.data();
    for (TokenOutput& o : outputs_.list()) {
      if (o.token == "occlusion") {
        out.occlusion = o.values.data();
        continue;
      }
      for (size_t c = 0; c < 3; ++c)
        (o.token == "irradiance" ? out.irradiance : out.direction)[c] = o.values.data() + c * run_.points;
    }
    if (const std::string problem = services.query(out); !problem.empty()) complain(problem);
    if (out.direction[0])
      mask_for_each(run_.mask.current(), run_.points, [&](size_t i) {
        const Triple d =
            transform_vector(from_cache_, {out.direction[0][i], out.direction[1][i], out.direction[2][i]});
        const float length = std::hypot(d[0], d[1], d[2]);
        for (size_t c = 0; c < 3; ++c)
          out.direction[c][i] = length > 0 ? d[c] / length : 0;
      });
    mask_for_each(run_.mask.current(), run_.points,
                  [&](size_t i) { put(call_.operands[0].planes, 0, i, found[i]); });
  }

  const GridCall& call_;
  const ShaderRun& run_;
  size_t first_; ///< of the arguments, behind what is stored
  CallTokens tokens_;
  TokenOutputs outputs_;
  Matrix4 to_cache_, from_cache_;
};

} // namespace

namespace grid_ops {

// Operands: result and variables that tokens name; operation, file, mode, P, N, token-value pairs.
void irradiance_cache(const GridCall& call) {
  IrradianceCall(call).run();
}

} // namespace grid_ops
} // namespace slvm
