#pragma once

#include <functional>

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/surface_matches.h"
#include "tests/support/meshes.h"

namespace mesher::test {

/// A mesh with attributes that are functions of the position.
struct Painted {
  Mesh mesh;
  Attributes attributes;
  std::vector<analysis::FaceTexture> textures;

  analysis::AttributedSurface surface() const { return {mesh, attributes, textures}; }
};

/// What the corners of a mesh have; functions that are not set give no layer.
struct Paint {
  std::function<glm::vec2(const glm::vec3&, std::size_t face)> uv;
  std::function<glm::vec3(const glm::vec3&)> normal;
  std::function<glm::u8vec4(const glm::vec3&)> color;
};

inline Painted painted(Soup soup, const Paint& paint) {
  BuildResult result = built(std::move(soup));
  CornerAttributes corners;
  for (std::size_t h = 0; h < result.mesh.halfedge_count(); ++h) {
    const glm::vec3& p = result.mesh.position(result.mesh.origins()[h]);
    if (paint.uv) corners.texcoord.push_back(paint.uv(p, h / 3));
    if (paint.normal) corners.normal.push_back(paint.normal(p));
    if (paint.color) corners.color.push_back(paint.color(p));
  }
  Attributes attributes = to_wedges(result.mesh, std::move(corners));
  return {std::move(result.mesh), std::move(attributes), {}};
}

/// A sheet of n x n squares with one texture coordinate per unit.
inline Painted sheet_with(std::uint32_t n, const glm::vec2& offset, float scale = 1.0F) {
  return painted(grid(n), {.uv = [=](const glm::vec3& p, std::size_t) {
                   return scale * glm::vec2(p) + offset;
                 }});
}

inline analysis::SurfaceMatches matches_of(const Painted& from, const Painted& to,
                                           std::uint64_t samples = 2000) {
  return analysis::match_surfaces(from.mesh, to.mesh, analysis::TriangleTree(to.mesh), samples);
}

inline constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

}  // namespace mesher::test
