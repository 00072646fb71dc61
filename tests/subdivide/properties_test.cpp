// Properties of subdivision that hold for any mesh and any rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/models.h"
#include "tests/support/meshes.h"
#include "tests/support/watched.h"

namespace mesher::test {
namespace {

std::string describe(const subdivide::SubdivideOptions& o) {
  return "scheme " + std::to_string(int(o.scheme)) + ", creases " + std::to_string(int(o.creases)) +
         ", boundary " + std::to_string(int(o.boundary)) + ", decay " +
         std::to_string(int(o.decay)) + (o.limit ? ", limit" : "");
}

/// Every third model. Each property is tested on these.
std::vector<const Model*> some_models(std::uint32_t most_faces = 150) {
  std::vector<const Model*> some;
  for (std::size_t i = 0; i < models().size(); ++i) {
    if (i % 3 == 0 && models()[i].mesh.face_count() <= most_faces) some.push_back(&models()[i]);
  }
  return some;
}

double size_of(const Mesh& mesh) {
  return diagonal(points_of(mesh.positions()));
}

double distance(const Mesh& a, const Mesh& b) {
  if (a.vertex_count() != b.vertex_count()) return kForEver;
  return largest_distance(points_of(a.positions()), points_of(b.positions()));
}

Mesh mapped(Mesh mesh) {
  const glm::mat3 linear(1.5F, 0.25F, -0.5F, 0.5F, -0.75F, 0.25F, 0.125F, 1.0F, 0.5F);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vertex vertex(v);
    mesh.set_position(vertex, linear * mesh.position(vertex) + glm::vec3(3.0F, -1.0F, 2.0F));
  }
  return mesh;
}

TEST(Properties, SubdivisionCommutesWithAffineMaps) {
  for (const subdivide::SubdivideOptions& options : every_rule(2)) {
    SCOPED_TRACE(describe(options));
    for (const Model* model : some_models()) {
      SCOPED_TRACE(model->name);
      const Mesh before = subdivide::subdivide(mapped(model->mesh), options).mesh;
      const Mesh after = mapped(subdivide::subdivide(model->mesh, options).mesh);
      // Only rounding of coordinates around 10.
      EXPECT_LE(distance(before, after), 4 * kTolerance * size_of(before));
    }
  }
}

TEST(Properties, ZeroSharpnessEqualsNoTag) {
  for (const subdivide::SubdivideOptions& options : every_rule(2)) {
    SCOPED_TRACE(describe(options));
    for (const Model* model : some_models()) {
      if (!is_untagged(model->mesh)) continue;
      Mesh tagged = model->mesh;
      for (std::uint32_t h = 0; h < tagged.halfedge_count(); ++h)
        tagged.set_sharpness(tagged.edge(Halfedge(h)), 0.0F);
      tagged.set_sharpness(Vertex(0), 0.0F);
      const Mesh a = subdivide::subdivide(tagged, options).mesh;
      const Mesh b = subdivide::subdivide(model->mesh, options).mesh;
      ASSERT_EQ(a.vertex_count(), b.vertex_count());
      EXPECT_EQ(std::memcmp(a.positions().data(), b.positions().data(), a.positions().size_bytes()),
                0)
          << model->name;
    }
  }
}

/// An icosahedron with a loop of the given sharpness (0: none).
Mesh looped(float sharpness) {
  Mesh mesh = built(jittered(icosahedron(), 0.1F)).mesh;
  for (std::uint32_t i = 0; i < 5; ++i) {
    mesh.set_sharpness(mesh.find_edge(Vertex(1 + i), Vertex(1 + (i + 1) % 5)), sharpness);
  }
  return mesh;
}

/// The same mesh without any sharpness.
Mesh dulled(Mesh mesh) {
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    mesh.set_sharpness(mesh.edge(Halfedge(h)), 0.0F);
  return mesh;
}

TEST(Properties, IntegerSharpnessEqualsThatManyCreaseLevels) {
  for (const subdivide::CreaseRules creases :
       {subdivide::CreaseRules::hoppe94, subdivide::CreaseRules::derose98}) {
    for (std::uint32_t k = 1; k <= 3; ++k) {
      const Mesh soft =
          subdivide::subdivide(looped(float(k)), {.levels = k + 1, .creases = creases}).mesh;
      const Mesh sharp =
          subdivide::subdivide(looped(kInfinitelySharp), {.levels = k, .creases = creases}).mesh;
      const Mesh by_hand =
          subdivide::subdivide(dulled(sharp), {.levels = 1, .creases = creases}).mesh;
      EXPECT_LE(distance(soft, by_hand), kTolerance * size_of(soft)) << k;
    }
  }
}

TEST(Properties, ResultIsContinuousInTheSharpness) {
  constexpr float kStep = 1e-3F;
  for (const subdivide::CreaseRules creases :
       {subdivide::CreaseRules::hoppe94, subdivide::CreaseRules::derose98}) {
    for (const subdivide::CreaseDecay decay : kDecays) {
      for (const bool limit : {false, true}) {
        const subdivide::SubdivideOptions options{
            .levels = 4, .creases = creases, .decay = decay, .limit = limit};
        for (const float s : {0.0F, 0.3F, 0.9995F, 1.0F, 1.4F, 1.9995F, 2.0F, 2.9995F}) {
          const Mesh a = subdivide::subdivide(looped(s), options).mesh;
          const Mesh b = subdivide::subdivide(looped(s + kStep), options).mesh;
          EXPECT_LE(distance(a, b), 2 * kStep * size_of(a)) << describe(options) << ' ' << s;
        }
      }
    }
  }
}

TEST(Properties, OldVerticesHaveTheSameLimitAtEveryLevel) {
  for (const subdivide::SubdivideOptions& rule : every_rule(0)) {
    if (!rule.limit) continue;
    SCOPED_TRACE(describe(rule));
    for (const Model* model : some_models()) {
      SCOPED_TRACE(model->name);
      subdivide::SubdivideOptions options = rule;
      std::vector<Point> coarse =
          points_of(subdivide::subdivide(model->mesh, options).mesh.positions());
      for (options.levels = 1; options.levels <= 3; ++options.levels) {
        const std::vector<Point> fine =
            points_of(subdivide::subdivide(model->mesh, options).mesh.positions());
        ASSERT_GE(fine.size(), coarse.size());
        EXPECT_LE(largest_distance(coarse, fine), kTolerance * size_of(model->mesh))
            << "level " << options.levels;
        coarse = fine;
      }
    }
  }
}

std::size_t count_twinless(const Mesh& mesh) {
  return static_cast<std::size_t>(std::count(mesh.twins().begin(), mesh.twins().end(), Halfedge()));
}

TEST(Properties, KeepsTopologyAndDoublesBoundaryEdges) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const std::uint32_t most = std::min(3U, affordable_levels(model.mesh, 3));
    for (std::uint32_t levels = 0; levels <= most; ++levels) {
      const Mesh fine = subdivide::subdivide(model.mesh, {.levels = levels}).mesh;
      expect_valid(fine);
      EXPECT_EQ(topology(fine), topology(model.mesh));
      EXPECT_EQ(fine.face_count(), model.mesh.face_count() << (2 * levels));
      EXPECT_EQ(count_twinless(fine), count_twinless(model.mesh) << levels);
    }
  }
}

template <class T>
bool is_same_bytes(const Array<T>& a, const Array<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST(Properties, SameBytesForAnyThreadCount) {
  for (const subdivide::SubdivideOptions& options : every_rule(4)) {
    SCOPED_TRACE(describe(options));
    for (const Model& model : models()) {
      if (model.name != "random 7" && model.name != "grid, soft crease to the boundary") continue;
      const auto run = [&](unsigned threads) {
        const ThreadLimit limit(threads);
        return subdivide::subdivide(model.mesh, options);
      };
      const subdivide::Subdivided one = run(1);
      for (const unsigned threads : {2U, 5U}) {
        const subdivide::Subdivided many = run(threads);
        EXPECT_TRUE(is_identical(one.mesh, many.mesh)) << model.name << ", " << threads;
        EXPECT_TRUE(is_same_bytes(one.limit_normal, many.limit_normal)) << model.name;
      }
    }
  }
}

TEST(Properties, TriangleOutputMatchesTheMesh) {
  for (const subdivide::SubdivideOptions& rule : every_rule(0)) {
    SCOPED_TRACE(describe(rule));
    for (const Model* model : some_models()) {
      SCOPED_TRACE(model->name);
      subdivide::SubdivideOptions options = rule;
      for (options.levels = 0; options.levels <= 2; ++options.levels) {
        const Mesh mesh = subdivide::subdivide(model->mesh, options).mesh;
        const subdivide::IndexedTriangles bare =
            subdivide::subdivide_to_triangles(model->mesh, options);
        EXPECT_TRUE(is_same_bytes(
            bare.position, Array<glm::vec3>(mesh.positions().begin(), mesh.positions().end())));
        EXPECT_TRUE(
            is_same_bytes(bare.index, Array<Vertex>(mesh.origins().begin(), mesh.origins().end())));
      }
    }
  }
}

TEST(Properties, PredictedSizeIsExact) {
  for (const Model* model : some_models()) {
    SCOPED_TRACE(model->name);
    for (std::uint32_t levels = 0; levels <= 3; ++levels) {
      const Mesh fine = subdivide::subdivide(model->mesh, {.levels = levels}).mesh;
      const subdivide::SubdivisionSize size =
          subdivide::subdivision_size(model->mesh, {.levels = levels});
      EXPECT_EQ(size.vertices, fine.vertex_count());
      EXPECT_EQ(size.faces, fine.face_count());
      EXPECT_TRUE(size.has_ids);
      EXPECT_GE(size.peak_bytes, size.result_bytes);
      if (levels > 0 && fine.vertex_sharpnesses().empty()) {
        EXPECT_NEAR(double(size.result_bytes), double(fine.memory_bytes()),
                    0.25 * double(fine.memory_bytes()) + 64);
      }
    }
  }
}

TEST(Properties, PredictedSizeDoesNotOverflow) {
  const Mesh mesh = built(octahedron()).mesh;
  EXPECT_TRUE(
      subdivide::subdivision_size(mesh, {.levels = 13}).has_ids);  // 3 * 8 * 4^13: 1.6 billion
  EXPECT_FALSE(subdivide::subdivision_size(mesh, {.levels = 14}).has_ids);  // 6.4 billion
  EXPECT_EQ(subdivide::subdivision_size(mesh, {.levels = 14}).faces, 8ULL << 28);
  for (const std::uint32_t levels : {15U, 31U, 32U, 64U, 1000U, 0xFFFFFFFFU})
    EXPECT_FALSE(subdivide::subdivision_size(mesh, {.levels = levels}).has_ids) << levels;
}

TEST(Properties, ZeroLevelsAndEmptyMeshesAreAccepted) {
  for (const subdivide::SubdivideOptions& options : every_rule(0)) {
    if (options.limit) continue;
    for (const Model* model : some_models())
      EXPECT_EQ(distance(subdivide::subdivide(model->mesh, options).mesh, model->mesh), 0.0);
  }
  for (const subdivide::SubdivideOptions& options : every_rule(3)) {
    EXPECT_EQ(subdivide::subdivide(Mesh(), options).mesh.vertex_count(), 0U);
    EXPECT_TRUE(subdivide::subdivide_to_triangles(Mesh(), options).index.empty());
  }
}

TEST(Properties, IsolatedVerticesDoNotMove) {
  for (const subdivide::SubdivideOptions& options : every_rule(2)) {
    SCOPED_TRACE(describe(options));
    for (const Model& model : models()) {
      const Mesh fine = model.name == "isolated vertices"
                            ? subdivide::subdivide(model.mesh, options).mesh
                            : Mesh();
      for (std::uint32_t v = 0; v < model.mesh.vertex_count() && fine.vertex_count() > 0; ++v) {
        if (!model.mesh.is_isolated(Vertex(v))) continue;
        EXPECT_EQ(fine.position(Vertex(v)), model.mesh.position(Vertex(v)));
        EXPECT_TRUE(fine.is_isolated(Vertex(v)));
      }
    }
  }
}

TEST(Properties, ThrowsWhenCanceled) {
  const Mesh mesh = built(octahedron()).mesh;
  for (const subdivide::Scheme scheme :
       {subdivide::Scheme::loop, subdivide::Scheme::butterfly, subdivide::Scheme::midpoint}) {
    Progress progress;
    progress.cancel();
    const subdivide::SubdivideOptions options{.levels = 3, .scheme = scheme, .progress = &progress};
    EXPECT_THROW(static_cast<void>(subdivide::subdivide(mesh, options)), Cancelled);
    EXPECT_THROW(static_cast<void>(subdivide::subdivide_to_triangles(mesh, options)), Cancelled);
  }
}

TEST(Properties, HasOneProgress) {
  const Mesh mesh = built(torus(260, 160)).mesh;
  for (const subdivide::Scheme scheme :
       {subdivide::Scheme::loop, subdivide::Scheme::butterfly, subdivide::Scheme::midpoint}) {
    for (const unsigned threads : {1U, 2U}) {
      const ThreadLimit limit(threads);
      const auto subdivide = [&](bool with_limit) {
        return [&, with_limit](Progress* progress) {
          static_cast<void>(subdivide::subdivide(
              mesh, {.levels = 2, .scheme = scheme, .limit = with_limit, .progress = progress}));
        };
      };
      const std::vector<std::string> levels{"subdividing, level 1 of 2",
                                            "subdividing, level 2 of 2"};
      expect_one_progress(watched(subdivide(false)), levels);
      if (!subdivide::traits(scheme).has_limit) continue;
      std::vector<std::string> with_limit = levels;
      with_limit.insert(with_limit.end(),
                        {"projecting to the limit", "following creases to the limit"});
      expect_one_progress(watched(subdivide(true)), with_limit);
    }
  }
}

TEST(Properties, CanBeCanceledAtAnyMoment) {
  const Mesh mesh = built(torus(300, 200)).mesh;
  cancel_at_many_moments("subdividing", [&](Progress* progress) {
    static_cast<void>(subdivide::subdivide(mesh, {.levels = 3, .progress = progress}));
  });
}

}  // namespace
}  // namespace mesher::test
