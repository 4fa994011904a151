// The RIB parser: arguments of all kinds, the text of every message, recovery.
#include "render/rib/parser.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace render {
namespace {

/// Writes calls down as text.
class Recorder : public RiTarget {
public:
  void request(const RequestCall& call) override {
    log += call.info().name;
    for (const Argument& a : call.arguments) {
      if (!a.present) continue;
      for (float x : a.numbers)
        log += fmt::format(" {:g}", x);
      for (int x : a.ints)
        log += fmt::format(" {}i", x);
      for (const std::string& s : a.strings)
        log += fmt::format(" '{}'", s);
    }
    for (const Param& p : call.params) {
      log += fmt::format(" <{}>", p.token);
      for (float x : p.numbers)
        log += fmt::format(" {:g}", x);
      for (const std::string& s : p.strings)
        log += fmt::format(" '{}'", s);
    }
    log += '\n';
  }
  void unknown_request(std::string_view name, std::string_view suggestion, slvm::SourceRange where) override {
    log += fmt::format("?{} {}:{} {}\n", name, where.line, where.column, suggestion);
  }
  std::string log;
};

struct Parsed {
  std::string log, errors;
};

Parsed parse(const std::string& text) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  Recorder recorder;
  slvm::FileId file = sources.add("t.rib", text);
  parse_rib(sources.text(file), file, recorder, diagnostics);
  std::string errors;
  for (const slvm::Diagnostic& d : diagnostics.sorted())
    errors += fmt::format("{}:{}: {}\n", d.where.line, d.where.column, d.text);
  return {recorder.log, errors};
}

TEST(Parser, numeric_requests_take_bare_and_bracketed_arguments) {
  EXPECT_EQ(parse("Sphere 1 -1 1 360").log, "Sphere 1 -1 1 360\n");
  EXPECT_EQ(parse("Sphere [1 -1 1 360] \"Cs\" [1 0 0]").log, "Sphere 1 -1 1 360 <Cs> 1 0 0\n");
  EXPECT_EQ(parse("Color 1 0 0 Color [1 0 0]").log, "Color 1 0 0\nColor 1 0 0\n");
  EXPECT_EQ(parse("Format [640 480 1]").log, "Format 640i 480i 1\n");
}

TEST(Parser, parameter_values_may_be_bare) {
  EXPECT_EQ(parse("Surface \"plastic\" \"Kd\" .5 \"string mode\" \"bake\" \"Cs\" [1 0 0]").log,
            "Surface 'plastic' <Kd> 0.5 <string mode> 'bake' <Cs> 1 0 0\n");
}

TEST(Parser, handles_are_integers_or_strings) {
  EXPECT_EQ(parse("LightSource \"p\" 1 \"intensity\" 4 Illuminate \"key\" 0").log,
            "LightSource 'p' '1' <intensity> 4\nIlluminate 'key' 0i\n");
}

TEST(Parser, basis_is_a_name_or_sixteen_numbers) {
  EXPECT_EQ(parse("Basis \"bezier\" 3 [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] 1").log,
            "Basis 'bezier' 3i 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1i\n");
}

TEST(Parser, optional_arguments) {
  EXPECT_EQ(parse("DepthOfField - DepthOfField 8 .1 5").log, "DepthOfField\nDepthOfField 8 0.1 5\n");
  EXPECT_EQ(parse("SubdivisionMesh \"catmull-clark\" [3] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]").log,
            "SubdivisionMesh 'catmull-clark' 3i 0i 1i 2i <P> 0 0 0 1 0 0 0 1 0\n");
  EXPECT_EQ(
      parse("SubdivisionMesh \"catmull-clark\" [3] [0 1 2] [\"interpolateboundary\"] [0 0] [] [] \"P\" []")
          .log,
      "SubdivisionMesh 'catmull-clark' 3i 0i 1i 2i 'interpolateboundary' 0i 0i <P>\n");
}

TEST(Parser, every_request_of_the_table_is_known_by_name) {
  for (const RequestInfo& r : requests()) {
    EXPECT_EQ(find_request(r.name), &r);
    EXPECT_TRUE(r.outside || r.world) << r.name;
    EXPECT_FALSE(r.doc.empty()) << r.name;
  }
}

TEST(Parser, unknown_requests_are_named_with_the_nearest_known_one) {
  EXPECT_EQ(parse("Sphre 1 -1 1 360 Sides 1").log, "?Sphre 1:1 Sphere\nSides 1i\n");
  EXPECT_EQ(parse("Wibble \"a\" [1 2]").log, "?Wibble 1:1 \n");
}

TEST(Parser, messages_name_request_and_expectation) {
  EXPECT_EQ(parse("Sphere 1 \"x\" 1 360").errors,
            "1:10: Sphere: expected a number for 'zmin', found \"x\"\n");
  EXPECT_EQ(parse("Sphere [1 -1 1]").errors, "1:15: Sphere: expected a number for 'thetamax', found ']'\n");
  EXPECT_EQ(parse("Sphere [1 -1 1 360 5]").errors, "1:20: Sphere: expected ']', found the number 5\n");
  EXPECT_EQ(parse("Sides").errors,
            "1:6: Sides: expected an integer for 'sides', found the end of the file\n");
  EXPECT_EQ(parse("Sides 1.5").errors, "1:7: Sides: expected an integer for 'sides', found the number 1.5\n");
  EXPECT_EQ(parse("Sides 99999999999").errors, "1:7: Sides: 1e+11 is too large for the integer 'sides'\n");
  EXPECT_EQ(parse("Surface Color 1 0 0").errors,
            "1:9: Surface: expected a string for 'name', found the request Color\n");
  EXPECT_EQ(parse("Transform [1 2 3]").errors, "1:11: Transform: 'matrix' takes 16 numbers, found 3\n");
  EXPECT_EQ(parse("Illuminate [1] 1").errors,
            "1:12: Illuminate: expected an integer or a string for 'light', found '['\n");
  EXPECT_EQ(parse("PointsPolygons 3").errors,
            "1:16: PointsPolygons: expected '[' and an array for 'nvertices', found the number 3\n");
  EXPECT_EQ(parse("MotionBegin \"x\"").errors,
            "1:13: MotionBegin: expected an array of numbers for 'times', found \"x\"\n");
}

TEST(Parser, messages_about_parameter_lists) {
  EXPECT_EQ(parse("Disk 0 1 360 \"Cs\"").errors,
            "1:18: Disk: expected a value for \"Cs\", found the end of the file\n");
  EXPECT_EQ(parse("Disk 0 1 360 \"Cs\" [1 \"a\"]").errors,
            "1:25: Disk: the value of \"Cs\" mixes numbers and strings\n");
  EXPECT_EQ(parse("Disk 0 1 360 \"Cs\" [1 Sides 1").errors,
            "1:22: Disk: expected a value of \"Cs\" or ']', found the request Sides\n");
  EXPECT_EQ(parse("Disk 0 1 360 5").errors,
            "1:14: Disk: expected a token string or the next request, found the number 5\n");
  EXPECT_EQ(parse("Display \"a.tif\" \"rgba\" \"compression\" [\"lzw\"]").errors,
            "1:38: Display: found '[' after \"compression\", which was taken for 'mode'; an argument is "
            "missing before it\n");
  EXPECT_EQ(parse("WorldBegin 5").errors,
            "1:12: WorldBegin: expected the next request, found the number 5\n");
  EXPECT_EQ(parse("5 Sides 1").errors, "1:1: expected a request, found the number 5\n");
}

TEST(Parser, an_array_for_an_optional_name) {
  EXPECT_EQ(parse("Projection [\"orthographic\"]").errors,
            "1:12: Projection: expected a token string or the next request, found '['\n");
}

TEST(Parser, goes_on_at_the_next_known_request) {
  Parsed p = parse("Sphere 1 oops [1 2] \"x\"\nSides 1\nColor 1 [\nSides 2");
  EXPECT_EQ(p.log, "Sides 1i\nSides 2i\n");
  EXPECT_EQ(p.errors, "1:10: Sphere: expected a number for 'zmin', found 'oops'\n"
                      "3:9: Color: expected a number for 'color', found '['\n");
}

TEST(Parser, a_real_where_an_integer_is_wanted_is_only_a_warning) {
  Parsed p = parse("Sides 2.0");
  EXPECT_EQ(p.log, "Sides 2i\n");
  EXPECT_EQ(p.errors, "1:7: Sides: 'sides' is an integer, written as a real number\n");
}

TEST(Parser, damaged_text_is_safe) {
  const std::string kText =
      "Display \"a\" \"png\" \"rgba\" \"quantize\" [0 1 0 1]\nWorldBegin LightSource \"x\" 1 \"k\" 2\n"
      "Sphere [1 -1 1 360] \"varying color Cs\" [1 2 3]\nPatch \"bicubic\" \"P\" [1 2 3]\n"
      "SubdivisionMesh \"c\" [3] [0 1 2] [\"hole\"] [1 0] [0] [] \"P\" [0] # end\nWorldEnd\n";
  uint32_t state = 1;
  auto random = [&](size_t below) { return (state = state * 1664525u + 1013904223u, (state >> 8) % below); };
  const std::string kBytes = "[]\"\\-.0e#\n\x80\xff\0 ";
  for (int i = 0; i < 5000; ++i) {
    std::string text = kText;
    for (size_t n = random(6) + 1; n > 0; --n) {
      size_t at = random(text.size());
      switch (random(3)) {
      case 0: text[at] = kBytes[random(kBytes.size())]; break;
      case 1: text.erase(at, random(20)); break;
      default: text.insert(at, text.substr(random(text.size()), random(30))); break;
      }
      if (text.empty()) text.push_back(' ');
    }
    parse(text);
  }
}

} // namespace
} // namespace render
