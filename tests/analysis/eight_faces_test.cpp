#include "engine/analysis/eight_faces.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/analysis/fan_graph.h"
#include "engine/mesh/circulators.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using analysis::EightFaces;

/// The faces of a mesh in eights.
std::vector<EightFaces> eights(const Mesh& mesh) {
  const auto graphs = analysis::find_graphs(mesh);
  std::vector<EightFaces> result((mesh.face_count() + 7) / 8);
  for (EightFaces& eight : result)
    eight.clear();
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    result[f / 8].set(f % 8, mesh, Face(f), graphs);
  return result;
}

/// Checks that pairs without a bit do not intersect. Returns the number of pairs with one.
std::size_t count_open(const Mesh& mesh) {
  const auto faces = eights(mesh);
  std::size_t open = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t g = 0; g < mesh.face_count(); ++g) {
      if (f == g) continue;
      const bool may = (faces[g / 8].may_intersect(faces[f / 8], f % 8) >> g % 8 & 1U) != 0;
      open += may ? 1 : 0;
      if (!may) {
        EXPECT_FALSE(analysis::do_areas_intersect(analysis::exact_triangle(mesh, Face(f)),
                                                  analysis::exact_triangle(mesh, Face(g))))
            << f << ' ' << g;
      }
    }
  }
  return open;
}

TEST(EightBoxes, OverlapWhereTheyTouch) {
  analysis::EightBoxes boxes;
  boxes.clear();
  boxes.set(1, {glm::vec3(0), glm::vec3(1)});
  boxes.set(6, {glm::vec3(2), glm::vec3(3)});
  EXPECT_EQ(boxes.overlapping({glm::vec3(1), glm::vec3(1.5F)}), 2U);
  EXPECT_EQ(boxes.overlapping({glm::vec3(1), glm::vec3(2)}), 66U);
  EXPECT_EQ(boxes.overlapping({glm::vec3(0.5F, 0.5F, 4), glm::vec3(5)}), 0U);
  EXPECT_EQ(boxes.overlapping({glm::vec3(-9), glm::vec3(9)}), 66U);
  EXPECT_EQ(boxes.all().min, glm::vec3(0));
  EXPECT_EQ(boxes.all().max, glm::vec3(3));
  EXPECT_EQ(boxes.get(6).max, glm::vec3(3));
}

TEST(EightFaces, SettleNeighborsOnSmoothSurfaces) {
  const Mesh mesh = built(torus(31, 17)).mesh;
  const auto faces = eights(mesh);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    for (const Halfedge other : halfedges_around(mesh, mesh.origin(Halfedge(h)))) {
      const std::uint32_t f = Mesh::face(Halfedge(h)).index();
      const std::uint32_t g = Mesh::face(other).index();
      if (f == g) continue;
      EXPECT_EQ(faces[g / 8].may_intersect(faces[f / 8], f % 8) >> g % 8 & 1U, 0U) << f << ' ' << g;
    }
  }
  // Each face has twelve neighbors.
  EXPECT_LT(count_open(mesh), 2 * mesh.face_count());
}

TEST(EightFaces, MissNoPairOfRandomSoups) {
  std::size_t open = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed)
    open += count_open(built(random_soup(seed)).mesh);
  EXPECT_GT(open, 100U);
}

TEST(EightFaces, MissNoPairAtTheEndsOfTheFloatRange) {
  for (const float scale : {1e-44F, 1e-25F, 1e-12F, 1e12F, 1e25F, 1e38F}) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      Soup soup = random_soup(seed);
      float most = 1.0F;
      for (const glm::vec3& p : soup.positions)
        most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      for (glm::vec3& p : soup.positions)
        p = scale * (p / most);
      count_open(built(std::move(soup)).mesh);
    }
  }
}

TEST(EightFaces, MissNoPairOfTinyAndHugeFaces) {
  std::mt19937 random(3);
  const auto vector = [&] {
    const auto number = [&] { return static_cast<double>(random() % 2001U) / 1000.0 - 1.0; };
    return glm::dvec3(number(), number(), number());
  };
  std::size_t open = 0;
  for (int i = 0; i < 5000; ++i) {
    const double tiny = i % 2 == 0 ? 3e-23 : 1e-22;
    const std::array<glm::dvec3, 3> t{tiny * vector(), tiny * vector(), tiny * vector()};
    // The large face pierces the tiny one with its first corner.
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]) / (tiny * tiny);
    const glm::dvec3 corner = (t[0] + t[1] + t[2]) / 3.0 - 0.1 * tiny * normal;
    Soup soup;
    for (const glm::dvec3& p : {t[0], t[1], t[2], corner, 1e20 * (normal + 0.3 * vector()),
                                1e20 * (normal + 0.3 * vector())}) {
      soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
      soup.positions.emplace_back(p);
    }
    open += count_open(built(std::move(soup)).mesh);
  }
  EXPECT_GT(open, 1000U);
}

TEST(EightFaces, MissNoPairOfSheetsFarFromTheOrigin) {
  // Far from the origin, sheets one unit in the last place apart.
  Soup soup = join(grid(4), grid(4));
  for (std::size_t i = 0; i < soup.positions.size(); ++i)
    soup.positions[i] +=
        glm::vec3(1e6F, 1e6F, i < soup.positions.size() / 2 ? 1e6F : 1e6F + 0.0625F);
  count_open(built(std::move(soup)).mesh);
}

}  // namespace
}  // namespace mesher::test
