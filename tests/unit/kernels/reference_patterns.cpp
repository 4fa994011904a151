// The reference of noise, splines and colour spaces: reference.h. Noise is written from its description in
// slvm/kernels/gradient_noise.h, one point and one corner at a time.
#include "tests/unit/kernels/reference.h"

#include <algorithm>
#include <array>
#include <vector>

namespace slvm::test {
namespace {

// ---- Noise

/// A coordinate: the cell's number below and above, and how far from the lower end.
struct Cell {
  int64_t below, above;
  double fraction;
};

Cell cell(double x, double period) {
  if (!(std::abs(x) < 0x1p30)) x = 0;
  double below = std::floor(x), fraction = x - below;
  if (period <= 0) return {int64_t(below), int64_t(below) + 1, fraction};
  double wrapped = below - period * std::floor(below / period);
  return {int64_t(wrapped), int64_t(std::fmod(wrapped + 1, period)), fraction};
}

constexpr uint32_t kPrimes[4] = {0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du, 0x27d4eb2fu};

uint32_t lattice_hash(uint32_t start, const std::vector<Cell>& cells, unsigned corner) {
  for (size_t i = 0; i < cells.size(); ++i)
    start ^= uint32_t(corner >> i & 1 ? cells[i].above : cells[i].below) * kPrimes[i];
  return start;
}

/// Gradient `entry` of a dimension, in units of 1/127: vertices of a 16-gon, of a dodecahedron and an
/// icosahedron, of four-dimensional boxes; half of them, the others are their opposites.
std::vector<double> gradient(size_t dimension, unsigned entry) {
  constexpr int k2[16][2] = {{126, 12}, {122, 37},  {112, 60},  {98, 81},   {81, 98},   {60, 112},
                             {37, 122}, {12, 126},  {-12, 126}, {-37, 122}, {-60, 112}, {-81, 98},
                             {-98, 81}, {-112, 60}, {-122, 37}, {-126, 12}};
  constexpr int k3[16][3] = {{73, 73, 73},  {73, 73, -73}, {73, -73, 73}, {73, -73, -73},
                             {0, 45, 119},  {45, 119, 0},  {119, 0, 45},  {0, 108, 67},
                             {108, 67, 0},  {67, 0, 108},  {0, 45, -119}, {45, -119, 0},
                             {-119, 0, 45}, {0, 108, -67}, {108, -67, 0}, {-67, 0, 108}};
  if (dimension == 2) return {double(k2[entry][0]), double(k2[entry][1])};
  if (dimension == 3) return {double(k3[entry][0]), double(k3[entry][1]), double(k3[entry][2])};
  // The long axis moves on after every four entries; signs are those of a Hadamard matrix, the last ones
  // turned round in the second half.
  std::vector<double> g(4, 41);
  const unsigned axis = entry / 4, k = entry % 4;
  g[axis] = 105;
  const int signs[4][4] = {{1, 1, 1, 1}, {1, 1, -1, -1}, {1, -1, 1, -1}, {1, -1, -1, 1}};
  for (size_t i = 0; i < 4; ++i)
    g[i] *= axis >= 2 && i == 3 ? -signs[k][i] : signs[k][i];
  return g;
}

double corner_value(uint32_t hash, const std::vector<double>& offset) {
  const size_t n = offset.size();
  // The topmost byte chooses: in one dimension a slope, else an entry and, by its first bit, the opposite.
  if (n == 1) return double(int32_t(hash & 0xff000000u)) * 0x1p-24 * offset[0] / 128;
  std::vector<double> g = gradient(n, hash >> 24 & 15);
  double sum = 0;
  for (size_t i = 0; i < n; ++i)
    sum += g[i] * offset[i];
  return (hash >> 31 ? -sum : sum) / 127;
}

/// noise and pnoise: coordinates, then periods of pnoise.
void noise(Row row, In in, Out out) {
  constexpr double kGreatest[5] = {0, 0.5, 0.7072f, 0.8661f, 0.9f}, kContrast[5] = {0, 0, 0, 0.25, 0.5};
  // A period stands behind all coordinates.
  const bool periodic = row.params[row.param_count - 1].uniform;
  const size_t n = periodic ? row.planes / 2 : row.planes;
  std::vector<Cell> cells;
  for (size_t i = 0; i < n; ++i)
    cells.push_back(cell(in[i], periodic ? std::max(1.0, std::floor(in[n + i] + 0.5)) : 0));
  for (int c = 0; c < components(row.result); ++c) {
    double sum = 0;
    for (unsigned corner = 0; corner < 1u << n; ++corner) {
      uint32_t hash = lattice_hash(0x51ed270bu * uint32_t(n), cells, corner);
      hash = (hash ^ hash >> 15) * 0x735a2d97u;
      if (c > 0) hash = (hash ^ hash >> 13) << 8 * c;
      double weight = 1;
      std::vector<double> offset;
      for (size_t i = 0; i < n; ++i) {
        const double t = cells[i].fraction, fade = t * t * t * (t * (t * 6 - 15) + 10);
        const bool above = corner >> i & 1;
        weight *= above ? fade : 1 - fade;
        offset.push_back(above ? t - 1 : t);
      }
      sum += weight * corner_value(hash, offset);
    }
    double v = sum / kGreatest[n];
    v *= 1 + kContrast[n] - kContrast[n] * v * v;
    out[c] = Expected(0.5 + 0.5 * v, 1);
  }
}

uint32_t mixed(uint32_t h) {
  h = (h ^ h >> 16) * 0x21f0aaadu;
  h = (h ^ h >> 15) * 0x735a2d97u;
  return h ^ h >> 15;
}

void cellnoise(Row row, In in, Out out) {
  std::vector<Cell> cells;
  for (size_t i = 0; i < row.planes; ++i)
    cells.push_back(cell(in[i], 0));
  const uint32_t hash = mixed(mixed(lattice_hash(0x2c1b3c6du * uint32_t(row.planes), cells, 0)));
  const uint32_t bits[3] = {hash, mixed(hash + 0x9e3779b9u), mixed(hash + 0x3c6ef372u)};
  for (int c = 0; c < components(row.result); ++c)
    out[c] = double(bits[c] >> 8) * 0x1p-24;
}

// ---- Splines

/// A segment between its four knots, by the construction each basis is defined with.
double segment(std::string_view basis, const double* k, double t) {
  auto mix = [](double a, double b, double at) { return a + (b - a) * at; };
  if (basis == "linear") return mix(k[1], k[2], t);
  if (basis == "bezier") { // de Casteljau
    double a = mix(k[0], k[1], t), b = mix(k[1], k[2], t), c = mix(k[2], k[3], t);
    return mix(mix(a, b, t), mix(b, c, t), t);
  }
  if (basis == "bspline") { // de Boor, knots at the integers
    double a = mix(k[0], k[1], (t + 2) / 3), b = mix(k[1], k[2], (t + 1) / 3), c = mix(k[2], k[3], t / 3);
    return mix(mix(a, b, (t + 1) / 2), mix(b, c, t / 2), t);
  }
  auto cubic_hermite = [t](double p, double dp, double q, double dq) {
    const double s = 1 - t;
    return p * (1 + 2 * t) * s * s + q * t * t * (3 - 2 * t) + dp * t * s * s - dq * t * t * s;
  };
  if (basis == "hermite") return cubic_hermite(k[0], k[1], k[2], k[3]);
  return cubic_hermite(k[1], (k[2] - k[0]) / 2, k[2], (k[3] - k[1]) / 2); // catmull-rom
}

void spline(Row row, In in, Out out) {
  const bool named = row.params[0].type == Type::kString;
  std::string_view basis = named ? row.strings->text(uint32_t(in[0])) : "catmull-rom";
  const bool solve = basis.starts_with("solve");
  if (solve) basis.remove_prefix(5);
  const bool counted = row.params[named ? 2 : 1].uniform;
  const size_t at_x = named ? 1 : 0, first = at_x + (counted ? 2 : 1);
  const size_t width = size_t(components(row.result));
  size_t knots = (row.planes - first) / width;
  if (counted) knots = std::min(knots, size_t(std::max(in[first - 1], 0.0)));
  if (knots < 4) {
    std::fill_n(out, width, Expected(0));
    return;
  }
  const size_t step = basis == "bezier" ? 3 : basis == "hermite" ? 2 : 1, segments = (knots - 4) / step + 1;
  auto at = [&](double x, size_t component) {
    const double along = std::clamp(x, 0.0, 1.0) * double(segments);
    const size_t s = std::min(size_t(along), segments - 1);
    double k[4];
    for (size_t i = 0; i < 4; ++i)
      k[i] = in[first + (s * step + i) * width + component];
    return segment(basis, k, along - double(s));
  };
  double magnitude = 0;
  for (size_t i = first; i < row.planes; ++i)
    magnitude = std::max(magnitude, std::abs(in[i]));
  for (size_t c = 0; c < width; ++c)
    out[c] = Expected(at(in[at_x], c), 4 * magnitude);
  // The inverse is tested for rising knots (spline_test.cpp): random ones have none.
  if (solve && width == 1) out[0] = Expected(0, 1e9);
}

// ---- Colour spaces

using Color = std::array<double, 3>;

Color linear(const double (&m)[3][3], Color c) {
  Color out;
  for (size_t i = 0; i < 3; ++i)
    out[i] = m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2];
  return out;
}
constexpr double kXyz[3][3] = {
    {0.4123908, 0.3575843, 0.1804808}, {0.2126390, 0.7151687, 0.0721923}, {0.0193308, 0.1191948, 0.9505322}};
constexpr double kRgbOfXyz[3][3] = {{3.2409699, -1.5373832, -0.4986108},
                                    {-0.9692436, 1.8759675, 0.0415551},
                                    {0.0556301, -0.2039770, 1.0569715}};

/// Smith 1978, one sector of the hexcone after the other.
Color rgb_of_hsv(Color c) {
  const double turn = (c[0] - std::floor(c[0])) * 6, f = turn - std::floor(turn);
  const double v = c[2], p = v * (1 - c[1]), q = v * (1 - c[1] * f), t = v * (1 - c[1] * (1 - f));
  switch (int(turn)) {
  case 0: return {v, t, p};
  case 1: return {q, v, p};
  case 2: return {p, v, t};
  case 3: return {p, q, v};
  case 4: return {t, p, v};
  default: return {v, p, q};
  }
}
Color hsv_of_rgb(Color c) {
  const double most = std::max({c[0], c[1], c[2]}), least = std::min({c[0], c[1], c[2]}),
               range = most - least;
  if (!(range > 0)) return {0, 0, most};
  double sixth = c[0] == most   ? (c[1] - c[2]) / range
                 : c[1] == most ? 2 + (c[2] - c[0]) / range
                                : 4 + (c[0] - c[1]) / range;
  const double hue = sixth / 6;
  return {hue - std::floor(hue), most != 0 ? range / most : 0, most};
}

Color to_rgb(std::string_view space, Color c) {
  if (space == "hsv") return rgb_of_hsv(c);
  return space == "XYZ" ? linear(kRgbOfXyz, c) : c;
}
Color from_rgb(std::string_view space, Color c) {
  if (space == "hsv") return hsv_of_rgb(c);
  return space == "XYZ" ? linear(kXyz, c) : c;
}

/// The spaces the random texts name; color_test.cpp has the others.
void ctransform(Row row, In in, Out out) {
  const bool from_given = row.param_count == 3;
  std::string_view from = from_given ? row.strings->text(uint32_t(in[0])) : "rgb",
                   to = row.strings->text(uint32_t(in[from_given ? 1 : 0]));
  const double* v = in + (from_given ? 2 : 1);
  const Color c{v[0], v[1], v[2]}, between = to_rgb(from, c), result = from == to ? c : from_rgb(to, between);
  double size = 0;
  for (size_t i = 0; i < 3; ++i)
    size = std::max({size, std::abs(c[i]), std::abs(between[i])});
  // Hue and saturation amplify rounding where the others almost cancel.
  const double range =
      std::max({between[0], between[1], between[2]}) - std::min({between[0], between[1], between[2]});
  const double most = std::abs(std::max({between[0], between[1], between[2]}));
  const bool hexcone = to == "hsv" && from != "hsv";
  for (size_t i = 0; i < 3; ++i) {
    double magnitude = 4 * size;
    if (hexcone && i == 0) magnitude = range > 1e-3 * size ? size / range : 1e9;
    if (hexcone && i == 1) magnitude = most > 1e-3 * size ? size * size / (most * most) + range / most : 1e9;
    out[i] = Expected(result[i], magnitude);
  }
  // A hue just below 1 and one just above 0 are the same.
  if (hexcone && (result[0] < 1e-6 || result[0] > 1 - 1e-6)) out[0] = Expected(result[0], 1e9);
}

constexpr Reference kPatterns[] = {
    {"noise", -1, noise},
    {"pnoise", -1, noise, -20, 20},
    {"cellnoise", -1, cellnoise, -100, 100},
    {"spline", -1, spline, 0, 1.1},
    {"ctransform", -1, ctransform, 0, 1},
};

} // namespace

std::span<const Reference> pattern_references() {
  return kPatterns;
}

} // namespace slvm::test
