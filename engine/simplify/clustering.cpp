#include "engine/simplify/clustering.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/build/build.h"

namespace mesher::simplify {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;
// Three numbers of a cell fit in 64 bits.
constexpr double kMostCells = double(1U << 20U);
// Cells that a surface crosses per square of the side of a cell, averaged over all directions.
constexpr double kCellsPerSquare = 1.5;
// Size of the face of a part that lies in one cell, as a share of the cell.
constexpr float kKeptSize = 0.5F;

/// Numbers the cells of a grid in the order in which they are first asked for.
class CellNumbers {
 public:
  CellNumbers(const Box& box, double side) : origin_(box.min), side_(side), slots_(1U << 12U) {}

  std::uint32_t number(const glm::vec3& at) {
    if (2 * count_ >= slots_.size()) grow();
    Slot& slot = find(slots_, code(at));
    if (slot.number == kNone) slot.number = count_++;
    return slot.number;
  }
  std::uint32_t count() const { return count_; }

 private:
  struct Slot {
    std::uint64_t code = 0;
    std::uint32_t number = kNone;
  };

  std::uint64_t code(const glm::vec3& at) const {
    const glm::dvec3 cell = (glm::dvec3(at) - origin_) / side_;
    const auto part = [](double c) {
      return static_cast<std::uint64_t>(std::clamp(c, 0.0, kMostCells));
    };
    return part(cell.x) << 42U | part(cell.y) << 21U | part(cell.z);
  }
  static Slot& find(std::vector<Slot>& slots, std::uint64_t code) {
    constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15U;
    std::size_t at = (code * kSpread) >> 32U & (slots.size() - 1);
    while (slots[at].number != kNone && slots[at].code != code)
      at = (at + 1) & (slots.size() - 1);
    slots[at].code = code;
    return slots[at];
  }
  void grow() {
    std::vector<Slot> larger(2 * slots_.size());
    for (const Slot& slot : slots_) {
      if (slot.number != kNone) find(larger, slot.code).number = slot.number;
    }
    slots_ = std::move(larger);
  }

  glm::dvec3 origin_;
  double side_;
  std::vector<Slot> slots_;
  std::uint32_t count_ = 0;
};

double side_for(const Statistics& statistics, std::uint32_t target_faces) {
  const double faces_per_square = 2.0 * kCellsPerSquare;
  const double side = std::sqrt(faces_per_square * statistics.area / std::max(target_faces, 1U));
  // Also for a mesh without an area, or one whose area is that of a fine crumpled surface.
  return std::max({side, statistics.box.diagonal() / kMostCells, 1e-30});
}

struct Clusters {
  Array<std::uint32_t> cell_of;  ///< for each vertex
  Array<glm::vec3> positions;    ///< for each cell
};

Clusters clusters_of(const Mesh& mesh, CellNumbers& cells) {
  Clusters clusters;
  clusters.cell_of.resize(mesh.vertex_count());
  std::vector<glm::dvec3> sums;
  std::vector<std::uint32_t> counts;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const glm::vec3& at = mesh.position(Vertex(v));
    const std::uint32_t cell = cells.number(at);
    clusters.cell_of[v] = cell;
    if (cell == sums.size()) {
      sums.emplace_back(0.0);
      counts.push_back(0);
    }
    sums[cell] += glm::dvec3(at);
    ++counts[cell];
  }
  clusters.positions.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    clusters.positions[i] = glm::vec3(sums[i] / double(counts[i]));
  return clusters;
}

/// Adds a face around the middle of three points, as large as a part of a cell.
void keep_face(Soup& soup, const std::array<glm::vec3, 3>& corners, float size) {
  const glm::vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0F;
  float reach = 0.0F;
  for (const glm::vec3& corner : corners)
    reach = std::max(reach, glm::distance(corner, middle));
  if (reach <= 0.0F) return;
  const float factor = std::max(1.0F, size / reach);
  for (const glm::vec3& corner : corners) {
    soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
    soup.positions.push_back(middle + factor * (corner - middle));
  }
}

}  // namespace

Mesh cluster(const Mesh& mesh, const Statistics& statistics, std::uint32_t target_faces) {
  const double side = side_for(statistics, target_faces);
  CellNumbers cells(statistics.box, side);
  Clusters clusters = clusters_of(mesh, cells);
  Soup soup;
  soup.positions = std::move(clusters.positions);
  std::vector<std::uint32_t> lone_face(cells.count(), kNone);  // a face inside the cell
  std::vector<bool> has_face(cells.count(), false);
  const auto origins = mesh.origins();
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::array<std::uint32_t, 3> at{};
    for (std::size_t c = 0; c < 3; ++c)
      at[c] = clusters.cell_of[origins[3 * f + c].index()];
    if (at[0] != at[1] && at[1] != at[2] && at[2] != at[0]) {
      for (const std::uint32_t cell : at) {
        soup.corners.push_back(cell);
        has_face[cell] = true;
      }
    } else if (at[0] == at[1] && at[1] == at[2] && lone_face[at[0]] == kNone) {
      lone_face[at[0]] = f;
    }
  }
  for (std::uint32_t cell = 0; cell < lone_face.size(); ++cell) {
    if (has_face[cell] || lone_face[cell] == kNone) continue;
    std::array<glm::vec3, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = mesh.position(origins[3 * lone_face[cell] + c]);
    keep_face(soup, corners, kKeptSize * static_cast<float>(side));
  }
  return build_mesh(std::move(soup)).mesh;
}

}  // namespace mesher::simplify
