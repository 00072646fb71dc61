#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/wedges.h"

namespace mesher::test {

/// Returns texture coordinates and normals, by vertex and by the chart of the face.
template <class Chart>
Attributes charted(const Mesh& mesh, Chart chart) {
  AttributeLayer uv(texcoord_type(), mesh.halfedge_count());
  AttributeLayer normal(normal_type(), mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const glm::vec3& p = mesh.position(mesh.origin(Halfedge(h)));
    const auto c = static_cast<float>(chart(h / 3));
    uv.values<glm::vec2>()[h] = {0.125F * p.x + 3.0F * c, 0.25F * p.y + 0.0625F * p.x};
    normal.values<glm::vec3>()[h] = {0, 0, 1};
  }
  Attributes attributes;
  std::vector<AttributeLayer> layers;
  layers.push_back(std::move(uv));
  layers.push_back(std::move(normal));
  set_corner_layers(mesh, attributes, std::move(layers));
  return attributes;
}

}  // namespace mesher::test
