#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/assert.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// The meaning of an attribute, which decides how an edit computes new values.
enum class AttributeKind : std::uint8_t {
  texcoord,
  normal,   ///< has unit length
  tangent,  ///< xyz has unit length; w is the handedness of the bitangent, 1 or -1
  color,
  joints,   ///< indices of bones: never blended
  weights,  ///< of the bones
  delta,    ///< what a morph target adds to another attribute
  custom,
};

/// The type of one component in memory.
enum class ComponentType : std::uint8_t { s8, u8, s16, u16, u32, f32 };

/// Returns the size of a component in bytes.
constexpr std::size_t bytes_of(ComponentType type) {
  switch (type) {
    case ComponentType::s8:
    case ComponentType::u8:
      return 1;
    case ComponentType::s16:
    case ComponentType::u16:
      return 2;
    case ComponentType::u32:
    case ComponentType::f32:
      return 4;
  }
  return 0;
}

/// What one value of an attribute is.
struct AttributeType {
  static constexpr std::size_t kMostComponents = 4;

  AttributeKind kind = AttributeKind::custom;
  std::string name;  ///< as glTF names it: "TEXCOORD_0", "COLOR_1", "_TEMPERATURE"
  std::uint8_t components = 1;
  ComponentType component = ComponentType::f32;
  bool is_normalized = false;  ///< integers are fractions of the largest one
  bool counts_down = false;    ///< texture coordinates: v is 0 at the top of the image, as in glTF
  bool is_linear = false;      ///< colors: linear in light, as in glTF; otherwise sRGB

  std::size_t value_bytes() const { return components * bytes_of(component); }
  friend bool operator==(const AttributeType&, const AttributeType&) = default;
};

/// Returns a type for users: "TEXCOORD_0: 2 x u16, normalized".
std::string type_text(const AttributeType& type);

/// The types of the attributes that most formats have. `set` counts from 0.
AttributeType texcoord_type(std::uint32_t set = 0);  ///< two floats
AttributeType normal_type();                         ///< three floats
AttributeType color_type(std::uint32_t set = 0);     ///< RGBA in bytes, 255 is full intensity

/// One attribute: values of one type, without gaps.
class AttributeLayer {
 public:
  AttributeLayer() = default;
  AttributeLayer(AttributeType type, std::size_t count)
      : type_(std::move(type)), bytes_(count * type_.value_bytes()) {}
  /// Copies the values. Pre: T has the size of a value.
  template <class T>
  AttributeLayer(AttributeType type, std::span<const T> values)
      : AttributeLayer(std::move(type), values.size()) {
    std::ranges::copy(values, this->values<T>().begin());
  }

  const AttributeType& type() const { return type_; }
  std::size_t count() const { return bytes_.size() / type_.value_bytes(); }
  void resize(std::size_t count) { bytes_.resize(count * type_.value_bytes()); }

  /// Returns the values as a type of the same size, such as glm::vec2.
  template <class T>
  std::span<T> values() {
    MESHER_ASSERT(sizeof(T) == type_.value_bytes());
    return {reinterpret_cast<T*>(bytes_.data()), count()};
  }
  template <class T>
  std::span<const T> values() const {
    MESHER_ASSERT(sizeof(T) == type_.value_bytes());
    return {reinterpret_cast<const T*>(bytes_.data()), count()};
  }
  std::span<const std::byte> value(std::size_t i) const {
    return std::span(bytes_).subspan(i * type_.value_bytes(), type_.value_bytes());
  }
  std::span<std::byte> value(std::size_t i) {
    return std::span(bytes_).subspan(i * type_.value_bytes(), type_.value_bytes());
  }
  Array<std::byte>& bytes() { return bytes_; }
  const Array<std::byte>& bytes() const { return bytes_; }

 private:
  AttributeType type_;
  Array<std::byte> bytes_;
};

/// A value with any type of component as numbers. Components beyond those of its type are 0.
using AttributeValue = std::array<double, AttributeType::kMostComponents>;

/// Returns a value of a layer; normalized integers become fractions.
AttributeValue load(const AttributeLayer& layer, std::size_t i);
/// Sets a value of a layer; integers are rounded and clamped to their range.
void store(AttributeLayer& layer, std::size_t i, const AttributeValue& value);
/// Returns whether values may be blended: floats and fractions, but not what belongs to bones.
bool can_blend(const AttributeType& type);
/// Sets a value to the mean of two. Integers are rounded up. Pre: the layers have one type.
void store_mean(AttributeLayer& layer, std::size_t i, const AttributeLayer& from, std::size_t a,
                std::size_t b);
/// Sets the value of a corner that has none in its file: NaN in floats, white in colors, otherwise
/// 0.
void store_absent(AttributeLayer& layer, std::size_t i);
/// Returns whether a value is that of a corner that has none. Integers always have a value.
bool is_absent(const AttributeLayer& layer, std::size_t i);

/// What faces of a file have in common besides their values. Empty texts: none.
struct FaceGroup {
  std::string object;              ///< `o` of OBJ, the name of a node of glTF
  std::string name;                ///< `g` of OBJ
  std::string smoothing;           ///< `s` of OBJ: normals are continuous among faces of one number
  std::uint32_t material = kNone;  ///< index into Materials (engine/mesh/material.h)
  std::uint32_t mesh = kNone;      ///< index into Scene::meshes (engine/scene/scene.h)
  std::uint32_t primitive = kNone;  ///< of the mesh in a glTF file

  friend bool operator==(const FaceGroup&, const FaceGroup&) = default;
};

/// The data of a mesh besides its shape.
///
/// Values are stored once per wedge: the corners of one vertex whose values all agree (H. Hoppe,
/// "Efficient implementation of progressive meshes", 1998). Nearly every vertex has one wedge; a
/// vertex on a seam has one for each side. Wedge v of a mesh with V vertices is the first wedge of
/// vertex v, and the others follow from V on. So a mesh without seams needs no wedge ids at all:
/// its corners' vertices are their wedges.
///
/// Invariants, checked by `validate` (engine/mesh/validate.h) under these numbers:
/// 15. `corner_wedge` is empty or has 3F elements; `further` is empty exactly if it is.
/// 16. Every layer has V + `further.size()` values, and no two layers have the same name.
/// 17. The wedge of a corner is that of the corner's vertex: below V it is the vertex itself, and
///     from V on, `further` names the vertex.
/// 18. `further` ascends, and each further wedge is used by a corner.
/// 19. `group` is empty or has F elements, each below the number of groups.
struct Attributes {
  std::vector<AttributeLayer> layers;
  Array<Wedge> corner_wedge;   ///< 3F, or empty: every vertex has one wedge
  Array<Vertex> further;       ///< vertex of each wedge from V on
  Array<std::uint32_t> group;  ///< one per face (F, or empty): index into `groups`
  std::vector<FaceGroup> groups;

  bool is_empty() const { return layers.empty() && group.empty(); }
  bool has_seams() const { return !corner_wedge.empty(); }
  /// Returns the wedge of a corner. `origins` are those of the mesh.
  Wedge wedge(std::span<const Vertex> origins, Halfedge corner) const {
    return corner_wedge.empty() ? Wedge(origins[corner.index()].index())
                                : corner_wedge[corner.index()];
  }
  /// Returns the vertex of a wedge of a mesh with `vertices` vertices.
  Vertex vertex(Wedge w, std::uint32_t vertices) const {
    return w.index() < vertices ? Vertex(w.index()) : further[w.index() - vertices];
  }
  /// Returns the layer of that name, or null.
  const AttributeLayer* find(std::string_view name) const;
  /// Returns the first layer of that kind, or null.
  const AttributeLayer* find(AttributeKind kind) const;
  /// Returns the number of bytes that the arrays occupy.
  std::size_t memory_bytes() const;
};

}  // namespace mesher
