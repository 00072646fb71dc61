#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"

namespace mesher::io {

/// The bytes of a written document: ranges of the input's buffers as they were, and new pieces.
/// Ranges that overlap are written once. Each byte keeps its place within a word of 4 bytes, so
/// what was aligned stays aligned.
class GltfData {
 public:
  /// Keeps `bytes`, which begin at `offset` of an input buffer. They must stay valid.
  void keep(std::uint64_t buffer, std::uint64_t offset, std::string_view bytes) {
    ranges_.push_back({buffer, offset, bytes});
  }
  /// Adds a piece and returns its number.
  std::size_t add(std::string&& bytes) {
    pieces_.push_back(std::move(bytes));
    return pieces_.size() - 1;
  }
  /// Gives everything its place. O(n log n). Nothing may be added after that.
  void arrange();
  /// Returns the new offset of a byte that is kept.
  std::uint64_t offset(std::uint64_t buffer, std::uint64_t offset) const;
  /// Returns the offset of a piece.
  std::uint64_t piece_offset(std::size_t piece) const { return piece_offsets_[piece]; }
  std::uint64_t piece_bytes(std::size_t piece) const { return pieces_[piece].size(); }
  std::uint64_t size() const { return size_; }

  /// Writes all bytes. `Sink` has write(std::string_view). Throws Cancelled.
  template <class Sink>
  void write(Sink& sink, Progress* progress) const {
    std::uint64_t at = 0;
    const auto put = [&](std::uint64_t offset, std::string_view bytes) {
      static constexpr std::string_view kZeros("\0\0\0\0\0\0\0", 7);
      sink.write(kZeros.substr(0, offset - at));
      at = offset + bytes.size();
      constexpr std::size_t kBlock = std::size_t{1} << 20;
      for (; !bytes.empty(); bytes.remove_prefix(std::min(kBlock, bytes.size()))) {
        report(progress, static_cast<float>(double(at - bytes.size()) / double(size_)));
        sink.write(bytes.substr(0, kBlock));
      }
    };
    for (std::size_t i = 0; i < ranges_.size(); ++i)
      put(range_offsets_[i], ranges_[i].bytes);
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      put(piece_offsets_[i], pieces_[i]);
    put(size_, {});
  }

 private:
  struct Range {
    std::uint64_t buffer;
    std::uint64_t offset;
    std::string_view bytes;
  };

  std::vector<Range> ranges_;
  std::vector<std::uint64_t> range_offsets_;
  std::vector<std::string> pieces_;
  std::vector<std::uint64_t> piece_offsets_;
  std::uint64_t size_ = 0;
};

}  // namespace mesher::io
