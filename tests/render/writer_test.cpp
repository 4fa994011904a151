// The RIB writer: what the parser makes of its text is what went in, for every request and in every encoding.
#include "render/rib/writer.h"

#include "render/rib/gzip.h"
#include "render/rib/rib_file.h"
#include "render/rib/write_tokens.h"
#include "tests/render/random_calls.h"
#include "tests/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace render::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

std::string written(const std::vector<RequestCall>& calls, RibFormat format = {}) {
  std::string out;
  RibWriter writer([&](std::string_view text) { out += text; }, format);
  for (const RequestCall& call : calls)
    writer.request(call);
  return out;
}

/// The text parsed and written again.
std::string rewritten(const std::string& text, RibFormat format = {}) {
  std::string out;
  RibWriter writer([&](std::string_view t) { out += t; }, format);
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  parse_rib(text, sources.add("t.rib", text), writer, diagnostics);
  EXPECT_EQ(format_diagnostics(diagnostics, sources), "");
  return out;
}

void expect_round_trip(RibFormat format) {
  RandomCalls random(format.binary ? 1 : 2);
  for (const RequestInfo& info : requests())
    for (int k = 0; k < 40; ++k) {
      RequestCall call = random.make(info.id);
      std::string messages, text = written({call}, format);
      CallList back = parse_calls(text, &messages);
      ASSERT_EQ(messages, "") << info.name << "\n" << text;
      size_t header = info.id == RequestId::kversion ? 0 : 1;
      ASSERT_EQ(back.calls.size(), header + 1) << text;
      ASSERT_EQ(difference(call, back.calls.back()), "") << text;
    }
}

TEST(RibWriter, every_request_comes_back_from_ascii) {
  expect_round_trip({false, 0});
}

TEST(RibWriter, every_request_comes_back_from_binary) {
  expect_round_trip({true, 0});
}

TEST(RibWriter, many_requests_in_one_file_come_back) {
  RandomCalls random(3);
  std::vector<RequestCall> calls;
  for (int k = 0; k < 3; ++k)
    for (const RequestInfo& info : requests())
      if (info.id != RequestId::kversion) calls.push_back(random.make(info.id));
  for (bool binary : {false, true}) {
    CallList back = parse_calls(written(calls, {binary, 0}));
    ASSERT_EQ(back.calls.size(), calls.size() + 1);
    for (size_t i = 0; i < calls.size(); ++i)
      ASSERT_EQ(difference(calls[i], back.calls[i + 1]), "");
  }
}

TEST(RibWriter, text_is_laid_out_by_blocks) {
  std::string text = "##RenderMan RIB\n"
                     "version 3.04\n"
                     "Display \"a \\\"b\\\".tif\" \"file\" \"rgba\" \"int merge\" [1]\n"
                     "WorldBegin\n"
                     "  # a comment\n"
                     "  AttributeBegin\n"
                     "    Surface \"plastic\" \"Kd\" [0.5] \"float[2] st\" [0 1.5]\n"
                     "    IfBegin \"$x\"\n"
                     "      Sphere 1 -1 1 360\n"
                     "    Else\n"
                     "      Polygon \"P\" [0 0 0 1 0 0 0 1.25 0]\n"
                     "    IfEnd\n"
                     "    LightSource \"spot\" 1\n"
                     "    LightSource \"spot\" \"key\"\n"
                     "    DepthOfField -\n"
                     "  AttributeEnd\n"
                     "WorldEnd\n";
  EXPECT_EQ(rewritten(text), text);
}

TEST(RibWriter, headers_are_not_doubled) {
  EXPECT_EQ(rewritten("Sides 1"), "##RenderMan RIB\nversion 3.04\nSides 1\n");
  EXPECT_EQ(rewritten("##RenderMan RIB-Structure 1.0\nversion 3.03 Sides 1"),
            "##RenderMan RIB-Structure 1.0\nversion 3.03\nSides 1\n");
  EXPECT_EQ(rewritten(""), "");
}

TEST(RibWriter, long_arrays_are_wrapped) {
  std::string text = "Polygon \"P\" [";
  for (int i = 0; i < 300; ++i)
    text += std::to_string(i) + ".5 ";
  std::string out = rewritten(text + "]");
  size_t longest = 0, line = 0;
  for (char c : out)
    longest = std::max(longest, line = c == '\n' ? 0 : line + 1);
  EXPECT_LE(longest, 110u);
  EXPECT_EQ(rewritten(out), out);
}

TEST(RibWriter, comments_keep_their_place) {
  CallList list = parse_calls("# one\nSides 1 # two\n##Scene\nColor # inside\n 1 0 0\n# last");
  EXPECT_THAT(list.comments, ElementsAre(Pair(0, " one"), Pair(1, " two"), Pair(1, "#Scene"),
                                         Pair(2, " inside"), Pair(2, " last")));
}

TEST(RibWriter, content_that_is_no_rib_is_kept) {
  std::string text = "##RenderMan RIB\nversion 3.04\n"
                     "ArchiveBegin \"x\" \"string Content-Type\" [\"application/tcl\"]\n"
                     "puts [expr {1 + 2}]\n  \"Sphere\n"
                     "ArchiveEnd \"x\"\nSides 1\n";
  EXPECT_EQ(rewritten(text), text);
  CallList back = parse_calls(rewritten(text, {true, 0}));
  ASSERT_EQ(back.calls.size(), 4u);
  EXPECT_EQ(back.calls[1].data, "puts [expr {1 + 2}]\n  \"Sphere\n");
  // Nor is none at all: its end is looked for as text, too.
  text = "##RenderMan RIB\nversion 3.04\nArchiveBegin \"x\" \"Content-Type\" [\"\"]\nArchiveEnd \"x\"\nSides "
         "1\n";
  EXPECT_EQ(rewritten(text), text);
  back = parse_calls(rewritten(text, {true, 0}));
  ASSERT_EQ(back.calls.size(), 4u);
  EXPECT_EQ(back.calls[1].data, "");
}

TEST(RibWriter, numbers) {
  auto real = [](float x, int precision = 0) {
    std::string s;
    append_real(s, x, precision);
    return s;
  };
  EXPECT_EQ(real(0.1f), "0.1");
  EXPECT_EQ(real(1), "1.0");
  EXPECT_EQ(real(-0.0f), "-0.0");
  EXPECT_EQ(real(1.0f / 3), "0.33333334");
  EXPECT_EQ(real(1.0f / 3, 3), "0.333");
  EXPECT_EQ(real(1e20f), "1e+20");
  EXPECT_EQ(real(std::numeric_limits<float>::infinity()), "1e39");
  EXPECT_EQ(real(std::nanf("")), "0.0");
  std::string encoded;
  append_encoded_integer(encoded, -2);
  append_encoded_integer(encoded, 127);
  append_encoded_integer(encoded, 128);
  constexpr std::string_view kExpected("\200\376\200\177\201\000\200", 7);
  EXPECT_EQ(encoded, kExpected);
}

TEST(RibFile, appears_when_it_is_finished) {
  anemone::test::TempFolder folder;
  std::string name = folder / "a.rib";
  {
    auto file = RibFile::create(name, false);
    ASSERT_TRUE(file);
    (*file)->write("Sides 1\n");
    EXPECT_FALSE(folder.has("a.rib"));
    EXPECT_EQ((*file)->finish(), "");
  }
  EXPECT_EQ(folder.read("a.rib"), "Sides 1\n");
  { auto dropped = RibFile::create(folder / "b.rib", false); }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(RibFile, may_be_compressed) {
  anemone::test::TempFolder folder;
  auto file = RibFile::create(folder / "a.rib", true);
  ASSERT_TRUE(file);
  for (int i = 0; i < 1000; ++i)
    (*file)->write("Sides 1\n");
  ASSERT_EQ((*file)->finish(), "");
  std::string bytes = folder.read("a.rib");
  EXPECT_TRUE(is_gzip(bytes));
  EXPECT_LT(bytes.size(), 200u);
  EXPECT_EQ(unpack_gzip(bytes, 1 << 20).text.size(), 8000u);
}

TEST(RibFile, says_why_it_cannot_be_written) {
  auto file = RibFile::create("/nowhere/a.rib", false);
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error(), HasSubstr("cannot write \"/nowhere/a.rib\": No such file or directory"));
}

} // namespace
} // namespace render::testing
