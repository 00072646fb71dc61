#include <gtest/gtest.h>

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

Soup parse(std::string_view name, const std::string& bytes) {
  const TempFolder folder;
  return io::read_soup(folder.write(name, bytes));
}

void expect_refusal(std::string_view name, const std::string& bytes, std::uint64_t line,
                    const std::string& reason) {
  try {
    parse(name, bytes);
    ADD_FAILURE() << "was not rejected: " << bytes;
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), line) << bytes;
    EXPECT_NE(error.reason().find(reason), std::string::npos)
        << bytes << " gave " << error.reason();
  }
}

std::string binary_stl(const std::vector<glm::vec3>& corners, std::uint32_t claimed) {
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&claimed), 4);
  for (std::size_t f = 0; f < corners.size() / 3; ++f) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(&corners[3 * f]), 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::vector<glm::vec3> kTwoFacets = {{0, 0, 0},     {1, 0, 0}, {0, 1, 0},
                                           {-0.0F, 1, 0}, {1, 0, 0}, {1, 1, -0.0F}};
const std::vector<std::uint32_t> kTwoFacetsCorners = {0, 1, 2, 2, 1, 3};

TEST(StlRead, BinaryJoinsEqualPositions) {
  const Soup soup = parse("m.stl", binary_stl(kTwoFacets, 2));
  EXPECT_EQ(soup.positions.size(), 4U);
  EXPECT_EQ(std::vector<std::uint32_t>(soup.corners.begin(), soup.corners.end()),
            kTwoFacetsCorners);
}

TEST(StlRead, ReadsBinaryThatStartsLikeText) {
  std::string bytes = binary_stl(kTwoFacets, 2);
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(parse("m.stl", bytes).corners.size(), 6U);
}

TEST(StlRead, ReadsBinaryWithTrailingBytes) {
  EXPECT_EQ(parse("m.stl", binary_stl(kTwoFacets, 2) + "extra").corners.size(), 6U);
}

TEST(StlRead, RejectsBinaryWithWrongCount) {
  expect_refusal("m.stl", binary_stl(kTwoFacets, 3), 0, "too early");
  expect_refusal("m.stl", binary_stl(kTwoFacets, 0xFFFFFFFFU), 0, "too early");
  expect_refusal("m.stl", binary_stl({}, 0), 0, "neither");
  expect_refusal("m.stl", "short", 0, "neither");
}

std::string text_facet(const std::string& corners) {
  return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
}

TEST(StlRead, ReadsText) {
  const Soup soup = parse(
      "m.stl", "solid a b c\n" + text_facet("vertex 0 0 0\nvertex 1 0 0\n  vertex 0 1e0 0\n") +
                   "endsolid a\nsolid\n" +
                   text_facet("vertex -0 1 0\r\nvertex 1 0 0\nvertex 1 1 0\n") + "endsolid\n");
  EXPECT_EQ(soup.positions.size(), 4U);
  EXPECT_EQ(std::vector<std::uint32_t>(soup.corners.begin(), soup.corners.end()),
            kTwoFacetsCorners);
}

TEST(StlRead, ReadsUppercaseTextAfterAByteOrderMark) {
  const Soup soup = parse("m.stl",
                          "\xEF\xBB\xBFSOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\n"
                          "VERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID A\n");
  EXPECT_EQ(soup.corners.size(), 3U);
}

TEST(StlRead, RejectsInvalidText) {
  expect_refusal("m.stl", "solid\nendsolid\n", 0, "no facets");
  expect_refusal("m.stl", "solid\nfacet normal 0 0\nouter", 3, "not a number");
  expect_refusal("m.stl", "solid\n" + text_facet("vertex 0 0 0\nvertex 1 0 0\n"), 6, "\"vertex\"");
  expect_refusal("m.stl", "solid\n" + text_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"), 9,
                 "ends too early");
}

TEST(OffRead, ReadsPolygonsCommentsAndCountsOnTheFirstLine) {
  for (const std::string start :
       {"OFF\n4 2 0\n", "OFF 4 2 5\n", "# c\nOFF # d\n\n4 2\n", "\xEF\xBB\xBFOFF\n4 2 0\n"}) {
    const Soup soup = parse(
        "m.off", start + "0 0 0\n1 0 0 # right\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2 0.5 0.5 0.5\n");
    EXPECT_EQ(soup.positions.size(), 4U);
    EXPECT_EQ(std::vector<std::uint32_t>(soup.face_start.begin(), soup.face_start.end()),
              (std::vector<std::uint32_t>{0, 4, 7}));
  }
}

TEST(OffRead, ReadsAttributes) {
  const Soup soup =
      parse("m.off",
            "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 10 1 0.5\n1 0 0 0 0 1 0.5 0 1 1 0 1\n0 1 0 0 0 1 "
            "255 0 10 7 0 1\n3 0 1 2\n");
  EXPECT_EQ(soup.attributes.normal[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(soup.attributes.color[0], glm::u8vec4(255, 0, 10, 255));
  EXPECT_EQ(soup.attributes.color[1], glm::u8vec4(128, 0, 255, 255));
  EXPECT_EQ(soup.attributes.color[2], glm::u8vec4(255, 0, 10, 7));
  EXPECT_EQ(soup.attributes.texcoord[0], glm::vec2(1, 0.5F));
  EXPECT_EQ(soup.attributes.texcoord[2], glm::vec2(0, 1));
}

TEST(OffRead, RejectsInvalidFiles) {
  expect_refusal("m.off", "OF\n", 1, "begin with OFF");
  expect_refusal("m.off", "4OFF\n", 1, "three-dimensional");
  expect_refusal("m.off", "OFF BINARY\n", 1, "binary");
  expect_refusal("m.off", "OFF\n", 2, "ends too early");
  expect_refusal("m.off", "OFF\n-1 0 0\n", 2, "negative count");
  expect_refusal("m.off", "OFF\n0 0 0\n", 2, "no vertices");
  expect_refusal("m.off", "OFF\n4000000000 1 0\n0 0 0\n", 2, "too short");
  expect_refusal("m.off", "OFF\n1 4000000000 0\n0 0 0\n", 2, "too short");
  const std::string three = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect_refusal("m.off", three, 6, "ends too early");
  expect_refusal("m.off", three + "3 0 1 3\n", 6, "out of range");
  expect_refusal("m.off", three + "3 0 1 -1\n", 6, "out of range");
  expect_refusal("m.off", three + "-3\n", 6, "negative count");
  expect_refusal("m.off", three + "1000000 0 1 2\n", 6, "too short");
  expect_refusal("m.off", "COFF\n1 0 0\n0 0 0 255\n", 3, "color");
}

}  // namespace
}  // namespace mesher
