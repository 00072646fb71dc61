#include "engine/io/text_cursor.h"

#include <cstring>

#include "engine/core/error.h"
#include "engine/io/scan.h"

namespace mesher::io {

const char* text_start(const MappedFile& file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (file.bytes().starts_with("\xFF\xFE") || file.bytes().starts_with("\xFE\xFF")) {
    throw InputError(file.name(), 0, "is UTF-16 text; save it as UTF-8");
  }
  return file.begin() + (file.bytes().starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}

bool TextCursor::at_end() {
  for (;;) {
    if (!at_line_end()) return false;
    if (p_ >= file_.end()) return true;
    skip_line();
  }
}

bool TextCursor::at_line_end() {
  p_ = scan::skip_blanks(p_);
  return *p_ == '\n' || *p_ == '#' || p_ >= file_.end();
}

bool TextCursor::at_row_end() {
  while (*p_ == ' ' || *p_ == '\t')
    ++p_;
  return *p_ == '\r' || at_line_end();
}

std::optional<double> TextCursor::number_on_line(bool& is_whole) {
  if (at_line_end()) return std::nullopt;
  double value = 0.0;
  const char* const next = scan::read_double(p_, value);
  if (next == nullptr || *next == '#') return std::nullopt;
  is_whole = std::memchr(p_, '.', static_cast<std::size_t>(next - p_)) == nullptr;
  last_ = p_;
  p_ = next;
  return value;
}

void TextCursor::skip_line() {
  if (p_ >= file_.end()) return;
  const void* const newline = std::memchr(p_, '\n', bytes_left());
  p_ = newline == nullptr ? file_.end() : static_cast<const char*>(newline) + 1;
}

std::string_view TextCursor::word() {
  expect_more();
  while (p_ < file_.end() && static_cast<unsigned char>(*p_) > ' ')
    ++p_;
  if (p_ == last_) fail("a control character in a text file");
  return {last_, static_cast<std::size_t>(p_ - last_)};
}

float TextCursor::number() {
  expect_more();
  float value = 0.0F;
  take_number(scan::read_float(p_, value));
  return value;
}

float TextCursor::coordinate(double& error) {
  expect_more();
  float value = 0.0F;
  take_number(scan::read_coordinate(p_, value, error));
  return value;
}

// A comment begins after white space: some programs write "1.#IND" for a number that is none.
void TextCursor::take_number(const char* end) {
  if (end == nullptr || *end == '#') fail("not a number");
  p_ = end;
}

double TextCursor::wide_number() {
  expect_more();
  double value = 0.0;
  take_number(scan::read_double(p_, value));
  return value;
}

std::int64_t TextCursor::integer() {
  expect_more();
  std::int64_t value = 0;
  const char* const next = scan::read_integer(p_, value);
  if (next == nullptr) fail("not an integer");
  p_ = next;
  return value;
}

void TextCursor::expect_more() {
  const bool is_end = at_end();
  last_ = p_;
  if (is_end) fail("the file ends too early");
}

void TextCursor::fail(std::string_view reason) const {
  throw InputError(file_.name(), file_.line_of(last_), reason);
}

}  // namespace mesher::io
