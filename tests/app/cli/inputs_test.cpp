// Tests commands whose inputs another program changes or cuts short while they are read.
#include <cstdint>
#include <cstring>

#include "tests/app/program_test.h"
#include "tests/support/file_faults.h"

namespace mesher::test {
namespace {

/// An input that consists of one file or more, and the one that something happens to.
struct ChangingInput {
  std::string model;
  std::string changing;
  int at = 1;  ///< which of the files that are mapped it is
};

class ChangingInputs : public ProgramTest {
 protected:
  void SetUp() override {
    for (const char* name : {"in.obj", "in.ply", "in.stl", "in.off", "in.gltf", "in.glb"})
      ASSERT_EQ(mesher({"convert", "knot", name}).exit_code, 0) << name;
    ASSERT_EQ(mesher({"progressive", "knot", "in.pm"}).exit_code, 0);
    folder_.write("red.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\n" + std::string(8192, '#'));
    folder_.write("red.png", std::string(8192, 'p'));
    folder_.write("red.obj", "mtllib red.mtl\nusemtl red\n" + read_bytes(folder_ / "in.obj"));
    split_buffer();
  }

  /// Writes split.gltf, whose buffer is a file of its own.
  void split_buffer() {
    const std::string glb = read_bytes(folder_ / "in.glb");
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, &glb[kHeader], sizeof(json_bytes));
    const std::size_t json_begin = kHeader + kChunkHeader;
    auto json = nlohmann::json::parse(glb.substr(json_begin, json_bytes));
    json["buffers"][0]["uri"] = "split.bin";
    folder_.write("split.bin", glb.substr(json_begin + json_bytes + kChunkHeader));
    folder_.write("split.gltf", json.dump());
  }

  static std::vector<ChangingInput> inputs() {
    return {{"in.obj", "in.obj"},     {"in.ply", "in.ply"},           {"in.stl", "in.stl"},
            {"in.off", "in.off"},     {"in.gltf", "in.gltf"},         {"in.glb", "in.glb"},
            {"in.pm", "in.pm"},       {"split.gltf", "split.bin", 2}, {"red.obj", "red.mtl", 2},
            {"red.obj", "red.png", 3}};
  }

  /// Expects exit code 2, a line that says what happened to a file, and no output.
  void expect_refusal(const std::vector<std::string>& arguments, const FileFaults& faults,
                      const std::string& file) {
    const Finished run = mesher(arguments, faults.environment());
    EXPECT_EQ(run.exit_code, 2) << run.err;
    const std::string begin = "mesher: " + file;
    EXPECT_TRUE(holds(run.err, begin + ": was changed by another program while it was read") ||
                holds(run.err, begin + ": could not be read to its end"))
        << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_ / arguments.back()));
  }
};

TEST_F(ChangingInputs, InputThatIsRewrittenIsRefused) {
  for (const ChangingInput& input : inputs()) {
    SCOPED_TRACE(input.changing);
    const std::string before = read_bytes(folder_ / input.changing);
    for (const char* output : {"out.ply", "out.glb"}) {
      FileFaults faults;
      faults.change = (folder_ / input.changing).string();
      faults.at = input.at;
      expect_refusal({"convert", input.model, "--quiet", output}, faults, input.changing);
      folder_.write(input.changing, before);
    }
  }
}

TEST_F(ChangingInputs, InputThatIsCutShortIsRefused) {
  for (const ChangingInput& input : inputs()) {
    SCOPED_TRACE(input.changing);
    const std::string before = read_bytes(folder_ / input.changing);
    for (const char* output : {"out.ply", "out.glb"}) {
      FileFaults faults;
      faults.cut = (folder_ / input.changing).string();
      faults.at = input.at;
      expect_refusal({"convert", input.model, "--quiet", output}, faults, input.changing);
      folder_.write(input.changing, before);
    }
  }
}

TEST_F(ChangingInputs, EveryCommandRefusesThem) {
  const std::string before = read_bytes(folder_ / "in.obj");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", "in.obj", "--quiet"},
        {"simplify", "in.obj", "--faces", "100", "-o", "out.ply"},
        {"subdivide", "in.obj", "-o", "out.ply"},
        {"progressive", "in.obj", "-o", "out.pm"},
        {"lods", "in.obj", "-o", "out.glb"},
        {"compare", "knot", "in.obj", "--quiet"},
        {"edit", "in.obj", "--do", "subdivide", "-o", "out.ply"},
        {"render", "in.obj", "-o", "out.png"}}) {
    SCOPED_TRACE(arguments[0]);
    FileFaults faults;
    faults.change = (folder_ / "in.obj").string();
    faults.at = arguments[0] == "compare" ? 2 : 1;
    expect_refusal(arguments, faults, "in.obj");
    folder_.write("in.obj", before);
  }
}

}  // namespace
}  // namespace mesher::test
