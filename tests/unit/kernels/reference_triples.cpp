// The reference of functions of triples and matrices: reference.h.
#include "tests/unit/kernels/reference.h"

#include <algorithm>
#include <array>

namespace slvm::test {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<std::array<double, 4>, 4>;

Triple triple(const double* in) {
  return {in[0], in[1], in[2]};
}
double dot(Triple a, Triple b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(Triple a) {
  return std::sqrt(dot(a, a));
}
Triple plus(Triple a, Triple b, double scale = 1) {
  return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}
Triple times(Triple a, double s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
Triple cross(Triple a, Triple b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
void put(Expected* out, Triple a, double magnitude = 0) {
  for (int i = 0; i < 3; ++i)
    out[i] = Expected(a[i], magnitude);
}

Matrix matrix(const double* in) {
  Matrix m;
  for (int i = 0; i < 16; ++i)
    m[i / 4][i % 4] = in[i];
  return m;
}
Matrix identity() {
  return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}
Matrix times(const Matrix& a, const Matrix& b) {
  Matrix r{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        r[i][j] += a[i][k] * b[k][j];
  return r;
}
double largest(const Matrix& m) {
  double r = 0;
  for (const auto& row : m)
    for (double x : row)
      r = std::max(r, std::abs(x));
  return r;
}
void put(Expected* out, const Matrix& m, double magnitude = 0) {
  for (int i = 0; i < 16; ++i)
    out[i] = Expected(m[i / 4][i % 4], magnitude);
}

/// Gauss-Jordan with partial pivoting; zeros when singular. Also the determinant.
Matrix inverse(Matrix a, double* determinant = nullptr) {
  Matrix r = identity();
  double det = 1;
  for (int c = 0; c < 4; ++c) {
    int pivot = c;
    for (int i = c; i < 4; ++i)
      if (std::abs(a[i][c]) > std::abs(a[pivot][c])) pivot = i;
    if (pivot != c) det = -det;
    std::swap(a[c], a[pivot]), std::swap(r[c], r[pivot]);
    det *= a[c][c];
    if (a[c][c] == 0) break;
    double scale = 1 / a[c][c];
    for (int j = 0; j < 4; ++j)
      a[c][j] *= scale, r[c][j] *= scale;
    for (int i = 0; i < 4; ++i) {
      double f = i == c ? 0 : a[i][c];
      for (int j = 0; j < 4; ++j)
        a[i][j] -= f * a[c][j], r[i][j] -= f * r[c][j];
    }
  }
  if (determinant) *determinant = det;
  return det == 0 ? Matrix{} : r;
}

/// The rotation by quaternions: v' = v + 2w(q x v) + 2q x (q x v).
Triple rotated(Triple v, double angle, Triple axis) {
  double l = length(axis);
  if (l == 0) return v;
  Triple q = times(axis, std::sin(angle / 2) / l);
  Triple t = times(cross(q, v), 2);
  return plus(plus(v, t, std::cos(angle / 2)), cross(q, t));
}

/// Componentwise operators, where one operand may be a float.
void componentwise(const Signature& s, const double* in, Expected* out, char op) {
  int na = components(s.params[0].type), nb = components(s.params[1].type), n = components(s.result);
  for (int i = 0; i < n; ++i) {
    double a = in[na == 1 ? 0 : i], b = in[na + (nb == 1 ? 0 : i)];
    out[i] = op == '+' ? a + b : op == '-' ? a - b : op == '*' ? a * b : a / b;
  }
}

void multiply(Row s, In in, Out out) {
  if (s.params[0].type != Type::kMatrix || s.params[1].type != Type::kMatrix)
    return componentwise(s, in, out, '*');
  Matrix a = matrix(in), b = matrix(in + 16);
  put(out, times(a, b), 4 * largest(a) * largest(b));
}
/// The error of an inverse grows with the condition of the matrix.
void divide(Row s, In in, Out out) {
  if (s.params[1].type != Type::kMatrix) return componentwise(s, in, out, '/');
  bool by_float = s.params[0].type == Type::kFloat;
  Matrix a = by_float ? identity() : matrix(in), b = matrix(in + (by_float ? 1 : 16)), inverted = inverse(b);
  double scale = by_float ? in[0] : 1, norm = largest(inverted);
  Matrix r = times(a, inverted);
  for (auto& row : r)
    for (double& x : row)
      x *= scale;
  double minors = std::pow(std::max(largest(b), 1.0), 3) * norm;
  put(out, r, std::abs(scale) * largest(a) * norm * (1 + minors * largest(b)));
}

void fresnel(Row s, In in, Out out) {
  Triple i = triple(in), n = triple(in + 3);
  double eta = in[6], d = dot(i, n), c = std::abs(d), g2 = 1 / (eta * eta) + c * c - 1, kr = 1;
  double size = 1 + dot(i, i) * dot(n, n);
  if (g2 > 0) {
    double g = std::sqrt(g2), a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
    kr = std::clamp(0.5 * a * a * (1 + b * b), 0.0, 1.0);
  }
  bool ill = std::abs(g2) < 1e-3 * size; // the root amplifies rounding: either side may be taken
  out[0] = Expected(kr, ill ? 1e9 : size * size * (1 + 1 / (eta * eta)));
  out[1] = Expected(1 - kr, out[0].magnitude);
  if (s.param_count < 7) return;
  put(out + 2, plus(i, n, -2 * d), size * 10);
  double k = 1 - eta * eta * (1 - d * d);
  ill = std::abs(k) < 1e-3 * size * eta * eta;
  put(out + 5, k < 0 ? Triple{} : plus(times(i, eta), n, -(eta * d + std::sqrt(k))),
      ill ? 1e9 : 100 * size * eta * eta);
}

constexpr Reference kTriples[] = {
    {"operator+", 6, [](Row s, In in, Out out) { componentwise(s, in, out, '+'); }},
    {"operator-", 6, [](Row s, In in, Out out) { componentwise(s, in, out, '-'); }},
    {"operator*", -1, multiply},
    {"operator/", -1, divide},
    {"operator-", -1,
     [](Row s, In in, Out out) {
       for (int i = 0; i < components(s.result); ++i)
         out[i] = -in[i];
     }},
    {"operator.", 6,
     [](Row, In in, Out out) {
       out[0] = Expected(dot(triple(in), triple(in + 3)), length(triple(in)) * length(triple(in + 3)));
     }},
    {"operator^", 6,
     [](Row, In in, Out out) {
       put(out, cross(triple(in), triple(in + 3)), length(triple(in)) * length(triple(in + 3)));
     }},
    {"operator==", -1,
     [](Row s, In in, Out out) {
       int n = components(s.params[0].type);
       out[0] = std::equal(in, in + n, in + n);
     }},
    {"operator!=", -1,
     [](Row s, In in, Out out) {
       int n = components(s.params[0].type);
       out[0] = !std::equal(in, in + n, in + n);
     }},
    {"operator?:", -1,
     [](Row s, In in, Out out) {
       int n = components(s.result);
       for (int i = 0; i < n; ++i)
         out[i] = in[0] != 0 ? in[1 + i] : in[1 + n + i];
     }},
    {"triple", 3, [](Row, In in, Out out) { put(out, triple(in)); }},
    {"min", 6,
     [](Row, In in, Out out) {
       for (int i = 0; i < 3; ++i)
         out[i] = std::min(in[i], in[3 + i]);
     }},
    {"max", 6,
     [](Row, In in, Out out) {
       for (int i = 0; i < 3; ++i)
         out[i] = std::max(in[i], in[3 + i]);
     }},
    {"clamp", 9,
     [](Row, In in, Out out) {
       for (int i = 0; i < 3; ++i)
         out[i] = in[i] < in[3 + i] ? in[3 + i] : in[i] > in[6 + i] ? in[6 + i] : in[i];
     }},
    {"muladd", -1,
     [](Row s, In in, Out out) {
       const bool by_float = s.params[1].type == Type::kFloat;
       for (int i = 0; i < 3; ++i) {
         const double product = in[i] * in[by_float ? 3 : 3 + i];
         out[i] = Expected(product + in[(by_float ? 4 : 6) + i], std::abs(product));
       }
     }},
    {"mix", -1,
     [](Row s, In in, Out out) {
       for (int i = 0; i < 3; ++i) {
         double t = in[6 + (s.params[2].type == Type::kFloat ? 0 : i)];
         out[i] = Expected((1 - t) * in[i] + t * in[3 + i],
                           (1 + std::abs(t)) * (std::abs(in[i]) + std::abs(in[3 + i])));
       }
     }},
    {"xcomp", 3, [](Row, In in, Out out) { out[0] = in[0]; }},
    {"ycomp", 3, [](Row, In in, Out out) { out[0] = in[1]; }},
    {"zcomp", 3, [](Row, In in, Out out) { out[0] = in[2]; }},
    {"setxcomp", 4,
     [](Row, In in, Out out) {
       put(out, Triple{in[3], in[1], in[2]});
     }},
    {"setycomp", 4,
     [](Row, In in, Out out) {
       put(out, Triple{in[0], in[3], in[2]});
     }},
    {"setzcomp", 4,
     [](Row, In in, Out out) {
       put(out, Triple{in[0], in[1], in[3]});
     }},
    {"comp", 4,
     [](Row, In in, Out out) {
       int i = static_cast<int>(in[3]);
       out[0] = i >= 0 && i < 3 ? in[i] : 0;
     },
     -1, 4},
    {"comp", 18,
     [](Row, In in, Out out) {
       int i = static_cast<int>(in[16]), j = static_cast<int>(in[17]);
       out[0] = i >= 0 && i < 4 && j >= 0 && j < 4 ? in[4 * i + j] : 0;
     },
     -1, 5},
    {"setcomp", 5,
     [](Row, In in, Out out) {
       put(out, triple(in));
       int i = static_cast<int>(in[3]);
       if (i >= 0 && i < 3) out[i] = in[4];
     },
     -1, 4},
    {"setcomp", 19,
     [](Row, In in, Out out) {
       put(out, matrix(in));
       int i = static_cast<int>(in[16]), j = static_cast<int>(in[17]);
       if (i >= 0 && i < 4 && j >= 0 && j < 4) out[4 * i + j] = in[18];
     },
     -1, 5},
    {"length", 3, [](Row, In in, Out out) { out[0] = length(triple(in)); }},
    {"normalize", 3,
     [](Row, In in, Out out) {
       double l = length(triple(in));
       put(out, l > 0 ? times(triple(in), 1 / l) : Triple{});
     }},
    {"distance", 6, [](Row, In in, Out out) { out[0] = length(plus(triple(in), triple(in + 3), -1)); }},
    {"ptlined", 9,
     [](Row, In in, Out out) {
       Triple a = triple(in), axis = plus(triple(in + 3), a, -1), arm = plus(triple(in + 6), a, -1);
       double l2 = dot(axis, axis), t = l2 > 0 ? std::clamp(dot(arm, axis) / l2, 0.0, 1.0) : 0;
       out[0] = Expected(length(plus(arm, axis, -t)), length(arm) + length(axis));
     }},
    {"rotate", 10,
     [](Row, In in, Out out) {
       Triple a = triple(in + 4), arm = plus(triple(in), a, -1), axis = plus(triple(in + 7), a, -1);
       put(out, plus(rotated(arm, in[3], axis), a), 2 * length(arm) + length(a));
     }},
    {"rotate", 20,
     [](Row, In in, Out out) {
       Matrix by = identity();
       for (int i = 0; i < 3; ++i) {
         Triple v = rotated({by[i][0], by[i][1], by[i][2]}, in[16], triple(in + 17));
         std::copy(v.begin(), v.end(), by[i].begin());
       }
       put(out, times(matrix(in), by), 4 * largest(matrix(in)));
     }},
    {"translate", 19,
     [](Row, In in, Out out) {
       Matrix by = identity();
       std::copy(in + 16, in + 19, by[3].begin());
       put(out, times(matrix(in), by), 4 * largest(matrix(in)) * std::max(1.0, largest(by)));
     }},
    {"scale", 19,
     [](Row, In in, Out out) {
       Matrix by = identity();
       for (int i = 0; i < 3; ++i)
         by[i][i] = in[16 + i];
       put(out, times(matrix(in), by));
     }},
    {"determinant", 16,
     [](Row, In in, Out out) {
       double det;
       inverse(matrix(in), &det);
       out[0] = Expected(det, 24 * std::pow(largest(matrix(in)), 4));
     }},
    {"isperspective", 16,
     [](Row, In in, Out out) { out[0] = !(in[3] == 0 && in[7] == 0 && in[11] == 0 && in[15] == 1); }, 0, 0},
    {"transform", 19,
     [](Row, In in, Out out) {
       Matrix m = matrix(in);
       Triple p = triple(in + 16), r{}, size{};
       double w = m[3][3], wsize = std::abs(w);
       for (int k = 0; k < 3; ++k)
         w += p[k] * m[k][3], wsize += std::abs(p[k] * m[k][3]);
       for (int j = 0; j < 3; ++j) {
         r[j] = m[3][j], size[j] = std::abs(r[j]);
         for (int k = 0; k < 3; ++k)
           r[j] += p[k] * m[k][j], size[j] += std::abs(p[k] * m[k][j]);
         out[j] = Expected(r[j] / w, (size[j] + std::abs(r[j] / w) * wsize) / std::abs(w));
       }
     }},
    {"vtransform", 19,
     [](Row, In in, Out out) {
       Matrix m = matrix(in);
       for (int j = 0; j < 3; ++j) {
         double sum = 0, size = 0;
         for (int k = 0; k < 3; ++k)
           sum += in[16 + k] * m[k][j], size += std::abs(in[16 + k] * m[k][j]);
         out[j] = Expected(sum, size);
       }
     }},
    {"normalmatrix", 16,
     [](Row, In in, Out out) {
       Matrix m = matrix(in), upper = identity();
       for (int i = 0; i < 3; ++i)
         for (int j = 0; j < 3; ++j)
           upper[i][j] = m[j][i];
       Matrix r = inverse(upper);
       double norm = largest(r);
       put(out, r, norm == 0 ? 1 : norm * (1 + norm * std::pow(std::max(1.0, largest(upper)), 3)));
     }},
    {"faceforward", 9,
     [](Row, In in, Out out) {
       double d = dot(triple(in + 3), triple(in + 6));
       for (int i = 0; i < 3; ++i)
         out[i] = d > 0 ? -in[i] : in[i];
       if (std::abs(d) < 1e-4) put(out, Triple{}, 1e9);
     }},
    {"incone", 7,
     [](Row, In in, Out out) {
       double sides = length(triple(in)) * length(triple(in + 3)),
              d = dot(triple(in), triple(in + 3)) - in[6] * sides;
       out[0] = std::abs(d) < 1e-4 ? Expected(0, 1e9) : Expected(d >= 0);
     },
     -1, 1},
    {"reflect", 6,
     [](Row, In in, Out out) {
       Triple i = triple(in), n = triple(in + 3);
       put(out, plus(i, n, -2 * dot(i, n)), length(i) * (1 + 4 * dot(n, n)));
     }},
    {"refract", 7,
     [](Row, In in, Out out) {
       Triple i = triple(in), n = triple(in + 3);
       double eta = in[6], d = dot(i, n), k = 1 - eta * eta * (1 - d * d),
              size = 1 + eta * eta * (1 + dot(i, i) * dot(n, n));
       put(out, k < 0 ? Triple{} : plus(times(i, eta), n, -(eta * d + std::sqrt(k))),
           std::abs(k) < 1e-3 * size ? 1e9 : 100 * size);
     },
     -1, 1},
    {"fresnel", 7, fresnel, -1, 1},
};

} // namespace

std::span<const Reference> triple_references() {
  return kTriples;
}

} // namespace slvm::test
