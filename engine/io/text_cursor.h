#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/io/mapped_file.h"

namespace mesher::io {

/// Returns the start of a file's text, after the byte order mark that some editors write. Throws
/// InputError if the mark is that of UTF-16, which mesher does not read.
const char* text_start(const MappedFile& file);

/// Reads the words and numbers of a text file one by one. Throws InputError with the line if the
/// text does not match. A comment runs from '#' to the end of the line.
class TextCursor {
 public:
  TextCursor(const MappedFile& file, const char* start) : file_(file), p_(start) {}

  const char* position() const { return p_; }
  /// Returns the number of bytes up to the end of the file: a bound on the elements still to come.
  std::size_t bytes_left() const { return static_cast<std::size_t>(file_.end() - p_); }

  /// Skips white space, line ends and comments. Returns true at the end of the file.
  bool at_end();
  /// Skips blanks. Returns true at a comment, the end of the line or the end of the file.
  bool at_line_end();
  /// Does the same as at_line_end for files whose lines end in a lone carriage return.
  bool at_row_end();
  /// Reads the next number on this line. Returns nothing at its end, or if the next word is no
  /// number. `is_whole`: it has no decimal point.
  std::optional<double> number_on_line(bool& is_whole);
  /// Goes to the start of the next line.
  void skip_line();

  // The next word or number, on this line or a later one. Each throws InputError at the end of the
  // file or if the next word has another form.

  std::string_view word();
  float number();
  /// As number, and raises `error` to the distance of the result from the number as written.
  float coordinate(double& error);
  double wide_number();
  std::int64_t integer();

  /// Throws InputError with the line of the last word read.
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  void expect_more();
  void take_number(const char* end);

  const MappedFile& file_;
  const char* p_;
  const char* last_ = p_;  ///< start of the last word read
};

}  // namespace mesher::io
