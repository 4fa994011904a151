// Colour spaces: ctransform (RISpec 3.2, 15.3). A conversion goes through rgb, the working space. Spaces are
// named by uniform strings, looked up once per call; an unknown name leaves the colour as it is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slvm/kernels/color.cpp"
#include <hwy/foreach_target.h>

#include "slvm/wide/lanes.h"

#include "slvm/kernels/color_space.h"
#include "slvm/kernels/rows.h"

HWY_BEFORE_NAMESPACE();
namespace slvm {
namespace HWY_NAMESPACE {

// ---- Linear spaces
/// Rows of a 3x3 matrix that is applied to column vectors.
struct Linear {
  float row[3][3];
};
/// NTSC, with the coefficients RISpec's time used.
constexpr Linear kYiqOfRgb{{{0.299f, 0.587f, 0.114f}, {0.596f, -0.274f, -0.322f}, {0.212f, -0.523f, 0.311f}}};
constexpr Linear kRgbOfYiq{{{1.0f, 0.954889204f, 0.622103935f},
                            {1.0f, -0.271354783f, -0.647512026f},
                            {1.0f, -1.107251005f, 1.702460374f}}};
/// Primaries of ITU-R BT.709, white point D65.
constexpr Linear kXyzOfRgb{{{0.4123908f, 0.3575843f, 0.1804808f},
                            {0.2126390f, 0.7151687f, 0.0721923f},
                            {0.0193308f, 0.1191948f, 0.9505322f}}};
constexpr Linear kRgbOfXyz{{{3.2409699f, -1.5373832f, -0.4986108f},
                            {-0.9692436f, 1.8759675f, 0.0415551f},
                            {0.0556301f, -0.2039770f, 1.0569715f}}};

HWY_INLINE Vec3 apply(const Linear& m, Vec3 c) {
  auto row = [&](int i) HWY_ATTR { return c.x * m.row[i][0] + c.y * m.row[i][1] + c.z * m.row[i][2]; };
  return {row(0), row(1), row(2)};
}

HWY_INLINE Vec3 xyy_of_xyz(Vec3 c) {
  Float sum = c.x + c.y + c.z;
  Bool lit = sum != 0.0f;
  return {keep_if(lit, c.x / sum), keep_if(lit, c.y / sum), c.y};
}
HWY_INLINE Vec3 xyz_of_xyy(Vec3 c) {
  Bool lit = c.y != 0.0f;
  return {keep_if(lit, c.x * c.z / c.y), keep_if(lit, c.z), keep_if(lit, (1.0f - c.x - c.y) * c.z / c.y)};
}

// ---- Hexcone spaces (Smith 1978): hue in [0, 1), 0 for greys
struct Hexcone {
  Float hue, most, least;
};
HWY_INLINE Hexcone hexcone_of_rgb(Vec3 c) {
  Float most = max(c.x, max(c.y, c.z)), least = min(c.x, min(c.y, c.z));
  Float range = most - least;
  Float sixth = select(c.x == most, (c.y - c.z) / range,
                       select(c.y == most, 2.0f + (c.z - c.x) / range, 4.0f + (c.x - c.y) / range));
  Float hue = sixth * (1.0f / 6.0f);
  return {keep_if(range > 0.0f, hue - floor(hue)), most, least};
}
HWY_INLINE Vec3 hsv_of_rgb(Vec3 c) {
  Hexcone h = hexcone_of_rgb(c);
  return {h.hue, keep_if(h.most != 0.0f, (h.most - h.least) / h.most), h.most};
}
HWY_INLINE Vec3 hsl_of_rgb(Vec3 c) {
  Hexcone h = hexcone_of_rgb(c);
  Float sum = h.most + h.least, range = h.most - h.least;
  Float saturation = range / select(sum > 1.0f, 2.0f - sum, sum);
  return {h.hue, keep_if(range != 0.0f, saturation), 0.5f * sum};
}
/// The trapezoid wave, of period 6, that each component follows as the hue turns: 0 at `phase`, 1 from 1 to 3
/// after it.
HWY_INLINE Float hue_wave(Float hue, float phase) {
  Float turn = hue + phase / 6.0f;
  Float k = 6.0f * (turn - floor(turn));
  return clamp(min(k, 4.0f - k), 0.0f, 1.0f);
}
HWY_INLINE Vec3 hue_waves(Float hue) {
  return {hue_wave(hue, 5.0f), hue_wave(hue, 3.0f), hue_wave(hue, 1.0f)};
}
HWY_INLINE Vec3 rgb_of_hsv(Vec3 c) {
  return (Vec3(1.0f) - hue_waves(c.x) * c.y) * c.z;
}
HWY_INLINE Vec3 rgb_of_hsl(Vec3 c) {
  Float chroma = 2.0f * c.y * min(c.z, 1.0f - c.z);
  return (Vec3(0.5f) - hue_waves(c.x)) * chroma + Vec3(c.z);
}

// ---- Conversions
HWY_INLINE Vec3 to_rgb(ColorSpace space, Vec3 c) {
  switch (space) {
  case ColorSpace::kHsv: return rgb_of_hsv(c);
  case ColorSpace::kHsl: return rgb_of_hsl(c);
  case ColorSpace::kYiq: return apply(kRgbOfYiq, c);
  case ColorSpace::kXyz: return apply(kRgbOfXyz, c);
  case ColorSpace::kXyy: return apply(kRgbOfXyz, xyz_of_xyy(c));
  case ColorSpace::kRgb: break;
  }
  return c;
}
HWY_INLINE Vec3 from_rgb(ColorSpace space, Vec3 c) {
  switch (space) {
  case ColorSpace::kHsv: return hsv_of_rgb(c);
  case ColorSpace::kHsl: return hsl_of_rgb(c);
  case ColorSpace::kYiq: return apply(kYiqOfRgb, c);
  case ColorSpace::kXyz: return apply(kXyzOfRgb, c);
  case ColorSpace::kXyy: return xyy_of_xyz(apply(kXyzOfRgb, c));
  case ColorSpace::kRgb: break;
  }
  return c;
}

inline void convert_colors(const Operand& result, const Operand& color, ColorSpace from, ColorSpace to,
                           size_t lanes) {
  for (size_t lane = 0; lane < lanes; lane += kWidth)
    store(result, lane,
          from == to ? loaded<Vec3>(color, lane) : from_rgb(to, to_rgb(from, loaded<Vec3>(color, lane))));
}
inline void ctransform_to(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  convert_colors(o[0], o[2], ColorSpace::kRgb, color_space(o[1], context), lanes);
}
inline void ctransform_from_to(const Operand* o, uint32_t, size_t lanes, const KernelContext& context) {
  convert_colors(o[0], o[3], color_space(o[1], context), color_space(o[2], context), lanes);
}

#define SL_FAMILY fill_color
#include "slvm/kernels/rows.inc"
#undef SL_FAMILY

} // namespace HWY_NAMESPACE
} // namespace slvm
HWY_AFTER_NAMESPACE();
