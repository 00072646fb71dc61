#include "engine/io/spool.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "engine/core/error.h"
#include "engine/core/memory.h"

namespace mesher::io {
namespace {

/// A pipe or a pair of sockets, whose ends close with it.
struct TwoEnds {
  int output = -1;
  int input = -1;
  explicit TwoEnds(bool is_socket) {
    int ends[2];
    const int failed = is_socket ? socketpair(AF_UNIX, SOCK_STREAM, 0, ends) : pipe(ends);
    EXPECT_EQ(failed, 0);
    output = ends[0];
    input = ends[1];
  }
  ~TwoEnds() {
    close(output);
    end();
  }
  void write(const std::string& bytes) const {
    EXPECT_EQ(::write(input, bytes.data(), bytes.size()), ssize_t(bytes.size()));
  }
  void end() {
    if (input >= 0) close(input);
    input = -1;
  }
};

TEST(Peek, HalfClosedSocketHasEnded) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  ASSERT_EQ(::write(ends[0], "v 0", 3), 3);
  ASSERT_EQ(::shutdown(ends[0], SHUT_WR), 0);
  EXPECT_EQ(io::peek(ends[1], 4096, nullptr), "v 0") << "the other end still waits for an answer";
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Spool, PeekConsumesNothing) {
  for (const bool is_socket : {false, true}) {
    TwoEnds ends(is_socket);
    ends.write("abcdef");
    EXPECT_EQ(peek(ends.output, 4, nullptr), "abcd");
    EXPECT_EQ(peek(ends.output, 6, nullptr), "abcdef");
    ends.end();
    EXPECT_EQ(peek(ends.output, 100, nullptr), "abcdef") << "all that there is";
  }
}

TEST(Spool, PeekWaitsForSlowWriters) {
  TwoEnds ends(false);
  std::thread writer([&] {
    for (const char* part : {"a", "b", "c"}) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      ends.write(part);
    }
  });
  EXPECT_EQ(peek(ends.output, 3, nullptr), "abc");
  writer.join();
}

TEST(Spool, PipeBecomesAFileThatCanBeReadAgain) {
  for (const bool is_socket : {false, true}) {
    TwoEnds ends(is_socket);
    const std::string bytes(300'000, 'x');
    std::thread writer([&] {
      ends.write(bytes);
      ends.end();
    });
    spool(ends.output, "pipe", nullptr);
    writer.join();
    EXPECT_EQ(lseek(ends.output, 0, SEEK_END), off_t(bytes.size()));
    EXPECT_EQ(peek(ends.output, bytes.size(), nullptr), bytes);
  }
}

TEST(Spool, CountsForTheMemoryLimit) {
  TwoEnds ends(false);
  std::thread writer([&] {
    ends.write(std::string(60'000, 'x'));
    ends.end();
  });
  const MemoryLimit limit(50'000, MemoryLimit::Of::everything);
  EXPECT_THROW(spool(ends.output, "pipe", nullptr), LimitError);
  writer.join();
}

TEST(Spool, SilentPipeCanBeCanceled) {
  const TwoEnds ends(false);
  Progress progress;
  progress.cancel();
  EXPECT_THROW(spool(ends.output, "pipe", &progress), Cancelled);
  EXPECT_THROW(static_cast<void>(peek(ends.output, 1, &progress)), Cancelled);
}

}  // namespace
}  // namespace mesher::io
