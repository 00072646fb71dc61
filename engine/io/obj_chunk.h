#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/assert.h"

namespace mesher::io {

/// Reusable storage with a fixed capacity. Appending is a store and an increment. Pages that are
/// never reached are never touched.
template <class T>
class Scratch {
 public:
  /// Clears it and makes room for `capacity` elements.
  void start(std::size_t capacity) {
    size_ = 0;
    if (storage_.size() >= capacity) return;
    storage_.clear();  // no elements to copy
    storage_.resize(capacity);
  }
  void push(const T& value) {
    MESHER_ASSERT(size_ < storage_.size());
    storage_.data()[size_++] = value;
  }
  /// Appends copies of `value` until the size is `size`. For arrays that are first needed halfway
  /// through.
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

/// The three kinds of elements that OBJ indexes.
enum ObjKind : std::uint8_t { kObjVertex, kObjTexcoord, kObjNormal };
inline constexpr int kObjKinds = 3;

/// Range of valid vertex indices of a corner. The defaults allow any index, because a chunk does
/// not know the range while other chunks are still being parsed.
struct ObjBounds {
  std::uint64_t count = 0xFFFFFFFFU;  ///< in the whole file
  std::uint64_t before = 1ULL << 40;  ///< in the chunks before this one
};

/// A relative index of a texture coordinate or normal that reaches further back than this before
/// its chunk is bad. So one that reaches back, wrapped below zero, is at least
/// 2^32 - kObjFurthestBack, and larger than any index within a chunk.
inline constexpr std::uint32_t kObjFurthestBack = 0xF0000000U;

/// One kind of index of a chunk's corners.
struct ObjIndices {
  /// One per corner, counted from 0; kNone if the corner has no index. Empty if no corner has this
  /// kind. A relative index counts from the start of the chunk and wraps below zero if it refers to
  /// an earlier chunk.
  Scratch<std::uint32_t> index;
  std::vector<std::uint32_t> relative;  ///< corners whose index is relative
  std::uint32_t largest = 0;            ///< absolute index, counted from 1
  std::uint64_t reach_back = 0;         ///< largest distance of a relative index before the chunk
  std::uint64_t bad = 0;                ///< indices that no file can have; their corners have none
};

/// A change of name by `g`, `o`, `usemtl` or `s`, or a file of `mtllib`.
struct ObjName {
  char kind;           ///< 'g', 'o', 'u', 's' or 'm'
  std::uint32_t face;  ///< first face of the chunk with the name
  std::string_view name;
};

/// A crease or a corner as written in the file.
struct ObjTag {
  bool is_corner = false;
  bool is_based_on_zero = true;  ///< false for `e`: the whole file decides its base
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float sharpness = 0.0F;
  const char* where = nullptr;
};

/// The contents of a run of whole lines of an OBJ file, counted from its own start.
struct ObjChunk {
  Scratch<glm::vec3> positions;
  Scratch<glm::u8vec4> colors;  ///< one per position, or empty
  Scratch<glm::vec2> texcoords;
  Scratch<glm::vec3> normals;
  ObjIndices indices[kObjKinds];
  Scratch<std::uint32_t> face_end;  ///< one per face: number of corners up to its last
  bool all_triangles = true;
  std::vector<ObjName> names;
  std::vector<ObjTag> tags;
  std::uint64_t points = 0;
  std::uint64_t lines = 0;
  std::uint64_t curves = 0;
  bool has_weights = false;               ///< a vertex has a weight other than 1
  bool has_third_texcoord = false;        ///< that is not 0
  std::vector<std::string_view> unknown;  ///< keywords of statements; some may repeat
  /// Largest distance of a coordinate from its number in the text.
  double coordinate_error = 0.0;

  const char* error = nullptr;  ///< reason, or null
  const char* error_at = nullptr;

  std::size_t corner_count() const { return indices[kObjVertex].index.size(); }
};

/// Parses the whole lines [begin, end) into `chunk` and replaces its contents.
///
/// Stops at the first error and records it in `chunk`. Positions are relative to `origin`; unless
/// it is 0, they are read in double precision. Throws only if out of memory. Pre: the text is in a
/// MappedFile, and both ends are starts of lines or the end of the file.
void parse_obj_chunk(const char* begin, const char* end, const ObjBounds& bounds,
                     const glm::dvec3& origin, ObjChunk& chunk);

/// Returns the start of the first line at or after `from`. Does not split continued lines.
const char* next_obj_line(const char* text_begin, const char* from, const char* end);

}  // namespace mesher::io
