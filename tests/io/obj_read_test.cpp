#include "engine/io/obj_read.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "tests/support/attributes.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::TempFolder;

constexpr float kInf = std::numeric_limits<float>::infinity();
const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Soup parse(const std::string& text, const io::ReadOptions& options = {}) {
  const TempFolder folder;
  return io::read_soup(folder.write("model.obj", text), options);
}

std::vector<std::uint32_t> corners_of(const Soup& soup) {
  return {soup.corners.begin(), soup.corners.end()};
}

/// Line number and reason of an error.
struct Refusal {
  std::uint64_t line = 0;
  std::string reason;
};
Refusal refusal(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    EXPECT_NE(error.file().find("model.obj"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return {error.line(), error.reason()};
  }
  ADD_FAILURE() << "was not rejected: " << text.substr(0, 200);
  return {};
}

// A path in a comment may end in a backslash. The next line is still a separate line.
TEST(ObjRead, CommentsDoNotContinueAfterABackslash) {
  for (const char* line : {"vn 0 0 1", "vt 0 0", "mtllib a.mtl", "t other 0/0/0", "v 5 5 5",
                           "g name", "f 1 2 4", "", "s 1", "t crease 2/1/0 0 1 2.0"}) {
    for (const char* end : {"\n", "\r\n"}) {
      const Soup soup =
          parse(kSquare + line + " # c:\\" + end + "f 1 2 3\n" + "# c:\\" + end + "f 1 3 4\n");
      const std::uint32_t own = std::string(line).starts_with("f") ? 1 : 0;
      EXPECT_EQ(soup.face_count(), 2 + own) << line;
    }
  }
}

TEST(ObjRead, IgnoredStatementsMayContinueOverSeveralLines) {
  const Soup soup = parse(kSquare + "curv 1 2 \\\nf 1 2 3 \\\r\nf 9 9 9\nf 1 3 4\n");
  EXPECT_EQ(soup.face_count(), 1U);
}

TEST(ObjRead, ReadsPositionsAndTriangles) {
  const Soup soup = parse("# a comment\nv 1.5 -2e3 .25\nv 0 1 0\nv +3 4. 5E-1\nf 1 2 3\n");
  ASSERT_EQ(soup.positions.size(), 3U);
  EXPECT_EQ(soup.positions[0], glm::vec3(1.5F, -2000.0F, 0.25F));
  EXPECT_EQ(soup.positions[2], glm::vec3(3.0F, 4.0F, 0.5F));
  EXPECT_EQ(corners_of(soup), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(soup.face_start.empty());
  EXPECT_TRUE(soup.attributes.is_empty());
}

TEST(ObjRead, AcceptsEveryLineEnding) {
  for (const std::string text :
       {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "\xEF\xBB\xBFv 0 0 0\n\n\n\tv\t1\t0\t0\t\n  v 0 1 0  \nf 1 2 3 # why\n",
        "v 0 0 0\nv \\\n1 0\\\n 0\nv 0 1 \\\r\n0\nf 1 2 \\\n  3\n\\\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\"}) {
    const Soup soup = parse(text);
    ASSERT_EQ(soup.positions.size(), 3U) << text;
    EXPECT_EQ(soup.positions[1], glm::vec3(1, 0, 0)) << text;
    EXPECT_EQ(soup.positions[2], glm::vec3(0, 1, 0)) << text;
    EXPECT_EQ(corners_of(soup), (std::vector<std::uint32_t>{0, 1, 2})) << text;
  }
}

TEST(ObjRead, ReadsPolygonsAndShortFaces) {
  const Soup soup = parse(kSquare + "f 1 2 3\nf 1 2 3 4\nf 1 2\nf\nf 2 3 4\n");
  EXPECT_EQ(std::vector<std::uint32_t>(soup.face_start.begin(), soup.face_start.end()),
            (std::vector<std::uint32_t>{0, 3, 7, 9, 9, 12}));
  EXPECT_EQ(soup.face_count(), 5U);
}

TEST(ObjRead, ReadsEveryIndexForm) {
  const std::string values = kTriangle + "vt 0.5 0.25\nvt 1\nvn 0 0 1\n";
  const Soup plain = parse(values + "f 1 2 3\n");
  EXPECT_TRUE(plain.attributes.texcoord.empty());
  EXPECT_TRUE(plain.attributes.normal.empty());
  const Soup both = parse(values + "f 1/1/1 2/2/1 3/1/1\n");
  EXPECT_EQ(both.attributes.texcoord[0], glm::vec2(0.5F, 0.25F));
  EXPECT_EQ(both.attributes.texcoord[1], glm::vec2(1.0F, 0.0F));
  EXPECT_EQ(both.attributes.normal[2], glm::vec3(0, 0, 1));
  const Soup normals = parse(values + "f 1//1 2//1 3//1\n");
  EXPECT_TRUE(normals.attributes.texcoord.empty());
  EXPECT_EQ(normals.attributes.normal[0], glm::vec3(0, 0, 1));
  const Soup texcoords = parse(values + "f 1/1 2/2 3/2/\n");
  EXPECT_EQ(texcoords.attributes.texcoord.size(), 3U);
  EXPECT_TRUE(texcoords.attributes.normal.empty());
}

TEST(ObjRead, MissingAttributesAreNaN) {
  const Soup soup = parse(kTriangle + "vt 1 1\nf 1 2 3\nf 1/1 2 3/1\nf 3 2 1\n");
  ASSERT_EQ(soup.attributes.texcoord.size(), 9U);
  for (const int corner : {0, 1, 2, 4, 6, 7, 8}) {
    EXPECT_TRUE(std::isnan(soup.attributes.texcoord[corner].x)) << corner;
  }
  EXPECT_EQ(soup.attributes.texcoord[3], glm::vec2(1, 1));
  EXPECT_EQ(soup.attributes.texcoord[5], glm::vec2(1, 1));
}

TEST(ObjRead, RelativeIndicesCountFromTheirLine) {
  const Soup soup = parse(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nf -3/-2/-1 -2/-1/-1 -1/-1/-1\n"
      "v 5 5 5\nf -1 -2 -3\nf 4 1 2\n");
  EXPECT_EQ(corners_of(soup), (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 1, 3, 0, 1}));
  EXPECT_EQ(soup.attributes.texcoord[0], glm::vec2(0, 0));
  EXPECT_EQ(soup.attributes.texcoord[2], glm::vec2(1, 1));
}

TEST(ObjRead, AcceptsForwardReferences) {
  EXPECT_EQ(corners_of(parse("f 1 2 3\n" + kTriangle)), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(ObjRead, ReadsColorsAndWeights) {
  const Soup soup =
      parse("v 0 0 0 1\nv 1 0 0 1 0.5 0\nv 0 1 0 0 0 0 0.5\nv 1 1 1\nf 1 2 3\nf 1 2 4\n");
  ASSERT_EQ(soup.attributes.color.size(), 6U);
  EXPECT_EQ(soup.attributes.color[0], glm::u8vec4(255));
  EXPECT_EQ(soup.attributes.color[1], glm::u8vec4(255, 128, 0, 255));
  EXPECT_EQ(soup.attributes.color[2], glm::u8vec4(0, 0, 0, 128));
  EXPECT_EQ(soup.attributes.color[5], glm::u8vec4(255));
}

TEST(ObjRead, GroupsKeepObjectNameSmoothingAndMaterialApart) {
  EXPECT_TRUE(parse(kTriangle + "g\nf 1 2 3\n").attributes.group.empty());
  EXPECT_EQ(parse("g all\n" + kTriangle + "f 1 2 3\n").attributes.groups,
            test::named_groups({"all"}));
  EXPECT_EQ(parse("s off\n" + kTriangle + "f 1 2 3\n").attributes.groups,
            (std::vector<FaceGroup>{{.smoothing = "off"}}));
  const Soup soup = parse(kTriangle +
                          "f 1 2 3\no box\ng side\nf 1 2 3\nf 2 3 1\nusemtl red\nf 1 2 3\n"
                          "g empty\ng side\nf 1 2 3\ng\nf 1 2 3\n");
  EXPECT_EQ(soup.attributes.groups,
            (std::vector<FaceGroup>{{},
                                    {.object = "box", .name = "side"},
                                    {.object = "box", .name = "side", .material = 0},
                                    {.object = "box", .material = 0}}));
  ASSERT_EQ(soup.materials->materials.size(), 1U);
  EXPECT_EQ(soup.materials->materials[0].name, "red");
  EXPECT_TRUE(soup.materials->materials[0].is_name_only);
  EXPECT_EQ(std::vector<std::uint32_t>(soup.attributes.group.begin(), soup.attributes.group.end()),
            (std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3}));
}

TEST(ObjRead, UnsupportedStatementsAreIgnored) {
  const Soup soup =
      parse(kTriangle +
            "mtllib C:\\models\\\ns off\np 1\nl 1\nl 7 8 9\nvp 0.1\ncurv 0 1 \\\n 2\nend\n"
            "trim\nvx 1\nface 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(soup.face_count(), 1U);
}

TEST(ObjRead, NonFiniteNumbersAreKept) {
  const Soup soup = parse("v nan inf -inf\nv 1e999 -1e999 1e-999\nv 0 0 0\nf 1 2 3\n");
  EXPECT_TRUE(std::isnan(soup.positions[0].x));
  EXPECT_EQ(soup.positions[0].z, -kInf);
  EXPECT_EQ(soup.positions[1], glm::vec3(kInf, -kInf, 0.0F));
}

TEST(ObjRead, ReadsCreasesInThreeForms) {
  const Soup soup = parse(
      kSquare +
      "f 1 2 3\nf 1 3 4\ne 0 2 1.5\ne 0 1 inf\ne 1 2\nt crease 2/1/0 0 3 2\n"
      "t crease 3/1/0 0 1 2 4\nt corner 1/1/0 3 7\nt corner 2/2/0 0 1 5 inf\nt other 1/0/0 99\n");
  ASSERT_EQ(soup.creases.size(), 6U);
  EXPECT_EQ(soup.creases[0].a, 0U);
  EXPECT_EQ(soup.creases[0].b, 2U);
  EXPECT_EQ(soup.creases[0].sharpness, 1.5F);
  EXPECT_EQ(soup.creases[1].sharpness, kInf);
  EXPECT_EQ(soup.creases[2].sharpness, kInf);
  EXPECT_EQ(soup.creases[3].b, 3U);
  EXPECT_EQ(soup.creases[3].sharpness, 2.0F);
  EXPECT_EQ(soup.creases[5].a, 1U);
  EXPECT_EQ(soup.creases[5].b, 2U);
  EXPECT_EQ(soup.creases[5].sharpness, 4.0F);
  ASSERT_EQ(soup.corner_tags.size(), 3U);
  EXPECT_EQ(soup.corner_tags[0].v, 3U);
  EXPECT_EQ(soup.corner_tags[0].sharpness, 7.0F);
  EXPECT_EQ(soup.corner_tags[2].sharpness, kInf);
}

TEST(ObjRead, DetectsTheIndexBaseOfCreases) {
  // With base 0, 1-3 (vertices 1 and 3) is not an edge. With base 1 it is the diagonal 0-2.
  const std::string faces = kSquare + "f 1 2 3\nf 1 3 4\n";
  EXPECT_EQ(parse(faces + "e 1 3\ne 1 2\n").creases[0].b, 2U);
  EXPECT_EQ(parse(faces + "e 1 2\n").creases[0].b, 2U) << "both bases fit, and 0 is preferred";
  EXPECT_EQ(parse(faces + "e 1 2\n", {.crease_index_base = 1}).creases[0].b, 1U);
  EXPECT_EQ(parse(faces + "e 3 4\n").creases[0].b, 3U) << "vertex 4 exists only with base 1";
}

TEST(ObjRead, ErrorsHaveTheirLineNumber) {
  const auto expect = [](const std::string& text, std::uint64_t line, const std::string& reason) {
    const Refusal found = refusal(text);
    EXPECT_EQ(found.line, line) << text;
    EXPECT_NE(found.reason.find(reason), std::string::npos) << text << " gave " << found.reason;
  };
  expect("v 0 0\n", 1, "three coordinates");
  expect("v 0 0 0\nv 1 x 0\n", 2, "not a number");
  expect("v 0 0 0\nv 1 1.2.3 0\n", 2, "not a number");
  expect("v 0 0 0\nv 1 0x10 0\n", 2, "not a number");
  expect("v 0 0 0\nv 1 --1 0\n", 2, "not a number");
  expect(kTriangle + "\n\nf 1 2 4\n", 6, "vertex index out of range");
  expect(kTriangle + "f 1 2 99999999999999999999\n", 4, "vertex index out of range");
  expect(kTriangle + "f 0 1 2\n", 4, "index 0");
  expect(kTriangle + "f -1 -2 -4\n", 4, "vertex index out of range");
  expect("v 0 0 0\nv 1 1 1\nf -1 -2 -3\nv 0 0 0\n", 3, "vertex index out of range");
  expect(kTriangle + "f 1 2 3\nf 1 2 b\n", 5, "not a face corner");
  expect(kTriangle + "f 1 2 3/x\n", 4, "not a face corner");
  expect(kTriangle + "f 1 2 3/-\n", 4, "not a face corner");
  expect(kTriangle + "f 1 2 3.5\n", 4, "not a face corner");
  expect(kTriangle + "f 1 2 - 3\n", 4, "not a face corner");
  expect(kTriangle + "vt\nf 1 2 3\n", 4, "texture coordinate");
  expect(kTriangle + "vn 1 2\nf 1 2 3\n", 4, "three components");
  expect(kTriangle + "f 1 2 3\ne 0\n", 5, "vertex numbers");
  expect(kTriangle + "f 1 2 3\ne 0 -1\n", 5, "vertex numbers");
  expect(kTriangle + "f 1 2 3\ne 0 7\n", 5, "does not exist");
  expect(kTriangle + "f 1 2 3\nt crease 2/1 0 1 1\n", 5, "counts like");
  expect(kTriangle + "f 1 2 3\nt crease 4000000000/1/0 0 1 1\n", 5, "vertex numbers");
  expect("# nothing\n", 0, "no vertices");
  expect(std::string("v 0 0 0\nv \0 0 0\n", 16), 2, "not a number");
}

// An index that no value has costs its corner the attribute. The shape is whole.
TEST(ObjRead, BadAttributeIndicesCostTheCornerItsAttribute) {
  const std::string values = kTriangle + "vt 0.5 0.5\nvn 0 0 1\n";
  struct Case {
    const char* corner;
    std::uint64_t bad;
    bool has_texcoord;
    bool has_normal;
  };
  for (const Case& c :
       {Case{"3/1/1", 0, true, true}, Case{"3/2/1", 1, false, true}, Case{"3/1/2", 1, true, false},
        Case{"3/0/0", 2, false, false}, Case{"3/-1/-1", 0, true, true},
        Case{"3/-2/-1", 1, false, true}, Case{"3/-4294967295/-4294967296", 2, false, false},
        Case{"3/-99999999999999999999/1", 1, false, true},
        Case{"3/99999999999999999999/4294967295", 2, false, false},
        Case{"3//7", 1, false, false}}) {
    SCOPED_TRACE(c.corner);
    const Soup soup = parse(values + "f 1/1/1 2/1/1 " + c.corner + "\n");
    EXPECT_EQ(soup.face_count(), 1U);
    EXPECT_EQ(soup.report[Repair::attribute_indices_ignored], c.bad);
    EXPECT_EQ(soup.attributes.texcoord[2] == glm::vec2(0.5F), c.has_texcoord);
    EXPECT_EQ(soup.attributes.normal[2] == glm::vec3(0, 0, 1), c.has_normal);
    EXPECT_EQ(soup.attributes.texcoord[0], glm::vec2(0.5F));
  }
}

// Relative indices reach back across chunks; only those before the start of the file are bad.
TEST(ObjRead, BadRelativeAttributeIndicesAreFoundInEveryChunk) {
  std::string text = kTriangle + "vt 0.5 0.5\n";
  while (text.size() < 600000)
    text += "# a comment that fills a chunk of the file, so that the face is in another one\n";
  const Soup soup = parse(text + "f 1/-1 2/-2 3/-4294967290\n");
  EXPECT_EQ(soup.report[Repair::attribute_indices_ignored], 2U);
  EXPECT_EQ(soup.attributes.texcoord[0], glm::vec2(0.5F));
  EXPECT_TRUE(std::isnan(soup.attributes.texcoord[1].x));
  EXPECT_TRUE(std::isnan(soup.attributes.texcoord[2].x));
}

TEST(ObjRead, BlanksAfterABackslashDoNotMatter) {
  for (const char* end : {"\\\n", "\\ \n", "\\\t \n", "\\\r\n", "\\  \r\n"}) {
    SCOPED_TRACE(end);
    const std::string cut = std::string(" ") + end + " ";
    const Soup soup = parse("v 0" + cut + "0 0\nv 1 0" + cut + "0\nv 0 1 0" + cut + "\nxyz a" +
                            cut + "f 1 1 1\nf 1" + cut + "2" + cut + cut + "3\n");
    EXPECT_EQ(soup.positions.size(), 3U);
    EXPECT_EQ(corners_of(soup), (std::vector<std::uint32_t>{0, 1, 2}));
  }
  EXPECT_NE(refusal(kTriangle + "f 1 2 \\ 3\n").reason.find("not a face corner"),
            std::string::npos);
}

TEST(ObjRead, Utf16IsRefusedByName) {
  for (const bool is_big : {false, true}) {
    std::string text = is_big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : kTriangle)
      text += is_big ? std::string{'\0', c} : std::string{c, '\0'};
    EXPECT_NE(refusal(text).reason.find("UTF-16"), std::string::npos);
  }
}

TEST(ObjRead, NotesWhatItDoesNotKeep) {
  const Soup soup = parse(
      "mtllib a b.mtl\no Box\ng left\ns 1\nusemtl brick\nv 0 0 0 2\nv 1 0 0\nv 0 1 0\n"
      "vt 0 0 0.5\nvp 0 0\np 1 2 3\nl 1 2\nl 2 3\ncurv 0 1 1 2\nbevel on\nf 1/1 2/1 3/1\n"
      "usemtl paper\nusemtl brick\ns off\ng right\nf 3 2 1\n");
  const FileContents& contents = soup.contents;
  EXPECT_EQ(contents.names(Content::material_files), std::vector<std::string>{"a b.mtl"});
  EXPECT_EQ(contents.names(Content::objects), std::vector<std::string>{"Box"});
  EXPECT_EQ(contents.names(Content::groups), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(contents.names(Content::materials), (std::vector<std::string>{"brick", "paper"}));
  EXPECT_EQ(contents[Content::smoothing_groups], 1U);
  EXPECT_EQ(contents[Content::points], 3U);
  EXPECT_EQ(contents[Content::lines], 2U);
  EXPECT_EQ(contents[Content::curves], 1U);
  EXPECT_EQ(contents[Content::uv_sets], 1U);
  EXPECT_EQ(
      contents.names(Content::own_properties),
      (std::vector<std::string>{"bevel", "weights of vertices", "third texture coordinates"}));
}

/// A grid of n x n quads as text.
std::string grid(int n) {
  std::string text;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " 0.123456\n";
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
              std::to_string(a + n + 2) + " " + std::to_string(a + n + 1) + "\n";
    }
  }
  return text;
}

TEST(ObjRead, ManyChunksGiveTheSameModelForAnyThreadCount) {
  const std::string text = grid(700);  // about 20 MB, several batches of chunks
  const Soup parallel = parse(text);
  ASSERT_EQ(parallel.positions.size(), 701U * 701U);
  ASSERT_EQ(parallel.face_count(), 700U * 700U);
  EXPECT_EQ(parallel.positions[701 * 701 - 1], glm::vec3(700, 700, 0.123456F));
  EXPECT_EQ(parallel.corners.back(), 700U * 701U - 1 + 700U);
  const ThreadLimit one(1);
  const Soup serial = parse(text);
  EXPECT_EQ(serial.positions, parallel.positions);
  EXPECT_EQ(serial.corners, parallel.corners);
  EXPECT_EQ(serial.face_start, parallel.face_start);
}

TEST(ObjRead, LineNumbersAreCorrectFarIntoTheFile) {
  const std::string text = grid(300);
  const auto lines = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
  EXPECT_EQ(refusal(text + "v 1 2 three\n").line, lines + 1);
  EXPECT_EQ(refusal(text + "f 1 2 90602\n").line, lines + 1);
  EXPECT_EQ(refusal(text + "f 1 2 -90602\n").line, lines + 1);
  EXPECT_EQ(refusal("f 1 2 90602\n" + text).line, 1U);
}

TEST(ObjRead, RelativeIndicesCrossChunks) {
  std::string text;
  for (int i = 0; i < 60000; ++i)
    text += "v " + std::to_string(i) + " 0.5 0.25\n";
  const Soup soup = parse(text + "f -60000 -1 -30000\n");
  EXPECT_EQ(corners_of(soup), (std::vector<std::uint32_t>{0, 59999, 30000}));
}

TEST(ObjRead, PolygonsAndAttributesMayStartLate) {
  std::string text = kSquare + "vt 0.5 0.5\n";
  constexpr std::uint32_t kMany = 700000;  // more than one batch
  for (std::uint32_t i = 0; i < kMany; ++i)
    text += "f 1 2 3\n";
  const Soup soup = parse(text + "f 1/1 2/1 3/1 4/1\n");
  ASSERT_EQ(soup.face_start.size(), kMany + 2);
  EXPECT_EQ(soup.face_start[kMany], 3 * kMany);
  EXPECT_EQ(soup.face_start[kMany + 1], 3 * kMany + 4);
  EXPECT_TRUE(std::isnan(soup.attributes.texcoord[0].x));
  EXPECT_TRUE(std::isnan(soup.attributes.texcoord[3 * kMany - 1].x));
  EXPECT_EQ(soup.attributes.texcoord[3 * kMany + 3], glm::vec2(0.5F));
}

}  // namespace
}  // namespace mesher
