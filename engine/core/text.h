#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mesher {

/// Returns text from a stranger, such as a name in a file, as it may be printed on a terminal: with
/// control characters, and bytes that are not UTF-8, as escapes ("\n", "\x1b"). All other
/// characters stay, backslashes too. O(bytes).
std::string printable(std::string_view text);

// Numbers as people read them, in messages and panels. Files and JSON do not use these functions:
// they hold all digits of a number.

/// Returns a count with all its digits, a comma between thousands: "1,234,567", "-12".
std::string count_text(std::int64_t count);

/// Returns a count of things, named by a noun that takes an "s" in the plural: "1 face",
/// "1,234 faces".
std::string count_text(std::int64_t count, std::string_view noun);

/// Returns a count in front of a phrase. Where the phrase has "{one|many}", the count chooses the
/// words: "1 face flipped" and "2 faces flipped" for "{face|faces} flipped".
std::string count_phrase(std::int64_t count, std::string_view phrase);

/// Returns a measurement without a unit (a length, an area, an angle), rounded to six significant
/// digits: "0.00123457", "2", "1.5e+09".
std::string number_text(double value);

/// Returns a percentage, rounded to three significant digits: "12.3 %" for 12.3456.
/// From 999.5 on, it is rounded to a whole number: "1,234 %".
std::string percent_text(double percent);

/// Returns a size in memory or in a file: below 1000 all digits, "999 bytes", and from there on in
/// decimal units up to EB, rounded to three significant digits: "1.02 kB", "12.3 MB", "1 GB".
std::string bytes_text(std::uint64_t bytes);

/// Returns a duration: "0.412 ms", "41.2 ms", "1.23 s", "2 min 5 s", "3 h 12 min".
/// Below one minute it is rounded to three significant digits, below one hour to seconds, and from
/// there on to minutes. Below 0.1 microseconds it is "0 ms".
std::string seconds_text(double seconds);

}  // namespace mesher
