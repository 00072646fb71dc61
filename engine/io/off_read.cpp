#include "engine/io/off_read.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/io/far_origin.h"
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
  // Programs differ in the order of the letters; that of the numbers is the same.
  for (;;) {
    if (!kind.has_texcoords && take_prefix(word, "ST")) {
      kind.has_texcoords = true;
    } else if (!kind.has_colors && take_prefix(word, "C")) {
      kind.has_colors = true;
    } else if (!kind.has_normals && take_prefix(word, "N")) {
      kind.has_normals = true;
    } else {
      break;
    }
  }
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

/// The numbers at the end of a line.
struct OffNumbers {
  static constexpr std::size_t kMost = 8;
  double values[kMost] = {};
  std::size_t count = 0;  ///< at most kMost; the line may have more
  bool is_whole[kMost] = {};

  void read(TextCursor& text) {
    while (count < kMost) {
      const std::optional<double> value = text.number_on_line(is_whole[count]);
      if (!value) break;
      values[count++] = *value;
    }
  }
};

/// Colors as in the file: three or four numbers, 0..255 if whole and 0..1 if written with a decimal
/// point. If no number of the file exceeds 1, one with a decimal point makes all of them fractions.
class OffColors {
 public:
  /// Adds the first `parts` numbers as a color; `parts` 0: none.
  void push(const OffNumbers& numbers, std::size_t parts) {
    Raw raw;
    bool is_fraction = false;
    for (std::size_t i = 0; i < parts; ++i) {
      const double value = numbers.values[i];
      raw.parts[static_cast<int>(i)] = static_cast<float>(value);
      is_fraction = is_fraction || !numbers.is_whole[i];
      largest_ = std::max(largest_, value);
      is_color_ = is_color_ && value >= 0.0 && value <= 255.0;
    }
    raw.count = static_cast<std::uint8_t>(parts);
    raw.is_fraction = is_fraction;
    has_fractions_ = has_fractions_ || is_fraction;
    has_any_ = has_any_ || parts > 0;
    colors_.push_back(raw);
  }

  bool has_any() const { return has_any_; }
  std::size_t size() const { return colors_.size(); }
  /// Returns whether all numbers are in the range of colors.
  bool are_colors() const { return is_color_; }

  /// Returns the colors; elements without one have `is_there` false.
  Array<FaceValue<glm::u8vec4>> finish() const {
    Array<FaceValue<glm::u8vec4>> values(colors_.size());
    const bool all_fractions = has_fractions_ && largest_ <= 1.0;
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      const Raw& raw = colors_[i];
      values[i] = {glm::u8vec4(255), raw.count > 0};
      const bool is_fraction = all_fractions || (raw.is_fraction && is_small(raw));
      for (int c = 0; c < raw.count; ++c) {
        const double full = is_fraction ? 255.0 * double(raw.parts[c]) : double(raw.parts[c]);
        values[i].value[c] = static_cast<std::uint8_t>(
            std::isnan(full) ? 0L : std::lround(std::clamp(full, 0.0, 255.0)));
      }
    }
    return values;
  }

 private:
  struct Raw {
    glm::vec4 parts{0.0F};
    std::uint8_t count = 0;
    bool is_fraction = false;
  };
  static bool is_small(const Raw& raw) {
    for (int c = 0; c < raw.count; ++c) {
      if (raw.parts[c] > 1.0F) return false;
    }
    return true;
  }

  Array<Raw> colors_;
  double largest_ = 0.0;
  bool has_fractions_ = false;
  bool has_any_ = false;
  bool is_color_ = true;
};

class OffReader {
 public:
  OffReader(const MappedFile& file, const glm::dvec3& origin, Progress* progress)
      : text_(file, text_start(file)),
        progress_(progress),
        bytes_(static_cast<double>(file.size())) {
    soup_.origin = origin;
    is_wide_ = origin != glm::dvec3(0.0);
  }

  Soup run() {
    Stages stages(progress_, {kOffReadWeight, kOffFinishWeight});
    stages.next();
    read_elements();
    stages.next();
    return finish();
  }

  double coordinate_error() const { return coordinate_error_; }

 private:
  void read_elements() {
    const OffKind kind = read_kind(text_);
    const std::size_t vertices = read_count(text_, 6);  // "0 0 0\n"
    const std::size_t faces = read_count(text_, 2);     // "0\n"
    FaceLimit::check(faces);
    text_.skip_line();  // the number of edges, given or not
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
    CornerAttributes& attributes = soup_.attributes;
    attributes.texcoord = spread_to_corners<glm::vec2>(soup_.corners, texcoords_, progress_);
    stages.next();
    attributes.normal = spread_to_corners<glm::vec3>(soup_.corners, normals_, progress_);
    stages.next();
    finish_colors();
    FileContents& contents = soup_.contents;
    contents[Content::uv_sets] = texcoords_.empty() ? 0 : 1;
    contents[Content::normals] = normals_.empty() ? 0 : 1;
    const auto note = [&](bool is_there, std::string_view name) {
      if (is_there) contents.add(Content::own_properties, name);
    };
    note(has_vertex_numbers_, "numbers after the coordinates of vertices");
    note(has_face_numbers_, "numbers after the corners of faces");
    note(has_color_indices_, "indices of colors in a color map");
    forget_triangle_starts(soup_);
    return std::move(soup_);
  }

  /// Numbers after the coordinates need not be colors if the first word does not say so.
  void finish_colors() {
    if (vertex_colors_.has_any() && !vertex_colors_.are_colors() && !has_declared_colors_) {
      has_vertex_numbers_ = true;
    } else if (vertex_colors_.has_any()) {
      ++soup_.contents[Content::color_sets];
      const Array<FaceValue<glm::u8vec4>> values = vertex_colors_.finish();
      Array<glm::u8vec4> colors(values.size());
      for (std::size_t v = 0; v < values.size(); ++v)
        colors[v] = values[v].value;
      soup_.attributes.color = spread_to_corners<glm::u8vec4>(soup_.corners, colors, progress_);
    }
    if (!face_colors_.has_any()) return;
    if (!face_colors_.are_colors()) {
      has_face_numbers_ = true;
      return;
    }
    ++soup_.contents[Content::color_sets];
    spread_faces_to_corners(soup_.face_start, face_colors_.finish(), glm::u8vec4(255),
                            soup_.attributes.color);
  }

  glm::vec3 read_vector() {
    glm::vec3 v;
    for (int i = 0; i < 3; ++i)
      v[i] = text_.number();
    return v;
  }

  glm::vec3 read_position() {
    glm::vec3 v;
    for (int i = 0; i < 3; ++i) {
      v[i] = is_wide_ ? static_cast<float>(text_.wide_number() - soup_.origin[i])
                      : text_.coordinate(coordinate_error_);
    }
    return v;
  }

  void read_vertex(const OffKind& kind) {
    soup_.positions.push_back(read_position());
    if (kind.has_normals) normals_.push_back(read_vector());
    const bool is_plain = !kind.has_colors && !kind.has_texcoords && !vertex_colors_.has_any();
    if (is_plain && text_.at_line_end()) return text_.skip_line();
    has_declared_colors_ = kind.has_colors;
    OffNumbers numbers;
    numbers.read(text_);
    const std::size_t after = kind.has_texcoords ? 2 : 0;
    if (kind.has_colors && numbers.count < 3 + after) text_.fail("a vertex has no color");
    if (numbers.count < after) text_.fail("a vertex has no texture coordinate");
    const std::size_t parts = std::min<std::size_t>(4, numbers.count - after);
    if (kind.has_texcoords) {
      texcoords_.push_back({static_cast<float>(numbers.values[parts]),
                            static_cast<float>(numbers.values[parts + 1])});
    }
    push_color(vertex_colors_, numbers, parts, soup_.positions.size(), has_vertex_numbers_);
    text_.skip_line();
  }

  /// Adds the color of element number `count`, if it has one. No memory is needed for files without
  /// colors.
  void push_color(OffColors& colors, const OffNumbers& numbers, std::size_t parts,
                  std::size_t count, bool& has_numbers) {
    const bool is_color = parts == 3 || parts == 4;
    has_color_indices_ = has_color_indices_ || parts == 1;
    has_numbers = has_numbers || parts == 2;
    if (!is_color && !colors.has_any()) return;
    while (colors.size() + 1 < count)
      colors.push({}, 0);
    colors.push(numbers, is_color ? parts : 0);
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
    if (!face_colors_.has_any() && text_.at_line_end()) return text_.skip_line();
    OffNumbers numbers;
    numbers.read(text_);
    push_color(face_colors_, numbers, std::min<std::size_t>(4, numbers.count),
               soup_.face_start.size() - 1, has_face_numbers_);
    text_.skip_line();
  }

  TextCursor text_;
  Progress* progress_;
  double bytes_;  ///< of the file
  Soup soup_;
  Array<glm::vec2> texcoords_;
  Array<glm::vec3> normals_;
  OffColors vertex_colors_;
  OffColors face_colors_;
  bool has_declared_colors_ = false;
  bool has_vertex_numbers_ = false;
  bool has_face_numbers_ = false;
  bool has_color_indices_ = false;
  bool is_wide_ = false;
  double coordinate_error_ = 0.0;
};

}  // namespace

Soup read_off(const MappedFile& file, Progress* progress) {
  OffReader reader(file, glm::dvec3(0.0), progress);
  Soup soup = reader.run();
  const glm::dvec3 origin = choose_origin(soup.positions, reader.coordinate_error());
  if (origin == glm::dvec3(0.0)) return soup;
  soup = {};
  return OffReader(file, origin, progress).run();
}

}  // namespace mesher::io
