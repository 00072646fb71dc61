#include "engine/simplify/attribute_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "engine/mesh/circulators.h"
#include "engine/simplify/attribute_policy.h"
#include "engine/simplify/bucket_queue.h"
#include "engine/simplify/collapser.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::AttributeField;
using simplify::AttributeMetric;
using simplify::Surface;

/// A bumpy torus, closed, with a random vector of `size` numbers per vertex.
struct Bumpy {
  explicit Bumpy(std::size_t size, unsigned seed = 1) {
    Soup soup = torus(12, 8);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> bump(-0.05F, 0.05F);
    for (glm::vec3& p : soup.positions)
      p += glm::vec3(bump(random), bump(random), bump(random));
    mesh = built(std::move(soup)).mesh;
    metric.size = size;
    std::uniform_real_distribution<float> value(-1.0F, 1.0F);
    for (std::size_t i = 0; i < size * mesh.vertex_count(); ++i)
      metric.values.push_back(value(random));
    for (const Vertex v : mesh.origins())
      metric.of_corner.push_back(v.index());
  }

  Mesh mesh;
  AttributeMetric metric;
};

/// The cost of merging an edge at `p`, straight from the definition: each face at either end
/// extends its attributes to `p`, and the vertex gets their mean.
double cost_by_definition(const Mesh& mesh, const AttributeMetric& metric, Halfedge h,
                          const glm::dvec3& p) {
  double cost = 0.0;
  for (std::size_t j = 0; j < metric.size; ++j) {
    std::vector<std::pair<double, double>> extended;  // value, area
    for (const Vertex v : {mesh.origin(h), mesh.target(h)}) {
      for (const Halfedge spoke : halfedges_around(mesh, v)) {
        glm::dvec3 at[3];
        double a[3];
        Halfedge corner = spoke;
        for (int c = 0; c < 3; ++c, corner = Mesh::next(corner)) {
          at[c] = mesh.position(mesh.origin(corner));
          a[c] = double{metric.at(corner.index())[j]};
        }
        const glm::dvec3 first = at[1] - at[0];
        const glm::dvec3 second = at[2] - at[0];
        const glm::dvec3 n = glm::cross(first, second);
        const glm::dvec3 gradient =
            ((a[1] - a[0]) * glm::cross(second, n) + (a[2] - a[0]) * glm::cross(n, first)) /
            glm::dot(n, n);
        extended.emplace_back(a[0] + glm::dot(gradient, p - at[0]), 0.5 * glm::length(n));
      }
    }
    double sum = 0.0;
    double area = 0.0;
    for (const auto& [value, weight] : extended) {
      sum += weight * value;
      area += weight;
    }
    for (const auto& [value, weight] : extended)
      cost += weight * (value - sum / area) * (value - sum / area);
  }
  return cost;
}

TEST(AttributeField, QuadricIsTheCostByDefinition) {
  for (const std::size_t size : {1U, 2U, 5U, 8U, 16U}) {
    Bumpy bumpy(size);
    const Mesh mesh = bumpy.mesh;
    const Surface surface(std::move(bumpy.mesh), {});
    const AttributeField field(surface, bumpy.metric);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> offset(-0.2F, 0.2F);
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += 7) {
      const Halfedge h(i);
      const glm::dvec3 middle = 0.5 * (glm::dvec3(mesh.position(mesh.origin(h))) +
                                       glm::dvec3(mesh.position(mesh.target(h))));
      const glm::vec3 y(offset(random), offset(random), offset(random));
      const double expected = cost_by_definition(mesh, bumpy.metric, h, middle + glm::dvec3(y));
      const double found = field.quadric(surface, h).cost({y.x, y.y, y.z});
      EXPECT_NEAR(found, expected, 1e-3 * expected + 1e-5) << size << " " << i;
    }
  }
}

TEST(AttributeField, EightEdgesHaveTheCostsOfEach) {
  Bumpy bumpy(5);
  const Surface surface(std::move(bumpy.mesh), {});
  const AttributeField field(surface, bumpy.metric);
  std::array<Halfedge, 8> edges;
  for (std::uint32_t lane = 0; lane < 8; ++lane)
    edges[lane] = Halfedge(11 * lane);
  const simplify::EdgeQuadric<Float8> shapes = surface.edge_quadrics(edges);
  const auto eight = field.quadrics(edges, shapes.half);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto one = field.quadric(surface, edges[lane]);
    EXPECT_EQ(lane < 4 ? eight.constant.low[lane] : eight.constant.high[lane - 4], one.constant);
    EXPECT_EQ(lane < 4 ? eight.a.xy.low[lane] : eight.a.xy.high[lane - 4], one.a.xy);
    EXPECT_EQ(lane < 4 ? eight.linear.z.low[lane] : eight.linear.z.high[lane - 4], one.linear.z);
  }
}

TEST(AttributeField, CostAtAnEndKeepsItsValues) {
  // In a flat sheet with a linear attribute, moving a vertex costs nothing: its faces agree at the
  // other end. Moved to a vertex whose value is off by d, it costs the area times d squared.
  Mesh mesh = built(grid(4)).mesh;
  AttributeMetric metric{.size = 1};
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    metric.values.push_back(2.0F * mesh.position(Vertex(v)).x - mesh.position(Vertex(v)).y);
  for (const Vertex v : mesh.origins())
    metric.of_corner.push_back(v.index());
  Halfedge inner;
  for (std::uint32_t i = 0; i < mesh.halfedge_count() && !inner.is_valid(); ++i) {
    const Halfedge h(i);
    if (!mesh.is_boundary(mesh.origin(h)) && !mesh.is_boundary(mesh.target(h))) inner = h;
  }
  ASSERT_TRUE(inner.is_valid());
  const Surface surface(Mesh(mesh), {});
  EXPECT_NEAR(AttributeField(surface, metric).cost_at_target(surface, inner), 0.0F, 1e-6F);
  EXPECT_NEAR(AttributeField(surface, metric).cost_at_origin(surface, inner), 0.0F, 1e-6F);
}

/// Collapses edges of a surface with a policy that follows attributes.
struct Collapsing {
  Collapsing(Bumpy&& bumpy, const simplify::SimplifyOptions& options)
      : surface(std::move(bumpy.mesh), options),
        policy(options.placement, surface, bumpy.metric),
        queue(surface.mesh().vertex_count(), simplify::QueueEntry{}),
        context{.surface = surface, .policy = policy, .queue = queue} {
    context.faces_to_remove = surface.mesh().face_count();
    simplify::evaluate_all(context);
    for (std::uint32_t v = 0; v < surface.mesh().vertex_count(); ++v)
      vertices.emplace_back(v);
  }
  void run(std::uint32_t faces) {
    simplify::Collapser collapser(context, {.faces = faces, .fresh_after = 0, .valence = 64});
    removed = collapser.run(vertices).removed_faces;
  }

  Surface surface;
  simplify::AttributePolicy policy;
  Array<simplify::QueueEntry> queue;
  simplify::CollapseContext context;
  std::vector<Vertex> vertices;
  std::uint32_t removed = 0;
};

TEST(AttributeField, SumsFollowEveryCollapse) {
  for (const auto placement : {simplify::Placement::optimal, simplify::Placement::endpoint}) {
    Collapsing collapsing(Bumpy(5), {.placement = placement});
    collapsing.run(100);
    ASSERT_GE(collapsing.removed, 98U);
    const Mesh& mesh = collapsing.surface.mesh();
    const AttributeField& field = *collapsing.policy.attributes();
    AttributeMetric now{.size = 5};
    Array<Face> left;
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      now.of_corner.push_back(h);
      if (collapsing.surface.is_removed(Mesh::face(Halfedge(h)))) {
        now.values.insert(now.values.end(), 5, 0.0F);
        continue;
      }
      field.append_values(Halfedge(h), 1.0F, now.values);
    }
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      const Halfedge edge(h);
      if (collapsing.surface.is_removed(Mesh::face(edge)) || h % 5 != 0) continue;
      const glm::dvec3 middle = 0.5 * (glm::dvec3(mesh.position(mesh.origin(edge))) +
                                       glm::dvec3(mesh.position(mesh.target(edge))));
      const double expected = cost_by_definition(mesh, now, edge, middle);
      EXPECT_NEAR(field.quadric(collapsing.surface, edge).cost({0.0F, 0.0F, 0.0F}), expected,
                  1e-2 * expected + 1e-3);
    }
  }
}

TEST(AttributeField, CornersAtAnEndNameTheirSource) {
  Collapsing collapsing(Bumpy(3), {.placement = simplify::Placement::endpoint});
  collapsing.run(60);
  const Mesh& mesh = collapsing.surface.mesh();
  const AttributeField& field = *collapsing.policy.attributes();
  const Bumpy before(3);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    if (collapsing.surface.is_removed(Mesh::face(Halfedge(h)))) continue;
    const std::uint32_t source = field.source(Halfedge(h));
    ASSERT_NE(source, kNone) << "every vertex is one of the input";
    EXPECT_EQ(mesh.position(mesh.origin(Halfedge(h))), before.mesh.position(Vertex(source)));
    Array<float> values;
    field.append_values(Halfedge(h), 1.0F, values);
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_EQ(values[j], before.metric.values[3 * source + j]);
  }
}

TEST(AttributeField, NoTextureTriangleTurnsOver) {
  Bumpy bumpy(2);
  bumpy.metric.layers.push_back({0, 1.0, 0, true});
  // Random texture coordinates: half of the faces are mirrored already.
  const auto area = [](const Mesh& mesh, const AttributeField& field, Face f) {
    Array<float> uv;
    for (std::uint32_t c = 0; c < 3; ++c)
      field.append_values(Mesh::halfedge(f, c), 1.0F, uv);
    (void)mesh;
    return (uv[2] - uv[0]) * (uv[5] - uv[1]) - (uv[3] - uv[1]) * (uv[4] - uv[0]);
  };
  Collapsing collapsing(std::move(bumpy), {});
  const Mesh& mesh = collapsing.surface.mesh();
  const AttributeField& field = *collapsing.policy.attributes();
  std::vector<float> before;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    before.push_back(area(mesh, field, Face(f)));
  collapsing.run(100);
  EXPECT_GT(collapsing.removed, 4U);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (collapsing.surface.is_removed(Face(f))) continue;
    EXPECT_GT(before[f] * area(mesh, field, Face(f)), 0.0F) << f;
  }
}

}  // namespace
}  // namespace mesher::test
