// .slo files: what is written is read again; damaged, foreign and outdated files get an error that says so.
#include "slvm/format/slo.h"

#include "tests/temp_folder.h"
#include "tests/unit/ir/samples.h"

#include <cstring>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace slvm {
namespace {

using testing::HasSubstr;

std::span<const std::byte> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

Program full_program() {
  Program p = ir::compile(ir::computed_default());
  p.source_name = "scale.sl";
  p.source_hash = 0x0123456789abcdefull;
  p.annotations = {{"help", "scales"}, {"author", ""}};
  Param names;
  names.name = "names";
  names.type = Type::kString;
  names.elements = 2;
  names.default_known = true;
  names.default_value = {Type::kString, 2, {}, {"first", ""}};
  p.params.push_back(names);
  p.facts = {true,
             false,
             true,
             false,
             {"surface:depth"},
             {"wood.tex"},
             {"convert"},
             {},
             {{3, 0, 12, 7}, {0, 0, 14, 1}, {3, 0, 15, 2}}};
  p.sources = {{"scale.sl", 1}, {"inc/noise.h", 0xfedcba9876543210ull}};
  p.compiler = "slc (Anemone) 0.1.0";
  return p;
}

TEST(Slo, RoundTripKeepsEverything) {
  for (auto& [name, m] : ir::samples()) {
    Program program = ir::compile(m);
    auto back = read_slo(write_slo(program));
    ASSERT_TRUE(back) << name << ": " << back.error();
    EXPECT_EQ(*back, program) << name;
  }
  auto back = read_slo(write_slo(full_program()));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(*back, full_program());
}

TEST(Slo, RefusesTruncationAtEveryByte) {
  auto file = write_slo(full_program());
  for (size_t n = 0; n < file.size(); ++n) {
    auto result = read_slo(std::span(file).first(n));
    ASSERT_FALSE(result) << n;
    EXPECT_THAT(result.error(),
                n < 7 ? HasSubstr("not an Anemone .slo file") : testing::AnyOf(HasSubstr("truncated")))
        << n;
  }
}

TEST(Slo, RefusesEveryFlippedBit) {
  auto file = write_slo(ir::compile(ir::varying_branch()));
  for (size_t i = 0; i < file.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      file[i] ^= static_cast<std::byte>(1 << bit);
      EXPECT_FALSE(read_slo(file)) << "byte " << i << " bit " << bit;
      file[i] ^= static_cast<std::byte>(1 << bit);
    }
  EXPECT_TRUE(read_slo(file));
}

/// Makes the checksum right again, as somebody who means harm would.
void seal(std::vector<std::byte>& file) {
  uint64_t hash = hash_bytes(std::span(file).subspan(16));
  std::memcpy(file.data() + 8, &hash, sizeof hash);
}

TEST(Slo, FlippedBitsUnderARightChecksumDoNoHarm) {
  const auto file = write_slo(full_program());
  for (size_t i = 16; i < file.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      auto damaged = file;
      damaged[i] ^= static_cast<std::byte>(1 << bit);
      seal(damaged);
      auto result = read_slo(damaged);
      if (result) continue; // a bit of a constant, say
      EXPECT_THAT(result.error(), testing::AnyOf(HasSubstr("damaged"), HasSubstr("uses the built-in")));
    }
}

TEST(Slo, UnknownBuiltInIsNamed) {
  auto file = write_slo(ir::compile(ir::varying_branch()));
  std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  ASSERT_NE(text.find("operator<"), text.npos); // it stands there twice: for the code and for the IR
  for (size_t at = text.find("operator<"); at != text.npos; at = text.find("operator<"))
    file[at + 8] = std::byte{'#'};
  seal(file);
  EXPECT_EQ(read_slo(file).error(), "uses the built-in 'operator#' with signature 'bool(float a, float b)', "
                                    "which this version does not have");
}

TEST(Slo, OtherVersionsAreRefusedWithAdvice) {
  auto file = write_slo(full_program());
  file[7] = std::byte{99};
  EXPECT_EQ(read_slo(file).error(),
            "made for version 99 of the format, this program reads version 1: compile the shader again");
}

TEST(Slo, ForeignFilesAreNamed) {
  EXPECT_THAT(read_slo(bytes_of("AQSIS_V 1.8\nsurface\n")).error(), HasSubstr("an Aqsis shader"));
  EXPECT_THAT(read_slo(bytes_of("#!parameters:\n")).error(), HasSubstr("a Pixie shader"));
  EXPECT_THAT(read_slo(bytes_of("OpenShadingLanguage 1.00\n")).error(),
              HasSubstr("an Open Shading Language shader"));
  EXPECT_THAT(read_slo(bytes_of("\x7f"
                                "ELF\x02\x01"))
                  .error(),
              HasSubstr("a shared library"));
  EXPECT_THAT(read_slo(bytes_of("surface plastic(float Ks = 0.5;) { }")).error(),
              HasSubstr("compile it with slc first"));
  EXPECT_EQ(read_slo(bytes_of("\x01\x02\x03")).error(), "not an Anemone .slo file");
  EXPECT_EQ(read_slo({}).error(), "not an Anemone .slo file");
}

TEST(Files, AreWrittenWholeOrNotAtAll) {
  anemone::test::TempFolder folder;
  std::string path = folder / "x.slo";
  auto file = write_slo(full_program());
  ASSERT_TRUE(write_file(path, file));
  auto back = read_file(path);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, file);
  auto entries = std::distance(std::filesystem::directory_iterator(folder), {});
  EXPECT_EQ(entries, 1); // no temporary stays
  EXPECT_THAT(read_file(folder / "none.slo").error(), HasSubstr("cannot open"));
  EXPECT_THAT(write_file(folder / "none" / "x.slo", file).error(), HasSubstr("cannot write"));
}

} // namespace
} // namespace slvm
