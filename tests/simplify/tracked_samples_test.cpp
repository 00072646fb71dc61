#include "engine/simplify/tracked_samples.h"

#include <gtest/gtest.h>

#include "engine/mesh/build/build.h"
#include "engine/mesh/collapse.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr std::size_t kSamples = 400;

simplify::Surface surface_of(Soup soup) {
  return simplify::Surface(build_mesh(std::move(soup)).mesh, {});
}

struct Asked {
  simplify::Fan fan;
  simplify::Candidate candidate;
  float correction = 0.0F;
};

/// Evaluates the collapse of `h` to the position `p`, for which the quadric costs `cost`.
Asked ask(simplify::TrackedSamples& tracked, const simplify::Surface& surface, Halfedge h,
          const glm::vec3& p, float cost) {
  Asked asked;
  asked.candidate = {cost, cost, p};
  EXPECT_TRUE(asked.fan.gather(surface, h, 64));
  asked.fan.check_shape(surface, p);
  asked.correction = tracked.correction(surface, h, asked.fan, p, cost);
  return asked;
}

/// An edge with both ends inside the grid.
Halfedge inner_edge(const Mesh& mesh) {
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (!mesh.is_boundary(mesh.origin(h)) && !mesh.is_boundary(mesh.target(h))) return h;
  }
  return {};
}

glm::vec3 midpoint(const Mesh& mesh, Halfedge h) {
  return 0.5F * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h)));
}

TEST(TrackedSamples, FlatCollapseCostsNothing) {
  const simplify::Surface surface = surface_of(grid(6));
  const simplify::ErrorSamples samples(surface, kSamples);
  simplify::TrackedSamples tracked(surface, samples);
  const Halfedge h = inner_edge(surface.mesh());
  const Asked asked = ask(tracked, surface, h, midpoint(surface.mesh(), h), 1.0F);
  // The correction removes most of the quadric cost, in proportion to the number of points, but
  // never all of it.
  EXPECT_LT(asked.correction, -0.5F);
  EXPECT_GE(asked.candidate.cost + asked.correction, 0.0F);
}

TEST(TrackedSamples, AddTheDistanceThatPlanesMiss) {
  const simplify::Surface surface = surface_of(grid(6));
  const simplify::ErrorSamples samples(surface, kSamples);
  simplify::TrackedSamples tracked(surface, samples);
  const Halfedge h = inner_edge(surface.mesh());
  const glm::vec3 above = midpoint(surface.mesh(), h) + glm::vec3(0.0F, 0.0F, 0.5F);
  const float low = ask(tracked, surface, h, above, 0.0F).correction;
  EXPECT_GT(low, 0.1F);
  const glm::vec3 high = above + glm::vec3(0.0F, 0.0F, 0.5F);
  EXPECT_GT(ask(tracked, surface, h, high, 0.0F).correction, 2.0F * low);
}

TEST(TrackedSamples, RememberDistanceAlreadyLost) {
  simplify::Surface surface = surface_of(grid(6));
  const simplify::ErrorSamples samples(surface, kSamples);
  simplify::TrackedSamples tracked(surface, samples);
  const Halfedge h = inner_edge(surface.mesh());
  const glm::vec3 flat = midpoint(surface.mesh(), h);
  const glm::vec3 above = flat + glm::vec3(0.0F, 0.0F, 0.5F);
  const Asked lifted = ask(tracked, surface, h, above, 0.0F);
  // Simulate the collapse: its faces hold the points at their new distances. Moving back to the
  // plane then costs nothing, because the points get nearer.
  tracked.collapsed(lifted.fan);
  EXPECT_EQ(ask(tracked, surface, h, flat, 0.0F).correction, 0.0F);
  EXPECT_LT(ask(tracked, surface, h, above, 0.0F).correction, 0.1F * lifted.correction);
}

TEST(TrackedSamples, HaveNoEffectWithoutPoints) {
  const simplify::Surface surface = surface_of(grid(6));
  const simplify::ErrorSamples none(surface, 0);
  simplify::TrackedSamples tracked(surface, none);
  const Halfedge h = inner_edge(surface.mesh());
  EXPECT_EQ(ask(tracked, surface, h, midpoint(surface.mesh(), h), 1.0F).correction, 0.0F);
}

}  // namespace
}  // namespace mesher::test
