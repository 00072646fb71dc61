#include "tests/simplify/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/mesh/collapse.h"
#include "engine/mesh/normals.h"

namespace mesher::test {
namespace {

/// Tracks ids of the input through a mesh that fills its holes after each removal.
class IdTracker {
 public:
  explicit IdTracker(std::uint32_t count) : now_(count), was_(count) {
    std::iota(now_.begin(), now_.end(), 0U);
    std::iota(was_.begin(), was_.end(), 0U);
  }
  std::uint32_t now(std::uint32_t input_id) const { return now_[input_id]; }
  /// The element at `place` is removed, and `move` fills the hole.
  void removed(std::uint32_t place, const CollapseResult::Move& move) {
    now_[was_[place]] = kNone;
    if (move.from != kNone) {
      was_[move.to] = was_[move.from];
      now_[was_[move.to]] = move.to;
    }
    was_.pop_back();
  }

 private:
  std::vector<std::uint32_t> now_;
  std::vector<std::uint32_t> was_;
};

using Corner = std::array<float, 3>;

std::vector<std::array<Corner, 3>> sorted_faces(const Mesh& mesh) {
  std::vector<std::array<Corner, 3>> faces;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::array<Corner, 3> face{};
    for (std::uint32_t c = 0; c < 3; ++c) {
      const glm::vec3& p = mesh.position(mesh.origin(Mesh::halfedge(Face(f), c)));
      face[c] = {p.x, p.y, p.z};
    }
    // Rotate the lowest corner to the front and keep the orientation.
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace

std::uint64_t count_folds(const Mesh& mesh) {
  const Array<glm::vec3> normals = face_normals(mesh);
  std::uint64_t folds = 0;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge t = mesh.twin(Halfedge(i));
    if (!t.is_valid() || t.index() < i) continue;
    folds += glm::dot(normals[i / 3], normals[t.index() / 3]) < -0.866026F ? 1 : 0;
  }
  return folds;
}

double folded_share(const Mesh& mesh) {
  const Array<glm::vec3> normals = face_normals(mesh);
  const auto area = [&](std::uint32_t f) {
    const auto corner = [&](std::uint32_t c) {
      return glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(Face(f), c))));
    };
    return 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
  };
  double folded = 0.0;
  double all = 0.0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    all += area(f);
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge t = mesh.twin(Halfedge(i));
    if (!t.is_valid() || t.index() < i) continue;
    if (glm::dot(normals[i / 3], normals[t.index() / 3]) >= -0.866026F) continue;
    folded += std::min(area(i / 3), area(t.index() / 3));
  }
  return all > 0.0 ? folded / all : 0.0;
}

void expect_no_harmful_folds(const Mesh& before, const Mesh& after, simplify::CostPolicy policy) {
  if (policy != simplify::CostPolicy::quadric &&
      policy != simplify::CostPolicy::accumulated_quadric) {
    EXPECT_LE(count_folds(after), count_folds(before));
    return;
  }
  constexpr std::uint32_t kFewFaces = 64;
  if (after.face_count() < kFewFaces) return;
  EXPECT_LE(folded_share(after), folded_share(before) + 0.02);
}

Mesh replay(Mesh mesh, std::span<const simplify::CollapseRecord> records,
            const std::function<void(const Mesh&, std::size_t)>& after_each) {
  IdTracker vertices(mesh.vertex_count());
  IdTracker faces(mesh.face_count());
  std::size_t done = 0;
  for (const simplify::CollapseRecord& record : records) {
    const Halfedge h = Mesh::halfedge(Face(faces.now(Mesh::face(record.halfedge).index())),
                                      Mesh::corner(record.halfedge));
    const Vertex removed(vertices.now(record.removed.index()));
    EXPECT_EQ(mesh.origin(h), removed);
    EXPECT_EQ(mesh.target(h), Vertex(vertices.now(record.kept.index())));
    EXPECT_EQ(mesh.twin(h).is_valid(), record.twin.is_valid());
    EXPECT_TRUE(check_collapse(mesh, h).is_legal());
    if (testing::Test::HasFailure()) return mesh;
    std::array<std::uint32_t, 2> gone{
        Mesh::face(h).index(), record.twin.is_valid() ? Mesh::face(mesh.twin(h)).index() : kNone};
    // Remove the higher of the two first.
    if (gone[1] != kNone && gone[1] > gone[0]) std::swap(gone[0], gone[1]);
    const CollapseResult result = collapse(mesh, h, record.position);
    vertices.removed(removed.index(), result.vertex_move);
    for (std::uint32_t i = 0; i < result.removed_faces; ++i)
      faces.removed(gone[i], result.face_moves[i]);
    after_each(mesh, ++done);
  }
  return mesh;
}

bool is_same_surface(const Mesh& a, const Mesh& b) {
  return a.vertex_count() == b.vertex_count() && sorted_faces(a) == sorted_faces(b);
}

}  // namespace mesher::test
