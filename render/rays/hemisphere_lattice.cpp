// Lines and cells of a lattice.
#include "render/rays/hemisphere_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace render {

namespace {

/// Lines and cells of fewer steps whose ends agree are interpolated without a look at their middles.
constexpr int kVerified = 4;
/// Points so few steps apart whose samples agree have nothing between them that would be seen, near as it may
/// be.
constexpr int kBeside = 2;
/// Neighbouring normals with less between them, as a cosine, are of one side of a surface.
constexpr float kTurnedRound = 0.3f;
/// Rectangles of no more steps than this are not halved further where normals turn round in them.
constexpr int kSmall = 4;
constexpr size_t kValues = HemisphereSample::kValues, kGradients = HemisphereSample::kGradients;

HemisphereSample blend(const HemisphereSample& a, const HemisphereSample& b, float t) {
  HemisphereSample out;
  for (size_t i = 0; i < kValues; ++i)
    out.value[i] = a.value[i] + (b.value[i] - a.value[i]) * t;
  for (size_t i = 0; i < kGradients; ++i) {
    out.move[i] = a.move[i] + (b.move[i] - a.move[i]) * t;
    out.turn[i] = a.turn[i] + (b.turn[i] - a.turn[i]) * t;
  }
  // The distances of both, weighted by nearness.
  float near_a = 1 / a.distance, near_b = 1 / b.distance;
  out.distance = 1 / (near_a + (near_b - near_a) * t);
  return out;
}

class Lattice {
public:
  explicit Lattice(const LatticeProblem& p) : p_(p), samples_(p.points.size()), known_(p.points.size()) {}

  std::vector<HemisphereSample> run() {
    int u = p_.nu - 1, v = p_.nv - 1;
    for (int corner : {0, u, v * p_.nu, v * p_.nu + u})
      take(corner);
    line(0, 1, u);
    line(v * p_.nu, 1, u);
    line(0, p_.nu, v);
    line(u, p_.nu, v);
    cell(0, 0, u, v);
    return std::move(samples_);
  }

private:
  bool on(int k) const { return p_.mask[k / 64] >> (k % 64) & 1; }
  const HemispherePoint& point(int k) const { return p_.points[static_cast<size_t>(k)]; }
  HemisphereSample& at(int k) { return samples_[static_cast<size_t>(k)]; }

  void take(int k) {
    if (known_[static_cast<size_t>(k)]) return;
    known_[static_cast<size_t>(k)] = true;
    if (on(k)) at(k) = p_.sample(point(k));
  }
  void set(int k, const HemisphereSample& s) {
    if (known_[static_cast<size_t>(k)]) return;
    known_[static_cast<size_t>(k)] = true;
    at(k) = s;
  }

  float turn(int from, int to) const {
    return std::sqrt(std::max(0.0f, 1 - glm::dot(point(from).N, point(to).N)));
  }
  float way(int from, int to) const { return glm::distance(point(from).P, point(to).P); }
  /// How wrong the sample of one point, with this reach, may be at another one.
  float error(int from, float reach, int to) const { return way(from, to) / reach + turn(from, to); }
  bool turns_round(int a, int b) const {
    return on(a) && on(b) && glm::dot(point(a).N, point(b).N) < kTurnedRound;
  }

  /// Reaches of samples that belong together, none much greater than that of another one near it.
  template <size_t n> std::array<float, n> reaches(const std::array<int, n>& of) {
    std::array<float, n> own, out;
    for (size_t i = 0; i < n; ++i)
      own[i] = reach_of(at(of[i]));
    for (size_t i = 0; i < n; ++i) {
      out[i] = own[i];
      for (size_t k = 0; k < n; ++k)
        out[i] = std::min(out[i], own[k] + way(of[i], of[k]));
    }
    return out;
  }

  /// Nothing is seen from any of these but what is in the way, alike: how near that is makes no difference.
  template <size_t n> bool all_blocked(const std::array<int, n>& of) {
    return std::all_of(of.begin(), of.end(), [&](int k) {
      if (at(k).value[0] < 1) return false;
      for (size_t c = 1; c < kGradients; ++c)
        if (at(k).value[c] != at(of[0]).value[c]) return false;
      return true;
    });
  }

  /// Values at all points of a line whose ends are known.
  void line(int first, int stride, int steps) {
    if (steps < 2) return;
    for (int i = 0; i < steps; ++i) {
      const int before = first + stride * i, behind = before + stride;
      if (!turns_round(before, behind)) continue;
      take(before);
      take(behind);
      line(first, stride, i);
      line(behind, stride, steps - i - 1);
      return;
    }
    int middle = steps / 2, centre = first + stride * middle;
    bool near = can_interpolate(first, stride, steps);
    if (near && steps < kVerified && agree(at(first), at(first + stride * steps))) {
      interpolate(first, stride, steps);
      return;
    }
    if (near) {
      HemisphereSample expected = on_line(first, stride, steps, middle);
      take(centre);
      near = agree(expected, at(centre));
    } else {
      take(centre);
    }
    if (near) {
      interpolate(first, stride, middle);
      interpolate(centre, stride, steps - middle);
      return;
    }
    line(first, stride, middle);
    line(centre, stride, steps - middle);
  }

  /// Whether a sample is what was expected, light compared with the brighter of both.
  bool agree(const HemisphereSample& a, const HemisphereSample& b) const {
    for (size_t c = 0; c < kGradients; ++c) {
      float whole = c == 0 ? 1.0f : std::max({a.value[c], b.value[c], 0.1f});
      if (!(std::abs(a.value[c] - b.value[c]) <= p_.tolerance * whole)) return false;
    }
    return true;
  }

  bool can_interpolate(int first, int stride, int steps) {
    if (steps > p_.most_steps) return false;
    const std::array<int, 2> ends{first, first + stride * steps};
    std::array<float, 2> reach = reaches(ends);
    if (steps <= kBeside || (steps >= kVerified && all_blocked(ends))) reach.fill(kInfinity);
    for (int k = first; k <= ends[1]; k += stride) {
      if (!on(k)) return false;
      if (k == first || k == ends[1]) continue;
      if (!(std::min(error(first, reach[0], k), error(ends[1], reach[1], k)) <= p_.max_error)) return false;
    }
    return true;
  }

  /// Cubic from both values and the slopes that their gradients give, at a point of the line.
  HemisphereSample on_line(int first, int stride, int steps, int step) {
    int last = first + stride * steps;
    const HemisphereSample &a = at(first), &b = at(last);
    Vec3 way = point(last).P - point(first).P, turn = glm::cross(point(first).N, point(last).N);
    float whole = 0, gone = 0;
    for (int i = 0; i < steps; ++i) {
      int k = first + stride * i;
      whole += glm::distance(point(k).P, point(k + stride).P);
      if (i + 1 == step) gone = whole;
    }
    float t = whole > 0 ? gone / whole : static_cast<float>(step) / static_cast<float>(steps), r = 1 - t;
    HemisphereSample s = blend(a, b, t);
    for (size_t c = 0; c < kGradients; ++c) {
      float chord = b.value[c] - a.value[c];
      auto slope = [&](const HemisphereSample& from) {
        float m = glm::dot(from.move[c], way) + glm::dot(from.turn[c], turn);
        // Gradients are estimates: they may not lead far from the values at the ends.
        float most = 2 * std::max({std::abs(a.value[c]), std::abs(b.value[c]), std::abs(chord)});
        return std::clamp(m, -most, most);
      };
      s.value[c] = std::max(0.0f, s.value[c] + t * r * (r * (slope(a) - chord) - t * (slope(b) - chord)));
    }
    s.value[0] = std::min(s.value[0], 1.0f);
    return s;
  }

  void interpolate(int first, int stride, int steps) {
    for (int i = 1; i < steps; ++i)
      set(first + stride * i, on_line(first, stride, steps, i));
  }

  /// The inside of a rectangle whose edges are known.
  void cell(int i0, int j0, int i1, int j1) {
    if (i1 - i0 < 2 || j1 - j0 < 2) return;
    if (cell_is_near(i0, j0, i1, j1) && has_smooth_edges({i0, j0, i1, j1})) {
      const HemisphereSample& corner = at(j0 * p_.nu + i0);
      if (std::min(i1 - i0, j1 - j0) < kVerified && agree(corner, at(j0 * p_.nu + i1)) &&
          agree(corner, at(j1 * p_.nu + i0)) && agree(corner, at(j1 * p_.nu + i1))) {
        blend_cell({i0, j0, i1, j1}, nullptr);
        return;
      }
      int i = (i0 + i1) / 2, j = (j0 + j1) / 2;
      HemisphereSample expected = in_cell({i0, j0, i1, j1}, i, j);
      take(j * p_.nu + i);
      if (agree(expected, at(j * p_.nu + i))) {
        blend_cell({i0, j0, i1, j1}, &expected);
        return;
      }
    }
    if (std::max(i1 - i0, j1 - j0) <= kSmall && is_crossed({i0, j0, i1, j1})) {
      carry_into({i0, j0, i1, j1});
      return;
    }
    if (i1 - i0 >= j1 - j0) {
      int i = (i0 + i1) / 2;
      line(j0 * p_.nu + i, p_.nu, j1 - j0);
      cell(i0, j0, i, j1);
      cell(i, j0, i1, j1);
    } else {
      int j = (j0 + j1) / 2;
      line(j * p_.nu + i0, 1, i1 - i0);
      cell(i0, j0, i1, j);
      cell(i0, j, i1, j1);
    }
  }

  bool cell_is_near(int i0, int j0, int i1, int j1) {
    if (std::max(i1 - i0, j1 - j0) > p_.most_steps) return false;
    const std::array<int, 4> corners{j0 * p_.nu + i0, j0 * p_.nu + i1, j1 * p_.nu + i0, j1 * p_.nu + i1};
    if (!std::all_of(corners.begin(), corners.end(), [&](int k) { return on(k); })) return false;
    std::array<float, 4> reach = reaches(corners);
    if (std::max(i1 - i0, j1 - j0) <= kBeside ||
        (std::min(i1 - i0, j1 - j0) >= kVerified && all_blocked(corners)))
      reach.fill(kInfinity);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        int k = j * p_.nu + i;
        if (!on(k)) return false;
        float least = kInfinity;
        for (size_t c = 0; c < 4; ++c)
          least = std::min(least, error(corners[c], reach[c], k));
        if (!(least <= p_.max_error)) return false;
      }
    return true;
  }

  struct Cell {
    int i0, j0, i1, j1;
  };

  /// Whether normals turn round inside.
  bool is_crossed(const Cell& c) const {
    for (int j = c.j0; j <= c.j1; ++j)
      for (int i = c.i0; i <= c.i1; ++i) {
        const int k = j * p_.nu + i;
        if ((i < c.i1 && turns_round(k, k + 1)) || (j < c.j1 && turns_round(k, k + p_.nu))) return true;
      }
    return false;
  }

  /// Points inside take the mean of what is on the edges, by how near that is; points that nothing is near to
  /// have samples of their own.
  void carry_into(const Cell& c) {
    std::vector<int> edge;
    for (int j = c.j0; j <= c.j1; ++j)
      for (int i = c.i0; i <= c.i1; ++i)
        if ((i == c.i0 || i == c.i1 || j == c.j0 || j == c.j1) && on(j * p_.nu + i))
          edge.push_back(j * p_.nu + i);
    for (int j = c.j0 + 1; j < c.j1; ++j)
      for (int i = c.i0 + 1; i < c.i1; ++i) {
        const int k = j * p_.nu + i;
        if (known_[static_cast<size_t>(k)] || !on(k)) continue;
        HemisphereSample sum;
        float weights = 0, nearness = 0;
        for (int from : edge) {
          const HemisphereSample& s = at(from);
          const float e = error(from, reach_of(s), k);
          if (!(e <= p_.max_error) || turns_round(from, k)) continue;
          const float weight = 1 / std::max(e, 1e-3f);
          const HemisphereSample here =
              carried(s, point(k).P - point(from).P, glm::cross(point(from).N, point(k).N));
          for (size_t v = 0; v < kValues; ++v)
            sum.value[v] += weight * here.value[v];
          nearness += weight / s.distance;
          weights += weight;
        }
        if (!(weights > 0)) {
          take(k);
          continue;
        }
        for (float& v : sum.value)
          v /= weights;
        sum.distance = weights / nearness;
        set(k, sum);
      }
  }

  /// Whether the edges are what their ends foretell. Where something begins or ends on an edge, it does so
  /// inside, too, at places that no blend of the edges finds.
  bool has_smooth_edges(const Cell& c) {
    const int width = c.i1 - c.i0, height = c.j1 - c.j0;
    return is_smooth(c.j0 * p_.nu + c.i0, 1, width) && is_smooth(c.j1 * p_.nu + c.i0, 1, width) &&
           is_smooth(c.j0 * p_.nu + c.i0, p_.nu, height) && is_smooth(c.j0 * p_.nu + c.i1, p_.nu, height);
  }
  bool is_smooth(int first, int stride, int steps) {
    for (int i = 1; i < steps; ++i)
      if (!agree(on_line(first, stride, steps, i), at(first + stride * i))) return false;
    return true;
  }

  /// Coons' blend of the four edges at a point inside: values only, for nothing is interpolated from there.
  HemisphereSample in_cell(const Cell& cell, int i, int j) {
    auto [i0, j0, i1, j1] = cell;
    const float s = static_cast<float>(i - i0) / static_cast<float>(i1 - i0),
                t = static_cast<float>(j - j0) / static_cast<float>(j1 - j0);
    auto values = [&](int row, int column) -> const auto& {
      return at(row * p_.nu + column).value;
    };
    const auto &left = values(j, i0), &right = values(j, i1), &low = values(j0, i), &high = values(j1, i);
    const auto &a = values(j0, i0), &b = values(j0, i1), &c = values(j1, i0), &d = values(j1, i1);
    HemisphereSample out;
    for (size_t k = 0; k < kValues; ++k) {
      const float across = left[k] + (right[k] - left[k]) * s, down = low[k] + (high[k] - low[k]) * t;
      const float first = a[k] + (b[k] - a[k]) * s, last = c[k] + (d[k] - c[k]) * s;
      out.value[k] = across + down - (first + (last - first) * t);
    }
    return out;
  }

  /// `expected`: what the middle would have been; by how much it is not so is spread over the cell.
  void blend_cell(const Cell& cell, const HemisphereSample* expected) {
    auto [i0, j0, i1, j1] = cell;
    const HemisphereSample middle = at((j0 + j1) / 2 * p_.nu + (i0 + i1) / 2);
    for (int j = j0 + 1; j < j1; ++j)
      for (int i = i0 + 1; i < i1; ++i) {
        HemisphereSample out = in_cell(cell, i, j);
        float part = bulge(i0, i, i1) * bulge(j0, j, j1);
        for (size_t c = 0; c < kValues; ++c) {
          if (expected) out.value[c] += part * (middle.value[c] - expected->value[c]);
          if (c < kGradients) out.value[c] = std::max(0.0f, out.value[c]);
        }
        out.value[0] = std::min(out.value[0], 1.0f);
        set(j * p_.nu + i, out);
      }
  }
  /// A parabola: 0 at the ends, 1 in the middle.
  static float bulge(int from, int at, int to) {
    return 4 * static_cast<float>((at - from) * (to - at)) / static_cast<float>((to - from) * (to - from));
  }

  const LatticeProblem& p_;
  std::vector<HemisphereSample> samples_;
  std::vector<bool> known_;
};

} // namespace

std::vector<HemisphereSample> fill_lattice(const LatticeProblem& problem) {
  return Lattice(problem).run();
}

} // namespace render
