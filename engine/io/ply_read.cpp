#include "engine/io/ply_read.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/progress.h"
#include "engine/core/text.h"
#include "engine/io/far_origin.h"
#include "engine/io/ply_header.h"
#include "engine/io/ply_textures.h"
#include "engine/io/ply_values.h"
#include "engine/io/soup_faces.h"
#include "engine/io/vertex_attributes.h"

namespace mesher::io {
namespace {

constexpr std::uint64_t kPlyRowsPerReport = 4096;
/// Times of reading the elements and of bringing attributes to the corners, without attributes 1 %.
constexpr double kPlyReadWeight = 0.97;
constexpr double kPlyFinishWeight = 0.03;

/// Role of a vertex property.
enum class Role { none, position, normal, texcoord, color };
struct Slot {
  Role role = Role::none;
  int component = 0;
};

Slot slot_of(std::string_view name) {
  static constexpr struct {
    std::string_view name;
    Slot slot;
  } kSlots[] = {{"x", {Role::position, 0}},         {"y", {Role::position, 1}},
                {"z", {Role::position, 2}},         {"nx", {Role::normal, 0}},
                {"ny", {Role::normal, 1}},          {"nz", {Role::normal, 2}},
                {"s", {Role::texcoord, 0}},         {"t", {Role::texcoord, 1}},
                {"u", {Role::texcoord, 0}},         {"v", {Role::texcoord, 1}},
                {"texture_u", {Role::texcoord, 0}}, {"texture_v", {Role::texcoord, 1}},
                {"red", {Role::color, 0}},          {"green", {Role::color, 1}},
                {"blue", {Role::color, 2}},         {"alpha", {Role::color, 3}},
                {"diffuse_red", {Role::color, 0}},  {"diffuse_green", {Role::color, 1}},
                {"diffuse_blue", {Role::color, 2}}};
  for (const auto& known : kSlots) {
    if (known.name == name) return known.slot;
  }
  return {};
}

/// Returns a color component as a byte. Floating-point values range over 0..1; integers use the
/// full range of their type.
std::uint8_t color_byte(double value, PlyType type) {
  if (!is_whole(type)) value *= 255.0;
  if (type == PlyType::uint16) value /= 257.0;
  return std::isnan(value) ? std::uint8_t{0}
                           : static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

template <class Values>
class PlyReader {
 public:
  PlyReader(const MappedFile& file, const PlyHeader& header, const glm::dvec3& origin,
            Progress* progress)
      : header_(header),
        values_(file, header.data),
        progress_(progress),
        textures_(header.textures.size()) {
    soup_.origin = origin;
    is_wide_ = origin != glm::dvec3(0.0);
  }

  Soup run() {
    Stages stages(progress_, {kPlyReadWeight, kPlyFinishWeight});
    stages.next();
    read_elements();
    stages.next();
    return finish();
  }

  double coordinate_error() const { return coordinate_error_; }

 private:
  void read_elements() {
    find_vertices();
    note_contents();
    soup_.face_start.push_back(0);
    for (const PlyElement& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.properties.empty()) {
        continue;  // any number of them takes no bytes
      } else if (element.name == "face") {
        FaceLimit::check(element.count);
        find_face_colors(element);
        read_rows(element.count, [&](std::uint64_t) { read_face(element); });
      } else if (element.name == "tristrips") {
        read_rows(element.count, [&](std::uint64_t) { read_strips(element); });
      } else {
        read_rows(element.count, [&](std::uint64_t) { skip_row(element); });
      }
    }
  }

  /// Names what is not read.
  void note_contents() {
    FileContents& contents = soup_.contents;
    soup_.report[Repair::header_lines_skipped] = header_.skipped_lines;
    for (const std::string& texture : header_.textures)
      contents.add(Content::textures, texture);
    for (const PlyElement& element : header_.elements) {
      const bool is_vertex = element.name == "vertex";
      const bool is_face = element.name == "face";
      if (!is_vertex && !is_face && element.name != "tristrips") {
        if (element.count > 0 && !element.properties.empty())
          contents.add(Content::own_properties, "element " + element.name);
        continue;
      }
      for (const PlyProperty& property : element.properties) {
        const bool is_read =
            is_vertex ? !property.count_type && slot_of(property.name).role != Role::none
                      : lists_vertices(property) ||
                            (is_face && (is_corner_texcoord(property) || is_face_color(property) ||
                                         is_texnumber(property)));
        if (!is_read) contents.add(Content::own_properties, element.name + " " + property.name);
      }
    }
  }

  static bool is_corner_texcoord(const PlyProperty& property) {
    return property.count_type && property.name == "texcoord";
  }
  static bool is_face_color(const PlyProperty& property) {
    return !property.count_type && slot_of(property.name).role == Role::color;
  }

  /// Without textures, the number means nothing to mesher.
  bool is_texnumber(const PlyProperty& property) const {
    return !header_.textures.empty() && !property.count_type && is_whole(property.type) &&
           property.name == "texnumber";
  }

  void find_face_colors(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      color_component_.push_back(is_face_color(property) ? slot_of(property.name).component : -1);
      has_face_colors_ = has_face_colors_ || color_component_.back() >= 0;
    }
  }

  /// Calls read(i) for each row, and reports the bytes that were read.
  template <class Read>
  void read_rows(std::uint64_t rows, const Read& read) {
    for (std::uint64_t begin = 0; begin < rows; begin += kPlyRowsPerReport) {
      const auto left = static_cast<double>(values_.file_bytes_left());
      report(progress_, static_cast<float>(1.0 - left / bytes_));
      const std::uint64_t end = std::min(rows, begin + kPlyRowsPerReport);
      for (std::uint64_t i = begin; i < end; ++i)
        read(i);
    }
  }

  void find_vertices() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") vertex_count_ = element.count;
    }
    if (vertex_count_ == 0) values_.fail("no vertices");
    if (vertex_count_ >= kNone) values_.fail("more elements than 32-bit indices can address");
  }

  /// Refuses counts that the rest of the file cannot hold. Call it before allocating.
  void check_count(const PlyElement& element) {
    std::size_t row = 0;
    for (const PlyProperty& property : element.properties) {
      row += Values::least_bytes(property.count_type.value_or(property.type));
    }
    if (row != 0 && element.count > values_.bytes_left() / row) {
      values_.fail("the file is too short for its " + element.name + " elements");
    }
  }

  void skip_property(const PlyProperty& property) {
    if (!property.count_type) return values_.skip(property.type);
    for (std::size_t left = list_size(property); left > 0; --left)
      values_.skip(property.type);
  }

  void skip_row(const PlyElement& element) {
    for (const PlyProperty& property : element.properties)
      skip_property(property);
  }

  std::size_t list_size(const PlyProperty& property) {
    const std::int64_t size = values_.next_whole(*property.count_type);
    if (size < 0) values_.fail("a list with a negative count");
    if (static_cast<std::uint64_t>(size) >
        values_.bytes_left() / Values::least_bytes(property.type)) {
      values_.fail("the file is too short for a list");
    }
    return static_cast<std::size_t>(size);
  }

  void read_vertices(const PlyElement& element) {
    std::vector<Slot> slots;
    bool has[5] = {};
    int coordinates = 0;
    for (const PlyProperty& property : element.properties) {
      slots.push_back(property.count_type ? Slot{} : slot_of(property.name));
      has[static_cast<int>(slots.back().role)] = true;
      if (slots.back().role == Role::position) coordinates |= 1 << slots.back().component;
    }
    if (coordinates != 7) values_.fail("vertices need x, y and z");
    const auto count = static_cast<std::size_t>(element.count);
    soup_.positions.resize(count);
    if (has[static_cast<int>(Role::normal)]) normals_.assign(count, glm::vec3(0.0F));
    if (has[static_cast<int>(Role::texcoord)]) texcoords_.assign(count, glm::vec2(0.0F));
    if (has[static_cast<int>(Role::color)]) colors_.assign(count, glm::u8vec4(255));
    read_rows(count, [&](std::uint64_t v) {
      for (std::size_t i = 0; i < slots.size(); ++i)
        read_value(element.properties[i], slots[i], v);
      values_.end_row();
    });
  }

  void read_value(const PlyProperty& property, Slot slot, std::size_t v) {
    switch (slot.role) {
      case Role::position:
        soup_.positions[v][slot.component] = coordinate(property.type, slot.component);
        break;
      case Role::normal:
        normals_[v][slot.component] = values_.next_float(property.type);
        break;
      case Role::texcoord:
        texcoords_[v][slot.component] = values_.next_float(property.type);
        break;
      case Role::color:
        colors_[v][slot.component] = color_byte(values_.next(property.type), property.type);
        break;
      case Role::none:
        skip_property(property);
        break;
    }
  }

  float coordinate(PlyType type, int axis) {
    if (is_wide_) return static_cast<float>(values_.next(type) - soup_.origin[axis]);
    return values_.coordinate(type, coordinate_error_);
  }

  std::uint32_t check_index(std::int64_t index) {
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
      values_.fail("vertex index out of range");
    }
    return static_cast<std::uint32_t>(index);
  }

  static bool lists_vertices(const PlyProperty& property) {
    return property.count_type &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  void end_face(std::int64_t texnumber = 0) {
    if (soup_.corners.size() >= kNone)
      values_.fail("more elements than 32-bit indices can address");
    soup_.face_start.push_back(static_cast<std::uint32_t>(soup_.corners.size()));
    textures_.add_face(texnumber);
  }

  void read_face(const PlyElement& element) {
    const std::size_t first = soup_.corners.size();
    corner_texcoords_.clear();
    glm::u8vec4 color(255);
    std::int64_t texnumber = 0;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (lists_vertices(property)) {
        for (std::size_t left = list_size(property); left > 0; --left) {
          soup_.corners.push_back(check_index(values_.next_whole(property.type)));
        }
      } else if (color_component_[i] >= 0) {
        color[color_component_[i]] = color_byte(values_.next(property.type), property.type);
      } else if (is_corner_texcoord(property)) {
        for (std::size_t left = list_size(property); left > 0; --left) {
          corner_texcoords_.push_back(values_.next_float(property.type));
        }
      } else if (is_texnumber(property)) {
        texnumber = values_.next_whole(property.type);
      } else {
        skip_property(property);
      }
    }
    values_.end_row();
    end_face(texnumber);
    if (has_face_colors_) {
      face_colors_.resize(soup_.face_start.size() - 2);  // strips before have none
      face_colors_.push_back({color, true});
    }
    keep_corner_texcoords(first);
  }

  void keep_corner_texcoords(std::size_t first) {
    if (corner_texcoords_.empty() && soup_.attributes.texcoord.empty()) return;
    constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
    const std::size_t corners = soup_.corners.size() - first;
    soup_.attributes.texcoord.resize(first, glm::vec2(kAbsent));
    const bool is_complete = corner_texcoords_.size() == 2 * corners;
    if (!is_complete && !corner_texcoords_.empty()) ++bad_texcoord_lists_;
    for (std::size_t c = 0; c < corners; ++c) {
      soup_.attributes.texcoord.push_back(
          is_complete ? glm::vec2(corner_texcoords_[2 * c], corner_texcoords_[2 * c + 1])
                      : glm::vec2(kAbsent));
    }
  }

  /// Each further index forms a triangle with the two before it; every other triangle is flipped.
  /// -1 starts a new strip.
  void read_strips(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (!lists_vertices(property)) {
        skip_property(property);
        continue;
      }
      std::uint32_t before[2] = {};
      std::size_t length = 0;
      for (std::size_t left = list_size(property); left > 0; --left) {
        const std::int64_t index = values_.next_whole(property.type);
        if (index == -1) {
          length = 0;
          continue;
        }
        const std::uint32_t v = check_index(index);
        if (length >= 2) {
          const bool is_turned = length % 2 == 1;
          soup_.corners.insert(soup_.corners.end(), {before[is_turned], before[!is_turned], v});
          end_face();
        }
        before[0] = before[1];
        before[1] = v;
        ++length;
      }
    }
  }

  Soup finish() {
    Stages stages(progress_, {1.0, 1.0, 1.0});
    stages.next();
    FileContents& contents = soup_.contents;
    textures_.finish(soup_);
    if (bad_texcoord_lists_ > 0) {
      contents.warn(count_phrase(static_cast<std::int64_t>(bad_texcoord_lists_),
                                 "{face|faces} without two texcoord values per corner: no texture "
                                 "coordinates"));
    }
    contents[Content::uv_sets] =
        (texcoords_.empty() ? 0U : 1U) + (soup_.attributes.texcoord.empty() ? 0U : 1U);
    contents[Content::normals] = normals_.empty() ? 0 : 1;
    contents[Content::color_sets] = (colors_.empty() ? 0U : 1U) + (face_colors_.empty() ? 0U : 1U);
    if (soup_.attributes.texcoord.empty()) {
      soup_.attributes.texcoord =
          spread_to_corners<glm::vec2>(soup_.corners, texcoords_, progress_);
    } else {
      soup_.attributes.texcoord.resize(soup_.corners.size(),
                                       glm::vec2(std::numeric_limits<float>::quiet_NaN()));
    }
    stages.next();
    soup_.attributes.normal = spread_to_corners<glm::vec3>(soup_.corners, normals_, progress_);
    stages.next();
    soup_.attributes.color = spread_to_corners<glm::u8vec4>(soup_.corners, colors_, progress_);
    spread_faces_to_corners(soup_.face_start, face_colors_, glm::u8vec4(255),
                            soup_.attributes.color);
    forget_triangle_starts(soup_);
    return std::move(soup_);
  }

  const PlyHeader& header_;
  Values values_;
  Progress* progress_;
  double bytes_ = static_cast<double>(std::max<std::size_t>(1, values_.file_bytes_left()));
  std::uint64_t vertex_count_ = 0;
  Soup soup_;
  Array<glm::vec3> normals_;
  Array<glm::vec2> texcoords_;
  Array<glm::u8vec4> colors_;
  std::vector<float> corner_texcoords_;  ///< of the current face
  Array<FaceValue<glm::u8vec4>> face_colors_;
  bool has_face_colors_ = false;
  PlyFaceTextures textures_;
  std::uint64_t bad_texcoord_lists_ = 0;
  std::vector<int> color_component_;  ///< of each property of a face, -1: no color
  bool is_wide_ = false;
  double coordinate_error_ = 0.0;
};

/// Reads about zero, and again about an origin if that keeps more digits.
template <class Values>
Soup read_values(const MappedFile& file, const PlyHeader& header, Progress* progress) {
  PlyReader<Values> reader(file, header, glm::dvec3(0.0), progress);
  Soup soup = reader.run();
  const glm::dvec3 origin = choose_origin(soup.positions, reader.coordinate_error());
  if (origin == glm::dvec3(0.0)) return soup;
  soup = {};
  return PlyReader<Values>(file, header, origin, progress).run();
}

Soup read_encoding(const MappedFile& file, const PlyHeader& header, Progress* progress) {
  constexpr bool kIsLittle = std::endian::native == std::endian::little;
  switch (header.encoding) {
    case PlyEncoding::text:
      return read_values<PlyTextValues>(file, header, progress);
    case PlyEncoding::little_endian:
      return read_values<PlyBinaryValues<!kIsLittle>>(file, header, progress);
    case PlyEncoding::big_endian:
      break;
  }
  return read_values<PlyBinaryValues<kIsLittle>>(file, header, progress);
}

}  // namespace

Soup read_ply(const MappedFile& file, Progress* progress) {
  const PlyHeader header = read_ply_header(file);
  Soup soup = read_encoding(file, header, progress);
  add_ply_materials(file, header.textures, soup);
  return soup;
}

}  // namespace mesher::io
