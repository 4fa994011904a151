// Meshes laid out flat: which faces, where, with what; the procedural and the program.
#include "render/rib/parser.h"
#include "render/state/fragment.h"
#include "tests/render/run_slrender.h"

#include <gmock/gmock.h>

namespace render::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Keeps what it is given.
struct Collector : RiTarget {
  void request(const RequestCall& call) override { calls.push_back(call); }
  void unknown_request(std::string_view, std::string_view, slvm::SourceRange) override {}
  std::vector<RequestCall> calls;
};

class Fragments : public ::testing::Test {
protected:
  std::vector<RequestCall> pieces(const std::string& rib, int mesh = 0) {
    Collector collector;
    Fragmenter fragmenter(collector, diagnostics_, {}, mesh);
    const slvm::FileId file = sources_.add("t.rib", rib);
    parse_rib(sources_.text(file), file, fragmenter, diagnostics_);
    meshes_ = fragmenter.meshes();
    return collector.calls;
  }
  std::string messages() { return format_diagnostics(diagnostics_, sources_); }
  static const Param& param(const RequestCall& call, std::string_view token) {
    const Param* p = call.find_param(token);
    EXPECT_TRUE(p) << token;
    static const Param kNone;
    return p ? *p : kNone;
  }

  slvm::SourceManager sources_;
  slvm::Diagnostics diagnostics_;
  int meshes_ = 0;
};

/// n by n squares in the plane z = 0 with these tags and variables; vertices row by row, side 1.
std::string sheet(int n, const std::string& tags, const std::string& variables = "") {
  std::string rib = "SubdivisionMesh \"catmull-clark\" [";
  for (int i = 0; i < n * n; ++i)
    rib += "4 ";
  rib += "] [";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      rib += fmt::format("{} {} {} {} ", j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1,
                         (j + 1) * (n + 1) + i);
  rib += "] " + tags + " \"P\" [";
  for (int k = 0; k < (n + 1) * (n + 1); ++k)
    rib += fmt::format("{} {} 0 ", k % (n + 1), k / (n + 1));
  return rib + "] " + variables;
}

const std::string kNoTags = "[] [] [] []";

// F5.8 of the course's figures: as many meshes as faces inside, each with its neighbours.
TEST_F(Fragments, OneForEachFaceThatIsNotAtABorder) {
  const auto calls = pieces(sheet(5, kNoTags));
  EXPECT_EQ(messages(), "");
  ASSERT_EQ(calls.size(), 9u);
  for (const RequestCall& call : calls) {
    EXPECT_EQ(call.id, RequestId::kSubdivisionMesh);
    EXPECT_EQ(call.integers(1).size(), 9u);
    EXPECT_EQ(param(call, "P").numbers.size(), 3u * 16);
    EXPECT_THAT(call.texts(3), ElementsAre("hole"));
    EXPECT_THAT(call.integers(4), ElementsAre(8, 0));
    EXPECT_THAT(call.integers(5), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  }
}

TEST_F(Fragments, BordersToo) {
  const auto calls = pieces(sheet(3, "[\"interpolateboundary\"] [1 0] [1] []"));
  ASSERT_EQ(calls.size(), 9u);
  EXPECT_EQ(calls[0].integers(1).size(), 4u); // a corner
  EXPECT_THAT(calls[0].texts(3), ElementsAre("hole", "interpolateboundary"));
  EXPECT_THAT(calls[0].integers(5), ElementsAre(1, 2, 3, 1));
  EXPECT_TRUE(pieces(sheet(2, kNoTags)).empty());
  EXPECT_THAT(messages(), HasSubstr("no face can be laid out; a mesh with an open boundary needs the tag "
                                    "\"interpolateboundary\""));
}

// Cells of 1/3; the square takes 3/4 of its cell.
TEST_F(Fragments, EachInItsCellAllWithOneScale) {
  const auto calls = pieces(sheet(5, kNoTags));
  ASSERT_EQ(calls.size(), 9u);
  for (size_t k = 0; k < 9; ++k) {
    const auto& P = param(calls[k], "P").numbers;
    const auto corners = calls[k].integers(2).first(4);
    float least[2] = {9, 9}, most[2] = {-9, -9};
    for (int v : corners)
      for (size_t c = 0; c < 2; ++c) {
        const float x = P[3 * static_cast<size_t>(v) + c];
        least[c] = std::min(least[c], x), most[c] = std::max(most[c], x);
      }
    const float cell[] = {static_cast<float>(k % 3), static_cast<float>(k / 3)};
    for (size_t c = 0; c < 2; ++c) {
      EXPECT_NEAR(least[c], (cell[c] + 0.125f) / 3, 1e-5) << k;
      EXPECT_NEAR(most[c], (cell[c] + 0.875f) / 3, 1e-5) << k;
    }
  }
}

TEST_F(Fragments, PointsAreKeptAndFacesTurnRound) {
  const auto calls = pieces(sheet(3, kNoTags));
  ASSERT_EQ(calls.size(), 1u);
  const auto& pref = param(calls[0], "ScatterPref").numbers;
  std::vector<float> face;
  for (int v : calls[0].integers(2).first(4))
    for (size_t c = 0; c < 2; ++c)
      face.push_back(pref[3 * static_cast<size_t>(v) + c]);
  EXPECT_THAT(face, ElementsAre(1, 1, 1, 2, 2, 2, 2, 1));              // was 1 1, 2 1, 2 2, 1 2
  EXPECT_THAT(param(calls[0], "ScatterFace").numbers, ElementsAre(4)); // the middle one of nine
}

TEST_F(Fragments, VariablesOfAllClasses) {
  std::string corners, faces, vertices;
  for (int i = 0; i < 36; ++i)
    corners += fmt::format("{} ", i);
  for (int i = 0; i < 9; ++i)
    faces += fmt::format("{} ", i);
  for (int i = 0; i < 16; ++i)
    vertices += fmt::format("{} {} ", i, -i);
  const auto calls =
      pieces("Declare \"id\" \"uniform float\" " +
             sheet(3, kNoTags,
                   "\"id\" [" + faces + "] \"facevarying float c\" [" + corners +
                       "] \"vertex float[2] w\" [" + vertices + "] \"constant string name\" [\"skin\"]"));
  EXPECT_EQ(messages(), "");
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_THAT(param(calls[0], "id").numbers, ElementsAre(4, 0, 1, 2, 3, 5, 6, 7, 8));
  const auto& c = param(calls[0], "c").numbers;
  ASSERT_EQ(c.size(), 36u);
  EXPECT_THAT(std::vector<float>(c.begin(), c.begin() + 4), ElementsAre(16, 19, 18, 17));
  EXPECT_THAT(param(calls[0], "name").strings, ElementsAre("skin"));
  const auto& w = param(calls[0], "w").numbers;
  const auto& pref = param(calls[0], "ScatterPref").numbers;
  for (size_t v = 0; v < 16; ++v) {
    EXPECT_EQ(w[2 * v], pref[3 * v] + 4 * pref[3 * v + 1]);
    EXPECT_EQ(w[2 * v + 1], -w[2 * v]);
  }
}

TEST_F(Fragments, CreasesAndCornersOfThePatchOnly) {
  const auto calls =
      pieces(sheet(4, "[\"crease\" \"corner\" \"creasemethod\"] [3 2 2 1 1 0] [5 6 7 6 24 1] [2 3 4]"));
  EXPECT_EQ(messages(), "");
  ASSERT_EQ(calls.size(), 4u); // the first face has corners 6, 11, 12, 7
  using ::testing::UnorderedElementsAre;
  EXPECT_THAT(calls[0].texts(3), UnorderedElementsAre("hole", "crease", "crease", "corner", "creasemethod"));
  EXPECT_THAT(calls[0].numbers(6), UnorderedElementsAre(2, 3, 4));
  // The last face does not reach 5.
  EXPECT_THAT(calls[3].texts(3), UnorderedElementsAre("hole", "crease", "corner", "corner", "creasemethod"));
}

TEST_F(Fragments, HolesAndFacesWithoutExtentAreNone) {
  EXPECT_TRUE(pieces(sheet(3, "[\"hole\"] [1 0] [4] []")).empty());
  EXPECT_TRUE(pieces("SubdivisionMesh \"bilinear\" [3] [0 1 2] [\"interpolateboundary\"] [1 0] [1] [] \"P\" "
                     "[0 0 0 1 1 1 2 2 2]")
                  .empty());
}

TEST_F(Fragments, OneMeshOfMany) {
  EXPECT_EQ(pieces(sheet(3, kNoTags) + " Sphere 1 -1 1 360 " + sheet(4, kNoTags), 1).size(), 4u);
  EXPECT_EQ(meshes_, 2);
}

TEST_F(Fragments, WhatIsWrongWithAMesh) {
  auto complaint = [&](const std::string& rib) {
    EXPECT_TRUE(pieces(rib).empty());
    std::string text = messages();
    diagnostics_ = {};
    return text;
  };
  EXPECT_THAT(complaint("SubdivisionMesh \"catmull-clark\" [3] [0 1 2] \"P\" [0 0]"),
              HasSubstr("t.rib:1:1: error: SubdivisionMesh: it needs \"P\", three numbers a point"));
  EXPECT_THAT(complaint("SubdivisionMesh \"catmull-clark\" [2] [0 1] \"P\" [0 0 0 1 1 1]"),
              HasSubstr("a face has at least 3 vertices, found 2"));
  EXPECT_THAT(complaint("SubdivisionMesh \"catmull-clark\" [3] [0 1] \"P\" [0 0 0 1 1 1]"),
              HasSubstr("'nvertices' asks for 3 vertex numbers, found 2"));
  EXPECT_THAT(complaint("SubdivisionMesh \"catmull-clark\" [3] [0 1 2] \"P\" [0 0 0 1 1 1]"),
              HasSubstr("there is no vertex 2, \"P\" has 2"));
  EXPECT_THAT(complaint(sheet(3, "[\"hole\"] [] [1] []")),
              HasSubstr("the tag \"hole\" has no numbers in 'nargs'"));
  EXPECT_THAT(complaint(sheet(3, "[\"hole\"] [2 0] [1] []")),
              HasSubstr("there are fewer numbers than 'nargs' says for \"hole\""));
  EXPECT_THAT(complaint(sheet(3, kNoTags, "\"vertex float w\" [1]")),
              HasSubstr("\"vertex float w\" takes 16 numbers, found 1"));
  EXPECT_THAT(complaint(sheet(3, kNoTags, "\"vertex flaot w\" [1]")), HasSubstr("flaot"));
  std::string counts, fan, points;
  for (int i = 0; i < 257; ++i) {
    counts += "3 ";
    fan += fmt::format("257 {} {} ", i, (i + 1) % 257);
    points += fmt::format("{} {} 0 ", i, i * i);
  }
  EXPECT_THAT(
      complaint("SubdivisionMesh \"loop\" [" + counts + "] [" + fan + "] \"P\" [" + points + "0 0 0]"),
      HasSubstr("more than 256 faces meet at a vertex"));
  EXPECT_THAT(complaint("SubdivisionMesh \"loop\" [257] [0] \"P\" [0 0 0]"),
              HasSubstr("a face has more than 256 vertices"));
  EXPECT_THAT(complaint("Declare \"w\" \"vertex flaot\" "), HasSubstr("Declare: "));
}

TEST(FragmentSource, FilesNumbersAndText) {
  auto source = [](std::string_view data) {
    const FragmentSource s = fragment_source(data);
    return s.file + "|" + s.text + "|" + std::to_string(s.mesh);
  };
  EXPECT_EQ(source("head.rib"), "head.rib||0");
  EXPECT_EQ(source("head.rib 2 "), "head.rib||2");
  EXPECT_EQ(source("my head.rib"), "my head.rib||0");
  EXPECT_EQ(source("my 3d head -1"), "my 3d head -1||0");
  EXPECT_EQ(source("SubdivisionMesh \"loop\" 2"), "|SubdivisionMesh \"loop\" 2|0");
}

class SlFragment : public anemone::test::SlrenderTest {};

TEST_F(SlFragment, WritesAFile) {
  file("mesh.rib", sheet(5, kNoTags) + "\n" + sheet(3, kNoTags));
  const std::string program = SLFRAGMENT_PROGRAM;
  EXPECT_EQ(run_command(program + " mesh.rib -o out.rib").status, 0);
  const std::string out = directory_.read("out.rib");
  size_t count = 0;
  for (size_t at = 0; (at = out.find("SubdivisionMesh", at)) != out.npos; ++at)
    ++count;
  EXPECT_EQ(count, 9u);
  EXPECT_THAT(run_command(program + " mesh.rib -n 1").text, HasSubstr("ScatterPref"));
  Outcome none = run_command(program + " mesh.rib --mesh 2");
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(
      none.text,
      HasSubstr("slfragment: error: mesh.rib: mesh 2 is wanted, but there are 2 SubdivisionMesh requests"));
  Outcome missing = run_command(program + " none.rib");
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.text, HasSubstr("slfragment: error: none.rib: it cannot be read"));
  file("wrong.rib", "SubdivisionMesh \"loop\" [3] [0 1] \"P\" [0 0 0]");
  Outcome wrong = run_command(program + " wrong.rib -o never.rib");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.text, HasSubstr("wrong.rib:1:1: error: SubdivisionMesh: 'nvertices'"));
  EXPECT_FALSE(exists("never.rib"));
  EXPECT_EQ(run_command(program + " -n x mesh.rib").status, 2);
  EXPECT_EQ(run_command(program + " --version").text, "slfragment 0.1.0 (Anemone)\n");
}

TEST_F(SlFragment, AnswersAsAProcedural) {
  file("mesh.rib", sheet(3, kNoTags));
  const std::string program = SLFRAGMENT_PROGRAM;
  file("ask", "12 mesh.rib\n1e3 " + sheet(5, kNoTags) + "\n5 none.rib\n");
  const Outcome o = run_command(program + " < ask");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(std::count(o.text.begin(), o.text.end(), '\377'), 3);
  EXPECT_THAT(o.text, HasSubstr("none.rib: it cannot be read"));
}

/// What the procedural draws, and what it says.
TEST_F(SlFragment, TheProceduralDrawsTheSame) {
  file("mesh.rib", sheet(4, kNoTags));
  std::filesystem::create_directories(directory_ / "tools");
  std::filesystem::create_symlink(SLFRAGMENT_PROGRAM, directory_ / "tools/fragment");
  auto scene = [&](const std::string& name, const std::string& procedural, const std::string& camera = "") {
    file(name + ".rib",
         "Display \"" + name +
             ".tif\" \"tiff\" \"rgb\" \"quantize\" [0 0 0 0] Format 32 32 1 PixelFilter \"box\" 1 1\n" +
             camera +
             "WorldBegin Surface \"constant\" Color .5 .25 1 TransformBegin CoordSysTransform \"NDC\"\n" +
             "Procedural " + procedural + " [0 1 0 1 0 1] TransformEnd WorldEnd");
    return run("--allow-programs --procedurals tools " + name + ".rib");
  };
  EXPECT_EQ(scene("a", "\"Fragment\" [\"mesh.rib\"]").text, "");
  EXPECT_EQ(scene("b", "\"RunProgram\" [\"fragment\" \"mesh.rib\"]").text, "");
  std::string inline_mesh = sheet(4, kNoTags);
  for (size_t at = 0; (at = inline_mesh.find('"', at)) != inline_mesh.npos; at += 2)
    inline_mesh.insert(at, "\\");
  EXPECT_EQ(scene("c", "\"Fragment\" [\"" + inline_mesh + "\"]").text, "");
  const auto a = pixels("a.tif");
  EXPECT_EQ(std::count(a.begin(), a.end(), 0.25f), 4 * 12 * 12); // four squares of 3/4 of a cell of 16 pixels
  EXPECT_EQ(a, pixels("b.tif"));
  EXPECT_EQ(a, pixels("c.tif"));
  EXPECT_THAT(
      scene("d", "\"Fragment\" [\"mesh.rib 1\"]").text,
      HasSubstr(
          "Procedural: Fragment \"mesh.rib 1\": mesh 1 is wanted, but there are 1 SubdivisionMesh requests"));
  EXPECT_THAT(scene("e", "\"Fragment\" [\"none.rib\"]").text,
              HasSubstr("Procedural: no archive \"none.rib\""));
  EXPECT_THAT(scene("f", "\"Fragment\" [\"mesh.rib\" \"1\"]").text,
              HasSubstr("\"Fragment\" takes a mesh as RIB, or the name of a file, found 2"));
  EXPECT_THAT(scene("g", "\"Fragment\" [\"mesh.rib\"]", "Projection \"perspective\" \"fov\" [40]\n").text,
              HasSubstr("the camera is not orthographic: what shaders transform from \"NDC\" is wrong"));
}

} // namespace
} // namespace render::testing
