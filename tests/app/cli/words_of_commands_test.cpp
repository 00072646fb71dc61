// Tests the messages of commands.
#include <sstream>
#include <string>

#include "tests/app/program_test.h"

namespace mesher::test {
namespace {

class WordsOfCommands : public ProgramTest {
 protected:
  /// Expects that each line of stderr begins with "mesher: ", and that there is one.
  static void expect_named(const Finished& run) {
    EXPECT_NE(run.err, "");
    std::istringstream lines(run.err);
    for (std::string line; std::getline(lines, line);)
      EXPECT_TRUE(line.starts_with("mesher: ")) << run.err;
  }
};

TEST_F(WordsOfCommands, EveryMessageBeginsWithTheProgram) {
  folder_.write("bad.obj", "v 0 0 0\nf 1 2 9\n");
  folder_.write("m.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 2 3\n");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"info", "bad.obj"},
                                             {"info", "missing.obj"},
                                             {"info"},
                                             {"info", "cube", "--no-such-option"},
                                             {"info", "cube", "--threads", "x"},
                                             {"nothing-like-a-command"},
                                             {"convert", "m.obj", "m.stl"},
                                             {"simplify", "cube", "-o", "s.obj", "--faces", "6"},
                                             {"subdivide", "cube", "-o", "s.obj"},
                                             {"progressive", "knot", "-o", "k.pm"},
                                             {"lods", "knot", "-o", "k.obj"},
                                             {"edit", "cube", "e.obj", "--do", "subdivide"},
                                             {"render", "cube", "-o", "x.jpg"},
                                             {"view", "cube", "--size", "50"}}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_named(mesher(arguments));
  }
}

TEST_F(WordsOfCommands, ControlBytesOfNamesAreEscaped) {
  const std::string evil = "a\x1b[31m\n\x07.obj";
  const Finished missing = mesher({"info", evil});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err.find("mesher: a\\x1b[31m\\n\\x07.obj: "), 0U) << missing.err;
  folder_.write(
      "m.obj", "mtllib x\x1b[2J.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng evil\x1b]0;title\x07\nf 1 2 3\n");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", "m.obj"},
                                                    {"convert", "m.obj", "m.stl"},
                                                    {"info", "cube", "--\x1b[31m"}}) {
    const Finished run = mesher(arguments);
    for (const std::string* text : {&run.err, &run.out}) {
      EXPECT_EQ(text->find('\x1b'), std::string::npos) << *text;
      EXPECT_EQ(text->find('\x07'), std::string::npos) << *text;
    }
    EXPECT_TRUE(holds(run.err, "\\x1b")) << run.err;
  }
}

TEST_F(WordsOfCommands, NamesThatAreNotUtf8LeaveJsonValid) {
  folder_.write("m.obj", "mtllib \xff.mtl\no \xC3(\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto info = mesher_json({"info", "m.obj"});
  EXPECT_FALSE(info.is_discarded());
  EXPECT_EQ(info["statistics"]["faces"], 1);
}

TEST_F(WordsOfCommands, NetworkAddressesAreNamedAsSuch) {
  const auto document = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,
           "componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":
           {"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})";
  };
  for (const char* uri : {"http://example.com/a.bin", "https://example.com/a.bin", "ftp://a/b"}) {
    folder_.write("net.gltf", document(uri));
    const Finished run = mesher({"info", "net.gltf"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.err, std::string("mesher: net.gltf: buffer 0 is at ") + uri +
                           ": mesher does not fetch from the network\n");
  }
  folder_.write("net.gltf", document("none.bin"));
  EXPECT_TRUE(holds(mesher({"info", "net.gltf"}).err, "buffer 0 is at none.bin: there is no such"));
}

TEST_F(WordsOfCommands, MistypedOptionIsAnsweredInItsOwnStyle) {
  EXPECT_TRUE(holds(mesher({"cube", "-gourad"}).err, "mesher: -gourad: did you mean -gouraud?\n"));
  EXPECT_TRUE(
      holds(mesher({"cube", "--gourad"}).err, "mesher: --gourad: did you mean --gouraud?\n"));
  EXPECT_TRUE(holds(mesher({"info", "cube", "-max-face", "5"}).err,
                    "mesher: -max-face: did you mean -max-faces?\n"));
}

}  // namespace
}  // namespace mesher::test
