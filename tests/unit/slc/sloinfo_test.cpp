// What sloinfo lists of small shaders beside their parameters, word for word; sources that have changed.
#include "slc/preprocess/preprocess.h"
#include "tests/unit/slc/tool_fixture.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using slc_test::Tool;
using testing::HasSubstr;

class Sloinfo : public Tool {
protected:
  // The same for source, compiled file and name.
  void expect_listing(const std::string& options, const std::string& shader, const std::string& text) {
    EXPECT_EQ(run("-q " + shader + ".sl"), 0) << output_;
    for (const char* suffix : {".sl", ".slo", ""}) {
      EXPECT_EQ(sloinfo(options + " " + shader + suffix), 0) << output_;
      EXPECT_EQ(output_, text);
    }
  }
};

TEST_F(Sloinfo, messages) {
  write("m.sl",
        "surface m(string which = \"depth\"; output varying color out = 0; output float k[2] = {1, 2}) {\n"
        "  float d = 0, e = 0;\n"
        "  surface(\"depth\", d); surface(\"depth\", e);\n"
        "  displacement(which, e);\n"
        "  atmosphere(concat(which, \"s\"), e);\n"
        "  illuminance(P) { lightsource(\"intensity\", d); out += d; }\n"
        "  out += e;\n"
        "}\n");
  expect_listing("--messages", "m",
                 "surface \"m\"\n"
                 "    messages read\n"
                 "        surface \"depth\": m.sl:3\n"
                 "        displacement, parameter \"which\", by default \"depth\": m.sl:4\n"
                 "        atmosphere, a computed name: m.sl:5\n"
                 "        lightsource \"intensity\": m.sl:6\n"
                 "    outputs\n"
                 "        \"out\" \"output parameter varying color\"\n"
                 "        \"k\" \"output parameter uniform float[2]\"\n");
  write("none.sl", "surface none() {}");
  expect_listing("--messages", "none", "surface \"none\"\n    no messages read\n    no outputs\n");
}

TEST_F(Sloinfo, light_loops_send_and_receive) {
  write("l.sl", "surface l() {\n"
                "  float x = 0;\n"
                "  illuminance(P, \"send:light:gain\", 2, \"light:spread\", x) Ci += Cl * x;\n"
                "}\n");
  expect_listing("--messages", "l",
                 "surface \"l\"\n"
                 "    messages read\n"
                 "        lightsource \"spread\": l.sl:3\n"
                 "    messages sent to lights\n"
                 "        illuminance \"gain\": l.sl:3\n"
                 "    no outputs\n");
}

TEST_F(Sloinfo, gather_reads_messages_and_shoots_rays) {
  write("g.sl",
        "surface g() {\n"
        "  color hit = 0; float length = 0;\n"
        "  gather(\"\", P, N, 0.5, 4, \"surface:Ci\", hit, \"ray:length\", length) Ci += hit + length;\n"
        "  Ci += trace(P, N);\n"
        "}\n");
  expect_listing("--messages --uses", "g",
                 "surface \"g\"\n"
                 "    messages read\n"
                 "        gather \"surface:Ci\": g.sl:3\n"
                 "    no outputs\n"
                 "    functions\n"
                 "        \"trace\" \"color(point P, vector R, @trace)\": 1 call, g.sl:4\n"
                 "    rays\n"
                 "        gather \"\": g.sl:3\n"
                 "        trace: g.sl:4\n"
                 "    derivatives\n"
                 "        gather: g.sl:3\n"
                 "        trace: g.sl:4\n"
                 "    variables read\n"
                 "        Ci N P\n"
                 "    variables written\n"
                 "        Ci\n");
}

TEST_F(Sloinfo, textures_by_constant_parameter_or_computation) {
  write("t.sl", "surface t(string map = \"wood.tex\", other = \"\"; float swap = 0) {\n"
                "  string name = map;\n"
                "  if (swap > 0) name = other;\n"
                "  Ci = texture(name) + color texture(\"a.tex\", u, v) +\n"
                "       environment(concat(map, \".env\"), N);\n"
                "}\n");
  expect_listing(
      "--uses", "t",
      "surface \"t\"\n"
      "    functions\n"
      "        \"concat\" \"string(uniform string parts...)\": 1 call, t.sl:5\n"
      "        \"environment\" \"color(string name, uniform float channel, vector R, "
      "@environment)\": 1 "
      "call, t.sl:5\n"
      "        \"texture\" \"color(string name, uniform float channel, @texture)\": 1 call, t.sl:4\n"
      "        \"texture\" \"color(string name, uniform float channel, float s, float t, "
      "@texture)\": 1 "
      "call, t.sl:4\n"
      "    textures\n"
      "        texture, parameter \"other\", by default \"\": t.sl:4\n"
      "        texture, parameter \"map\", by default \"wood.tex\": t.sl:4\n"
      "        texture \"a.tex\": t.sl:4\n"
      "        environment, a computed name: t.sl:5\n"
      "    derivatives\n"
      "        texture: t.sl:4\n"
      "        environment: t.sl:5\n"
      "    variables read\n"
      "        N s t u v\n"
      "    variables written\n"
      "        Ci\n");
}

TEST_F(Sloinfo, files_of_point_clouds_and_optional_arguments) {
  write("f.sl",
        "surface f(string cloud = \"a.ptc\") {\n"
        "  Ci = occlusion(P, normalize(N), 16, \"environmentmap\", \"sky.env\", \"filename\", cloud);\n"
        "  bake3d(\"out.ptc\", \"\", P, N, \"area\", 1);\n"
        "}\n");
  EXPECT_EQ(sloinfo("--uses f.sl"), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("    textures\n"
                                 "        occlusion \"sky.env\": f.sl:2\n"
                                 "        occlusion, parameter \"cloud\", by default \"a.ptc\": f.sl:2\n"
                                 "        bake3d \"out.ptc\": f.sl:3\n"));
}

TEST_F(Sloinfo, lights_and_functions_that_are_inlined) {
  write("p.sl", "float wide(float x) { return abs(Du(x)); }\n"
                "surface p(string key = \"key\") {\n"
                "  color c = diffuse(normalize(N)) + ambient();\n"
                "  illuminance(key, P, N, 1) { c += Cl; }\n"
                "  illuminance(\"-fill\", P) { c += Cl; }\n"
                "  c += Deriv(s, v) + wide(t);\n"
                "  c *= pow(2, 3);\n" // folded: no call
                "  Ci = c;\n"
                "}\n"
                "light l() { illuminate(point \"world\" (0, 0, 0)) Cl = 1; }\n");
  EXPECT_EQ(sloinfo("--uses p.sl"), 0);
  EXPECT_EQ(output_,
            "surface \"p\"\n"
            "    functions\n"
            "        \"Deriv\" \"float(float num, float den)\": 1 call, p.sl:6\n"
            "        \"Du\" \"float(float x)\": 1 call, p.sl:1\n"
            "        \"abs\" \"float(float x)\": 1 call, p.sl:1\n"
            "        \"ambient\" \"color()\": 1 call, p.sl:3\n"
            "        \"diffuse\" \"color(normal N)\": 1 call, p.sl:3\n"
            "        \"normalize\" \"normal(normal v)\": 1 call, p.sl:3\n"
            "    lights\n"
            "        diffuse, all lights: p.sl:3\n"
            "        ambient: p.sl:3\n"
            "        illuminance, parameter \"key\", by default \"key\": p.sl:4\n"
            "        illuminance \"-fill\": p.sl:5\n"
            "    derivatives\n"
            "        Du: p.sl:1\n"
            "        Deriv: p.sl:6\n"
            "    variables read\n"
            "        Cl L N P s t v\n"
            "    variables written\n"
            "        Ci\n"
            "light \"l\"\n"
            "    functions\n"
            "        \"transform\" \"point(uniform string from, uniform string to, point p)\": 1 call, "
            "p.sl:10\n"
            "    lights\n"
            "        illuminate: p.sl:10\n"
            "    coordinate systems\n"
            "        space \"world\": p.sl:10\n"
            "    variables written\n"
            "        Cl\n");
}

TEST_F(Sloinfo, attributes_options_and_spaces) {
  write("a.sl", "surface a(point from = point \"shader\" (0, 0, 1); string frame = \"object\") {\n"
                "  float x = 0;\n"
                "  attribute(\"user:x\", x); option(\"Frame\", x);\n"
                "  Ci = x + comp(transform(frame, P), 0) + comp(from, 1);\n"
                "}\n");
  expect_listing(
      "--uses", "a",
      "surface \"a\"\n"
      "    functions\n"
      "        \"attribute\" \"uniform float(uniform string name, inout any value)\": 1 call, a.sl:3\n"
      "        \"comp\" \"float(point c, float i)\": 2 calls, a.sl:4\n"
      "        \"option\" \"uniform float(uniform string name, inout any value)\": 1 call, a.sl:3\n"
      "        \"transform\" \"point(uniform string to, point p)\": 1 call, a.sl:4\n"
      "        \"transform\" \"point(uniform string from, uniform string to, point p)\": 1 call, a.sl:1\n"
      "    attributes and options\n"
      "        attribute \"user:x\": a.sl:3\n"
      "        option \"Frame\": a.sl:3\n"
      "    coordinate systems\n"
      "        space \"shader\": a.sl:1\n"
      "        space, parameter \"frame\", by default \"object\": a.sl:4\n"
      "    variables read\n"
      "        P\n"
      "    variables written\n"
      "        Ci\n");
}

TEST_F(Sloinfo, source_map_and_disassembly) {
  write("half.h", "float half(float x) { return x / 2; }\n");
  write("a.sl", "#include \"half.h\"\nsurface a() {\n  float h = half(u);\n  Ci = h;\n}\n");
  expect_listing("--source-map", "a",
                 "surface \"a\"\n"
                 "     0-2  a.sl:4    Ci = h;\n"
                 "     3-6  half.h:1  float half(float x) { return x / 2; }\n"
                 "    7-11  a.sl:4    Ci = h;\n");
  expect_listing("--disassemble", "a",
                 "surface \"a\": 0 uniform, 1 strip, 0 grid planes, mask depth 0\n"
                 "main:\n"
                 "; a.sl:4: Ci = h;\n"
                 "    0   strip ->10, 0\n"
                 "; half.h:1: float half(float x) { return x / 2; }\n"
                 "    3     s0 = operator/ u, c0(2)\n"
                 "; a.sl:4: Ci = h;\n"
                 "    7     Ci = convert s0\n"
                 "   10   endstrip\n"
                 "   11   end\n");
  ASSERT_EQ(run("-q -o far.slo a.sl"), 0);
  std::filesystem::create_directory(folder_ / "away");
  std::filesystem::rename(folder_ / "far.slo", folder_ / "away/far.slo");
  std::filesystem::remove(folder_ / "a.sl");
  EXPECT_EQ(sloinfo("--source-map away/far.slo"), 0); // without the source
  EXPECT_EQ(output_, "surface \"a\"\n"
                     "     0-2  a.sl:4\n"
                     "     3-6  half.h:1\n"
                     "    7-11  a.sl:4\n");
}

TEST_F(Sloinfo, sources_and_whether_they_have_changed) {
  write("k.h", "#define K 1\n");
  write("a.sl", "#include \"k.h\"\n#include \"noises.h\"\nsurface a() { Ci = K; }\n");
  expect_listing("--sources", "a",
                 "surface \"a\"\n"
                 "    compiled by slc (Anemone) 0.1.0\n"
                 "    source hash 6c04a2c8c4e04148\n"
                 "    \"a.sl\" unchanged\n"
                 "    \"k.h\" unchanged\n");
  write("k.h", "#define K 2\n");
  EXPECT_EQ(sloinfo("--sources a.slo"), 0);
  EXPECT_THAT(output_,
              HasSubstr("sloinfo: warning: a.slo is older than its source: k.h has changed; compile it "
                        "again with slc\n"));
  EXPECT_THAT(output_, HasSubstr("    \"k.h\" changed\n"));
  std::filesystem::remove(folder_ / "k.h");
  EXPECT_EQ(sloinfo("--sources a.slo"), 0);
  EXPECT_EQ(output_.find("warning"), std::string::npos);
  EXPECT_THAT(output_, HasSubstr("    \"k.h\" not found\n"));
}

TEST_F(Sloinfo, listings_as_json) {
  write("a.sl", "surface a(output varying float d = 0) {\n  d = length(Du(P));\n}\n");
  EXPECT_EQ(sloinfo("--messages --source-map --json a.sl"), 0);
  EXPECT_EQ(output_, R"({
  "schema": "anemone-sloinfo",
  "version": 1,
  "shaders": [
    {
      "kind": "surface",
      "name": "a",
      "source": "a.sl",
      "source_hash": "809011b6379249ab",
      "messages_read": [],
      "messages": {
        "reads": [],
        "sends": [],
        "outputs": [
          "d"
        ]
      },
      "source_map": [
        {
          "begin": 0,
          "end": 4,
          "file": "a.sl",
          "line": 2,
          "column": 14,
          "text": "d = length(Du(P));"
        },
        {
          "begin": 4,
          "end": 7,
          "file": "a.sl",
          "line": 2,
          "column": 3,
          "text": "d = length(Du(P));"
        },
        {
          "begin": 7,
          "end": 10,
          "file": "a.sl",
          "line": 2,
          "column": 7,
          "text": "d = length(Du(P));"
        },
        {
          "begin": 10,
          "end": 12,
          "file": "a.sl",
          "line": 2,
          "column": 3,
          "text": "d = length(Du(P));"
        }
      ]
    }
  ]
}
)");
}

TEST_F(Sloinfo, json_has_everything_but_the_code_or_what_is_asked_for) {
  write("a.sl", "surface a(output varying float d = 0) {\n  d = length(Du(P));\n}\n");
  EXPECT_EQ(sloinfo("--json a.sl"), 0); // all but the code
  for (const char* key : {"parameters", "annotations", "uses", "shadeops", "texture_names", "plugins",
                          "calls", "textures", "rays", "lights", "derivatives", "queries", "spaces",
                          "variables", "messages_read", "messages", "compiler", "sources"})
    EXPECT_THAT(output_, HasSubstr("\"" + std::string(key) + "\": ")) << key;
  EXPECT_EQ(output_.find("source_map"), std::string::npos);
  EXPECT_EQ(sloinfo("--json --uses a.sl"), 0);
  EXPECT_THAT(output_, HasSubstr(R"(      "derivatives": [
        {
          "by": "Du",
          "name": null,
          "named_by": "nothing",
          "places": [
            {
              "file": "a.sl",
              "line": 2,
              "column": 14
            }
          ]
        }
      ],
)"));
  EXPECT_EQ(output_.find("\"parameters\""), std::string::npos);
  EXPECT_EQ(sloinfo("--json --disassemble --sources a.sl"), 0);
  EXPECT_THAT(output_, HasSubstr("\"disassembly\": \"surface \\\"a\\\": "));
  EXPECT_THAT(output_, HasSubstr("\"state\": \"unchanged\""));
}

TEST_F(Sloinfo, the_example_of_the_schema_is_true) {
  std::string page = slc::read_file(SLOINFO_SCHEMA).value_or("");
  size_t source = page.find("    light pointlight("), json = page.find("```json\n", source);
  ASSERT_NE(json, page.npos);
  std::string text = page.substr(source, page.find("\n\n", source) + 1 - source);
  for (size_t line = 0; line != text.npos && line < text.size(); line = text.find('\n', line) + 1)
    text.erase(line, 4);
  write("pointlight.sl", text);
  ASSERT_EQ(sloinfo("--json pointlight.sl"), 0) << output_;
  json += 8;
  using Json = nlohmann::json;
  EXPECT_EQ(Json::parse(page.substr(json, page.find("```", json) - json)), Json::parse(output_));
}

TEST_F(Sloinfo, options_that_contradict_each_other) {
  write("a.sl", "surface a(float k = 1) { Ci = k; }");
  EXPECT_EQ(sloinfo("--uses --param k a.sl"), 2);
  EXPECT_THAT(output_, HasSubstr("--param excludes --uses"));
  EXPECT_EQ(sloinfo("-p --messages a.sl"), 2);
  EXPECT_EQ(sloinfo("-m --disassemble a.sl"), 2);
  EXPECT_EQ(sloinfo("-m --json a.sl"), 2);
  EXPECT_EQ(sloinfo("--json --param k a.sl"), 0);
}

} // namespace
