// PLY in general: formats, types, lists, and what is wrong with files.
#include "stdlib/subsurface/ply.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace subsurface {
namespace {

slvm::Result<PlyFile> parse(const std::string& text) {
  return parse_ply(std::as_bytes(std::span(text)), "a.ply");
}

std::string error_of(const std::string& text) {
  auto file = parse(text);
  return file ? "" : file.error();
}

const std::string kHead = "ply\nformat ascii 1.0\n";

TEST(Ply, TextWithListsCommentsAndWindowsLineEnds) {
  auto file =
      parse("ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement vertex 2\r\nproperty float x\r\n"
            "property uchar quality\r\nelement face 2\r\nproperty list uchar int vertex_indices\r\n"
            "end_header\r\n0.5 +7\r\n-1e-3 255\r\n3 0 1 2\r\n0\r\n");
  ASSERT_TRUE(file) << file.error();
  const PlyElement* vertex = file->find("vertex");
  ASSERT_TRUE(vertex);
  EXPECT_EQ(vertex->find("x")->values, (std::vector<float>{0.5f, -1e-3f}));
  EXPECT_EQ(vertex->find("quality")->values, (std::vector<float>{7, 255}));
  const PlyProperty* list = file->find("face")->find("vertex_indices");
  EXPECT_EQ(list->items, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(list->ends, (std::vector<size_t>{3, 3}));
  EXPECT_EQ(vertex->find("y"), nullptr);
  EXPECT_EQ(file->find("edge"), nullptr);
}

template <class T> void put(std::string& out, T value, bool swapped) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (swapped) std::reverse(raw, raw + sizeof value);
  out.append(raw, sizeof value);
}

TEST(Ply, BinaryOfBothByteOrdersAndAllTypes) {
  for (bool swapped : {false, true}) {
    std::string text = std::string("ply\nformat binary_") + (swapped ? "big" : "little") + "_endian 1.0\n";
    text += "element vertex 1\nproperty char a\nproperty uint8 b\nproperty short c\nproperty uint16 "
            "d\nproperty int e\n"
            "property uint32 f\nproperty float g\nproperty float64 h\nproperty list ushort double "
            "l\nend_header\n";
    put<int8_t>(text, -3, swapped);
    put<uint8_t>(text, 200, swapped);
    put<int16_t>(text, -300, swapped);
    put<uint16_t>(text, 60000, swapped);
    put<int32_t>(text, -70000, swapped);
    put<uint32_t>(text, 3000000000u, swapped);
    put<float>(text, 0.25f, swapped);
    put<double>(text, 1e300, swapped);
    put<uint16_t>(text, 2, swapped);
    put<double>(text, 0.1, swapped);
    put<double>(text, -5, swapped);
    auto file = parse(text);
    ASSERT_TRUE(file) << file.error();
    const PlyElement& v = file->elements[0];
    const float wanted[] = {-3, 200, -300, 60000, -70000, 3e9f, 0.25f, HUGE_VALF};
    for (size_t i = 0; i < 8; ++i)
      EXPECT_EQ(v.properties[i].values[0], wanted[i]) << i;
    EXPECT_EQ(v.properties[8].items, (std::vector<double>{0.1, -5}));
    text.pop_back();
    EXPECT_EQ(error_of(text), "a.ply: 'vertex' number 0 is cut off, or has something else than numbers");
  }
}

TEST(Ply, SaysWhatIsWrongWithTheHeader) {
  EXPECT_EQ(error_of("solid cube"), "a.ply: not a PLY file: the first line must be 'ply'");
  EXPECT_EQ(error_of("ply\nend_header\n"), "a.ply:2: the header has no line 'format'");
  EXPECT_EQ(error_of("ply\nformat ascii 2.0\n"),
            "a.ply:2: expected 'format ascii 1.0', or binary_little_endian or binary_big_endian");
  EXPECT_EQ(error_of("ply\nformat binary 1.0\n"), "a.ply:2: unknown format 'binary'");
  EXPECT_EQ(error_of(kHead + "elemnt vertex 3\n"), "a.ply:3: unknown statement 'elemnt'");
  EXPECT_EQ(error_of(kHead + "element vertex\n"), "a.ply:3: expected 'element NAME COUNT'");
  EXPECT_EQ(error_of(kHead + "element vertex -1\n"), "a.ply:3: '-1' is no count between 0 and 2147483648");
  EXPECT_EQ(error_of(kHead + "property float x\n"), "a.ply:3: a property before the first element");
  EXPECT_EQ(error_of(kHead + "element v 1\nproperty real x\n"), "a.ply:4: unknown type 'real'");
  EXPECT_EQ(error_of(kHead + "element v 1\nproperty float\n"),
            "a.ply:4: expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
  EXPECT_EQ(error_of(kHead + "element v 1\nproperty list float int l\n"),
            "a.ply:4: the length of a list must be a whole number");
  EXPECT_EQ(error_of(kHead + "element v 1\nproperty float x\nproperty int x\n"),
            "a.ply:5: a second property 'x'");
  EXPECT_EQ(error_of(kHead + "element v 1\n"),
            "a.ply:3: the header has no 'end_header', or a line of more than 4096 bytes");
  std::string many = kHead;
  for (int i = 0; i < 101; ++i)
    many += "element e" + std::to_string(i) + " 0\n";
  EXPECT_EQ(error_of(many), "a.ply:103: more than 100 elements");
  many = kHead + "element v 1\n";
  for (int i = 0; i < 1001; ++i)
    many += "property float p" + std::to_string(i) + "\n";
  EXPECT_EQ(error_of(many), "a.ply:1004: more than 1000 properties");
}

TEST(Ply, TakesNoMemoryForWhatCannotBeThere) {
  EXPECT_EQ(error_of(kHead + "element vertex 2000000000\nproperty float x\nend_header\n1 2 3\n"),
            "a.ply: too short for 2000000000 times 'vertex': damaged?");
  EXPECT_EQ(error_of(kHead + "element face 1\nproperty list uint int l\nend_header\n4000000000 1\n"),
            "a.ply: 'face' number 0 is cut off, or has something else than numbers");
  EXPECT_EQ(error_of(kHead + "element face 1\nproperty list char int l\nend_header\n-1\n"),
            "a.ply: 'face' number 0 is cut off, or has something else than numbers");
  EXPECT_EQ(error_of(kHead + "element face 2\nproperty float x\nend_header\n1 zwei\n"),
            "a.ply: 'face' number 1 is cut off, or has something else than numbers");
  // Elements without properties take no bytes.
  EXPECT_EQ(error_of(kHead + "element ghost 2000000000\nelement v 1\nproperty float x\nend_header\n1"), "");
}

} // namespace
} // namespace subsurface
