#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "engine/core/parallel.h"
#include "tests/fuzz/support.h"
#include "tests/support/temp_folder.h"
#include "tests/support/zoo.h"

namespace mesher {
namespace {

using test::read_or_refuse;
using test::rewrite_or_refuse;
using test::Specimen;
using test::TempFolder;
using test::Watchdog;

constexpr int kMutants = 1500;
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
    int read = 0;
    for (int i = 0; i < kMutants; ++i) {
      const std::string bytes = mutator.mutate(sound.bytes);
      SCOPED_TRACE(sound.name + " mutant " + std::to_string(i) + ":\n" + printable(bytes));
      const auto file = folder.write("mutant" + sound.extension, bytes);
      if (read_or_refuse(file)) ++read;
      if (sound.extension.starts_with(".gl")) rewrite_or_refuse(file);
      if (testing::Test::HasFailure()) return;  // the first failure is enough
    }
    // If all mutants were read, or none, the mutations would test nothing.
    EXPECT_GT(read, 0) << sound.name;
    EXPECT_LT(read, kMutants) << sound.name;
  }
}

}  // namespace
}  // namespace mesher
