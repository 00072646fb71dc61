// Tests that no moment to end a command leaves a partial file, and what signals and power failures
// may leave.
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "tests/app/program_test.h"
#include "tests/support/file_faults.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

namespace fs = std::filesystem;

/// A command, and the files that it writes.
struct Writer {
  std::vector<std::string> arguments;
  std::vector<std::string> outputs;
};

class Kills : public ProgramTest {
 protected:
  void SetUp() override {
    folder_.write("red.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\n");
    folder_.write("red.png", std::string(100'000, 'p'));
    folder_.write("in.obj", "mtllib red.mtl\nusemtl red\n" + read_bytes(kKnot));
    fs::create_directory(folder_ / "out");
  }

  static std::vector<Writer> model_writers() {
    return {{{"convert", "in.obj", "out/m.obj"}, {"m.obj", "m.mtl", "red.png"}},
            {{"convert", "in.obj", "out/m.ply"}, {"m.ply", "red.png"}},
            {{"convert", "in.obj", "out/m.stl"}, {"m.stl"}},
            {{"convert", "in.obj", "out/m.off"}, {"m.off"}},
            {{"convert", "in.obj", "out/m.gltf"}, {"m.gltf"}},
            {{"convert", "in.obj", "out/m.glb", "--compress"}, {"m.glb"}},
            {{"simplify", "in.obj", "-o", "out/s.glb", "--faces", "500"}, {"s.glb"}},
            {{"progressive", "in.obj", "out/p.pm"}, {"p.pm"}},
            {{"lods", "in.obj", "-o", "out/l.stl", "--ratios", "1,0.5"},
             {"l_lod0.stl", "l_lod1.stl", "l.json"}},
            {{"edit", "in.obj", "-o", "out/e.ply", "--do", "subdivide"}, {"e.ply", "red.png"}}};
  }

  static std::vector<Writer> picture_writers() {
    std::vector<Writer> all;
    const auto add = [&](const std::string& name, std::vector<std::string> more,
                         std::vector<std::string> outputs) {
      std::vector<std::string> words{"render", "knot", "-o", "out/" + name, "--size", "64"};
      words.insert(words.end(), more.begin(), more.end());
      all.push_back({words, std::move(outputs)});
    };
    add("p.png", {}, {"p.png"});
    add("p.webp", {}, {"p.webp"});
    add("t.webp", {"--turntable", "--frames", "3"}, {"t.webp"});
    add("t#.png", {"--turntable", "--frames", "3"}, {"t0.png", "t1.png", "t2.png"});
    return all;
  }

  static std::vector<Writer> all_writers() {
    std::vector<Writer> all = model_writers();
    const std::vector<Writer> pictures = picture_writers();
    all.insert(all.end(), pictures.begin(), pictures.end());
    return all;
  }

  /// Files whose names begin with ".mesher-".
  std::size_t count_leftovers() const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
      count += entry.path().filename().string().starts_with(".mesher-");
    return count;
  }

  void empty_output() const {
    fs::remove_all(folder_ / "out");
    fs::create_directory(folder_ / "out");
  }

  /// Fills the folder with old files of these names.
  void write_old(const Writer& writer) const {
    empty_output();
    for (const std::string& output : writer.outputs)
      folder_.write("out/" + output, kOld);
  }

  /// What the writer makes, and how long it takes.
  struct Whole {
    std::map<std::string, std::string> bytes;
    double seconds = 0.0;
  };
  Whole run_whole(const Writer& writer, const FileFaults& faults) {
    write_old(writer);
    const auto begin = std::chrono::steady_clock::now();
    const Finished run = mesher(writer.arguments, faults.environment());
    Whole whole;
    whole.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_EQ(run.exit_code, 0) << run.err;
    for (const std::string& output : writer.outputs) {
      whole.bytes[output] = read_bytes(folder_ / ("out/" + output));
      // A file of the user's with the name of a texture stays, and the texture gets another name.
      EXPECT_TRUE(output == "red.png" || whole.bytes[output] != kOld) << output;
    }
    return whole;
  }

  void expect_no_partial_file(const Whole& whole) {
    for (const auto& [output, bytes] : whole.bytes) {
      const std::string now = read_bytes(folder_ / ("out/" + output));
      EXPECT_TRUE(now == kOld || now == bytes) << output << " has " << now.size() << " bytes";
    }
  }

  /// Ends the writers by a signal, each at `moments` random ones. Returns the number of runs that
  /// the signal ended.
  int end_at_random(int signal, int moments, const std::vector<Writer>& writers) {
    std::mt19937 random(static_cast<unsigned>(signal));
    int ended = 0;
    for (const bool has_no_tmpfile : {false, true}) {
      FileFaults faults;
      faults.has_no_tmpfile = has_no_tmpfile;
      for (const Writer& writer : writers) {
        SCOPED_TRACE(testing::PrintToString(writer.arguments) +
                     (has_no_tmpfile ? " without O_TMPFILE" : ""));
        const Whole whole = run_whole(writer, faults);
        std::uniform_real_distribution<double> moment(0.0, 1.1 * whole.seconds);
        for (int i = 0; i < moments; ++i) {
          write_old(writer);
          ended += end_at(writer, faults, signal, moment(random));
          expect_no_partial_file(whole);
          EXPECT_TRUE(signal == SIGKILL || count_leftovers() == 0U);
        }
      }
    }
    return ended;
  }

  bool end_at(const Writer& writer, const FileFaults& faults, int signal, double seconds) {
    std::vector<std::string> words{"env", "-C", folder_.path().string(), MESHER_PROGRAM};
    words.insert(words.end(), writer.arguments.begin(), writer.arguments.end());
    words.emplace_back("--quiet");
    std::vector<std::string> environment = faults.environment();
    environment.insert(environment.end(), {"DISPLAY", "WAYLAND_DISPLAY"});
    BackgroundProgram program(words, environment, -1, (folder_ / "err").string());
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    program.send(signal);
    const int code = program.wait(60.0);
    EXPECT_TRUE(code == 0 || code == 128 + signal) << code;
    return code != 0;
  }

  static constexpr const char* kKnot = MESHER_SOURCE_DIR "/assets/knot.obj";
  static constexpr const char* kOld = "what was there before";
};

// Under the sanitizers a program starts ten times slower.
constexpr int kMoments = kSanitized ? 2 : 50;

TEST_F(Kills, ThousandKillsLeaveNoPartialFile) {
  const int ended = end_at_random(SIGKILL, kMoments, model_writers());
  EXPECT_GT(ended, 2 * 10 * kMoments / 3) << "most of them came in time";
}

TEST_F(Kills, KillsLeaveNoPartialPicture) {
  EXPECT_GT(end_at_random(SIGKILL, kMoments / 12 + 1, picture_writers()), 2);
}

TEST_F(Kills, SignalsLeaveNothing) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP})
    EXPECT_GT(end_at_random(signal, kMoments / 12 + 1, model_writers()), 0);
}

TEST_F(Kills, SignalAtEachWriteLeavesNothing) {
  for (const bool has_no_tmpfile : {false, true}) {
    for (const Writer& writer : kSanitized ? model_writers() : all_writers()) {
      SCOPED_TRACE(testing::PrintToString(writer.arguments));
      for (int at = 1; at <= 3; ++at) {
        FileFaults faults;
        faults.has_no_tmpfile = has_no_tmpfile;
        faults.signal = SIGTERM;
        faults.at = at;
        empty_output();
        const Finished run = mesher(writer.arguments, faults.environment());
        const bool was_ended = run.exit_code == 128 + SIGTERM;
        EXPECT_TRUE(was_ended || (run.exit_code == 0 && at > 1)) << run.exit_code << run.err;
        EXPECT_TRUE(!was_ended || fs::is_empty(folder_ / "out"));
      }
    }
  }
}

TEST_F(Kills, IgnoredSignalsStayIgnored) {
  const Writer writer{{"convert", "in.obj", "out/m.ply"}, {"m.ply"}};
  FileFaults faults;
  faults.signal = SIGHUP;
  std::vector<std::string> words{"nohup", "env", "-C", folder_.path().string(), MESHER_PROGRAM};
  words.insert(words.end(), writer.arguments.begin(), writer.arguments.end());
  EXPECT_EQ(run_program(words, faults.environment()).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/m.ply"));
}

TEST_F(Kills, NextWriteRemovesWhatKillLeft) {
  FileFaults faults;
  faults.has_no_tmpfile = true;
  faults.signal = SIGKILL;
  const std::vector<std::string> convert{"convert", "in.obj", "out/m.ply"};
  EXPECT_EQ(mesher(convert, faults.environment()).exit_code, 128 + SIGKILL);
  EXPECT_GT(count_leftovers(), 0U);
  EXPECT_EQ(mesher(convert).exit_code, 0);
  EXPECT_EQ(count_leftovers(), 0U);
}

TEST_F(Kills, ResultIsOnTheDiskBeforeItHasItsName) {
  for (const Writer& writer : all_writers()) {
    SCOPED_TRACE(testing::PrintToString(writer.arguments));
    const std::size_t files = writer.outputs.size();
    FileFaults faults;
    faults.log = (folder_ / "log").string();
    const auto calls_of = [&](std::vector<std::string> arguments) {
      fs::remove(folder_ / "log");
      empty_output();
      const Finished run = mesher(std::move(arguments), faults.environment());
      EXPECT_EQ(run.exit_code, 0) << run.err;
      return read_bytes(folder_ / "log");
    };
    std::string expected;
    for (std::size_t i = 0; i < files; ++i)
      expected += "fsync file\n";
    for (std::size_t i = 0; i < files; ++i)
      expected += "rename\n";
    EXPECT_TRUE(calls_of(writer.arguments).ends_with(expected + "fsync folder\n"))
        << read_bytes(folder_ / "log");
    std::vector<std::string> hurried = writer.arguments;
    hurried.emplace_back("--no-fsync");
    EXPECT_FALSE(holds(calls_of(hurried), "fsync")) << read_bytes(folder_ / "log");
  }
}

}  // namespace
}  // namespace mesher::test
