#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/assert.h"

namespace mesher {

/// Space for a known largest number of elements, used again from chunk to chunk: appending is a
/// store and an increment, and pages that are never reached are never filled.
template <class T>
class Scratch {
 public:
  /// Empties it and makes room for `capacity` elements.
  void start(std::size_t capacity) {
    size_ = 0;
    if (storage_.size() >= capacity) return;
    storage_.clear();  // nothing to carry over
    storage_.resize(capacity);
  }
  void push(const T& value) {
    MESHER_ASSERT(size_ < storage_.size());
    storage_.data()[size_++] = value;
  }
  /// Appends copies up to a size. For arrays that begin to matter half way.
  void fill_up(std::size_t size, const T& value) {
    while (size_ < size)
      push(value);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* begin() const { return storage_.data(); }
  const T* end() const { return storage_.data() + size_; }

 private:
  Array<T> storage_;
  std::size_t size_ = 0;
};

/// The three things that OBJ counts.
enum ObjKind : std::uint8_t { kObjVertex, kObjTexcoord, kObjNormal };
inline constexpr int kObjKinds = 3;

/// What a corner's indices may name. As far as a chunk knows while the others are still being
/// parsed: anything.
struct ObjBounds {
  std::uint64_t count = 0xFFFFFFFFU;  ///< in the whole file
  std::uint64_t before = 1ULL << 40;  ///< in the chunks before this one
};

/// One kind of index of a chunk's corners.
struct ObjIndices {
  /// One a corner, or empty where no corner has this kind; counted from 0, kNone where absent. A
  /// relative index counts from the chunk's start, and wraps below zero where it reaches back.
  Scratch<std::uint32_t> index;
  std::vector<std::uint32_t> relative;  ///< corners whose index is relative
  std::uint32_t largest = 0;            ///< of the absolute ones, counted from 1
  std::uint64_t reach_back = 0;         ///< how far before the chunk a relative one reaches
};

/// A name takes effect: `g`, `o` or `usemtl`.
struct ObjName {
  char kind;           ///< 'g', 'o' or 'u'
  std::uint32_t face;  ///< first face of the chunk that has it
  std::string_view name;
};

/// A crease or a corner as written.
struct ObjTag {
  bool is_corner = false;
  bool is_based_on_zero = true;  ///< false for `e`, whose base the file as a whole decides
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float sharpness = 0.0F;
  const char* where = nullptr;
};

/// What a run of whole lines of an OBJ file says, counted from its own start.
struct ObjChunk {
  Scratch<glm::vec3> positions;
  Scratch<glm::u8vec4> colors;  ///< one a position, or empty
  Scratch<glm::vec2> texcoords;
  Scratch<glm::vec3> normals;
  ObjIndices indices[kObjKinds];
  Scratch<std::uint32_t> face_end;  ///< one a face: number of corners up to its last
  bool all_triangles = true;
  std::vector<ObjName> names;
  std::vector<ObjTag> tags;

  const char* error = nullptr;  ///< reason, or null
  const char* error_at = nullptr;

  std::size_t corner_count() const { return indices[kObjVertex].index.size(); }
};

/// Parses whole lines [begin, end) into `chunk`, whose contents are replaced; stops at the first
/// error and notes it there. Never throws but for lack of memory. Pre: the text lies in a
/// MappedFile, and both ends are starts of lines or the end of the file.
void parse_obj_chunk(const char* begin, const char* end, const ObjBounds (&bounds)[kObjKinds],
                     ObjChunk& chunk);

/// Start of the first line at or after `from`: continued lines are not torn apart.
const char* next_obj_line(const char* text_begin, const char* from, const char* end);

}  // namespace mesher
