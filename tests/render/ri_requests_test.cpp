// The C interface: ri.h against requests.def, and each of its functions against the RIB it must write.
#include "render/rib/request.h"
#include "tests/render/random_calls.h"
#include "tests/render/ri_testing.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace render::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string header_text() {
  std::ifstream in(RI_HEADER);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Functions of ri.h with the names of their parameters; "..." for variable ones.
std::map<std::string, std::vector<std::string>> functions() {
  std::string text = std::regex_replace(header_text(), std::regex("//[^\n]*"), "");
  std::map<std::string, std::vector<std::string>> out;
  std::regex function("\\n\\w+\\*? (Ri\\w+)\\(([^;]*)\\);"), parameter("(\\.\\.\\.|\\w+)(\\[\\])?\\s*(,|$)");
  for (std::sregex_iterator f(text.begin(), text.end(), function), end; f != end; ++f) {
    std::string list = (*f)[2];
    auto& names = out[(*f)[1]];
    for (std::sregex_iterator p(list.begin(), list.end(), parameter); p != end; ++p)
      if ((*p)[1] != "void") names.push_back((*p)[1]);
  }
  return out;
}

TEST(RiHeader, has_a_function_for_every_request) {
  auto all = functions();
  ASSERT_GT(all.size(), 150u);
  for (const RequestInfo& info : requests()) {
    if (info.id == RequestId::kversion) continue; // files have one, programs do not
    std::string name = "Ri" + std::string(info.name);
    ASSERT_TRUE(all.contains(name)) << name;
    EXPECT_EQ(all.contains(name + "V") && all[name + "V"].back() == "values",
              info.params || info.id == RequestId::kIfBegin || info.id == RequestId::kElseIf)
        << name;
    if (info.params) {
      EXPECT_EQ(all[name].back(), "...") << name;
    }
  }
}

TEST(RiHeader, names_arguments_as_the_table_does) {
  auto all = functions();
  // Where C differs: what has another form there is not compared.
  const std::set<std::string> kOther{"RiHyperboloid", "RiPolygon",    "RiPoints",      "RiMotionBegin",
                                     "RiProcedural",  "RiBlobby",     "RiObjectBegin", "RiObjectInstance",
                                     "RiLightSource", "RiArchiveEnd", "RiClipping",    "RiDepthOfField",
                                     "RiPixelFilter"};
  for (const RequestInfo& info : requests()) {
    std::string name = "Ri" + std::string(info.name);
    if (kOther.contains(name) || info.id == RequestId::kversion) continue;
    std::vector<std::string> expected;
    for (const ArgumentInfo& a : info.arguments)
      if (a.kind != ArgumentKind::kHandle || info.id == RequestId::kIlluminate) expected.emplace_back(a.name);
    std::vector<std::string> have;
    for (const std::string& p : all[name]) // counts are C's own
      if (std::find(expected.begin(), expected.end(), p) != expected.end()) have.push_back(p);
    EXPECT_EQ(have, expected) << name;
  }
}

TEST(RiHeader, everything_declared_is_there) {
  for (const auto& [name, parameters] : functions())
    EXPECT_NE(::dlsym(RTLD_DEFAULT, name.c_str()), nullptr) << name;
  std::string text = header_text();
  std::regex variables("\\nextern \\w+ ([^;]*);"), word("\\w+");
  int count = 0;
  for (std::sregex_iterator v(text.begin(), text.end(), variables), end; v != end; ++v) {
    std::string list = (*v)[1];
    for (std::sregex_iterator w(list.begin(), list.end(), word); w != end; ++w, ++count)
      EXPECT_NE(::dlsym(RTLD_DEFAULT, (*w)[0].str().c_str()), nullptr) << (*w)[0];
  }
  EXPECT_GT(count, 90);
}

RtFloat f(double x) {
  return static_cast<RtFloat>(x);
}

class RiRequests : public RiTest {
protected:
  template <class Function> std::string rib(Function function) {
    begin_file();
    function();
    return end_file();
  }
  /// The same inside a world.
  template <class Function> std::string world(Function function) {
    std::string text = rib([&] {
      RiWorldBegin();
      function();
      RiWorldEnd();
    });
    std::string out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("  ")) out += line.substr(2) + "\n";
    return out;
  }
  RtFloat one_[64] = {};
};

TEST_F(RiRequests, options) {
  RtFloat fov = 30, samples[3] = {1, 0, 0};
  RtInt bucket[2] = {8, 16};
  RtToken path = "a:b";
  EXPECT_EQ(rib([&] {
              RiFrameBegin(3);
              RiFormat(320, 240, -1);
              RiFrameAspectRatio(1.5);
              RiScreenWindow(-1, 1, f(-.75), f(.75));
              RiCropWindow(0, .5, 0, 1);
              RiProjection(RI_PERSPECTIVE, RI_FOV, &fov, RI_NULL);
              RiProjection(RI_NULL, RI_NULL);
              RiClipping(f(.1), RI_INFINITY);
              RiClippingPlane(0, 0, 1, 0, 0, -1);
              RiDepthOfField(RI_INFINITY, 0, 0);
              RiDepthOfField(22, 45, 1200);
              RiShutter(0, .5);
              RiPixelVariance(f(.01));
              RiPixelSamples(4, 3);
              RiPixelFilter(RiCatmullRomFilter, 4, 3);
              RiExposure(1, f(2.2));
              RiImager("background", "bgcolor", samples, RI_NULL);
              RiQuantize(RI_RGBA, 255, 0, 255, .5);
              RiDisplay("a.tif", RI_FILE, RI_RGB, "compression", &path, RI_NULL);
              RiDisplayChannel("varying color diffuse", RI_NULL);
              RiHider("hidden", "subpixel", bucket, RI_NULL);
              RiColorSamples(1, samples, samples);
              RiRelativeDetail(.5);
              RiOption("limits", "bucketsize", bucket, RI_NULL);
              RiOption("searchpath", "shader", &path, RI_NULL);
              RiFrameEnd();
            }),
            "FrameBegin 3\n"
            "  Format 320 240 -1\n"
            "  FrameAspectRatio 1.5\n"
            "  ScreenWindow -1 1 -0.75 0.75\n"
            "  CropWindow 0 0.5 0 1\n"
            "  Projection \"perspective\" \"fov\" [30.0]\n"
            "  Projection\n"
            "  Clipping 0.1 1e+38\n"
            "  ClippingPlane 0 0 1 0 0 -1\n"
            "  DepthOfField -\n"
            "  DepthOfField 22 45 1200\n"
            "  Shutter 0 0.5\n"
            "  PixelVariance 0.01\n"
            "  PixelSamples 4 3\n"
            "  PixelFilter \"catmull-rom\" 4 3\n"
            "  Exposure 1 2.2\n"
            "  Imager \"background\" \"bgcolor\" [1 0 0.0]\n"
            "  Quantize \"rgba\" 255 0 255 0.5\n"
            "  Display \"a.tif\" \"file\" \"rgb\" \"compression\" [\"a:b\"]\n"
            "  DisplayChannel \"varying color diffuse\"\n"
            "  Hider \"hidden\" \"subpixel\" [8]\n"
            "  ColorSamples [1 0 0] [1 0 0]\n"
            "  RelativeDetail 0.5\n"
            "  Option \"limits\" \"bucketsize\" [8 16]\n"
            "  Option \"searchpath\" \"shader\" [\"a:b\"]\n"
            "FrameEnd\n");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRequests, maps) {
  RtString files[2] = {"a.z", "b.z"};
  EXPECT_EQ(rib([&] {
              RiMakeTexture("i", "t", RI_PERIODIC, RI_CLAMP, RiGaussianFilter, 2, 3, RI_NULL);
              RiMakeBump("i", "t", RI_BLACK, RI_CLAMP, RI_NULL, 1, 1, RI_NULL);
              RiMakeLatLongEnvironment("i", "t", RiBoxFilter, 1, 1, RI_NULL);
              RiMakeCubeFaceEnvironment("a", "b", "c", "d", "e", "f", "t", 95, RiSincFilter, 2, 2, RI_NULL);
              RiMakeShadow("z", "s", RI_NULL);
              RiMakeOcclusion(2, files, "o", RI_NULL);
              RiMakeBrickMap(1, files, "m", RI_NULL);
            }),
            "MakeTexture \"i\" \"t\" \"periodic\" \"clamp\" \"gaussian\" 2 3\n"
            "MakeBump \"i\" \"t\" \"black\" \"clamp\" \"box\" 1 1\n"
            "MakeLatLongEnvironment \"i\" \"t\" \"box\" 1 1\n"
            "MakeCubeFaceEnvironment \"a\" \"b\" \"c\" \"d\" \"e\" \"f\" \"t\" 95 \"sinc\" 2 2\n"
            "MakeShadow \"z\" \"s\"\n"
            "MakeOcclusion [\"a.z\" \"b.z\"] \"o\"\n"
            "MakeBrickMap [\"a.z\"] \"m\"\n");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRequests, attributes_and_shaders) {
  RtColor red = {1, 0, 0};
  RtBound bound = {-1, 1, -2, 2, -3, 3};
  RtFloat kd = f(.5), foo[2] = {1, 2};
  RtInt yes = 1;
  RtToken name = "ball";
  RtMatrix own = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
  EXPECT_EQ(rib([&] {
              RiAttributeBegin();
              RiAttribute("identifier", "name", &name, RI_NULL);
              RiAttribute("user", "uniform float[2] foo", foo, "int ok", &yes, RI_NULL);
              RiAttribute("visibility", "camera", &yes, RI_NULL);
              RiColor(red);
              RiOpacity(red);
              RiTextureCoordinates(0, 0, 1, 0, 0, 1, 1, 1);
              RtLightHandle key = RiLightSource("spotlight", RI_INTENSITY, &kd, RI_NULL);
              RtLightHandle area = RiAreaLightSource("arealight", RI_NULL);
              RiIlluminate(key, RI_FALSE);
              RiIlluminate(area, RI_TRUE);
              RiDeclare("bumps", "uniform integer");
              RiSurface("plastic", RI_KD, &kd, "bumps", &yes, RI_NULL);
              RiDisplacement("bumpy", RI_NULL);
              RiAtmosphere("fog", RI_NULL);
              RiInterior("a", RI_NULL);
              RiExterior("b", RI_NULL);
              RiDeformation("c", RI_NULL);
              RiShadingRate(.25);
              RiShadingInterpolation(RI_SMOOTH);
              RiMatte(RI_TRUE);
              RiBound(bound);
              RiDetail(bound);
              RiDetailRange(0, 1, 2, 3);
              RiGeometricApproximation(RI_FLATNESS, 2);
              RiOrientation(RI_LH);
              RiReverseOrientation();
              RiSides(1);
              RiBasis(RiBSplineBasis, RI_BSPLINESTEP, RiCatmullRomBasis, RI_CATMULLROMSTEP);
              RiBasis(RiPowerBasis, RI_POWERSTEP, own, 2);
              RiAttributeEnd();
            }),
            "AttributeBegin\n"
            "  Attribute \"identifier\" \"name\" [\"ball\"]\n"
            "  Attribute \"user\" \"uniform float[2] foo\" [1 2.0] \"int ok\" [1]\n"
            "  Attribute \"visibility\" \"camera\" [1]\n"
            "  Color [1 0 0]\n"
            "  Opacity [1 0 0]\n"
            "  TextureCoordinates 0 0 1 0 0 1 1 1\n"
            "  LightSource \"spotlight\" 1 \"intensity\" [0.5]\n"
            "  AreaLightSource \"arealight\" 2\n"
            "  Illuminate 1 0\n"
            "  Illuminate 2 1\n"
            "  Declare \"bumps\" \"uniform integer\"\n"
            "  Surface \"plastic\" \"Kd\" [0.5] \"bumps\" [1]\n"
            "  Displacement \"bumpy\"\n"
            "  Atmosphere \"fog\"\n"
            "  Interior \"a\"\n"
            "  Exterior \"b\"\n"
            "  Deformation \"c\"\n"
            "  ShadingRate 0.25\n"
            "  ShadingInterpolation \"smooth\"\n"
            "  Matte 1\n"
            "  Bound [-1 1 -2 2 -3 3]\n"
            "  Detail [-1 1 -2 2 -3 3]\n"
            "  DetailRange 0 1 2 3\n"
            "  GeometricApproximation \"flatness\" 2\n"
            "  Orientation \"lh\"\n"
            "  ReverseOrientation\n"
            "  Sides 1\n"
            "  Basis \"b-spline\" 1 \"catmull-rom\" 1\n"
            "  Basis \"power\" 4 [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16] 2\n"
            "AttributeEnd\n");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRequests, transformations) {
  RtMatrix m = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {5, 6, 7, 1}};
  EXPECT_EQ(rib([&] {
              RiTransformBegin();
              RiIdentity();
              RiTransform(m);
              RiConcatTransform(m);
              RiPerspective(30);
              RiTranslate(1, 2, 3);
              RiRotate(90, 0, 0, 1);
              RiScale(1, 2, f(.5));
              RiSkew(45, 0, 1, 0, 1, 0, 0);
              RiCoordinateSystem("here");
              RiScopedCoordinateSystem("there");
              RiCoordSysTransform("here");
              RiTransformEnd();
            }),
            "TransformBegin\n"
            "  Identity\n"
            "  Transform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]\n"
            "  ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]\n"
            "  Perspective 30\n"
            "  Translate 1 2 3\n"
            "  Rotate 90 0 0 1\n"
            "  Scale 1 2 0.5\n"
            "  Skew 45 0 1 0 1 0 0\n"
            "  CoordinateSystem \"here\"\n"
            "  ScopedCoordinateSystem \"there\"\n"
            "  CoordSysTransform \"here\"\n"
            "TransformEnd\n");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRequests, quadrics) {
  RtPoint a = {1, 0, 0}, b = {1, 1, 1};
  RtFloat heat[4] = {1, 2, 3, 4};
  EXPECT_EQ(world([&] {
              RiSphere(1, -1, 1, 360, "varying float heat", heat, RI_NULL);
              RiCone(2, 1, 360, RI_NULL);
              RiCylinder(1, -1, 1, 180, RI_NULL);
              RiHyperboloid(a, b, 360, RI_NULL);
              RiParaboloid(1, 0, 1, 360, RI_NULL);
              RiDisk(0, 1, 360, RI_NULL);
              RiTorus(2, f(.5), 0, 360, 360, RI_NULL);
              RiGeometry("teapot", RI_NULL);
            }),
            "Sphere 1 -1 1 360 \"varying float heat\" [1 2 3 4.0]\n"
            "Cone 2 1 360\n"
            "Cylinder 1 -1 1 180\n"
            "Hyperboloid 1 0 0 1 1 1 360\n"
            "Paraboloid 1 0 1 360\n"
            "Disk 0 1 360\n"
            "Torus 2 0.5 0 360 360\n"
            "Geometry \"teapot\"\n");
  EXPECT_THAT(told(), IsEmpty());
}

/// How many numbers each parameter of the last request has.
std::vector<size_t> lengths(const std::string& text) {
  std::string messages;
  CallList list = parse_calls(text, &messages);
  EXPECT_EQ(messages, "");
  std::vector<size_t> out;
  for (const Param& p : list.calls.back().params)
    out.push_back(p.numbers.size());
  return out;
}

/// RISpec 3.2, sections 5.1 to 5.6: uniform, varying, vertex, facevarying.
#define RI_CLASSES                                                                                           \
  "uniform float u", data, "varying float v", data, "vertex float w", data, "facevarying float f", data,     \
      RI_NULL

TEST_F(RiRequests, lists_are_as_long_as_the_primitive_says) {
  std::vector<RtFloat> many(2000);
  RtPointer data = many.data();
  auto sizes = [&](auto function) { return lengths(world(function)); };
  RtInt n3[2] = {3, 4}, verts[7] = {0, 1, 2, 2, 1, 0, 9}, loops[2] = {2, 1}, n9[3] = {3, 3, 3},
        verts9[9] = {0, 1, 2, 3, 4, 5, 6, 7, 7};
  EXPECT_THAT(sizes([&] { RiCone(1, 1, 360, RI_CLASSES); }), ElementsAre(1, 4, 4, 4));
  EXPECT_THAT(sizes([&] { RiPolygon(5, RI_CLASSES); }), ElementsAre(1, 5, 5, 5));
  EXPECT_THAT(sizes([&] { RiGeneralPolygon(2, n3, RI_CLASSES); }), ElementsAre(1, 7, 7, 7));
  EXPECT_THAT(sizes([&] { RiPointsPolygons(2, n3, verts, RI_CLASSES); }), ElementsAre(2, 10, 10, 7));
  EXPECT_THAT(sizes([&] { RiPointsGeneralPolygons(2, loops, n9, verts9, RI_CLASSES); }),
              ElementsAre(2, 8, 8, 9));
  EXPECT_THAT(sizes([&] {
                RiSubdivisionMesh("catmull-clark", 2, n3, verts, 0, nullptr, nullptr, nullptr, nullptr,
                                  RI_CLASSES);
              }),
              ElementsAre(2, 10, 10, 7));
  EXPECT_THAT(sizes([&] { RiPatch(RI_BILINEAR, RI_CLASSES); }), ElementsAre(1, 4, 4, 4));
  EXPECT_THAT(sizes([&] { RiPatch(RI_BICUBIC, RI_CLASSES); }), ElementsAre(1, 4, 16, 4));
  EXPECT_THAT(sizes([&] { RiPatchMesh(RI_BICUBIC, 7, RI_NONPERIODIC, 9, RI_PERIODIC, RI_CLASSES); }),
              ElementsAre(2 * 3, 3 * 3, 63, 9));
  EXPECT_THAT(sizes([&] { RiPatchMesh(RI_BILINEAR, 3, RI_PERIODIC, 4, RI_NONPERIODIC, RI_CLASSES); }),
              ElementsAre(3 * 3, 3 * 4, 12, 12));
  RtFloat knots[8] = {0, 0, 0, 0, 1, 1, 1, 1}, knots5[7] = {0, 0, 0, 1, 2, 2, 2};
  EXPECT_THAT(sizes([&] { RiNuPatch(4, 4, knots, 0, 1, 4, 3, knots5, 0, 2, RI_CLASSES); }),
              ElementsAre(1 * 2, 2 * 3, 16, 6));
  EXPECT_THAT(sizes([&] { RiPoints(6, RI_CLASSES); }), ElementsAre(1, 6, 6, 6));
  RtInt curve[2] = {4, 7};
  EXPECT_THAT(sizes([&] { RiCurves(RI_CUBIC, 2, curve, RI_NONPERIODIC, RI_CLASSES); }),
              ElementsAre(2, 2 + 3, 11, 5));
  EXPECT_THAT(sizes([&] { RiCurves(RI_LINEAR, 2, curve, RI_PERIODIC, RI_CLASSES); }),
              ElementsAre(2, 11, 11, 11));
  RtInt code[2] = {1000, 0};
  RtFloat constant[1] = {1};
  EXPECT_THAT(sizes([&] { RiBlobby(1, 2, code, 1, constant, 0, nullptr, RI_CLASSES); }),
              ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(sizes([&] {
                RiPolygon(3, RI_P, data, "vertex hpoint h", data, "constant color c", data, "float[3] a",
                          data, "st", data, RI_NULL);
              }),
              ElementsAre(9, 12, 3, 3, 6));
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRequests, lists_follow_the_current_basis) {
  std::vector<RtFloat> many(2000);
  RtPointer data = many.data();
  RtInt curve[1] = {7};
  auto curves = [&] { RiCurves(RI_CUBIC, 1, curve, RI_NONPERIODIC, "varying float v", data, RI_NULL); };
  std::string text = world([&] {
    curves(); // bezier: 2 segments
    RiAttributeBegin();
    RiBasis(RiBSplineBasis, 1, RiBSplineBasis, 1);
    curves(); // 4
    RiObjectBegin();
    RiBasis(RiHermiteBasis, 2, RiHermiteBasis, 2);
    curves(); // 2
    RiObjectEnd();
    curves(); // 4
    RiAttributeEnd();
    curves();
  });
  std::vector<size_t> found;
  for (const RequestCall& c : parse_calls(text).calls)
    if (c.id == RequestId::kCurves) found.push_back(c.params[0].numbers.size());
  EXPECT_THAT(found, ElementsAre(3, 5, 3, 5, 3));
}

TEST_F(RiRequests, meshes) {
  RtInt nvertices[2] = {3, 3}, vertices[6] = {0, 1, 2, 2, 1, 3}, loops[1] = {2};
  RtToken tags[2] = {"crease", "interpolateboundary"};
  RtInt nargs[4] = {2, 1, 0, 0}, ints[2] = {0, 1};
  RtFloat floats[1] = {2.5};
  RtInt code[4] = {1001, 0, 7, 0};
  RtString name[1] = {"ground.z"};
  EXPECT_EQ(world([&] {
              RiPointsPolygons(2, nvertices, vertices, RI_NULL);
              RiGeneralPolygon(2, nvertices, RI_NULL);
              RiPointsGeneralPolygons(1, loops, nvertices, vertices, RI_NULL);
              RiSubdivisionMesh(RI_CATMULLCLARK, 2, nvertices, vertices, 2, tags, nargs, ints, floats,
                                RI_NULL);
              RiPatch(RI_BICUBIC, RI_NULL);
              RiPatchMesh(RI_BILINEAR, 2, RI_PERIODIC, 3, RI_NONPERIODIC, RI_NULL);
              RiBlobby(1, 4, code, 2, one_, 1, name, RI_NULL);
              RiPoints(0, RI_NULL);
              RiCurves(RI_LINEAR, 2, nvertices, RI_NONPERIODIC, RI_NULL);
            }),
            "PointsPolygons [3 3] [0 1 2 2 1 3]\n"
            "GeneralPolygon [3 3]\n"
            "PointsGeneralPolygons [2] [3 3] [0 1 2 2 1 3]\n"
            "SubdivisionMesh \"catmull-clark\" [3 3] [0 1 2 2 1 3] [\"crease\" \"interpolateboundary\"] [2 1 "
            "0 0] [0 1]\n"
            "    [2.5]\n"
            "Patch \"bicubic\"\n"
            "PatchMesh \"bilinear\" 2 \"periodic\" 3 \"nonperiodic\"\n"
            "Blobby 1 [1001 0 7 0] [0 0] [\"ground.z\"]\n"
            "Points\n"
            "Curves \"linear\" [3 3] \"nonperiodic\"\n");
  RtFloat knots[6] = {0, 0, 0, 1, 1, 1}, min[1] = {0}, max[1] = {1}, u[3] = {0, 1, 0}, w[3] = {1, 1, 1};
  RtInt ncurves[1] = {1}, order[1] = {3}, n[1] = {3};
  EXPECT_EQ(world([&] {
              RiTrimCurve(1, ncurves, order, knots, min, max, n, u, u, w);
              RiNuPatch(3, 3, knots, 0, 1, 3, 3, knots, 0, 1, RI_NULL);
              RiTrimCurve(0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
            }),
            "TrimCurve [1] [3] [0 0 0 1 1 1] [0] [1] [3] [0 1 0] [0 1 0] [1 1 1]\n"
            "NuPatch 3 3 [0 0 0 1 1 1] 0 1 3 3 [0 0 0 1 1 1] 0 1\n"
            "TrimCurve [] [] [] [] [] [] [] [] []\n");
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRequests, blocks_archives_and_conditions) {
  RtBound bound = {-1, 1, -1, 1, -1, 1};
  RtString file[1] = {"a.rib"}, program[2] = {"maker", "x y"}, plug_in[2] = {"balls.so", "3"};
  RtFloat times[2] = {0, .5};
  EXPECT_EQ(world([&] {
              RiSolidBegin(RI_UNION);
              RiSolidEnd();
              RtObjectHandle object = RiObjectBegin();
              RiObjectEnd();
              RiObjectInstance(object);
              RiMotionBegin(2, 0.0, 1.0);
              RiMotionEnd();
              RiMotionBeginV(2, times);
              RiMotionEnd();
              RiArchiveBegin("part", RI_NULL);
              RiArchiveEnd();
              RiArchiveInstance("part", "int frame", RI_NULL, RI_NULL);
              RiReadArchive("a.rib", RI_NULL, RI_NULL);
              RiIfBegin("$x == 1", RI_NULL);
              RiElseIf("$x == 2", RI_NULL);
              RiElse();
              RiIfEnd();
              RiProcedural(file, bound, RiProcDelayedReadArchive, RI_NULL);
              RiProcedural(program, bound, RiProcRunProgram, RI_NULL);
              RiProcedural(plug_in, bound, RiProcDynamicLoad, RI_NULL);
              RiArchiveRecord(RI_COMMENT, " %d of %s", 3, "all");
              RiArchiveRecord(RI_STRUCTURE, "Scene");
              RiArchiveRecord(RI_VERBATIM, "  Sides %d", 1);
            }),
            "SolidBegin \"union\"\n"
            "SolidEnd\n"
            "ObjectBegin 1\n"
            "ObjectEnd\n"
            "ObjectInstance 1\n"
            "MotionBegin [0 1]\n"
            "MotionEnd\n"
            "MotionBegin [0 0.5]\n"
            "MotionEnd\n"
            "ArchiveBegin \"part\"\n"
            "ArchiveEnd\n"
            "ArchiveInstance \"part\"\n"
            "ReadArchive \"a.rib\"\n"
            "IfBegin \"$x == 1\"\n"
            "ElseIf \"$x == 2\"\n"
            "Else\n"
            "IfEnd\n"
            "Procedural \"DelayedReadArchive\" [\"a.rib\"] [-1 1 -1 1 -1 1]\n"
            "Procedural \"RunProgram\" [\"maker\" \"x y\"] [-1 1 -1 1 -1 1]\n"
            "Procedural \"DynamicLoad\" [\"balls.so\" \"3\"] [-1 1 -1 1 -1 1]\n"
            "# 3 of all\n"
            "##Scene\n"
            "Sides 1\n");
  EXPECT_THAT(told(), ElementsAre(HasSubstr("the values of \"int frame\" are a null pointer")));
}

TEST_F(RiRequests, files_may_be_binary_and_compressed) {
  RtToken binary = "binary", gzip = "gzip";
  RiContext(nullptr);
  begin_file();
  RiOption("rib", "format", &binary, "compression", &gzip, RI_NULL);
  RiSides(1);
  RiEnd();
  std::string bytes = folder_.read("t.rib");
  EXPECT_TRUE(bytes.starts_with("\x1f\x8b"));
  // Before RiBegin it counts for all that follow.
  RtToken ascii = "ascii", none = "none";
  RiOption("rib", "format", &binary, RI_NULL);
  begin_file();
  RiSides(1);
  std::string text = end_file();
  RiOption("rib", "format", &ascii, "compression", &none, RI_NULL);
  auto code = static_cast<char>(RequestId::kSides);
  EXPECT_EQ(text, std::string("\314") + code + "\225Sides\246" + code + "\200\001\n");
  EXPECT_EQ(parse_calls(text).calls.size(), 1u);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRequests, a_program_can_be_made_to_write) {
  ::setenv("ANEMONE_RIB", (folder_ / "t.rib").c_str(), 1);
  RiBegin(RI_NULL);
  ::unsetenv("ANEMONE_RIB");
  RiSides(1);
  EXPECT_EQ(end_file(), "Sides 1\n");
  ::testing::internal::CaptureStdout();
  RiBegin("-");
  RiSides(2);
  RiEnd();
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "##RenderMan RIB\nversion 3.04\nSides 2\n");
}

TEST_F(RiRequests, error_handlers_are_written_when_they_have_names) {
  EXPECT_EQ(rib([] {
              RiErrorHandler(RiErrorIgnore);
              RiErrorHandler(RiErrorPrint);
              RiErrorHandler(remember);
            }),
            "ErrorHandler \"ignore\"\nErrorHandler \"print\"\n");
}

TEST_F(RiRequests, functions_are_carried_out_where_a_file_is_written) {
  static int freed = 0;
  RtBound bound = {-1, 1, -1, 1, -1, 1};
  RtFloat radius = 2;
  EXPECT_EQ(world([&] {
              RiProcedural(
                  &radius, bound,
                  [](RtPointer data, RtFloat detail) {
                    EXPECT_EQ(detail, RI_INFINITY);
                    RtFloat r = *static_cast<RtFloat*>(data);
                    RiSphere(r, -r, r, 360, RI_NULL);
                  },
                  [](RtPointer) { ++freed; });
            }),
            "AttributeBegin\n  Sphere 2 -2 2 360\nAttributeEnd\n");
  EXPECT_EQ(freed, 1);
}

} // namespace
} // namespace render::testing
