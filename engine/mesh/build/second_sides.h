#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/build/soup.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// A face among those with the same vertices.
struct CoincidentFace {
  std::uint32_t face;
  bool is_reversed;     ///< of two directions around its outline, the second one
  std::uint32_t group;  ///< 0 if the soup has no groups
};

/// A face that is kept although it has the vertices of another: it faces the other way, or belongs
/// to another group. Such faces are modeled on purpose, to show two sides or two materials.
struct SecondSide {
  std::uint32_t face;
  std::uint32_t sheet;  ///< 1 for the first such face at its place, and so on
};

/// What becomes of coincident faces.
struct CoincidentFaces {
  std::vector<std::uint32_t> duplicates;  ///< same direction and group as an earlier face
  std::vector<SecondSide> second_sides;
};

/// Sorts one set of faces with the same vertices, in the order of the file, into `result`: the
/// first is neither a duplicate nor a second side. O(n^2) in the number of kept faces of the set,
/// which differ in direction or group.
void sort_coincident(std::span<const CoincidentFace> faces, CoincidentFaces& result);

/// Returns the triangles among `faces` (EdgeMatching::coincident_faces) by kind, each list in
/// increasing order. `group` is empty or has one entry per face. O(k log k) for k faces.
CoincidentFaces coincident_triangles(const Array<Vertex>& origin,
                                     const std::vector<std::uint32_t>& faces,
                                     const Array<std::uint32_t>& group);

/// The vertices of second sides. Second sides of the same sheet share them, so that a two-sided
/// surface becomes two surfaces; a half-edge mesh could not hold both on the same vertices.
/// Internal to building.
class SheetVertices {
 public:
  /// Returns the copy of a vertex on a sheet; makes it as number `next` if there is none yet.
  std::uint32_t copy(std::uint32_t vertex, std::uint32_t sheet, std::uint32_t next);
  /// Makes `number` the copy of a vertex on a sheet.
  void set(std::uint32_t vertex, std::uint32_t sheet, std::uint32_t number) {
    numbers_[{sheet, vertex}] = number;
  }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers_;
};

/// A vertex that was appended to Soup::positions for second sides.
struct SheetCopy {
  std::uint32_t vertex;  ///< it is a copy of
  std::uint32_t sheet;
};

/// Gives polygons of four or more corners that are second sides vertices of their own. Returns the
/// appended vertices in order, and sets `duplicates` and the number of second sides. Expects
/// Soup::face_start.
std::vector<SheetCopy> separate_polygons(Soup& soup, std::vector<std::uint32_t>& duplicates,
                                         std::uint64_t& second_sides);

}  // namespace mesher
