// Regions become places to look at, and places texels, as many at a time as the processor has lanes.
#include "render/texture/texture_filter.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/texture/texture_filter.cpp"
#include <hwy/foreach_target.h>

#include "render/texture/wide_block.h"
#include "slvm/wide/targets.h"

#include <hwy/contrib/math/math-inl.h>

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// A texel of a level is a box as wide as itself, bilinear interpolation a tent of twice that: together they
/// spread as a box does that is wider by this.
constexpr float kSpread = 1.7320508f;
constexpr size_t kSums = TextureFilter::kSums;

HWY_INLINE V square(V x) {
  return hn::Mul(x, x);
}

HWY_INLINE auto is_finite(V x) {
  return hn::Eq(hn::Sub(x, x), hn::Zero(kWide));
}

/// How many places of a level have the spread of the longest axis, and how far apart.
HWY_INLINE void spread_places(V longest, I level, V most, size_t i, TexturePlaces& out, size_t k) {
  const V texel = hn::BitCast(kWide, hn::ShiftLeft<23>(hn::Add(level, hn::Set(kWideInt, 127)))),
          one = number(1);
  const V rest =
      hn::Sqrt(hn::Max(hn::Sub(square(longest), square(hn::Mul(texel, number(kSpread)))), hn::Zero(kWide)));
  const V places = hn::Min(hn::Max(hn::Ceil(hn::Add(hn::Div(rest, texel), number(0.5f))), one), most);
  const V whole = hn::Mul(longest, hn::Sqrt(hn::Sub(one, hn::Div(one, square(places)))));
  hn::Store(places, kWide, out.in[k].places + i);
  hn::Store(hn::IfThenElseZero(hn::Gt(places, one), hn::Div(rest, whole)), kWide, out.in[k].scale + i);
  hn::Store(level, kWideInt, out.in[k].level + i);
}

void find_places(const TextureRegions& r, const TextureFilter::Limits& limits, TexturePlaces& out) {
  const V zero = hn::Zero(kWide), one = number(1), half = number(0.5f);
  const V width = number(limits.width), height = number(limits.height);
  for (size_t i = 0; i < TextureRegions::kBlock; i += kLanes) {
    auto sides = [&](const float* u, const float* v, V size, V(&side)[2]) HWY_ATTR {
      side[0] = hn::Mul(hn::Load(kWide, u + i), size);
      side[1] = hn::Mul(hn::Load(kWide, v + i), size);
    };
    V s[2], t[2];
    sides(r.s_u, r.s_v, width, s);
    sides(r.t_u, r.t_v, height, t);
    V ss = hn::Add(hn::Add(square(s[0]), square(s[1])), square(hn::Mul(hn::Load(kWide, r.sblur + i), width))),
      tt =
          hn::Add(hn::Add(square(t[0]), square(t[1])), square(hn::Mul(hn::Load(kWide, r.tblur + i), height))),
      st = hn::Add(hn::Mul(s[0], t[0]), hn::Mul(s[1], t[1]));
    // In parts of the largest: squares of large numbers would be too large. What is no number is a point.
    V most = hn::Max(hn::Max(ss, tt), hn::Abs(st));
    const auto is_region = hn::And(is_finite(hn::Add(ss, tt)), is_finite(st));
    most = hn::Min(hn::IfThenElse(hn::And(is_region, hn::Gt(most, zero)), most, one), number(1e36f));
    ss = hn::IfThenElseZero(is_region, hn::Div(ss, most));
    tt = hn::IfThenElseZero(is_region, hn::Div(tt, most));
    st = hn::IfThenElseZero(is_region, hn::Div(st, most));
    const V differ = hn::Mul(half, hn::Sub(ss, tt)), off = hn::Sqrt(hn::Add(square(differ), square(st)));
    const V longest = hn::Sqrt(hn::Mul(most, hn::Add(hn::Mul(half, hn::Add(ss, tt)), off)));
    // By the determinant: the difference of large numbers would leave rounding errors.
    const V area = hn::Mul(most, hn::Sqrt(hn::Max(hn::Sub(hn::Mul(ss, tt), square(st)), zero)));
    const V shortest = hn::IfThenElseZero(hn::Gt(longest, zero), hn::Div(area, longest));
    const auto along_s = hn::Ge(differ, zero);
    const V x = hn::IfThenElse(along_s, hn::Add(differ, off), st),
            y = hn::IfThenElse(along_s, st, hn::Sub(off, differ));
    const V length = hn::Sqrt(hn::Add(square(x), square(y)));
    const V scale = hn::IfThenElseZero(hn::Gt(length, zero), hn::Div(hn::Mul(half, longest), length));
    hn::Store(hn::Div(hn::Mul(x, scale), width), kWide, out.s + i);
    hn::Store(hn::Div(hn::Mul(y, scale), height), kWide, out.t + i);
    hn::Store(longest, kWide, out.longest + i);

    // Up to half of the usual number of places a stretch needs no more of them.
    const V more = hn::Max(hn::Mul(hn::Load(kWide, r.stretch + i), number(0.125f)), one);
    const V places = hn::Min(hn::Mul(more, number(limits.most_places)), number(limits.most_stretched));
    const V texel = hn::Max(hn::Max(hn::Div(shortest, number(kSpread)), hn::Div(longest, places)), one);
    const V level = hn::Min(hn::Max(hn::Log2(kWide, texel), zero), number(limits.last_level));
    V lower = hn::Floor(limits.between_levels ? level : hn::Add(level, half));
    const V part = limits.between_levels ? hn::Sub(level, lower) : zero;
    const I first = hn::ConvertTo(kWideInt, lower);
    hn::Store(hn::Sub(one, part), kWide, out.in[0].weight + i);
    hn::Store(part, kWide, out.in[1].weight + i);
    spread_places(longest, first, places, i, out, 0);
    spread_places(longest, hn::Add(first, hn::Set(kWideInt, 1)), places, i, out, 1);
  }
}

/// The texels along one axis that an interpolation looks at.
struct Taps {
  size_t count = 0;
  I at[4];
  V weight[4];

  HWY_INLINE void add(I i, V part, int size, TextureWrap wrap) {
    const I zero = hn::Zero(kWideInt), all = hn::Set(kWideInt, size), last = hn::Set(kWideInt, size - 1);
    if (wrap == TextureWrap::kBlack)
      part = hn::IfThenZeroElse(hn::RebindMask(kWide, hn::Or(hn::Lt(i, zero), hn::Gt(i, last))), part);
    if (wrap == TextureWrap::kPeriodic) { // at most two beyond a side; for sides of one texel see below
      i = hn::Add(i, hn::IfThenElseZero(hn::Lt(i, zero), all));
      i = hn::Sub(i, hn::IfThenElseZero(hn::Gt(i, last), all));
    }
    at[count] = hn::Min(hn::Max(i, zero), last);
    weight[count++] = part;
  }
};

/// `x`: in texels, whose middles are at halves.
HWY_INLINE Taps taps(Interpolation way, V x, int size, TextureWrap wrap) {
  Taps out;
  const V whole = number(static_cast<float>(size)), one = number(1);
  // Far beyond the image all places are alike but for those that repeat.
  if (wrap == TextureWrap::kPeriodic) x = hn::Sub(x, hn::Mul(hn::Floor(hn::Div(x, whole)), whole));
  x = hn::Min(hn::Max(x, number(-8)), hn::Add(whole, number(8)));
  if (way == Interpolation::kNearest) {
    out.add(hn::ConvertTo(kWideInt, hn::Floor(x)), one, size, wrap);
    return out;
  }
  x = hn::Sub(x, number(0.5f));
  const V from = hn::Floor(x), f = hn::Sub(x, from), g = hn::Sub(one, f);
  const I i = hn::ConvertTo(kWideInt, from);
  auto add = [&](int step, V weight)
                 HWY_ATTR { out.add(hn::Add(i, hn::Set(kWideInt, step)), weight, size, wrap); };
  auto cubic = [](V at, float c3, float c2, float c1, float c0) HWY_ATTR {
    const V high = hn::Add(hn::Mul(number(c3), at), number(c2));
    return hn::Add(hn::Mul(hn::Add(hn::Mul(high, at), number(c1)), at), number(c0));
  };
  switch (way) {
  case Interpolation::kBSpline:
    add(-1, cubic(g, 1.0f / 6, 0, 0, 0));
    add(0, cubic(f, 0.5f, -1, 0, 2.0f / 3));
    add(1, cubic(g, 0.5f, -1, 0, 2.0f / 3));
    add(2, cubic(f, 1.0f / 6, 0, 0, 0));
    break;
  case Interpolation::kCatmullRom:
    add(-1, cubic(f, -0.5f, 1, -0.5f, 0));
    add(0, cubic(f, 1.5f, -2.5f, 0, 1));
    add(1, cubic(f, -1.5f, 2, 0.5f, 0));
    add(2, cubic(f, 0.5f, -0.5f, 0, 0));
    break;
  default: add(0, g); add(1, f);
  }
  return out;
}

template <class T> HWY_INLINE V load_channel(const std::byte* const* texels, size_t channel) {
  alignas(64) float numbers[kLanes];
  for (size_t k = 0; k < kLanes; ++k) {
    T value;
    std::memcpy(&value, texels[k] + channel * sizeof(T), sizeof(T));
    numbers[k] = static_cast<float>(value);
  }
  return hn::Load(kWide, numbers);
}

/// The weight that is left where no channel is greater than the layout's limit; it is counted.
HWY_INLINE V weight_within(const TextureFilter::Layout& layout, const V (&values)[3], V weight, V& counted) {
  const V limit = number(layout.ignore_above);
  for (size_t c = 0; c < layout.channels; ++c)
    weight = hn::IfThenZeroElse(hn::Gt(values[c], limit), weight);
  counted = hn::Add(counted, weight);
  return weight;
}

/// The channels of one texel in each lane, times a weight.
HWY_INLINE void add_texels(const TextureFilter::Layout& layout, const std::byte* const* texels, V weight,
                           V (&sums)[kSums]) {
  V values[3] = {hn::Zero(kWide), hn::Zero(kWide), hn::Zero(kWide)};
  if (layout.type == PixelType::kByte) { // all channels at once
    alignas(64) uint32_t bits[kLanes];
    for (size_t k = 0; k < kLanes; ++k)
      std::memcpy(&bits[k], texels[k], sizeof bits[k]);
    const auto all = hn::Load(kWideBits, bits), byte = hn::Set(kWideBits, 255u);
    auto set = [&](size_t c, auto shifted) HWY_ATTR {
      values[c] = hn::ConvertTo(kWide, hn::BitCast(kWideInt, hn::And(shifted, byte)));
    };
    set(0, all);
    if (layout.channels > 1) set(1, hn::ShiftRight<8>(all));
    if (layout.channels > 2) set(2, hn::ShiftRight<16>(all));
    if (layout.limited) weight = weight_within(layout, values, weight, sums[3]);
  } else {
    for (size_t c = 0; c < layout.channels; ++c)
      values[c] = layout.type == PixelType::kShort ? load_channel<uint16_t>(texels, c)
                                                   : load_channel<float>(texels, c);
    if (layout.limited) weight = weight_within(layout, values, weight, sums[3]);
    for (size_t c = 0; c < layout.channels; ++c) // it may be infinite
      values[c] = hn::IfThenElseZero(hn::Ne(weight, hn::Zero(kWide)), values[c]);
  }
  for (size_t c = 0; c < layout.channels; ++c)
    sums[c] = hn::Add(sums[c], hn::Mul(weight, values[c]));
}

/// `sums`: kSums floats each.
void look_at(const TextureFilter::Layout& layout, const TextureImage::Level& level, Interpolation way,
             const TextureProbes& probes, float* sums) {
  const V width = number(static_cast<float>(level.width)), height = number(static_cast<float>(level.height));
  const size_t row_bytes = static_cast<size_t>(level.width) * layout.texel;
  for (size_t i = 0; i < probes.count; i += kLanes) {
    const Taps columns =
                   taps(way, hn::Mul(hn::LoadU(kWide, &probes.s[i]), width), level.width, layout.wrap[0]),
               rows =
                   taps(way, hn::Mul(hn::LoadU(kWide, &probes.t[i]), height), level.height, layout.wrap[1]);
    const V weight = hn::LoadU(kWide, &probes.weight[i]);
    V found[kSums] = {hn::Zero(kWide), hn::Zero(kWide), hn::Zero(kWide), hn::Zero(kWide)};
    alignas(64) int32_t row[kLanes], in_row[4][kLanes];
    for (size_t x = 0; x < columns.count; ++x)
      hn::Store(hn::Mul(columns.at[x], hn::Set(kWideInt, static_cast<int32_t>(layout.texel))), kWideInt,
                in_row[x]);
    for (size_t y = 0; y < rows.count; ++y) {
      const V of_row = hn::Mul(weight, rows.weight[y]);
      const std::byte *starts[kLanes], *texels[kLanes];
      hn::Store(rows.at[y], kWideInt, row);
      for (size_t k = 0; k < kLanes; ++k)
        starts[k] = level.texels + layout.first + static_cast<size_t>(row[k]) * row_bytes;
      for (size_t x = 0; x < columns.count; ++x) {
        for (size_t k = 0; k < kLanes; ++k)
          texels[k] = starts[k] + in_row[x][k];
        add_texels(layout, texels, hn::Mul(of_row, columns.weight[x]), found);
      }
    }
    auto add = [&](size_t c) HWY_ATTR {
      alignas(64) float channel[kLanes];
      hn::Store(found[c], kWide, channel);
      for (size_t k = 0; k < kLanes; ++k)
        sums[kSums * probes.sum[i + k] + c] += channel[k];
    };
    for (size_t c = 0; c < layout.channels; ++c)
      add(c);
    if (layout.limited) add(3);
  }
}

} // namespace HWY_NAMESPACE
} // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace render {

const auto kFindPlaces = SL_BEST(find_places);
const auto kLookAt = SL_BEST(look_at);

TextureFilter::TextureFilter(const TextureImage& image, const slvm::TextureLookup& lookup, TextureWrap swrap,
                             TextureWrap twrap)
    : image_(image), channels_(lookup.channels), probes_(image.levels() + 1) {
  const TextureHeader& header = image.header();
  const slvm::TextureOptions& o = lookup.options;
  const auto there = static_cast<size_t>(header.channels), first = static_cast<size_t>(lookup.first_channel);
  layout_ = {there * bytes_of(header.type),
             first * bytes_of(header.type),
             first < there ? std::min(channels_, there - first) : 0,
             header.type,
             {swrap, twrap}};
  fill_ = o.fill;
  one_ = header.type == PixelType::kByte ? 255.0f : header.type == PixelType::kShort ? 65535.0f : 1.0f;
  layout_.limited = o.ignore_above < std::numeric_limits<float>::infinity();
  layout_.ignore_above = o.ignore_above * one_;
  one_sample_ = o.samples == 1;
  constexpr float kMostPlaces = 16, kMostStretched = 128;
  limits_ = {static_cast<float>(header.levels[0].width),
             static_cast<float>(header.levels[0].height),
             o.samples >= 1 ? std::min(std::floor(o.samples), 256.0f) : kMostPlaces,
             o.samples >= 1 ? std::min(std::floor(o.samples), 256.0f) : kMostStretched,
             static_cast<float>(image.levels() - 1),
             o.between_levels};
  gaussian_ = o.filter == "gaussian";
  triangle_ = o.filter == "triangle";
  interpolation_ = gaussian_                   ? Interpolation::kBSpline
                   : o.filter == "catmull-rom" ? Interpolation::kCatmullRom
                                               : Interpolation::kBilinear;
}

float TextureFilter::shape(float x) const {
  return gaussian_ ? std::exp(-2 * x * x) : triangle_ ? 1 - std::abs(x) : 1.0f;
}

/// The places along the long axis of one region, in both levels.
void TextureFilter::add_probes(const TextureRegions& r, const TexturePlaces& places, uint32_t lane) {
  if (one_sample_ && places.longest[lane] == 0) {
    TextureProbes& probes = probes_.back();
    const size_t at = probes.add(1);
    probes.s[at] = r.s[lane];
    probes.t[at] = r.t[lane];
    probes.weight[at] = 1 / one_;
    probes.sum[at] = lane;
    return;
  }
  for (uint32_t k = 0; k < 2; ++k) {
    const auto& in = places.in[k];
    if (!(in.weight[lane] > 0)) continue;
    TextureProbes& probes = probes_[static_cast<size_t>(in.level[lane])];
    const float places_there = in.places[lane], s = in.scale[lane] * places.s[lane],
                t = in.scale[lane] * places.t[lane];
    const auto count = static_cast<size_t>(places_there), first = probes.add(count);
    float *at_s = &probes.s[first], *at_t = &probes.t[first], *weight = &probes.weight[first];
    const float step = 2 / places_there;
    float sum = places_there;
    for (size_t i = 0; i < count; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) * step - 1;
      at_s[i] = r.s[lane] + x * s;
      at_t[i] = r.t[lane] + x * t;
    }
    std::fill_n(&probes.sum[first], count, static_cast<uint32_t>(k * kBlock) + lane);
    std::fill_n(weight, count, 1.0f);
    if (gaussian_ || triangle_) {
      sum = 0;
      for (size_t i = 0; i < count; ++i)
        sum += weight[i] = shape((static_cast<float>(i) + 0.5f) * step - 1);
    }
    const float part = in.weight[lane] / (sum * one_);
    for (size_t i = 0; i < count; ++i)
      weight[i] *= part;
  }
}

bool TextureFilter::means(const TextureRegions& regions, uint32_t active, Means& out) {
  for (uint32_t rest = active; rest != 0; rest &= rest - 1)
    if (const int lane = std::countr_zero(rest);
        !std::isfinite(regions.s[lane]) || !std::isfinite(regions.t[lane]))
      active &= ~(1u << lane);
  TexturePlaces places;
  kFindPlaces(regions, limits_, places);
  for (uint32_t rest = active; rest != 0; rest &= rest - 1)
    add_probes(regions, places, static_cast<uint32_t>(std::countr_zero(rest)));
  float sums[2 * kBlock + 1][kSums] = {}; // of each region in either of its levels, and of nobody
  bool read = true;
  for (size_t i = 0; i < probes_.size(); ++i) {
    TextureProbes& probes = probes_[i];
    if (probes.count == 0) continue;
    const bool nearest = i == image_.levels();
    const TextureImage::Level level = image_.level(nearest ? 0 : i);
    read = read && level.texels;
    if (read) kLookAt(layout_, level, nearest ? Interpolation::kNearest : interpolation_, probes, sums[0]);
    probes.clear();
  }
  auto sum = [&](size_t lane, size_t c) { return sums[lane][c] + sums[kBlock + lane][c]; };
  auto mean = [&](size_t lane, size_t c) {
    if (!layout_.limited) return sum(lane, c); // weights add up to 1
    const float counted = sum(lane, 3) * one_;
    return counted > 0 ? sum(lane, c) / counted : 0.0f;
  };
  for (size_t c = 0; c < channels_; ++c)
    for (size_t lane = 0; lane < kBlock; ++lane)
      out[c][lane] = c < layout_.channels ? mean(lane, c) : active >> lane & 1 ? fill_ : 0.0f;
  return read;
}

} // namespace render
#endif
