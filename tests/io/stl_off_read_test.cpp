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

// Streaming programs write the count last, or never. The size of the file tells it.
TEST(StlRead, CorrectsTheCountThatTheSizeTells) {
  for (const std::uint32_t claimed : {0U, 1U, 3U, 0xFFFFFFFFU}) {
    for (const char* start : {"    ", "solid"}) {
      SCOPED_TRACE(claimed);
      std::string bytes = binary_stl(kTwoFacets, claimed);
      bytes.replace(0, 5, start);
      bytes.resize(84 + 100);
      const Soup soup = parse("m.stl", bytes);
      EXPECT_EQ(soup.corners.size(), 6U);
      EXPECT_EQ(soup.report[Repair::facet_counts_corrected], 1U);
    }
  }
  EXPECT_EQ(parse("m.stl", binary_stl(kTwoFacets, 2)).report[Repair::facet_counts_corrected], 0U);
}

TEST(StlRead, RejectsBinaryWithWrongCountAndARest) {
  expect_refusal("m.stl", binary_stl(kTwoFacets, 3) + "x", 0, "too early");
  expect_refusal("m.stl", binary_stl(kTwoFacets, 0xFFFFFFFFU) + "x", 0, "too early");
  expect_refusal("m.stl", binary_stl(kTwoFacets, 0) + "x", 0, "neither");
  expect_refusal("m.stl", binary_stl({}, 0), 0, "neither");
  expect_refusal("m.stl", "short", 0, "neither");
}

/// Two facets with two attribute bytes each.
Soup colored_stl(const std::string& header, std::uint16_t first, std::uint16_t second) {
  std::string bytes = binary_stl(kTwoFacets, 2);
  bytes.replace(0, header.size(), header);
  std::memcpy(&bytes[84 + 48], &first, 2);
  std::memcpy(&bytes[84 + 98], &second, 2);
  return parse("m.stl", bytes);
}

// VisCAM and SolidView: the highest bit says that a facet has a color, blue in the lowest bits.
TEST(StlRead, ReadsFacetColorsOfVisCam) {
  const Soup soup = colored_stl("", 0x8000U | 31U, 0x7C00U);
  ASSERT_EQ(soup.attributes.color.size(), 6U);
  EXPECT_EQ(soup.attributes.color[0], glm::u8vec4(0, 0, 255, 255));
  EXPECT_EQ(soup.attributes.color[2], glm::u8vec4(0, 0, 255, 255));
  EXPECT_EQ(soup.attributes.color[3], glm::u8vec4(255)) << "this facet has none";
  EXPECT_EQ(soup.contents[Content::color_sets], 1U);
}

// Materialise Magics: the highest bit says that a facet has the color in the header; otherwise its
// own has red in the lowest bits.
TEST(StlRead, ReadsFacetColorsOfMagics) {
  const std::string header("COLOR=\x0A\x14\x1E\xFF", 10);
  const Soup soup = colored_stl(header, 31U, 0x8000U | 31U);
  EXPECT_EQ(soup.attributes.color[0], glm::u8vec4(255, 0, 0, 255));
  EXPECT_EQ(soup.attributes.color[3], glm::u8vec4(10, 20, 30, 255));
  EXPECT_EQ(colored_stl(header, 0, 0).attributes.color[0], glm::u8vec4(10, 20, 30, 255))
      << "no facet has a color of its own";
  EXPECT_EQ(colored_stl(header, 16U << 5U, 0).attributes.color[0], glm::u8vec4(0, 132, 0, 255));
}

TEST(StlRead, NamesAttributeBytesThatAreNoColors) {
  const Soup soup = colored_stl("", 7, 0);
  EXPECT_TRUE(soup.attributes.color.empty());
  EXPECT_EQ(soup.contents.names(Content::own_properties),
            std::vector<std::string>{"attribute bytes of facets"});
  EXPECT_EQ(colored_stl("", 0, 0).contents[Content::own_properties], 0U);
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

// Normals follow from the positions. Some programs write these for degenerate facets.
TEST(StlRead, NormalsThatAreNotNumbersDoNoHarm) {
  for (const char* normal :
       {"-1.#IND -1.#IND -1.#IND", "nan nan nan", "1.#QNAN 0 0", "", "0 0", "x y z", "#IND 0 0"}) {
    SCOPED_TRACE(normal);
    const Soup soup = parse("m.stl", std::string("solid a\nfacet normal ") + normal +
                                         "\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                         "endloop\nendfacet\nendsolid\n");
    EXPECT_EQ(soup.corners.size(), 3U);
    EXPECT_EQ(soup.report[Repair::invalid_normals_ignored], 1U);
    EXPECT_EQ(soup.contents.names(Content::objects), std::vector<std::string>{"a"});
  }
}

// A comment begins after white space, so the rest of such a number is not skipped, and the error
// names its line.
TEST(StlRead, NumberSignInsideANumberIsNoComment) {
  const auto with_corner = [](const std::string& corner) {
    return "solid\n" + text_facet("vertex 0 0 0\nvertex " + corner + "\nvertex 0 1 0\n") +
           "endsolid\n";
  };
  expect_refusal("m.stl", with_corner("1.#IND 0 0"), 5, "not a number");
  expect_refusal("m.stl", with_corner("1 0 0.#QNAN"), 5, "not a number");
  EXPECT_EQ(parse("m.stl", with_corner("1 0 0 # c")).corners.size(), 3U);
}

TEST(StlRead, RejectsInvalidText) {
  expect_refusal("m.stl", "solid\nendsolid\n", 0, "no facets");
  expect_refusal("m.stl", "solid\nfacet normal 0 0\nouter", 3, "ends too early");
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

TEST(OffRead, PrefixLettersMayComeInAnyOrder) {
  for (const char* word : {"CNOFF", "NCOFF"}) {
    const Soup soup =
        parse("m.off", std::string(word) +
                           "\n3 1 0\n0 0 0 0 0 1 255 0 10\n1 0 0 0 0 1 255 0 10\n0 1 0 0 0 1 255 0 "
                           "10\n3 0 1 2\n");
    EXPECT_EQ(soup.attributes.normal[0], glm::vec3(0, 0, 1)) << word;
    EXPECT_EQ(soup.attributes.color[0], glm::u8vec4(255, 0, 10, 255)) << word;
  }
  for (const char* word : {"STCNOFF", "NSTCOFF", "CSTNOFF", "NCSTOFF"}) {
    const Soup soup =
        parse("m.off", std::string(word) +
                           "\n3 1 0\n0 0 0 0 0 1 255 0 10 1 0.5\n1 0 0 0 0 1 255 0 10 1 "
                           "0\n0 1 0 0 0 1 255 0 10 0 1\n3 0 1 2\n");
    EXPECT_EQ(soup.attributes.texcoord[0], glm::vec2(1, 0.5F)) << word;
    EXPECT_EQ(soup.attributes.color[0], glm::u8vec4(255, 0, 10, 255)) << word;
  }
  expect_refusal("m.off", "CCOFF\n", 1, "begin with OFF");
}

// Many programs write colors without the letter in front.
TEST(OffRead, ReadsColorsOfVerticesAndFacesWithoutTheLetter) {
  const auto square = [](const std::string& vertex, const std::string& face) {
    return parse("m.off", "OFF\n4 2 0\n0 0 0 " + vertex + "\n1 0 0 " + vertex + "\n1 1 0 " +
                              vertex + "\n0 1 0 " + vertex + "\n3 0 1 2 " + face + "\n3 0 2 3\n");
  };
  const glm::u8vec4 color(255, 0, 51, 255);
  for (const char* text :
       {"255 0 51", "255 0 51 255", "1.0 0 0.2", "1 0 0.2 1.0", "255.0 0.0 51.0"}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(square(text, "").attributes.color[0], color);
    const Soup faces = square("", text);
    EXPECT_EQ(faces.attributes.color[0], color);
    EXPECT_EQ(faces.attributes.color[2], color);
    EXPECT_EQ(faces.attributes.color[3], glm::u8vec4(255)) << "the second face has none";
    const Soup both = square("0 255 0", text);
    EXPECT_EQ(both.attributes.color[0], color);
    EXPECT_EQ(both.attributes.color[3], glm::u8vec4(0, 255, 0, 255));
    EXPECT_EQ(both.contents[Content::color_sets], 2U);
  }
  EXPECT_TRUE(square("", "").attributes.color.empty());
}

TEST(OffRead, NamesNumbersThatAreNoColors) {
  const auto names = [](const std::string& vertex, const std::string& face) {
    const Soup soup =
        parse("m.off", "OFF\n3 1 0\n0 0 0 " + vertex + "\n1 0 0\n0 1 0\n3 0 1 2 " + face + "\n");
    EXPECT_TRUE(soup.attributes.color.empty());
    return soup.contents.names(Content::own_properties);
  };
  const std::vector<std::string> of_vertices{"numbers after the coordinates of vertices"};
  EXPECT_EQ(names("0 -1 0", ""), of_vertices) << "a normal";
  EXPECT_EQ(names("300 0 0", ""), of_vertices);
  EXPECT_EQ(names("1 2", ""), of_vertices);
  EXPECT_EQ(names("", "7"), std::vector<std::string>{"indices of colors in a color map"});
  EXPECT_EQ(names("", "7 8"), std::vector<std::string>{"numbers after the corners of faces"});
  EXPECT_EQ(names("words", "words"), std::vector<std::string>{}) << "as before, not read at all";
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
