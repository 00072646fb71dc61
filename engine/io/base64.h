#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/progress.h"

namespace mesher::io {

/// Returns the bytes that a base64 text encodes (RFC 4648, with or without padding). Returns
/// nothing if the text has a character outside the alphabet or an impossible length. O(n).
/// Throws Cancelled.
std::optional<std::string> decode_base64(std::string_view text, Progress* progress = nullptr);

/// Encodes bytes as base64 and passes them to `Sink::write` piece by piece.
template <class Sink>
class Base64Writer {
 public:
  explicit Base64Writer(Sink& sink) : sink_(sink) {}

  void write(std::string_view bytes) {
    text_.clear();
    for (const char byte : bytes) {
      bits_ = bits_ << 8 | static_cast<unsigned char>(byte);
      if (++held_ == 3) flush();
    }
    sink_.write(text_);
  }
  /// Writes the remaining bytes, padded. Call it once, at the end.
  void finish() {
    if (held_ == 0) return;
    text_.clear();
    const int missing = 3 - held_;
    bits_ <<= 8 * missing;
    flush();
    text_.replace(text_.size() - static_cast<std::size_t>(missing), std::string::npos,
                  static_cast<std::size_t>(missing), '=');
    sink_.write(text_);
  }

 private:
  void flush() {
    static constexpr char kAlphabet[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int shift = 18; shift >= 0; shift -= 6)
      text_ += kAlphabet[(bits_ >> shift) & 63U];
    bits_ = 0;
    held_ = 0;
  }

  Sink& sink_;
  std::string text_;
  std::uint32_t bits_ = 0;
  int held_ = 0;
};

}  // namespace mesher::io
