// The C interface: what is wrong is told to the error handler, and nothing worse happens.
#include "tests/render/ri_testing.h"

#include "render/rib/ri_error.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace render::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class RiErrors : public RiTest {
protected:
  /// What is told about `function`, called in a world that is rendered, and in one that is written.
  template <class Function> std::string both(Function function) {
    std::string out;
    for (bool file : {false, true}) {
      told().clear();
      if (file)
        begin_file();
      else
        RiBegin(RI_NULL);
      RtToken nothing = "null";
      RiDisplay("x", nothing, RI_RGBA, RI_NULL);
      RiFormat(8, 8, 1);
      RiWorldBegin();
      function();
      RiWorldEnd();
      RiEnd();
      std::string text = fmt::format("{}", fmt::join(told(), " | "));
      if (file) {
        EXPECT_EQ(text, out) << "rendered and written differ";
      }
      out = text;
    }
    return out;
  }
};

TEST_F(RiErrors, nothing_before_begin) {
  RiSphere(1, -1, 1, 360, RI_NULL);
  RiEnd();
  EXPECT_EQ(RiLightSource("ambientlight", RI_NULL), nullptr);
  EXPECT_THAT(told(), ElementsAre("23 2: RiSphere: RiBegin is missing", "23 2: RiEnd: RiBegin is missing",
                                  "23 2: RiLightSource: RiBegin is missing"));
  EXPECT_EQ(RiLastError, RIE_NOTSTARTED);
}

TEST_F(RiErrors, programs_are_not_run) {
  RiBegin("|rm -rf x");
  EXPECT_EQ(RiGetContext(), nullptr);
  EXPECT_THAT(told(), ElementsAre("11 2: RiBegin: \"|rm -rf x\" is a program to be run, which is not done; "
                                  "RiBegin(RI_NULL) renders here, a file name writes RIB"));
}

TEST_F(RiErrors, nesting) {
  EXPECT_EQ(both([] { RiAttributeEnd(); }),
            "24 2: AttributeEnd: there is no open AttributeBegin; the request is skipped");
  EXPECT_EQ(both([] {
              RiAttributeBegin();
              RiTransformBegin();
              RiAttributeEnd();
            }).substr(0, 58),
            "24 2: AttributeEnd: TransformBegin is still open");
  EXPECT_EQ(both([] { RiObjectEnd(); }),
            "24 2: ObjectEnd: there is no open ObjectBegin; the request is skipped");
  RiBegin(RI_NULL);
  RiAttributeBegin();
  told().clear();
  RiEnd();
  EXPECT_THAT(told(), ElementsAre(HasSubstr("24 2: ")));
}

TEST_F(RiErrors, places) {
  EXPECT_EQ(both([] { RiFormat(1, 1, 1); }),
            "25 2: Format: options cannot change inside a world block; the request is skipped");
  begin_file();
  told().clear();
  RiSphere(1, -1, 1, 360, RI_NULL);
  RiSolidBegin(RI_UNION);
  EXPECT_THAT(
      told(),
      ElementsAre("27 2: Sphere: this belongs between WorldBegin and WorldEnd; the request is skipped",
                  "28 2: SolidBegin: this belongs between WorldBegin and WorldEnd; the request is skipped"));
}

TEST_F(RiErrors, null_pointers) {
  EXPECT_EQ(both([] { RiSurface(RI_NULL, RI_NULL); }), "46 2: RiSurface: 'name' is a null pointer");
  EXPECT_EQ(both([] { RiColor(nullptr); }), "46 2: RiColor: 'color' is a null pointer");
  EXPECT_EQ(both([] { RiTransform(nullptr); }), "46 2: RiTransform: 'matrix' is a null pointer");
  EXPECT_EQ(both([] { RiHyperboloid(nullptr, nullptr, 360, RI_NULL); }),
            "46 2: RiHyperboloid: 'x1' is a null pointer");
  EXPECT_EQ(both([] { RiBasis(nullptr, 1, nullptr, 1); }), "46 2: RiBasis: 'ubasis' is a null pointer");
  EXPECT_EQ(both([] { RiPointsPolygons(1, nullptr, nullptr, RI_NULL); }),
            "46 2: RiPointsPolygons: 'nvertices' is a null pointer");
  EXPECT_EQ(both([] { RiSphereV(1, -1, 1, 360, 1, nullptr, nullptr); }),
            "46 2: RiSphere: the parameter list is a null pointer");
  EXPECT_EQ(both([] { RiSphere(1, -1, 1, 360, RI_P, RI_NULL, RI_NULL); }),
            "46 2: RiSphere: the values of \"P\" are a null pointer");
  RtToken none[1] = {nullptr};
  RtPointer value[1] = {none};
  EXPECT_EQ(both([&] { RiSphereV(1, -1, 1, 360, 1, none, value); }),
            "41 2: RiSphere: a token of the parameter list is a null pointer");
  EXPECT_EQ(both([&] { RiAttribute("identifier", "name", none, RI_NULL); }),
            "46 2: RiAttribute: a text of \"name\" is a null pointer");
  EXPECT_EQ(both([&] { RiDeclare("x", nullptr); }), "46 2: RiDeclare: 'declaration' is a null pointer");
  EXPECT_EQ(both([&] { RiArchiveRecord(nullptr, nullptr); }), "46 2: RiArchiveRecord: a null pointer");
  EXPECT_EQ(both([&] { RiProcedural(nullptr, nullptr, RiProcRunProgram, RI_NULL); }),
            "46 2: RiProcedural: 'bound' is a null pointer");
  RtBound bound = {};
  EXPECT_EQ(both([&] { RiProcedural(nullptr, bound, RI_NULL, RI_NULL); }),
            "46 2: RiProcedural: 'subdivfunc' is a null pointer");
  EXPECT_EQ(both([&] { RiProcedural(nullptr, bound, RiProcRunProgram, RI_NULL); }),
            "46 2: RiProcedural: 'arguments' is a null pointer");
}

TEST_F(RiErrors, counts) {
  EXPECT_EQ(both([] { RiPolygon(-1, RI_NULL); }), "42 2: RiPolygon: the number of vertices is -1");
  RtInt n[1] = {3};
  EXPECT_EQ(both([&] { RiGeneralPolygon(-2, n, RI_NULL); }),
            "42 2: RiGeneralPolygon: the number of elements of 'nvertices' is -2");
  EXPECT_EQ(both([&] { RiSphereV(1, -1, 1, 360, -3, nullptr, nullptr); }),
            "42 2: RiSphere: the number of parameters is -3");
  RtInt none[1] = {-2};
  EXPECT_EQ(both([&] { RiCurves(RI_CUBIC, 1, none, RI_NONPERIODIC, RI_NULL); }),
            "43 2: RiCurves: a curve has -2 points");
  EXPECT_EQ(both([&] { RiPatchMesh(RI_BICUBIC, 3, RI_PERIODIC, 4, RI_PERIODIC, RI_NULL); }),
            "43 2: RiPatchMesh: nu is 3; a bicubic mesh has at least 4");
  EXPECT_EQ(both([&] { RiPatchMesh(RI_BICUBIC, 4, "wrapped", 4, RI_PERIODIC, RI_NULL); }),
            "43 2: RiPatchMesh: unknown wrap \"wrapped\"; expected \"periodic\" or \"nonperiodic\"");
  RtFloat knots[6] = {}; // points and order together
  EXPECT_EQ(both([&] { RiNuPatch(2, 4, knots, 0, 1, 2, 2, knots, 0, 1, RI_NULL); }),
            "43 2: RiNuPatch: 2 points are too few for order 4");
  EXPECT_EQ(both([&] { RiNuPatch(2, 2, nullptr, 0, 1, 2, 2, knots, 0, 1, RI_NULL); }),
            "46 2: RiNuPatch: 'uknot' is a null pointer");
}

TEST_F(RiErrors, tokens) {
  RtFloat x = 1;
  EXPECT_EQ(both([&] { RiSphere(1, -1, 1, 360, "heat", &x, RI_NULL); }),
            "41 2: RiSphere: \"heat\" is not declared; RiDeclare says its type, or the token: \"float x\"");
  EXPECT_EQ(
      both([&] { RiSurface("plastic", "roughnes", &x, RI_NULL); }),
      "41 2: RiSurface: \"roughnes\" is not declared; did you mean \"roughness\"?; RiDeclare says its type, "
      "or the token: \"float x\"");
  EXPECT_EQ(both([&] { RiArchiveRecord("note", "x"); }),
            "41 2: RiArchiveRecord: unknown type \"note\"; known are comment, structure, verbatim");
  EXPECT_EQ(both([&] { RiIfBegin("1", "float x", &x, RI_NULL), RiIfEnd(); }),
            "41 2: IfBegin: a condition takes no parameters");
}

TEST_F(RiErrors, handles) {
  EXPECT_EQ(both([] { RiIlluminate(nullptr, 1); }), "44 2: RiIlluminate: this is not the handle of a light");
  EXPECT_EQ(both([] { RiObjectInstance(told().data()); }),
            "44 2: RiObjectInstance: this is not the handle of an object");
  RiContext(told().data());
  EXPECT_THAT(told().back(), HasSubstr("44 2: RiContext: this is no context, or it was ended"));
}

TEST_F(RiErrors, rib_options) {
  begin_file();
  RtToken what = "xml";
  RiOption("rib", "format", &what, RI_NULL);
  RiSides(1);
  what = "binary";
  RiOption("rib", "format", &what, RI_NULL);
  EXPECT_THAT(told(), ElementsAre("42 2: Option: \"format\" \"xml\": expected \"format\" (ascii, binary), "
                                  "\"compression\" (none, gzip) or \"precision\" (0 to 17)",
                                  "28 2: Option: the file has been begun; \"rib\" belongs before all other "
                                  "requests"));
}

TEST_F(RiErrors, files_that_cannot_be_written) {
  RiBegin("/nowhere/a.rib");
  RiSides(1);
  RiSides(1);
  RiEnd();
  EXPECT_THAT(told(), ElementsAre("4 3: cannot write \"/nowhere/a.rib\": No such file or directory"));
}

TEST_F(RiErrors, what_only_a_renderer_can_do) {
  begin_file();
  RiPixelFilter([](RtFloat, RtFloat, RtFloat, RtFloat) -> RtFloat { return 1; }, 2, 2);
  RtPoint p[1] = {{0, 0, 0}};
  EXPECT_EQ(RiTransformPoints("world", "camera", 1, p), nullptr);
  RiMakeTexture(
      "i", "t", RI_CLAMP, RI_CLAMP, [](RtFloat, RtFloat, RtFloat, RtFloat) -> RtFloat { return 1; }, 2, 2,
      RI_NULL);
  EXPECT_THAT(told(),
              ElementsAre("11 2: PixelFilter: a file cannot keep a function; expected one of ri.h, such as "
                          "RiGaussianFilter",
                          "41 2: RiTransformPoints: spaces are not known where a file is written",
                          "11 2: RiMakeTexture: 'filter' is a function of the program's own; expected one of "
                          "ri.h, such as RiGaussianFilter"));
}

TEST_F(RiErrors, functions_that_make_functions_for_ever) {
  begin_file();
  RiWorldBegin();
  struct Maker {
    static void make(RtPointer, RtFloat) {
      RtBound bound = {-1, 1, -1, 1, -1, 1};
      RiProcedural(RI_NULL, bound, make, RI_NULL);
    }
  };
  Maker::make(nullptr, 0);
  RiWorldEnd();
  RiEnd();
  EXPECT_THAT(
      told(),
      ElementsAre("13 2: Procedural: functions make functions more than 16 deep, or more than 1000000 "
                  "of them; the rest is left out of the file"));
}

TEST_F(RiErrors, functions_stay_in_their_renderer) {
  RtBound bound = {-1, 1, -1, 1, 0, 1};
  RtToken nothing = "null";
  RiBegin(RI_NULL);
  RiDisplay("x", nothing, RI_RGBA, RI_NULL);
  RiWorldBegin();
  RiProcedural(
      RI_NULL, bound,
      [](RtPointer, RtFloat) {
        RiBegin(RI_NULL);
        RiEnd();
        RiContext(nullptr);
        RiWorldEnd();
        RiAttributeBegin();
      },
      RI_NULL);
  RiObjectBegin();
  RiProcedural(
      RI_NULL, bound, [](RtPointer, RtFloat) { ADD_FAILURE(); }, RI_NULL);
  RiObjectEnd();
  RiWorldEnd();
  EXPECT_THAT(told(),
              ElementsAre("28 2: Procedural: a function cannot be kept in an object, an archive or a motion "
                          "block",
                          "24 2: RiBegin: functions of a procedural cannot begin a renderer",
                          "24 2: RiEnd: functions of a procedural cannot end the renderer",
                          "24 2: RiContext: functions of a procedural cannot change the context",
                          HasSubstr("WorldEnd: a procedural cannot end the world; the request is skipped"),
                          HasSubstr("Procedural: function: a block is left open at its end")));
}

TEST_F(RiErrors, handlers_belong_to_contexts) {
  static int first, second;
  first = second = 0;
  RiErrorHandler([](RtInt, RtInt, char*) { ++first; });
  begin_file();
  RiErrorHandler([](RtInt, RtInt, char*) { ++second; });
  RiSides(1);
  RiAttributeEnd();
  EXPECT_EQ(second, 1);
  RtContextHandle file = RiGetContext();
  RiBegin(RI_NULL);
  EXPECT_NE(RiGetContext(), file);
  RiAttributeEnd();
  EXPECT_EQ(first, 1);
  RiContext(file);
  RiAttributeEnd();
  EXPECT_EQ(second, 2);
  RiErrorHandler(RiErrorIgnore);
  RiAttributeEnd();
  EXPECT_EQ(second, 2);
  EXPECT_EQ(RiLastError, RIE_NESTING);
}

TEST_F(RiErrors, printed_and_fatal) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  std::string name = folder_ / "t.rib";
  EXPECT_EXIT(
      {
        RiErrorHandler(RiErrorPrint);
        RiBegin(name.c_str());
        RiAttributeEnd();
        std::exit(7);
      },
      ::testing::ExitedWithCode(7),
      "ri: error: AttributeEnd: there is no open AttributeBegin; the request is skipped \\(24\\)");
  EXPECT_EXIT(
      {
        RiErrorHandler(RiErrorAbort);
        RiBegin(name.c_str());
        RiSides(1);
        RiAttributeEnd();
        std::exit(7);
      },
      ::testing::ExitedWithCode(1), "ri: error: AttributeEnd");
}

TEST(RiErrorCodes, are_those_of_the_header) {
  EXPECT_EQ(static_cast<int>(RiError::kNoMemory), RIE_NOMEM);
  EXPECT_EQ(static_cast<int>(RiError::kSystem), RIE_SYSTEM);
  EXPECT_EQ(static_cast<int>(RiError::kNoFile), RIE_NOFILE);
  EXPECT_EQ(static_cast<int>(RiError::kBadFile), RIE_BADFILE);
  EXPECT_EQ(static_cast<int>(RiError::kIncapable), RIE_INCAPABLE);
  EXPECT_EQ(static_cast<int>(RiError::kUnimplemented), RIE_UNIMPLEMENT);
  EXPECT_EQ(static_cast<int>(RiError::kLimit), RIE_LIMIT);
  EXPECT_EQ(static_cast<int>(RiError::kBug), RIE_BUG);
  EXPECT_EQ(static_cast<int>(RiError::kNotStarted), RIE_NOTSTARTED);
  EXPECT_EQ(static_cast<int>(RiError::kNesting), RIE_NESTING);
  EXPECT_EQ(static_cast<int>(RiError::kNotOptions), RIE_NOTOPTIONS);
  EXPECT_EQ(static_cast<int>(RiError::kNotPrimitives), RIE_NOTPRIMS);
  EXPECT_EQ(static_cast<int>(RiError::kIllegalState), RIE_ILLSTATE);
  EXPECT_EQ(static_cast<int>(RiError::kBadMotion), RIE_BADMOTION);
  EXPECT_EQ(static_cast<int>(RiError::kBadToken), RIE_BADTOKEN);
  EXPECT_EQ(static_cast<int>(RiError::kRange), RIE_RANGE);
  EXPECT_EQ(static_cast<int>(RiError::kConsistency), RIE_CONSISTENCY);
  EXPECT_EQ(static_cast<int>(RiError::kBadHandle), RIE_BADHANDLE);
  EXPECT_EQ(static_cast<int>(RiError::kMissingData), RIE_MISSINGDATA);
  EXPECT_EQ(static_cast<int>(RiError::kSyntax), RIE_SYNTAX);
}

} // namespace
} // namespace render::testing
