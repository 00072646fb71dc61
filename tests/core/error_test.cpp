#include "engine/core/error.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace mesher {
namespace {

TEST(Error, InputErrorMessageHasFileLineAndReason) {
  const InputError error("bunny.obj", 12, "vertex 99 does not exist");
  EXPECT_STREQ(error.what(), "bunny.obj:12: vertex 99 does not exist");
  EXPECT_EQ(error.file(), "bunny.obj");
  EXPECT_EQ(error.line(), 12U);
  EXPECT_EQ(error.reason(), "vertex 99 does not exist");
}

TEST(Error, InputErrorMessageOmitsUnknownParts) {
  EXPECT_STREQ(InputError("a.stl", 0, "empty").what(), "a.stl: empty");
  EXPECT_STREQ(InputError("", 3, "empty").what(), "line 3: empty");
  EXPECT_STREQ(InputError("empty").what(), "empty");
}

TEST(Error, OutputErrorMessageHasFileAndReason) {
  EXPECT_STREQ(OutputError("out.ply", "disk full").what(), "out.ply: disk full");
}

TEST(Error, EachErrorTypeHasItsExitCode) {
  EXPECT_EQ(UsageError("x").exit_code(), ExitCode::usage);
  EXPECT_EQ(InputError("x").exit_code(), ExitCode::bad_input);
  EXPECT_EQ(DeviceError("x").exit_code(), ExitCode::machine_lacks);
  EXPECT_EQ(OutputError("f", "x").exit_code(), ExitCode::output_failed);
}

// Scripts depend on these numbers.
TEST(Error, ExitCodesMatchTheDocumentation) {
  EXPECT_EQ(static_cast<int>(ExitCode::done), 0);
  EXPECT_EQ(static_cast<int>(ExitCode::usage), 1);
  EXPECT_EQ(static_cast<int>(ExitCode::bad_input), 2);
  EXPECT_EQ(static_cast<int>(ExitCode::machine_lacks), 3);
  EXPECT_EQ(static_cast<int>(ExitCode::output_failed), 4);
}

TEST(Error, CancelledIsNotAnError) {
  EXPECT_FALSE((std::is_base_of_v<Error, Cancelled>));
}

}  // namespace
}  // namespace mesher
