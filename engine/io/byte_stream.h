#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace mesher::io {

/// Reads a file or a pipe on a thread of its own, so that the consumer never blocks. Reads at most
/// kMostAhead bytes ahead.
class ByteStream {
 public:
  using Block = std::vector<std::byte>;
  static constexpr std::size_t kBlockBytes = std::size_t{16} << 10U;
  static constexpr std::size_t kMostAhead = std::size_t{8} << 20U;

  /// Opens the file and returns at once, even for a named pipe without a writer. Such a pipe stays
  /// silent until a program opens it for writing. Throws InputError if the file cannot be opened.
  explicit ByteStream(const std::filesystem::path& file);
  /// Stops reading within a moment, even from a silent pipe.
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// Sets the function that the reading thread calls when data or the end of the file is available.
  /// Null: it calls none.
  void set_wake(void (*wake)());
  /// Returns the next block. Empty: no data is available yet, or the stream has ended.
  Block take();
  /// Returns whether `take` has data or the stream has ended.
  bool has_news() const;
  /// Returns whether all data has been taken and no more will come.
  bool is_at_end() const;
  /// Blocks until data is available or the stream has ended.
  void wait() const;
  /// Drops the data that has not been taken and stops reading within a moment.
  void close();
  /// Returns the error that stopped reading early. Empty: no error occurred.
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

}  // namespace mesher::io
