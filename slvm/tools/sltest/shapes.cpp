#include "slvm/tools/sltest/shapes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace slvm::sltest {
namespace {

using Vec = std::array<double, 3>;
constexpr double kTau = 2 * std::numbers::pi;

struct SurfacePoint {
  Vec p, dpdu, dpdv, n;
};

SurfacePoint plane(double u, double v) {
  return {{u, v, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

SurfacePoint sphere(double u, double v) {
  double ct = std::cos(u * kTau), st = std::sin(u * kTau);
  double phi = (v - 0.5) * std::numbers::pi, cp = std::cos(phi), sp = std::sin(phi);
  return {{ct * cp, st * cp, sp},
          {-st * cp * kTau, ct * cp * kTau, 0},
          {-ct * sp * kTau / 2, -st * sp * kTau / 2, cp * kTau / 2},
          {ct * cp, st * cp, sp}};
}

SurfacePoint cylinder(double u, double v) {
  double c = std::cos(u * kTau), s = std::sin(u * kTau);
  return {{c, s, v}, {-s * kTau, c * kTau, 0}, {0, 0, 1}, {c, s, 0}};
}

SurfacePoint cone(double u, double v) {
  double c = std::cos(u * kTau), s = std::sin(u * kTau), r = 1 - v, k = std::sqrt(0.5);
  return {{r * c, r * s, v}, {-s * kTau * r, c * kTau * r, 0}, {-c, -s, 1}, {c * k, s * k, k}};
}

SurfacePoint disk(double u, double v) {
  double c = std::cos(u * kTau), s = std::sin(u * kTau), r = 1 - v;
  return {{r * c, r * s, 0}, {-s * kTau * r, c * kTau * r, 0}, {-c, -s, 0}, {0, 0, 1}};
}

SurfacePoint torus(double u, double v) {
  constexpr double kMinor = 0.25;
  double c = std::cos(u * kTau), s = std::sin(u * kTau), cp = std::cos(v * kTau), sp = std::sin(v * kTau);
  double r = 1 + kMinor * cp, k = kMinor * kTau;
  return {{r * c, r * s, kMinor * sp},
          {-s * kTau * r, c * kTau * r, 0},
          {-c * sp * k, -s * sp * k, cp * k},
          {c * cp, s * cp, sp}};
}

struct Shape {
  ShapeInfo info;
  SurfacePoint (*point)(double u, double v);
};
constexpr int kShapeCount = 6;
constexpr Shape kShapes[kShapeCount] = {
    {{"plane", "P = (u, v, 0), N = (0, 0, 1)"}, plane},
    {{"sphere", "radius 1 about the origin, poles on the z axis"}, sphere},
    {{"cylinder", "radius 1, z from 0 to 1"}, cylinder},
    {{"cone", "radius 1 at z = 0, apex at z = 1"}, cone},
    {{"disk", "radius 1 at z = 0, rim at v = 0"}, disk},
    {{"torus", "radii 1 and 0.25 about the z axis"}, torus},
};

Variable varying(std::string_view name, size_t points) {
  Type type = global_info(find_global(name)).type;
  Variable v{std::string(name), type, 0, true, {}, {}};
  v.numbers.resize(points * v.planes());
  return v;
}

void store(Variable& v, size_t point, const Vec& value) {
  const size_t points = v.points();
  for (size_t c = 0; c < 3; ++c)
    v.numbers[c * points + point] = static_cast<float>(value[c]);
}

Variable uniform(std::string_view name, std::vector<float> value) {
  return {std::string(name), global_info(find_global(name)).type, 0, false, std::move(value), {}};
}

double parameter(int at, int count, bool center) {
  if (center) return (at + 0.5) / count;
  return count == 1 ? 0.5 : static_cast<double>(at) / (count - 1);
}

float element(int count, bool center) {
  return center ? 1.0f / static_cast<float>(count) : count == 1 ? 1.0f : 1.0f / static_cast<float>(count - 1);
}

Variable renamed(Variable v, std::string_view name) {
  v.name = name;
  v.type = global_info(find_global(name)).type;
  return v;
}

void add_geometry(GridData& grid, const Shape& shape, bool center) {
  const size_t points = grid.points();
  Variable u = varying("u", points), v = varying("v", points), p = varying("P", points),
           n = varying("N", points), dpdu = varying("dPdu", points), dpdv = varying("dPdv", points);
  for (int y = 0; y < grid.nv; ++y)
    for (int x = 0; x < grid.nu; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(grid.nu) + static_cast<size_t>(x);
      const double pu = parameter(x, grid.nu, center), pv = parameter(y, grid.nv, center);
      const SurfacePoint at = shape.point(pu, pv);
      u.numbers[i] = static_cast<float>(pu);
      v.numbers[i] = static_cast<float>(pv);
      store(p, i, at.p);
      store(n, i, at.n);
      store(dpdu, i, at.dpdu);
      store(dpdv, i, at.dpdv);
    }
  for (Variable variable : {renamed(u, "s"), renamed(v, "t"), renamed(n, "Ng"), u, v, p, n, dpdu, dpdv})
    grid.set(std::move(variable));
}

} // namespace

std::span<const ShapeInfo> shapes() {
  static const std::vector<ShapeInfo> list = [] {
    std::vector<ShapeInfo> all;
    for (const Shape& s : kShapes)
      all.push_back(s.info);
    return all;
  }();
  return list;
}

Result<GridData> make_shape(const GridSpec& spec, ShaderKind kind) {
  const Shape* shape = nullptr;
  std::string names;
  for (const Shape& s : kShapes) {
    if (s.info.name == spec.shape) shape = &s;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", s.info.name);
  }
  if (!shape) return Error{fmt::format("no shape '{}'; there are {}", spec.shape, names)};

  GridData grid;
  grid.nu = spec.nu;
  grid.nv = spec.nv;
  grid.derivatives = spec.derivatives;
  grid.flip_normals = spec.flip_normals;
  grid.ray = spec.ray;
  add_geometry(grid, *shape, spec.center);
  grid.set(uniform("du", {element(spec.nu, spec.center)}));
  grid.set(uniform("dv", {element(spec.nv, spec.center)}));
  grid.set(uniform("I", {0, 0, 1}));
  grid.set(uniform("E", {0, 0, 0}));
  grid.set(uniform("Cs", {1, 1, 1}));
  grid.set(uniform("Os", {1, 1, 1}));
  if (kind == ShaderKind::kLight) {
    grid.set(renamed(*grid.find("P"), "Ps"));
    grid.set(renamed(*grid.find("N"), "Ns"));
  }
  if (kind == ShaderKind::kImager) {
    Variable p = varying("P", grid.points());
    for (size_t i = 0; i < grid.points(); ++i) {
      const size_t x = i % static_cast<size_t>(grid.nu), y = i / static_cast<size_t>(grid.nu);
      store(p, i, {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5, 0});
    }
    grid.set(std::move(p));
  }
  return grid;
}

} // namespace slvm::sltest
