// Tests the whole program from the command line: output, files and exit codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "engine/io/png.h"
#include "tests/app/program_test.h"
#include "tests/support/meshes.h"
#include "tests/support/obj_files.h"

namespace mesher::test {
namespace {

constexpr const char* kAssets = MESHER_SOURCE_DIR "/assets/";

class CommandLine : public ProgramTest {};

TEST_F(CommandLine, InfoPrintsBunnyStatistics) {
  const Finished run = mesher({"info", "bunny", "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["statistics"]["faces"], 3674);
  EXPECT_EQ(json["statistics"]["euler_characteristic"], 2);
  EXPECT_EQ(json["repairs"]["faces_flipped"], 0);
  const Finished words = mesher({"info", "open_box.obj"});
  EXPECT_NE(words.out.find("boundary loops        1"), std::string::npos) << words.out;
}

TEST_F(CommandLine, RenderWritesPictureOfRequestedSize) {
  const Finished run =
      mesher({"render", "cube.obj", "-o", "cube.png", "--size", "120x80", "--wireframe",
              "--shading", "gouraud", "--camera", "-30,20,1.2", "--validation", "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["wireframe"], true);
  const Image image = io::read_png(folder_ / "cube.png");
  EXPECT_EQ(image.width, 120U);
  EXPECT_EQ(image.height, 80U);
  EXPECT_NE(std::memcmp(image.pixel(60, 40), image.pixel(0, 0), 4), 0);  // something is there
}

TEST_F(CommandLine, NamesTheCommandThatWritesProgressiveMeshes) {
  const std::vector<std::string> commands[] = {
      {"convert", "cube.obj", "-o", "c.pm"},
      {"simplify", "cube.obj", "-o", "c.pm", "--faces", "6"},
      {"subdivide", "cube.obj", "-o", "c.pm"},
      {"edit", "cube.obj", "-o", "c.pm", "--do", "subdivide"},
  };
  for (const auto& command : commands) {
    const Finished run = mesher(command);
    EXPECT_EQ(run.exit_code, 1) << command[0];
    EXPECT_TRUE(holds(run.err, "`mesher progressive MODEL c.pm`")) << run.err;
  }
}

TEST_F(CommandLine, ScreenshotShowsOneModel) {
  const Finished run = mesher({"cube.obj", "knot.obj", "--screenshot", "c.png"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(holds(run.err, "shows one model, and not also 'knot.obj'")) << run.err;
  const Finished missing = mesher({"cube.obj", "knott.obj"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(holds(missing.err, "knott.obj: does not exist")) << missing.err;
}

TEST_F(CommandLine, TagCreasesOptionMarksCreases) {
  const Finished run =
      mesher({"convert", "cube.obj", "creased.obj", "--tag-creases", "45", "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["statistics"]["crease_edges"], 12);
  const Finished info = mesher({"info", (folder_ / "creased.obj").string(), "--json"});
  EXPECT_EQ(nlohmann::json::parse(info.out)["statistics"]["crease_edges"], 12);
  EXPECT_EQ(mesher({"info", "cube", "--tag-creases", "200"}).exit_code, 1);
}

TEST_F(CommandLine, KeysEditCreasesWithoutWindow) {
  const Finished run = mesher({"view", "cube", "--keys", "c shift+c ctrl+a - -", "--size", "100",
                               "--screenshot", "cube.png", "--validation", "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto state = nlohmann::json::parse(run.out);
  EXPECT_EQ(state["crease_edges"], 12);
  EXPECT_EQ(state["creases"]["mode"], true);
  EXPECT_EQ(state["creases"]["selected"], 12);
  EXPECT_EQ(state["creases"]["sharpness"], 9.0);
  EXPECT_EQ(state["undo_depth"], 3);
}

TEST_F(CommandLine, MissingDisplayWritesPictureAndMessage) {
  const Finished run =
      mesher({"-input", "bunny.obj", "-size", "200", "-gouraud", "-wireframe", "--validation"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("no display"), std::string::npos) << run.err;
  EXPECT_EQ(io::read_png(folder_ / "bunny.png").width, 200U);
}

TEST_F(CommandLine, MissingDisplayOverwritesNoFile) {
  folder_.write("cube.png", "somebody's texture");
  const Finished run = mesher({"cube", "--size", "50"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read_bytes(folder_ / "cube.png"), "somebody's texture");
  EXPECT_EQ(io::read_png(folder_ / "cube-2.png").width, 50U);
}

TEST_F(CommandLine, MissingDisplayAndVulkanPrintOneError) {
  const Finished run =
      mesher({"cube"}, {"VK_ICD_FILENAMES=/nonexistent.json", "VK_DRIVER_FILES=/nonexistent.json",
                        // GLFW and Mesa print a line of their own where it is not set.
                        "XDG_RUNTIME_DIR=" + folder_.path().string()});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(CommandLine, DeviceIsSelectedByNumberOrName) {
  EXPECT_EQ(mesher({"render", "cube", "-o", "a.png", "--size", "50", "--device", "0"}).exit_code,
            0);
  EXPECT_EQ(mesher({"render", "cube", "-o", "b.png", "--size", "50", "--device", "99"}).exit_code,
            3);
}

TEST_F(CommandLine, NonUtf8FileNamesAreAccepted) {
  const std::string odd = "b\xff.obj";
  folder_.write(odd, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Finished run = mesher({"info", odd, "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["statistics"]["faces"], 1);
}

TEST_F(CommandLine, KeysAndScreenshotRunWithoutWindow) {
  const Finished run = mesher({"view", "cube", "--size", "100", "--keys", "w g 3 5 f",
                               "--screenshot", "out.png", "--json", "--validation"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["wireframe"], true);
  EXPECT_EQ(json["shading"], "gouraud");
  EXPECT_EQ(json["camera"]["orthographic"], true);
  EXPECT_EQ(io::read_png(folder_ / "out.png").height, 100U);
  // The same state, set by options, gives the same picture.
  EXPECT_EQ(mesher({"render", "cube", "-o", "words.png", "--size", "100", "--wireframe",
                    "--gouraud", "--view", "right", "--orthographic"})
                .exit_code,
            0);
  EXPECT_TRUE(io::read_png(folder_ / "out.png").rgba == io::read_png(folder_ / "words.png").rgba);
}

TEST_F(CommandLine, ConvertPreservesPositionsExactly) {
  ASSERT_EQ(mesher({"convert", "bunny", "a.ply"}).exit_code, 0);
  ASSERT_EQ(mesher({"convert", "a.ply", "b.off"}).exit_code, 0);
  ASSERT_EQ(mesher({"convert", "b.off", "c.obj"}).exit_code, 0);
  ASSERT_EQ(mesher({"convert", "bunny", "direct.obj"}).exit_code, 0);
  EXPECT_EQ(read_bytes(folder_ / "c.obj"), read_bytes(folder_ / "direct.obj"));
}

TEST_F(CommandLine, ConvertReportsWhatFormatCannotHold) {
  const Finished run = mesher({"convert", "creased_cube", "c.ply", "--json"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(run.out)["lost"], nlohmann::json::array({"5 creases"}));
  EXPECT_NE(run.err.find("c.ply does not hold 5 creases"), std::string::npos) << run.err;
  EXPECT_TRUE(
      nlohmann::json::parse(mesher({"convert", "creased_cube", "c.obj", "--json"}).out)["lost"]
          .empty());
}

TEST_F(CommandLine, SimplifyReachesItsTargetAndReports) {
  const Finished run = mesher({"simplify", "knot", "-o", "k.obj", "--faces", "2000", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["output"], "k.obj");
  EXPECT_EQ(json["asked_faces"], 2000);
  EXPECT_EQ(json["faces_before"], 2880);
  EXPECT_EQ(json["faces_reached"], 2000);
  EXPECT_EQ(json["vertices_reached"], 1000);
  EXPECT_EQ(json["stop_reason"], "target_reached");
  EXPECT_EQ(json["collapses"], 440);
  EXPECT_TRUE(json["measured_error"].is_null());
  EXPECT_TRUE(json["distance"].is_null());
  EXPECT_TRUE(json["self_intersections_before"].is_null());
  for (const char* phase : {"prepare", "collapse", "finish", "measure", "total"})
    EXPECT_GE(json["seconds"][phase], 0.0);
  EXPECT_TRUE(json["rejected"].contains("fold_over"));
  EXPECT_FALSE(json.contains("dropped"));
  EXPECT_TRUE(json["lost"].empty());
  EXPECT_EQ(json["repairs"]["faces_flipped"], 0);
  EXPECT_NE(run.err.find("asked for 2,000 faces, reached 2,000 of 2,880"), std::string::npos)
      << run.err;
  const auto info = nlohmann::json::parse(mesher({"info", "k.obj", "--json"}).out);
  EXPECT_EQ(info["statistics"]["faces"], 2000);
  EXPECT_EQ(info["statistics"]["euler_characteristic"], 0);
}

TEST_F(CommandLine, SimplifyPrunesPartsSmallerThanTheError) {
  folder_.write("s.obj", obj_of(torus_with_specks(40, 0.02F)));
  const Finished run = mesher({"simplify", "s.obj", "-o", "o.obj", "--faces", "200", "--prune",
                               "--bound", "--measure", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["faces_reached"], 200);
  EXPECT_EQ(json["pruned"]["parts"], 40);
  EXPECT_EQ(json["pruned"]["faces"], 480);
  EXPECT_LT(json["pruned"]["largest"], json["pruned"]["unpruned_error"]);
  EXPECT_LT(json["estimated_error"], json["pruned"]["unpruned_error"]);
  EXPECT_GE(json["certified_bound"], json["distance"]["two_sided"]["max"]);
  EXPECT_NE(run.err.find("pruned 40 parts (480 faces), the largest "), std::string::npos)
      << run.err;
  EXPECT_EQ(mesher_json({"info", "o.obj"})["statistics"]["components"], 1);

  const Finished fine =
      mesher({"simplify", "s.obj", "-o", "o.obj", "--faces", "5000", "--prune", "--json"});
  EXPECT_TRUE(nlohmann::json::parse(fine.out)["pruned"].is_null());
  EXPECT_NE(fine.err.find("pruned nothing"), std::string::npos) << fine.err;
  const Finished plain = mesher({"simplify", "s.obj", "-o", "o.obj", "--faces", "200", "--json"});
  EXPECT_TRUE(nlohmann::json::parse(plain.out)["pruned"].is_null()) << "off by default";
  EXPECT_EQ(plain.err.find("pruned"), std::string::npos) << plain.err;

  const Finished refused =
      mesher({"simplify", "s.obj", "-o", "x.obj", "--prune", "--max-error", "1%"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("--prune: cannot be combined with --max-error"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "x.obj"));
}

TEST_F(CommandLine, SimplifyReachesRatioOrLastLegalCollapse) {
  const Finished half =
      mesher({"simplify", "knot", "half.ply", "--ratio", "0.5", "--json", "--quiet", "--measure",
              "--cost", "qem", "--placement", "midpoint", "--boundary", "lock"});
  ASSERT_EQ(half.exit_code, 0) << half.err;
  EXPECT_TRUE(half.err.empty());
  const auto json = nlohmann::json::parse(half.out);
  EXPECT_EQ(json["asked_faces"], 1440);
  EXPECT_GT(json["distance"]["two_sided"]["rms"], 0.0);
  EXPECT_EQ(json["self_intersections_before"], 0);
  EXPECT_EQ(json["self_intersections_after"], 0);
  const Finished cube = mesher({"simplify", "cube", "-o", "c.stl", "--faces", "2"});
  EXPECT_EQ(cube.exit_code, 0);
  EXPECT_NE(cube.err.find("no legal collapse is left"), std::string::npos) << cube.err;
}

TEST_F(CommandLine, SimplifyAvoidsIntersectionsOnRequest) {
  const Finished run = mesher({"simplify", "knot", "-o", "k.obj", "--faces", "4",
                               "--no-intersections", "--measure", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["stop_reason"], "no_legal_collapse");
  EXPECT_EQ(json["self_intersections_after"], 0);
  EXPECT_GT(json["rejected"]["intersection"], 0);
  EXPECT_NE(run.err.find("by self-intersection"), std::string::npos) << run.err;
}

TEST_F(CommandLine, SimplifySaysThatSeamsWereCrossed) {
  // A bumpy sheet with different texture coordinates for each face: every edge is a seam.
  std::string text = "vt 0 0\nvt 1 1\n";
  constexpr int kSide = 4;
  for (int i = 0; i < (kSide + 1) * (kSide + 1); ++i) {
    text += "v " + std::to_string(i % (kSide + 1)) + ' ' + std::to_string(i / (kSide + 1)) + ' ' +
            std::to_string(0.1 * (i % 3)) + '\n';
  }
  const auto face = [&](int a, int b, int c, const char* vt) {
    for (const int v : {a, b, c})
      text += (v == a ? "f " : " ") + std::to_string(v + 1) + vt;
    text += '\n';
  };
  for (int i = 0; i < kSide * kSide; ++i) {
    const int a = i / kSide * (kSide + 1) + i % kSide;
    face(a, a + 1, a + kSide + 2, "/1");
    face(a, a + kSide + 2, a + kSide + 1, "/2");
  }
  folder_.write("t.obj", text);
  const Finished run = mesher({"simplify", "t.obj", "-o", "o.obj", "--faces", "28", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["faces_reached"], 28);
  EXPECT_EQ(json["crosses_seams"], true);
  EXPECT_NE(run.err.find("seams of the attributes were crossed"), std::string::npos) << run.err;
  EXPECT_NE(test::read_bytes(folder_ / "o.obj").find("\nvt "), std::string::npos);
  const Finished all = mesher({"simplify", "t.obj", "-o", "o.obj", "--faces", "32", "--json"});
  EXPECT_EQ(nlohmann::json::parse(all.out)["crosses_seams"], false) << all.out;
}

TEST_F(CommandLine, RenderSimplifiesOnRequest) {
  const Finished run =
      mesher({"render", "knot", "-o", "k.png", "--size", "60", "--faces", "2000", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["faces"], 2000);
}

TEST_F(CommandLine, CompareMeasuresBothDirections) {
  const Finished run = mesher({"compare", "cube", "open_box", "--json", "--samples", "20000"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_GT(json["forward"]["max"], 0.4);  // the lid, from its middle to the rim
  EXPECT_LT(json["backward"]["max"], 1e-6);
  EXPECT_EQ(json["two_sided"]["max"], json["forward"]["max"]);
  const Finished words = mesher({"compare", "cube", "cube"});
  EXPECT_NE(words.out.find("two-sided"), std::string::npos);
  EXPECT_EQ(mesher({"compare", "cube"}).exit_code, 1);
}

TEST_F(CommandLine, ConvertRejectsMeshWithoutFaces) {
  folder_.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  for (const char* output : {"o.obj", "o.ply", "o.stl", "o.off", "o.glb"}) {
    EXPECT_EQ(mesher({"convert", "points.obj", output}).exit_code, 2);
  }
  EXPECT_EQ(mesher({"simplify", "points.obj", "o.obj", "--faces", "1"}).exit_code, 2);
  EXPECT_EQ(folder_.count_files(), 1U);
}

// An empty picture is a failure.
TEST_F(CommandLine, RenderRefusesModelsWithoutFaces) {
  folder_.write("points.ply",
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                "property float z\nend_header\n0 0 0\n1 0 0\n");
  folder_.write("points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n");
  for (const char* model : {"points.ply", "points.obj"}) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                                 {"--keep-isolated"},
                                                 {"--lod", "0.5"},
                                                 {"--faces", "3"},
                                                 {"--turntable", "--frames", "2"}}) {
      const bool is_turntable = !more.empty() && more[0] == "--turntable";
      std::vector<std::string> arguments{"render", model, "-o", is_turntable ? "p.webp" : "p.png",
                                         "--size", "20"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Finished run = mesher(arguments);
      EXPECT_EQ(run.exit_code, 2) << run.err;
      EXPECT_NE(run.err.find("has no faces to draw"), std::string::npos) << run.err;
    }
  }
  EXPECT_EQ(folder_.count_files(), 2U);
}

TEST_F(CommandLine, WeldOptionsJoinVertices) {
  folder_.write("loose.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1.001 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n");
  const auto joined = [&](std::vector<std::string> more, const char* kind) {
    more.insert(more.begin(), {"info", "loose.obj", "--json"});
    return nlohmann::json::parse(mesher(more).out)["repairs"][kind].get<int>();
  };
  EXPECT_EQ(joined({}, "vertices_joined"), 1);
  EXPECT_EQ(joined({}, "close_vertices_joined"), 0);
  EXPECT_EQ(joined({"--no-weld"}, "vertices_joined"), 0);
  EXPECT_EQ(joined({"--weld", "0.01"}, "vertices_joined"), 1);
  EXPECT_EQ(joined({"--weld", "0.01"}, "close_vertices_joined"), 1);
  EXPECT_EQ(mesher({"info", "loose.obj", "--weld", "0.01", "--no-weld"}).exit_code, 1);
  EXPECT_EQ(mesher({"info", "loose.obj", "--weld", "-1"}).exit_code, 1);
  EXPECT_EQ(mesher({"info", "loose.obj", "--weld", "nan"}).exit_code, 1);
}

// Every command that writes says what it does not keep of the file.
TEST_F(CommandLine, EveryCommandNamesWhatItDoesNotKeep) {
  folder_.write(
      "in.obj",
      "mtllib a.mtl\no Box\nusemtl brick\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
      "l 1 2\nf 1 2 3 4\nf 2 5 6 3\n");
  const std::vector<std::vector<std::string>> commands = {
      {"convert", "in.obj", "o.ply"},
      {"simplify", "in.obj", "-o", "o.ply", "--faces", "2"},
      {"subdivide", "in.obj", "-o", "o.ply"},
      {"edit", "in.obj", "-o", "o.ply", "--do", "subdivide"},
      {"lods", "in.obj", "-o", "o.ply", "--ratios", "1,0.5"}};
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command[0]);
    command.emplace_back("--json");
    const Finished run = mesher(command);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto lost = nlohmann::json::parse(run.out)["lost"].get<std::vector<std::string>>();
    for (const char* loss :
         {"1 line", "1 object: Box", "1 material: brick", "1 material file: a.mtl"})
      EXPECT_EQ(std::count(lost.begin(), lost.end(), loss), 1) << loss;
  }
  // OBJ keeps the rest, and every command hands it on.
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command[0]);
    std::ranges::replace(command, "o.ply", "o.obj");
    command.emplace_back("--json");
    EXPECT_EQ(nlohmann::json::parse(mesher(command).out)["lost"],
              nlohmann::json::array({"1 line"}));
    const std::string text =
        test::read_bytes(folder_ / (command[0] == "lods" ? "o_lod1.obj" : "o.obj"));
    EXPECT_NE(text.find("mtllib a.mtl\n"), std::string::npos);
    EXPECT_NE(text.find("o Box\nusemtl brick\n"), std::string::npos);
  }
  const Finished pm = mesher({"progressive", "in.obj", "-o", "o.pm"});
  EXPECT_NE(pm.err.find("o.pm does not hold 1 line"), std::string::npos) << pm.err;
  EXPECT_NE(pm.err.find("o.pm does not hold 1 material file: a.mtl"), std::string::npos) << pm.err;
  // A .pm file keeps objects and materials.
  const auto kept = nlohmann::json::parse(mesher({"info", "o.pm", "--json"}).out)["contents"];
  EXPECT_EQ(kept["materials"]["names"], nlohmann::json::array({"brick"}));
  EXPECT_EQ(kept["objects"]["names"], nlohmann::json::array({"Box"}));
  const Finished info = mesher({"info", "in.obj"});
  EXPECT_NE(info.out.find("1 material: brick"), std::string::npos) << info.out;
  EXPECT_EQ(nlohmann::json::parse(
                mesher({"info", "in.obj", "--json"}).out)["contents"]["materials"]["names"],
            nlohmann::json::array({"brick"}));
}

TEST_F(CommandLine, ModelsFarFromZeroKeepTheirDigits) {
  folder_.write(
      "far.obj",
      "v 6000000.125 2000000 120.0625\nv 6000008.3333 2000000 121.1955\nv 6000000 2000009.75 "
      "122.3642\nf 1 2 3\n");
  folder_.write("near.obj",
                "v 0.125 0 120.0625\nv 8.3333 0 121.1955\nv 0 9.75 122.3642\nf 1 2 3\n");
  ASSERT_EQ(mesher({"convert", "far.obj", "o.glb"}).exit_code, 0);
  const auto compared =
      nlohmann::json::parse(mesher({"compare", "far.obj", "o.glb", "--json"}).out);
  EXPECT_LT(compared["two_sided"]["max"].get<double>(), 1e-6);
  const auto apart =
      nlohmann::json::parse(mesher({"compare", "near.obj", "far.obj", "--json"}).out);
  EXPECT_NEAR(apart["two_sided"]["max"].get<double>(), 6324555.3, 20.0);
  const auto info = nlohmann::json::parse(mesher({"info", "far.obj", "--json"}).out);
  EXPECT_NEAR(info["statistics"]["box"]["min"][0].get<double>(), 6000000.0, 1e-6);
  EXPECT_NEAR(info["statistics"]["box"]["max"][2].get<double>(), 122.3642, 1e-5);
  const auto stl = nlohmann::json::parse(mesher({"convert", "far.obj", "o.stl", "--json"}).out);
  EXPECT_EQ(stl["lost"].size(), 1U);
  // The picture is that of the same model near zero.
  ASSERT_EQ(mesher({"render", "far.obj", "-o", "far.png", "--size", "60"}).exit_code, 0);
  ASSERT_EQ(mesher({"render", "near.obj", "-o", "near.png", "--size", "60"}).exit_code, 0);
  const Image far = io::read_png(folder_ / "far.png");
  const Image near = io::read_png(folder_ / "near.png");
  std::size_t different = 0;
  for (std::size_t i = 0; i < far.rgba.size(); ++i)
    different += std::abs(int(far.rgba[i]) - int(near.rgba[i])) > 8 ? 1 : 0;
  EXPECT_LT(different, far.rgba.size() / 100);
}

TEST_F(CommandLine, FileSizeLimitExitsWithFourAndLeavesNoFile) {
  const Finished run =
      run_program({"sh", "-c",
                   "cd '" + folder_.path().string() +
                       "' && ulimit -f 0 && exec " MESHER_PROGRAM " convert bunny z.obj"});
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(CommandLine, OutputIsIndependentOfThreadCount) {
  // Large enough to be read, built and written in many chunks; quads, so that it is triangulated.
  std::string text;
  constexpr int kSide = 300;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      text += "v " + std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(x * y % 7) +
              '\n';
    }
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int a = y * (kSide + 1) + x + 1;
      text += "f " + std::to_string(a) + ' ' + std::to_string(a + 1) + ' ' +
              std::to_string(a + kSide + 2) + ' ' + std::to_string(a + kSide + 1) + '\n';
    }
  }
  ASSERT_GT(text.size(), 3'000'000U);
  folder_.write("big.obj", text);
  ASSERT_EQ(mesher({"convert", "big.obj", "one.obj", "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(mesher({"convert", "big.obj", "two.obj", "--threads", "2"}).exit_code, 0);
  EXPECT_TRUE(read_bytes(folder_ / "one.obj") == read_bytes(folder_ / "two.obj"));
}

TEST_F(CommandLine, UsageErrorsExitWithOne) {
  const std::vector<std::vector<std::string>> bad{
      {"render", "cube"},
      {"render", "cube", "-o", "x.png", "--size", "huge"},
      {"render", "cube", "-o", "x.png", "--camera", "1"},
      {"info"},
      {"simplfy"},
      {"info", "cube", "--no-such-option"},
      {"view", "cube", "--screenshot", "x.png", "--keys", "f9"},
      {"render", "cube", "-o", "x.jpg"},
      {"render", "cube", "-o", "x.png", "--crease-angle", "nan"},
      {"convert", "cube", "x.unknown"},
      {"simplify", "cube", "-o", "x.obj"},
      {"simplify", "cube", "--faces", "6"},
      {"simplify", "cube", "-o", "x.obj", "--faces", "0"},
      {"simplify", "cube", "-o", "x.obj", "--faces", "-3"},
      {"simplify", "cube", "-o", "x.obj", "--faces", "6", "--ratio", "0.5"},
      {"simplify", "cube", "-o", "x.obj", "--ratio", "0"},
      {"simplify", "cube", "-o", "x.obj", "--ratio", "1.5"},
      {"simplify", "cube", "-o", "x.obj", "--ratio", "nan"},
      {"simplify", "cube", "-o", "x.obj", "--max-error", "lots"},
      {"simplify", "cube", "-o", "x.obj", "--max-error", "-1%"},
      {"simplify", "cube", "-o", "x.obj", "--faces", "6", "--cost", "vanity"},
      {"simplify", "cube", "-o", "x.obj", "--faces", "6", "--placement", "left"},
      {"simplify", "cube", "-o", "x.obj", "--faces", "6", "--crease-angle", "nan"},
      {"simplify", "cube", "-o", "x.unknown", "--faces", "6"},
      {"render", "cube", "-o", "x.png", "--faces", "0"}};
  for (const auto& arguments : bad) {
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 1) << arguments[0] << " " << arguments.back() << ": " << run.err;
    EXPECT_FALSE(run.err.empty());
  }
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(CommandLine, MistypedNamesGetASuggestion) {
  const std::pair<std::vector<std::string>, const char*> mistyped[] = {
      {{"cube", "-gourad"}, "mesher: -gourad: did you mean -gouraud?"},
      {{"-inptu", "cube"}, "mesher: -inptu: did you mean -input?"},
      {{"simplify", "cube", "-o", "x.ply", "--face", "6"}, "--face: did you mean --faces?"},
      {{"simplfy"}, "did you mean simplify?"},
  };
  for (const auto& [arguments, hint] : mistyped) {
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find(hint), std::string::npos) << run.err;
  }
  EXPECT_EQ(mesher({"nothing-like-a-command"}).err.find("did you mean"), std::string::npos);
}

TEST_F(CommandLine, BadInputPrintsFileLineAndReason) {
  folder_.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"info", "bad.obj"}, {"convert", "bad.obj", "out.ply"}, {"-input", "bad.obj"}}) {
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find("bad.obj:4: "), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_EQ(mesher({"info", "missing.obj"}).exit_code, 2);
  EXPECT_EQ(folder_.count_files(), 1U);
}

TEST_F(CommandLine, FullStdoutExitsWithFour) {
  for (const char* form : {"", " --json"}) {
    const Finished run = run_program(
        {"sh", "-c", std::string(MESHER_PROGRAM) + " info cube" + form + " >/dev/full"});
    EXPECT_EQ(run.exit_code, 4) << run.err;
  }
}

TEST_F(CommandLine, UnwritableOutputExitsWithFour) {
  EXPECT_EQ(mesher({"convert", "cube", "no/such/folder/x.obj"}).exit_code, 4);
  EXPECT_EQ(mesher({"render", "cube", "-o", "no/such/folder/x.png"}).exit_code, 4);
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(CommandLine, MissingVulkanExitsWithThreeAndOneLine) {
  const std::vector<std::string> no_driver{"VK_ICD_FILENAMES=/nonexistent.json",
                                           "VK_DRIVER_FILES=/nonexistent.json"};
  const Finished run = mesher({"render", "cube", "-o", "x.png"}, no_driver);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_EQ(folder_.count_files(), 0U);
}

TEST_F(CommandLine, UnknownDeviceIsNamedInError) {
  const Finished run = mesher({"render", "cube", "-o", "x.png", "--device", "voodoo"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("voodoo"), std::string::npos) << run.err;
}

TEST_F(CommandLine, HelpAndVersionGoToStdout) {
  const Finished help = mesher({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word :
       {"view", "render", "info", "convert", "simplify", "progressive", "extract", "lods"}) {
    EXPECT_NE(help.out.find(word), std::string::npos);
  }
  EXPECT_EQ(mesher({"render", "--help"}).exit_code, 0);
  EXPECT_NE(mesher({"--version"}).out.find("mesher"), std::string::npos);
}

TEST_F(CommandLine, ConvertPreservesCreases) {
  ASSERT_EQ(mesher({"convert", "creased_cube", "c.obj"}).exit_code, 0);
  const auto before = nlohmann::json::parse(
      mesher({"info", std::string(kAssets) + "creased_cube.obj", "--json"}).out);
  const auto after = nlohmann::json::parse(mesher({"info", "c.obj", "--json"}).out);
  EXPECT_GT(before["statistics"]["crease_edges"], 0);
  EXPECT_EQ(before["statistics"], after["statistics"]);
}

}  // namespace
}  // namespace mesher::test
