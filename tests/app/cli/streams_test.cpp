// Tests commands that read and write pipes.
#include <string>

#include "tests/app/program_test.h"

namespace mesher::test {
namespace {

class Pipes : public ProgramTest {
 protected:
  /// Writes the cube in every format, and returns the extensions.
  std::vector<std::string> cubes() {
    const std::vector<std::string> formats{"obj", "ply", "stl", "off", "gltf", "glb"};
    for (const std::string& format : formats)
      EXPECT_EQ(mesher({"convert", "cube", "cube." + format, "--quiet"}).exit_code, 0);
    EXPECT_EQ(mesher({"progressive", "cube", "cube.pm", "--quiet"}).exit_code, 0);
    return formats;
  }

  static int faces_of(const Finished& run) {
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto info = nlohmann::json::parse(run.out, nullptr, false);
    return info.is_discarded() ? -1 : info["statistics"]["faces"].get<int>();
  }
};

TEST_F(Pipes, InfoKnowsEveryFormatByItsBeginning) {
  std::vector<std::string> formats = cubes();
  formats.emplace_back("pm");
  for (const std::string& format : formats) {
    SCOPED_TRACE(format);
    EXPECT_EQ(faces_of(shell("cat cube." + format + " | mesher info - --json")), 12);
    EXPECT_EQ(faces_of(shell("mesher info --json /dev/stdin < cube." + format)), 12);
    EXPECT_EQ(faces_of(shell("mesher info --json /dev/fd/7 7< cube." + format)), 12);
    EXPECT_EQ(faces_of(shell("cat cube." + format + " | mesher info --json /dev/fd/7 7<&0")), 12);
  }
}

TEST_F(Pipes, TextStlAndPlyAreKnownToo) {
  for (const char* format : {"stl", "ply"}) {
    const std::string file = std::string("text.") + format;
    ASSERT_EQ(mesher({"convert", "cube", file, "--ascii", "--quiet"}).exit_code, 0);
    EXPECT_EQ(faces_of(shell("cat " + file + " | mesher info - --json")), 12) << format;
  }
}

TEST_F(Pipes, FormatNamesThatOfAnInput) {
  folder_.write("odd",
                "# no statement that only OBJ has in front\nzzz\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                "f 1 2 3\n");
  const Finished unknown = shell("cat odd | mesher info -");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(unknown.err,
            "mesher: /dev/stdin: does not begin like any format; name its format by --format: obj, "
            "ply, stl, off, gltf, glb or pm\n");
  EXPECT_EQ(faces_of(shell("cat odd | mesher info - --json --format obj")), 1);
  EXPECT_EQ(faces_of(shell("cat odd | mesher info - --json --input-format obj")), 1);
}

TEST_F(Pipes, ConvertWritesEveryFormatToStdout) {
  for (const std::string& format : cubes()) {
    SCOPED_TRACE(format);
    for (const char* output : {"-", "/dev/stdout", "/dev/fd/1"}) {
      const Finished run = shell(std::string("mesher convert cube ") + output + " --format " +
                                 format + " | cmp - cube." + format);
      EXPECT_EQ(run.exit_code, 0) << output << run.err << run.out;
    }
    EXPECT_EQ(shell("mesher convert cube /dev/fd/5 --quiet --format " + format +
                    " 5>&1 | cmp - cube." + format)
                  .exit_code,
              0);
  }
}

TEST_F(Pipes, EveryCommandReadsAndWritesPipes) {
  cubes();
  for (const char* command :
       {"convert - -", "simplify - -o - --faces 6", "subdivide - -", "edit - - --do subdivide"}) {
    SCOPED_TRACE(command);
    const Finished run = shell(std::string("cat cube.ply | mesher ") + command +
                               " --format off --quiet | mesher info - --json");
    EXPECT_GT(faces_of(run), 0);
  }
  EXPECT_GT(faces_of(shell("cat cube.glb | mesher lods - -o - --format glb --quiet | "
                           "mesher info - --json")),
            0);
  EXPECT_EQ(faces_of(shell("cat cube.stl | mesher progressive - - --quiet | "
                           "mesher extract - -o - --lod 1 --format obj --quiet | "
                           "mesher info - --json")),
            12);
  EXPECT_EQ(shell("cat cube.glb | mesher compare - cube.glb --quiet").exit_code, 0);
}

TEST_F(Pipes, RenderWritesPicturesToStdout) {
  ASSERT_EQ(mesher({"render", "cube", "-o", "p.png", "--size", "64"}).exit_code, 0);
  const Finished png =
      shell("mesher render cube -o - --size 64 --format png --quiet | cmp - p.png");
  EXPECT_EQ(png.exit_code, 0) << png.out << png.err;
  const Finished webp = shell("mesher render cube -o - --size 64 --format webp --quiet");
  EXPECT_EQ(webp.exit_code, 0) << webp.err;
  EXPECT_EQ(webp.out.substr(8, 4), "WEBP");
}

TEST_F(Pipes, OutputPipeWithoutFormatIsAUsageError) {
  const Finished run = mesher({"convert", "cube", "-"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err,
            "mesher: /dev/stdout: name the format of the output by --format: obj, ply, stl, off, "
            "gltf, glb\n");
  EXPECT_EQ(mesher({"convert", "cube", "-", "--format", "png"}).exit_code, 1);
  EXPECT_EQ(mesher({"render", "cube", "-o", "-"}).exit_code, 1);
  EXPECT_EQ(mesher({"lods", "cube", "-o", "-", "--format", "obj"}).exit_code, 1);
  EXPECT_EQ(mesher({"compare", "-", "/dev/stdin"}).exit_code, 1);
  EXPECT_EQ(mesher({"convert", "cube.obj", "x.ply", "--format", "off"}).exit_code, 1);
}

TEST_F(Pipes, JsonGoesToStderrWhereTheOutputIsStdout) {
  const Finished run = mesher({"convert", "cube", "-", "--format", "off", "--json", "--quiet"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(run.out.starts_with("OFF")) << run.out.substr(0, 20);
  EXPECT_EQ(nlohmann::json::parse(run.err)["statistics"]["faces"], 12);
  const Finished file = mesher({"convert", "cube", "x.off", "--json", "--quiet"});
  EXPECT_EQ(nlohmann::json::parse(file.out)["statistics"]["faces"], 12);
  EXPECT_EQ(file.err, "");
}

TEST_F(Pipes, ReaderThatGoesAwayIsAnErrorAndNoCrash) {
  const Finished run = shell(
      "{ mesher subdivide knot - --levels 2 --format obj --quiet 2>err; echo $? >code; } | head -c "
      "10 >out; cat code err");
  EXPECT_EQ(run.out, "4\nmesher: /dev/stdout: cannot write: Broken pipe\n");
  const Finished text = shell(
      "{ sleep 0.2; mesher info knot 2>err; echo $? >code; } | true; sleep 0.5; cat code err");
  EXPECT_EQ(text.out, "4\nmesher: stdout: cannot be written\n");
}

TEST_F(Pipes, FilesBesideAreLeftOutAndNamed) {
  folder_.write("m.mtl", "newmtl red\nKd 1 0 0\n");
  folder_.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const Finished run = mesher({"convert", "m.obj", "-", "--format", "obj"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out.find("mtllib"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("mesher: /dev/stdout does not hold 1 material: red"), std::string::npos)
      << run.err;
}

TEST_F(Pipes, EmptyPipeIsRefused) {
  const Finished run = shell("true | mesher info -");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.err, "mesher: /dev/stdin: is empty, or nothing that can be read\n");
}

}  // namespace
}  // namespace mesher::test
