#pragma once

#include <bitset>
#include <cstddef>
#include <string_view>
#include <vector>

namespace mesher::app {

/// The first and the last of consecutive code points.
struct CodeRange {
  char32_t first;
  char32_t last;
  friend bool operator==(const CodeRange&, const CodeRange&) = default;
};

/// A set of Unicode code points below U+10000, which are those that ImGui can draw.
class CodePoints {
 public:
  static constexpr char32_t kEnd = 0x10000;
  /// Stands for a byte that is not UTF-8, and for a code point that cannot be drawn.
  static constexpr char32_t kReplacement = 0xFFFD;
  /// The code points below are in the font from the start: Basic Latin and Latin-1.
  static constexpr char32_t kLatinEnd = 0x100;

  /// Ignores code points that ImGui cannot draw.
  void add(char32_t code_point) {
    if (code_point < kEnd) bits_.set(code_point);
  }
  /// Adds the code points of a UTF-8 text that are not Latin. Invalid bytes and code points that
  /// ImGui cannot draw count as kReplacement.
  void add_text(std::string_view text);
  void clear() { bits_.reset(); }

  bool has(char32_t code_point) const { return code_point < kEnd && bits_.test(code_point); }
  bool is_empty() const { return bits_.none(); }
  std::size_t count() const { return bits_.count(); }
  /// Returns whether all of `other` are in this set.
  bool has_all(const CodePoints& other) const { return (other.bits_ & ~bits_).none(); }

  void add(const CodePoints& other) { bits_ |= other.bits_; }
  void remove(const CodePoints& other) { bits_ &= ~other.bits_; }
  void keep(const CodePoints& other) { bits_ &= other.bits_; }
  /// Keeps the `most` lowest code points.
  void truncate(std::size_t most);

  /// Returns the set as ranges, in ascending order.
  std::vector<CodeRange> ranges() const;

  friend bool operator==(const CodePoints&, const CodePoints&) = default;

 private:
  std::bitset<kEnd> bits_;
};

}  // namespace mesher::app
