#include "engine/io/off_read.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/io/soup_faces.h"
#include "engine/io/text_cursor.h"
#include "engine/io/vertex_attributes.h"

namespace mesher::io {
namespace {

constexpr std::size_t kOffRowsPerReport = 4096;
/// Times of reading the elements and of bringing attributes to the corners, without attributes 1 %.
constexpr double kOffReadWeight = 0.97;
constexpr double kOffFinishWeight = 0.03;

/// Attributes per vertex, as the first word declares them.
struct OffKind {
  bool has_texcoords = false;
  bool has_colors = false;
  bool has_normals = false;
};

bool take_prefix(std::string_view& word, std::string_view prefix) {
  if (word.substr(0, prefix.size()) != prefix) return false;
  word.remove_prefix(prefix.size());
  return true;
}

OffKind read_kind(TextCursor& text) {
  std::string_view word = text.word();
  OffKind kind;
  kind.has_texcoords = take_prefix(word, "ST");
  kind.has_colors = take_prefix(word, "C");
  kind.has_normals = take_prefix(word, "N");
  if (word == "4OFF" || word == "nOFF" || word == "4nOFF") {
    text.fail("only three-dimensional OFF is supported");
  }
  if (word != "OFF") text.fail("does not begin with OFF");
  if (!text.at_line_end() && *text.position() == 'B') text.fail("binary OFF is not supported");
  return kind;
}

/// Reads a number of elements that each take at least `least_bytes` of the remaining text.
std::size_t read_count(TextCursor& text, std::size_t least_bytes) {
  const std::int64_t count = text.integer();
  if (count < 0) text.fail("a negative count");
  // The last element needs no line end.
  if (static_cast<std::uint64_t>(count) > text.bytes_left() / least_bytes + 1) {
    text.fail("the file is too short for so many elements");
  }
  if (count >= kNone) text.fail("more elements than 32-bit indices can address");
  return static_cast<std::size_t>(count);
}

class OffReader {
 public:
  OffReader(const MappedFile& file, Progress* progress)
      : text_(file, text_start(file)),
        progress_(progress),
        bytes_(static_cast<double>(file.size())) {}

  Soup run() {
    Stages stages(progress_, {kOffReadWeight, kOffFinishWeight});
    stages.next();
    read_elements();
    stages.next();
    return finish();
  }

 private:
  void read_elements() {
    const OffKind kind = read_kind(text_);
    const std::size_t vertices = read_count(text_, 6);  // "0 0 0\n"
    const std::size_t faces = read_count(text_, 2);     // "0\n"
    text_.skip_line();                                  // the number of edges, given or not
    if (vertices == 0) text_.fail("no vertices");
    read_rows(vertices, [&] { read_vertex(kind); });
    soup_.face_start.push_back(0);
    read_rows(faces, [&] { read_face(); });
  }

  /// Calls `read` for each row, and reports the bytes that were read.
  template <class Read>
  void read_rows(std::size_t rows, const Read& read) {
    ordered_chunks(rows, kOffRowsPerReport, nullptr, [&](IndexRange range) {
      report(progress_, static_cast<float>(1.0 - static_cast<double>(text_.bytes_left()) / bytes_));
      for (std::size_t i = range.begin; i < range.end; ++i)
        read();
    });
  }

  Soup finish() {
    Stages stages(progress_, {1.0, 1.0, 1.0});
    stages.next();
    forget_triangle_starts(soup_);
    soup_.attributes.texcoord = spread_to_corners<glm::vec2>(soup_.corners, texcoords_, progress_);
    stages.next();
    soup_.attributes.normal = spread_to_corners<glm::vec3>(soup_.corners, normals_, progress_);
    stages.next();
    soup_.attributes.color = spread_to_corners<glm::u8vec4>(soup_.corners, colors_, progress_);
    return std::move(soup_);
  }

  glm::vec3 read_vector() {
    glm::vec3 v;
    for (int i = 0; i < 3; ++i)
      v[i] = text_.number();
    return v;
  }

  void read_vertex(const OffKind& kind) {
    soup_.positions.push_back(read_vector());
    if (kind.has_normals) normals_.push_back(read_vector());
    if (kind.has_colors) read_color(kind.has_texcoords ? 2 : 0);
    if (kind.has_texcoords) {
      const float u = text_.number();
      texcoords_.push_back({u, text_.number()});
    }
    text_.skip_line();
  }

  /// Reads a color of three or four numbers: 0..255 if whole, 0..1 if written with a decimal point.
  /// `after` numbers at the end of the line belong to something else.
  void read_color(std::size_t after) {
    std::string_view words[6];
    double values[6] = {};
    std::size_t count = 0;
    TextCursor ahead = text_;
    while (count < 4 + after && !ahead.at_line_end()) {
      TextCursor again = ahead;
      words[count] = again.word();
      values[count++] = ahead.wide_number();
    }
    if (count < 3 + after) ahead.fail("a vertex has no color");
    const std::size_t parts = count - after;
    const bool is_fraction = std::any_of(words, words + parts, [](std::string_view word) {
      return word.find('.') != std::string_view::npos;
    });
    glm::u8vec4 color(255);
    for (std::size_t i = 0; i < parts; ++i) {
      const double full = is_fraction ? 255.0 * values[i] : values[i];
      color[static_cast<int>(i)] = static_cast<std::uint8_t>(
          std::isnan(full) ? 0L : std::lround(std::clamp(full, 0.0, 255.0)));
      text_.wide_number();
    }
    colors_.push_back(color);
  }

  void read_face() {
    const std::int64_t corners = text_.integer();
    if (corners < 0) text_.fail("a face with a negative count");
    if (static_cast<std::uint64_t>(corners) > text_.bytes_left() / 2 + 1) {
      text_.fail("the file is too short for this face");
    }
    for (std::int64_t c = 0; c < corners; ++c) {
      const std::int64_t index = text_.integer();
      if (index < 0 || static_cast<std::uint64_t>(index) >= soup_.positions.size()) {
        text_.fail("vertex index out of range");
      }
      soup_.corners.push_back(static_cast<std::uint32_t>(index));
    }
    if (soup_.corners.size() >= kNone) text_.fail("more elements than 32-bit indices can address");
    soup_.face_start.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
    text_.skip_line();  // may hold a color
  }

  TextCursor text_;
  Progress* progress_;
  double bytes_;  ///< of the file
  Soup soup_;
  Array<glm::vec2> texcoords_;
  Array<glm::vec3> normals_;
  Array<glm::u8vec4> colors_;
};

}  // namespace

Soup read_off(const MappedFile& file, Progress* progress) {
  return OffReader(file, progress).run();
}

}  // namespace mesher::io
