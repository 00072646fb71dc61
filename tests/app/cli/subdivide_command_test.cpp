#include "app/cli/subdivide_command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "app/cli/run.h"
#include "engine/core/memory.h"
#include "engine/io/read.h"
#include "engine/mesh/validate.h"
#include "tests/support/attributes.h"
#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

using test::Finished;
using Json = nlohmann::json;

/// Runs the program from the command line, in a folder of the test.
class SubdivideCommand : public testing::Test {
 protected:
  Finished subdivide(std::vector<std::string> arguments) {
    const std::vector<std::string> start{"env", "-C", folder_.path().string(), MESHER_PROGRAM,
                                         "subdivide"};
    arguments.insert(arguments.begin(), start.begin(), start.end());
    return test::run_program(arguments);
  }
  Model read(const char* file, const io::ReadOptions& options = {}) {
    return io::read_model(folder_ / file, options);
  }

  test::TempFolder folder_;
};

bool is_said(const Finished& run, std::string_view words) {
  return run.err.find(words) != std::string::npos;
}

TEST_F(SubdivideCommand, WritesFourTimesTheFacesAndReports) {
  const Finished run = subdivide({"cube", "-o", "c.obj", "--levels", "2", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["before"], (Json{{"vertices", 8}, {"faces", 12}}));
  EXPECT_EQ(json["after"], (Json{{"vertices", 98}, {"faces", 192}}));
  EXPECT_EQ(json["levels"], 2);
  EXPECT_EQ(json["scheme"], "loop");
  EXPECT_EQ(json["creases"], "hoppe94");
  EXPECT_EQ(json["boundary"], "edge-only");
  EXPECT_EQ(json["crease_decay"], "uniform");
  EXPECT_EQ(json["limit"], false);
  EXPECT_EQ(json["output"], "c.obj");
  EXPECT_GE(json["seconds"], 0.0);
  for (const char* key : {"input", "lost", "repairs"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_TRUE(is_said(run, "subdivided 2x (loop) in ")) << run.err;
  const Model model = read("c.obj");
  EXPECT_EQ(model.mesh.face_count(), 192U);
  EXPECT_TRUE(validate(model.mesh).empty());
}

TEST_F(SubdivideCommand, BowTiesKeepPositionAndGetNoTags) {
  folder_.write("touching.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n"
                "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 5 6\nf 1 7 5\nf 5 7 6\nf 6 7 1\n");
  for (const char* scheme : {"loop", "butterfly", "midpoint"}) {
    const Finished run = subdivide(
        {"touching.obj", "-o", "fine.obj", "--levels", "3", "--limit", "--scheme", scheme});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Model fine = read("fine.obj", {.weld = std::nullopt});
    // The file contains the copies as ordinary vertices: the first and the last of the old ones.
    EXPECT_EQ(fine.mesh.position(Vertex(0)), glm::vec3(0.0F)) << scheme;
    EXPECT_EQ(fine.mesh.position(Vertex(7)), glm::vec3(0.0F)) << scheme;
    const std::string text = test::read_bytes(folder_ / "fine.obj");
    EXPECT_EQ(text.find("\nt corner"), std::string::npos) << scheme;
    EXPECT_EQ(text.find("\ne "), std::string::npos) << scheme;
  }
}

TEST_F(SubdivideCommand, QuietPrintsNothing) {
  const Finished run = subdivide({"cube", "c.ply", "--quiet"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, "");
}

TEST_F(SubdivideCommand, AcceptsSingleDashOptions) {
  const Finished run = subdivide({"-input", "cube", "-o", "c.obj", "-levels", "3", "-scheme",
                                  "butterfly", "-crease-decay", "chaikin", "-json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["scheme"], "butterfly");
  EXPECT_EQ(json["crease_decay"], "chaikin");
  EXPECT_EQ(json["after"]["faces"], 12 * 64);
}

TEST_F(SubdivideCommand, IndexOverflowIsRejectedWithSize) {
  const Finished run = subdivide({"bunny", "-o", "b.obj", "--levels", "14"});
  EXPECT_EQ(run.exit_code, 3);
  // 3,674 faces: the eleventh level has 15,410 million, four times as many as indices allow.
  EXPECT_TRUE(is_said(run, "subdividing 14 times would make ")) << run.err;
  EXPECT_TRUE(is_said(run, " faces or more: too many for 32-bit indices")) << run.err;
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(SubdivideCommand, OutOfMemoryIsRejectedWithSize) {
  const MemoryLimit limit(1'000'000'000);
  const std::string output = (folder_ / "c.obj").string();
  const std::array arguments{"mesher", "subdivide", "cube", "-o", output.c_str(), "--levels", "13"};
  testing::internal::CaptureStderr();
  EXPECT_EQ(app::run(static_cast<int>(arguments.size()), arguments.data()), 3);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("would make 805,306,368 faces, which needs "), std::string::npos) << said;
  EXPECT_NE(said.find(" of memory; the limit is four fifths of the "), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(SubdivideCommand, UnknownValuesAreRejected) {
  const std::vector<std::vector<std::string>> wrong{
      {"--scheme", "doo-sabin"},  {"--creases", "hoppe"}, {"--boundary", "none"},
      {"--crease-decay", "fast"}, {"--levels", "17"},     {"--levels", "-1"},
      {"--levels", "x"},          {"--level-of", "2"}};
  for (const std::vector<std::string>& words : wrong) {
    std::vector<std::string> arguments{"cube", "-o", "c.obj"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    EXPECT_EQ(subdivide(arguments).exit_code, 1) << words[0] << ' ' << words[1];
  }
  EXPECT_EQ(subdivide({"cube"}).exit_code, 1);
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(SubdivideCommand, UnknownExtensionIsRejectedBeforeReading) {
  // The input does not exist either, but the first error is reported.
  const Finished run = subdivide({"no_such_model", "-o", "b.docx", "--levels", "2"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(is_said(run, "docx")) << run.err;
}

TEST_F(SubdivideCommand, ModelWithoutFacesIsRejected) {
  folder_.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  for (const bool keeps : {false, true}) {
    std::vector<std::string> arguments{"points.obj", "-o", "o.obj"};
    if (keeps) arguments.push_back("--keep-isolated");
    const Finished run = subdivide(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_TRUE(is_said(run, "points.obj")) << run.err;
  }
  EXPECT_EQ(subdivide({"no_such_model.obj", "-o", "o.obj"}).exit_code, 2);
}

TEST_F(SubdivideCommand, MissingOutputFolderExitsWithFour) {
  EXPECT_EQ(subdivide({"cube", "-o", "nowhere/c.obj"}).exit_code, 4);
}

TEST_F(SubdivideCommand, OutputKeepsInfinitelySharpCreases) {
  ASSERT_EQ(subdivide({"creased_cube", "-o", "c.obj", "--levels", "2"}).exit_code, 0);
  const Mesh mesh = read("c.obj").mesh;
  const auto sharp = [](float s) { return s == kInfinitelySharp; };
  EXPECT_EQ(std::count_if(mesh.sharpnesses().begin(), mesh.sharpnesses().end(), sharp),
            2 * 5 * 4);  // half-edges of five creases in four pieces each
}

TEST_F(SubdivideCommand, OutputDecaysSemiSharpCreases) {
  folder_.write("soft.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nf 1 2 3\nf 2 4 3\ne 1 2 2.5\n");
  ASSERT_EQ(subdivide({"soft.obj", "-o", "s.obj"}).exit_code, 0);
  const Mesh mesh = read("s.obj").mesh;
  EXPECT_EQ(std::count(mesh.sharpnesses().begin(), mesh.sharpnesses().end(), 1.5F), 4);
}

TEST_F(SubdivideCommand, LimitWritesUnitNormals) {
  const Finished run = subdivide({"cube", "-o", "c.obj", "--limit", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["limit"], true);
  const Model model = read("c.obj");
  const Array<glm::vec3> normals = test::corners_of(model).normal;
  ASSERT_EQ(normals.size(), model.mesh.halfedge_count());
  for (std::uint32_t h = 0; h < model.mesh.halfedge_count(); ++h) {
    const glm::vec3& n = normals[h];
    EXPECT_NEAR(glm::dot(n, n), 1.0F, 1e-4F);
    EXPECT_GT(glm::dot(n, model.mesh.position(model.mesh.origin(Halfedge(h)))), 0.0F);
  }
  ASSERT_EQ(subdivide({"cube", "-o", "plain.obj"}).exit_code, 0);
  EXPECT_TRUE(read("plain.obj").attributes.is_empty());
}

TEST_F(SubdivideCommand, LimitOfInterpolatingSchemesHasNoEffect) {
  const Finished run = subdivide({"cube", "-o", "b.obj", "--scheme", "butterfly", "--limit"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(
      is_said(run, "--limit has no effect: the vertices of this scheme are on their limit surface"))
      << run.err;
  ASSERT_EQ(subdivide({"cube", "-o", "plain.obj", "--scheme", "butterfly"}).exit_code, 0);
  EXPECT_EQ(test::read_bytes(folder_ / "b.obj"), test::read_bytes(folder_ / "plain.obj"));
}

TEST_F(SubdivideCommand, CarriesAttributesAndComputesNormals) {
  folder_.write("t.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvn 0 0 1\n"
                "g stone\nf 1/1/1 2/2/1 3/3/1\ng moss\nf 2/1/1 4/4/1 3/3/1\n");
  const Finished run = subdivide({"t.obj", "-o", "o.obj", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["lost"], Json::array());
  const CornerAttributes attributes = test::corners_of(read("o.obj"));
  ASSERT_EQ(attributes.texcoord.size(), 24U);
  EXPECT_EQ(attributes.texcoord[1], glm::vec2(0.5F, 0.0F));
  EXPECT_EQ(attributes.texcoord[12], glm::vec2(0.0F, 0.0F));  // a seam: vertex 2 is 1 0 elsewhere
  EXPECT_EQ(attributes.normal, Array<glm::vec3>(24, glm::vec3(0, 0, 1)));
  EXPECT_EQ(attributes.groups, test::named_groups({"stone", "moss"}));
  ASSERT_EQ(attributes.group.size(), 8U);
  EXPECT_EQ(attributes.group[3], 0U);
  EXPECT_EQ(attributes.group[4], 1U);
}

TEST_F(SubdivideCommand, ZeroLevelsLeaveModelUnchanged) {
  folder_.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  const Finished run = subdivide({"t.obj", "-o", "o.obj", "--levels", "0", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["lost"], Json::array());
  const Model model = read("o.obj");
  EXPECT_EQ(model.mesh.face_count(), 1U);
  EXPECT_EQ(test::corners_of(model).normal.size(), 3U);
}

TEST_F(SubdivideCommand, OutputIsIndependentOfThreadCount) {
  for (const char* scheme : {"loop", "butterfly", "midpoint"}) {
    const auto run = [&](const char* threads, const char* file) {
      ASSERT_EQ(subdivide({"creased_cube", "-o", file, "--levels", "5", "--scheme", scheme,
                           "--limit", "--threads", threads})
                    .exit_code,
                0);
    };
    run("1", "one.obj");
    run("2", "two.obj");
    EXPECT_EQ(test::read_bytes(folder_ / "one.obj"), test::read_bytes(folder_ / "two.obj"))
        << scheme;
  }
}

}  // namespace
}  // namespace mesher::app
