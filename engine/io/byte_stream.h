#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace mesher {

/// The bytes of a file or a pipe, read on a thread of its own as they come: whoever takes them
/// never waits. Reads no further ahead than kMostAhead.
class ByteStream {
 public:
  using Block = std::vector<std::byte>;
  static constexpr std::size_t kBlockBytes = std::size_t{16} << 10U;
  static constexpr std::size_t kMostAhead = std::size_t{8} << 20U;

  /// Returns at once, even for a named pipe that nobody has opened for writing yet: that one is
  /// silent until somebody does. Throws InputError where the file cannot be opened.
  explicit ByteStream(const std::filesystem::path& file);
  /// Ends the reading within a moment, even of a pipe that is silent.
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// `wake` is called from the thread, from now on, when there is something to take, or the end.
  /// Null: nothing is.
  void set_wake(void (*wake)());
  /// What comes next; empty: nothing is there yet, or nothing more comes.
  Block take();
  /// There is something to take, or the end.
  bool has_news() const;
  /// All has been taken, and no more comes.
  bool is_at_end() const;
  /// Returns when there is something to take, or the end.
  void wait() const;
  /// Nobody wants more: what waits is dropped, and reading ends within a moment.
  void close();
  /// Why reading ended before the end; empty: it did not.
  std::string failure() const;

 private:
  void run();
  void tell();
  bool read_block();
  bool put(Block&& block);
  bool has_room() const { return waiting_bytes_ < kMostAhead || is_stopped_; }

  std::filesystem::path file_;
  int descriptor_ = -1;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<Block> blocks_;
  std::size_t waiting_bytes_ = 0;
  void (*wake_)() = nullptr;
  bool is_done_ = false;
  bool is_stopped_ = false;
  std::string failure_;
  std::thread thread_;
};

}  // namespace mesher
