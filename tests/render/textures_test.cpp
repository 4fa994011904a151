// Textures: what is read of files, and means over regions beside sums over the texels.
#include "render/texture/texture_filter.h"
#include "render/texture/texture_lookups.h"
#include "render/texture/texture_png.h"
#include "render/texture/texture_tiff.h"
#include "slvm/support/tiff_open.h"
#include "tests/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <functional>
#include <random>

namespace render::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// An image in memory, of one channel unless `channels` says more.
class Made : public TextureReader {
public:
  using Function = std::function<float(int x, int y, int c)>;
  Made(int width, int height, Function f, int channels = 1) : f_(std::move(f)) {
    header_.levels = {{width, height}};
    header_.channels = channels;
    header_.type = PixelType::kFloat;
  }
  std::string read(size_t, std::span<std::byte> texels) override {
    auto* to = reinterpret_cast<float*>(texels.data());
    for (int y = 0; y < header_.levels[0].height; ++y)
      for (int x = 0; x < header_.levels[0].width; ++x)
        for (int c = 0; c < header_.channels; ++c)
          *to++ = f_(x, y, c);
    return {};
  }

private:
  Function f_;
};

struct Region {
  float s, t, s_u, t_u, s_v, t_v;
  float sblur = 0, tblur = 0;
};

class Filter : public ::testing::Test {
protected:
  void make(int width, int height, Made::Function f, int channels = 1) {
    image_ = std::make_unique<TextureImage>(std::make_unique<Made>(width, height, std::move(f), channels),
                                            memory_);
    lookup_.channels = 1;
  }
  /// In every lane the same.
  float mean(const Region& region) const {
    TextureFilter::Means out;
    EXPECT_TRUE(TextureFilter(*image_, lookup_, swrap_, twrap_).means(everywhere(region), 0xffff, out));
    for (const float other : out[0])
      EXPECT_EQ(other, out[0][0]);
    return out[0][0];
  }
  static TextureRegions everywhere(const Region& r) {
    TextureRegions out;
    for (size_t i = 0; i < TextureRegions::kBlock; ++i)
      put(r, i, out);
    return out;
  }
  static void put(const Region& r, size_t i, TextureRegions& out) {
    out.s[i] = r.s, out.t[i] = r.t;
    out.s_u[i] = r.s_u, out.t_u[i] = r.t_u, out.s_v[i] = r.s_v, out.t_v[i] = r.t_v;
    out.sblur[i] = r.sblur, out.tblur[i] = r.tblur;
  }
  static float noise(int x, int y, int) {
    const double s = std::sin(x * 12.9898 + y * 78.233) * 43758.5453;
    return static_cast<float>(s - std::floor(s));
  }

  std::atomic<long long> memory_{0};
  std::unique_ptr<TextureImage> image_;
  slvm::TextureLookup lookup_;
  TextureWrap swrap_ = TextureWrap::kPeriodic, twrap_ = TextureWrap::kPeriodic;
};

TEST_F(Filter, points_are_interpolated_between_the_middles_of_texels) {
  make(8, 4, [](int x, int y, int) { return static_cast<float>(x + 10 * y); });
  EXPECT_FLOAT_EQ(mean({3.5f / 8, 1.5f / 4, 0, 0, 0, 0}), 13);
  EXPECT_FLOAT_EQ(mean({4 / 8.0f, 1.5f / 4, 0, 0, 0, 0}), 13.5f);
  EXPECT_FLOAT_EQ(mean({3.5f / 8, 2 / 4.0f, 0, 0, 0, 0}), 18);
  lookup_.options.samples = 1;
  EXPECT_FLOAT_EQ(mean({3.9f / 8, 1.9f / 4, 0, 0, 0, 0}), 13);
}

TEST_F(Filter, wraps) {
  make(4, 4, [](int x, int, int) { return static_cast<float>(x + 1); });
  const Region left{-0.5f / 4, 0.5f, 0, 0, 0, 0}, right{9.5f / 4, 0.5f, 0, 0, 0, 0};
  EXPECT_FLOAT_EQ(mean(left), 4);
  EXPECT_FLOAT_EQ(mean(right), 2);
  swrap_ = TextureWrap::kClamp;
  EXPECT_FLOAT_EQ(mean(left), 1);
  EXPECT_FLOAT_EQ(mean(right), 4);
  EXPECT_FLOAT_EQ(mean({1e30f, 0.5f, 0, 0, 0, 0}), 4);
  swrap_ = TextureWrap::kBlack;
  EXPECT_FLOAT_EQ(mean(left), 0);
  EXPECT_FLOAT_EQ(mean({0, 0.5f, 0, 0, 0, 0}), 0.5f); // half of the first texel, half of nothing
}

/// The mean of the texels by the shape of a region: a parallelogram, each point of it as good as another.
float brute_force(int size, const Made::Function& f, const Region& r) {
  constexpr int kSide = 200;
  double sum = 0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const float a = (static_cast<float>(i) + 0.5f) / kSide - 0.5f,
                  b = (static_cast<float>(j) + 0.5f) / kSide - 0.5f;
      const float s = r.s + a * r.s_u + b * r.s_v, t = r.t + a * r.t_u + b * r.t_v;
      auto cell = [&](float x) {
        const int k = static_cast<int>(std::floor(x * static_cast<float>(size))) % size;
        return k < 0 ? k + size : k;
      };
      sum += static_cast<double>(f(cell(s), cell(t), 0));
    }
  return static_cast<float>(sum / (kSide * kSide));
}

// Pictures with large parts, as means over regions tell them apart.
TEST_F(Filter, regions_are_near_the_mean_of_their_texels) {
  constexpr int kSize = 128;
  const Made::Function waves = [](int x, int y, int) {
    return 0.5f + 0.25f * std::sin(static_cast<float>(x) * 0.098f) +
           0.25f * std::cos(static_cast<float>(y) * 0.147f);
  };
  make(kSize, kSize, waves);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0, 1), angle(0, 6.28f), side(0.01f, 0.3f);
  double worst = 0, squares = 0;
  constexpr int kTrials = 300;
  for (int k = 0; k < kTrials; ++k) {
    const float a = angle(random), u = side(random), v = side(random);
    const Region r{place(random),   place(random),    u * std::cos(a),
                   u * std::sin(a), -v * std::sin(a), v * std::cos(a)};
    const double error = static_cast<double>(mean(r) - brute_force(kSize, waves, r));
    worst = std::max(worst, std::abs(error));
    squares += error * error;
  }
  EXPECT_LT(std::sqrt(squares / kTrials), 0.015);
  EXPECT_LT(worst, 0.08);
}

TEST_F(Filter, what_is_smaller_than_the_region_averages_out) {
  make(256, 256, noise);
  for (const float side : {0.25f, 0.5f, 1.0f})
    for (const float s : {0.1f, 0.4f, 0.77f})
      EXPECT_NEAR(mean({s, 0.3f, side, 0, 0, side}), 0.5f, 0.03f) << side;
}

// Along a side of a long region there is nothing to be averaged but what it lies on.
TEST_F(Filter, long_regions_do_not_blur_across) {
  make(128, 128, [](int, int y, int) { return y % 64 < 32 ? 1.0f : 0.0f; });
  EXPECT_NEAR(mean({0.5f, 30 / 128.0f, 0.12f, 0, 0, 1 / 128.0f}), 1, 0.02f);
  EXPECT_NEAR(mean({0.5f, 34 / 128.0f, 0.12f, 0, 0, 1 / 128.0f}), 0, 0.02f);
  EXPECT_NEAR(mean({0.5f, 32 / 128.0f, 0.12f, 0, 0, 1 / 128.0f}), 0.5f, 0.02f);
  lookup_.options.samples = 1; // as wide across as along
  EXPECT_LT(mean({0.5f, 30 / 128.0f, 0.12f, 0, 0, 1 / 128.0f}), 0.85f);
}

TEST_F(Filter, blur_is_a_region_of_its_own) {
  make(128, 128, [](int x, int, int) { return x < 64 ? 1.0f : 0.0f; });
  swrap_ = TextureWrap::kClamp;
  auto at = [&](float s, float blur) { return mean({s, 0.5f, 0, 0, 0, 0, blur, 0}); };
  EXPECT_NEAR(at(0.5f, 0.25f), 0.5f, 0.02f);
  // The edge as wide as the blur: a box of it, with soft ends.
  for (const float s : {0.40f, 0.45f, 0.55f, 0.60f})
    EXPECT_NEAR(at(s, 0.25f), 0.5f - (s - 0.5f) / 0.25f, 0.04f) << s;
  EXPECT_NEAR(at(0.3f, 0.25f), 1, 0.01f);
  EXPECT_NEAR(mean({0.45f, 0.5f, 0, 0, 0, 0, 0, 0.25f}), 1, 0.01f); // along t nothing changes
}

TEST_F(Filter, ramps_stay_what_they_are_under_all_filters) {
  make(64, 64, [](int x, int y, int) {
    return (static_cast<float>(x) + 0.5f) / 64 + (static_cast<float>(y) + 0.5f) / 32;
  });
  for (const char* name : {"", "box", "disk", "triangle", "gaussian", "catmull-rom"}) {
    lookup_.options.filter = name;
    EXPECT_NEAR(mean({0.43f, 0.51f, 0, 0, 0, 0}), 0.43f + 2 * 0.51f, 1e-4f) << name;
    EXPECT_NEAR(mean({0.43f, 0.51f, 0.1f, 0.05f, -0.02f, 0.1f}), 0.43f + 2 * 0.51f, 1e-3f) << name;
  }
}

TEST_F(Filter, cubic_filters_at_the_middle_of_a_texel) {
  make(16, 16, [](int x, int y, int) { return x == 8 && y == 8 ? 1.0f : 0.0f; });
  const Region texel{8.5f / 16, 8.5f / 16, 0, 0, 0, 0}, beside{9.5f / 16, 8.5f / 16, 0, 0, 0, 0};
  lookup_.options.filter = "catmull-rom";
  EXPECT_NEAR(mean(texel), 1, 1e-6f);
  EXPECT_NEAR(mean(beside), 0, 1e-6f);
  lookup_.options.filter = "gaussian"; // a cubic B-spline: 2/3 and 1/6 along each axis
  EXPECT_NEAR(mean(texel), 4.0f / 9, 1e-6f);
  EXPECT_NEAR(mean(beside), 1.0f / 9, 1e-6f);
}

TEST_F(Filter, channels_that_are_not_there_are_filled) {
  make(
      4, 4, [](int, int, int c) { return static_cast<float>(c + 1); }, 2);
  lookup_.channels = 3;
  lookup_.first_channel = 1;
  lookup_.options.fill = 0.25f;
  TextureFilter::Means out;
  const TextureRegions regions = everywhere({0.5f, 0.5f, 0, 0, 0, 0});
  EXPECT_TRUE(TextureFilter(*image_, lookup_, swrap_, twrap_).means(regions, 0xffff, out));
  EXPECT_THAT((std::array{out[0][5], out[1][5], out[2][5]}), ElementsAre(2, 0.25f, 0.25f));
}

// Bit by bit: a picture must not depend on how its points are grouped.
TEST_F(Filter, regions_do_not_depend_on_their_neighbours) {
  make(64, 32, noise);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1, 2), side(-0.2f, 0.2f);
  for (const char* name : {"", "triangle", "gaussian", "catmull-rom"}) {
    lookup_.options.filter = name;
    TextureRegions regions;
    std::vector<Region> each;
    for (size_t i = 0; i < TextureRegions::kBlock; ++i) {
      each.push_back({place(random), place(random), side(random), side(random), side(random), side(random)});
      put(each.back(), i, regions);
    }
    TextureFilter::Means all, some;
    TextureFilter filter(*image_, lookup_, swrap_, twrap_);
    EXPECT_TRUE(filter.means(regions, 0xffff, all));
    EXPECT_TRUE(filter.means(regions, 0x8421, some));
    for (size_t i = 0; i < TextureRegions::kBlock; ++i) {
      EXPECT_EQ(all[0][i], mean(each[i])) << name << i;
      if (0x8421 >> i & 1) {
        EXPECT_EQ(all[0][i], some[0][i]) << name << i;
      }
    }
  }
}

// Texels that are infinite do not spread to where they have no part.
TEST_F(Filter, infinite_texels_stay_where_they_are) {
  make(8, 8, [](int x, int, int) { return x < 4 ? 1.0f : INFINITY; });
  EXPECT_EQ(mean({3.5f / 8, 0.5f, 0, 0, 0, 0}), 1);
  EXPECT_EQ(mean({4.5f / 8, 0.5f, 0, 0, 0, 0}), INFINITY);
}

TEST_F(Filter, regions_that_are_no_numbers_are_points) {
  make(4, 4, [](int x, int, int) { return static_cast<float>(x); });
  const float nan = std::nanf("");
  EXPECT_FLOAT_EQ(mean({1.5f / 4, 0.5f, nan, 0, 0, INFINITY}), 1);
  EXPECT_FLOAT_EQ(mean({1.5f / 4, 0.5f, 1e30f, 0, 0, 0}), 1);
  EXPECT_EQ(mean({nan, 0.5f, 0, 0, 0, 0}), 0); // nowhere
}

TEST(TextureLevels, odd_sizes_keep_the_mean) {
  std::atomic<long long> memory{0};
  {
    TextureImage image(
        std::make_unique<Made>(7, 5, [](int x, int y, int) { return static_cast<float>(x * y); }), memory);
    ASSERT_EQ(image.levels(), 3u); // 7 x 5, 3 x 2, 1 x 1
    EXPECT_EQ(memory, 0);          // nobody has looked yet
    const TextureImage::Level last = image.level(2);
    EXPECT_EQ(last.width * last.height, 1);
    EXPECT_NEAR(*reinterpret_cast<const float*>(last.texels), 6, 1e-5f);
    EXPECT_EQ(memory, (35 + 6 + 1) * 4);
  }
  EXPECT_EQ(memory, 0);
}

TEST(TextureLevels, rows_may_be_too_long) {
  std::atomic<long long> memory{0};
  const TextureImage image(std::make_unique<Made>(
                               1 << 16, 1, [](int, int, int) { return 0.0f; }, 1 << 14),
                           memory);
  EXPECT_EQ(image.level(0).texels, nullptr);
  EXPECT_EQ(image.problem(), "its rows are too long");
}

// ---- Files.

struct TiffKind {
  int bits = 8, channels = 3, tile = 0;
  bool apart = false;
  uint16_t extra = EXTRASAMPLE_UNSPECIFIED;
};

class Files : public ::testing::Test {
protected:
  /// Texel (x, y) has (x, y, x + y, 3) of 255 in its channels.
  std::string tiff(const std::string& name, const TiffKind& k, std::vector<int> sizes = {24}) {
    std::string message, path = (folder_ / name).string();
    slvm::TiffFile file = slvm::open_tiff(path, "w", message);
    TIFF* t = file.get();
    for (const int size : sizes) {
      TIFFSetField(t, TIFFTAG_IMAGEWIDTH, static_cast<uint32_t>(size));
      TIFFSetField(t, TIFFTAG_IMAGELENGTH, static_cast<uint32_t>(size));
      TIFFSetField(t, TIFFTAG_BITSPERSAMPLE, static_cast<uint16_t>(k.bits));
      TIFFSetField(t, TIFFTAG_SAMPLESPERPIXEL, static_cast<uint16_t>(k.channels));
      TIFFSetField(t, TIFFTAG_SAMPLEFORMAT,
                   static_cast<uint16_t>(k.bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT));
      TIFFSetField(t, TIFFTAG_PHOTOMETRIC,
                   static_cast<uint16_t>(k.channels >= 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK));
      TIFFSetField(t, TIFFTAG_PLANARCONFIG,
                   static_cast<uint16_t>(k.apart ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG));
      TIFFSetField(t, TIFFTAG_PIXAR_WRAPMODES, "periodic,clamp");
      if (k.channels == 2 || k.channels == 4) TIFFSetField(t, TIFFTAG_EXTRASAMPLES, uint16_t{1}, &k.extra);
      if (k.tile > 0) {
        TIFFSetField(t, TIFFTAG_TILEWIDTH, static_cast<uint32_t>(k.tile));
        TIFFSetField(t, TIFFTAG_TILELENGTH, static_cast<uint32_t>(k.tile));
      } else {
        TIFFSetField(t, TIFFTAG_ROWSPERSTRIP, 5u);
      }
      const int planes = k.apart ? k.channels : 1;
      for (int plane = 0; plane < planes; ++plane)
        k.tile > 0 ? write_tiles(t, k, size, plane) : write_rows(t, k, size, plane);
      TIFFWriteDirectory(t);
    }
    return path;
  }
  static float value(int x, int y, int c) {
    return static_cast<float>(c == 0 ? x : c == 1 ? y : c == 2 ? x + y : 3) / 255;
  }
  static void put(const TiffKind& k, int x, int y, int plane, std::vector<std::byte>& out) {
    for (int c = k.apart ? plane : 0; c < (k.apart ? plane + 1 : k.channels); ++c) {
      auto add = [&](auto v) {
        const auto* bytes = reinterpret_cast<const std::byte*>(&v);
        out.insert(out.end(), bytes, bytes + sizeof v);
      };
      const float v = value(x, y, c);
      if (k.bits == 32)
        add(v);
      else if (k.bits == 16)
        add(static_cast<uint16_t>(std::lround(v * 65535)));
      else
        add(static_cast<uint8_t>(std::lround(v * 255)));
    }
  }
  static void write_rows(TIFF* t, const TiffKind& k, int size, int plane) {
    for (int y = 0; y < size; ++y) {
      std::vector<std::byte> row;
      for (int x = 0; x < size; ++x)
        put(k, x, y, plane, row);
      TIFFWriteScanline(t, row.data(), static_cast<uint32_t>(y), static_cast<uint16_t>(plane));
    }
  }
  static void write_tiles(TIFF* t, const TiffKind& k, int size, int plane) {
    for (int y0 = 0; y0 < size; y0 += k.tile)
      for (int x0 = 0; x0 < size; x0 += k.tile) {
        std::vector<std::byte> tile;
        for (int y = y0; y < y0 + k.tile; ++y)
          for (int x = x0; x < x0 + k.tile; ++x)
            put(k, std::min(x, size - 1), std::min(y, size - 1), plane, tile);
        TIFFWriteTile(t, tile.data(), static_cast<uint32_t>(x0), static_cast<uint32_t>(y0), 0,
                      static_cast<uint16_t>(plane));
      }
  }

  /// Looks up the middle of a texel of a file with 24 x 24 of them.
  std::array<float, 3> texel(TextureLookups& lookups, const std::string& path, int x, int y,
                             uint32_t first = 0) {
    slvm::TextureLookup l;
    uint64_t mask = 1;
    std::array<float, 3> out{};
    l.map = path;
    l.channels = 3;
    l.first_channel = first;
    l.points = 1;
    l.mask = &mask;
    l.options.fill = -1;
    for (size_t c = 0; c < 3; ++c) {
      l.centre[c] = {c == 0 ? (static_cast<float>(x) + 0.5f) / 24 : (static_cast<float>(y) + 0.5f) / 24};
      l.along_u[c] = l.along_v[c] = {0};
      l.result[c] = &out[c];
    }
    problem_ = lookups.texture(path, l);
    return out;
  }

  anemone::test::TempFolder folder_;
  std::string problem_;
};

TEST_F(Files, tiff_of_all_kinds) {
  TextureLookups lookups(100);
  for (const int bits : {8, 16, 32})
    for (const int channels : {1, 3, 4})
      for (const int tile : {0, 16})
        for (const bool apart : {false, true}) {
          const TiffKind kind{bits, channels, tile, apart};
          const std::string name = std::to_string(bits) + "_" + std::to_string(channels) + "_" +
                                   std::to_string(tile) + (apart ? "a" : "t") + ".tif";
          SCOPED_TRACE(name);
          const auto reader = open_tiff_texture(tiff(name, kind));
          ASSERT_TRUE(reader);
          EXPECT_EQ(reader->header().swrap, TextureWrap::kPeriodic);
          EXPECT_EQ(reader->header().twrap, TextureWrap::kClamp);
          const auto got = texel(lookups, (folder_ / name).string(), 21, 18);
          EXPECT_EQ(problem_, "");
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(got[static_cast<size_t>(c)], c < channels ? value(21, 18, c) : -1, 1e-5f) << c;
        }
}

/// A PNG file whose pixel (x, y) is number x + y of so many bits in all channels but alpha, which is half of
/// all.
void write_png(const std::string& path, int bits, int type, int interlace) {
  constexpr int kSize = 24;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, kSize, kSize, bits, type, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (type == PNG_COLOR_TYPE_PALETTE) {
    png_color colours[48];
    for (int i = 0; i < 48; ++i)
      colours[i] = {static_cast<png_byte>(i), static_cast<png_byte>(2 * i), static_cast<png_byte>(3 * i)};
    png_set_PLTE(png, info, colours, 48);
  }
  png_write_info(png, info);
  if (bits < 8) png_set_packing(png);
  std::vector<std::vector<png_byte>> rows(kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      for (int c = 0; c < png_get_channels(png, info); ++c) {
        const bool alpha = (type & PNG_COLOR_MASK_ALPHA) && c + 1 == png_get_channels(png, info);
        const int value = (alpha ? 1 << (bits - 1) : x + y) & ((1 << bits) - 1);
        if (bits == 16) rows[static_cast<size_t>(y)].push_back(static_cast<png_byte>(value >> 8));
        rows[static_cast<size_t>(y)].push_back(static_cast<png_byte>(value));
      }
  std::vector<png_bytep> pointers;
  for (auto& row : rows)
    pointers.push_back(row.data());
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST_F(Files, png_of_all_kinds) {
  TextureLookups lookups(100);
  struct Kind {
    int bits, type;
  };
  for (const Kind k : {Kind{1, PNG_COLOR_TYPE_GRAY},
                       {4, PNG_COLOR_TYPE_GRAY},
                       {8, PNG_COLOR_TYPE_GRAY},
                       {16, PNG_COLOR_TYPE_GRAY},
                       {8, PNG_COLOR_TYPE_PALETTE},
                       {8, PNG_COLOR_TYPE_RGB},
                       {16, PNG_COLOR_TYPE_RGB},
                       {8, PNG_COLOR_TYPE_GRAY_ALPHA},
                       {8, PNG_COLOR_TYPE_RGB_ALPHA},
                       {16, PNG_COLOR_TYPE_RGB_ALPHA}})
    for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
      SCOPED_TRACE(std::to_string(k.bits) + " bits, type " + std::to_string(k.type));
      const std::string path =
          (folder_ / ("a" + std::to_string(100 * k.type + 2 * k.bits + interlace))).string();
      write_png(path, k.bits, k.type, interlace);
      const auto reader = open_png_texture(path);
      ASSERT_TRUE(reader);
      EXPECT_EQ(reader->header().type, k.bits == 16 ? PixelType::kShort : PixelType::kByte);
      const auto got = texel(lookups, path, 3, 2);
      EXPECT_EQ(problem_, "");
      const int most = (1 << k.bits) - 1;
      const bool alpha = k.type & PNG_COLOR_MASK_ALPHA, gray = !(k.type & PNG_COLOR_MASK_COLOR);
      const float part = alpha ? static_cast<float>(1 << (k.bits - 1)) / static_cast<float>(most) : 1.0f,
                  value = static_cast<float>(5 & most) / static_cast<float>(most) * part,
                  near = alpha ? 0.6f / 255 : 1e-6f;
      EXPECT_NEAR(got[0], value, near);
      EXPECT_NEAR(got[1],
                  gray                               ? (alpha ? part : -1)
                  : k.type == PNG_COLOR_TYPE_PALETTE ? 2 * value
                                                     : value,
                  near);
      EXPECT_NEAR(got[2], gray ? -1 : k.type == PNG_COLOR_TYPE_PALETTE ? 3 * value : value, near);
    }
}

TEST_F(Files, damaged_png_is_said) {
  const std::string path = (folder_ / "a.png").string();
  write_png(path, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  TextureLookups lookups(100);
  EXPECT_EQ(texel(lookups, path, 20, 20)[0], 0);
  EXPECT_NE(problem_, "");
}

TEST_F(Files, further_pictures_are_levels_if_they_are_half_as_large) {
  EXPECT_EQ(open_tiff_texture(tiff("a.tif", {}, {24, 12, 6, 3, 1}))->header().levels.size(), 5u);
  EXPECT_EQ(open_tiff_texture(tiff("b.tif", {}, {24, 12, 24}))->header().levels.size(), 2u);
  EXPECT_EQ(open_tiff_texture(tiff("c.tif", {}, {24, 24}))->header().levels.size(), 1u);
}

TEST_F(Files, colours_are_multiplied_by_straight_alpha) {
  TextureLookups lookups(100);
  TiffKind kind{32, 4, 0, false, EXTRASAMPLE_UNASSALPHA};
  EXPECT_NEAR(texel(lookups, tiff("straight.tif", kind), 20, 9)[2], value(20, 9, 2) * 3 / 255, 1e-6f);
  EXPECT_NEAR(texel(lookups, tiff("straight.tif", kind), 20, 9, 3)[0], 3.0f / 255, 1e-6f);
  kind.extra = EXTRASAMPLE_ASSOCALPHA;
  EXPECT_NEAR(texel(lookups, tiff("by_alpha.tif", kind), 20, 9)[2], value(20, 9, 2), 1e-6f);
}

TEST_F(Files, textures_leave_the_memory_beyond_the_limit_and_come_back) {
  constexpr float kMegabytes = 24 * 24 * 3 * 2.5f / 1048576; // two and a half of them
  TextureLookups lookups(kMegabytes);
  std::vector<std::string> paths;
  for (int i = 0; i < 5; ++i)
    paths.push_back(tiff(std::to_string(i) + ".tif", {}));
  for (int round = 0; round < 3; ++round)
    for (const std::string& path : paths) {
      EXPECT_NEAR(texel(lookups, path, 11, 7)[0], 11.0f / 255, 1e-6f);
      EXPECT_LE(lookups.usage().second, 3 * 24 * 24 * 3);
    }
  EXPECT_EQ(lookups.usage().first, 5);
}

TEST_F(Files, what_cannot_be_read_is_said_each_time) {
  TextureLookups lookups(100);
  folder_.write("early.tx", std::string("\xfa\xce\x00\x03 and so on", 14));
  for (int i = 0; i < 2; ++i) {
    texel(lookups, (folder_ / "early.tx").string(), 0, 0);
    EXPECT_EQ(problem_,
              "it is in PRMan's own format of before TIFF; make it anew of its image, by MakeTexture");
  }
  // Texels end before the image does.
  const std::string path = tiff("short.tif", {8, 3, 0, false});
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 24);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(texel(lookups, path, 1, 1)[0], 0);
    EXPECT_NE(problem_, "");
  }
}

} // namespace
} // namespace render::testing
