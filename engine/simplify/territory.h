#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Returns the bounding box of the corners of a live face. O(1).
Box face_box(const Mesh& mesh, Face f);

/// Maps each cell of a grid to the region to which all faces in the cell belong. Cells of several
/// regions and empty cells belong to none. While each region puts new faces only into its own
/// cells, faces of different regions cannot intersect, whatever the order of the regions.
class Territory {
 public:
  /// Assigns the cells for a round. Pre: each live vertex has its region. O(F), parallel.
  void claim(const Surface& surface);

  /// Returns whether all cells that the box touches belong to the region. O(cells).
  bool owns(std::uint32_t region, const Box& box) const;

 private:
  struct Cells {
    glm::ivec3 first;
    glm::ivec3 last;
  };

  Cells cells(const Box& box) const;
  std::size_t index(const glm::ivec3& cell) const;
  void set_cell_size(float size, const Box& all, std::size_t most_cells);
  bool is_fine_enough(const Surface& surface) const;
  void mark(const Surface& surface, Face f);

  glm::vec3 origin_{0.0F};
  float inverse_size_ = 0.0F;
  glm::ivec3 counts_{0};
  Array<std::uint32_t> owner_;
};

}  // namespace mesher::simplify
