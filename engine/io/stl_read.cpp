#include "engine/io/stl_read.h"

#include <strings.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/parallel.h"
#include "engine/io/scan.h"
#include "engine/io/text_cursor.h"
#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kFacetsBetweenReports = 4096;

std::uint32_t claimed_facets(const MappedFile& file) {
  std::uint32_t count = 0;
  if (file.size() >= kHeaderBytes) std::memcpy(&count, file.begin() + 80, sizeof count);
  return count;
}

bool starts_as_text(const MappedFile& file) {
  const char* p = text_start(file);
  while (scan::is_blank(*p) || *p == '\n')
    ++p;
  return ::strncasecmp(p, "solid", 5) == 0;
}

/// Returns whether one of the first bytes is zero. Binary files whose header begins with "solid"
/// have zero bytes soon.
bool has_zero_byte(const MappedFile& file) {
  constexpr std::size_t kLooked = 1024;
  return file.bytes().substr(0, kLooked).find('\0') != std::string_view::npos;
}

/// Returns how many facets the size of a binary file leaves room for, if it leaves no rest; or 0.
std::size_t facets_by_size(const MappedFile& file) {
  const std::size_t size = file.size();
  if (size <= kHeaderBytes || (size - kHeaderBytes) % kFacetBytes != 0) return 0;
  return (size - kHeaderBytes) / kFacetBytes;
}

std::uint8_t five_bits(std::uint32_t value) {
  value &= 31U;
  return static_cast<std::uint8_t>(value << 3U | value >> 2U);
}

/// The color of a whole file, in the header that Materialise Magics writes.
std::optional<glm::u8vec4> object_color(const MappedFile& file) {
  constexpr std::string_view kKeyword = "COLOR=";
  const std::string_view header = file.bytes().substr(0, 80);
  const std::size_t at = header.find(kKeyword);
  if (at == std::string_view::npos || at + kKeyword.size() + 4 > header.size()) return std::nullopt;
  glm::u8vec4 color;
  for (int i = 0; i < 4; ++i)
    color[i] =
        static_cast<std::uint8_t>(header[at + kKeyword.size() + static_cast<std::size_t>(i)]);
  return color;
}

std::uint16_t facet_attribute(const MappedFile& file, std::size_t facet) {
  std::uint16_t value;
  std::memcpy(&value, file.begin() + kHeaderBytes + facet * kFacetBytes + 48, sizeof value);
  return value;
}

/// Reads the colors of facets, by one of two conventions for the two bytes after a facet.
///
/// - Materialise Magics: the header holds COLOR= and four bytes, the color of the whole. A facet
///   with the highest bit clear has its own color, red in the lowest bits. (If all facets have 0,
///   the program did not write colors of facets.)
/// - VisCAM and SolidView: a facet with the highest bit set has a color, blue in the lowest bits.
///
/// Other values are named among the contents.
void read_colors(const MappedFile& file, std::size_t facets, Soup& soup) {
  constexpr std::uint32_t kHighBit = 0x8000U;
  const std::optional<glm::u8vec4> whole = object_color(file);
  bool has_any = false;
  bool has_high = false;
  for (std::size_t f = 0; f < facets; ++f) {
    const std::uint16_t value = facet_attribute(file, f);
    has_any = has_any || value != 0;
    has_high = has_high || (value & kHighBit) != 0;
  }
  if (file.bytes().substr(0, 80).find("MATERIAL=") != std::string_view::npos) {
    soup.contents.add(Content::materials, "MATERIAL=");
  }
  if (!whole && !has_high) {
    if (has_any) soup.contents.add(Content::own_properties, "attribute bytes of facets");
    return;
  }
  soup.contents[Content::color_sets] = 1;
  soup.attributes.color.resize(3 * facets);
  for (std::size_t f = 0; f < facets; ++f) {
    const std::uint32_t value = facet_attribute(file, f);
    const std::uint8_t low = five_bits(value);
    const std::uint8_t middle = five_bits(value >> 5U);
    const std::uint8_t high = five_bits(value >> 10U);
    const bool is_high = (value & kHighBit) != 0;
    glm::u8vec4 color = whole.value_or(glm::u8vec4(255));
    if (whole && has_any && !is_high) color = {low, middle, high, 255};
    if (!whole && is_high) color = {high, middle, low, 255};
    std::fill_n(soup.attributes.color.begin() + static_cast<std::ptrdiff_t>(3 * f), 3, color);
  }
}

Array<glm::vec3> read_binary(const MappedFile& file, std::size_t facets, Progress* progress) {
  Array<glm::vec3> positions(3 * facets);
  parallel_chunks(facets, std::size_t{1} << 13, progress, [&](std::size_t, IndexRange range) {
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const char* const corners = file.begin() + kHeaderBytes + f * kFacetBytes + sizeof(glm::vec3);
      std::memcpy(static_cast<void*>(&positions[3 * f]), corners, 3 * sizeof(glm::vec3));
    }
  });
  return positions;
}

float part_read(const MappedFile& file, const char* p) {
  return static_cast<float>(static_cast<double>(p - file.begin()) /
                            static_cast<double>(file.size()));
}

// Some programs write keywords in upper case.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return word.size() == keyword.size() &&
         ::strncasecmp(word.data(), keyword.data(), keyword.size()) == 0;
}

void expect(TextCursor& text, std::string_view word) {
  if (!is_keyword(text.word(), word)) text.fail("expected \"" + std::string(word) + "\"");
}

glm::vec3 read_vector(TextCursor& text) {
  glm::vec3 v;
  for (int i = 0; i < 3; ++i)
    v[i] = text.number();
  return v;
}

bool is_finite_number(std::string_view word) {
  float value = 0.0F;
  const char* const end = scan::read_float(word.data(), value);
  return end == word.data() + word.size() && std::isfinite(value);
}

/// Reads the normal of a facet up to "outer". mesher computes normals itself, so bad ones do no
/// harm. Returns whether it has three finite numbers.
bool skip_normal(TextCursor& text) {
  constexpr int kMostWords = 16;
  int numbers = 0;
  for (int i = 0; i < kMostWords; ++i) {
    const std::string_view word = text.word();
    if (is_keyword(word, "outer")) return numbers == 3;
    numbers += is_finite_number(word) ? 1 : 0;
  }
  text.fail("expected \"outer\"");
}

/// Skips the line that begins a solid, and notes its name.
void skip_name(TextCursor& text, Soup& soup) {
  const char* const begin = text.position();
  text.skip_line();
  std::string_view name(begin, static_cast<std::size_t>(text.position() - begin));
  while (!name.empty() && static_cast<unsigned char>(name.back()) <= ' ')
    name.remove_suffix(1);
  while (!name.empty() && static_cast<unsigned char>(name.front()) <= ' ')
    name.remove_prefix(1);
  // mesher writes its own name there.
  if (!name.empty() && name != "mesher") soup.contents.add(Content::objects, name);
}

Array<glm::vec3> read_text(const MappedFile& file, Soup& soup, Progress* progress) {
  Array<glm::vec3> positions;
  TextCursor text(file, text_start(file));
  while (!text.at_end()) {  // a file may hold several solids
    expect(text, "solid");
    skip_name(text, soup);
    for (;;) {
      if (positions.size() % (3 * kFacetsBetweenReports) == 0) {
        FaceLimit::check(positions.size() / 3);
        report(progress, part_read(file, text.position()));
      }
      const std::string_view word = text.word();
      if (is_keyword(word, "endsolid")) break;
      if (!is_keyword(word, "facet")) text.fail("expected \"facet\" or \"endsolid\"");
      expect(text, "normal");
      if (!skip_normal(text)) ++soup.report[Repair::invalid_normals_ignored];
      expect(text, "loop");
      for (int corner = 0; corner < 3; ++corner) {
        expect(text, "vertex");
        positions.push_back(read_vector(text));
      }
      expect(text, "endloop");
      expect(text, "endfacet");
    }
    text.skip_line();
  }
  return positions;
}

}  // namespace

Soup read_stl(const MappedFile& file, Progress* progress) {
  const std::size_t claimed = claimed_facets(file);
  const std::size_t by_size = facets_by_size(file);
  // Some binary files have a header that begins with "solid", so the size is more reliable.
  const bool is_text = (by_size == 0 || by_size != claimed) && starts_as_text(file) &&
                       (by_size == 0 || !has_zero_byte(file));
  const std::size_t facets = by_size > 0 ? by_size : claimed;
  const bool fits = facets > 0 && file.size() >= kHeaderBytes &&
                    (file.size() - kHeaderBytes) / kFacetBytes >= facets;
  if (!is_text && !fits) {
    throw InputError(file.name(), 0,
                     facets == 0 ? "neither text nor binary STL with facets"
                                 : "the file ends too early for its facet count");
  }
  if (!is_text && facets > kNone / 3) {
    throw InputError(file.name(), 0, "more elements than 32-bit indices can address");
  }
  if (!is_text) FaceLimit::check(facets);
  Soup soup;
  if (is_text) {
    soup.positions = read_text(file, soup, progress);
  } else {
    soup.positions = read_binary(file, facets, progress);
    read_colors(file, facets, soup);
    soup.report[Repair::facet_counts_corrected] = facets != claimed ? 1 : 0;
  }
  if (soup.positions.empty()) throw InputError(file.name(), 0, "no facets");
  if (soup.positions.size() >= kNone) {
    throw InputError(file.name(), 0, "more elements than 32-bit indices can address");
  }
  soup.corners.resize(soup.positions.size());
  std::iota(soup.corners.begin(), soup.corners.end(), 0U);
  return soup;
}

}  // namespace mesher::io
