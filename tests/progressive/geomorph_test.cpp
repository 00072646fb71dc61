#include "engine/progressive/geomorph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "engine/mesh/normals.h"
#include "engine/mesh/packed_normal.h"
#include "engine/progressive/build.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

Mesh bumpy() {
  Soup soup = torus(48, 30);
  std::mt19937 random(5);
  for (glm::vec3& p : soup.positions)
    p *= 1.0F + 0.0001F * static_cast<float>(random() % 1000);
  return built(std::move(soup)).mesh;
}

progressive::ProgressiveMesh progressive(const Mesh& mesh, std::uint32_t base_faces = 60) {
  return std::move(progressive::make_progressive(mesh, {.target_faces = base_faces}).mesh);
}

/// The vertex of level `level` from which `v` was split.
Vertex ancestor(const progressive::ProgressiveMesh& mesh, Vertex v, std::uint32_t level) {
  while (v.index() >= mesh.base_vertex_count() + level)
    v = mesh.splits()[v.index() - mesh.base_vertex_count()].parent;
  return v;
}

/// Drawn position and normal of each vertex of a progressive mesh at one time.
struct Drawn {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::uint32_t level;
};

Drawn drawn(progressive::ProgressiveMesh& mesh, progressive::Geomorph& morph, double time,
            double range) {
  Drawn result;
  result.level = static_cast<std::uint32_t>(
      std::min(std::ceil(time), static_cast<double>(mesh.split_count())));
  mesh.go_to(result.level);
  morph.follow(mesh);
  const GeomorphTime at = GeomorphTime::continuous(time, range);
  for (std::uint32_t v = 0; v < mesh.mesh().vertex_count(); ++v) {
    const std::uint32_t head = morph.heads()[v];
    result.positions.push_back(
        morphed_position(mesh.mesh().position(Vertex(v)), head, morph.splits(), at));
    result.normals.push_back(morphed_normal(morph.normals()[v], head, morph.splits(), at));
  }
  return result;
}

/// Upper bound of the total distance that the splits growing from time `first` on move a vertex.
float way_to_go(const progressive::Geomorph& morph, std::uint32_t head, double first) {
  float sum = 0.0F;
  while (head != kNoHead && static_cast<double>(head / 2) >= first) {
    const SplitMorph& split = morph.splits()[head / 2];
    sum += glm::length(head % 2 == 1 ? split.child_delta : split.parent_delta);
    head = split.previous;
  }
  return sum;
}

TEST(Geomorph, VertexSpeedIsBoundedByTheSlider) {
  const Mesh input = bumpy();
  progressive::ProgressiveMesh mesh = progressive(input);
  progressive::Geomorph morph(mesh);
  const double splits = mesh.split_count();
  const double rounding = 4e-6 * statistics(input).box.diagonal();
  for (const double share : {0.005, 0.06, 0.5}) {
    const double range = share * splits;
    for (const double step : {1e-3 * (splits + range), 0.3}) {
      Drawn before = drawn(mesh, morph, 0.0, range);
      for (double time = step; time < splits + range; time += step) {
        Drawn now = drawn(mesh, morph, time, range);
        for (std::uint32_t v = 0; v < now.positions.size(); ++v) {
          // A new vertex starts at the vertex from which it was split.
          const Vertex was = ancestor(mesh, Vertex(v), before.level);
          const double moved = glm::length(now.positions[v] - before.positions[was.index()]);
          const double way = way_to_go(morph, morph.heads()[v], time - step - range);
          ASSERT_LE(moved, step / range * way + rounding) << "time " << time << " vertex " << v;
        }
        before = std::move(now);
      }
    }
  }
}

TEST(Geomorph, NormalChangeIsBoundedByTheSlider) {
  progressive::ProgressiveMesh mesh = progressive(bumpy());
  progressive::Geomorph morph(mesh);
  const double range = 0.1 * mesh.split_count();
  const double end = mesh.split_count() + range;
  // Halving the step halves the largest change, so no normal jumps.
  std::vector<double> largest;
  for (const double step : {4.0, 2.0, 1.0, 0.5}) {
    largest.push_back(0.0);
    for (double time = 3.3; time + step < end; time += 61.0) {
      const Drawn before = drawn(mesh, morph, time, range);
      const Drawn now = drawn(mesh, morph, time + step, range);
      for (std::uint32_t v = 0; v < now.normals.size(); ++v) {
        const Vertex was = ancestor(mesh, Vertex(v), before.level);
        largest.back() = std::max(
            largest.back(), double{glm::length(now.normals[v] - before.normals[was.index()])});
      }
    }
  }
  EXPECT_GT(largest[0], 0.0);
  for (std::size_t i = 1; i < largest.size(); ++i)
    EXPECT_LE(largest[i], 0.75 * largest[i - 1] + 1e-4);
}

TEST(Geomorph, InterpolatesBetweenTwoLevels) {
  progressive::ProgressiveMesh mesh = progressive(bumpy());
  progressive::Geomorph morph(mesh);
  const auto coarse_level = mesh.split_count() / 5;
  mesh.go_to(coarse_level);
  const Mesh coarse = mesh.mesh();
  const std::vector<std::uint32_t> coarse_normals = [&] {
    morph.follow(mesh);
    return std::vector<std::uint32_t>(morph.normals().begin(), morph.normals().end());
  }();
  mesh.go_to(mesh.split_count() - 3);
  morph.follow(mesh);
  for (std::uint32_t v = 0; v < mesh.mesh().vertex_count(); ++v) {
    const glm::vec3& fine = mesh.mesh().position(Vertex(v));
    const std::uint32_t head = morph.heads()[v];
    const auto at = [&](float alpha) {
      return morphed_position(fine, head, morph.splits(),
                              GeomorphTime::between(coarse_level, alpha));
    };
    const Vertex from = ancestor(mesh, Vertex(v), coarse_level);
    EXPECT_LT(glm::length(at(0.0F) - coarse.position(from)), 2e-5F);
    EXPECT_EQ(at(1.0F), fine);
    EXPECT_LT(glm::length(at(0.5F) - 0.5F * (at(0.0F) + at(1.0F))), 2e-5F);
    const glm::vec3 n = morphed_normal(morph.normals()[v], head, morph.splits(),
                                       GeomorphTime::between(coarse_level, 0.0F));
    EXPECT_LT(glm::length(n - decode_normal(coarse_normals[from.index()])), 1e-3F);
  }
}

TEST(Geomorph, FullDetailHasTheNormalsOfTheInput) {
  const Mesh input = bumpy();
  progressive::Progressive made = progressive::make_progressive(input, {.target_faces = 60});
  progressive::Geomorph morph(made.mesh);
  EXPECT_EQ(made.mesh.level(), 0U) << "leaves the level unchanged";
  made.mesh.go_to(made.mesh.split_count());
  morph.follow(made.mesh);
  const Array<glm::vec3> normals = vertex_normals(input);
  for (std::uint32_t v = 0; v < input.vertex_count(); ++v) {
    const glm::vec3& expected = normals[made.vertex_source[v].index()];
    EXPECT_LT(glm::length(decode_normal(morph.normals()[v]) - expected), 2e-4F);
  }
}

void expect_equal(const progressive::Geomorph& a, const progressive::Geomorph& b) {
  EXPECT_TRUE(is_equal(a.heads(), b.heads()));
  EXPECT_TRUE(is_equal(a.normals(), b.normals()));
  EXPECT_TRUE(is_equal(a.splits(), b.splits()));
}

TEST(Geomorph, DependsOnlyOnTheLevel) {
  progressive::ProgressiveMesh mesh = progressive(bumpy());
  progressive::Geomorph morph(mesh);
  std::mt19937 random(8);
  for (int i = 0; i < 25; ++i) {
    mesh.go_to(static_cast<std::uint32_t>(random() % (mesh.split_count() + 1)));
    morph.follow(mesh);
    expect_equal(morph, progressive::Geomorph(mesh));
  }
}

TEST(Geomorph, ExtendsWithAppendedSplits) {
  progressive::ProgressiveMesh whole = progressive(bumpy());
  whole.go_to(0);
  progressive::ProgressiveMesh arriving{Mesh(whole.mesh())};
  progressive::Geomorph morph;
  morph.extend(arriving);
  for (std::uint32_t i = 0; i < whole.split_count(); ++i) {
    whole.go_to(i);
    arriving.append(whole.next_split());
    if (i % 97 != 0) continue;
    morph.extend(arriving);
    morph.follow(arriving);
    EXPECT_TRUE(morph.normals().empty());
  }
  morph.extend(arriving);
  morph.follow(arriving);
  morph.find_normals(arriving);
  expect_equal(morph, progressive::Geomorph(arriving));
}

TEST(Geomorph, BaseWithoutSplitsHasNothingToMorph) {
  progressive::ProgressiveMesh mesh{built(cube()).mesh};
  const progressive::Geomorph morph(mesh);
  EXPECT_TRUE(morph.splits().empty());
  ASSERT_EQ(morph.heads().size(), mesh.mesh().vertex_count());
  for (const std::uint32_t head : morph.heads())
    EXPECT_EQ(head, kNoHead);
}

TEST(Geomorph, StopsWhenCanceled) {
  progressive::ProgressiveMesh mesh = progressive(bumpy());
  Progress progress;
  progress.cancel();
  EXPECT_THROW(progressive::Geomorph(mesh, &progress), Cancelled);
}

}  // namespace
}  // namespace mesher::test
