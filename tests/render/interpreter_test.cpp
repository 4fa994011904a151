// The graphics state: what requests do to it, and the text of its messages.
#include "tests/render/render_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace render::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The scene of the text's last world block.
Scene scene_of(const std::string& rib) {
  return render_text("Format 4 4 1\n" + rib).scene;
}

TEST(Interpreter, attributes_are_scoped_by_blocks) {
  Scene s =
      scene_of("WorldBegin Color 1 0 0 AttributeBegin Color 0 1 0 Sides 1 Sphere 1 -1 1 360 AttributeEnd "
               "Sphere 1 -1 1 360 WorldEnd");
  ASSERT_EQ(s.primitives.size(), 2u);
  EXPECT_EQ(s.primitives[0].attributes().color, Color(0, 1, 0));
  EXPECT_EQ(s.primitives[0].attributes().sides, 1);
  EXPECT_EQ(s.primitives[1].attributes().color, Color(1, 0, 0));
  EXPECT_EQ(s.primitives[1].attributes().sides, 2);
}

TEST(Interpreter, transform_blocks_keep_attributes) {
  Scene s = scene_of("Translate 0 0 5 WorldBegin TransformBegin Translate 1 0 0 Color 1 0 0 TransformEnd "
                     "Sphere 1 -1 1 360 WorldEnd");
  ASSERT_EQ(s.primitives.size(), 1u);
  EXPECT_EQ(s.primitives[0].attributes().color, Color(1, 0, 0));
  EXPECT_EQ(transform_point(s.primitives[0].state->object_to_camera, Vec3{0, 0, 0}), Vec3(0, 0, 5));
}

TEST(Interpreter, transform_and_identity_are_relative_to_the_world) {
  Scene s = scene_of("Translate 0 0 5 WorldBegin Transform [1 0 0 0 0 1 0 0 0 0 1 0 2 0 0 1] Disk 0 1 360 "
                     "Identity Disk 0 1 360 WorldEnd");
  EXPECT_EQ(transform_point(s.primitives[0].state->object_to_camera, Vec3{0, 0, 0}), Vec3(2, 0, 5));
  EXPECT_EQ(transform_point(s.primitives[1].state->object_to_camera, Vec3{0, 0, 0}), Vec3(0, 0, 5));
}

TEST(Interpreter, coordinate_systems_are_global_and_scoped_ones_are_not) {
  Scene s = scene_of(
      "WorldBegin AttributeBegin Translate 3 0 0 CoordinateSystem \"a\" ScopedCoordinateSystem \"b\" "
      "AttributeEnd CoordSysTransform \"a\" Disk 0 1 360 CoordSysTransform \"b\" WorldEnd");
  EXPECT_EQ(transform_point(s.primitives[0].state->object_to_camera, Vec3{0, 0, 0}), Vec3(3, 0, 0));
  EXPECT_THAT(messages_of("CoordSysTransform \"b\""), HasSubstr("no coordinate system is named \"b\""));
}

TEST(Interpreter, ndc_space_is_the_unit_square_of_the_image) {
  Scene s = scene_of("WorldBegin CoordSysTransform \"NDC\" Disk 0 1 360 WorldEnd");
  Vec3 corner = transform_point(s.primitives[0].state->object_to_camera, Vec3{0, 0, 0});
  EXPECT_NEAR(corner.x, -1, 1e-6f);
  EXPECT_NEAR(corner.y, 1, 1e-6f);
}

TEST(Interpreter, lights_are_listed_in_order_and_switched) {
  Scene s = scene_of(
      "WorldBegin LightSource \"a\" 1 LightSource \"b\" \"two\" Illuminate 1 0 Disk 0 1 360 WorldEnd");
  const auto& lights = s.primitives[0].attributes().lights;
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0]->name, "b");
  EXPECT_THAT(messages_of("Illuminate 7 1"), HasSubstr("error: Illuminate: no light has the handle \"7\""));
}

TEST(Interpreter, a_handle_that_is_used_again_names_the_new_light_beside_the_old) {
  Scene s = scene_of("WorldBegin LightSource \"a\" 2 LightSource \"b\" 2 Disk 0 1 360 Illuminate 2 0 "
                     "Disk 0 1 360 WorldEnd");
  ASSERT_EQ(s.primitives[0].attributes().lights.size(), 2u);
  ASSERT_EQ(s.primitives[1].attributes().lights.size(), 1u);
  EXPECT_EQ(s.primitives[1].attributes().lights[0]->name, "a");
}

TEST(Interpreter, frames_restore_options) {
  Scene s = scene_of("FrameBegin 1 Format 8 8 1 Clipping 1 10 FrameEnd WorldBegin WorldEnd");
  EXPECT_EQ(s.options.xres, 4);
  EXPECT_NE(s.options.far_plane, 10);
}

TEST(Interpreter, objects_and_inline_archives_are_replayed) {
  Scene s =
      scene_of("WorldBegin ObjectBegin 1 Color 0 1 0 Disk 0 1 360 ObjectEnd Color 1 0 0 Translate 1 0 0 "
               "ObjectInstance 1 Disk 0 1 360 ArchiveBegin \"a\" Translate 1 0 0 ArchiveEnd "
               "ReadArchive \"a\" ArchiveInstance \"a\" Disk 0 1 360 WorldEnd");
  ASSERT_EQ(s.primitives.size(), 3u);
  EXPECT_EQ(s.primitives[0].attributes().color, Color(0, 1, 0));
  EXPECT_EQ(s.primitives[1].attributes().color, Color(1, 0, 0));
  EXPECT_EQ(transform_point(s.primitives[2].state->object_to_camera, Vec3{0, 0, 0}), Vec3(3, 0, 0));
}

TEST(Interpreter, archives_that_contain_themselves_end) {
  EXPECT_THAT(messages_of("ArchiveBegin \"a\" ReadArchive \"a\" ArchiveEnd ReadArchive \"a\""),
              HasSubstr("archives and instances are nested more than 64 deep"));
}

TEST(Interpreter, a_motion_block_moves_what_follows) {
  Rendered r =
      render_text("Format 4 4 1 Shutter 1 3 WorldBegin MotionBegin [0 4] Translate 1 0 0 Translate 5 0 0 "
                  "MotionEnd Scale 2 1 1 Translate 0 0 5 Disk 0 9 360 WorldEnd");
  EXPECT_EQ(r.messages, "");
  const PrimitiveState& s = *r.scene.primitives[0].state;
  EXPECT_FLOAT_EQ(s.object_to_camera(3, 0), 2);
  ASSERT_EQ(s.motion.size(), 2u);
  EXPECT_FLOAT_EQ(s.motion[0].value(3, 0), 2);
  EXPECT_FLOAT_EQ(s.motion[1].value(3, 0), 4);
  EXPECT_FLOAT_EQ(s.motion[1].value(0, 0), 2);
}

TEST(Interpreter, motion_ends_with_the_block_that_surrounds_it) {
  Rendered r = render_text(
      "Format 4 4 1 Shutter 0 1 WorldBegin TransformBegin MotionBegin [0 .5 1] Translate 1 0 0 "
      "Translate 3 0 0 Translate 4 0 0 MotionEnd Disk 5 9 360 TransformEnd Disk 5 9 360 WorldEnd");
  EXPECT_EQ(r.scene.primitives[0].state->motion.size(), 3u);
  EXPECT_TRUE(r.scene.primitives[1].state->motion.empty());
}

TEST(Interpreter, a_closed_shutter_sees_the_moment_it_opens) {
  Rendered r =
      render_text("Format 4 4 1 Shutter .5 .5 WorldBegin MotionBegin [0 1] Translate 0 0 0 Translate 4 0 0 "
                  "MotionEnd Disk 5 9 360 WorldEnd");
  EXPECT_TRUE(r.scene.primitives[0].state->motion.empty());
  EXPECT_FLOAT_EQ(r.scene.primitives[0].state->object_to_camera(3, 0), 2);
}

TEST(Interpreter, a_moving_camera_moves_the_world) {
  Rendered r =
      render_text("Format 4 4 1 Shutter 0 1 MotionBegin [0 1] Translate 0 0 5 Translate 1 0 5 MotionEnd "
                  "WorldBegin Disk 0 9 360 Identity Disk 0 9 360 WorldEnd");
  for (const Primitive& p : r.scene.primitives) {
    ASSERT_EQ(p.state->motion.size(), 2u);
    EXPECT_FLOAT_EQ(p.state->motion[1].value(3, 0), 1);
    EXPECT_FLOAT_EQ(p.state->motion[1].value(3, 2), 5);
  }
}

TEST(Interpreter, shapes_of_a_motion_block_become_one_primitive) {
  Rendered r = render_text("Format 4 4 1 Shutter 0 1 WorldBegin Translate 0 0 5 MotionBegin [0 1] "
                           "Sphere 1 -1 1 360 Sphere 2 -2 2 360 MotionEnd WorldEnd");
  ASSERT_EQ(r.scene.primitives.size(), 1u);
  EXPECT_EQ(r.scene.primitives[0].deformation.size(), 2u);
  EXPECT_NEAR(r.scene.primitives[0].camera_bound({}).max.x, 2, 1e-3f);
}

TEST(Interpreter, mistakes_in_motion_blocks) {
  std::string head = "WorldBegin ";
  EXPECT_THAT(messages_of(head + "MotionBegin [] MotionEnd WorldEnd"), HasSubstr("has at least one time"));
  EXPECT_THAT(messages_of(head + "MotionBegin [1 0] Translate 0 0 0 Translate 0 0 1 MotionEnd WorldEnd"),
              HasSubstr("times must increase, found 0 after 1"));
  EXPECT_THAT(messages_of(head + "MotionBegin [0 1] Translate 0 0 0 MotionEnd WorldEnd"),
              HasSubstr("the block has 2 times, but 1 requests"));
  EXPECT_THAT(
      messages_of(head +
                  "MotionBegin [0 1] Translate 0 0 0 Translate 0 0 1 Translate 0 0 2 MotionEnd WorldEnd"),
      HasSubstr("has 2 times; further requests in it are skipped"));
  EXPECT_THAT(messages_of(head + "MotionBegin [0 1] Translate 0 0 0 Scale 1 1 1 MotionEnd WorldEnd"),
              HasSubstr("a motion block repeats one request; the first was Translate"));
  EXPECT_THAT(messages_of(head + "MotionBegin [0 1] Color 0 0 0 Color 1 1 1 MotionEnd WorldEnd"),
              HasSubstr("Color does not move: the first one in the motion block counts"));
  EXPECT_THAT(messages_of(head + "MotionBegin [0 1] Polygon \"P\" [0 0 0 1 0 0 1 1 0] "
                                 "Polygon \"P\" [0 0 0 1 0 0 1 1 0 0 1 0 -1 .5 0] MotionEnd WorldEnd"),
              HasSubstr("at the first time of the motion block it was"));
}

TEST(Interpreter, depth_of_field_and_hiders) {
  auto options = [](const std::string& text) {
    return render_text("Format 1 1 1 " + text + " WorldBegin WorldEnd").scene.options;
  };
  EXPECT_EQ(options("DepthOfField 2 .1 5").focal_distance, 5);
  EXPECT_EQ(options("DepthOfField 2 .1 5 DepthOfField -").fstop, kInfinity);
  EXPECT_THAT(messages_of("DepthOfField 2 0 5"),
              HasSubstr("expected f-stop, focal length and focal distance"));
  EXPECT_EQ(options("Hider \"hidden\" \"depthfilter\" \"midpoint\"").depth_filter, DepthFilter::kMidpoint);
  EXPECT_TRUE(options("Hider \"hidden\" \"int subpixel\" 1").subpixel);
  EXPECT_THAT(messages_of("Hider \"hidden\" \"depthfilter\" \"x\""),
              HasSubstr("unknown depthfilter \"x\"; known are min"));
  Options o = options("Hider \"depthmask\" \"zfile\" \"a.z\" \"reversesign\" 1 \"depthbias\" .5");
  ASSERT_TRUE(o.depth_mask);
  EXPECT_EQ(o.depth_mask->file, "a.z");
  EXPECT_TRUE(o.depth_mask->reverse);
  EXPECT_EQ(o.depth_mask->bias, 0.5f);
  EXPECT_THAT(messages_of("Hider \"depthmask\""), HasSubstr("\"depthmask\" needs \"zfile\""));
}

TEST(Interpreter, requests_without_effect_are_named_once) {
  std::string m = messages_of("WorldBegin\nDeformation \"bend\"\nDeformation \"bend\"\nWorldEnd");
  EXPECT_THAT(m, HasSubstr("test.rib:2:1: warning: Deformation is not supported yet: nothing is deformed"));
  EXPECT_THAT(m, Not(HasSubstr("test.rib:3:1")));
  EXPECT_THAT(messages_of("Frobnicate 1 Frobnicate 2"), HasSubstr("warning: unknown request Frobnicate"));
  EXPECT_THAT(messages_of("Srface \"x\""), HasSubstr("unknown request Srface; did you mean Surface?"));
  EXPECT_EQ(messages_of("Attribute \"trace\" \"bias\" .1"), "");
  EXPECT_THAT(messages_of("Attribute \"dice\" \"strategy\" \"a\""),
              HasSubstr("Attribute \"dice\" \"strategy\" has no effect: sizes are measured in the image"));
  EXPECT_THAT(messages_of("Option \"bucket\" \"order\" \"circle\""),
              HasSubstr("Option \"bucket\" \"order\" has no effect: buckets are rendered in rows"));
  EXPECT_THAT(messages_of("Option \"statistics\" \"filename\" \"a\""),
              HasSubstr("Option \"statistics\" \"filename\" has no effect: slrender --statisticsfile"));
  EXPECT_THAT(
      messages_of("Attribute \"cull\" \"int x\" 1"),
      HasSubstr("Attribute \"cull\" \"x\" is not known and has no effect (shaders can read its value); "
                "known are hidden, backfacing"));
  EXPECT_THAT(messages_of("Hider \"stochastic\""), HasSubstr("Hider \"stochastic\" is not supported yet"));
}

TEST(Interpreter, error_handlers) {
  EXPECT_EQ(messages_of("ErrorHandler \"ignore\" Sides 3 ShadingRate 0 Frobnicate 1"), "");
  EXPECT_THAT(messages_of("ErrorHandler \"ignore\" ErrorHandler \"print\" Sides 3"),
              HasSubstr("1 or 2 sides"));
  std::string m = messages_of("ErrorHandler \"abort\" Sides 3\nSides 4 Sides 5");
  EXPECT_THAT(m, HasSubstr("1 or 2 sides"));
  EXPECT_THAT(
      m,
      HasSubstr("test.rib:2:1: warning: Sides: after an error ErrorHandler \"abort\" ends the scene here"));
  EXPECT_THAT(m, Not(HasSubstr("2:1: error")));
}

TEST(Interpreter, requests_in_the_wrong_place) {
  EXPECT_THAT(
      messages_of("Sphere 1 -1 1 360"),
      HasSubstr("error: Sphere: this belongs between WorldBegin and WorldEnd; the request is skipped"));
  EXPECT_THAT(messages_of("WorldBegin Format 1 1 1 WorldEnd"),
              HasSubstr("error: Format: options cannot change inside a world block; the request is skipped"));
  EXPECT_THAT(messages_of("AttributeEnd"), HasSubstr("AttributeEnd: there is no open AttributeBegin"));
  EXPECT_THAT(messages_of("WorldBegin AttributeBegin WorldEnd"),
              HasSubstr("WorldEnd: AttributeBegin is still open"));
  EXPECT_THAT(messages_of("AttributeBegin WorldBegin AttributeEnd WorldEnd AttributeEnd"),
              HasSubstr("AttributeEnd: there is no open AttributeBegin"));
  EXPECT_THAT(messages_of("WorldBegin"), HasSubstr("nothing is rendered: WorldEnd is missing"));
  EXPECT_THAT(messages_of("ArchiveBegin \"a\""),
              HasSubstr("1:1: error: ArchiveBegin \"a\" is not closed by ArchiveEnd"));
  EXPECT_THAT(messages_of("ObjectEnd"), HasSubstr("ObjectEnd: there is no open ObjectBegin"));
  EXPECT_THAT(messages_of("Else"), HasSubstr("Else: there is no open IfBegin"));
}

TEST(Interpreter, values_out_of_range) {
  const std::pair<const char*, const char*> kCases[] = {
      {"Projection \"fisheye\"", "unknown projection \"fisheye\""},
      {"Projection \"perspective\" \"fov\" 180", "\"fov\" takes one number between 0 and 180 degrees"},
      {"Clipping 5 1", "the near plane (5) is not in front of the far one (1)"},
      {"CropWindow .5 .5 0 1", "the window is empty"},
      {"ScreenWindow 0 0 0 1", "the window has no area"},
      {"PixelSamples 0 1", "expected 1 to 64 samples in each direction"},
      {"PixelFilter \"bos\" 1 1", "unknown filter \"bos\"; known are box, triangle, gaussian"},
      {"PixelFilter \"box\" 0 1", "expected widths above 0"},
      {"Exposure 1 0", "gamma must be positive"},
      {"Quantize \"rgba\" 255 255 0 .5", "min is larger than max"},
      {"ShadingRate 0", "the shading rate must be positive"},
      {"ShadingInterpolation \"flat\"", "\"flat\" is not \"constant\" or \"smooth\""},
      {"Orientation \"up\"", "\"up\" is not \"outside\", \"inside\", \"lh\" or \"rh\""},
      {"Sides 3", "a surface has 1 or 2 sides"},
      {"Rotate 90 0 0 0", "the axis has no length"},
      {"Skew 90 0 1 0 1 0 0", "the angle must be smaller than the angle between the two axes"},
      {"Perspective 0", "the field of view must be between 0 and 180 degrees"},
      {"Basis \"bspline\" 1 \"bezier\" 3", "unknown basis \"bspline\""},
      {"Declare \"x\" \"varyin color\"", "\"varyin color\" is not a declaration"},
      {"Declare \"x\" \"float[0]\"", "'0' is not an array length"},
      {"Display \"a.tiff\" \"rgba\" \"x\"", "\"rgba\" is a mode; the type is missing"},
      {"ErrorHandler \"panic\"", "unknown handler \"panic\"; known are ignore, print, abort"},
      {"ReadArchive \"nowhere.rib\"", "no archive \"nowhere.rib\" in the search path \".\""},
      {"WorldBegin ObjectInstance 1 WorldEnd", "no object \"1\" was recorded"},
  };
  for (auto [rib, message] : kCases)
    EXPECT_THAT(messages_of(rib), HasSubstr(message)) << rib;
}

TEST(Interpreter, geometry_that_cannot_be) {
  auto in_world = [](const std::string& rib) { return messages_of("WorldBegin " + rib + " WorldEnd"); };
  const std::pair<const char*, const char*> kCases[] = {
      {"Sphere 0 -1 1 360",
       "warning: Sphere: the radius is zero; nothing is drawn, here and wherever it is so"},
      {"Sphere 1 -1 1 0", "warning: Sphere: thetamax is zero; nothing is drawn"},
      {"Sphere 1 1 1 360", "warning: Sphere: zmin equals zmax; nothing is drawn"},
      {"Paraboloid 1 -1 0 360",
       "warning: Paraboloid: zmax is zero; a paraboloid has its apex there; nothing"},
      {"Cylinder 1 2 2 360", "warning: Cylinder: zmin equals zmax; nothing is drawn"},
      {"Torus 1 0 0 360 360", "warning: Torus: the minor radius is zero; nothing is drawn"},
      {"Hyperboloid 1 0 0 1 0 0 360", "warning: Hyperboloid: its two points are the same; nothing is drawn"},
      {"Sphere 1 -1 1 360 \"Cs\" [1 0 0 1 0 0]",
       "error: Sphere: \"Cs\" (varying color) takes 12 numbers, found 6"},
      {"Sphere 1 -1 1 360 \"Cs\" [1 0 0]",
       "warning: Sphere: \"Cs\" (varying color) takes 12 numbers, found 3; this value "
       "holds all over the primitive"},
      {"Sphere 1 -1 1 360 \"s\" [1 2 3 4 5]",
       "warning: Sphere: \"s\" (varying float) takes 4 numbers, found 5; those left "
       "over are not used"},
      {"Sphere 1 -1 1 360 \"foo\" [1]", "Sphere: \"foo\" is not declared"},
      {"Sphere 1 -1 1 360 \"widht\" [1]", "\"widht\" is not declared; did you mean \"width\"?"},
      {"Sphere 1 -1 1 360 \"varying string x\" [\"a\" \"b\" \"c\" \"d\"]",
       "is a string and cannot be varying"},
      {"Polygon \"N\" [0 0 1]", "Polygon: \"P\" is missing"},
      {"Polygon \"P\" [0 0 0 1 1 1]", "a polygon has at least 3 vertices, found 2"},
      {"PointsPolygons [2 3] [0 1 0 1 2] \"P\" [0 0 0 1 1 1 0 1 0]",
       "warning: PointsPolygons: 1 of 2 faces cannot be drawn and is left out; face 0, counted from 0, has 2 "
       "vertices"},
      {"PointsPolygons [3] [0 1] \"P\" [0 0 0 1 1 1]", "'nvertices' asks for 3 vertex numbers, found 2"},
      {"PointsPolygons [3] [0 0 -2] \"P\" [0 0 0]",
       "face 0, counted from 0, has the vertex -2, and there are 1"},
      {"PointsPolygons [3 3] [0 1 2 2 1 0] \"P\" [0 0 0]",
       "warning: PointsPolygons: 2 of 2 faces cannot be drawn and are left out; the first, face 0, counted "
       "from "
       "0, has the vertex 1, and there are 1"},
      {"Patch \"bicubic\" \"P\" [0 0 0]", "\"P\" (vertex point) takes 48 numbers, found 3"},
      {"Patch \"cubic\" \"P\" [0 0 0]", "unknown type \"cubic\""},
  };
  for (auto [rib, message] : kCases)
    EXPECT_THAT(in_world(rib), HasSubstr(message)) << rib;
}

TEST(Interpreter, declarations_of_all_forms) {
  Scene s = scene_of("Declare \"heat\" \"varying float\" WorldBegin Sphere 1 -1 1 360 \"heat\" [0 1 2 3] "
                     "\"constant float foo\" [.1] \"varying float[2] bar2\" [0 0 1 1 2 2 3 3] "
                     "\"uniform   string name\" [\"x\"] \"constant float bar3[2]\" [1 2] WorldEnd");
  const auto& vars = s.primitives[0].vars;
  ASSERT_EQ(vars.size(), 5u);
  EXPECT_EQ(vars[4].name, "bar3");
  EXPECT_EQ(vars[4].elements, 2u);
  EXPECT_EQ(vars[0].name, "heat");
  EXPECT_EQ(vars[1].interpolation, Interpolation::kConstant);
  EXPECT_EQ(vars[2].elements, 2u);
  EXPECT_EQ(vars[3].strings[0], "x");
}

} // namespace
} // namespace render::testing
