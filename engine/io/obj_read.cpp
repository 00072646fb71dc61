#include "engine/io/obj_read.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/io/far_origin.h"
#include "engine/io/format.h"
#include "engine/io/obj_chunk.h"
#include "engine/io/obj_creases.h"
#include "engine/io/obj_groups.h"
#include "engine/io/obj_materials.h"
#include "engine/io/text_cursor.h"

namespace mesher::io {
namespace {

/// Bytes of text per chunk. Small enough that the text and its contents fit in a core's cache.
constexpr std::size_t kChunkBytes = std::size_t{1} << 18;
/// Number of chunks parsed before their contents are combined.
constexpr std::size_t kWave = 16;
/// Number of elements that one thread gathers at a time.
constexpr std::size_t kIndexGrain = std::size_t{1} << 15;

/// Times of parsing the text and of bringing attributes to the corners, without attributes 0.5 %.
constexpr double kParseWeight = 0.97;
constexpr double kFinishWeight = 0.03;

/// Range of a chunk and the element counts before it: enough to find an error's line later.
struct ChunkRange {
  const char* begin;
  const char* end;
  std::size_t before[kObjKinds];
};

/// Part of the file that a wave covers, as fractions of its bytes.
struct Stretch {
  double begin;
  double end;
};

/// Extends an array to `size` elements after a wave.
///
/// If that needs new memory, it reserves enough for the rest of the file, assuming as many elements
/// per byte as in this wave. So an array moves once or twice at most. (Reserved pages that are
/// never reached cost nothing.)
template <class T>
void grow(Array<T>& array, std::size_t size, Stretch wave) {
  if (size > array.capacity()) {
    const double rate = static_cast<double>(size - array.size()) / (wave.end - wave.begin);
    const double expected = 1.02 * rate * (1.0 - wave.end);
    array.reserve(size + static_cast<std::size_t>(expected));
  }
  array.resize(size);
}

/// Combines chunks in file order.
class ObjAssembly {
 public:
  ObjAssembly(const MappedFile& file, const ReadOptions& options,
              const glm::dvec3& origin = glm::dvec3(0.0))
      : file_(file), options_(options), origin_(origin) {
    soup_.origin = origin;
  }

  Soup run() {
    Stages stages(options_.progress, {kParseWeight, kFinishWeight});
    stages.next();
    parse_all();
    stages.next();
    return finish();
  }

  /// Returns the largest distance of a coordinate from its number in the text. Pre: origin is 0.
  double coordinate_error() const { return coordinate_error_; }
  const ObjGroups& groups() const { return groups_; }

 private:
  void parse_all() {
    const char* p = text_start(file_);
    std::vector<ObjChunk> wave(kWave);
    while (p < file_.end()) {
      std::vector<ChunkRange> ranges;
      while (ranges.size() < kWave && p < file_.end()) {
        const std::size_t left = static_cast<std::size_t>(file_.end() - p);
        const char* const end =
            left <= kChunkBytes ? file_.end() : next_obj_line(p, p + kChunkBytes, file_.end());
        ranges.push_back({p, end, {}});
        p = end;
      }
      parse(ranges, wave);
      append(ranges, wave);
      report(options_.progress, static_cast<float>(share(p)));
    }
  }

  double share(const char* p) const {
    return static_cast<double>(p - file_.begin()) / static_cast<double>(file_.size());
  }

  [[noreturn]] void fail(const char* where, std::string_view reason) const {
    throw InputError(file_.name(), file_.line_of(where), reason);
  }

  void parse(const std::vector<ChunkRange>& ranges, std::vector<ObjChunk>& wave) const {
    parallel_chunks(ranges.size(), 1, [&](std::size_t i, IndexRange) {
      parse_obj_chunk(ranges[i].begin, ranges[i].end, ObjBounds(), origin_, wave[i]);
    });
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (wave[i].error != nullptr) fail(wave[i].error_at, wave[i].error);
    }
  }

  void append(std::vector<ChunkRange>& ranges, const std::vector<ObjChunk>& wave) {
    const std::size_t first_face = face_count_;
    const std::size_t first_corner = corner_count_;
    std::vector<std::size_t> corner_at(ranges.size());
    std::vector<std::size_t> face_at(ranges.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      std::copy_n(count_, kObjKinds, ranges[i].before);
      corner_at[i] = corner_count_;
      face_at[i] = face_count_;
      count(wave[i], ranges[i]);
    }
    make_room(first_corner, first_face, {share(ranges.front().begin), share(ranges.back().end)});
    parallel_chunks(ranges.size(), 1, [&](std::size_t i, IndexRange) {
      copy_chunk(wave[i], ranges[i], corner_at[i], face_at[i]);
    });
  }

  /// Adds a chunk's element counts and takes over its rare contents.
  void count(const ObjChunk& chunk, const ChunkRange& range) {
    for (const ObjName& name : chunk.names) {
      note(name);
      groups_.add(name, static_cast<std::uint32_t>(face_count_ + name.face));
    }
    note_rest(chunk);
    tags_.insert(tags_.end(), chunk.tags.begin(), chunk.tags.end());
    for (int kind = 0; kind < kObjKinds; ++kind) {
      has_[kind] = has_[kind] || !chunk.indices[kind].index.empty();
      bad_indices_ += chunk.indices[kind].bad;
    }
    const ObjIndices& vertices = chunk.indices[kObjVertex];
    if (vertices.largest > largest_) {
      largest_ = vertices.largest;
      largest_at_ = range;
    }
    if (vertices.reach_back > count_[kObjVertex]) fail_in(range, false);
    count_[kObjVertex] += chunk.positions.size();
    count_[kObjTexcoord] += chunk.texcoords.size();
    count_[kObjNormal] += chunk.normals.size();
    corner_count_ += chunk.corner_count();
    face_count_ += chunk.face_end.size();
    FaceLimit::check(face_count_);
    has_colors_ = has_colors_ || !chunk.colors.empty();
    all_triangles_ = all_triangles_ && chunk.all_triangles;
    constexpr std::size_t kMost = kNone - 1;
    if (std::max({corner_count_, face_count_, count_[0], count_[1], count_[2]}) > kMost) {
      throw InputError(file_.name(), 0, "more elements than 32-bit indices can address");
    }
  }

  void make_room(std::size_t first_corner, std::size_t first_face, Stretch wave) {
    grow(soup_.positions, count_[kObjVertex], wave);
    if (has_colors_) grow_filled(colors_, count_[kObjVertex], glm::u8vec4(255), wave);
    grow(texcoords_, count_[kObjTexcoord], wave);
    grow(normals_, count_[kObjNormal], wave);
    grow(soup_.corners, corner_count_, wave);
    for (ObjKind kind : {kObjTexcoord, kObjNormal}) {
      if (!has_[kind]) continue;
      if (index_[kind].empty()) index_[kind].assign(first_corner, kNone);
      grow(index_[kind], corner_count_, wave);
    }
    if (all_triangles_) return;
    if (soup_.face_start.empty()) {
      soup_.face_start.resize(first_face + 1);
      for (std::size_t f = 0; f <= first_face; ++f) {
        soup_.face_start[f] = static_cast<std::uint32_t>(3 * f);
      }
    }
    grow(soup_.face_start, face_count_ + 1, wave);
  }

  template <class T>
  static void grow_filled(Array<T>& array, std::size_t size, const T& value, Stretch wave) {
    const std::size_t before = array.size();
    grow(array, size, wave);
    std::fill(array.begin() + static_cast<std::ptrdiff_t>(before), array.end(), value);
  }

  void copy_chunk(const ObjChunk& chunk, const ChunkRange& range, std::size_t corner_at,
                  std::size_t face_at) {
    const auto copy = [](const auto& from, auto& to, std::size_t at) {
      std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(at));
    };
    copy(chunk.positions, soup_.positions, range.before[kObjVertex]);
    copy(chunk.texcoords, texcoords_, range.before[kObjTexcoord]);
    copy(chunk.normals, normals_, range.before[kObjNormal]);
    if (has_colors_) copy(chunk.colors, colors_, range.before[kObjVertex]);
    copy_indices(chunk.indices[kObjVertex], range.before[kObjVertex], soup_.corners, corner_at);
    for (ObjKind kind : {kObjTexcoord, kObjNormal}) {
      if (!has_[kind]) continue;
      if (chunk.indices[kind].index.empty()) {
        std::fill_n(index_[kind].begin() + static_cast<std::ptrdiff_t>(corner_at),
                    chunk.corner_count(), kNone);
      } else {
        copy_indices(chunk.indices[kind], range.before[kind], index_[kind], corner_at);
        drop_before_start(chunk.indices[kind], range.before[kind], index_[kind], corner_at);
      }
    }
    if (all_triangles_) return;
    std::uint32_t* face_start = soup_.face_start.data() + face_at + 1;
    for (const std::uint32_t end : chunk.face_end) {
      *face_start++ = static_cast<std::uint32_t>(corner_at + end);
    }
  }

  static void copy_indices(const ObjIndices& from, std::size_t before, Array<std::uint32_t>& to,
                           std::size_t at) {
    std::copy(from.index.begin(), from.index.end(), to.begin() + static_cast<std::ptrdiff_t>(at));
    for (const std::uint32_t corner : from.relative) {
      to[at + corner] += static_cast<std::uint32_t>(before);
    }
  }

  /// Takes their indices from corners whose relative index lies before the start of the file.
  void drop_before_start(const ObjIndices& from, std::size_t before, Array<std::uint32_t>& to,
                         std::size_t at) {
    for (const std::uint32_t corner : from.relative) {
      const std::uint32_t index = from.index.begin()[corner];
      const std::uint32_t reach = 0U - index;
      if (reach > kObjFurthestBack || reach == 0 || reach <= before) continue;
      to[at + corner] = kNone;
      ++bad_indices_;
    }
  }

  void note(const ObjName& name) {
    if (name.name.empty() || (name.kind == 's' && is_smoothing_off(name.name))) return;
    if (!seen_[static_cast<unsigned char>(name.kind)].insert(name.name).second) return;
    switch (name.kind) {
      case 's':
        soup_.contents.add(Content::smoothing_groups, name.name);
        break;
      case 'o':
        soup_.contents.add(Content::objects, name.name);
        break;
      case 'g':
        soup_.contents.add(Content::groups, name.name);
        break;
      default:  // materials are noted with their files
        break;
    }
  }

  void note_rest(const ObjChunk& chunk) {
    FileContents& contents = soup_.contents;
    contents[Content::points] += chunk.points;
    contents[Content::lines] += chunk.lines;
    contents[Content::curves] += chunk.curves;
    for (const std::string_view keyword : chunk.unknown) {
      if (seen_[0].insert(keyword).second) contents.add(Content::own_properties, keyword);
    }
    const auto note_once = [&](bool is_there, std::string_view words) {
      if (is_there && seen_[0].insert(words).second) contents.add(Content::own_properties, words);
    };
    note_once(chunk.has_weights, "weights of vertices");
    note_once(chunk.has_third_texcoord, "third texture coordinates");
    coordinate_error_ = std::max(coordinate_error_, chunk.coordinate_error);
  }

  Soup finish() {
    if (largest_ > count_[kObjVertex]) fail_in(largest_at_, true);
    if (soup_.positions.empty()) throw InputError(file_.name(), 0, "no vertices");
    Stages stages(options_.progress, {1.0, 1.0, 1.0, 1.0});
    stages.next();
    gather_texcoords();
    stages.next();
    gather_normals();
    stages.next();
    gather_colors();
    stages.next();
    groups_.finish(face_count_, soup_.attributes);
    soup_.contents[Content::uv_sets] = has_[kObjTexcoord] ? 1 : 0;
    soup_.contents[Content::normals] = has_[kObjNormal] ? 1 : 0;
    soup_.contents[Content::color_sets] = has_colors_ ? 1 : 0;
    soup_.report[Repair::attribute_indices_ignored] = bad_indices_;
    check_cancelled(options_.progress);
    add_obj_tags(file_, options_.crease_index_base, tags_, soup_);
    return std::move(soup_);
  }

  /// Parses a chunk with an index out of range again, now with known bounds, to report the error.
  [[noreturn]] void fail_in(const ChunkRange& range, bool is_whole_file_read) const {
    ObjBounds bounds;
    // While chunks remain, the limit on forward references is unknown.
    if (is_whole_file_read) bounds.count = count_[kObjVertex];
    bounds.before = range.before[kObjVertex];
    ObjChunk chunk;
    parse_obj_chunk(range.begin, range.end, bounds, origin_, chunk);
    fail(chunk.error != nullptr ? chunk.error_at : range.begin,
         chunk.error != nullptr ? chunk.error : "index out of range");
  }

  void gather_texcoords() {
    if (!has_[kObjTexcoord]) return;
    gather(index_[kObjTexcoord], texcoords_, glm::vec2(std::numeric_limits<float>::quiet_NaN()),
           soup_.attributes.texcoord);
    index_[kObjTexcoord] = {};
  }

  void gather_normals() {
    if (!has_[kObjNormal]) return;
    gather(index_[kObjNormal], normals_, glm::vec3(std::numeric_limits<float>::quiet_NaN()),
           soup_.attributes.normal);
    index_[kObjNormal] = {};
  }

  void gather_colors() {
    if (has_colors_) gather(soup_.corners, colors_, glm::u8vec4(255), soup_.attributes.color);
  }

  template <class T>
  void gather(const Array<std::uint32_t>& index, const Array<T>& values, const T& absent,
              Array<T>& out) {
    out.resize(index.size());
    parallel_chunks(index.size(), kIndexGrain, options_.progress,
                    [&](std::size_t, IndexRange range) {
                      std::uint64_t bad = 0;
                      for (std::size_t c = range.begin; c < range.end; ++c) {
                        const bool is_there = index[c] < values.size();
                        bad += !is_there && index[c] != kNone ? 1 : 0;
                        out[c] = is_there ? values[index[c]] : absent;
                      }
                      if (bad > 0) bad_indices_ += bad;
                    });
  }

  const MappedFile& file_;
  const ReadOptions& options_;
  glm::dvec3 origin_;
  Soup soup_;
  std::size_t count_[kObjKinds] = {};  ///< vertices, texture coordinates, normals so far
  std::size_t corner_count_ = 0;
  std::size_t face_count_ = 0;
  bool has_[kObjKinds] = {};  ///< whether any corner has an index of the kind
  bool has_colors_ = false;
  bool all_triangles_ = true;
  std::uint32_t largest_ = 0;  ///< vertex index, counted from 1
  ChunkRange largest_at_ = {};
  std::atomic<std::uint64_t> bad_indices_{0};
  double coordinate_error_ = 0.0;
  /// Names that were noted, by ObjName::kind; [0]: unknown statements.
  std::unordered_map<unsigned char, std::unordered_set<std::string_view>> seen_;
  Array<std::uint32_t> index_[kObjKinds];  ///< those of vertices are soup_.corners
  Array<glm::vec2> texcoords_;
  Array<glm::vec3> normals_;
  Array<glm::u8vec4> colors_;
  std::vector<ObjTag> tags_;
  ObjGroups groups_;
};

}  // namespace

Soup read_obj(const MappedFile& file, const ReadOptions& options) {
  ObjAssembly assembly(file, options);
  Soup soup = assembly.run();
  const glm::dvec3 origin = choose_origin(soup.positions, assembly.coordinate_error());
  if (origin != glm::dvec3(0.0)) {
    soup = {};
    soup = ObjAssembly(file, options, origin).run();
  }
  add_materials(file, assembly.groups(), soup);
  return soup;
}

}  // namespace mesher::io
