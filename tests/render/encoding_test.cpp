// The binary encoding of RIB and gzip files.
#include "render/rib/encoding.h"
#include "render/rib/gzip.h"
#include "tests/render/tokens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

namespace render {
namespace {

using namespace std::string_literals;
using ::testing::HasSubstr;

Token only(std::string_view text) {
  auto t = tokens_of(text);
  EXPECT_EQ(t.size(), 1u);
  return t.empty() ? Token{} : t[0];
}

TEST(Encoding, integers_of_one_to_four_bytes_are_signed) {
  EXPECT_EQ(only("\200\xff"s).number, -1);
  EXPECT_EQ(only("\200\x7f"s).number, 127);
  EXPECT_EQ(only("\201\x01\x00"s).number, 256);
  EXPECT_EQ(only("\202\xff\xff\xfe"s).number, -2);
  EXPECT_EQ(only("\203\x80\x00\x00\x00"s).number, -2147483648.0);
  EXPECT_EQ(only("\203\x00\x01\x00\x00"s).kind, TokenKind::kInteger);
}

TEST(Encoding, fixed_point) {
  EXPECT_EQ(only("\204\x80"s).number, -0.5);
  EXPECT_EQ(only("\205\x01\x80"s).number, 1.5);
  EXPECT_EQ(only("\206\xff\xff\x00"s).number, -1);
  EXPECT_EQ(only("\213\x00\x03\x40\x00"s).number, 3.25);
  EXPECT_EQ(only("\214\x01"s).number, 1.0 / (1 << 24));
  EXPECT_EQ(only("\204\x80"s).kind, TokenKind::kReal);
}

TEST(Encoding, floats_and_doubles) {
  EXPECT_EQ(only("\244\x3f\xc0\x00\x00"s).number, 1.5);
  EXPECT_EQ(only("\245\xbf\xe0\x00\x00\x00\x00\x00\x00"s).number, -0.5);
  EXPECT_EQ(only("\244\x7f\xc0\x00\x00"s).text, "this encoded float is not a number");
}

TEST(Encoding, strings_short_long_and_numbered) {
  EXPECT_EQ(only("\220"s).kind, TokenKind::kString);
  EXPECT_EQ(only("\223abc"s).text, "abc");
  EXPECT_EQ(only("\240\x04"s + "a\"\\]").text, "a\"\\]");
  EXPECT_EQ(only("\241\x00\x02hi"s).text, "hi");
  auto t = tokens_of("\315\x07\"seven\" \316\x01\x02\223two \317\x07 \320\x01\x02 x"s);
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].text, "seven");
  EXPECT_EQ(t[1].text, "two");
  EXPECT_EQ(t[2].text, "x");
}

TEST(Encoding, requests_by_code) {
  auto t = tokens_of("\314\x01\226Sphere\314\x02 \"Disk\" \246\x01 1 \246\x02"s);
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].kind, TokenKind::kWord);
  EXPECT_EQ(t[0].text, "Sphere");
  EXPECT_EQ(t[2].text, "Disk");
}

TEST(Encoding, arrays_of_floats) {
  auto t = tokens_of("\310\x02\x3f\x80\x00\x00\x40\x00\x00\x00 Disk"s);
  ASSERT_EQ(t.size(), 5u);
  EXPECT_EQ(t[0].kind, TokenKind::kOpen);
  EXPECT_EQ(t[1].number, 1);
  EXPECT_EQ(t[2].number, 2);
  EXPECT_EQ(t[3].kind, TokenKind::kClose);
  EXPECT_EQ(t[4].text, "Disk");
  EXPECT_EQ(tokens_of("\311\x00\x00"s).size(), 2u);
  // Blanks are numbers inside an array: 0x20202020.
  EXPECT_EQ(tokens_of("\310\x01    ]"s).size(), 4u);
}

TEST(Encoding, the_end_mark_ends_the_stream) {
  EXPECT_EQ(tokens_of("A B \377 C"s).size(), 2u);
}

TEST(Encoding, damaged_input_is_named) {
  EXPECT_EQ(only("\246\x05"s).text, "the request code 5 was not defined before");
  EXPECT_EQ(only("\317\x09"s).text, "the string number 9 was not defined before");
  EXPECT_EQ(only("\203\x01"s).text, "an encoded item needs 4 bytes more, the file has 1");
  EXPECT_EQ(only("\243\xff\xff\xff\xff"s).text,
            "an encoded item needs 4294967295 bytes more, the file has 0");
  EXPECT_EQ(only("\313\x7f\xff\xff\xff    "s).text,
            "an encoded array of 2147483647 floats reaches past the end of the file");
  EXPECT_EQ(tokens_of("\314\x01 7"s)[0].text, "expected a string for the encoded request 1 defined here");
  EXPECT_EQ(tokens_of("\315\x01 7"s)[0].text, "expected a string for the encoded string 1 defined here");
  EXPECT_EQ(only("\350"s).text, "byte 0xe8 has no meaning in a RIB file");
}

TEST(Encoding, tokens_know_their_byte) {
  auto t = tokens_of("AB \223abc\200\x05"s);
  ASSERT_EQ(t.size(), 3u);
  EXPECT_FALSE(t[0].encoded);
  EXPECT_TRUE(t[1].encoded);
  EXPECT_EQ(t[1].offset, 3u);
  EXPECT_EQ(t[2].offset, 7u);
}

TEST(Encoding, the_end_mark_is_not_mistaken) {
  auto end_of = [](const std::string& text) { return EndMarkFinder().find(text); };
  EXPECT_EQ(end_of("Disk 1\377"s), 6u);
  EXPECT_EQ(end_of("\"\377\" # \377\n\244\xff\xff\xff\xff\310\x01\xff\xff\xff\xff\222\xff\xff\377"s), 22u);
  EXPECT_EQ(end_of("\"\\\"\377"s), EndMarkFinder::kNone);
  // Item by item, as a pipe delivers it.
  EndMarkFinder finder;
  EXPECT_EQ(finder.find("\244\xff"s), EndMarkFinder::kNone);
  EXPECT_EQ(finder.find("\244\xff\xff\xff\xff"s), EndMarkFinder::kNone);
  EXPECT_EQ(finder.find("\244\xff\xff\xff\xff\377"s), 5u);
  EXPECT_TRUE(finder.saw_encoded());
}

std::string gzip(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

TEST(Gzip, one_member_and_several) {
  std::string long_text(300000, 'x');
  Unpacked u = unpack_gzip(gzip("Disk ") + gzip(long_text), 1 << 20);
  EXPECT_EQ(u.error, "");
  EXPECT_EQ(u.text, "Disk " + long_text);
  EXPECT_EQ(unpack_gzip(gzip("a") + "padding", 100).text, "a");
}

TEST(Gzip, damaged_and_hostile_files) {
  std::string whole = gzip("Sphere 1 -1 1 360 Sphere 2 -2 2 360");
  EXPECT_THAT(unpack_gzip(whole.substr(0, 20), 100).error, HasSubstr("ends too early, at byte 20"));
  EXPECT_THAT(unpack_gzip("\x1f\x8bXXXXXXXXXXXX", 100).error, HasSubstr("is damaged near byte"));
  Unpacked bomb = unpack_gzip(gzip(std::string(5 << 20, ' ')), 2 << 20);
  EXPECT_EQ(bomb.error, "the compressed file unpacks to more than 2 MB; the rest is not read");
  EXPECT_EQ(bomb.text.size(), size_t{2 << 20});
}

} // namespace
} // namespace render
