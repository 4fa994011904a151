// Named values: every one the table knows either has an effect or says why not, and so does what it does not
// know.
#include "render/rib/parameters.h"
#include "tests/render/render_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace render::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A request that sets the parameter to something other than its default.
std::string request_with(const ParameterInfo& p) {
  std::string name(p.name == "*" ? "something" : p.name);
  std::string value = "[7]";
  size_t width = p.width().value_or(1);
  if (width == 0)
    value = p.name == "filter"            ? "\"box\""
            : p.name == "sense"           ? "\"outside\""
            : p.name == "codes"           ? "\"note31\""
            : p.name.ends_with("hitmode") ? "\"primitive\""
            : p.name == "filemode"        ? "\"rw\""
            : p.name == "shadingmodel"    ? "\"glass\""
                                          : "\"max\"";
  else if (width > 1)
    value = fmt::format("[{}]", fmt::join(std::vector<int>(width, 7), " "));
  if (p.request == RequestId::kOption || p.request == RequestId::kAttribute)
    return fmt::format("{} \"{}\" \"{}\" {}", request_info(p.request).name, p.category, name, value);
  if (p.request == RequestId::kGeometricApproximation)
    return fmt::format("GeometricApproximation \"{}\" 7", name);
  if (p.request == RequestId::kHider)
    return fmt::format("Hider \"{}\" {}\"{}\" {}", p.category.empty() ? "hidden" : p.category,
                       p.category == "depthmask" && p.name != "zfile" ? "\"zfile\" \"a.z\" " : "", name,
                       value);
  if (p.request == RequestId::kDisplay)
    return fmt::format("Display \"a\" \"null\" \"rgb\" \"{}\" {}", name, value);
  return fmt::format("DisplayChannel \"varying color c\" \"{}\" {}", name, value);
}

TEST(Parameters, each_has_an_effect_or_says_why_not) {
  size_t lacking = 0;
  for (const ParameterInfo& p : parameters()) {
    std::string rib = request_with(p), messages = messages_of(rib);
    SCOPED_TRACE(rib);
    if (p.request == RequestId::kOption && p.category == "hider") {
      EXPECT_THAT(messages, HasSubstr("Hider \"something\" is not known and has no effect"));
    } else if (p.lacks.empty()) {
      EXPECT_EQ(messages, "");
    } else {
      EXPECT_THAT(messages, HasSubstr(fmt::format("\" has no effect: {}", p.lacks)));
      ++lacking;
    }
  }
  EXPECT_GT(lacking, 10u);
}

TEST(Parameters, rows_are_unique_and_documented) {
  std::set<std::string> seen;
  for (const ParameterInfo& p : parameters()) {
    std::string key = fmt::format("{} {} {}", request_info(p.request).name, p.category, p.name);
    EXPECT_TRUE(seen.insert(key).second) << key;
    EXPECT_FALSE(p.doc.empty() && p.lacks.empty()) << key;
  }
}

TEST(Parameters, defaults_said_explicitly_are_no_reason_for_a_message) {
  EXPECT_EQ(messages_of("Hider \"hidden\" \"int sigma\" 0 Option \"bucket\" \"order\" \"horizontal\" "
                        "Attribute \"derivatives\" \"int centered\" 1 "
                        "Attribute \"dice\" \"string strategy\" \"planarprojection\""),
            "");
}

TEST(Parameters, messages_come_once_with_place_and_suggestion) {
  std::string m = messages_of("Attribute \"dice\" \"string strategy\" \"x\"\n"
                              "Attribute \"dice\" \"string strategy\" \"y\"");
  EXPECT_THAT(m, HasSubstr("test.rib:1:18: warning: Attribute \"dice\" \"strategy\" has no effect: sizes are "
                           "measured in the image"));
  EXPECT_THAT(m, Not(HasSubstr("test.rib:2")));
  EXPECT_THAT(messages_of("Attribute \"dice\" \"int binery\" 1"),
              HasSubstr("Attribute \"dice\" \"binery\" is not known and has no effect (shaders can read its "
                        "value); did you mean \"binary\"?"));
  EXPECT_THAT(messages_of("Attribute \"dise\" \"int binary\" 1"),
              HasSubstr("Attribute \"dise\" is not known and has no effect (shaders can read its value); did "
                        "you mean \"dice\"?"));
  EXPECT_THAT(messages_of("Hider \"hidden\" \"int x\" 1"),
              HasSubstr("Hider \"x\" is not known and has no "
                        "effect; known are jitter, depthfilter"));
  EXPECT_THAT(messages_of("Hider \"hidden\" \"string zfile\" \"a\""),
              HasSubstr("Hider \"zfile\" is not known"));
  EXPECT_THAT(messages_of("Display \"a\" \"null\" \"rgb\" \"float gama\" 1"),
              HasSubstr("Display \"gama\" is not known here and is left to the file format"));
  EXPECT_EQ(messages_of("Display \"a\" \"null\" \"rgb\" \"string tiff:planarconfig\" \"separate\""), "");
  EXPECT_THAT(
      messages_of("GeometricApproximation \"flatness\" .5"),
      HasSubstr("GeometricApproximation \"flatness\" has no effect: surfaces are diced by ShadingRate"));
}

TEST(Parameters, wrong_types_are_errors_and_change_nothing) {
  EXPECT_THAT(messages_of("Attribute \"dice\" \"string binary\" \"x\""),
              HasSubstr("error: Attribute: \"binary\" takes one number"));
  EXPECT_THAT(messages_of("Option \"limits\" \"bucketsize\" [16]"),
              HasSubstr("\"bucketsize\" takes 2 numbers"));
  EXPECT_THAT(messages_of("Option \"searchpath\" \"shader\" [1]"), HasSubstr("\"shader\" takes one string"));
  EXPECT_THAT(messages_of("GeometricApproximation \"motionfactor\" -1"),
              HasSubstr("\"motionfactor\" takes one number, 0 or more"));
  EXPECT_THAT(messages_of("Attribute \"trimcurve\" \"sense\" \"up\""),
              HasSubstr("\"up\" is not \"inside\" or \"outside\""));
  EXPECT_EQ(messages_of("Option \"limits\" \"othreshold\" [.5] \"zthreshold\" [.5 .5 .5]"), "");
}

TEST(Parameters, requests_that_take_none_and_other_things_without_effect) {
  EXPECT_THAT(messages_of("ArchiveBegin \"a\" \"int x\" 1 ArchiveEnd"),
              HasSubstr("ArchiveBegin \"int x\" is not known and has no effect"));
  EXPECT_THAT(messages_of("ArchiveBegin \"a\" ArchiveEnd ArchiveInstance \"a\" \"int frame\" 36"),
              HasSubstr("ArchiveInstance \"int frame\" is not known and has no effect"));
  EXPECT_THAT(messages_of("ArchiveBegin \"a\" ArchiveEnd ReadArchive \"a\" \"int frame\" 36"),
              HasSubstr("ReadArchive \"int frame\" is not known and has no effect"));
  EXPECT_THAT(messages_of("Shutter 1 0"), HasSubstr("Shutter: it closes before it opens: nothing moves"));
  EXPECT_THAT(messages_of("PixelSamples 1.4 2"),
              HasSubstr("PixelSamples: 1.4 by 2 samples are rounded to 1 by 2"));
  EXPECT_THAT(messages_of("Matte 2"), HasSubstr("Matte: 2 is taken as 1: there is one kind of hole"));
  EXPECT_THAT(messages_of("DepthOfField 1 1 1 WorldBegin WorldEnd"),
              HasSubstr("DepthOfField has no effect: orthographic cameras have no lens"));
  EXPECT_THAT(render_text("Quantize \"glow\" 255 0 255 .5 WorldBegin WorldEnd").messages,
              HasSubstr("Quantize \"glow\" has no effect: no Display shows a channel \"glow\""));
}

TEST(Parameters, hiders_that_are_not_there) {
  EXPECT_THAT(
      messages_of("Hider \"paint\""),
      HasSubstr("Hider \"paint\" is not supported: surfaces hide each other by depth, as by \"hidden\""));
  EXPECT_THAT(messages_of("Hider \"zbuffer\""),
              HasSubstr("Hider \"zbuffer\" is not supported yet: \"hidden\""));
  EXPECT_EQ(messages_of("Hider \"null\""), "");
  EXPECT_THAT(messages_of("PixelVariance .01"), HasSubstr("PixelVariance is not supported yet: the number of "
                                                          "samples is fixed by PixelSamples"));
  EXPECT_THAT(messages_of("MakeBrickMap [\"a.ptc\"] \"a.bkm\""), HasSubstr("no brick map is made"));
  EXPECT_THAT(messages_of("MakeOcclusion [\"a.z\"] \"a.occ\""), HasSubstr("no occlusion map is made"));
}

TEST(Parameters, of_later_releases) {
  const std::string layer = "ShaderLayer \"surface\" \"wood\" \"a\" \"float k\" [1] ";
  const std::string said = messages_of("WorldBegin " + layer + layer +
                                       "Sides 2 "
                                       "ConnectShaderLayers \"surface\" \"a\" \"k\" \"b\" \"k\" WorldEnd");
  const std::string text = "ShaderLayer is of later releases and is skipped: shaders are not put together of "
                           "layers; the last Surface, Displacement ... counts";
  EXPECT_THAT(said, HasSubstr(text));
  EXPECT_EQ(said.find(text), said.rfind(text));
  EXPECT_THAT(said, HasSubstr("ConnectShaderLayers is of later releases"));
  const std::string model = "Attribute \"photon\" \"string shadingmodel\" ";
  const std::string volume = messages_of(model + "\"isotropic\" " + model + "\"isotropic\"");
  EXPECT_THAT(volume, HasSubstr("warning: Attribute: \"shadingmodel\" \"isotropic\" is not known; known are "
                                "\"matte\", \"translucent\""));
  EXPECT_EQ(volume.find("isotropic"), volume.rfind("\"isotropic\" is not known") + 1);
  EXPECT_EQ(messages_of(model + "\"refractive:ior=1.4\" " + model + "\"dielectric\""), "");
  EXPECT_THAT(messages_of(model + "\"glass:ior=0.4\""), HasSubstr("has an index of refraction of 1 or more"));
}

TEST(Parameters, deep_shadow_maps_become_shadow_maps_and_appended_ones_are_told) {
  const Rendered r = render_text("Display \"a.dsm\" \"deepshad\" \"deepopacity\" WorldBegin WorldEnd");
  EXPECT_THAT(r.messages,
              HasSubstr("Display \"deepshad\": maps of more than one depth are not made; a shadow map of "
                        "the first opaque surfaces is, and what is transparent casts no shadow"));
  ASSERT_EQ(r.scene.options.displays.size(), 1u);
  EXPECT_EQ(r.scene.options.displays[0].type, "shadow");
  EXPECT_EQ(r.scene.options.displays[0].mode, "z");
  EXPECT_THAT(
      messages_of("Display \"a.z\" \"shadow\" \"z\" \"float append\" [1]"),
      HasSubstr("\"append\" has no effect: files hold one picture: the last one stays; give each a name of "
                "its own"));
}

} // namespace
} // namespace render::testing
