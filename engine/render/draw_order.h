#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/material.h"
#include "engine/mesh/mesh.h"

namespace mesher::render {

/// Faces that are drawn together.
struct Batch {
  std::uint32_t material = 0;  ///< number of materials: the faces have none
  std::uint32_t first = 0;     ///< in the order of drawing
  std::uint32_t count = 0;
  bool blends = false;
  glm::vec3 center{0.0F};  ///< of its corners, if it blends: for drawing from back to front
};

/// The order in which faces are drawn: by material, first those that hide what is behind them.
/// Faces that blend are divided by their groups as well, which are drawn from back to front.
struct DrawOrder {
  Array<std::uint32_t> faces;  ///< empty: all faces in their order
  std::vector<Batch> batches;
};

/// Returns the order for a mesh. `materials` may be null. O(F).
DrawOrder draw_order(const Mesh& mesh, const Attributes& attributes, const Materials* materials);

/// Returns the order of the first `faces` faces that the attributes have, of which some may be
/// missing in the drawn mesh: see batches_of_level. O(faces).
DrawOrder order_of_faces(std::uint32_t faces, const Attributes& attributes,
                         const Materials* materials);
/// Returns the batches of a level of a progressive mesh, whose faces are the first ones of an
/// order, with their centers. Batches without faces are left out. O(batches * log F + faces that
/// blend).
std::vector<Batch> batches_of_level(const DrawOrder& order, const Mesh& level);

}  // namespace mesher::render
