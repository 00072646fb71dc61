// Tests `mesher lods`, which writes several levels of detail.
#include "app/cli/lods_command.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "tests/app/program_test.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/obj_files.h"

namespace mesher::test {
namespace {

using app::parse_coverage;
using app::parse_ratios;
using Numbers = std::vector<double>;

TEST(LodArguments, RatiosMustDecrease) {
  EXPECT_EQ(parse_ratios("1,0.5,0.25"), (Numbers{1.0, 0.5, 0.25}));
  EXPECT_EQ(parse_ratios("0.1"), (Numbers{0.1}));
  for (const char* bad : {"", ",", "1,", "0", "1,0", "-1", "1.5,1", "0.5,0.5", "0.25,0.5", "nan",
                          "1,nan", "inf", "1 0.5", "1,0.5x", "1;0.5"})
    EXPECT_THROW((void)parse_ratios(bad), UsageError) << bad;
}

TEST(LodArguments, CoveragesMustDecreaseOnePerLevel) {
  EXPECT_EQ(parse_coverage("0.5,0.2,0", 3), (Numbers{0.5, 0.2, 0.0}));
  for (const char* bad : {"", "0.5", "0.5,0.2,0.1,0", "0.1,0.2,0.3", "0.5,0.5,0.1", "2,1,0",
                          "0.5,0.2,-0.1", "nan,nan,nan", "a,b,c"})
    EXPECT_THROW((void)parse_coverage(bad, 3), UsageError) << bad;
  EXPECT_EQ(app::default_coverage({1.0, 0.5, 0.25}), (Numbers{0.5, 0.25, 0.0}));
  EXPECT_EQ(app::default_coverage({1.0}), (Numbers{0.0}));
}

TEST(LodArguments, ErrorsMustIncreaseInOneUnit) {
  using app::parse_errors;
  EXPECT_EQ(parse_errors("--max-error", "0.5,2", 100.0), (Numbers{0.5, 2.0}));
  EXPECT_EQ(parse_errors("--max-error", "0,1%,2%", 100.0), (Numbers{0.0, 1.0, 2.0}));
  EXPECT_EQ(parse_errors("--max-error", "0%,1%", 100.0), (Numbers{0.0, 1.0}));
  for (const char* bad :
       {"", ",", "%", "-1", "2,1", "1,1", "0,0", "1%,2", "1,2%", "1%%", "nan", "x"})
    EXPECT_THROW((void)parse_errors("--max-error", bad, 1.0), UsageError) << bad;
}

TEST(LodArguments, PixelsFollowFromTheScreen) {
  // The sphere around the model, of radius 1, fills the screen.
  app::ScreenArguments screen{.height_pixels = 1000.0, .fov_deg = 90.0, .distance = {}};
  EXPECT_NEAR(app::eye_distance(screen, 2.0), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(app::pixels_per_unit(screen, 2.0), 500.0 / std::sqrt(2.0), 1e-9);
  screen.distance = 10.0;
  EXPECT_NEAR(app::pixels_per_unit(screen, 2.0), 50.0, 1e-9);
  screen.distance.reset();
  EXPECT_EQ(app::pixels_per_unit(screen, 0.0), 0.0);
}

TEST(LodArguments, FilesAreNumbered) {
  EXPECT_EQ(app::manifest_file("a.b/c.d.ply"), "a.b/c.d.json");
  EXPECT_EQ(app::level_file("out.obj", 0), "out_lod0.obj");
  EXPECT_EQ(app::level_file("a.b/c.d.ply", 12), "a.b/c.d_lod12.ply");
}

class LodsCommand : public ProgramTest {
 protected:
  /// The JSON of a .glb.
  nlohmann::json document(const std::string& file) {
    const std::string bytes = read_bytes(folder_ / file);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return nlohmann::json::parse(bytes.substr(20, length));
  }
};

TEST_F(LodsCommand, GlbHoldsAllLevels) {
  const Finished run = mesher({"lods", "bunny", "-o", "b.glb", "--ratios", "1,0.5,0.25",
                               "--coverage", "0.5,0.2,0.05", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["files"], nlohmann::json({"b.glb"}));
  EXPECT_EQ(json["faces_before"], 3674);
  EXPECT_EQ(json["stop_reason"], "target_reached");
  ASSERT_EQ(json["levels"].size(), 3U);
  const int faces[] = {3674, 1836, 918};
  const auto glb = document("b.glb");
  ASSERT_EQ(glb["nodes"].size(), 3U);
  ASSERT_EQ(glb["meshes"].size(), 3U);
  EXPECT_EQ(glb["extensionsUsed"], nlohmann::json({"MSFT_lod"}));
  EXPECT_EQ(glb["scenes"][0]["nodes"], nlohmann::json::array({0}));
  EXPECT_EQ(glb["nodes"][0]["extensions"]["MSFT_lod"]["ids"], nlohmann::json({1, 2}));
  EXPECT_EQ(glb["nodes"][0]["extras"]["MSFT_screencoverage"], nlohmann::json({0.5, 0.2, 0.05}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(json["levels"][i]["faces"], faces[i]);
    const std::size_t mesh = glb["nodes"][i]["mesh"];
    const auto& primitive = glb["meshes"][mesh]["primitives"][0];
    EXPECT_EQ(glb["accessors"][primitive["indices"].get<std::size_t>()]["count"], 3 * faces[i]);
    const auto& positions =
        glb["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(positions["count"], json["levels"][i]["vertices"]);
    EXPECT_TRUE(positions.contains("min"));
  }
  // A reader without MSFT_lod sees the finest level.
  EXPECT_EQ(mesher_json({"info", "b.glb"})["statistics"]["faces"], 3674);
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile((folder_ / "b.glb").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 1U);
  EXPECT_EQ(scene->mMeshes[0]->mNumFaces, 3674U);
}

TEST_F(LodsCommand, DefaultCoverageFollowsRatios) {
  const auto json = mesher_json({"lods", "bunny", "-o", "b.gltf"});
  ASSERT_EQ(json["levels"].size(), 3U);
  const auto gltf = nlohmann::json::parse(read_bytes(folder_ / "b.gltf"));
  EXPECT_EQ(gltf["nodes"][0]["extras"]["MSFT_screencoverage"], nlohmann::json({0.5, 0.25, 0.0}));
  EXPECT_EQ(json["levels"][1]["coverage"], 0.25);
}

TEST_F(LodsCommand, OtherFormatsGetOneFilePerLevel) {
  const Finished run = mesher({"lods", "cactus", "-o", "c.obj", "--ratios", "1,0.6", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["files"], nlohmann::json({"c_lod0.obj", "c_lod1.obj"}));
  EXPECT_EQ(folder_.count_files(), 3U) << "and a manifest";
  const auto input = mesher_json({"info", "cactus"})["statistics"];
  EXPECT_EQ(mesher_json({"info", "c_lod0.obj"})["statistics"], input);
  const auto coarse = mesher_json({"info", "c_lod1.obj"})["statistics"];
  EXPECT_LE(coarse["faces"], std::round(0.6 * input["faces"].get<double>()));
  EXPECT_GT(coarse["crease_edges"], 0);
  EXPECT_EQ(coarse["euler_characteristic"], input["euler_characteristic"]);
  const Finished ply = mesher({"lods", "cactus", "-o", "c.ply"});
  EXPECT_TRUE(holds(ply.err, "c.ply does not hold ")) << ply.err;
}

/// A bumpy sheet. Its texture coordinates have seams at every edge, or no seams.
std::string sheet(bool has_seams) {
  constexpr int kSide = 6;
  std::string text = "vn 0 0 1\n";
  for (int i = 0; i < (kSide + 1) * (kSide + 1); ++i) {
    const std::string xy = std::to_string(i % (kSide + 1)) + ' ' + std::to_string(i / (kSide + 1));
    text += "v " + xy + ' ' + std::to_string(0.1 * (i % 3)) + "\nvt " + xy + '\n';
  }
  const auto face = [&](int a, int b, int c, int seam) {
    for (const int v : {a, b, c}) {
      const int t = has_seams ? seam : v;
      text += (v == a ? "f " : " ") + std::to_string(v + 1) + '/' + std::to_string(t + 1) + "/1";
    }
    text += '\n';
  };
  for (int i = 0; i < kSide * kSide; ++i) {
    const int a = i / kSide * (kSide + 1) + i % kSide;
    face(a, a + 1, a + kSide + 2, 1);
    face(a, a + kSide + 2, a + kSide + 1, 2);
  }
  return text;
}

TEST_F(LodsCommand, AttributesAreCarriedOver) {
  folder_.write("s.obj", sheet(false));
  mesher_json({"lods", "s.obj", "-o", "o.obj", "--ratios", "1,0.5"});
  const Model coarse = io::read_model(folder_ / "o_lod1.obj");
  ASSERT_EQ(coarse.mesh.face_count(), 36U);
  const CornerAttributes corners = test::corners_of(coarse);
  ASSERT_EQ(corners.texcoord.size(), 108U);
  EXPECT_EQ(corners.normal.size(), 108U);
  for (std::uint32_t h = 0; h < 108; ++h) {  // they were equal to x and y
    const glm::vec3& p = coarse.mesh.position(coarse.mesh.origin(Halfedge(h)));
    EXPECT_NEAR(corners.texcoord[h].x, p.x, 0.1F);
    EXPECT_NEAR(corners.texcoord[h].y, p.y, 0.1F);
  }
  const Model input = io::read_model(folder_ / "s.obj");
  const Model fine = io::read_model(folder_ / "o_lod0.obj");
  EXPECT_TRUE(test::corners_of(fine).texcoord == test::corners_of(input).texcoord);
}

TEST_F(LodsCommand, AttributesWithSeamsAreKept) {
  folder_.write("s.obj", sheet(true));
  const Finished run = mesher({"lods", "s.obj", "-o", "o.glb", "--ratios", "1,0.5", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto glb = document("o.glb");
  for (const std::size_t level : {0U, 1U}) {
    const auto& attributes = glb["meshes"][level]["primitives"][0]["attributes"];
    EXPECT_TRUE(attributes.contains("TEXCOORD_0")) << level;
    EXPECT_TRUE(attributes.contains("NORMAL")) << level;
  }
}

TEST_F(LodsCommand, UsesLevelsOfProgressiveMesh) {
  ASSERT_EQ(mesher({"progressive", "bunny", "-o", "p.pm", "--base-faces", "1000"}).exit_code, 0);
  const Finished run = mesher({"lods", "p.pm", "-o", "l.ply", "--ratios", "0.5,0.1", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["levels"][0]["faces"], 1836);
  EXPECT_EQ(json["levels"][1]["faces"], 1000);
  EXPECT_TRUE(holds(run.err, "asked for 367 faces: it is the base")) << run.err;
  EXPECT_EQ(json["pm"]["complete"], true);
  ASSERT_EQ(mesher({"extract", "p.pm", "-o", "e.ply", "--faces", "1837"}).exit_code, 0);
  EXPECT_TRUE(read_bytes(folder_ / "e.ply") == read_bytes(folder_ / "l_lod0.ply"));
}

TEST_F(LodsCommand, EveryLevelReportsItsError) {
  const Finished run = mesher({"lods", "bunny", "-o", "b.glb", "--ratios", "1,0.3,0.1", "--json"});
  const auto json = nlohmann::json::parse(run.out);
  const double pixels = json["screen"]["pixels_per_unit"];
  EXPECT_EQ(json["screen"]["height"], 1080.0);
  EXPECT_EQ(json["levels"][0]["error_rms"], 0.0);
  for (const std::size_t i : {1U, 2U}) {
    const auto& level = json["levels"][i];
    EXPECT_GT(level["error_rms"], json["levels"][i - 1]["error_rms"]);
    EXPECT_NEAR(level["error_pixels"].get<double>(), pixels * level["error_rms"].get<double>(),
                1e-9);
    EXPECT_TRUE(level["error_bound"].is_null());
  }
  EXPECT_TRUE(holds(run.err, "(RMS), ")) << run.err;
  const auto halved = mesher_json({"lods", "bunny", "-o", "b.glb", "--screen-height", "540"});
  EXPECT_NEAR(halved["screen"]["pixels_per_unit"].get<double>(), 0.5 * pixels, 1e-9);
}

TEST_F(LodsCommand, BoundsAreCertifiedOnRequest) {
  const auto json = mesher_json({"lods", "bunny", "-o", "b.ply", "--ratios", "1,0.2", "--bound"});
  const double max = mesher_json({"compare", "bunny", "b_lod1.ply"})["two_sided"]["max"];
  EXPECT_EQ(json["levels"][0]["error_bound"], 0.0);
  EXPECT_GE(json["levels"][1]["error_bound"].get<double>(), max);
  EXPECT_LE(json["levels"][1]["error_bound"].get<double>(), 1.2 * max);
  EXPECT_EQ(nlohmann::json::parse(read_bytes(folder_ / "b.json"))["levels"][1]["error_is"],
            "certified bound");
}

TEST_F(LodsCommand, ErrorsChooseLevels) {
  const auto json = mesher_json({"lods", "bunny", "-o", "b.ply", "--max-error", "0,0.5%,2%"});
  const auto& levels = json["levels"];
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[0]["faces"], 3674);
  EXPECT_TRUE(levels[0]["asked_faces"].is_null());
  const double diagonal = mesher_json({"info", "bunny"})["statistics"]["diagonal"];
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_LT(levels[i]["faces"], levels[i - 1]["faces"]);
    EXPECT_LE(levels[i]["error_bound"].get<double>(), (i == 1 ? 0.005 : 0.02) * diagonal);
  }
  // The same as `simplify` within that error.
  ASSERT_EQ(mesher({"simplify", "bunny", "-o", "s.ply", "--max-error", "2%"}).exit_code, 0);
  EXPECT_TRUE(read_bytes(folder_ / "s.ply") == read_bytes(folder_ / "b_lod2.ply"));
  EXPECT_EQ(levels[1]["coverage"], levels[2]["ratio"]);
}

TEST_F(LodsCommand, PixelsChooseLevelsByTheScreen) {
  const auto near = mesher_json({"lods", "bunny", "-o", "b.glb", "--pixels", "2,8"});
  const double per_unit = near["screen"]["pixels_per_unit"];
  EXPECT_LE(near["levels"][0]["error_pixels"].get<double>(), 2.0);
  EXPECT_LE(near["levels"][1]["error_bound"].get<double>() * per_unit, 8.0);
  const auto far = mesher_json(
      {"lods", "bunny", "-o", "b.glb", "--pixels", "2,8", "--distance", "60", "--fov", "40"});
  EXPECT_LT(far["levels"][0]["faces"], near["levels"][0]["faces"]);
}

TEST_F(LodsCommand, ManifestListsSeparateFiles) {
  for (const char* output : {"c.obj", "c.glb"}) {
    const auto json =
        mesher_json({"lods", "cactus", "-o", output, "--ratios", "1,0.6", "--separate"});
    EXPECT_EQ(json["manifest"], "c.json");
    const auto manifest = nlohmann::json::parse(read_bytes(folder_ / "c.json"));
    EXPECT_EQ(manifest["input"], "cactus.obj");
    EXPECT_EQ(manifest["screen"], json["screen"]);
    ASSERT_EQ(manifest["levels"].size(), 2U);
    const auto& coarse = manifest["levels"][1];
    EXPECT_EQ(coarse["level"], 1);
    EXPECT_EQ(coarse["file"], json["files"][1]);
    EXPECT_EQ(coarse["error_is"], "RMS");
    for (const auto& [mine, theirs] : {std::pair{"faces", "faces"},
                                       {"coverage", "coverage"},
                                       {"error", "error_rms"},
                                       {"pixels", "error_pixels"}})
      EXPECT_EQ(coarse[mine], json["levels"][1][theirs]) << mine;
    const auto file = mesher_json({"info", coarse["file"].get<std::string>()});
    EXPECT_EQ(file["statistics"]["faces"], coarse["faces"]);
  }
  EXPECT_TRUE(mesher_json({"lods", "cactus", "-o", "c.glb"})["manifest"].is_null());
}

TEST_F(LodsCommand, ReportsWhyTargetIsNotReached) {
  const Finished run = mesher({"lods", "cube", "-o", "c.stl", "--ratios", "1,0.1"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(holds(run.err, "asked for 1 face: no legal collapse is left")) << run.err;
}

TEST_F(LodsCommand, DefaultLevelsStopBeforeErrorLimit) {
  const Finished run = mesher({"lods", "cube", "-o", "c.stl", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["stop_reason"], "far_from_input");
  // Ten faces are 4.9 % away, eight 6.3 %.
  EXPECT_EQ(json["levels"][2]["faces"], 10);
  EXPECT_EQ(json["levels"][2]["far_from_input"], false);
  EXPECT_TRUE(holds(run.err,
                    "asked for 3 faces: fewer faces would be further than 5 % of the diagonal "
                    "from the input"))
      << run.err;
  EXPECT_FALSE(holds(run.err, "warning")) << run.err;
}

TEST_F(LodsCommand, RequestedLevelsBeyondErrorLimitGiveWarning) {
  const Finished run = mesher({"lods", "cactus", "-o", "c.ply", "--ratios", "1,0.5,0.1", "--json"});
  const auto levels = nlohmann::json::parse(run.out)["levels"];
  EXPECT_EQ(levels[2]["faces"], 26);
  EXPECT_EQ(levels[1]["far_from_input"], false);
  EXPECT_EQ(levels[2]["far_from_input"], true);
  EXPECT_TRUE(holds(run.err, "warning: level 2 is far from the input: ")) << run.err;
  EXPECT_FALSE(holds(run.err, "warning: level 1")) << run.err;
  // The same for a progressive mesh from a file.
  ASSERT_EQ(mesher({"progressive", "cactus", "-o", "p.pm", "--base-faces", "24"}).exit_code, 0);
  const Finished read = mesher({"lods", "p.pm", "-o", "c.ply", "--ratios", "1,0.1"});
  EXPECT_TRUE(holds(read.err, "warning: level 1 is far from the input: ")) << read.err;
}

TEST_F(LodsCommand, PruningUsesErrorOfEachLevel) {
  folder_.write("s.obj", obj_of(torus_with_specks(40, 0.02F)));
  const auto json =
      mesher_json({"lods", "s.obj", "-o", "l.ply", "--ratios", "1,0.5,0.04,0.03", "--prune"});
  const auto& levels = json["levels"];
  EXPECT_EQ(levels[0]["faces"], 5280);
  EXPECT_TRUE(levels[0]["pruned"].is_null());
  EXPECT_TRUE(levels[1]["pruned"].is_null());
  EXPECT_EQ(levels[2]["pruned"]["parts"], 40);
  EXPECT_EQ(levels[2]["faces"], 210);  // 0.04 of 5,280 is 211; a closed mesh has an even number
  EXPECT_EQ(levels[3]["pruned"]["faces"], 480);
  EXPECT_EQ(levels[3]["repeats_previous"], false);
  EXPECT_EQ(json["faces_before"], 5280);
  EXPECT_EQ(json["stop_reason"], "target_reached");
  EXPECT_EQ(mesher_json({"info", "l_lod2.ply"})["statistics"]["components"], 1);
  // If nothing is pruned, the levels equal those of plain simplification.
  ASSERT_EQ(mesher({"simplify", "s.obj", "-o", "d.ply", "--ratio", "0.5"}).exit_code, 0);
  EXPECT_TRUE(read_bytes(folder_ / "d.ply") == read_bytes(folder_ / "l_lod1.ply"));
  // Pruning starts from the full detail of a progressive mesh.
  ASSERT_EQ(mesher({"progressive", "s.obj", "-o", "s.pm"}).exit_code, 0);
  EXPECT_EQ(mesher_json({"lods", "s.pm", "-o", "p.ply", "--ratios", "0.04",
                         "--prune"})["levels"][0]["pruned"]["parts"],
            40);
}

TEST_F(LodsCommand, ReportsRepeatedLevels) {
  const Finished run =
      mesher({"lods", "bunny", "-o", "b.glb", "--ratios", "1,0.0001,0.00001", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.err, "the same mesh as level 1")) << run.err;
  EXPECT_FALSE(holds(run.err, "the same mesh as level 0")) << run.err;
  const auto levels = nlohmann::json::parse(run.out)["levels"];
  EXPECT_EQ(levels[0]["repeats_previous"], false);
  EXPECT_EQ(levels[1]["repeats_previous"], false);
  EXPECT_EQ(levels[2]["repeats_previous"], true);
}

TEST_F(LodsCommand, ErrorsLeaveNoFiles) {
  const std::vector<std::vector<std::string>> bad{
      {"lods", "cube"},
      {"lods", "cube", "-o", "x.unknown"},
      {"lods", "cube", "-o", "x.pm"},
      {"lods", "cube", "-o", "x.glb", "--ratios", "1,2"},
      {"lods", "cube", "-o", "x.glb", "--ratios", "0.5,1"},
      {"lods", "cube", "-o", "x.glb", "--ratios", "1,0"},
      {"lods", "cube", "-o", "x.glb", "--ratios", "nan"},
      {"lods", "cube", "-o", "x.glb", "--coverage", "0.5"},
      {"lods", "cube", "-o", "x.glb", "--coverage", "0.1,0.2,0.3"},
      {"lods", "cube", "-o", "x.glb", "--cost", "vanity"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "-1"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "1,1"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "1%,0.5%"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "1%,2"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "nan"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "1", "--prune"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "1", "--ratios", "1,0.5"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "1", "--pixels", "1"},
      {"lods", "cube", "-o", "x.glb", "--max-error", "1", "--coverage", "0.5,0.1"},
      {"lods", "cube", "-o", "x.glb", "--pixels", "2,1"},
      {"lods", "cube", "-o", "x.glb", "--pixels", "1%"},
      {"lods", "cube", "-o", "x.glb", "--pixels", "few"},
      {"lods", "cube", "-o", "x.glb", "--screen-height", "0"},
      {"lods", "cube", "-o", "x.glb", "--fov", "180"},
      {"lods", "cube", "-o", "x.glb", "--distance", "-1"}};
  for (const auto& arguments : bad) {
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 1) << arguments.back() << ": " << run.err;
  }
  EXPECT_EQ(mesher({"lods", "missing.obj", "-o", "x.glb"}).exit_code, 2);
  EXPECT_EQ(mesher({"lods", "missing.obj", "-o", "no/such/x.glb"}).exit_code, 4);
  EXPECT_EQ(folder_.count_files(), 0U);
  // If one file cannot be written, none is.
  std::filesystem::create_directory(folder_ / "x_lod1.obj");
  EXPECT_EQ(mesher({"lods", "cube", "-o", "x.obj"}).exit_code, 4);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x_lod0.obj"));
}

}  // namespace
}  // namespace mesher::test
