#include "engine/simplify/territory.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "engine/core/parallel.h"

namespace mesher::simplify {
namespace {

// No regions: they are counted from 0.
constexpr std::uint32_t kEmpty = kNone;
constexpr std::uint32_t kShared = kNone - 1;

constexpr std::size_t kTerritoryChunk = 8192;
// Larger cells widen the strips that no region may enter; smaller cells leave more cells empty
// beside the surface. On the bunny all values from 2 to 3 take the same time.
constexpr float kFacesAcrossCell = 3.0F;
constexpr std::size_t kMostCellsPerFace = 8;
// If faces touch more cells than this on average, a few large faces fill the grid: it is coarsened.
constexpr std::size_t kMostTouchedPerFace = 32;

float longest_side(const Box& box) {
  const glm::vec3 size = box.max - box.min;
  return std::max({size.x, size.y, size.z});
}

struct FaceExtent {
  Box box{glm::vec3(std::numeric_limits<float>::max()),
          glm::vec3(std::numeric_limits<float>::lowest())};
  double sides = 0.0;
  std::size_t faces = 0;

  FaceExtent& operator+=(const FaceExtent& other) {
    box.min = glm::min(box.min, other.box.min);
    box.max = glm::max(box.max, other.box.max);
    sides += other.sides;
    faces += other.faces;
    return *this;
  }
};

FaceExtent extent(const Surface& surface) {
  const std::size_t n = surface.mesh().face_count();
  return parallel_sum<FaceExtent>(n, kTerritoryChunk, [&](IndexRange range) {
    FaceExtent sum;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Face f(static_cast<std::uint32_t>(i));
      if (surface.is_removed(f)) continue;
      const Box box = face_box(surface.mesh(), f);
      sum += {box, longest_side(box), 1};
    }
    return sum;
  });
}

}  // namespace

Box face_box(const Mesh& mesh, Face f) {
  const glm::vec3& a = mesh.position(mesh.origin(Mesh::halfedge(f, 0)));
  const glm::vec3& b = mesh.position(mesh.origin(Mesh::halfedge(f, 1)));
  const glm::vec3& c = mesh.position(mesh.origin(Mesh::halfedge(f, 2)));
  return {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
}

void Territory::set_cell_size(float size, const Box& all, std::size_t most_cells) {
  origin_ = all.min;
  const glm::vec3 sides = all.max - all.min;
  const float least = std::max(longest_side(all), std::numeric_limits<float>::min());
  size = std::max(size, 0x1p-10F * least);
  const auto cells = [&] {
    const glm::dvec3 counts = glm::floor(glm::dvec3(sides) / double{size}) + 1.0;
    return counts.x * counts.y * counts.z;
  };
  while (cells() > static_cast<double>(most_cells))
    size *= 1.25F;
  inverse_size_ = 1.0F / size;
  counts_ = glm::ivec3(sides * inverse_size_) + 1;
}

Territory::Cells Territory::cells(const Box& box) const {
  const auto cell = [&](const glm::vec3& p) {
    const glm::vec3 at = (p - origin_) * inverse_size_;
    // A new vertex may be outside the box of all faces, at any distance.
    return glm::ivec3(glm::clamp(glm::floor(at), glm::vec3(-1.0F), glm::vec3(counts_)));
  };
  return {cell(box.min), cell(box.max)};
}

std::size_t Territory::index(const glm::ivec3& cell) const {
  const auto row = static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(counts_.y) +
                   static_cast<std::size_t>(cell.y);
  return row * static_cast<std::size_t>(counts_.x) + static_cast<std::size_t>(cell.x);
}

bool Territory::is_fine_enough(const Surface& surface) const {
  const std::size_t n = surface.mesh().face_count();
  struct Touched {
    std::size_t cells = 0;
    std::size_t faces = 0;
    Touched& operator+=(const Touched& other) {
      cells += other.cells;
      faces += other.faces;
      return *this;
    }
  };
  const auto touched = parallel_sum<Touched>(n, kTerritoryChunk, [&](IndexRange range) {
    Touched sum;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Face f(static_cast<std::uint32_t>(i));
      if (surface.is_removed(f)) continue;
      const Cells c = cells(face_box(surface.mesh(), f));
      const glm::uvec3 size(c.last - c.first + 1);
      sum += {std::size_t{size.x} * size.y * size.z, 1};
    }
    return sum;
  });
  return touched.cells <= kMostTouchedPerFace * touched.faces;
}

void Territory::mark(const Surface& surface, Face f) {
  const Mesh& mesh = surface.mesh();
  std::uint32_t region = surface.state(mesh.origin(Mesh::halfedge(f))).region;
  for (std::uint32_t c = 1; c < 3; ++c) {
    if (surface.state(mesh.origin(Mesh::halfedge(f, c))).region != region) region = kShared;
  }
  const Cells c = cells(face_box(mesh, f));
  for (int z = c.first.z; z <= c.last.z; ++z) {
    for (int y = c.first.y; y <= c.last.y; ++y) {
      for (int x = c.first.x; x <= c.last.x; ++x) {
        // Independent of the order, the result is the cell's only region, or kShared.
        const std::atomic_ref<std::uint32_t> owner(owner_[index({x, y, z})]);
        std::uint32_t before = kEmpty;
        if (owner.compare_exchange_strong(before, region, std::memory_order_relaxed)) continue;
        if (before != region) owner.store(kShared, std::memory_order_relaxed);
      }
    }
  }
}

void Territory::claim(const Surface& surface) {
  const FaceExtent all = extent(surface);
  if (all.faces == 0) return;
  auto size = static_cast<float>(all.sides / static_cast<double>(all.faces)) * kFacesAcrossCell;
  set_cell_size(size, all.box, kMostCellsPerFace * all.faces);
  while (!is_fine_enough(surface))
    set_cell_size(2.0F / inverse_size_, all.box, kMostCellsPerFace * all.faces);
  owner_.assign(index(counts_ - 1) + 1, kEmpty);
  parallel_for_each(surface.mesh().face_count(), kTerritoryChunk, [&](std::uint32_t i) {
    if (!surface.is_removed(Face(i))) mark(surface, Face(i));
  });
}

bool Territory::owns(std::uint32_t region, const Box& box) const {
  const Cells c = cells(box);
  const glm::ivec3 end = c.last + 1;
  if (c.first.x < 0 || c.first.y < 0 || c.first.z < 0) return false;
  if (end.x > counts_.x || end.y > counts_.y || end.z > counts_.z) return false;
  for (int z = c.first.z; z < end.z; ++z) {
    for (int y = c.first.y; y < end.y; ++y) {
      const std::size_t row = index({0, y, z});
      for (int x = c.first.x; x < end.x; ++x) {
        if (owner_[row + static_cast<std::size_t>(x)] != region) return false;
      }
    }
  }
  return true;
}

}  // namespace mesher::simplify
