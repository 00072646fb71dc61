#include "engine/io/ply_read.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::TempFolder;

Soup parse_ply(const std::string& bytes) {
  const TempFolder folder;
  return io::read_soup(folder.write("model.ply", bytes));
}

/// Line number and reason of an error.
std::pair<std::uint64_t, std::string> ply_refusal(const std::string& bytes) {
  try {
    parse_ply(bytes);
  } catch (const InputError& error) {
    return {error.line(), error.reason()};
  }
  ADD_FAILURE() << "was not rejected";
  return {};
}

template <class T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kTextTriangle =
    "ply\nformat ascii 1.0\ncomment hello\nobj_info x\nelement vertex 3\n" + kXyz +
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1.5 0\n3 "
    "0 1 2\n";

TEST(PlyRead, ReadsText) {
  const Soup soup = parse_ply(kTextTriangle);
  ASSERT_EQ(soup.positions.size(), 3U);
  EXPECT_EQ(soup.positions[2], glm::vec3(0, 1.5F, 0));
  EXPECT_TRUE(soup.face_start.empty());
  EXPECT_EQ(soup.corners[2], 2U);
}

TEST(PlyRead, AcceptsEveryLineEndingInTheHeader) {
  for (const char* end : {"\r\n", "\r"}) {
    std::string text;
    for (const char c : kTextTriangle)
      text += c == '\n' ? std::string(end) : std::string(1, c);
    EXPECT_EQ(parse_ply(text).positions.size(), 3U);
  }
}

/// A square with every data type, with wide counts, unknown properties and an unknown element.
std::string binary_square(bool big) {
  std::string bytes =
      big ? "ply\nformat binary_big_endian 1.0\n" : "ply\nformat binary_little_endian 1.0\n";
  bytes +=
      "element vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty list "
      "uchar "
      "ushort extra\nproperty uchar red\nproperty ushort green\nproperty float blue\n"
      "element camera 2\nproperty char a\nproperty list int double b\n"
      "element face 2\nproperty uchar flag\nproperty list uint ushort vertex_index\nend_header\n";
  for (int v = 0; v < 4; ++v) {
    bytes += bytes_of(v % 2 + 0.0, big) + bytes_of(v < 2 ? 0.25F : 1.25F, big) +
             bytes_of(static_cast<std::int16_t>(-3), big) + bytes_of(std::uint8_t{1}, big) +
             bytes_of(std::uint16_t{7}, big) + bytes_of(std::uint8_t{255}, big) +
             bytes_of(std::uint16_t{65535}, big) + bytes_of(0.5F, big);
  }
  for (int i = 0; i < 2; ++i) {
    bytes += bytes_of(std::int8_t{1}, big) + bytes_of(std::int32_t{1}, big) + bytes_of(1.0, big);
  }
  for (const std::vector<std::uint16_t>& face :
       {std::vector<std::uint16_t>{0, 1, 3, 2}, {0, 2, 3}}) {
    bytes +=
        bytes_of(std::uint8_t{9}, big) + bytes_of(static_cast<std::uint32_t>(face.size()), big);
    for (const std::uint16_t v : face)
      bytes += bytes_of(v, big);
  }
  return bytes;
}

TEST(PlyRead, ReadsBothByteOrdersAndEveryType) {
  for (const bool big : {false, true}) {
    const Soup soup = parse_ply(binary_square(big));
    ASSERT_EQ(soup.positions.size(), 4U);
    EXPECT_EQ(soup.positions[3], glm::vec3(1.0F, 1.25F, -3.0F));
    EXPECT_EQ(soup.face_start.back(), 7U);
    EXPECT_EQ(soup.corners[2], 3U);
    EXPECT_EQ(soup.attributes.color[0], glm::u8vec4(255, 255, 128, 255));
  }
}

TEST(PlyRead, RejectsBinaryFileTruncatedAnywhere) {
  const std::string bytes = binary_square(false);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(parse_ply(bytes.substr(0, size)), InputError) << size;
  }
}

TEST(PlyRead, ReadsVertexAndCornerAttributes) {
  const Soup soup = parse_ply(
      "ply\nformat ascii 1.0\nelement vertex 3\n" + kXyz +
      "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float "
      "t\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "end_header\n0 0 0 0 0 1 .1 .2\n1 0 0 0 0 1 .3 .4\n0 1 0 0 0 1 .5 .6\n3 0 1 2 0\n3 2 1 0 6 1 "
      "2 3 4 5 6\n");
  EXPECT_EQ(soup.attributes.normal[5], glm::vec3(0, 0, 1));
  ASSERT_EQ(soup.attributes.texcoord.size(), 6U);
  EXPECT_TRUE(std::isnan(soup.attributes.texcoord[0].x));
  EXPECT_EQ(soup.attributes.texcoord[5], glm::vec2(5, 6));
}

TEST(PlyRead, ReadsTriangleStrips) {
  const Soup soup =
      parse_ply("ply\nformat ascii 1.0\nelement vertex 4\n" + kXyz +
                "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 1 3 2\n");
  EXPECT_EQ(std::vector<std::uint32_t>(soup.corners.begin(), soup.corners.end()),
            (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 1, 3, 2}));
}

TEST(PlyRead, SkipsAByteOrderMark) {
  EXPECT_EQ(parse_ply("\xEF\xBB\xBF" + kTextTriangle).positions.size(), 3U);
  EXPECT_EQ(parse_ply("\xEF\xBB\xBF" + binary_square(false)).positions.size(),
            parse_ply(binary_square(false)).positions.size());
}

// A widespread exporter leaves out the word "comment".
TEST(PlyRead, SkipsUnknownHeaderLinesAndSaysSo) {
  std::string text = kTextTriangle;
  text.insert(text.find("element"), "Created by an exporter, source file:\n\nproperties follow\n");
  const Soup soup = parse_ply(text);
  EXPECT_EQ(soup.positions.size(), 3U);
  EXPECT_EQ(soup.report[Repair::header_lines_skipped], 2U);
  EXPECT_EQ(parse_ply(kTextTriangle).report[Repair::header_lines_skipped], 0U);
}

TEST(PlyRead, ColorsOfFacesGoToTheirCorners) {
  const auto with = [](const std::string& vertex, const std::string& type, const std::string& row) {
    return parse_ply("ply\nformat ascii 1.0\nelement vertex 4\n" + kXyz + vertex +
                     "element face 2\nproperty " + type +
                     " red\nproperty list uchar int "
                     "vertex_indices\nproperty " +
                     type + " green\nproperty " + type +
                     " blue\nend_header\n0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n" + row);
  };
  const Soup bytes =
      with("property uchar alpha\n", "uchar", "10 4 0 1 2 3 20 30\n40 3 0 1 2 50 60\n");
  ASSERT_EQ(bytes.attributes.color.size(), 7U);
  EXPECT_EQ(bytes.attributes.color[3], glm::u8vec4(10, 20, 30, 255));
  EXPECT_EQ(bytes.attributes.color[4], glm::u8vec4(40, 50, 60, 255));
  EXPECT_EQ(bytes.contents[Content::color_sets], 2U) << "those of vertices are not kept";
  const Soup fractions =
      with("property uchar other\n", "float", "1 3 0 1 2 0 0.2\n0 3 0 2 3 1 0\n");
  EXPECT_EQ(fractions.attributes.color[2], glm::u8vec4(255, 0, 51, 255));
  EXPECT_EQ(fractions.contents[Content::color_sets], 1U);
}

TEST(PlyRead, NamesWhatItDoesNotKeep) {
  const Soup soup = parse_ply(
      "ply\nformat ascii 1.0\ncomment TextureFile a b.png\ncomment other\nelement vertex 3\n" +
      kXyz +
      "property float quality\nproperty list uchar int flags\nelement face 1\nproperty list uchar "
      "int "
      "vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\nelement edge 1\n"
      "property int a\nend_header\n0 0 0 1 0\n1 0 0 1 1 2\n0 1 0 1 0\n3 0 1 2 6 0 0 1 0 0 1 "
      "0\n5\n");
  EXPECT_EQ(soup.contents.names(Content::textures), std::vector<std::string>{"a b.png"});
  EXPECT_EQ(soup.contents.names(Content::own_properties),
            (std::vector<std::string>{"vertex quality", "vertex flags", "element edge"}));
  EXPECT_EQ(soup.contents[Content::uv_sets], 1U);
}

TEST(PlyRead, RejectsInvalidFiles) {
  const auto expect = [](const std::string& bytes, std::uint64_t line, const std::string& reason) {
    const auto [at, why] = ply_refusal(bytes);
    EXPECT_EQ(at, line) << bytes;
    EXPECT_NE(why.find(reason), std::string::npos) << bytes << " gave " << why;
  };
  const std::string start = "ply\nformat ascii 1.0\n";
  expect("plx\n", 1, "begin with ply");
  expect("ply\n", 2, "no end");
  expect("ply\nend_header\n", 2, "no format");
  expect("ply\nformat utf8 1.0\nend_header\n", 2, "unknown format");
  expect(start + "element vertex -1\n", 3, "name and a count");
  expect(start + "element vertex 99999999999999999999999\n", 3, "name and a count");
  expect(start + "property float x\n", 3, "precedes the first element");
  expect(start + "element vertex 1\nproperty quad x\n", 4, "unknown type");
  expect(start + "element vertex 1\nproperty list float int x\n", 4, "integer type");
  expect(start + "element a 1\nelement a 1\n", 4, "declared twice");
  expect(start + "nonsense\n", 4, "no end");
  expect(start + "element vertex 1\nproperty float x\nend_header\n1\n", 6, "x, y and z");
  expect(start + "element vertex 0\n" + kXyz + "end_header\n", 8, "no vertices");
  expect(start + "element vertex 4000000000\n" + kXyz + "end_header\n0 0 0\n", 8, "too short");
  expect(start + "element vertex 4000000000\nend_header\n", 5, "x, y and z");
  const std::string three = start + "element vertex 3\n" + kXyz +
                            "element face 1\nproperty list int int vertex_indices\nend_header\n"
                            "0 0 0\n1 0 0\n0 1 0\n";
  expect(three + "3 0 1 3\n", 13, "out of range");
  expect(three + "3 0 1 -1\n", 13, "out of range");
  expect(three + "3 0 1\n", 14, "ends too early");
  expect(three + "-3 0 1 2\n", 13, "negative count");
  expect(three + "2000000000 0 1 2\n", 13, "too short");
  expect(three + "3 0 1 x\n", 13, "not an integer");
  expect(three, 13, "");
}

TEST(PlyRead, ManyElementsWithoutPropertiesAreFast) {
  const Soup soup = parse_ply(
      "ply\nformat ascii 1.0\nelement nothing 9999999999999\nelement face 9999999999\n"
      "element vertex 1\n" +
      kXyz + "end_header\n1 2 3\n");
  EXPECT_EQ(soup.positions.size(), 1U);
  EXPECT_EQ(soup.face_count(), 0U);
}

}  // namespace
}  // namespace mesher
