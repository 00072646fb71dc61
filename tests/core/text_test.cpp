#include "engine/core/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mesher {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Printable, EscapesControlCharacters) {
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable("\x1b[31mred\x07"), "\\x1b[31mred\\x07");
  EXPECT_EQ(printable(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\xc2\\x9b31m")
      << "the one-character form of ESC [";
}

TEST(Printable, KeepsText) {
  for (const char* text : {"", "a b\\n", "Gr\u00fc\u00dfe", "\u732b \U0001F408", "\u00a0"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("b\xff.obj"), "b\\xff.obj");
  EXPECT_EQ(printable("\xE4\xBD"), "\\xe4\\xbd") << "cut short";
  EXPECT_EQ(printable("\xC0\x8A"), "\\xc0\\x8a") << "a line feed in a form that is too long";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "half of a surrogate pair";
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
  EXPECT_EQ(printable("\x9b"), "\\x9b");
}

TEST(CountText, HasCommasBetweenThousands) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1000), "1,000");
  EXPECT_EQ(count_text(123'456), "123,456");
  EXPECT_EQ(count_text(1'234'567), "1,234,567");
  EXPECT_EQ(count_text(10'000'000), "10,000,000");
}

TEST(CountText, ShowsNegativeNumbers) {
  EXPECT_EQ(count_text(-1), "-1");
  EXPECT_EQ(count_text(-999), "-999");
  EXPECT_EQ(count_text(-1000), "-1,000");
}

TEST(CountText, ShowsEndsOfRange) {
  EXPECT_EQ(count_text(std::numeric_limits<std::uint32_t>::max()), "4,294,967,295");
  EXPECT_EQ(count_text(std::numeric_limits<std::int64_t>::max()), "9,223,372,036,854,775,807");
  EXPECT_EQ(count_text(std::numeric_limits<std::int64_t>::min()), "-9,223,372,036,854,775,808");
}

TEST(CountPhrase, ChoosesWordsByTheCount) {
  EXPECT_EQ(count_phrase(1, "{face|faces} flipped"), "1 face flipped");
  EXPECT_EQ(count_phrase(1'234, "{face|faces} flipped"), "1,234 faces flipped");
  EXPECT_EQ(count_phrase(0, "bad {index|indices} in {a face|faces}"), "0 bad indices in faces");
  EXPECT_EQ(count_phrase(1, "bad {index|indices} in {a face|faces}"), "1 bad index in a face");
  EXPECT_EQ(count_phrase(2, "left"), "2 left");
}

TEST(CountText, AddsPluralUnlessOne) {
  EXPECT_EQ(count_text(0, "face"), "0 faces");
  EXPECT_EQ(count_text(1, "face"), "1 face");
  EXPECT_EQ(count_text(2, "face"), "2 faces");
  EXPECT_EQ(count_text(12'345, "edge"), "12,345 edges");
}

TEST(NumberText, HasSixSignificantDigits) {
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(2.0), "2");
  EXPECT_EQ(number_text(0.001234567891), "0.00123457");
  EXPECT_EQ(number_text(-123456.7), "-123457");
  EXPECT_EQ(number_text(1.5e9), "1.5e+09");
}

TEST(NumberText, NamesWhatIsNotFinite) {
  EXPECT_EQ(number_text(kInfinity), "inf");
  EXPECT_EQ(number_text(-kInfinity), "-inf");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(PercentText, HasThreeSignificantDigits) {
  EXPECT_EQ(percent_text(0.0), "0 %");
  EXPECT_EQ(percent_text(0.001234), "0.00123 %");
  EXPECT_EQ(percent_text(12.3456), "12.3 %");
  EXPECT_EQ(percent_text(99.96), "100 %");
  EXPECT_EQ(percent_text(-5.25), "-5.25 %");
}

TEST(PercentText, IsWholeFromThousandOn) {
  EXPECT_EQ(percent_text(999.4), "999 %");
  EXPECT_EQ(percent_text(999.5), "1,000 %");
  EXPECT_EQ(percent_text(1234.5678), "1,235 %");
  EXPECT_EQ(percent_text(-1234.5678), "-1,235 %");
}

TEST(PercentText, AcceptsWhatIsNotAWholeNumber) {
  EXPECT_EQ(percent_text(1e300), "1e+300 %");
  EXPECT_EQ(percent_text(kInfinity), "inf %");
  EXPECT_EQ(percent_text(std::numeric_limits<double>::quiet_NaN()), "nan %");
}

TEST(BytesText, ShowsAllDigitsBelowThousand) {
  EXPECT_EQ(bytes_text(0), "0 bytes");
  EXPECT_EQ(bytes_text(1), "1 byte");
  EXPECT_EQ(bytes_text(2), "2 bytes");
  EXPECT_EQ(bytes_text(999), "999 bytes");
}

TEST(BytesText, HasThreeSignificantDigitsInDecimalUnits) {
  EXPECT_EQ(bytes_text(1000), "1 kB");
  EXPECT_EQ(bytes_text(1023), "1.02 kB");
  EXPECT_EQ(bytes_text(1024), "1.02 kB");
  EXPECT_EQ(bytes_text(1'540), "1.54 kB");
  EXPECT_EQ(bytes_text(12'440'000), "12.4 MB");
  EXPECT_EQ(bytes_text(1'000'000'000), "1 GB");
  EXPECT_EQ(bytes_text(1'500'000'000), "1.5 GB");
  EXPECT_EQ(bytes_text(std::uint64_t{1} << 32), "4.29 GB");
  EXPECT_EQ(bytes_text(3'214'000'000'000), "3.21 TB");
  EXPECT_EQ(bytes_text(50'000'000'000'000'000), "50 PB");
  EXPECT_EQ(bytes_text(std::numeric_limits<std::uint64_t>::max()), "18.4 EB");
}

TEST(BytesText, ChangesUnitWhereItRoundsUp) {
  EXPECT_EQ(bytes_text(999'400), "999 kB");
  EXPECT_EQ(bytes_text(999'499), "999 kB");
  EXPECT_EQ(bytes_text(999'500), "1 MB");
  EXPECT_EQ(bytes_text(999'999), "1 MB");
  EXPECT_EQ(bytes_text(999'999'999), "1 GB");
}

TEST(SecondsText, HasThreeSignificantDigitsBelowOneMinute) {
  EXPECT_EQ(seconds_text(0.0), "0 ms");
  EXPECT_EQ(seconds_text(1e-9), "0 ms");
  EXPECT_EQ(seconds_text(1e-7), "0.0001 ms");
  EXPECT_EQ(seconds_text(0.0004), "0.4 ms");
  EXPECT_EQ(seconds_text(0.0004123), "0.412 ms");
  EXPECT_EQ(seconds_text(0.04123), "41.2 ms");
  EXPECT_EQ(seconds_text(1.0), "1 s");
  EXPECT_EQ(seconds_text(1.2345), "1.23 s");
  EXPECT_EQ(seconds_text(59.9), "59.9 s");
}

TEST(SecondsText, ChangesUnitWhereItRoundsUp) {
  EXPECT_EQ(seconds_text(0.9994), "999 ms");
  EXPECT_EQ(seconds_text(0.9996), "1 s");
  EXPECT_EQ(seconds_text(59.94), "59.9 s");
  EXPECT_EQ(seconds_text(59.96), "1 min 0 s");
  EXPECT_EQ(seconds_text(3599.4), "59 min 59 s");
  EXPECT_EQ(seconds_text(3599.6), "1 h 0 min");
}

TEST(SecondsText, ShowsMinutesAndHours) {
  EXPECT_EQ(seconds_text(60.0), "1 min 0 s");
  EXPECT_EQ(seconds_text(125.4), "2 min 5 s");
  EXPECT_EQ(seconds_text(10'800.0), "3 h 0 min");
  EXPECT_EQ(seconds_text(11'520.0), "3 h 12 min");
  EXPECT_EQ(seconds_text(1e8), "27,777 h 47 min");
}

TEST(SecondsText, AcceptsWhatIsNoDuration) {
  EXPECT_EQ(seconds_text(-0.5), "-0.5 s");
  EXPECT_EQ(seconds_text(1e13), "1e+13 s");
  EXPECT_EQ(seconds_text(kInfinity), "inf s");
  EXPECT_EQ(seconds_text(std::numeric_limits<double>::quiet_NaN()), "nan s");
}

}  // namespace
}  // namespace mesher
