// Image files: types, modes, quantisation, names, errors.
#include "render/display/file_format.h"
#include "render/display/output.h"
#include "render/display/preview.h"
#include "tests/render/render_text.h"
#include "tests/temp_folder.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

namespace render::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Display : public ::testing::Test {
protected:
  std::string path(const std::string& name) { return (directory_ / name).string(); }

  /// Renders a half-covering grey disk to the displays and returns the messages of writing.
  std::string write(const std::string& displays) {
    Rendered r =
        render_text(displays + " Format 8 6 1 PixelFilter \"box\" 1 1 CropWindow 0 1 0 .5 WorldBegin "
                               "Color .5 .25 1 Translate 0 0 5 Disk 0 9 360 WorldEnd");
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    auto aovs = display_aovs(r.scene.options, diagnostics);
    written_ = write_displays(r.scene, r.image, aovs, diagnostics);
    std::string messages;
    for (const auto& d : diagnostics.sorted())
      messages += d.text + "\n";
    return r.messages + messages;
  }

  std::vector<float> read(const std::string& name, OIIO::ImageSpec& spec) {
    auto in = OIIO::ImageInput::open(path(name));
    if (!in) return {};
    spec = in->spec();
    std::vector<float> pixels(spec.image_pixels() * static_cast<size_t>(spec.nchannels));
    in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data());
    return pixels;
  }

  anemone::test::TempFolder directory_;
  std::vector<std::string> written_;
};

TEST_F(Display, only_channels_that_are_shown_are_made) {
  auto shown = [](const std::string& requests) {
    Rendered r = render_text(requests + " WorldBegin WorldEnd");
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    return shown_channels(r.scene.options, display_aovs(r.scene.options, diagnostics)).to_string();
  };
  // From the last channel to the first: z, alpha, Oi, Ci.
  EXPECT_EQ(shown("Display \"a\" \"tiff\" \"rgb\""), "00000111");
  EXPECT_EQ(shown("Display \"a\" \"tiff\" \"rgba\" Display \"+b\" \"zfile\" \"z\""), "11000111");
  EXPECT_EQ(shown("Display \"a\" \"tiff\" \"N\""), "00000000");
  EXPECT_EQ(shown("Display \"a\" \"null\" \"rgba\""), "00000000");
  EXPECT_EQ(shown("Display \"a\" \"tiff\" \"z\" Imager \"background\""), "11111111");
  const Image some({2, 3, 6, 5}, 2, Image::StandardChannels(0b10000001));
  EXPECT_TRUE(some.has(Image::kCi) && some.has(Image::kZ) && some.has(Image::kAov + 1));
  EXPECT_FALSE(some.has(Image::kCi + 1) || some.has(Image::kAlpha));
  EXPECT_EQ(some.data.size(), 4u * 2u * 4u);
  EXPECT_EQ(some.row(Image::kZ, 2, 3) - some.row(Image::kCi, 2, 3), 8);
  EXPECT_EQ(some.row(Image::kAov, 3, 4) - some.row(Image::kZ, 2, 3), 8 + 5);
}

TEST_F(Display, png_is_eight_bit_and_keeps_the_crop_window) {
  EXPECT_EQ(write("Quantize \"rgba\" 255 0 255 0 Display \"" + path("a.png") + "\" \"png\" \"rgba\""), "");
  OIIO::ImageSpec spec;
  auto p = read("a.png", spec);
  ASSERT_EQ(spec.nchannels, 4);
  EXPECT_EQ(spec.width, 8);
  EXPECT_EQ(spec.height, 3);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT8);
  EXPECT_NEAR(p[0], 128 / 255.0f, 1e-6f);
  EXPECT_NEAR(p[1], 64 / 255.0f, 1e-6f);
  EXPECT_EQ(p[3], 1);
}

TEST_F(Display, exr_is_float_with_matrices) {
  EXPECT_EQ(write("Display \"" + path("a.exr") + "\" \"openexr\" \"rgbaz\""), "");
  OIIO::ImageSpec spec;
  auto p = read("a.exr", spec);
  ASSERT_EQ(spec.nchannels, 5);
  EXPECT_EQ(p[0], 0.5f);
  EXPECT_EQ(p[1], 0.25f);
  EXPECT_EQ(p[4], 5);
  EXPECT_EQ(spec.full_height, 6);
  EXPECT_NE(spec.find_attribute("worldtocamera"), nullptr);
}

TEST_F(Display, tiff_takes_sixteen_bits_or_floats) {
  EXPECT_EQ(write("Quantize \"rgba\" 65535 0 65535 0 Display \"" + path("a") + "\" \"tiff\" \"rgb\""), "");
  OIIO::ImageSpec spec;
  auto p = read("a.tif", spec); // the extension is added
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT16);
  EXPECT_NEAR(p[1], 0.25f, 1e-4f);
  EXPECT_EQ(write("Quantize \"rgba\" 0 0 1 0 Display \"" + path("b.tif") + "\" \"tiff\" \"rgb\""), "");
  p = read("b.tif", spec);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(p[1], 0.25f);
}

TEST_F(Display, several_displays_with_shader_variables) {
  EXPECT_EQ(write("Display \"" + path("a.exr") + "\" \"openexr\" \"rgba\" Display \"+" + path("n.exr") +
                  "\" \"openexr\" \"varying normal N\" Display \"+" + path("s.exr") + "\" \"openexr\" \"s\""),
            "");
  EXPECT_EQ(written_.size(), 3u);
  OIIO::ImageSpec spec;
  auto n = read("n.exr", spec);
  ASSERT_EQ(spec.nchannels, 3);
  EXPECT_NEAR(n[2], 1, 1e-5f);
  read("s.exr", spec);
  EXPECT_EQ(spec.nchannels, 1);
}

TEST_F(Display, each_display_has_its_own_exposure_and_quantisation) {
  EXPECT_EQ(write("Exposure 2 1 Quantize \"rgba\" 255 0 255 0 Display \"" + path("a.png") +
                  "\" \"png\" \"rgb\" "
                  "Display \"+" +
                  path("b.tif") +
                  "\" \"tiff\" \"rgba\" \"float[2] exposure\" [1 2] "
                  "\"float[4] quantize\" [0 0 0 0] Display \"+" +
                  path("c.tif") +
                  "\" \"tiff\" \"rgb\" \"float[4] quantize\" [10 110 0 255] \"float dither\" 0"),
            "");
  OIIO::ImageSpec spec;
  EXPECT_NEAR(read("a.png", spec)[1], 128 / 255.0f, 1e-5f);
  auto b = read("b.tif", spec);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_FLOAT_EQ(b[1], 0.5f); // the root of .25
  EXPECT_FLOAT_EQ(b[3], 1);
  EXPECT_NEAR(read("c.tif", spec)[1], 60 / 255.0f, 1e-5f); // halfway from 10 to 110
}

TEST_F(Display, a_display_has_its_own_filter) {
  Rendered r = render_text(
      "Format 9 9 1 PixelSamples 8 8 PixelFilter \"box\" 1 1 Display \"a\" \"tiff\" \"rgb\" Display \"+b\" "
      "\"tiff\" \"rgba\" \"filter\" \"box\" \"float[2] filterwidth\" [3 3] WorldBegin "
      "Polygon \"P\" [-.1111 -.1111 1 .1111 -.1111 1 .1111 .1111 1 -.1111 .1111 1] WorldEnd");
  EXPECT_EQ(r.messages, "");
  EXPECT_NEAR(r.alpha(4, 4), 1, 1e-4f);
  EXPECT_EQ(r.alpha(3, 4), 0);
  for (int x : {3, 4, 5})
    EXPECT_NEAR(r.image.at(Image::kAov + 3, x, 3), 1 / 9.0f, 1e-4f);
  EXPECT_EQ(r.image.at(Image::kAov + 3, 2, 4), 0);
}

TEST_F(Display, channels_of_one_file) {
  EXPECT_EQ(write("DisplayChannel \"varying normal N\" DisplayChannel \"varying float u\" \"filter\" \"box\" "
                  "Display \"" +
                  path("m.exr") + "\" \"openexr\" \"Ci,a,z,N,u\""),
            "");
  OIIO::ImageSpec spec;
  auto p = read("m.exr", spec);
  ASSERT_EQ(spec.nchannels, 9);
  auto at = [&](const std::string& name) { return p[static_cast<size_t>(spec.channelindex(name))]; };
  EXPECT_EQ(at("R"), 0.5f);
  EXPECT_EQ(at("A"), 1);
  EXPECT_EQ(at("Z"), 5);
  EXPECT_NEAR(at("N.B"), 1, 1e-5f);
}

TEST_F(Display, depth_files_and_uncompressed_floats) {
  EXPECT_EQ(write("Display \"" + path("shad.z") + "\" \"zfile\" \"z\""), "");
  OIIO::ImageSpec spec;
  EXPECT_EQ(read("shad.z", spec)[0], 5);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(
      write("Display \"" + path("P.tif") + "\" \"tiff\" \"varying point P\" \"string compression\" \"none\""),
      "");
  auto p = read("P.tif", spec);
  EXPECT_EQ(spec.get_string_attribute("compression"), "none");
  EXPECT_EQ(p[2], 5);
}

TEST_F(Display, tiff_files_say_where_they_are_and_what_saw_them) {
  for (const char* compression : {"zip", "lzw", "none", "packbits"}) {
    EXPECT_EQ(write("Display \"" + path("a.tif") + "\" \"tiff\" \"rgba\" \"string compression\" \"" +
                    compression + "\""),
              "");
    OIIO::ImageSpec spec;
    auto p = read("a.tif", spec);
    EXPECT_EQ(spec.get_string_attribute("compression"), compression);
    EXPECT_EQ(spec.full_width, 8);
    EXPECT_EQ(spec.full_height, 6);
    EXPECT_EQ(spec.alpha_channel, 3);
    EXPECT_NEAR(p[1], 64 / 255.0f, 1.1f / 255);
    const OIIO::ParamValue* m = spec.find_attribute("worldtoscreen", OIIO::TypeMatrix);
    ASSERT_NE(m, nullptr);
    EXPECT_NEAR(static_cast<const float*>(m->data())[5], 1, 1e-6f); // fov 90
  }
}

TEST_F(Display, png_has_colours_that_alpha_did_not_scale) {
  EXPECT_EQ(write("Quantize \"rgba\" 65535 0 65535 0 PixelFilter \"box\" 2 2 Opacity .5 .5 .5 Display \"" +
                  path("a.png") + "\" \"png\" \"rgba\""),
            "");
  OIIO::ImageSpec raw;
  raw.attribute("oiio:UnassociatedAlpha", 1);
  auto in = OIIO::ImageInput::open(path("a.png"), &raw);
  ASSERT_TRUE(in);
  std::vector<float> p(in->spec().image_pixels() * 4);
  ASSERT_TRUE(in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, p.data()));
  EXPECT_NEAR(p[3], 0.5f, 1e-4f);
  EXPECT_NEAR(p[0], 0.5f, 1e-4f);
  EXPECT_NEAR(p[2], 1, 1e-4f);
}

TEST_F(Display, wrong_parameters_are_reported) {
  auto message = [&](const std::string& parameters) {
    return write("Display \"" + path("x.tif") + "\" \"tiff\" \"rgb\" " + parameters);
  };
  EXPECT_THAT(message("\"filter\" \"x\""), HasSubstr("Display: \"filter\" takes one of box, "));
  EXPECT_THAT(message("\"float[2] filterwidth\" [0 1]"),
              HasSubstr("\"filterwidth\" takes two widths above 0"));
  EXPECT_THAT(message("\"float[2] exposure\" [1 0]"),
              HasSubstr("\"exposure\" takes gain and a gamma above 0"));
  EXPECT_THAT(message("\"float[2] dither\" [1 0]"), HasSubstr("\"dither\" takes one number"));
  EXPECT_THAT(message("\"float[2] quantize\" [1 0]"), HasSubstr("\"quantize\" takes 4 numbers"));
  EXPECT_THAT(message("\"float[4] quantize\" [0 255 9 8]"),
              HasSubstr("\"quantize\" takes what 0 and 1 become"));
  EXPECT_THAT(write("DisplayChannel \"color c\" \"filter\" \"x\" Display \"x\" \"tiff\" \"c\""),
              HasSubstr("Display: channel \"c\": \"filter\" takes one of"));
  EXPECT_THAT(write("Display \"x\" \"tiff\" \",\""), HasSubstr("Display: unknown mode \",\""));
  EXPECT_THAT(write("DisplayChannel \"varying colr c\" Display \"x\" \"null\" \"rgb\""),
              HasSubstr("DisplayChannel: "));
}

TEST_F(Display, channels_have_their_own_exposure_and_quantisation) {
  EXPECT_EQ(write("DisplayChannel \"varying float u\" \"float[2] exposure\" [4 1] "
                  "DisplayChannel \"varying float v\" \"float[4] quantize\" [0 100 0 255] \"float dither\" 0 "
                  "Quantize \"rgba\" 255 0 255 0 Quantize \"t\" 50 0 255 0 "
                  "Display \"" +
                  path("u.exr") + "\" \"openexr\" \"u\" Display \"+" + path("v.tif") +
                  "\" \"tiff\" \"v\" Display \"+" + path("t.tif") +
                  "\" \"tiff\" \"varying float t\" Display \"+" + path("w.exr") +
                  "\" \"openexr\" \"varying float u\""),
            "");
  OIIO::ImageSpec spec;
  auto u = read("u.exr", spec), w = read("w.exr", spec);
  ASSERT_EQ(u.size(), w.size());
  for (size_t i = 0; i < u.size(); ++i)
    EXPECT_FLOAT_EQ(u[i], 4 * w[i]);
  auto v = read("v.tif", spec);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT8);
  EXPECT_LE(*std::max_element(v.begin(), v.end()), 100 / 255.0f);
  auto t = read("t.tif", spec);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT8);
  EXPECT_LE(*std::max_element(t.begin(), t.end()), 50 / 255.0f);
  EXPECT_GT(*std::max_element(t.begin(), t.end()), 0);
}

TEST_F(Display, imagers_change_displays_with_a_filter_or_an_exposure_of_their_own) {
  // The imager swaps red and blue. It sees exposed colours, and all displays see what it made.
  EXPECT_EQ(write("Imager \"swap\" Exposure 2 1 Display \"" + path("a.exr") +
                  "\" \"openexr\" \"rgba\" Display \"+" + path("b.exr") +
                  "\" \"openexr\" \"rgb\" \"float[2] exposure\" [1 2] Display \"+" + path("c.exr") +
                  "\" \"openexr\" \"rgba\" \"filter\" \"box\" \"float[2] filterwidth\" [3 3] Display \"+" +
                  path("d.exr") + "\" \"openexr\" \"Ci\""),
            "");
  OIIO::ImageSpec spec;
  for (const char* name : {"a.exr", "c.exr", "d.exr"}) {
    auto p = read(name, spec);
    EXPECT_EQ(p[0], 2) << name;
    EXPECT_EQ(p[1], 0.5f) << name;
    EXPECT_EQ(p[2], 1) << name;
  }
  auto b = read("b.exr", spec);
  EXPECT_EQ(spec.nchannels, 3);
  EXPECT_FLOAT_EQ(b[0], 1);
  EXPECT_FLOAT_EQ(b[1], 0.5f);
  EXPECT_FLOAT_EQ(b[2], std::sqrt(0.5f));
}

TEST_F(Display, compression_and_what_only_the_format_knows) {
  OIIO::ImageSpec spec;
  EXPECT_EQ(write("Display \"" + path("a.tif") +
                  "\" \"tiff\" \"rgb\" \"string compression\" \"LZW\" "
                  "\"float[2] resolution\" [300 300]"),
            "");
  read("a.tif", spec);
  EXPECT_EQ(spec.get_string_attribute("compression"), "lzw");
  EXPECT_EQ(spec.get_float_attribute("XResolution"), 300);
  EXPECT_EQ(spec.get_float_attribute("YResolution"), 300);
  EXPECT_THAT(write("Display \"" + path("b.tif") + "\" \"tiff\" \"rgb\" \"string Artist\" \"Ada\""),
              HasSubstr("Display \"Artist\" is not known here and is left to the file format"));
  read("b.tif", spec);
  EXPECT_EQ(spec.get_string_attribute("Artist"), "Ada");
  EXPECT_THAT(write("Display \"" + path("c.tif") + "\" \"tiff\" \"rgb\" \"string compression\" \"best\""),
              HasSubstr("Display: tiff files have no compression \"best\"; known are none, lzw, zip"));
  EXPECT_THAT(write("Display \"" + path("d.png") + "\" \"png\" \"rgb\" \"string compression\" \"none\""),
              HasSubstr("Display: \"compression\" has no effect: png files have no choice of it"));
  // Of JPEG it is the quality.
  auto jpeg = [&](const std::string& name, const char* compression) {
    return write("Display \"" + path(name) + "\" \"file\" \"rgb\" \"string compression\" \"" + compression +
                 "\"");
  };
  EXPECT_EQ(jpeg("good.jpg", "jpeg:95"), "");
  EXPECT_EQ(jpeg("small.jpg", "JPEG:5"), "");
  EXPECT_LT(std::filesystem::file_size(path("small.jpg")), std::filesystem::file_size(path("good.jpg")));
  EXPECT_THAT(jpeg("wrong.jpg", "jpeg:0"),
              HasSubstr("Display: jpeg files have no compression \"jpeg:0\"; known are jpeg:1 to jpeg:100"));
}

TEST_F(Display, previews_show_what_is_finished) {
  Rendered r = render_text("Format 8 6 1 PixelFilter \"box\" 1 1 Quantize \"rgba\" 200 0 255 0 Exposure 2 1 "
                           "Display \"a\" \"tiff\" \"rgba\" WorldBegin Color .5 .25 1 Translate 0 0 5 "
                           "Disk 0 9 360 WorldEnd");
  Preview preview(r.scene.options, {}, path("p.png"));
  PixelRect left{0, 0, 4, 6};
  preview.add(r.image, left);
  EXPECT_FALSE(directory_.has("p.png")); // it is too soon
  std::this_thread::sleep_for(std::chrono::milliseconds(550));
  preview.add(r.image, left);
  OIIO::ImageSpec spec;
  auto p = read("p.png", spec);
  ASSERT_EQ(p.size(), 8u * 6 * 3);
  EXPECT_NEAR(p[0], 200 / 255.0f, 1e-6f); // exposed and quantised as the display asks
  EXPECT_NEAR(p[1], 100 / 255.0f, 1e-6f);
  EXPECT_NEAR(p[2], 1, 1e-6f);
  EXPECT_NEAR(p[7 * 3], 48 / 255.0f, 1e-6f);
  preview.add(r.image, {4, 0, 8, 6});
  EXPECT_EQ(preview.finish(), "");
  p = read("p.png", spec);
  EXPECT_NEAR(p[7 * 3 + 1], 100 / 255.0f, 1e-6f);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1);
  Preview nowhere(r.scene.options, {}, path("no/such/p.png"));
  nowhere.add(r.image, left);
  EXPECT_NE(nowhere.finish(), "");
}

TEST_F(Display, nothing_is_left_of_a_failed_write) {
  std::string folder = path("a.png");
  fs::create_directory(folder);
  EXPECT_THAT(write("Display \"" + folder + "\" \"png\" \"rgba\""), HasSubstr("Display: cannot write"));
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1);
}

TEST_F(Display, without_its_folder_a_picture_comes_to_the_current_one) {
  const fs::path before = fs::current_path();
  fs::current_path(directory_);
  std::string messages = write("Display \"no/such/folder/a.png\" \"png\" \"rgba\"");
  fs::current_path(before);
  EXPECT_THAT(messages, HasSubstr("Display: there is no folder \"no/such/folder\"; the picture is written to "
                                  "\"a.png\" here"));
  EXPECT_TRUE(fs::exists(path("a.png")));
}

TEST_F(Display, drivers_of_other_renderers_become_files) {
  const std::string name = path("x.exr");
  EXPECT_THAT(write("Display \"" + name + "\" \"piqsl\" \"rgba\""),
              HasSubstr("Display: type \"piqsl\" is not known and taken for \"file\": the picture is written "
                        "as exr; known are \"tiff\""));
  EXPECT_TRUE(fs::exists(name));
  EXPECT_THAT(write("Display \"" + path("y") + "\" \"sgif\" \"rgba\""), HasSubstr("is written as tiff"));
  EXPECT_TRUE(fs::exists(path("y.tif")));
}

TEST_F(Display, an_extension_tells_the_format_if_there_is_one) {
  auto format = [](const char* name) {
    DisplayRequest d;
    d.name = name;
    d.type = "file";
    return choose_format(d).plugin;
  };
  for (const char* name : {"a", "a.tif", "a.0010", "env.xp", "a.z", "a.tx", "a.", "a.whatever"})
    EXPECT_EQ(format(name), "tiff") << name;
  EXPECT_EQ(format("a.png"), "png");
  EXPECT_EQ(format("a.jpg"), "jpeg");
  EXPECT_EQ(format("a.bw"), "bw");
}

TEST_F(Display, errors_name_the_mode) {
  EXPECT_THAT(write("Display \"x.exr\" \"openexr\" \"varying string x\""),
              HasSubstr("Display: \"varying string x\" cannot be shown as an image"));
  EXPECT_EQ(write("Display \"x\" \"null\" \"rgba\""), "");
}

} // namespace
} // namespace render::testing
