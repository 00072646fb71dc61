#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/assert.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/io/far_origin.h"

namespace mesher::io {

/// A growing buffer of text or binary data. `need` makes room; appending does not check for it.
class Appender {
 public:
  void clear() { size_ = 0; }
  /// Makes room for `bytes` more bytes.
  void need(std::size_t bytes) {
    if (storage_.size() - size_ < bytes) storage_.resize(2 * storage_.size() + bytes);
  }
  std::string_view text() const { return {storage_.data(), size_}; }

  Appender& operator<<(char c) {
    *put(1) = c;
    return *this;
  }
  Appender& operator<<(std::string_view text) {
    std::memcpy(put(text.size()), text.data(), text.size());
    return *this;
  }
  /// Appends a decimal number of at most 10 characters.
  Appender& operator<<(std::uint32_t value) { return number(value, 10); }
  /// Appends the shortest decimal that reads back as the same float: at most 15 characters.
  Appender& operator<<(float value) { return number(value, 15); }
  /// Appends at most 25 characters.
  Appender& operator<<(const FarCoordinate& coordinate) {
    constexpr std::size_t kMost = 25;
    char* const p = storage_.data() + size_;
    MESHER_ASSERT(kMost <= storage_.size() - size_);
    size_ += static_cast<std::size_t>(write_far_coordinate(coordinate, p, p + kMost) - p);
    return *this;
  }
  /// Appends the bytes of a number as they are in memory (little-endian on all supported machines).
  template <class T>
  Appender& raw(const T& value) {
    std::memcpy(put(sizeof value), &value, sizeof value);
    return *this;
  }

 private:
  char* put(std::size_t bytes) {
    MESHER_ASSERT(bytes <= storage_.size() - size_);
    size_ += bytes;
    return storage_.data() + size_ - bytes;
  }
  template <class T>
  Appender& number(T value, std::size_t most) {
    char* const p = storage_.data() + size_;
    MESHER_ASSERT(most <= storage_.size() - size_);
    size_ += static_cast<std::size_t>(std::to_chars(p, p + most, value).ptr - p);
    return *this;
  }

  Array<char> storage_;
  std::size_t size_ = 0;
};

/// Writes `count` elements in order. `format(appender, i)` appends element i.
///
/// Elements are formatted in parallel, one block at a time, so memory stays at a few megabytes for
/// any count. Before each element the buffer has room for `most_bytes`; `format` may ask for more.
/// The output does not depend on the number of threads. `Sink` must have `write(std::string_view)`:
/// an AtomicFile, or an encoder that writes to one.
/// Reports the written elements, and throws Cancelled; `progress` may be null.
template <class Sink, class Format>
void write_elements(Sink& sink, std::size_t count, std::size_t most_bytes, Progress* progress,
                    Format&& format) {
  constexpr std::size_t kBlock = std::size_t{1} << 13;
  constexpr std::size_t kBlocksAtOnce = 16;
  std::vector<Appender> blocks(std::min(kBlocksAtOnce, chunk_count(count, kBlock)));
  for (std::size_t begin = 0; begin < count; begin += kBlock * kBlocksAtOnce) {
    report(progress, static_cast<float>(begin) / static_cast<float>(count));
    const std::size_t elements = std::min(count - begin, kBlock * kBlocksAtOnce);
    parallel_chunks(elements, kBlock, [&](std::size_t block, IndexRange range) {
      Appender& out = blocks[block];
      out.clear();
      for (std::size_t i = range.begin; i < range.end; ++i) {
        out.need(most_bytes);
        format(out, begin + i);
      }
    });
    for (std::size_t block = 0; block < chunk_count(elements, kBlock); ++block) {
      sink.write(blocks[block].text());
    }
  }
}

}  // namespace mesher::io
