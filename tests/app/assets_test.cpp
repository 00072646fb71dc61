// Checks that the program makes the committed bunnies from the full one.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace mesher::test {
namespace {

const std::filesystem::path kAssetFolder = MESHER_SOURCE_DIR "/assets";

void expect_made_by_the_program(const std::string& name, const std::string& faces) {
  const std::filesystem::path full = kAssetFolder / "bunny_70k.obj";
  if (!std::filesystem::exists(full)) {
    std::cerr << "*** NOT TESTED: " << full << " is missing ***\n";
    return;
  }
  const TempFolder folder;
  const Finished run = run_program({MESHER_PROGRAM, "simplify", full.string(), "--faces", faces,
                                    "-o", (folder / name).string(), "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(read_bytes(folder / name) == read_bytes(kAssetFolder / name))
      << name << " differs from the program's output; if simplification was changed on purpose, "
      << "run scripts/make_bunnies";
}

TEST(Assets, Bunny1kMatchesSimplifyOutput) {
  expect_made_by_the_program("bunny_1k.obj", "1000");
}

TEST(Assets, Bunny200MatchesSimplifyOutput) {
  expect_made_by_the_program("bunny_200.obj", "200");
}

}  // namespace
}  // namespace mesher::test
