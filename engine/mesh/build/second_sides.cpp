#include "engine/mesh/build/second_sides.h"

#include <algorithm>
#include <array>

#include "engine/mesh/build/duplicate_polygons.h"

namespace mesher {
namespace {

struct Triangle {
  std::array<std::uint32_t, 3> vertices;  ///< in increasing order
  CoincidentFace face;
  bool operator<(const Triangle& other) const {
    return vertices != other.vertices ? vertices < other.vertices : face.face < other.face.face;
  }
};

Triangle sorted_triangle(const Array<Vertex>& origin, std::uint32_t face, std::uint32_t group) {
  std::array<std::uint32_t, 3> v;
  for (std::size_t c = 0; c < 3; ++c)
    v[c] = origin[3 * std::size_t{face} + c].index();
  bool is_reversed = false;
  const auto order = [&](std::size_t a, std::size_t b) {
    if (v[a] <= v[b]) return;
    std::swap(v[a], v[b]);
    is_reversed = !is_reversed;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {v, {face, is_reversed, group}};
}

}  // namespace

void sort_coincident(std::span<const CoincidentFace> faces, CoincidentFaces& result) {
  std::vector<CoincidentFace> kept;
  for (const CoincidentFace& face : faces) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const CoincidentFace& other) {
      return other.is_reversed == face.is_reversed && other.group == face.group;
    });
    // More sides at one place than any model has are taken for duplicates.
    constexpr std::size_t kMostSheets = 16;
    if (is_known || kept.size() >= kMostSheets) {
      result.duplicates.push_back(face.face);
      continue;
    }
    if (!kept.empty()) {
      result.second_sides.push_back({face.face, static_cast<std::uint32_t>(kept.size())});
    }
    kept.push_back(face);
  }
}

CoincidentFaces coincident_triangles(const Array<Vertex>& origin,
                                     const std::vector<std::uint32_t>& faces,
                                     const Array<std::uint32_t>& group) {
  std::vector<Triangle> triangles;
  triangles.reserve(faces.size());
  for (const std::uint32_t face : faces)
    triangles.push_back(sorted_triangle(origin, face, group.empty() ? 0 : group[face]));
  std::sort(triangles.begin(), triangles.end());
  CoincidentFaces result;
  std::vector<CoincidentFace> same;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    same.push_back(triangles[i].face);
    if (i + 1 < triangles.size() && triangles[i + 1].vertices == triangles[i].vertices) continue;
    sort_coincident(same, result);
    same.clear();
  }
  std::sort(result.duplicates.begin(), result.duplicates.end());
  std::sort(result.second_sides.begin(), result.second_sides.end(),
            [](const SecondSide& a, const SecondSide& b) { return a.face < b.face; });
  return result;
}

std::uint32_t SheetVertices::copy(std::uint32_t vertex, std::uint32_t sheet, std::uint32_t next) {
  return numbers_.try_emplace({sheet, vertex}, next).first->second;
}

std::vector<SheetCopy> separate_polygons(Soup& soup, std::vector<std::uint32_t>& duplicates,
                                         std::uint64_t& second_sides) {
  CoincidentFaces found = coincident_polygons(soup);
  duplicates = std::move(found.duplicates);
  second_sides = found.second_sides.size();
  std::vector<SheetCopy> copies;
  SheetVertices vertices;
  for (const SecondSide& side : found.second_sides) {
    for (std::uint32_t c = soup.face_start[side.face]; c < soup.face_start[side.face + 1]; ++c) {
      const std::uint32_t vertex = soup.corners[c];
      const auto next = static_cast<std::uint32_t>(soup.positions.size());
      soup.corners[c] = vertices.copy(vertex, side.sheet, next);
      if (soup.corners[c] != next) continue;
      soup.positions.push_back(glm::vec3(soup.positions[vertex]));
      copies.push_back({vertex, side.sheet});
    }
  }
  return copies;
}

}  // namespace mesher
