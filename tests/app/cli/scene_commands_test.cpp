// Tests the commands on glTF files that are written as glTF again.
#include "app/cli/scene_commands.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/io/gltf_scene.h"
#include "tests/app/program_test.h"
#include "tests/support/gltf_scene_file.h"

namespace mesher::test {
namespace {

using nlohmann::json;

class SceneCommands : public ProgramTest {
 protected:
  json document(const std::string& file) {
    return json::parse(read_bytes(folder_ / file), nullptr, false);
  }
  /// Writes a scene that shows the bunny twice, once twice as large, and a small cube of its own.
  void write_bunnies(const std::string& file) {
    ASSERT_EQ(mesher({"convert", "bunny", "-o", "b.gltf"}).exit_code, 0);
    json scene = document("b.gltf");
    scene["nodes"] = json::parse(R"([{"name":"big","mesh":0,"scale":[2,2,2]},
      {"name":"small","mesh":0,"translation":[9,0,0]}])");
    scene["scenes"][0]["nodes"] = {0, 1};
    scene["materials"] = json::parse(R"([{"name":"fur"}])");
    scene["meshes"][0]["primitives"][0]["material"] = 0;
    scene["extras"]["author"] = "somebody";
    folder_.write(file, scene.dump());
  }
};

TEST_F(SceneCommands, InfoListsAttributesAndImages) {
  json scene = json::parse(scene_file());
  scene["images"] = json::parse(R"([{"uri":"wood.png","name":"wood"}])");
  scene["textures"] = json::parse(R"([{"source":0}])");
  scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  folder_.write("in.gltf", scene.dump());
  folder_.write("wood.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\1\2\0\0\0\3", 24));
  const json info = mesher_json({"info", "in.gltf"});
  EXPECT_EQ(info["attributes"], json({"TEXCOORD_0: 2 x f32"}));
  ASSERT_EQ(info["images"].size(), 1U);
  EXPECT_EQ(info["images"][0]["type"], "image/png");
  EXPECT_EQ(info["images"][0]["width"], 258);
  EXPECT_EQ(info["images"][0]["height"], 3);
  const Finished text = mesher({"info", "in.gltf"});
  EXPECT_TRUE(holds(text.out, "wood.png: image/png, 258 x 3 pixels, 24 bytes")) << text.out;
}

TEST_F(SceneCommands, CompareMeasuresEachMesh) {
  GltfDocument file;
  file.floats(kSquareCorners, "VEC3", 3);
  file.indices(kSquareIndices);
  file.floats({0, 0, .5F, 1, 0, .5F, 1, 1, .5F, 0, 1, .5F}, "VEC3", 3);
  const auto scene = [&](int second, const char* name) {
    return file.text(R"("nodes":[{"mesh":0},{"mesh":1,"scale":[4,4,4]}],"meshes":[
      {"name":"same","primitives":[{"indices":1,"attributes":{"POSITION":0}}]},{"name":")" +
                     std::string(name) +
                     R"(","primitives":[{"indices":1,"attributes":{"POSITION":)" +
                     std::to_string(second) + "}}]}]");
  };
  folder_.write("a.gltf", scene(0, "moved"));
  folder_.write("b.gltf", scene(2, "moved"));
  const json report = mesher_json({"compare", "a.gltf", "b.gltf", "--samples", "100"});
  ASSERT_EQ(report["meshes"].size(), 2U);
  EXPECT_EQ(report["meshes"][0]["name"], "same");
  EXPECT_NEAR(report["meshes"][0]["two_sided"]["max"].get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(report["meshes"][1]["two_sided"]["max"].get<double>(), 0.5, 1e-12)
      << "in its own coordinates";
  EXPECT_NEAR(report["two_sided"]["max"].get<double>(), 2.0, 1e-12) << "as the scene shows it";
  const Finished text = mesher({"compare", "a.gltf", "b.gltf"});
  EXPECT_TRUE(holds(text.out, "mesh moved            rms 0.5")) << text.out;
  // A file with one mesh more: meshes are matched by name.
  json more = json::parse(scene(0, "moved"));
  more["meshes"].insert(more["meshes"].begin(), more["meshes"][0]);
  more["meshes"][0]["name"] = "new";
  folder_.write("c.gltf", more.dump());
  const json by_name = mesher_json({"compare", "a.gltf", "c.gltf", "--samples", "100"});
  EXPECT_EQ(by_name["meshes"].size(), 2U);
  EXPECT_EQ(by_name["meshes_of_one_file"], json({"new"}));
}

TEST_F(SceneCommands, ConvertCopies) {
  folder_.write("in.gltf", scene_file());
  const json report = mesher_json({"convert", "in.gltf", "-o", "out.gltf"});
  EXPECT_EQ(report["lost"], json::array());
  EXPECT_EQ(report["faces"], 8);  // the sheet is shown twice
  EXPECT_EQ(report["meshes"], 1);
  EXPECT_EQ(report["repairs"]["vertices_joined"], 0);
  const json in = document("in.gltf");
  const json out = document("out.gltf");
  for (const char* part : {"nodes", "meshes", "materials", "animations", "accessors", "extras"})
    EXPECT_EQ(out[part], in[part]) << part;
}

TEST_F(SceneCommands, ConvertRepairsOnRequest) {
  folder_.write("in.gltf", scene_file());
  const json report = mesher_json({"convert", "in.gltf", "-o", "out.glb", "--repair"});
  EXPECT_EQ(report["repairs"]["vertices_joined"], 2);
  EXPECT_EQ(mesher_json({"info", "out.glb"})["statistics"]["faces"], 8);
}

TEST_F(SceneCommands, ConvertKeepsFilesWithoutFaces) {
  folder_.write("in.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"name":"n"}]})");
  const json report = mesher_json({"convert", "in.gltf", "-o", "out.gltf"});
  EXPECT_EQ(report["faces"], 0);
  EXPECT_EQ(document("out.gltf"), document("in.gltf"));
  const Finished run = mesher({"simplify", "in.gltf", "-o", "x.gltf", "--ratio", "0.5"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(holds(run.err, "has no faces to simplify")) << run.err;
}

TEST_F(SceneCommands, SimplifyKeepsTheScene) {
  write_bunnies("in.gltf");
  const json report = mesher_json({"simplify", "in.gltf", "-o", "out.gltf", "--ratio", "0.25"});
  EXPECT_EQ(report["lost"], json::array());
  const json& mesh = report["meshes"][0];
  EXPECT_EQ(mesh["placements"], 2);
  EXPECT_EQ(mesh["faces_before"], 3674);
  EXPECT_NEAR(mesh["faces_reached"].get<double>(), 918, 2);
  EXPECT_EQ(report["faces_reached"], 2 * mesh["faces_reached"].get<int>());
  const json in = document("in.gltf");
  const json out = document("out.gltf");
  for (const char* part : {"nodes", "materials", "scenes", "extras"})
    EXPECT_EQ(out[part], in[part]) << part;
  EXPECT_EQ(mesher_json({"info", "out.gltf"})["statistics"]["faces"], report["faces_reached"]);
}

// A mesh counts as often as it is shown, and lengths are those of the scene.
TEST_F(SceneCommands, TargetsAreThoseOfTheScene) {
  write_bunnies("in.gltf");
  const json faces = mesher_json({"simplify", "in.gltf", "-o", "out.gltf", "--faces", "1000"});
  EXPECT_NEAR(faces["faces_reached"].get<double>(), 1000, 4);
  EXPECT_NEAR(faces["meshes"][0]["faces_reached"].get<double>(), 500, 2);
  const json bound =
      mesher_json({"simplify", "in.gltf", "-o", "out.gltf", "--max-error", "0.02", "--measure"});
  EXPECT_LE(bound["measured_error"].get<double>(), 0.02);
  EXPECT_GT(bound["measured_error"].get<double>(), 0.005);
  EXPECT_LE(bound["distance"]["two_sided"]["max"].get<double>(), 0.02);
}

TEST_F(SceneCommands, WhatNeedsNoEditStaysAsItIs) {
  write_bunnies("in.gltf");
  const json report = mesher_json({"simplify", "in.gltf", "-o", "out.gltf", "--ratio", "1"});
  EXPECT_EQ(report["stop_reason"], "already_there");
  EXPECT_EQ(document("out.gltf")["accessors"], document("in.gltf")["accessors"]);
}

TEST_F(SceneCommands, SubdivideKeepsTheScene) {
  folder_.write("in.gltf", scene_file());
  const json report =
      mesher_json({"subdivide", "in.gltf", "-o", "out.gltf", "--scheme", "midpoint"});
  EXPECT_EQ(report["after"]["faces"], 32);
  EXPECT_EQ(report["lost"], json::array());
  const json out = document("out.gltf");
  EXPECT_EQ(out["nodes"], document("in.gltf")["nodes"]);
  const auto& primitives = out["meshes"][0]["primitives"];
  EXPECT_TRUE(primitives[0]["attributes"].contains("TEXCOORD_0"));
  EXPECT_FALSE(primitives[1]["attributes"].contains("TEXCOORD_0"));
  EXPECT_EQ(out["accessors"][primitives[1]["indices"].get<std::size_t>()]["count"], 24);
}

TEST_F(SceneCommands, LodsKeepTheScene) {
  write_bunnies("in.gltf");
  const json report = mesher_json({"lods", "in.gltf", "-o", "out.gltf", "--ratios", "1,0.1"});
  ASSERT_EQ(report["levels"].size(), 2U);
  EXPECT_EQ(report["levels"][0]["faces"], 7348);
  EXPECT_NEAR(report["levels"][1]["faces"].get<double>(), 735, 5);
  const json in = document("in.gltf");
  const json out = document("out.gltf");
  EXPECT_EQ(out["materials"], in["materials"]);
  EXPECT_EQ(out["meshes"][0], in["meshes"][0]);
  ASSERT_EQ(out["meshes"].size(), 2U);
  for (const std::size_t node : {0U, 1U}) {
    const std::size_t level = out["nodes"][node]["extensions"]["MSFT_lod"]["ids"][0];
    EXPECT_EQ(out["nodes"][level]["mesh"], 1);
    for (const char* key : {"scale", "translation"})
      EXPECT_EQ(out["nodes"][level].value(key, json()), in["nodes"][node].value(key, json()));
  }
}

TEST_F(SceneCommands, LodsMayPruneEachLevel) {
  write_bunnies("in.gltf");
  const json report =
      mesher_json({"lods", "in.gltf", "-o", "out.gltf", "--ratios", "0.5,0.1", "--prune"});
  EXPECT_NEAR(report["levels"][1]["faces"].get<double>(), 735, 5);
}

TEST_F(SceneCommands, BudgetIsSharedByErrorInTheScene) {
  write_bunnies("in.gltf");
  json scene = document("in.gltf");
  scene["meshes"].push_back(scene["meshes"][0]);
  scene["meshes"][0]["name"] = "small";
  scene["meshes"][1]["name"] = "large";
  scene["nodes"] = json::parse(R"([{"mesh":0},{"mesh":1,"scale":[5,5,5]}])");
  folder_.write("in.gltf", scene.dump());
  const json shared = mesher_json({"simplify", "in.gltf", "-o", "s.gltf", "--ratio", "0.1"});
  EXPECT_EQ(shared["asked_faces"], 735);
  EXPECT_EQ(shared["stop_reason"], "target_reached");
  EXPECT_LE(shared["faces_reached"], 735);
  EXPECT_GE(shared["faces_reached"], 732);
  EXPECT_GT(shared["meshes"][1]["faces_reached"],
            4 * shared["meshes"][0]["faces_reached"].get<int>());
  const json even =
      mesher_json({"simplify", "in.gltf", "-o", "e.gltf", "--ratio", "0.1", "--per-mesh"});
  EXPECT_EQ(even["meshes"][0]["faces_reached"], even["meshes"][1]["faces_reached"]);
  EXPECT_LT(shared["estimated_error"].get<double>(), 0.8 * even["estimated_error"].get<double>());
  // The same for levels.
  const json lods = mesher_json({"lods", "in.gltf", "-o", "l.gltf", "--ratios", "0.5,0.1"});
  EXPECT_EQ(lods["levels"][1]["faces"], shared["faces_reached"]);
  EXPECT_NEAR(lods["levels"][1]["error_rms"].get<double>(), shared["estimated_error"].get<double>(),
              1e-9);
  const json per_mesh =
      mesher_json({"lods", "in.gltf", "-o", "l.gltf", "--ratios", "0.5,0.1", "--per-mesh"});
  EXPECT_GT(per_mesh["levels"][1]["error_rms"], lods["levels"][1]["error_rms"]);
}

TEST_F(SceneCommands, LooseCardsAreThinnedInsteadOfTheRest) {
  // A wavy sheet, and above it a hundred squares.
  std::string text;
  const auto square = [&](double x, double y, double z, double size, int first) {
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      text += fmt::format("v {} {} {}\n", x + size * u, y + size * v, z);
    text += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", first, first + 1, first + 2, first + 3);
  };
  for (int i = 0; i < 100; ++i)
    square(i % 10 * 0.9, i / 10 * 0.9, 5.0 + i * 37 % 100 * 0.03, 0.5, 4 * i + 1);
  constexpr int kSide = 40;
  for (int i = 0; i <= kSide; ++i) {
    for (int k = 0; k <= kSide; ++k)
      text += fmt::format("v {} {} {}\n", i * 0.25, k * 0.25,
                          0.3 * std::sin(i * 0.5) * std::cos(k * 0.4));
  }
  for (int i = 0; i < kSide; ++i) {
    for (int k = 0; k < kSide; ++k) {
      const int at = 401 + i * (kSide + 1) + k;
      text += fmt::format("f {} {} {} {}\n", at, at + kSide + 1, at + kSide + 2, at + 1);
    }
  }
  folder_.write("in.obj", text);
  ASSERT_EQ(mesher({"convert", "in.obj", "-o", "in.gltf"}).exit_code, 0);
  for (const char* file : {"in.obj", "in.gltf"}) {
    SCOPED_TRACE(file);
    const Finished run = mesher({"simplify", file, "-o", "out.gltf", "--faces", "120", "--json"});
    const json report = json::parse(run.out);
    EXPECT_EQ(report["loose_cards"]["count"], 100);
    EXPECT_GT(report["loose_cards"]["removed"], 20);
    EXPECT_LT(report["loose_cards"]["removed"], 100);
    EXPECT_TRUE(holds(run.err, " of 100 loose cards removed, the others enlarged by ")) << run.err;
    EXPECT_LE(report["faces_reached"], 120);
    const json kept =
        mesher_json({"simplify", file, "-o", "out.gltf", "--faces", "120", "--keep-cards"});
    EXPECT_TRUE(kept.value("loose_cards", json()).is_null());
    const json levels = mesher_json({"lods", file, "-o", "out.glb", "--ratios", "1,0.05"});
    EXPECT_TRUE(levels["levels"][0]["loose_cards"].is_null());
    EXPECT_GT(levels["levels"][1]["loose_cards"]["removed"], 10);
  }
  // Never in a progressive mesh.
  EXPECT_EQ(mesher_json({"progressive", "in.obj", "-o", "p.pm"})["faces_before"], 3400);
  EXPECT_EQ(mesher_json({"info", "p.pm"})["statistics"]["components"], 101);
}

TEST_F(SceneCommands, SaysWhatACollapseOfManyInstancesRemoves) {
  write_bunnies("in.gltf");
  json scene = document("in.gltf");
  scene["nodes"] = json::array();
  scene["scenes"][0]["nodes"] = json::array();
  for (int i = 0; i < 50; ++i) {
    scene["nodes"].push_back({{"mesh", 0}, {"translation", {10 * i, 0, 0}}});
    scene["scenes"][0]["nodes"].push_back(i);
  }
  folder_.write("in.gltf", scene.dump());
  const Finished run = mesher({"simplify", "in.gltf", "-o", "out.gltf", "--faces", "10099"});
  EXPECT_TRUE(holds(run.err, "asked for 10,099 faces, reached 10,000 of 183,700")) << run.err;
  EXPECT_TRUE(holds(run.err, "a collapse in a mesh that is shown 50 times removes up to 100 faces"))
      << run.err;
}

TEST_F(SceneCommands, LodsMayBeSeparateScenes) {
  write_bunnies("bunnies.gltf");
  const json report = mesher_json(
      {"lods", "bunnies.gltf", "-o", "out.glb", "--max-error", "0,0.05,0.2", "--separate"});
  EXPECT_EQ(report["files"], json({"out_lod0.glb", "out_lod1.glb", "out_lod2.glb"}));
  const json manifest = document("out.json");
  ASSERT_EQ(manifest["levels"].size(), 3U);
  for (const std::size_t i : {1U, 2U}) {
    const json& level = manifest["levels"][i];
    EXPECT_EQ(level["error_is"], "certified bound");
    EXPECT_LE(level["error"].get<double>(), i == 1 ? 0.05 : 0.2);
    const json info = mesher_json({"info", level["file"].get<std::string>()});
    EXPECT_EQ(info["statistics"]["faces"], level["faces"]);
    EXPECT_EQ(info["contents"]["nodes"]["names"], json({"big", "small"}));
    const json distance =
        mesher_json({"compare", "bunnies.gltf", level["file"].get<std::string>()})["two_sided"];
    EXPECT_LE(distance["max"].get<double>(), level["error"].get<double>());
  }
}

TEST_F(SceneCommands, CompressedFilesAreSmallerAndTheSame) {
  write_bunnies("in.gltf");
  const json report = mesher_json({"convert", "in.gltf", "-o", "small.glb", "--compress"});
  EXPECT_EQ(report["lost"], json::array());
  ASSERT_EQ(mesher({"convert", "in.gltf", "-o", "plain.glb"}).exit_code, 0);
  EXPECT_LT(5 * read_bytes(folder_ / "small.glb").size(),
            3 * read_bytes(folder_ / "plain.glb").size());
  const json distance = mesher_json({"compare", "in.gltf", "small.glb"})["two_sided"];
  EXPECT_LT(distance["max_percent"].get<double>(), 0.005);
  const Finished refused = mesher({"convert", "in.gltf", "-o", "x.obj", "--compress"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_TRUE(holds(refused.err, "--compress: only .gltf and .glb can be compressed, not 'x.obj'"))
      << refused.err;
}

TEST_F(SceneCommands, EveryCommandCompressesModelsOfOtherFormats) {
  ASSERT_EQ(mesher({"progressive", "bunny", "-o", "b.pm"}).exit_code, 0);
  const std::vector<std::vector<std::string>> commands = {
      {"convert", "bunny"}, {"simplify", "bunny", "--ratio", "0.5"}, {"subdivide", "bunny"},
      {"lods", "bunny"},    {"extract", "b.pm", "--lod", "1"},
  };
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command[0]);
    command.insert(command.end(), {"-o", "plain.glb"});
    ASSERT_EQ(mesher(command).exit_code, 0);
    command.back() = "small.glb";
    command.emplace_back("--compress");
    EXPECT_EQ(mesher_json(command)["lost"], json::array());
    EXPECT_LT(5 * read_bytes(folder_ / "small.glb").size(),
              3 * read_bytes(folder_ / "plain.glb").size());
    const json distance = mesher_json({"compare", "plain.glb", "small.glb"})["two_sided"];
    EXPECT_LT(distance["max_percent"].get<double>(), 0.005);
  }
}

TEST_F(SceneCommands, SubdivideNamesTangents) {
  GltfDocument file;
  file.floats(kSquareCorners, "VEC3", 3);
  file.indices(kSquareIndices);
  file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  file.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
  folder_.write("in.gltf", file.text(R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2,"TANGENT":3},"indices":1}]}])"));
  for (const char* out : {"out.glb", "out.ply"}) {
    SCOPED_TRACE(out);
    const json report = mesher_json({"subdivide", "in.gltf", "-o", out});
    EXPECT_TRUE(report["lost"].dump().find("tangents") != std::string::npos) << report["lost"];
    EXPECT_FALSE(report.contains("dropped"));
  }
}

// The same bytes, whatever the number of threads.
TEST_F(SceneCommands, OutputIsIndependentOfThreadCount) {
  write_bunnies("in.gltf");
  for (const char* threads : {"1", "2", "7"}) {
    const std::string out = std::string("out") + threads + ".glb";
    ASSERT_EQ(mesher({"simplify", "in.gltf", "-o", out, "--ratio", "0.1", "--threads", threads})
                  .exit_code,
              0);
    EXPECT_EQ(read_bytes(folder_ / out), read_bytes(folder_ / "out1.glb")) << threads;
  }
}

}  // namespace
}  // namespace mesher::test
