// Makes a mesh of polygons, walks over its half-edges, and marks a crease.
#include <mesher/mesher.h>

#include <array>
#include <cstdint>
#include <iostream>
#include <vector>

int main() {
  // A cube of six quads, which are cut into triangles. The last one has the wrong direction.
  const std::vector<std::array<float, 3>> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::uint32_t> corners{0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4,
                                           1, 2, 6, 5, 2, 3, 7, 6, 3, 7, 4, 0};
  const std::vector<std::uint32_t> sizes(6, 4);
  mesher::Asset cube = mesher::Asset::build(positions, corners, sizes);
  for (const mesher::RepairCount& repair : cube.repairs())
    std::cout << repair.text << '\n';

  // The faces around the first edge: its half-edge and the opposite one.
  const std::uint32_t twin = cube.twins()[0];
  std::cout << cube.face_count() << " faces; the first edge is between the faces 0 and " << twin / 3
            << '\n';

  const bool is_edge = cube.set_crease(0, 1, 2.5F);
  const bool is_closed = cube.statistics().boundary_edges == 0;
  return is_edge && is_closed && cube.face_count() == 12 ? 0 : 1;
}
