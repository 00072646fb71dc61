// Tests what `mesher --version` says.
#include "app/cli/version.h"

#include "tests/app/program_test.h"

namespace mesher::test {
namespace {

using Version = ProgramTest;

TEST_F(Version, NamesVersionAndDevice) {
  const Finished run = mesher({"--version"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out.find("mesher 0."), 0U) << run.out;
  EXPECT_NE(run.out.find("\nVulkan device: "), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find("none"), std::string::npos) << run.out;
}

TEST_F(Version, WorksWithoutDevice) {
  const Finished run =
      mesher({"--version"}, {"VK_ICD_FILENAMES=/none.json", "VK_DRIVER_FILES=/none.json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("\nVulkan device: none: "), std::string::npos) << run.out;
}

}  // namespace
}  // namespace mesher::test
