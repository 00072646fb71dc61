#include "engine/io/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/core/error.h"
#include "tests/support/sanitized.h"

namespace mesher::io {
namespace {

TEST(ChildProcess, ReturnsWhatTheWorkWrites) {
  const std::string expected(300000, 'x');
  const ChildResult result = run_in_child(
      [&](const ChildWriter& write) {
        for (std::size_t i = 0; i < expected.size(); i += 1000) {
          if (!write(expected.substr(i, 1000))) return false;
        }
        return true;
      },
      {});
  EXPECT_EQ(result.outcome, ChildOutcome::done);
  EXPECT_EQ(result.bytes, expected);
}

TEST(ChildProcess, RefusalsAndExceptionsStayInTheChild) {
  EXPECT_EQ(run_in_child([](const ChildWriter&) { return false; }, {}).outcome,
            ChildOutcome::refused);
  EXPECT_EQ(run_in_child(
                [](const ChildWriter&) -> bool { throw std::runtime_error("in the library"); }, {})
                .outcome,
            ChildOutcome::refused);
}

TEST(ChildProcess, CrashKillsOnlyTheChild) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGILL}) {
    const ChildResult result = run_in_child(
        [&](const ChildWriter& write) {
          write("some bytes");
          return std::raise(signal) == 0;
        },
        {});
    EXPECT_EQ(result.outcome, ChildOutcome::died) << signal;
    EXPECT_TRUE(result.bytes.empty());
  }
}

TEST(ChildProcess, LimitsEndTheChild) {
  EXPECT_EQ(run_in_child(
                [](const ChildWriter& write) {
                  while (write(std::string(1000, 'x'))) {
                  }
                  return true;
                },
                {.output = 1 << 20})
                .outcome,
            ChildOutcome::too_long);
  EXPECT_EQ(run_in_child(
                [](const ChildWriter&) {
                  const volatile bool runs = true;
                  while (runs) {
                  }
                  return true;
                },
                {.cpu_s = 1})
                .outcome,
            ChildOutcome::died);
  if (test::kSanitized) return;  // its memory cannot be limited
  EXPECT_EQ(run_in_child(
                [](const ChildWriter&) {
                  std::vector<char> all(std::size_t{1} << 30);
                  return all[12345] == 0;
                },
                {.memory = std::size_t{1} << 28})
                .outcome,
            ChildOutcome::refused);
}

TEST(ChildProcess, CancellationKillsTheChild) {
  Progress progress;
  std::thread canceling([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.cancel();
  });
  EXPECT_THROW(run_in_child(
                   [](const ChildWriter&) {
                     ::sleep(1000);
                     return true;
                   },
                   {}, &progress),
               Cancelled);
  canceling.join();
}

}  // namespace
}  // namespace mesher::io
