// Pictures that write irradiance caches, and others that read them.
#include "render/caches/irradiance_cache.h"
#include "render/renderer.h"
#include "render/statistics.h"
#include "slvm/support/files.h"
#include "tests/render/shader_texts.h"
#include "tests/temp_folder.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace render {
namespace {

using ::testing::HasSubstr;

constexpr int kSize = 40;

/// A shader that looks up occlusion at a point; how much is known goes to green.
constexpr const char* kQuery =
    "surface query(string file = \"\", space = \"\", mode = \"r\"; varying point Pref = (0, 0, 0); "
    "float shift = 0, reference = 0) { float o = 7; normal n = normalize(N); point at = reference > 0 ? Pref "
    ": P + vector \"world\" (shift, 0, 0); "
    "float known = irradiancecache(\"query\", file, mode, at, n, \"coordsystem\", space, \"occlusion\", o); "
    "Ci = color(o, known, 0); Oi = 1; }";
constexpr const char* kInsert =
    "surface insert(string file = \"\", space = \"\", mode = \"w\"; float factor = 1) { "
    "point at = transform(\"world\", P); float o = factor * (.5 + .4 * sin(3 * xcomp(at)) * cos(2 * "
    "ycomp(at))); "
    "color c = color(xcomp(at), 2, 3); "
    "irradiancecache(\"insert\", file, mode, P, normalize(N), \"coordsystem\", space, \"occlusion\", o, "
    "\"irradiance\", c); Ci = color(o, 1, 0); Oi = Os; }";

class Bake : public ::testing::Test {
protected:
  std::map<std::string, std::string> shaders_ = {
      {"query", kQuery},
      {"insert", kInsert},
      {"constant", "surface constant() { Ci = Cs; Oi = Os; }"},
      {"occluded", "surface occluded(float samples = 64; string space = \"\") { normal n = "
                   "faceforward(normalize(N), I); Ci = "
                   "occlusion(P, n, samples, \"coordsystem\", space); Oi = Os; }"},
      {"lit", "surface lit(float samples = 64; string space = \"\") { float o = 0; normal n = "
              "faceforward(normalize(N), I); "
              "Ci = indirectdiffuse(P, n, samples, \"coordsystem\", space, \"occlusion\", o); Oi = Os; }"}};
  anemone::test::TempFolder folder_;
  std::string messages_;
  FrameStatistics statistics_;

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// kSize x kSize pixels of 4 floats.
  std::vector<float> render(const std::string& rib, int threads = 2, const std::string& options = "") {
    RendererSettings settings;
    settings.threads = threads;
    settings.shader_loader = [this](const std::string& name, const std::vector<std::string>&) {
      return testing::compile_shader_text(shaders_, name);
    };
    settings.statistics = [this](const FrameStatistics& s) { statistics_ = s; };
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    Renderer renderer(sources, diagnostics, settings);
    renderer.read_text("scene.rib",
                       fmt::format("Format {} {} 1\nOption \"limits\" \"int[2] bucketsize\" [12 12]\n"
                                   "Display \"{}\" \"openexr\" \"rgba\"\nPixelSamples 1 1 PixelFilter "
                                   "\"box\" 1 1 Hider \"hidden\" \"int jitter\" 0\n{}"
                                   "Projection \"orthographic\"\n{}",
                                   kSize, kSize, file("out.exr"), options, rib));
    renderer.finish();
    messages_ = format_diagnostics(diagnostics, sources);
    std::vector<float> pixels(kSize * kSize * 4);
    if (auto in = OIIO::ImageInput::open(file("out.exr")))
      in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, pixels.data());
    return pixels;
  }
  static float at(const std::vector<float>& pixels, int x, int y, int c = 0) {
    return pixels[static_cast<size_t>((y * kSize + x) * 4 + c)];
  }
  static float worst(const std::vector<float>& a, const std::vector<float>& b, int border = 2) {
    float most = 0;
    for (int y = border; y < kSize - border; ++y)
      for (int x = border; x < kSize - border; ++x)
        for (int c = 0; c < 3; ++c)
          most = std::max(most, std::abs(at(a, x, y, c) - at(b, x, y, c)));
    return most;
  }
  std::vector<IrradianceRecord> records(const std::string& name) {
    auto table = read_point_table(file(name));
    EXPECT_TRUE(table) << table.error();
    if (!table) return {};
    auto out = records_of(*table, name);
    EXPECT_TRUE(out) << out.error();
    return out ? std::move(*out) : std::vector<IrradianceRecord>();
  }
  std::vector<std::byte> bytes(const std::string& name) {
    auto out = slvm::read_file(file(name));
    return out ? std::move(*out) : std::vector<std::byte>();
  }

  /// The whole picture, facing the eye.
  static std::string square(const std::string& before = "", const std::string& surface = "") {
    return fmt::format("WorldBegin {} {} Polygon \"P\" [-1 -1 1  1 -1 1  1 1 1  -1 1 1] WorldEnd\n", before,
                       surface);
  }
  std::string surface(const std::string& shader, const std::string& cache, const std::string& more = "") {
    return fmt::format("Surface \"{}\" \"string file\" \"{}\" {}", shader, file(cache), more);
  }
  /// A floor that a disk hangs over, seen from above, in one space of its own.
  std::string under_disk(const std::string& shader, const std::string& attributes, float height = 0.5f) {
    return fmt::format(
        "Option \"limits\" \"int gridsize\" [256] " // grids are interpolated each by itself
        "WorldBegin Attribute \"visibility\" \"trace\" 1 Attribute \"trace\" \"float bias\" .001 "
        "AttributeBegin Attribute \"visibility\" \"camera\" 0 Surface \"constant\" Color .2 .6 1 "
        "Translate .2 0 {} Disk 0 .5 360 AttributeEnd "
        "Surface \"{}\" {} Polygon \"P\" [-1 -1 1  1 -1 1  1 1 1  -1 1 1] WorldEnd\n",
        1 - height, shader, attributes);
  }
  std::string handle(const std::string& cache, const std::string& mode) {
    return fmt::format("Attribute \"irradiance\" \"string handle\" \"{}\" \"string filemode\" \"{}\"",
                       file(cache), mode);
  }
};

// ---- irradiancecache()

TEST_F(Bake, what_is_inserted_is_found_again) {
  auto baked = render(square("", surface("insert", "a.ocf")));
  EXPECT_EQ(messages_, "");
  EXPECT_NEAR(at(baked, 10, 10, 1), 1, 1e-6f);
  auto read = render(square("", surface("query", "a.ocf")));
  EXPECT_EQ(messages_, "");
  EXPECT_LT(worst(baked, read), 0.01f);
  EXPECT_EQ(at(read, 20, 20, 1), 1);
  // Irradiance, too, in the same file.
  EXPECT_EQ(records("a.ocf")[0].holds, kOcclusion | kIrradiance);
}

TEST_F(Bake, there_is_nothing_where_nothing_was_inserted) {
  render(square("", surface("insert", "a.ocf")));
  auto read = render(square("", surface("query", "a.ocf", "\"float shift\" [1]")));
  EXPECT_EQ(at(read, 35, 20, 0), 0); // o was 7
  EXPECT_EQ(at(read, 35, 20, 1), 0);
  EXPECT_EQ(at(read, 5, 20, 1), 1);
}

TEST_F(Bake, files_do_not_depend_on_threads) {
  render(square("", surface("insert", "a.ocf")), 1);
  render(square("", surface("insert", "b.ocf")), 4);
  EXPECT_FALSE(bytes("a.ocf").empty());
  EXPECT_EQ(bytes("a.ocf"), bytes("b.ocf"));
}

TEST_F(Bake, the_shading_rate_says_how_many_points_there_are) {
  auto count = [&](float rate) {
    render(square(fmt::format("ShadingRate {} Attribute \"dice\" \"int rasterorient\" 0", rate),
                  surface("insert", "a.ocf")));
    return static_cast<double>(records("a.ocf").size());
  };
  const double dense = count(1), sparse = count(4);
  EXPECT_NEAR(dense, (kSize + 1) * (kSize + 1), 0.15 * dense); // a point for each pixel
  EXPECT_NEAR(dense / sparse, 4, 0.8);
}

TEST_F(Bake, data_move_with_their_space) {
  auto scene = [&](const std::string& shader, const std::string& where) {
    return fmt::format("WorldBegin {} CoordinateSystem \"hero\" {} Polygon \"P\" [-.8 -.8 1  .8 -.8 1  .8 .8 "
                       "1  -.8 .8 1] WorldEnd\n",
                       where, surface(shader, "a.ocf", "\"string space\" \"hero\""));
  };
  auto baked = render(scene("insert", ""));
  // A quarter turn: what was at the right is above.
  auto turned = render(scene("query", "Rotate 90 0 0 1"));
  EXPECT_EQ(messages_, "");
  for (int y = 8; y < 32; y += 4)
    for (int x = 8; x < 32; x += 4)
      EXPECT_NEAR(at(turned, y, kSize - 1 - x), at(baked, x, y), 0.025f) << x << ' ' << y;
}

TEST_F(Bake, references_stick_to_what_is_deformed) {
  auto baked = render(square("", surface("insert", "a.ocf")));
  auto bent = render(fmt::format("WorldBegin {} Patch \"bilinear\" \"P\" [-1 -1 1  0 -1 1  -1 1 1  0 1 1] "
                                 "\"vertex point Pref\" [-1 -1 1  "
                                 "1 -1 1  -1 1 1  1 1 1] WorldEnd\n",
                                 surface("query", "a.ocf", "\"float reference\" [1]")));
  // Squeezed into the left half.
  for (int x = 2; x < 18; ++x)
    EXPECT_NEAR(at(bent, x, 20), at(baked, 2 * x, 20), 0.04f) << x;
  EXPECT_EQ(at(bent, 10, 20, 1), 1);
}

TEST_F(Bake, rw_keeps_what_the_file_holds) {
  render(square("", surface("insert", "a.ocf")));
  const size_t before = records("a.ocf").size();
  // Half of it anew, with other values; the other half is out of the picture.
  const std::string half = "Polygon \"P\" [0 -1 1  1 -1 1  1 1 1  0 1 1]";
  render(fmt::format("WorldBegin {} {} WorldEnd\n",
                     surface("insert", "a.ocf", "\"string mode\" \"rw\" \"float factor\" [0]"), half));
  EXPECT_EQ(messages_, "");
  EXPECT_GE(records("a.ocf").size(), before);
  size_t left = 0;
  for (const IrradianceRecord& r : records("a.ocf"))
    left += r.P.x < -0.01f && r.sample.value[0] > 0.05f;
  EXPECT_GT(left, before / 3);
  render(fmt::format("WorldBegin {} {} WorldEnd\n", surface("insert", "a.ocf"), half));
  for (const IrradianceRecord& r : records("a.ocf"))
    EXPECT_GE(r.P.x, -1e-5f); // "w" begins anew
}

TEST_F(Bake, hits_of_rays_insert_nothing) {
  shaders_["mirror"] = "surface mirror() { Ci = trace(P, vector \"world\" (0, 0, 1)); Oi = 1; }";
  // On the left what is seen in the mirror only, on the right what is seen directly.
  auto picture = render(fmt::format(
      "WorldBegin Surface \"mirror\" Polygon \"P\" [-1 -1 1  0 -1 1  0 1 1  -1 1 1] Attribute \"visibility\" "
      "\"trace\" 1 \"camera\" 0 {} Polygon \"P\" [-1 -1 2  0 -1 2  0 1 2  -1 1 2] Attribute \"visibility\" "
      "\"camera\" 1 Polygon \"P\" [0 -1 3  1 -1 3  1 1 3  0 1 3] WorldEnd\n",
      surface("insert", "a.ocf")));
  EXPECT_GT(at(picture, 10, 20), 0.05f);
  EXPECT_FALSE(records("a.ocf").empty());
  for (const IrradianceRecord& r : records("a.ocf"))
    EXPECT_NE(r.P.z, 2);
}

TEST_F(Bake, mistakes_are_said) {
  render(square("", surface("query", "no.ocf")));
  EXPECT_THAT(messages_, HasSubstr("irradiancecache: there is no irradiance cache '" + file("no.ocf") +
                                   "': a scene must write it first"));
  render(square("", surface("query", "no.ocf", "\"string mode\" \"w\"")));
  EXPECT_THAT(messages_, HasSubstr("irradiancecache: the mode of \"query\" is \"r\", not \"w\""));
  render(square("", surface("insert", "a.ocf", "\"string mode\" \"r\"")));
  EXPECT_THAT(messages_, HasSubstr("irradiancecache: the mode of \"insert\" is \"w\" or \"rw\", not \"r\""));
  render(square("", surface("query", "a.ocf", "\"string space\" \"nowhere\"")));
  EXPECT_THAT(messages_,
              HasSubstr("irradiancecache: there is no space \"nowhere\", in which the data are to be"));
  render(square("", "Surface \"query\""));
  EXPECT_THAT(messages_, HasSubstr("irradiancecache: it needs the name of a file"));
  shaders_["odd"] = "surface odd() { irradiancecache(\"remove\", \"a\", \"r\", P, N); }";
  render(square("", "Surface \"odd\""));
  EXPECT_THAT(messages_, HasSubstr("irradiancecache: it can \"insert\" or \"query\", not \"remove\""));
  shaders_["dense"] = "surface dense(string file = \"\") { float o = 0; irradiancecache(\"insert\", file, "
                      "\"w\", P, normalize(N), \"occlusion\", o, \"maxpixeldist\", 5); }";
  render(square("", fmt::format("Surface \"dense\" \"string file\" \"{}\"", file("dense.ocf"))));
  EXPECT_THAT(
      messages_,
      HasSubstr("irradiancecache: \"maxpixeldist\" has no effect: data are as dense as they were kept"));
  shaders_["none"] = "surface none() { irradiancecache(\"insert\", \"a\", \"w\", P, N); }";
  render(square("", "Surface \"none\""));
  EXPECT_THAT(
      messages_,
      HasSubstr("irradiancecache: \"insert\" needs \"occlusion\", \"irradiance\" or \"environmentdir\""));
  const std::string where = file("no/such/folder/a.ocf");
  render(square("", fmt::format("Surface \"insert\" \"string file\" \"{}\"", where)));
  EXPECT_THAT(messages_, HasSubstr("error: the irradiance cache is not written: "));
  EXPECT_THAT(messages_, HasSubstr(where));
}

TEST_F(Bake, damaged_files_are_not_written_over) {
  ASSERT_TRUE(slvm::write_file(file("a.ocf"), std::as_bytes(std::span("my thesis"))));
  render(square("", surface("insert", "a.ocf", "\"string mode\" \"rw\"")));
  EXPECT_THAT(messages_, HasSubstr("is not written over what cannot be read: "));
  EXPECT_THAT(messages_, HasSubstr("this is neither an irradiance cache nor a photon map of Anemone"));
  EXPECT_EQ(bytes("a.ocf").size(), 10u);
  render(square("", surface("query", "a.ocf")));
  EXPECT_THAT(messages_, HasSubstr("this is neither an irradiance cache nor a photon map of Anemone"));
}

TEST_F(Bake, what_a_file_does_not_hold_is_said) {
  render(square("", "Surface \"occluded\" " + handle("a.ocf", "w")));
  shaders_["colour"] =
      "surface colour(string file = \"\") { color c = 5; irradiancecache(\"query\", file, \"r\", P, "
      "normalize(N), \"irradiance\", c); Ci = c; Oi = 1; }";
  auto read = render(square("", surface("colour", "a.ocf")));
  EXPECT_THAT(messages_, HasSubstr("' holds no irradiance"));
  EXPECT_EQ(at(read, 20, 20), 0);
}

// ---- occlusion() and indirectdiffuse()

TEST_F(Bake, occlusion_baked_is_occlusion_computed) {
  auto computed = render(under_disk("occluded", handle("a.ocf", "w")));
  EXPECT_EQ(messages_, "");
  const size_t baked = records("a.ocf").size();
  EXPECT_GT(baked, 30u);
  EXPECT_LT(baked, 1600u); // sparser than shading points
  EXPECT_GT(at(computed, 24, 20), 0.3f);
  auto read = render(under_disk("occluded", handle("a.ocf", "R")));
  EXPECT_EQ(messages_, "");
  EXPECT_EQ(statistics_.rays.hemisphere_rays, 0u);
  EXPECT_LT(worst(computed, read), 0.06f);
  double difference = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      difference += static_cast<double>(std::abs(at(read, x, y) - at(computed, x, y))) / kSize / kSize;
  EXPECT_LT(difference, 0.01);
}

TEST_F(Bake, seeds_save_rays_and_change_little) {
  auto computed = render(under_disk("occluded", handle("a.ocf", "w")));
  const size_t whole = statistics_.rays.hemisphere_rays;
  const auto before = bytes("a.ocf");
  auto seeded = render(under_disk("occluded", handle("a.ocf", "r")));
  EXPECT_LT(statistics_.rays.hemisphere_rays, whole / 10);
  EXPECT_LT(worst(computed, seeded), 0.06f);
  EXPECT_EQ(bytes("a.ocf"), before); // "r" writes nothing
}

TEST_F(Bake, rw_begins_without_a_file_and_goes_on_with_one) {
  render(under_disk("occluded", handle("a.ocf", "rw")));
  EXPECT_EQ(messages_, "");
  const size_t first = records("a.ocf").size();
  EXPECT_GT(first, 0u);
  // A tenth of the error: what is there is not enough.
  render(under_disk("occluded", handle("a.ocf", "rw") + " Attribute \"irradiance\" \"float maxerror\" .02"));
  EXPECT_GT(records("a.ocf").size(), first + 20);
  render(under_disk("occluded", handle("a.ocf", "")));
  EXPECT_GT(statistics_.rays.hemisphere_rays, 1000u);
}

TEST_F(Bake, density_follows_the_error_that_is_allowed) {
  auto count = [&](float error) {
    render(under_disk(
        "occluded",
        fmt::format("{} Attribute \"irradiance\" \"float maxerror\" {}", handle("a.ocf", "w"), error), 0.1f));
    return records("a.ocf").size();
  };
  const size_t all = count(0), fine = count(0.1f), coarse = count(0.5f);
  EXPECT_GE(all, size_t{kSize} * kSize); // every shading point
  EXPECT_GT(all, fine);
  EXPECT_GT(fine, coarse + coarse / 4);
}

TEST_F(Bake, an_irradiance_file_tells_occlusion_too) {
  auto light = render(under_disk("lit", handle("a.icf", "w")));
  EXPECT_GT(at(light, 24, 20, 1), 0.2f);
  auto read = render(under_disk("lit", handle("a.icf", "R")));
  EXPECT_EQ(statistics_.rays.all(), 0u);
  EXPECT_LT(worst(light, read), 0.06f);
  auto occlusion = render(under_disk("occluded", handle("a.icf", "R")));
  EXPECT_EQ(messages_, "");
  auto computed = render(under_disk("occluded", ""));
  EXPECT_LT(worst(occlusion, computed), 0.07f);
}

TEST_F(Bake, files_of_occlusion_do_not_depend_on_threads) {
  for (const char* shader : {"occluded", "lit"}) {
    render(under_disk(shader, handle("a.icf", "w")), 1);
    render(under_disk(shader, handle("b.icf", "w")), 4);
    EXPECT_FALSE(bytes("a.icf").empty());
    EXPECT_EQ(bytes("a.icf"), bytes("b.icf")) << shader;
    auto one = render(under_disk(shader, handle("a.icf", "r")), 1);
    EXPECT_EQ(render(under_disk(shader, handle("a.icf", "r")), 4), one);
  }
}

TEST_F(Bake, small_grids_are_baked_as_well) {
  std::string many =
      "WorldBegin Attribute \"visibility\" \"trace\" 1 Surface \"occluded\" " + handle("a.ocf", "{}");
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      const double x = -1 + 0.2 * i, y = -1 + 0.2 * j;
      many +=
          fmt::format(" Polygon \"P\" [{0} {1} 1  {2} {1} 1  {2} {3} 1  {0} {3} 1]", x, y, x + 0.2, y + 0.2);
    }
  many += " Translate .2 0 .5 Attribute \"visibility\" \"camera\" 0 Disk 0 .5 360 WorldEnd\n";
  auto with = [&](const char* mode) {
    std::string text = many;
    return text.replace(text.find("{}"), 2, mode);
  };
  render(with("w"), 1);
  const auto one = bytes("a.ocf");
  auto computed = render(with("w"), 4);
  EXPECT_EQ(bytes("a.ocf"), one);
  auto read = render(with("R"));
  EXPECT_LT(worst(computed, read), 0.08f);
}

TEST_F(Bake, mistakes_of_handles_are_said) {
  auto read = render(under_disk("occluded", handle("no.ocf", "R")));
  EXPECT_THAT(messages_, HasSubstr("occlusion: there is no irradiance cache '" + file("no.ocf") +
                                   "': a scene must write it first"));
  EXPECT_EQ(at(read, 25, 20), 0);
  render(under_disk("occluded", handle("a.ocf", "x")));
  EXPECT_THAT(messages_, HasSubstr("\"filemode\" is \"\", \"r\", \"w\", \"rw\" or \"R\""));
  render(under_disk("occluded", handle("a.ocf", "w")));
  EXPECT_EQ(messages_, "");
  render(under_disk("occluded\" \"string space\" \"nowhere", handle("b.ocf", "w")));
  EXPECT_THAT(messages_, HasSubstr("is not used: there is no coordinate system \"nowhere\""));
  EXPECT_FALSE(std::filesystem::exists(file("b.ocf")));
}

} // namespace
} // namespace render
