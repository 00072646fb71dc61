#include "engine/mesh/build/triangulate.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "engine/mesh/build/ear_clipper.h"

namespace mesher {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t kTriangulateGrain = 256;

bool is_finite(std::span<const glm::vec3> points) {
  for (const glm::vec3& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  }
  return true;
}

glm::dvec3 cross_at(std::span<const glm::vec3> p, int a, int b, int c) {
  return glm::cross(glm::dvec3(p[b]) - glm::dvec3(p[a]), glm::dvec3(p[c]) - glm::dvec3(p[a]));
}

double squared_length(const glm::dvec3& v) {
  return glm::dot(v, v);
}

// A diagonal lies inside a quad if its two triangles face the same way as the quad.
void triangulate_quad(std::span<const glm::vec3> p, std::vector<Triangle>& triangles) {
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(p[2]) - glm::dvec3(p[0]), glm::dvec3(p[3]) - glm::dvec3(p[1]));
  const auto is_front = [&](int a, int b, int c) {
    return glm::dot(cross_at(p, a, b, c), normal) > 0.0;
  };
  const bool is_02_inside = is_front(0, 1, 2) && is_front(0, 2, 3);
  const bool is_13_inside = is_front(0, 1, 3) && is_front(1, 2, 3);
  bool takes_02 = is_02_inside;
  if (is_02_inside == is_13_inside) {
    takes_02 = squared_length(glm::dvec3(p[2]) - glm::dvec3(p[0])) <=
               squared_length(glm::dvec3(p[3]) - glm::dvec3(p[1]));
  }
  if (takes_02) {
    triangles.insert(triangles.end(), {Triangle{0, 1, 2}, Triangle{0, 2, 3}});
  } else {
    triangles.insert(triangles.end(), {Triangle{0, 1, 3}, Triangle{1, 2, 3}});
  }
}

/// Returns the index of each face's first triangle, plus the total at the end. Dropped faces have
/// no triangles.
std::vector<std::size_t> triangle_starts(const Soup& soup,
                                         const std::vector<std::uint32_t>& duplicates,
                                         BuildReport& report) {
  const std::uint32_t faces = soup.face_count();
  report[Repair::duplicate_faces_dropped] += duplicates.size();
  auto duplicate = duplicates.begin();
  std::vector<std::size_t> starts(std::size_t{faces} + 1, 0);
  for (std::uint32_t f = 0; f < faces; ++f) {
    const std::uint32_t corners = soup.face_start[f + 1] - soup.face_start[f];
    const bool is_duplicate = duplicate != duplicates.end() && *duplicate == f;
    if (is_duplicate) ++duplicate;
    report[Repair::polygons_triangulated] += corners > 3 && !is_duplicate ? 1 : 0;
    report[Repair::degenerate_faces_dropped] += corners < 3 ? 1 : 0;
    starts[f + 1] = starts[f] + (corners < 3 || is_duplicate ? 0 : corners - 2);
  }
  return starts;
}

template <class T>
void gather(Array<T>& values, const Array<std::uint32_t>& source) {
  if (values.empty()) return;
  Array<T> gathered(source.size());
  parallel_for(source.size(), 1 << 16, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      gathered[i] = values[source[i]];
  });
  values = std::move(gathered);
}

}  // namespace

void triangulate(std::span<const glm::vec3> polygon, std::vector<Triangle>& triangles) {
  const auto n = static_cast<std::uint32_t>(polygon.size());
  if (n == 3) {
    triangles.push_back({0, 1, 2});
  } else if (!is_finite(polygon)) {
    for (std::uint32_t i = 1; i + 1 < n; ++i)
      triangles.push_back({0, i, i + 1});
  } else if (n == 4) {
    triangulate_quad(polygon, triangles);
  } else {
    EarClipper(polygon).run(triangles);
  }
}

std::vector<SheetCopy> triangulate(Soup& soup, BuildReport& report, Progress* progress) {
  if (soup.face_start.empty()) return {};
  const std::uint32_t faces = soup.face_count();
  std::vector<std::uint32_t> duplicates;
  std::uint64_t second_sides = 0;
  std::vector<SheetCopy> copies = separate_polygons(soup, duplicates, second_sides);
  report[Repair::second_sides_kept] += second_sides;
  const std::vector<std::size_t> starts = triangle_starts(soup, duplicates, report);
  Array<std::uint32_t> source(3 * starts[faces]);  // corner of the soup, for each new corner
  Array<std::uint32_t> source_face(starts[faces]);
  parallel_chunks(faces, kTriangulateGrain, progress, [&](std::size_t, IndexRange range) {
    std::vector<Triangle> triangles;
    std::vector<glm::vec3> outline;
    for (std::size_t f = range.begin; f < range.end; ++f) {
      if (starts[f] == starts[f + 1]) continue;
      const std::uint32_t begin = soup.face_start[f];
      triangles.clear();
      outline.clear();
      for (std::uint32_t c = begin; c < soup.face_start[f + 1]; ++c) {
        outline.push_back(soup.positions[soup.corners[c]]);
      }
      triangulate(outline, triangles);
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        source_face[starts[f] + t] = static_cast<std::uint32_t>(f);
        for (std::size_t c = 0; c < 3; ++c) {
          source[3 * (starts[f] + t) + c] = begin + triangles[t][c];
        }
      }
    }
  });
  gather(soup.corners, source);
  for (AttributeStream& stream : soup.streams)
    gather(stream.index, source);
  gather(soup.attributes.group, source_face);
  soup.polygon_of = std::move(source_face);
  soup.face_start = {};
  return copies;
}

}  // namespace mesher
