// Tests progressive meshes on the command line.
#include "app/cli/progressive_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "engine/io/read.h"
#include "tests/app/program_test.h"

namespace mesher::test {
namespace {

class ProgressiveCommand : public ProgramTest {
 protected:
  /// Writes the progressive mesh of an asset to "p.pm".
  void make(const std::string& model, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"progressive", model, "-o", "p.pm"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished run = mesher(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  /// Writes a copy of "p.pm" with one flipped bit to "damaged.pm".
  void damage(double where) {
    std::string bytes = read_bytes(folder_ / "p.pm");
    bytes[static_cast<std::size_t>(where * double(bytes.size()))] ^= 0x10;
    folder_.write("damaged.pm", bytes);
  }
};

using Triangle = std::array<std::array<float, 3>, 3>;

/// Returns the positions of the corners of each face, sorted. Each face starts at its smallest
/// corner.
std::vector<Triangle> surface(const std::filesystem::path& file) {
  const Model model = io::read_model(file);
  std::vector<Triangle> faces;
  for (std::uint32_t f = 0; f < model.mesh.face_count(); ++f) {
    Triangle t;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const glm::vec3& p = model.mesh.position(model.mesh.origins()[3 * f + c]);
      t[c] = {p.x, p.y, p.z};
    }
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    faces.push_back(t);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

TEST_F(ProgressiveCommand, WritesAndReports) {
  const Finished run = mesher({"progressive", "bunny", "-o", "b.pm", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["output"], "b.pm");
  EXPECT_EQ(json["faces_before"], 3674);
  EXPECT_TRUE(json["asked_faces"].is_null());
  EXPECT_EQ(json["faces_reached"], 200);
  EXPECT_EQ(json["far_from_input"], false);
  EXPECT_EQ(json["stop_reason"], "target_reached");
  EXPECT_EQ(json["collapses"], 1737);
  const auto& pm = json["pm"];
  EXPECT_EQ(pm["mode"], "lossless");
  EXPECT_TRUE(pm["coordinate_bits"].is_null());
  EXPECT_EQ(pm["base_faces"], 200);
  EXPECT_EQ(pm["base_vertices"], 102);
  EXPECT_EQ(pm["splits"], 1737);
  EXPECT_EQ(pm["complete"], true);
  EXPECT_TRUE(pm["damage"].is_null());
  const std::size_t bytes = std::filesystem::file_size(folder_ / "b.pm");
  EXPECT_EQ(pm["bytes"], bytes);
  EXPECT_DOUBLE_EQ(pm["bytes_per_vertex"], double(bytes) / 1839);
  EXPECT_EQ(pm["indexed_bytes"], 12 * (1839 + 3674));
  EXPECT_GT(pm["split_bytes"], pm["base_bytes"]);
  EXPECT_LT(json["share_of_indexed"], 1.0);
  for (const char* phase : {"collapse", "build", "write", "total"})
    EXPECT_GE(json["seconds"][phase], 0.0);
  EXPECT_TRUE(json.at("lost").empty());
  EXPECT_EQ(json["repairs"]["faces_flipped"], 0);
  EXPECT_TRUE(holds(run.err,
                    "base: 200 of 3,674 faces, chosen by size and error: target "
                    "reached; 1,737 splits"))
      << run.err;
  EXPECT_TRUE(holds(run.err, "per vertex (lossless)")) << run.err;
  EXPECT_TRUE(mesher({"progressive", "bunny", "-o", "b.pm", "--quiet"}).err.empty());
}

TEST_F(ProgressiveCommand, DefaultBaseIsSmallerThanModel) {
  const auto json = mesher_json({"progressive", "cube", "-o", "c.pm"});
  EXPECT_EQ(json["faces_reached"], 4);
  EXPECT_EQ(json["far_from_input"], true);
  EXPECT_EQ(mesher_json({"progressive", "cactus", "-o", "c.pm"})["faces_reached"], 32);
  EXPECT_EQ(mesher_json({"progressive", "bunny_200", "-o", "c.pm"})["faces_reached"], 24);
  const Finished box = mesher({"progressive", "open_box", "-o", "c.pm", "--json"});
  EXPECT_EQ(nlohmann::json::parse(box.out)["stop_reason"], "far_from_input");
  EXPECT_TRUE(holds(box.err,
                    "base: 3 of 10 faces, chosen by size and error: fewer faces would be "
                    "further than 5 % of the diagonal from the input"))
      << box.err;
  EXPECT_TRUE(holds(box.err, "warning: the base is far from the input")) << box.err;
}

TEST_F(ProgressiveCommand, RequestedBaseIsBuiltAtAnyError) {
  const Finished run = mesher({"progressive", "cactus", "-o", "c.pm", "--base-faces", "24"});
  EXPECT_TRUE(holds(run.err, "base: 24 of 256 faces, asked for 24: target reached")) << run.err;
  EXPECT_TRUE(holds(run.err, "give a larger --base-faces")) << run.err;
  const Finished fine = mesher({"progressive", "cactus", "-o", "c.pm", "--base-faces", "64"});
  EXPECT_FALSE(holds(fine.err, "warning")) << fine.err;
  EXPECT_EQ(mesher({"progressive", "cactus", "-o", "c.pm", "--base-faces", "0"}).exit_code, 1);
  EXPECT_EQ(mesher({"progressive", "cactus", "-o", "c.pm", "--prune"}).exit_code, 1)
      << "a vertex split cannot add a part";
}

TEST_F(ProgressiveCommand, ExtractWarnsWhenLevelIsFarFromFullDetail) {
  make("cactus", {"--base-faces", "24"});
  const Finished run = mesher({"extract", "p.pm", "-o", "e.obj", "--lod", "0", "--json"});
  EXPECT_EQ(nlohmann::json::parse(run.out)["far_from_input"], true);
  EXPECT_TRUE(holds(run.err, "warning: this level is far from the full detail: ")) << run.err;
  const Finished fine = mesher({"extract", "p.pm", "-o", "e.obj", "--faces", "100", "--json"});
  EXPECT_EQ(nlohmann::json::parse(fine.out)["far_from_input"], false);
  EXPECT_FALSE(holds(fine.err, "warning")) << fine.err;
}

TEST_F(ProgressiveCommand, ReportsWhyBaseIsNotReached) {
  const Finished run = mesher({"progressive", "cube", "-o", "c.pm", "--base-faces", "2"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(holds(run.err, "asked for 2: no legal collapse is left")) << run.err;
}

TEST_F(ProgressiveCommand, FullDetailEqualsInput) {
  for (const char* model : {"bunny", "open_box", "cactus", "hypersheet", "knot", "cube"}) {
    make(model, {"--base-faces", "20"});
    ASSERT_EQ(mesher({"extract", "p.pm", "-o", "e.obj", "--lod", "1"}).exit_code, 0);
    ASSERT_EQ(mesher({"convert", model, "c.obj"}).exit_code, 0);
    EXPECT_TRUE(surface(folder_ / "e.obj") == surface(folder_ / "c.obj")) << model;
    EXPECT_EQ(mesher_json({"info", "e.obj"})["statistics"]["crease_edges"],
              mesher_json({"info", "c.obj"})["statistics"]["crease_edges"])
        << model;
  }
}

TEST_F(ProgressiveCommand, ExtractReachesRequestedFaces) {
  make("bunny");
  for (const int faces : {200, 201, 999, 1000, 2345, 3673, 3674}) {
    const auto json =
        mesher_json({"extract", "p.pm", "-o", "e.ply", "--faces", std::to_string(faces)});
    EXPECT_EQ(json["asked_faces"], faces);
    EXPECT_EQ(json["faces"], faces - faces % 2);
    EXPECT_EQ(json["vertices"], faces / 2 + 2);
    const auto info = mesher_json({"info", "e.ply"});
    EXPECT_EQ(info["statistics"]["faces"], faces - faces % 2);
    EXPECT_EQ(info["statistics"]["euler_characteristic"], 2);
  }
}

TEST_F(ProgressiveCommand, ExtractReportsMissingLevel) {
  make("bunny");
  const Finished few = mesher({"extract", "p.pm", "-o", "e.obj", "--faces", "7", "--json"});
  EXPECT_EQ(few.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(few.out)["faces"], 200);
  EXPECT_TRUE(holds(few.err, "the base: no level is coarser")) << few.err;
  const Finished many = mesher({"extract", "p.pm", "-o", "e.obj", "--faces", "9999", "--json"});
  EXPECT_EQ(nlohmann::json::parse(many.out)["faces"], 3674);
  EXPECT_TRUE(holds(many.err, "full detail: the mesh has no more faces")) << many.err;
}

TEST_F(ProgressiveCommand, ExtractAcceptsShareOfSplits) {
  make("bunny");
  EXPECT_EQ(mesher_json({"extract", "p.pm", "e.obj", "--lod", "0"})["faces"], 200);
  const auto half = mesher_json({"extract", "p.pm", "e.obj", "--lod", "0.5"});
  EXPECT_EQ(half["level"], 869);
  EXPECT_EQ(half["asked_lod"], 0.5);
  EXPECT_TRUE(half["asked_faces"].is_null());
  for (const char* file : {"e.stl", "e.off", "e.gltf", "e.glb"})
    EXPECT_EQ(mesher_json({"extract", "p.pm", file, "--lod", "0.5"})["faces"], half["faces"]);
}

TEST_F(ProgressiveCommand, EveryLevelKeepsCreases) {
  make("cactus", {"--base-faces", "100"});
  const auto full = mesher_json({"info", "p.pm"});
  EXPECT_EQ(full["statistics"]["crease_edges"],
            mesher_json({"info", "cactus"})["statistics"]["crease_edges"]);
  ASSERT_EQ(mesher({"extract", "p.pm", "-o", "base.obj", "--lod", "0"}).exit_code, 0);
  EXPECT_GT(mesher_json({"info", "base.obj"})["statistics"]["crease_edges"], 0);
  const Finished ply = mesher({"extract", "p.pm", "-o", "base.ply", "--lod", "0"});
  EXPECT_TRUE(holds(ply.err, "base.ply does not hold ")) << ply.err;
}

TEST_F(ProgressiveCommand, AttributesAreKeptAndTheirSizesReported) {
  folder_.write("t.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
                "f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\n");
  const Finished run = mesher({"progressive", "t.obj", "-o", "t.pm", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["lost"], nlohmann::json::array());
  EXPECT_TRUE(holds(run.err, "TEXCOORD_0: ")) << run.err;
  EXPECT_TRUE(holds(run.err, " bits per vertex (lossless)")) << run.err;
  std::uint64_t bytes = 0;
  std::vector<std::string> names;
  for (const auto& part : json["pm"]["parts"]) {
    names.push_back(part["name"]);
    bytes += part["bytes"].get<std::uint64_t>();
  }
  EXPECT_EQ(names, (std::vector<std::string>{"mesh", "TEXCOORD_0", "NORMAL", "seams"}));
  EXPECT_LE(bytes, json["pm"]["bytes"].get<std::uint64_t>());
  EXPECT_GT(json["pm"]["attribute_bytes"], 0);
  const auto read = mesher_json({"info", "t.pm"});
  EXPECT_EQ(read["pm"]["attribute_bytes"], json["pm"]["attribute_bytes"]);
  EXPECT_EQ(read["attributes"].size(), 2U);
  ASSERT_EQ(mesher({"extract", "t.pm", "-o", "e.obj", "--lod", "1"}).exit_code, 0);
  EXPECT_EQ(mesher_json({"info", "e.obj"})["attributes"].size(), 2U);
}

TEST_F(ProgressiveCommand, QuantizedFileIsSmallerAndClose) {
  make("bunny");
  const auto json = mesher_json({"progressive", "bunny", "-o", "q.pm", "--bits", "12"});
  EXPECT_EQ(json["pm"]["mode"], "quantized");
  EXPECT_EQ(json["pm"]["coordinate_bits"], 12);
  EXPECT_EQ(mesher_json({"info", "q.pm"})["pm"]["coordinate_bits"], 12);
  EXPECT_LT(std::filesystem::file_size(folder_ / "q.pm"),
            0.7 * double(std::filesystem::file_size(folder_ / "p.pm")));
  const auto distance = mesher_json({"compare", "bunny", "q.pm", "--samples", "20000"});
  EXPECT_LT(distance["two_sided"]["max_percent"], 0.05);
  EXPECT_EQ(distance["second_pm"]["coordinate_bits"], 12);
}

TEST_F(ProgressiveCommand, EveryCommandReadsProgressiveMesh) {
  make("bunny");
  const Finished words = mesher({"info", "p.pm"});
  EXPECT_TRUE(holds(words.out, "splits                1,737")) << words.out;
  EXPECT_TRUE(holds(words.out, "complete              yes")) << words.out;
  EXPECT_TRUE(holds(words.out, "faces                 3,674")) << words.out;
  EXPECT_EQ(mesher_json({"info", "p.pm"})["pm"]["announced_splits"], 1737);
  EXPECT_EQ(mesher_json({"convert", "p.pm", "c.obj"})["statistics"]["faces"], 3674);
  EXPECT_EQ(mesher_json({"simplify", "p.pm", "s.obj", "--faces", "500"})["faces_before"], 3674);
  EXPECT_EQ(mesher_json({"subdivide", "p.pm", "s.obj"})["after"]["faces"], 4 * 3674);
  EXPECT_EQ(mesher_json({"compare", "p.pm", "bunny", "--samples", "100"})["first_pm"]["splits"],
            1737);
  EXPECT_EQ(mesher_json({"render", "p.pm", "-o", "r.png", "--size", "50"})["faces"], 3674);
  // A progressive mesh built from a progressive mesh, with another base.
  const auto again = mesher_json({"progressive", "p.pm", "-o", "p.pm", "--base-faces", "1000"});
  EXPECT_EQ(again["pm"]["base_faces"], 1000);
  EXPECT_EQ(again["input_pm"]["base_faces"], 200);
  EXPECT_EQ(mesher_json({"info", "p.pm"})["pm"]["base_faces"], 1000);
}

TEST_F(ProgressiveCommand, FormatIsDetectedByContents) {
  make("cube");
  for (const char* name : {"c.bin", "c", "c.obj", "c.PM"}) {
    folder_.write(name, read_bytes(folder_ / "p.pm"));
    EXPECT_EQ(mesher_json({"info", name})["statistics"]["faces"], 12) << name;
  }
  folder_.write("no.pm", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(mesher({"info", "no.pm"}).exit_code, 2);
}

TEST_F(ProgressiveCommand, PipesAreReadAndWritten) {
  const Finished info =
      shell("mesher progressive bunny -o /dev/stdout --quiet | mesher info /dev/stdin --json");
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(nlohmann::json::parse(info.out)["statistics"]["faces"], 3674);
  make("bunny");
  EXPECT_EQ(shell("cat p.pm | mesher extract /dev/stdin -o e.obj --faces 500").exit_code, 0);
  EXPECT_EQ(mesher_json({"info", "e.obj"})["statistics"]["faces"], 500);
  EXPECT_EQ(shell("mesher convert /dev/stdin c.obj < p.pm").exit_code, 0);
  EXPECT_EQ(mesher_json({"info", "c.obj"})["statistics"]["faces"], 3674);
  EXPECT_EQ(shell("mkfifo f.pm; cat p.pm >f.pm & mesher info f.pm").exit_code, 0);
  EXPECT_EQ(shell("cat p.pm | mesher lods /dev/stdin -o l.glb").exit_code, 0);
  const Finished other = shell("mkfifo f; echo v 0 0 0 and more of it >f & mesher info f");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(
      holds(other.err, "files of other formats, and named pipes, need one of the extensions"))
      << other.err;
}

/// Discs with two hubs each that are close together. A collapse of the hubs moves thousands of
/// corners.
std::string hubs(int discs, int rim) {
  std::string text;
  std::string faces;
  const auto add_face = [&](int a, int b, int c) {
    faces += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  for (int disc = 0; disc < discs; ++disc) {
    const int first = 1 + disc * (rim + 2);
    const auto at = [&](int i) { return first + 2 + i % rim; };
    const double x = 3.0 * disc;
    const auto add_vertex = [&](double dx, double y, double z) {
      text +=
          "v " + std::to_string(x + dx) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    };
    add_vertex(0.0, 0.0, 0.5);
    add_vertex(1e-4, 0.0, 0.5);
    for (int i = 0; i < rim; ++i) {
      const double angle = (0.5 + 2.0 * i / rim) * std::numbers::pi;
      add_vertex(std::cos(angle), std::sin(angle), 0.0);
      add_face(i < rim / 2 ? first : first + 1, at(i), at(i + 1));
    }
    add_face(first + 1, first, at(rim / 2));
    add_face(first, first + 1, at(0));
  }
  return text + faces;
}

TEST_F(ProgressiveCommand, FormatLimitErrorNamesFile) {
  folder_.write("hubs.obj", hubs(60, 3000));
  const Finished run = mesher({"progressive", "hubs.obj", "-o", "h.pm", "--base-faces", "180000",
                               "--boundary", "lock", "--cost", "length"});
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_TRUE(holds(run.err, "mesher: h.pm: splits move too many corners")) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "h.pm"));
}

TEST_F(ProgressiveCommand, WritesToFileDescriptors) {
  make("bunny");
  const std::string bytes = read_bytes(folder_ / "p.pm");
  EXPECT_EQ(shell("mesher progressive bunny -o /dev/stdout > a.out").exit_code, 0);
  EXPECT_TRUE(read_bytes(folder_ / "a.out") == bytes);
  EXPECT_EQ(shell("mesher progressive bunny -o /dev/fd/3 3> b.out").exit_code, 0);
  EXPECT_TRUE(read_bytes(folder_ / "b.out") == bytes);
  // Appending keeps the contents of the file.
  EXPECT_EQ(
      shell("printf head > c.out; mesher progressive bunny -o /dev/stdout >> c.out").exit_code, 0);
  EXPECT_TRUE(read_bytes(folder_ / "c.out") == "head" + bytes);
  const Finished closed = shell("mesher progressive bunny -o /dev/fd/77");
  EXPECT_EQ(closed.exit_code, 4);
  EXPECT_TRUE(holds(closed.err, "/dev/fd/77: cannot write")) << closed.err;
  EXPECT_EQ(shell("mesher progressive bunny -o /dev/fd/3 3< p.pm").exit_code, 4);
}

TEST_F(ProgressiveCommand, ReadsNoMoreOfPipeThanNeeded) {
  make("bunny");
  // The file "all" appears if mesher has read all bytes instead of closing the pipe.
  const std::string tail = "head -c 100M /dev/zero && echo x >all";
  const Finished after = shell("(cat p.pm; " + tail + ") | mesher info /dev/stdin --json");
  ASSERT_EQ(after.exit_code, 0) << after.err;
  EXPECT_EQ(nlohmann::json::parse(after.out)["statistics"]["faces"], 3674);
  const Finished garbage = shell("(" + tail + ") | mesher info /dev/stdin");
  EXPECT_EQ(garbage.exit_code, 2);
  EXPECT_TRUE(holds(garbage.err, "does not begin like any format")) << garbage.err;
  const Finished named = shell("mkfifo g.pm; (" + tail + ") >g.pm & mesher info g.pm");
  EXPECT_EQ(named.exit_code, 2);
  EXPECT_TRUE(holds(named.err, "not a progressive mesh")) << named.err;
  damage(0.5);
  EXPECT_EQ(shell("(cat damaged.pm; " + tail + ") | mesher info /dev/stdin").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "all"));
}

TEST_F(ProgressiveCommand, CompleteMeshDoesNotWaitForEndOfPipe) {
  make("bunny");
  const Finished run = shell(
      "mkfifo f.pm; (cat p.pm; exec sleep 60) >f.pm 2>/dev/null & "
      "timeout 30 " MESHER_PROGRAM " info f.pm --json; code=$?; kill $!; exit $code");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto pm = nlohmann::json::parse(run.out)["pm"];
  EXPECT_EQ(pm["complete"], true);
  EXPECT_EQ(pm["bytes"], std::filesystem::file_size(folder_ / "p.pm"));
}

TEST_F(ProgressiveCommand, BytesAfterEndAreDamageOfFileButNotOfPipe) {
  make("bunny");
  // Small enough for the buffer of the pipe, so that all bytes arrive at once.
  const std::string bytes = read_bytes(folder_ / "p.pm");
  ASSERT_LT(bytes.size(), 65536U);
  folder_.write("longer.pm", bytes + "more");
  const Finished piped = shell("cat longer.pm | mesher info /dev/stdin --json");
  ASSERT_EQ(piped.exit_code, 0) << piped.err;
  auto pm = nlohmann::json::parse(piped.out)["pm"];
  EXPECT_EQ(pm["complete"], true) << piped.out;
  EXPECT_EQ(pm["bytes"], bytes.size());
  const Finished refused = mesher({"info", "longer.pm"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(holds(refused.err, "is damaged: byte ")) << refused.err;
  EXPECT_TRUE(holds(refused.err, "bytes follow after the last split")) << refused.err;
  const Finished allowed = mesher({"info", "longer.pm", "--allow-damaged", "--json"});
  ASSERT_EQ(allowed.exit_code, 0) << allowed.err;
  pm = nlohmann::json::parse(allowed.out)["pm"];
  EXPECT_TRUE(holds(pm["damage"], "bytes follow")) << allowed.out;
  EXPECT_EQ(pm["bytes"], bytes.size() + 4);
}

TEST_F(ProgressiveCommand, TruncatedPipeGivesReceivedPart) {
  make("bunny");
  const std::size_t bytes = std::filesystem::file_size(folder_ / "p.pm");
  const Finished run = shell("head -c " + std::to_string(bytes / 2) +
                             " p.pm | mesher info /dev/stdin --json --quiet --allow-damaged");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.err, "/dev/stdin: DAMAGED: ")) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["pm"]["complete"], false);
  EXPECT_FALSE(json["pm"]["damage"].get<std::string>().empty());
  EXPECT_LT(json["pm"]["splits"], 1737);
  EXPECT_EQ(json["pm"]["announced_splits"], 1737);
  EXPECT_EQ(json["statistics"]["euler_characteristic"], 2);
  EXPECT_EQ(json["statistics"]["vertices"], 102 + json["pm"]["splits"].get<int>());
  const Finished nothing = shell("head -c 20 p.pm | mesher info /dev/stdin");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_EQ(std::count(nothing.err.begin(), nothing.err.end(), '\n'), 1) << nothing.err;
}

TEST_F(ProgressiveCommand, EveryCommandRefusesDamageOrReportsIt) {
  make("bunny");
  damage(0.7);
  const std::vector<std::vector<std::string>> commands{
      {"info", "damaged.pm"},
      {"convert", "damaged.pm", "o.obj"},
      {"extract", "damaged.pm", "o.obj", "--lod", "1"},
      {"simplify", "damaged.pm", "o.obj", "--faces", "100"},
      {"subdivide", "damaged.pm", "o.obj"},
      {"lods", "damaged.pm", "o.glb"},
      {"render", "damaged.pm", "-o", "o.png", "--size", "20", "--lod", "0.5"},
      {"render", "damaged.pm", "-o", "o.png", "--size", "20"}};
  for (auto arguments : commands) {
    arguments.insert(arguments.end(), {"--json", "--quiet"});
    const Finished refused = mesher(arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments[0];
    EXPECT_TRUE(holds(refused.err, "mesher: damaged.pm: is damaged: byte ")) << refused.err;
    EXPECT_EQ(refused.out, "") << arguments[0];
    for (const char* output : {"o.obj", "o.glb", "o.png"})
      EXPECT_FALSE(std::filesystem::exists(folder_ / output)) << arguments[0];
    arguments.emplace_back("--allow-damaged");
    const Finished run = mesher(arguments);
    ASSERT_EQ(run.exit_code, 0) << arguments[0] << ": " << run.err;
    EXPECT_TRUE(holds(run.err, "damaged.pm: DAMAGED: ")) << arguments[0] << ": " << run.err;
    const auto pm = nlohmann::json::parse(run.out)["pm"];
    EXPECT_EQ(pm["complete"], false) << arguments[0];
    EXPECT_GT(pm["splits"], 0) << arguments[0];
    EXPECT_LT(pm["splits"], 1737) << arguments[0];
    for (const char* output : {"o.obj", "o.glb", "o.png"})
      std::filesystem::remove(folder_ / output);
  }
  const std::vector<std::string> edit{"edit", "damaged.pm", "-o", "o.obj", "--do", "simplify"};
  EXPECT_EQ(mesher(edit).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o.obj"));
  const Finished view =
      mesher({"view", "damaged.pm", "--screenshot", "v.png", "--size", "20", "--quiet"});
  EXPECT_EQ(view.exit_code, 0);
  EXPECT_TRUE(holds(view.err, "DAMAGED: damaged.pm: ")) << view.err;
  const Finished compare = mesher({"compare", "damaged.pm", "bunny", "--json", "--allow-damaged"});
  EXPECT_EQ(nlohmann::json::parse(compare.out)["first_pm"]["complete"], false);
  EXPECT_EQ(mesher({"compare", "bunny", "damaged.pm"}).exit_code, 2);
  EXPECT_EQ(mesher({"compare", "bunny", "damaged.pm", "--allow-damaged"}).exit_code, 0);
}

TEST_F(ProgressiveCommand, MissingBaseIsAnError) {
  make("bunny");
  damage(0.0);
  for (const std::string& bytes : {read_bytes(folder_ / "damaged.pm"), std::string(),
                                   read_bytes(folder_ / "p.pm").substr(0, 30)}) {
    folder_.write("bad.pm", bytes);
    for (const auto& arguments : std::vector<std::vector<std::string>>{
             {"info", "bad.pm"}, {"extract", "bad.pm", "o.obj", "--lod", "0"}}) {
      const Finished run = mesher(arguments);
      EXPECT_EQ(run.exit_code, 2) << run.err;
      EXPECT_TRUE(holds(run.err, "mesher: bad.pm")) << run.err;
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o.obj"));
}

TEST_F(ProgressiveCommand, OutputIsIndependentOfThreadCount) {
  make("knot", {"--threads", "1", "--base-faces", "300"});
  const std::string one = read_bytes(folder_ / "p.pm");
  make("knot", {"--threads", "2", "--base-faces", "300"});
  EXPECT_TRUE(read_bytes(folder_ / "p.pm") == one);
}

TEST_F(ProgressiveCommand, UsageErrorsExitWithOne) {
  make("cube");
  const std::vector<std::vector<std::string>> bad{
      {"progressive", "cube"},
      {"progressive", "cube", "-o", "x.obj"},
      {"progressive", "cube", "-o", "x.pm", "--bits", "3"},
      {"progressive", "cube", "-o", "x.pm", "--bits", "25"},
      {"progressive", "cube", "-o", "x.pm", "--base-faces", "0"},
      {"progressive", "cube", "-o", "x.pm", "--cost", "vanity"},
      {"progressive", "cube", "-o", "x.pm", "--crease-angle", "nan"},
      {"convert", "cube", "x.pm"},
      {"simplify", "cube", "-o", "x.pm", "--faces", "6"},
      {"extract", "p.pm", "-o", "x.obj"},
      {"extract", "p.pm", "--lod", "1"},
      {"extract", "p.pm", "-o", "x.pm", "--lod", "1"},
      {"extract", "p.pm", "-o", "x.unknown", "--lod", "1"},
      {"extract", "p.pm", "-o", "x.obj", "--lod", "1", "--faces", "6"},
      {"extract", "p.pm", "-o", "x.obj", "--lod", "1", "--tag-creases", "30"},
      {"extract", "p.pm", "-o", "x.obj", "--faces", "0"},
      {"extract", "p.pm", "-o", "x.obj", "--lod", "1.01"},
      {"extract", "p.pm", "-o", "x.obj", "--lod", "-0.1"},
      {"extract", "p.pm", "-o", "x.obj", "--lod", "nan"},
      {"extract", "p.pm", "-o", "x.obj", "--lod", "half"}};
  for (const auto& arguments : bad) {
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 1) << arguments[0] << " " << arguments.back() << ": " << run.err;
    EXPECT_FALSE(run.err.empty());
  }
  EXPECT_EQ(folder_.count_files(), 1U);
}

TEST_F(ProgressiveCommand, UnwritableOutputIsRejectedBeforeReading) {
  folder_.write("points.obj", "v 0 0 0\nv 1 0 0\n");
  // The output is checked before the input is read.
  EXPECT_EQ(mesher({"progressive", "missing.obj", "-o", "no/such/x.pm"}).exit_code, 4);
  EXPECT_EQ(mesher({"extract", "missing.pm", "no/such/x.obj", "--lod", "1"}).exit_code, 4);
  EXPECT_EQ(mesher({"simplify", "missing.obj", "no/such/x.obj", "--faces", "9"}).exit_code, 4);
  EXPECT_EQ(mesher({"render", "missing.obj", "-o", "no/such/x.png"}).exit_code, 4);
  EXPECT_EQ(mesher({"progressive", "missing.obj", "-o", "x.pm"}).exit_code, 2);
  EXPECT_EQ(mesher({"progressive", "points.obj", "-o", "x.pm"}).exit_code, 2);
  EXPECT_EQ(mesher({"extract", "missing.pm", "-o", "x.obj", "--lod", "1"}).exit_code, 2);
  EXPECT_EQ(mesher({"extract", "cube", "-o", "x.obj", "--lod", "1"}).exit_code, 2);
  EXPECT_EQ(shell("ulimit -f 0; mesher progressive bunny -o x.pm").exit_code, 4);
  EXPECT_EQ(folder_.count_files(), 1U);
}

}  // namespace
}  // namespace mesher::test
