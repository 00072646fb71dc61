#pragma once

#include <cstdint>
#include <string_view>

#include "engine/io/mapped_file.h"

namespace mesher {

/// The start of a file's text: behind the byte order mark that some editors put first.
const char* text_start(const MappedFile& file);

/// Walks through the words and numbers of a text file and fails with the line where something else
/// stands. A comment runs from '#' to the end of the line.
class TextCursor {
 public:
  TextCursor(const MappedFile& file, const char* start) : file_(file), p_(start) {}

  const char* position() const { return p_; }
  /// Bytes from here to the end of the file: a bound on what can still be said.
  std::size_t bytes_left() const { return static_cast<std::size_t>(file_.end() - p_); }

  /// Skips white space, line ends and comments; true where nothing follows.
  bool at_end();
  /// Skips blanks; true at a comment, the end of the line or the end of the file.
  bool at_line_end();
  /// The same for files whose lines end in a carriage return alone.
  bool at_row_end();
  /// Goes to the start of the next line.
  void skip_line();

  // The next word or number, on this line or a later one. Each throws InputError where the file
  // ends or something else follows.

  std::string_view word();
  float number();
  double wide_number();
  std::int64_t integer();

  /// Throws InputError with the line of the word that was read last.
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  void expect_more();

  const MappedFile& file_;
  const char* p_;
  const char* last_ = p_;  ///< start of the word that was read last
};

}  // namespace mesher
