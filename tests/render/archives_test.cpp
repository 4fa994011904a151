// Files, archives and objects: where they are found, in which encodings, and what bounds them.
#include "render/state/interpreter.h"
#include "tests/render/render_text.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>

namespace render::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using ::testing::HasSubstr;
using ::testing::Not;

class Archives : public ::testing::Test {
protected:
  void file(const std::string& name, const std::string& text) { folder_.write(name, text); }
  void packed(const std::string& name, const std::string& text) {
    gzFile out = gzopen((folder_ / name).c_str(), "wb");
    gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
    gzclose(out);
  }
  /// Scene text that finds archives in the test's folder.
  Rendered in_world(const std::string& rib) {
    return render_text("Format 4 4 1 Option \"searchpath\" \"archive\" [\"" + folder_.string() +
                       ":&\"]\nWorldBegin " + rib + " WorldEnd");
  }

  anemone::test::TempFolder folder_;
};

const std::string kEncodedDisk = "\314\x05\224Disk\246\x05\200\x00\244\x3f\x80\x00\x00\201\x01\x68"s;

TEST_F(Archives, ascii_encoded_and_compressed_ones_mix) {
  file("a.rib", "Disk 0 1 360 ReadArchive \"b.rib\"");
  file("b.rib", kEncodedDisk + " ReadArchive \"c.rib.gz\" "s + kEncodedDisk);
  packed("c.rib.gz", "Disk 0 2 360 " + kEncodedDisk);
  Rendered r = in_world("ReadArchive \"a.rib\" ReadArchive \"a.rib\"");
  EXPECT_EQ(r.messages, "");
  EXPECT_EQ(r.scene.primitives.size(), 10u);
}

TEST_F(Archives, messages_about_encoded_files_name_the_byte) {
  file("a.rib", "Sphere \200\x01\xa9"s);
  std::string m = in_world("ReadArchive \"a.rib\"").messages;
  EXPECT_THAT(
      m,
      HasSubstr("a.rib:1:10: error: Sphere: byte 0xa9 has no meaning in a RIB file (byte 9 of the file)\n"));
  file("cut.rib", "Disk 0 1 \243\x7f"s);
  EXPECT_THAT(in_world("ReadArchive \"cut.rib\"").messages,
              HasSubstr("an encoded item needs 4 bytes more, the file has 1 (byte 9 of the file)"));
}

TEST_F(Archives, damaged_compression_is_named_and_the_rest_is_used) {
  std::string many;
  for (int i = 0; i < 2000; ++i)
    many += fmt::format("Disk {} 1 360\n", i);
  packed("a.rib.gz", many);
  fs::resize_file(folder_ / "a.rib.gz", 3000);
  Rendered r = in_world("ReadArchive \"a.rib.gz\"");
  EXPECT_THAT(r.messages, HasSubstr("the compressed file ends too early, at byte 3000"));
  EXPECT_GT(r.scene.primitives.size(), 100u);
}

TEST_F(Archives, are_found_beside_the_file_that_reads_them) {
  file("parts/a.rib", "ReadArchive \"b.rib\"");
  file("parts/b.rib", "Disk 0 1 360");
  EXPECT_EQ(in_world("ReadArchive \"parts/a.rib\"").scene.primitives.size(), 1u);
}

TEST_F(Archives, paths_of_other_machines_are_looked_for_by_the_last_name) {
  file("a.rib", "Disk 0 1 360");
  Rendered r = in_world("ReadArchive \"/anna/models/a.rib\" ReadArchive \"C:\\\\models\\\\a.rib\"");
  EXPECT_EQ(r.scene.primitives.size(), 2u);
  EXPECT_THAT(r.messages, HasSubstr("warning: there is no \"/anna/models/a.rib\"; \""));
  EXPECT_THAT(r.messages, HasSubstr("a.rib\" is read instead"));
}

TEST_F(Archives, inline_ones_hide_files) {
  file("a.rib", "Disk 0 1 360 Disk 0 1 360");
  EXPECT_EQ(in_world("ArchiveBegin \"a.rib\" Disk 0 1 360 ArchiveEnd ReadArchive \"a.rib\"")
                .scene.primitives.size(),
            1u);
}

TEST_F(Archives, may_hold_whole_frames_and_other_archives) {
  Rendered r =
      render_text("Format 4 4 1 ArchiveBegin \"outer\" ArchiveBegin \"inner\" Disk 0 1 360 ArchiveEnd "
                  "FrameBegin 1 WorldBegin ReadArchive \"inner\" WorldEnd FrameEnd ArchiveEnd \"outer\" "
                  "ArchiveInstance \"outer\"");
  EXPECT_EQ(r.messages, "");
  EXPECT_EQ(r.scene.primitives.size(), 1u);
}

TEST_F(Archives, multipart_ones_are_decoded) {
  Rendered r = in_world(
      "ArchiveBegin \"q\" \"Content-Type\" [\"application/rib\"]\n"
      "\"Content-Transfer-Encoding\" [\"quoted-printable\"]\n"
      "Disk =\n0 1 =33=\r\n60\nDisk 0 2 360\nArchiveEnd \"other\"\n  ArchiveEnd  \"q\"\n"
      "ArchiveBegin \"b\" \"Content-Transfer-Encoding\" \"base64\"\nRGlzayAwI\nDEgMzYw\nArchiveEnd \"b\"\n"
      "ArchiveInstance \"b\" Disk 0 1 360");
  EXPECT_EQ(r.messages, "");
  EXPECT_EQ(r.scene.primitives.size(), 2u);
  r = in_world("ArchiveBegin \"q\" \"Content-Transfer-Encoding\" \"quoted-printable\"\nDisk =\n0 1 "
               "=33=\r\n60\nDisk 0 2 "
               "360\nArchiveEnd \"q\"\nReadArchive \"q\"");
  EXPECT_EQ(r.messages, "");
  EXPECT_EQ(r.scene.primitives.size(), 2u);
}

TEST_F(Archives, content_of_other_types_is_passed_over) {
  Rendered r = in_world(
      "ArchiveBegin \"t\" \"Content-Type\" [\"application/tcl\"]\n# tcl\nRi::Cone {$x} \"\nArchiveEnd \"t\"\n"
      "ArchiveInstance \"t\" \"int frame\" [36]\nArchiveInstance \"t\" Disk 0 1 360");
  EXPECT_THAT(r.messages,
              HasSubstr("test.rib:6:1: warning: archive \"t\" holds application/tcl, which takes a plug-in "
                        "that is not there: nothing comes of it"));
  EXPECT_EQ(r.scene.primitives.size(), 1u);
}

TEST_F(Archives, multipart_mistakes) {
  auto messages = [&](const std::string& rest) {
    return in_world("ArchiveBegin \"a\" \"Content-Transfer-Encoding\" " + rest).messages;
  };
  EXPECT_THAT(messages("\"zip\"\nx\nArchiveEnd \"a\""),
              HasSubstr("ArchiveBegin: unknown encoding \"zip\"; known are quoted-printable, base64"));
  EXPECT_THAT(messages("\"base64\"\nAB*\nArchiveEnd \"a\""), HasSubstr("'*' is no digit of base64"));
  EXPECT_THAT(messages("\"quoted-printable\"\n=XY\nArchiveEnd \"a\""),
              HasSubstr("expected two hexadecimal digits or a line end after '=', found \"XY\""));
  EXPECT_THAT(messages("\"base64\"\nABC\nArchiveEnd \"b\""),
              HasSubstr("ArchiveBegin: the data has no end; expected a line ArchiveEnd \"a\""));
}

TEST_F(Archives, recursion_ends) {
  file("a.rib", "ReadArchive \"a.rib\" Disk 0 1 360");
  EXPECT_THAT(in_world("ReadArchive \"a.rib\"").messages,
              HasSubstr("ReadArchive: archives and instances are nested more than 64 deep"));
  std::string m =
      messages_of("WorldBegin ObjectBegin 1 ObjectInstance 1 ObjectEnd ObjectInstance 1 WorldEnd");
  EXPECT_THAT(m, HasSubstr("ObjectInstance: archives and instances are nested more than 64 deep"));
}

TEST_F(Archives, what_doubles_at_each_level_ends) {
  std::string rib;
  for (int i = 0; i < 60; ++i)
    rib += fmt::format("ArchiveBegin \"{}\" ReadArchive \"{}\" ReadArchive \"{}\" ArchiveEnd\n", i, i + 1,
                       i + 1);
  rib += "ArchiveBegin \"60\" Identity Identity Identity Identity Identity Identity Identity Identity "
         "ArchiveEnd\n";
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  Interpreter interpreter(sources, diagnostics, {});
  interpreter.most_replayed = 10000;
  interpreter.read_text("a.rib", rib + "ReadArchive \"0\"");
  EXPECT_THAT(
      format_diagnostics(diagnostics, sources),
      HasSubstr("archives and instances have repeated more than 10000 requests; the rest is not read"));
}

TEST_F(Archives, instances_of_meshes_have_a_limit) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  size_t primitives = 0;
  Interpreter interpreter(sources, diagnostics, [&](Scene& s) { primitives = s.primitives.size(); });
  interpreter.most_primitives = 5;
  interpreter.read_text("a.rib", "ObjectBegin 1 PointsPolygons [4 4] [0 1 2 3 3 2 1 0] "
                                 "\"P\" [0 0 0 1 0 0 1 1 0 0 1 0] ObjectEnd WorldBegin ObjectInstance 1 "
                                 "ObjectInstance 1 ObjectInstance 1 Sphere 1 -1 1 360 WorldEnd");
  EXPECT_EQ(format_diagnostics(diagnostics, sources)
                .find("a.rib:1:15: error: PointsPolygons: more than 5 "
                      "surfaces in a world; the mesh is skipped\n"),
            0u);
  EXPECT_EQ(primitives, 5u);
}

TEST_F(Archives, objects_take_handles_of_both_kinds_and_keep_the_state_around) {
  Rendered r = in_world(
      "ObjectBegin \"ball\" Disk 0 1 360 Translate 9 9 9 ObjectEnd ObjectBegin 4 Disk 0 2 360 ObjectEnd "
      "Sides 1 Translate 1 0 0 ObjectInstance \"ball\" ObjectInstance 4 ObjectInstance \"4\"");
  EXPECT_EQ(r.messages, "");
  ASSERT_EQ(r.scene.primitives.size(), 3u);
  EXPECT_EQ(r.scene.primitives[0].attributes().sides, 1);
  EXPECT_EQ(transform_point(r.scene.primitives[2].state->object_to_camera, Vec3{0, 0, 0}), Vec3(1, 0, 0));
}

TEST_F(Archives, scenes_bring_their_folder_to_the_search_paths) {
  file("scene.rib", "Format 4 4 1 WorldBegin ReadArchive \"parts/b.rib\" WorldEnd");
  file("parts/b.rib", "Disk 0 1 360");
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  std::vector<std::string> path;
  size_t primitives = 0;
  Interpreter interpreter(sources, diagnostics, [&](Scene& s) {
    path = s.options.search_paths["shader"];
    primitives = s.primitives.size();
  });
  interpreter.standard_paths["shader"] = {"standard"};
  ASSERT_TRUE(interpreter.read_file((folder_ / "scene.rib").string()));
  EXPECT_EQ(format_diagnostics(diagnostics, sources), "");
  EXPECT_EQ(path, (std::vector<std::string>{".", folder_.string(), "standard"}));
  EXPECT_EQ(primitives, 1u);
}

} // namespace
} // namespace render::testing
