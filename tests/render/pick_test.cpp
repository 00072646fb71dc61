#include "engine/render/pick.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

Mesh cube() {
  return build_mesh(test::cube()).mesh;
}

TEST(Pick, HitsTheNearSide) {
  const std::optional<Hit> hit = pick(cube(), {{0.1, 0.2, 5.0}, {0.0, 0.0, -1.0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 4.5, 1e-12);
  EXPECT_NEAR(glm::length(hit->point - glm::dvec3(0.1, 0.2, 0.5)), 0.0, 1e-12);
}

TEST(Pick, HitsBackFacesFromInside) {
  const std::optional<Hit> hit = pick(cube(), {{0.1, 0.2, 0.0}, {1.0, 0.0, 0.0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.x, 0.5, 1e-12);
}

TEST(Pick, MissesBesideAndBehindTheRay) {
  EXPECT_FALSE(pick(cube(), {{0.6, 0.2, 5.0}, {0.0, 0.0, -1.0}}));
  EXPECT_FALSE(pick(cube(), {{0.1, 0.2, 5.0}, {0.0, 0.0, 1.0}}));
  EXPECT_FALSE(pick(Mesh(), {{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}}));
}

TEST(Pick, SameForAnyThreadCount) {
  const Mesh mesh = build_mesh(test::torus(300, 200)).mesh;
  const Ray ray{{0.0, 0.3, 0.2}, glm::normalize(glm::dvec3(1.0, 0.1, 0.05))};
  const std::optional<Hit> many = pick(mesh, ray);
  ASSERT_TRUE(many);
  const ThreadLimit one(1);
  const std::optional<Hit> single = pick(mesh, ray);
  ASSERT_TRUE(single);
  EXPECT_EQ(many->face, single->face);
  EXPECT_EQ(many->distance, single->distance);
}

class PickEdge : public testing::Test {
 protected:
  PickEdge() { look(mesh_); }
  void look(const Mesh& mesh) {
    camera_.set_angles(0.4, 0.3);
    camera_.frame(bounding_box(mesh), kWindow.x / kWindow.y);
  }
  glm::dvec2 on_screen(const glm::dvec3& p) const { return camera_.places(kWindow).of(p); }
  /// Window position of the point at `share` of the edge from `a` to `b`.
  glm::dvec2 along(Vertex a, Vertex b, double share = 0.5) const {
    return on_screen(glm::mix(glm::dvec3(mesh_.position(a)), glm::dvec3(mesh_.position(b)), share));
  }

  static constexpr glm::dvec2 kWindow{640.0, 480.0};
  Mesh mesh_ = cube();
  Camera camera_;
};

TEST_F(PickEdge, WindowPositionsMatchThePickRay) {
  for (const bool orthographic : {false, true}) {
    camera_.set_orthographic(orthographic);
    const glm::dvec3 point(0.1, -0.3, 0.25);
    const Ray ray = camera_.pick_ray({on_screen(point), kWindow});
    const glm::dvec3 to_point = point - ray.origin;
    EXPECT_NEAR(glm::length(glm::cross(to_point, ray.direction)), 0.0, 1e-9);
    EXPECT_GT(camera_.places(kWindow).depth(point), 0.0);
  }
}

TEST_F(PickEdge, FindsTheNearestEdgeInTheWindow) {
  for (const bool orthographic : {false, true}) {
    camera_.set_orthographic(orthographic);
    const Edge front_top = mesh_.find_edge(Vertex(6), Vertex(7));
    for (const double share : {0.1, 0.5, 0.9}) {
      const auto hit = pick_edge(mesh_, camera_,
                                 {along(Vertex(7), Vertex(6), share) + glm::dvec2(0, 3), kWindow});
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->edge, front_top) << share;
      EXPECT_NEAR(hit->distance_px, 3.0, 0.2);
    }
    const auto diagonal = pick_edge(mesh_, camera_, {along(Vertex(4), Vertex(6)), kWindow});
    ASSERT_TRUE(diagonal);
    EXPECT_EQ(diagonal->edge, mesh_.find_edge(Vertex(4), Vertex(6)));
  }
}

TEST_F(PickEdge, FindsNoEdgeInTheMiddleOfAFace) {
  const glm::dvec2 middle = on_screen({0.25, -0.2, 0.5});
  EXPECT_FALSE(pick_edge(mesh_, camera_, {middle, kWindow}));
  EXPECT_TRUE(pick_edge(mesh_, camera_, {middle, kWindow}, 200.0));
  EXPECT_FALSE(pick_edge(mesh_, camera_, {{2.0, 2.0}, kWindow}));
  EXPECT_FALSE(pick_edge(Mesh(), camera_, {middle, kWindow}));
}

TEST_F(PickEdge, FindsTheOutlineFromSlightlyOutside) {
  const Edge top_back = mesh_.find_edge(Vertex(2), Vertex(3));
  const glm::dvec2 beside = along(Vertex(2), Vertex(3)) - glm::dvec2(0, 5);
  ASSERT_FALSE(pick(mesh_, camera_.pick_ray({beside, kWindow})));
  const auto hit = pick_edge(mesh_, camera_, {beside, kWindow});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->edge, top_back);
  EXPECT_FALSE(pick_edge(mesh_, camera_, {beside - glm::dvec2(0, 5), kWindow}));
}

TEST_F(PickEdge, FindsABoundaryEdge) {
  mesh_ = build_mesh(test::grid(3)).mesh;
  look(mesh_);
  const auto hit = pick_edge(mesh_, camera_, {along(Vertex(1), Vertex(2)), kWindow});
  ASSERT_TRUE(hit);
  EXPECT_TRUE(mesh_.is_boundary(hit->edge));
  EXPECT_EQ(hit->edge, mesh_.find_edge(Vertex(1), Vertex(2)));
}

TEST_F(PickEdge, FindsAnEdgeThatExtendsBehindTheEye) {
  mesh_ = build_mesh(test::soup_of({{-10, -1, 10}, {10, -1, 10}, {0, -1, -100}}, {0, 1, 2})).mesh;
  camera_ =
      {};  // at (0, 0, 3), looking along -z, so most of the triangle's sides is behind the eye
  const glm::dvec3 p = glm::mix(glm::dvec3(10, -1, 10), glm::dvec3(0, -1, -100), 0.5);
  const auto hit = pick_edge(mesh_, camera_, {on_screen(p), kWindow});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->edge, mesh_.find_edge(Vertex(1), Vertex(2)));
  EXPECT_NEAR(hit->distance_px, 0.0, 1e-3);
}

TEST_F(PickEdge, SameForAnyThreadCount) {
  mesh_ = build_mesh(test::torus(300, 200)).mesh;
  look(mesh_);
  // On the edge and next to it.
  for (const glm::dvec2 at : {glm::dvec2(250, 230), glm::dvec2(320, 20)}) {
    const auto many = pick_edge(mesh_, camera_, {at, kWindow}, 1e9);
    const ThreadLimit one(1);
    const auto single = pick_edge(mesh_, camera_, {at, kWindow}, 1e9);
    ASSERT_TRUE(many && single);
    EXPECT_EQ(many->edge, single->edge);
    EXPECT_EQ(many->distance_px, single->distance_px);
  }
}

}  // namespace
}  // namespace mesher::render
