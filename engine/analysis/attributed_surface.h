#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "engine/analysis/surface_point.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// How the faces of a group are textured.
struct FaceTexture {
  std::uint32_t set = 0;        ///< of the texture coordinates: TEXCOORD_<set>
  glm::dvec2 texels{kNominal};  ///< per unit of the texture coordinates
  std::uint64_t image = 0;      ///< equal numbers: the same image

  /// The size of a texture that is unknown.
  static constexpr double kNominal = 1024.0;
};

/// A mesh with what its surface looks like. Refers to the others, which must outlive it.
struct AttributedSurface {
  const Mesh& mesh;
  const Attributes& attributes;
  std::span<const FaceTexture>
      textures{};  ///< per group of `attributes`; empty: the default for all

  /// Returns how a face is textured. O(1).
  FaceTexture texture(Face f) const;
};

/// Reads an attribute anywhere on a surface. Refers to it.
class SurfaceLayer {
 public:
  SurfaceLayer(const AttributedSurface& surface, const AttributeLayer& layer)
      : surface_(surface), layer_(layer) {}

  const AttributeType& type() const { return layer_.type(); }
  /// Returns the value of a corner; components may be NaN.
  AttributeValue at(Halfedge corner) const;
  /// Returns the mean of the corners of the face by the point's weights; components may be NaN.
  AttributeValue at(const SurfacePoint& point) const;

 private:
  const AttributedSurface& surface_;
  const AttributeLayer& layer_;
};

/// The texture coordinates of the base colors of a surface, in the convention of glTF: v is 0 at
/// the top. Refers to the surface.
class UvLayers {
 public:
  explicit UvLayers(const AttributedSurface& surface);

  /// Returns whether any face may have texture coordinates.
  bool is_empty() const;
  /// Returns the texture coordinates of a face's corners; none if one of them is missing or not
  /// finite.
  std::optional<std::array<glm::dvec2, 3>> corners(Face f) const;
  /// The same at a point.
  std::optional<glm::dvec2> at(const SurfacePoint& point) const;

 private:
  static constexpr std::size_t kSets = 4;
  const AttributedSurface& surface_;
  std::array<const AttributeLayer*, kSets> layers_{};
};

}  // namespace mesher::analysis
