// Quadrics. A profile knows its point and derivative at v and a bound for a range of v; Quadric turns it.
#include "render/prims/quadrics.h"

#include "slvm/support/turn.h"

#include <cmath>

namespace render {

namespace {

/// Range of cos over [a, b] (a <= b, radians).
void cos_range(float a, float b, float& low, float& high) {
  float ca = std::cos(a), cb = std::cos(b);
  low = std::min(ca, cb);
  high = std::max(ca, cb);
  float turn = 2 * kPi;
  if (std::floor(b / turn) >= std::ceil(a / turn)) high = 1;                 // passes a multiple of 2 pi
  if (std::floor((b - kPi) / turn) >= std::ceil((a - kPi) / turn)) low = -1; // passes an odd multiple of pi
}

void sin_range(float a, float b, float& low, float& high) {
  cos_range(a - kPi / 2, b - kPi / 2, low, high);
}

/// A range of the profile: every point of it lies on a segment between a turned `a` and a turned `b`, at zmin
/// to zmax.
struct ProfileRange {
  Vec2 a, b;
  float zmin, zmax;
};

struct ProfilePoint {
  Vec3 q, dq; ///< dq: derivative with respect to v
};

struct SphereProfile {
  float radius, phimin, phimax;
  ProfilePoint at(float v) const {
    float d = phimax - phimin, c, s;
    slvm::sine_and_cosine((phimin + v * d) / (2 * kPi), s, c);
    return {{radius * c, 0, radius * s}, {-radius * s * d, 0, radius * c * d}};
  }
  ProfileRange range(float v0, float v1) const {
    float p0 = phimin + v0 * (phimax - phimin), p1 = phimin + v1 * (phimax - phimin);
    if (p0 > p1) std::swap(p0, p1);
    float clow, chigh, slow, shigh;
    cos_range(p0, p1, clow, chigh);
    sin_range(p0, p1, slow, shigh);
    auto [z0, z1] = std::minmax({radius * slow, radius * shigh});
    return {{radius * clow, 0}, {radius * chigh, 0}, z0, z1};
  }
};

struct TorusProfile {
  float major, minor, phimin, phimax;
  ProfilePoint at(float v) const {
    ProfilePoint p = SphereProfile{minor, phimin, phimax}.at(v);
    p.q.x += major;
    return p;
  }
  ProfileRange range(float v0, float v1) const {
    ProfileRange r = SphereProfile{minor, phimin, phimax}.range(v0, v1);
    r.a.x += major;
    r.b.x += major;
    return r;
  }
};

/// Cylinder, cone, disk and hyperboloid: a straight line.
struct LineProfile {
  Vec3 from, to;
  ProfilePoint at(float v) const { return {from * (1 - v) + to * v, to - from}; }
  ProfileRange range(float v0, float v1) const {
    Vec3 a = at(v0).q, b = at(v1).q;
    return {Vec2(a), Vec2(b), std::min(a.z, b.z), std::max(a.z, b.z)};
  }
};

struct ParaboloidProfile {
  float rmax, zmin, zmax;
  ProfilePoint at(float v) const {
    // At the apex dr/dv is infinite; a nearby slope keeps direction and finiteness.
    float z = zmin + v * (zmax - zmin), ratio = std::max(z / zmax, 0.0f);
    float slope = rmax * 0.5f / std::sqrt(std::max(ratio, 1e-6f)) * (zmax - zmin) / zmax;
    return {{rmax * std::sqrt(ratio), 0, z}, {slope, 0, zmax - zmin}};
  }
  ProfileRange range(float v0, float v1) const {
    Vec3 a = at(v0).q, b = at(v1).q;
    return {Vec2(a), Vec2(b), std::min(a.z, b.z), std::max(a.z, b.z)};
  }
};

template <class Profile> class Quadric final : public Geometry {
public:
  Quadric(Profile profile, float thetamax) : profile_(profile), thetamax_(radians(thetamax)) {}

  Box bound(const UvRect& rect) const override {
    ProfileRange r = profile_.range(rect.v0, rect.v1);
    Box box;
    for (Vec2 p : {r.a, r.b}) {
      float radius = glm::length(p), start = std::atan2(p.y, p.x);
      float t0 = start + rect.u0 * thetamax_, t1 = start + rect.u1 * thetamax_;
      if (t0 > t1) std::swap(t0, t1);
      float xlow, xhigh, ylow, yhigh;
      cos_range(t0, t1, xlow, xhigh);
      sin_range(t0, t1, ylow, yhigh);
      box.add({radius * xlow, radius * ylow, r.zmin});
      box.add({radius * xhigh, radius * yhigh, r.zmax});
    }
    Vec3 size = box.max - box.min; // room for the rounding of sines
    box.grow(1e-5f * std::max({size.x, size.y, size.z, 1e-30f}));
    return box;
  }

  void evaluate(const UvPoints& at, SurfaceLattice& out) const override {
    out.resize(at.size());
    const size_t width = at.u.size(), height = at.v.size();
    Columns columns;
    Rows rows;
    auto block = [](size_t first, size_t all) { return std::min(kBlock, all - first); };
    if (at.paired) {
      for (size_t k = 0; k < width; k += kBlock) {
        const size_t count = block(k, width);
        turn(at.u.data() + k, count, columns);
        find_profile(at.v.data() + k, count, rows);
        set_pairs(columns, rows, count, k, out);
      }
      return;
    }
    for (size_t v = 0; v < height; v += kBlock) {
      find_profile(at.v.data() + v, block(v, height), rows);
      for (size_t u = 0; u < width; u += kBlock) {
        turn(at.u.data() + u, block(u, width), columns);
        for (size_t j = 0; j < block(v, height); ++j)
          set_row(columns, block(u, width), rows, j, (v + j) * width + u, out);
      }
    }
  }

private:
  /// What columns and rows are worked out for together, component by component: loops that compilers
  /// vectorise.
  static constexpr size_t kBlock = 64;
  struct Columns {
    float sine[kBlock], cosine[kBlock];
  };
  struct Rows { ///< at theta 0
    float q[3][kBlock], dq[3][kBlock], n[3][kBlock];
  };

  void turn(const float* u, size_t count, Columns& out) const {
    const float turns = thetamax_ / (2 * kPi);
    for (size_t i = 0; i < count; ++i)
      slvm::sine_and_cosine(u[i] * turns, out.sine[i], out.cosine[i]);
  }

  void find_profile(const float* v, size_t count, Rows& out) const {
    for (size_t i = 0; i < count; ++i) {
      const ProfilePoint p = profile_.at(v[i]);
      for (int c = 0; c < 3; ++c) {
        out.q[c][i] = p.q[c];
        out.dq[c][i] = p.dq[c];
      }
    }
    const float sign = thetamax_ < 0 ? -1.0f : 1.0f;
    float length[kBlock];
    for (size_t i = 0; i < count; ++i) { // dPdu x dPdv: (-qy, qx, 0) x dq
      const float x = out.q[0][i] * out.dq[2][i], y = out.q[1][i] * out.dq[2][i],
                  z = -(out.q[0][i] * out.dq[0][i] + out.q[1][i] * out.dq[1][i]);
      length[i] = std::sqrt(x * x + y * y + z * z);
      const float scale = sign / length[i];
      out.n[0][i] = x * scale;
      out.n[1][i] = y * scale;
      out.n[2][i] = z * scale;
    }
    auto is_on_axis = [&](size_t i) {
      const float off = out.q[0][i] * out.q[0][i] + out.q[1][i] * out.q[1][i];
      const float x = out.dq[0][i], y = out.dq[1][i], z = out.dq[2][i];
      return !(off >= kOnAxis * (x * x + y * y + z * z)) | !(length[i] > 0);
    };
    int on_axis = 0;
    for (size_t i = 0; i < count; ++i)
      on_axis += is_on_axis(i);
    for (size_t i = 0; i < count && on_axis > 0; ++i) {
      if (!is_on_axis(i)) continue;
      const Vec3 n = normal_at_axis({out.dq[0][i], out.dq[1][i], out.dq[2][i]}, v[i]);
      for (int c = 0; c < 3; ++c)
        out.n[c][i] = n[c];
    }
  }

  /// Point first + i of `out` is that of column i and row i.
  void set_pairs(const Columns& columns, const Rows& rows, size_t count, size_t first,
                 SurfaceLattice& out) const {
    const float *sine = columns.sine, *cosine = columns.cosine;
    auto turn_all = [&](const float(&from)[3][kBlock], Vec3Planes& to) {
      float *x = to.plane(0) + first, *y = to.plane(1) + first;
      for (size_t i = 0; i < count; ++i)
        x[i] = from[0][i] * cosine[i] - from[1][i] * sine[i];
      for (size_t i = 0; i < count; ++i)
        y[i] = from[0][i] * sine[i] + from[1][i] * cosine[i];
      std::copy_n(from[2], count, to.plane(2) + first);
    };
    turn_all(rows.q, out.P);
    turn_all(rows.dq, out.dPdv);
    turn_all(rows.n, out.N);
    const float *x = out.P.plane(0) + first, *y = out.P.plane(1) + first;
    for (size_t i = 0; i < count; ++i)
      out.dPdu.set(first + i, {-y[i] * thetamax_, x[i] * thetamax_, 0});
  }

  /// All columns with row j; `out` from k on.
  void set_row(const Columns& columns, size_t count, const Rows& rows, size_t j, size_t k,
               SurfaceLattice& out) const {
    const float *sine = columns.sine, *cosine = columns.cosine;
    auto turn_all = [&](float x, float y, float z, Vec3Planes& to) {
      float *to_x = to.plane(0) + k, *to_y = to.plane(1) + k;
      for (size_t i = 0; i < count; ++i)
        to_x[i] = x * cosine[i] - y * sine[i];
      for (size_t i = 0; i < count; ++i)
        to_y[i] = x * sine[i] + y * cosine[i];
      std::fill_n(to.plane(2) + k, count, z);
    };
    turn_all(rows.q[0][j], rows.q[1][j], rows.q[2][j], out.P);
    turn_all(-rows.q[1][j] * thetamax_, rows.q[0][j] * thetamax_, 0, out.dPdu);
    turn_all(rows.dq[0][j], rows.dq[1][j], rows.dq[2][j], out.dPdv);
    turn_all(rows.n[0][j], rows.n[1][j], rows.n[2][j], out.N);
  }

  /// Squared distance from the axis, by the square of dPdv, at which dPdu has no direction.
  static constexpr float kOnAxis = 1e-8f;

  /// dPdu x dPdv at theta 0, with the direction of dPdu that a point a little off the axis has.
  Vec3 normal_at_axis(Vec3 dq, float v) const {
    const Vec3 q = profile_.at(v < 0.5f ? v + 1e-3f : v - 1e-3f).q;
    Vec3 n = glm::cross(Vec3(-q.y, q.x, 0), dq) * (thetamax_ < 0 ? -1.0f : 1.0f);
    float length = glm::length(n);
    return length > 0 ? n / length : Vec3(0, 0, 1);
  }

  Profile profile_;
  float thetamax_;
};

template <class Profile> GeometryResult finish(const Profile& profile, float thetamax) {
  if (thetamax == 0) return slvm::Error{"thetamax is zero"};
  return std::shared_ptr<const Geometry>(std::make_shared<Quadric<Profile>>(profile, thetamax));
}

} // namespace

GeometryResult make_sphere(float radius, float zmin, float zmax, float thetamax) {
  if (radius == 0) return slvm::Error{"the radius is zero"};
  float size = std::abs(radius);
  float low = std::asin(std::clamp(zmin / size, -1.0f, 1.0f)),
        high = std::asin(std::clamp(zmax / size, -1.0f, 1.0f));
  if (low == high) return slvm::Error{"zmin equals zmax"};
  // A negative radius mirrors the profile: the same sphere, inside out.
  if (radius < 0) return finish(SphereProfile{radius, -low, -high}, thetamax);
  return finish(SphereProfile{radius, low, high}, thetamax);
}

GeometryResult make_cone(float height, float radius, float thetamax) {
  if (radius == 0) return slvm::Error{"the radius is zero"};
  return finish(LineProfile{{radius, 0, 0}, {0, 0, height}}, thetamax);
}

GeometryResult make_cylinder(float radius, float zmin, float zmax, float thetamax) {
  if (radius == 0) return slvm::Error{"the radius is zero"};
  if (zmin == zmax) return slvm::Error{"zmin equals zmax"};
  return finish(LineProfile{{radius, 0, zmin}, {radius, 0, zmax}}, thetamax);
}

GeometryResult make_hyperboloid(Vec3 point1, Vec3 point2, float thetamax) {
  if (point1 == point2) return slvm::Error{"its two points are the same"};
  return finish(LineProfile{point1, point2}, thetamax);
}

GeometryResult make_paraboloid(float rmax, float zmin, float zmax, float thetamax) {
  if (rmax == 0) return slvm::Error{"rmax is zero"};
  if (zmax == 0) return slvm::Error{"zmax is zero; a paraboloid has its apex there"};
  if (zmin / zmax < 0) zmin = 0; // beyond the apex there is nothing
  if (zmin == zmax) return slvm::Error{"zmin equals zmax"};
  return finish(ParaboloidProfile{rmax, zmin, zmax}, thetamax);
}

GeometryResult make_disk(float height, float radius, float thetamax) {
  if (radius == 0) return slvm::Error{"the radius is zero"};
  return finish(LineProfile{{radius, 0, height}, {0, 0, height}}, thetamax);
}

GeometryResult make_torus(float major, float minor, float phimin, float phimax, float thetamax) {
  if (minor == 0) return slvm::Error{"the minor radius is zero"};
  if (phimin == phimax) return slvm::Error{"phimin equals phimax"};
  return finish(TorusProfile{major, minor, radians(phimin), radians(phimax)}, thetamax);
}

} // namespace render
