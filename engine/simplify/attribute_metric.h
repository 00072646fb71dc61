#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::simplify {

/// How much a difference of an attribute counts against a distance. The weights have no unit: the
/// same weights suit a model in millimeters and one in miles.
///
///  - Texture coordinates: 1 counts a texture that slides over the surface like a surface that
///    moves as far. (A slide is a difference times the mean size of the model per unit of texture.)
///  - Normals and colors: 1 counts a difference of one radian, or between black and full intensity,
///    like a distance of a hundredth of the diagonal.
///  - Joints: 1 counts a point that follows another part of the model like one that moves there
///    (joint_places).
struct AttributeWeights {
  float texcoord = 0.3F;
  float normal = 0.2F;
  float color = 0.5F;
  float joint = 0.03F;

  friend bool operator==(const AttributeWeights&, const AttributeWeights&) = default;
};

/// The attributes of a mesh as vectors that are measured in its own unit of length, so that their
/// squared differences add to squared distances. Texture coordinates, normals and colors count. So
/// do joints, by three numbers that belong to no layer.
struct AttributeMetric {
  /// Most numbers per vector. Further attributes are left out.
  static constexpr std::size_t kMost = 16;

  /// A layer whose values count.
  struct Layer {
    std::size_t index;  ///< in Attributes::layers
    double factor;      ///< from its values to lengths
    std::size_t first;  ///< of its numbers in a vector
    bool is_texcoord;
  };

  std::size_t size = 0;            ///< numbers per vector, 0 to kMost
  std::vector<Layer> layers;       ///< in the order of their numbers
  Array<float> values;             ///< `size` per wedge
  Array<std::uint32_t> of_corner;  ///< per half-edge: its wedge

  std::span<const float> at(std::size_t halfedge) const {
    return std::span(values).subspan(size * of_corner[halfedge], size);
  }
};

/// The attributes of a simplified mesh, per corner.
struct CornerVectors {
  /// Vectors in the order and unit of the metric, one per half-edge.
  Array<float> values;
  /// The source wedge of each corner: its index in the input if the values are unchanged, otherwise
  /// kNone.
  Array<std::uint32_t> source;
  bool crosses_seams = false;  ///< a collapse did (SimplifyOptions::crosses_seams)

  bool is_empty() const { return source.empty(); }
};

/// Returns the metric of a mesh's attributes; one of size 0 if none counts. O(F + values).
AttributeMetric attribute_metric(const Mesh& mesh, const Attributes& attributes,
                                 const AttributeWeights& weights);

/// Returns the metric of a mesh that has some of the faces, multiplied by `scale`. `face_source`:
/// per face of that mesh, the one it was; corners keep their order. O(F + values).
AttributeMetric of_faces(const AttributeMetric& metric, std::span<const Face> face_source,
                         float scale = 1.0F);

}  // namespace mesher::simplify
