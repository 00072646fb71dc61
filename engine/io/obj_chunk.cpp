#include "engine/io/obj_chunk.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/io/color_byte.h"
#include "engine/io/scan.h"
#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

using scan::is_blank;
using scan::is_digit;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Returns the length of a backslash and the line end, or the end of the file, that it escapes; 0
/// if there is none. Blanks between them do not count. (A zero byte inside the file is reached next
/// and refused.)
std::size_t continuation(const char* p) {
  if (p[0] != '\\') return 0;
  const char* const end = scan::skip_blanks(p + 1);
  if (*end == '\n') return static_cast<std::size_t>(end + 1 - p);
  return *end == '\0' ? static_cast<std::size_t>(end - p) : 0;
}

/// Returns whether the line that ends before `newline` ends in a backslash, with or without blanks
/// after it.
bool ends_in_backslash(const char* begin, const char* newline) {
  const char* last = newline;
  while (last > begin && is_blank(last[-1]))
    --last;
  return last > begin && last[-1] == '\\';
}

const char* skip_more_blanks(const char* p) {
  for (;;) {
    p = scan::skip_blanks(p);
    const std::size_t hidden = continuation(p);
    if (hidden == 0) return p;
    p += hidden;
  }
}

/// Skips blanks and continuations. A single blank is by far the most common case.
inline const char* skip_blanks(const char* p) {
  if (*p == ' ') ++p;
  if (static_cast<unsigned char>(*p) > ' ' && *p != '\\') return p;
  return skip_more_blanks(p);
}

/// Each `statement` function receives the text after its keyword. It returns the start of the next
/// line, or null after an error.
class Parser {
 public:
  Parser(const char* end, const ObjBounds& bounds, const glm::dvec3& origin, ObjChunk& chunk)
      : end_(end),
        bounds_(bounds),
        origin_(origin),
        is_wide_(origin != glm::dvec3(0.0)),
        chunk_(chunk) {}

  void run(const char* p) {
    while (p != nullptr && p < end_)
      p = line(skip_blanks(p));
  }

 private:
  const char* fail(const char* where, const char* reason) {
    chunk_.error = reason;
    chunk_.error_at = where;
    return nullptr;
  }

  bool at_end(const char* p) const { return *p == '\n' || *p == '#' || p >= end_; }

  const char* line(const char* p) {
    switch (*p) {
      case 'v':
        if (ends_keyword(p[1])) return position(p + 1);
        if (p[1] == 'n' && ends_keyword(p[2])) return normal(p + 2);
        if (p[1] == 't' && ends_keyword(p[2])) return texcoord(p + 2);
        break;
      case 'f':
        if (ends_keyword(p[1])) return face(p + 1);
        break;
      case 'e':
        if (ends_keyword(p[1])) return edge(p + 1);
        break;
      case 't':
        if (ends_keyword(p[1])) return tag(p + 1);
        break;
      case 'g':
      case 'o':
        if (ends_keyword(p[1])) return name(p[0], p + 1);
        break;
      case 's':
        if (ends_keyword(p[1])) return name('s', p + 1);
        break;
      case 'u':
        if (std::strncmp(p, "usemtl", 6) == 0 && ends_keyword(p[6])) return name('u', p + 6);
        break;
      case 'm':
        if (std::strncmp(p, "mtllib", 6) == 0 && ends_keyword(p[6])) return name('m', p + 6);
        break;
      default:
        break;
    }
    return *p == '#' ? past_line(p) : other_statement(p);
  }

  /// Counts a statement that is not read.
  const char* other_statement(const char* p) {
    const char* end = p;
    while (end < end_ && !scan::ends_token(*end))
      ++end;
    const std::string_view keyword(p, static_cast<std::size_t>(end - p));
    if (keyword == "p") {
      for (const char* q = skip_blanks(end); !at_end(q); q = skip_blanks(past_token(q)))
        ++chunk_.points;
    } else if (keyword == "l") {
      ++chunk_.lines;
    } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
      ++chunk_.curves;
    } else if (!keyword.empty() && !is_part_of_curve(keyword)) {
      note_unknown(keyword);
    }
    return past_statement(p);
  }

  const char* past_token(const char* p) const {
    do {
      ++p;
    } while (p < end_ && !scan::ends_token(*p));
    return p;
  }

  /// Statements that only describe the next curve or surface.
  static bool is_part_of_curve(std::string_view keyword) {
    static constexpr std::string_view kParts[] = {"vp",   "cstype", "deg",  "bmat", "step", "parm",
                                                  "trim", "hole",   "scrv", "sp",   "end",  "con"};
    return std::find(std::begin(kParts), std::end(kParts), keyword) != std::end(kParts);
  }

  void note_unknown(std::string_view keyword) {
    constexpr std::size_t kMostPerChunk = 64;
    std::vector<std::string_view>& unknown = chunk_.unknown;
    if (unknown.size() < kMostPerChunk && (unknown.empty() || unknown.back() != keyword)) {
      unknown.push_back(keyword);
    }
  }

  bool ends_keyword(char c) const { return is_blank(c) || c == '\n' || c == '\\' || c == '\0'; }

  /// Comments are not continued: a path in one may end in a backslash.
  const char* past_line(const char* p) const {
    if (p >= end_) return end_;
    const void* const newline = std::memchr(p, '\n', static_cast<std::size_t>(end_ - p));
    return newline == nullptr ? end_ : static_cast<const char*>(newline) + 1;
  }

  const char* past_statement(const char* p) const {
    if (p >= end_) return end_;
    const char* const line = past_line(p);
    const bool has_comment = std::memchr(p, '#', static_cast<std::size_t>(line - p)) != nullptr;
    if (has_comment || line == p || line[-1] != '\n' || !ends_in_backslash(p, line - 1))
      return line;
    return past_statement(line);
  }

  const char* number(const char* p, float& value, const char* too_few) {
    p = skip_blanks(p);
    const char* const next = scan::read_float(p, value);
    if (next != nullptr) return next;
    return fail(p, at_end(p) ? too_few : "not a number");
  }

  const char* vector3(const char* p, glm::vec3& v, const char* too_few) {
    for (int i = 0; i < 3 && p != nullptr; ++i)
      p = number(p, v[i], too_few);
    return p;
  }

  const char* coordinate(const char* p, int axis, float& value) {
    p = skip_blanks(p);
    const char* next = nullptr;
    if (is_wide_) {
      double wide = 0.0;
      next = scan::read_double(p, wide);
      value = static_cast<float>(wide - origin_[axis]);
    } else {
      next = scan::read_coordinate(p, value, chunk_.coordinate_error);
    }
    if (next != nullptr) return next;
    return fail(p, at_end(p) ? "a vertex needs three coordinates" : "not a number");
  }

  const char* position(const char* p) {
    glm::vec3 v;
    for (int i = 0; i < 3 && p != nullptr; ++i)
      p = coordinate(p, i, v[i]);
    if (p == nullptr) return nullptr;
    chunk_.positions.push(v);
    if (*p == '\n' && chunk_.colors.empty()) return p + 1;
    return vertex_color(skip_blanks(p));
  }

  /// Reads the text after the coordinates: nothing, a weight, or a color of three or four
  /// components.
  const char* vertex_color(const char* p) {
    float extra[4];
    int count = 0;
    while (!at_end(p)) {
      float value = 0.0F;
      const char* const next = scan::read_float(p, value);
      if (next == nullptr) return fail(p, "not a number");
      if (count < 4) extra[count] = value;
      ++count;
      p = skip_blanks(next);
    }
    constexpr glm::u8vec4 kWhite(255);
    if (count == 1 && extra[0] != 1.0F) chunk_.has_weights = true;
    if (count == 3 || count == 4) {
      chunk_.colors.fill_up(chunk_.positions.size() - 1, kWhite);
      chunk_.colors.push({color_byte(extra[0]), color_byte(extra[1]), color_byte(extra[2]),
                          count == 4 ? color_byte(extra[3]) : std::uint8_t{255}});
    } else if (!chunk_.colors.empty()) {
      chunk_.colors.push(kWhite);
    }
    return past_line(p);
  }

  const char* normal(const char* p) {
    glm::vec3 n;
    p = vector3(p, n, "a normal needs three components");
    if (p == nullptr) return nullptr;
    chunk_.normals.push(n);
    return *p == '\n' ? p + 1 : past_statement(p);
  }

  const char* texcoord(const char* p) {
    glm::vec2 t(0.0F);
    p = number(p, t.x, "a texture coordinate needs a number");
    if (p == nullptr) return nullptr;
    p = skip_blanks(p);
    if (!at_end(p)) p = number(p, t.y, "");
    if (p == nullptr) return nullptr;
    chunk_.texcoords.push(t);
    if (*p == '\n') return p + 1;
    float third = 0.0F;
    if (scan::read_float(skip_blanks(p), third) != nullptr && third != 0.0F) {
      chunk_.has_third_texcoord = true;
    }
    return past_statement(p);
  }

  std::size_t count_so_far(ObjKind kind) const {
    switch (kind) {
      case kObjVertex:
        return chunk_.positions.size();
      case kObjTexcoord:
        return chunk_.texcoords.size();
      default:
        return chunk_.normals.size();
    }
  }

  const char* face(const char* p) {
    const std::size_t first = chunk_.corner_count();
    for (;;) {
      p = skip_blanks(p);
      if (at_end(p)) break;
      p = index(p);
      if (p == nullptr) return nullptr;
      if (*p == '/') {
        p = corner_attributes(p);
        if (p == nullptr) return nullptr;
      }
      if (!scan::ends_token(*p)) return fail(p, "not a face corner");
    }
    end_face(first);
    return *p == '\n' ? p + 1 : past_line(p);
  }

  void end_face(std::size_t first) {
    const std::size_t corners = chunk_.corner_count();
    for (ObjKind kind : {kObjTexcoord, kObjNormal}) {
      Scratch<std::uint32_t>& indices = chunk_.indices[kind].index;
      if (!indices.empty()) indices.fill_up(corners, kNone);
    }
    if (corners - first != 3) chunk_.all_triangles = false;
    chunk_.face_end.push(static_cast<std::uint32_t>(corners));
  }

  /// Reads "/t", "//n" or "/t/n" of the last pushed corner.
  const char* corner_attributes(const char* p) {
    for (ObjKind kind : {kObjTexcoord, kObjNormal}) {
      if (*p != '/') break;
      ++p;
      if (!is_digit(*p) && *p != '-') continue;
      chunk_.indices[kind].index.fill_up(chunk_.corner_count() - 1, kNone);
      p = attribute_index(p, kind);
      if (p == nullptr) return nullptr;
    }
    return p;
  }

  /// A bad index costs the corner its attribute, not the file its geometry. One past the end is
  /// found when the whole file is read.
  const char* attribute_index(const char* p, ObjKind kind) {
    ObjIndices& indices = chunk_.indices[kind];
    const bool is_relative = *p == '-';
    if (is_relative && !is_digit(p[1])) return fail(p, "not a face corner");
    std::uint32_t value = 0;
    const char* const next = scan::read_digits(is_relative ? p + 1 : p, value);
    const std::size_t here = count_so_far(kind);
    if (value == 0 || (is_relative && value > here + kObjFurthestBack)) {
      indices.index.push(kNone);
      ++indices.bad;
    } else if (is_relative) {
      indices.relative.push_back(static_cast<std::uint32_t>(indices.index.size()));
      indices.index.push(static_cast<std::uint32_t>(here - value));
    } else {
      indices.index.push(value - 1);
    }
    return next;
  }

  const char* index(const char* p) {
    if (!is_digit(*p)) return relative_index(p);
    ObjIndices& indices = chunk_.indices[kObjVertex];
    std::uint32_t value = 0;
    const char* const next = scan::read_digits(p, value);
    if (value == 0) return fail(p, "index 0: OBJ counts from 1");
    if (value > bounds_.count) return fail(p, "vertex index out of range");
    indices.largest = std::max(indices.largest, value);
    indices.index.push(value - 1);
    return next;
  }

  const char* relative_index(const char* p) {
    if (p[0] != '-' || !is_digit(p[1])) return fail(p, "not a face corner");
    ObjIndices& indices = chunk_.indices[kObjVertex];
    std::uint32_t back = 0;
    const char* const next = scan::read_digits(p + 1, back);
    const std::size_t here = count_so_far(kObjVertex);
    if (back == 0) return fail(p, "index 0: OBJ counts from 1");
    if (back > here + bounds_.before) return fail(p, "vertex index out of range");
    if (back > here) indices.reach_back = std::max<std::uint64_t>(indices.reach_back, back - here);
    indices.relative.push_back(static_cast<std::uint32_t>(indices.index.size()));
    indices.index.push(static_cast<std::uint32_t>(here - back));
    return next;
  }

  const char* name(char kind, const char* p) {
    p = scan::skip_blanks(p);
    const char* const next = past_line(p);
    const char* last = next;
    while (last > p && static_cast<unsigned char>(last[-1]) <= ' ')
      --last;
    chunk_.names.push_back({kind, static_cast<std::uint32_t>(chunk_.face_end.size()),
                            std::string_view(p, static_cast<std::size_t>(last - p))});
    return next;
  }

  const char* vertex_number(const char* p, std::uint32_t& value) {
    p = skip_blanks(p);
    if (!is_digit(*p)) return fail(p, "a crease needs vertex numbers");
    const char* const next = scan::read_digits(p, value);
    return scan::ends_token(*next) ? next : fail(p, "a crease needs vertex numbers");
  }

  /// Reads `e a b [sharpness]`.
  const char* edge(const char* p) {
    ObjTag found{.is_based_on_zero = false, .sharpness = kInfinite, .where = p};
    p = vertex_number(p, found.a);
    if (p != nullptr) p = vertex_number(p, found.b);
    if (p == nullptr) return nullptr;
    p = skip_blanks(p);
    if (!at_end(p)) p = number(p, found.sharpness, "");
    if (p == nullptr) return nullptr;
    chunk_.tags.push_back(found);
    return past_line(p);
  }

  /// Reads `t crease i/f/s i0 i1 .. f0 ..` (a chain of edges) and `t corner i/f/s i0 .. f0 ..`,
  /// with one sharpness for all or one for each. Ignores other tags.
  const char* tag(const char* p) {
    const char* const where = p = skip_blanks(p);
    const bool is_corner = std::strncmp(p, "corner", 6) == 0 && ends_keyword(p[6]);
    const bool is_crease = std::strncmp(p, "crease", 6) == 0 && ends_keyword(p[6]);
    if (!is_corner && !is_crease) return past_statement(p);
    std::uint32_t counts[3] = {};
    p = tag_counts(skip_blanks(p + 6), counts);
    if (p == nullptr) return nullptr;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i < counts[0] && p != nullptr; ++i) {
      p = vertex_number(p, vertices.emplace_back());
    }
    std::vector<float> sharpness;
    for (std::uint32_t i = 0; i < counts[1] && p != nullptr; ++i) {
      p = number(p, sharpness.emplace_back(), "a tag has fewer values than its counts declare");
    }
    if (p == nullptr) return nullptr;
    const std::size_t tags =
        is_corner ? vertices.size() : vertices.size() - (vertices.empty() ? 0 : 1);
    if (sharpness.size() != 1 && sharpness.size() != tags) {
      return fail(where, "a tag needs one sharpness, or one per edge or vertex");
    }
    for (std::size_t i = 0; i < tags; ++i) {
      chunk_.tags.push_back({is_corner, true, vertices[i], is_corner ? 0 : vertices[i + 1],
                             sharpness.size() == 1 ? sharpness[0] : sharpness[i], where});
    }
    return past_statement(p);
  }

  const char* tag_counts(const char* p, std::uint32_t (&counts)[3]) {
    for (int i = 0; i < 3; ++i) {
      if (i > 0 && *p++ != '/') return fail(p - 1, "a tag needs counts like 2/1/0");
      if (!is_digit(*p)) return fail(p, "a tag needs counts like 2/1/0");
      p = scan::read_digits(p, counts[i]);
    }
    return p;
  }

  const char* const end_;
  const ObjBounds& bounds_;
  const glm::dvec3& origin_;
  const bool is_wide_;
  ObjChunk& chunk_;
};

/// Makes room for the largest contents of `bytes` bytes. A corner takes at least two ("1 "), a face
/// two ("f\n"), a position or normal eight ("v 1 1 1\n"), and a texture coordinate five ("vt 1\n");
/// the divisors do not exceed these.
void start(ObjChunk& chunk, std::size_t bytes) {
  chunk.positions.start(bytes / 6 + 1);
  chunk.colors.start(bytes / 6 + 1);
  chunk.normals.start(bytes / 6 + 1);
  chunk.texcoords.start(bytes / 4 + 1);
  for (ObjIndices& indices : chunk.indices) {
    indices.index.start(bytes / 2 + 1);
    indices.relative.clear();
    indices.largest = 0;
    indices.reach_back = 0;
    indices.bad = 0;
  }
  chunk.face_end.start(bytes / 2 + 1);
  chunk.all_triangles = true;
  chunk.names.clear();
  chunk.tags.clear();
  chunk.points = chunk.lines = chunk.curves = 0;
  chunk.has_weights = chunk.has_third_texcoord = false;
  chunk.unknown.clear();
  chunk.coordinate_error = 0.0;
  chunk.error = chunk.error_at = nullptr;
}

}  // namespace

void parse_obj_chunk(const char* begin, const char* end, const ObjBounds& bounds,
                     const glm::dvec3& origin, ObjChunk& chunk) {
  start(chunk, static_cast<std::size_t>(end - begin));
  Parser(end, bounds, origin, chunk).run(begin);
}

const char* next_obj_line(const char* text_begin, const char* from, const char* end) {
  // The newline that ends the line before `from` may be the character right before it.
  const char* p = from > text_begin ? from - 1 : from;
  for (;;) {
    if (p >= end) return end;
    const char* const newline =
        static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
    if (newline == nullptr) return end;
    if (!ends_in_backslash(text_begin, newline)) return newline + 1;
    p = newline + 1;
  }
}

}  // namespace mesher::io
