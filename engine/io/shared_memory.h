#pragma once

#include <cstddef>
#include <cstdint>

namespace mesher::io {

/// Memory that child processes started later (Child) share with this one, so that results need no
/// pipe. It begins as zeros, and pages that are never touched cost nothing.
class SharedMemory {
 public:
  /// Throws std::bad_alloc.
  explicit SharedMemory(std::size_t bytes);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  std::uint8_t* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  std::size_t size_;
  std::uint8_t* data_;
};

}  // namespace mesher::io
