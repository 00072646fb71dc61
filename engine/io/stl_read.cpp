#include "engine/io/stl_read.h"

#include <strings.h>

#include <cstring>
#include <string>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/scan.h"
#include "engine/io/text_cursor.h"
#include "engine/io/weld.h"

namespace mesher::io {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kFacetsBetweenReports = 4096;
/// Times of reading the facets and of welding their corners, measured with 1.4 and 13 million
/// faces.
constexpr double kTextWeights[] = {0.47, 0.53};
constexpr double kBinaryWeights[] = {0.03, 0.97};

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

Array<glm::vec3> read_text(const MappedFile& file, Progress* progress) {
  Array<glm::vec3> positions;
  TextCursor text(file, text_start(file));
  while (!text.at_end()) {  // a file may hold several solids
    expect(text, "solid");
    text.skip_line();
    for (;;) {
      if (positions.size() % (3 * kFacetsBetweenReports) == 0)
        report(progress, part_read(file, text.position()));
      const std::string_view word = text.word();
      if (is_keyword(word, "endsolid")) break;
      if (!is_keyword(word, "facet")) text.fail("expected \"facet\" or \"endsolid\"");
      expect(text, "normal");
      read_vector(text);
      expect(text, "outer");
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

Soup connect(const Array<glm::vec3>& positions, Progress* progress) {
  Weld welded = weld_positions(positions, progress);
  Soup soup;
  soup.positions.resize(welded.first.size());
  for (std::size_t v = 0; v < welded.first.size(); ++v) {
    soup.positions[v] = positions[welded.first[v]];
  }
  soup.corners = std::move(welded.index);
  return soup;
}

}  // namespace

Soup read_stl(const MappedFile& file, Progress* progress) {
  const std::size_t facets = claimed_facets(file);
  const bool fits = file.size() >= kHeaderBytes &&
                    (file.size() - kHeaderBytes) / kFacetBytes >= facets && facets > 0;
  const bool fits_exactly = fits && file.size() == kHeaderBytes + facets * kFacetBytes;
  // Some binary files have a header that begins with "solid", so the facet count is more reliable.
  const bool is_text = !fits_exactly && starts_as_text(file);
  if (!is_text && !fits) {
    throw InputError(file.name(), 0,
                     facets == 0 ? "neither text nor binary STL with facets"
                                 : "the file ends too early for its facet count");
  }
  if (!is_text && facets > kNone / 3) {
    throw InputError(file.name(), 0, "more elements than 32-bit indices can address");
  }
  Stages stages(progress, is_text ? kTextWeights : kBinaryWeights);
  stages.next();
  const Array<glm::vec3> positions =
      is_text ? read_text(file, progress) : read_binary(file, facets, progress);
  if (positions.empty()) throw InputError(file.name(), 0, "no facets");
  stages.next("connecting");
  return connect(positions, progress);
}

}  // namespace mesher::io
