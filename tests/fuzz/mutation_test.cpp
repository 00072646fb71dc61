#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/io/write.h"
#include "tests/fuzz/support.h"
#include "tests/support/temp_folder.h"
#include "tests/support/zoo.h"

namespace mesher {
namespace {

using test::edit_scene_or_refuse;
using test::read_or_refuse;
using test::rewrite_or_refuse;
using test::Specimen;
using test::TempFolder;
using test::Watchdog;

constexpr int kMutants = 1500;
/// Half way through the animation of the sample that has one.
const io::ReadOptions kPosed{.pose = io::PoseChoice{.animation = "0", .time_s = 0.5}};
constexpr std::chrono::seconds kFormatTimeLimit(120);  // for all mutants of a format

/// Numbers and words that are known to break parsers.
const std::vector<std::string> kTokens = {"0",
                                          "-1",
                                          "4294967295",
                                          "4294967296",
                                          "2147483648",
                                          "-2147483649",
                                          "18446744073709551615",
                                          "1e999",
                                          "nan",
                                          "inf",
                                          "-",
                                          "/",
                                          "//",
                                          "\\\n",
                                          "\n",
                                          "\r",
                                          std::string(1, '\0'),
                                          "\xFF\xFF\xFF\xFF",
                                          "\x7F\xFF\xFF\xFF",
                                          "[",
                                          "}",
                                          "\"",
                                          "f",
                                          "v ",
                                          "#",
                                          "1e-400",
                                          "0x10",
                                          "99999999999999999999"};

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutate(std::string bytes) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes && !bytes.empty(); ++i)
      change(bytes);
    return bytes;
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  void change(std::string& bytes) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(bytes.size() - at, 1 + below(16));
    const std::string& token = kTokens[below(kTokens.size())];
    switch (below(7)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
        break;
      case 1:
        bytes[at] = static_cast<char>(random_());
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      case 4:
        bytes.replace(at, std::min(token.size(), bytes.size() - at), token);
        break;
      case 5:
        bytes.insert(at, token);
        break;
      default:
        bytes.resize(at);
        break;
    }
  }

  std::mt19937 random_;
};

std::string printable(const std::string& bytes) {
  std::string text;
  for (const char c : bytes)
    text += c == '\n' || (c >= ' ' && c < 127) ? c : '?';
  return text;
}

TEST(Mutation, EveryMutantIsReadOrRejected) {
  const ThreadLimit one(1);  // waking a second thread takes longer than reading a few hundred bytes
  for (const Specimen& sound : test::sound_files()) {
    const Watchdog watchdog(sound.name, kFormatTimeLimit);
    const TempFolder folder;
    Mutator mutator(20240501);
    const bool is_animated = sound.bytes.find("animations") != std::string::npos;
    int read = 0;
    int posed = 0;
    for (int i = 0; i < kMutants; ++i) {
      const std::string bytes = mutator.mutate(sound.bytes);
      SCOPED_TRACE(sound.name + " mutant " + std::to_string(i) + ":\n" + printable(bytes));
      const auto file = folder.write("mutant" + sound.extension, bytes);
      if (read_or_refuse(file)) ++read;
      if (sound.extension.starts_with(".gl")) {
        rewrite_or_refuse(file);
        edit_scene_or_refuse(file);
      }
      if (is_animated && read_or_refuse(file, nullptr, kPosed)) ++posed;
      if (testing::Test::HasFailure()) return;  // the first failure is enough
    }
    // If all mutants were read, or none, the mutations would test nothing.
    EXPECT_GT(read, 0) << sound.name;
    EXPECT_LT(read, kMutants) << sound.name;
    if (!is_animated) continue;
    EXPECT_GT(posed, 0) << sound.name;
    EXPECT_LT(posed, read) << "no mutant broke the animation alone";
  }
}

// The look of a file must not cost its shape.
TEST(Mutation, NoMutantOfAMaterialFileCostsTheMesh) {
  const ThreadLimit one(1);
  const Watchdog watchdog("MTL", kFormatTimeLimit);
  const TempFolder folder;
  const auto obj = folder.write(
      "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
  folder.write("a.png", "\x89PNG\r\n\x1A\n");
  const std::string sound =
      "newmtl a\nKd 1 .5 0\nNs 10\nd 0.5\nillum 2\nmap_Kd -s 2 2 1 -o 0 .5 -clamp on a.png\n"
      "newmtl b\nTr 0.2\nKe 1 1 \\\n1\nnorm -bm 0.5 a.png\nmap_Pr -imfchan g a.png\n"
      "map_Pm -imfchan b a.png\nbump \"b c.png\"\n";
  Mutator mutator(20261130);
  for (int i = 0; i < kMutants; ++i) {
    const std::string bytes = mutator.mutate(sound);
    SCOPED_TRACE("mutant " + std::to_string(i) + ":\n" + printable(bytes));
    folder.write("m.mtl", bytes);
    const auto model = read_or_refuse(obj);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->mesh.face_count(), 2U);
    for (const char* name : {"o/m.obj", "o/m.glb"}) {
      std::filesystem::create_directory(folder / "o");
      io::write_model(folder / name, model->mesh, model->attributes,
                      {.materials = model->materials});
      EXPECT_TRUE(read_or_refuse(folder / name));
    }
    std::filesystem::remove_all(folder / "o");
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace mesher
