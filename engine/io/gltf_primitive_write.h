#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/io/gltf_write.h"

namespace mesher::io {

/// An accessor to be written, with its data.
struct GltfArray {
  std::string name;     ///< of the attribute; empty for indices
  nlohmann::json json;  ///< the accessor without its buffer view
  std::string bytes;
  std::size_t stride = 0;  ///< 0: elements follow each other
};

/// The arrays of one primitive.
struct GltfPrimitiveArrays {
  GltfArray indices;
  std::vector<GltfArray> attributes;
  std::vector<std::vector<GltfArray>> targets;
  std::vector<std::string> missing;  ///< attributes that it should have, but some corner does not
};

/// Makes the primitives of a mesh again from a level of it. Every layer is written; one vertex per
/// wedge, in the order of their first use.
class GltfPrimitiveMaker {
 public:
  /// Pre: the mesh has groups, as read_gltf_mesh makes them. O(F).
  explicit GltfPrimitiveMaker(const GltfLevel& level);

  /// Returns whether the mesh has the faces of a primitive of the document.
  bool makes(std::size_t primitive) const { return group_of(primitive) < faces_.size(); }
  /// Returns the arrays of a primitive; no attributes if no face is left. `original` is the
  /// primitive in the document that was read. O(its faces times layers). Pre: makes(primitive).
  GltfPrimitiveArrays make(std::size_t primitive, const nlohmann::json& original);

 private:
  std::size_t group_of(std::size_t primitive) const;
  void find_vertices(std::size_t group);
  GltfArray positions() const;
  GltfArray indices() const;
  GltfArray array_of(const AttributeLayer& layer, const std::string& name) const;
  bool has_all_values(const AttributeLayer& layer) const;
  void add_attributes(const nlohmann::json& original, GltfPrimitiveArrays& arrays) const;
  void add_targets(const nlohmann::json& original, GltfPrimitiveArrays& arrays) const;

  const Mesh& mesh_;
  const Attributes& attributes_;
  std::vector<std::vector<std::uint32_t>> faces_;  ///< of each group
  std::vector<std::uint32_t> number_;              ///< of each wedge in the primitive, or kNone
  std::vector<std::uint32_t> wedges_;              ///< of the primitive
  std::vector<std::uint32_t> corners_;             ///< their numbers, three per face
};

}  // namespace mesher::io
