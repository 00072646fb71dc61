// Tests the limits for models from strangers: --max-memory, --timeout and --max-faces.
#include <chrono>
#include <string>

#include "tests/app/program_test.h"

namespace mesher::test {
namespace {

class Limits : public ProgramTest {
 protected:
  /// Expects exit code `code`, one line on stderr that holds `words`, and no output file.
  void expect_refusal(const Finished& run, int code, const std::string& words) {
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_TRUE(run.err.starts_with("mesher: ")) << run.err;
    EXPECT_TRUE(holds(run.err, words)) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.ply"));
  }

  void write_knot() {
    for (const char* format : {"obj", "ply", "stl", "off", "gltf", "glb"}) {
      ASSERT_EQ(mesher({"convert", "knot", std::string("knot.") + format, "--quiet"}).exit_code, 0);
    }
    ASSERT_EQ(mesher({"progressive", "knot", "knot.pm", "--quiet"}).exit_code, 0);
  }
};

TEST_F(Limits, MaxFacesHoldsForEveryFormat) {
  write_knot();
  for (const char* format : {"obj", "ply", "stl", "off", "gltf", "glb", "pm"}) {
    SCOPED_TRACE(format);
    const std::string file = std::string("knot.") + format;
    const Finished run = mesher({"info", file, "--max-faces", "1000"});
    expect_refusal(run, 2, file + ": has ");
    EXPECT_TRUE(holds(run.err, "--max-faces allows 1,000\n")) << run.err;
    EXPECT_EQ(mesher({"info", file, "--max-faces", "100000"}).exit_code, 0);
    expect_refusal(mesher({"edit", file, "out.ply", "--do", "subdivide", "--max-faces", "1000"}), 2,
                   file + ": has ");
  }
}

TEST_F(Limits, MaxFacesCountsTrianglesOfPolygons) {
  folder_.write("quads.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(mesher({"info", "quads.obj", "--max-faces", "2"}).exit_code, 0);
  expect_refusal(mesher({"info", "quads.obj", "--max-faces", "1"}), 2, "quads.obj: has 2 faces");
}

TEST_F(Limits, MaxFacesHoldsForResults) {
  expect_refusal(mesher({"subdivide", "cube", "out.ply", "--levels", "3", "--max-faces", "700"}), 2,
                 "the subdivided mesh has 768 faces or more; --max-faces allows 700");
  expect_refusal(mesher({"edit", "cube", "out.ply", "--do", "subdivide; subdivide; subdivide",
                         "--max-faces", "700"}),
                 2, "the subdivided mesh has 768 faces");
  EXPECT_EQ(
      mesher({"subdivide", "cube", "ok.ply", "--levels", "3", "--max-faces", "768"}).exit_code, 0);
}

TEST_F(Limits, MaxMemoryRefusesLargeModelsWithFigures) {
  write_knot();
  ASSERT_EQ(mesher({"subdivide", "knot", "big.ply", "--levels", "2", "--quiet"}).exit_code, 0);
  const Finished run = mesher({"convert", "big.ply", "out.ply", "--max-memory", "2MB"});
  expect_refusal(run, 2, "big.ply: --max-memory is 2 MB, of which ");
  EXPECT_TRUE(holds(run.err, "more are needed\n")) << run.err;
  EXPECT_EQ(mesher({"convert", "big.ply", "ok.ply", "--max-memory", "1GB"}).exit_code, 0);
}

TEST_F(Limits, MaxMemoryHoldsForEveryCommand) {
  ASSERT_EQ(mesher({"subdivide", "knot", "big.ply", "--levels", "2", "--quiet"}).exit_code, 0);
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"info", "big.ply"},
           {"simplify", "big.ply", "-o", "out.ply", "--faces", "100"},
           {"subdivide", "big.ply", "out.ply"},
           {"progressive", "big.ply", "out.pm"},
           {"lods", "big.ply", "-o", "out.ply"},
           {"compare", "big.ply", "cube"},
           {"edit", "big.ply", "out.ply", "--do", "subdivide"},
           {"render", "big.ply", "-o", "out.png"}}) {
    SCOPED_TRACE(command[0]);
    std::vector<std::string> limited = command;
    limited.insert(limited.end(), {"--max-memory", "2MB"});
    expect_refusal(mesher(limited), 2, "--max-memory is 2 MB");
  }
}

TEST_F(Limits, MaxMemoryRefusesASubdivisionBeforeItBegins) {
  expect_refusal(mesher({"subdivide", "cube", "out.ply", "--levels", "9", "--max-memory", "100MB"}),
                 2, "the limit is four fifths of the ");
  const Finished run =
      mesher({"subdivide", "cube", "out.ply", "--levels", "9", "--max-memory", "100MB"});
  EXPECT_TRUE(holds(run.err, "that --max-memory leaves\n")) << run.err;
  EXPECT_TRUE(holds(run.err, "subdividing 9 times would make 3,145,728 faces, which needs "))
      << run.err;
}

TEST_F(Limits, MaxMemoryHoldsForPipes) {
  const Finished run = shell(
      "head -c 40000000 /dev/zero | tr '\\0' '#' | "
      "mesher info - --format obj --max-memory 10MB");
  expect_refusal(run, 2, "/dev/stdin: --max-memory is 10 MB");
}

TEST_F(Limits, TimeoutStopsAPipeThatSendsNothing) {
  for (const char* input : {"-", "- --input-format obj", "- --input-format pm"}) {
    SCOPED_TRACE(input);
    const auto begin = std::chrono::steady_clock::now();
    const Finished run =
        shell(std::string("mkfifo p; sleep 60 >p & pid=$!; mesher convert ") + input +
              " out.ply --timeout 0.3 <p; code=$?; kill $pid; rm p; exit $code");
    expect_refusal(run, 5, "mesher: stopped after 300 ms (--timeout)\n");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  }
}

TEST_F(Limits, TimeoutStopsWorkAndLeavesNoFile) {
  const Finished run =
      mesher({"subdivide", "knot", "out.ply", "--levels", "7", "--timeout", "0.2"});
  expect_refusal(run, 5, "mesher: stopped after 200 ms (--timeout)\n");
  EXPECT_EQ(folder_.count_files(), 0U);
  EXPECT_EQ(mesher({"convert", "cube", "ok.ply", "--timeout", "60"}).exit_code, 0);
}

TEST_F(Limits, TimeoutStopsAnOutputThatNobodyReads) {
  const Finished run = shell(
      "mkfifo q; sleep 60 <q & pid=$!; mesher subdivide knot /dev/fd/5 --levels 3 --format obj "
      "--quiet --timeout 0.5 5>q; code=$?; kill $pid; exit $code");
  EXPECT_EQ(run.exit_code, 5) << run.err;
  EXPECT_EQ(run.err, "mesher: stopped after 500 ms (--timeout)\n");
}

TEST_F(Limits, BadLimitsAreUsageErrors) {
  for (const std::vector<std::string>& limit :
       std::vector<std::vector<std::string>>{{"--max-memory", "lots"},
                                             {"--max-memory", "0"},
                                             {"--max-memory", "5XB"},
                                             {"--timeout", "-1"},
                                             {"--timeout", "0"},
                                             {"--max-faces", "0"},
                                             {"--max-faces", "x"}}) {
    std::vector<std::string> arguments{"info", "cube"};
    arguments.insert(arguments.end(), limit.begin(), limit.end());
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 1) << limit[0] << " " << limit[1];
    EXPECT_TRUE(run.err.starts_with("mesher: ")) << run.err;
  }
}

}  // namespace
}  // namespace mesher::test
