#include "engine/simplify/carry_attributes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/mesh/normals.h"
#include "engine/mesh/wedges.h"
#include "engine/simplify/simplify_model.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::SimplifiedModel;
using simplify::simplify_model;

/// A sheet with texture coordinates that are a linear function of the position.
struct Sheet {
  static glm::vec2 texcoord_at(const glm::vec3& p) {
    return {0.25F * p.x - 0.5F * p.y, 3.0F + 0.125F * p.y};
  }

  explicit Sheet(std::uint32_t side = 12) : mesh(built(grid(side)).mesh) {
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      corners.texcoord.push_back(texcoord_at(mesh.position(mesh.origin(Halfedge(h)))));
      corners.normal.push_back({0.0F, 0.0F, 1.0F});
      corners.color.push_back({200, 100, 50, 255});
    }
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
      corners.group.push_back(f % 3);
    corners.groups = test::named_groups({"a", "b", "c"});
  }
  SimplifiedModel simplified(std::uint32_t target) const {
    return simplify_model(Mesh(mesh), to_wedges(mesh, CornerAttributes(corners)),
                          {.target_faces = target});
  }

  Mesh mesh;
  CornerAttributes corners;
};

void expect_valid_model(const SimplifiedModel& model) {
  EXPECT_TRUE(validate(model.simplified.mesh).empty());
  EXPECT_TRUE(validate(model.simplified.mesh, model.attributes).empty());
}

TEST(CarryAttributes, LinearFunctionsOfAPlaneAreReproduced) {
  for (const std::uint32_t target : {200U, 60U, 10U, 2U}) {
    const SimplifiedModel model = Sheet().simplified(target);
    expect_valid_model(model);
    const Mesh& mesh = model.simplified.mesh;
    ASSERT_LE(mesh.face_count(), target);
    const CornerAttributes carried = to_corners(mesh, model.attributes);
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      const glm::vec2 expected = Sheet::texcoord_at(mesh.position(mesh.origin(Halfedge(h))));
      EXPECT_NEAR(carried.texcoord[h].x, expected.x, 1e-5F);
      EXPECT_NEAR(carried.texcoord[h].y, expected.y, 1e-5F);
      EXPECT_EQ(carried.normal[h], glm::vec3(0, 0, 1));
      EXPECT_EQ(carried.color[h], glm::u8vec4(200, 100, 50, 255));
    }
    EXPECT_FALSE(model.attributes.has_seams());
  }
}

/// A torus cut open in its texture: u jumps from 1 to 0 at a ring of edges; normals are smooth.
Attributes cut_torus(const Mesh& mesh) {
  CornerAttributes corners;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    double angle[3];
    for (std::uint32_t c = 0; c < 3; ++c) {
      const glm::vec3 p = mesh.position(mesh.origin(Mesh::halfedge(Face(f), c)));
      angle[c] = std::atan2(p.y, p.x);
      corners.normal.push_back(glm::normalize(p));
    }
    const double least = std::min({angle[0], angle[1], angle[2]});
    for (double& a : angle) {
      // A face that crosses the cut has all its corners on one side.
      if (least < -2.0 && a > 2.0) a -= 2.0 * 3.14159265358979;
      corners.texcoord.push_back({static_cast<float>(a), 0.0F});
    }
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge h = Mesh::halfedge(Face(f), c);
      corners.texcoord[h.index()].y = mesh.position(mesh.origin(h)).z;
    }
  }
  return to_wedges(mesh, std::move(corners));
}

TEST(CarryAttributes, ConstantAttributesChangeNothing) {
  Mesh mesh = built(torus(40, 30)).mesh;
  CornerAttributes constant;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    constant.texcoord.push_back({0.5F, 0.5F});
    constant.normal.push_back({0.0F, 1.0F, 0.0F});
    constant.color.push_back({1, 2, 3, 255});
  }
  for (const std::uint32_t target : {1000U, 200U, 40U}) {
    const SimplifiedModel with = simplify_model(
        Mesh(mesh), to_wedges(mesh, CornerAttributes(constant)), {.target_faces = target});
    const SimplifiedModel without = simplify_model(Mesh(mesh), {}, {.target_faces = target});
    EXPECT_TRUE(is_identical(with.simplified.mesh, without.simplified.mesh)) << target;
  }
}

TEST(CarryAttributes, SizeOfTheTextureChangesNothingElse) {
  const Mesh mesh = built(torus(40, 30)).mesh;
  const auto simplified = [&](float size) {
    CornerAttributes corners;
    for (const Vertex v : mesh.origins()) {
      const glm::vec3 p = mesh.position(v);
      corners.texcoord.push_back({size * p.x, size * (p.y + p.x * p.x)});
    }
    return simplify_model(Mesh(mesh), to_wedges(mesh, std::move(corners)), {.target_faces = 300});
  };
  const SimplifiedModel one = simplified(1.0F);
  const SimplifiedModel large = simplified(1024.0F);
  EXPECT_TRUE(is_identical(one.simplified.mesh, large.simplified.mesh));
  const auto a = one.attributes.layers[0].values<glm::vec2>();
  const auto b = large.attributes.layers[0].values<glm::vec2>();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LT(glm::distance(1024.0F * a[i], b[i]), 1e-2F);
}

TEST(CarryAttributes, SameForAnyThreadCount) {
  const Mesh mesh = built(torus(200, 100)).mesh;  // several regions
  const Attributes attributes = cut_torus(mesh);
  const auto with = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return simplify_model(Mesh(mesh), attributes, {.target_faces = 4000});
  };
  const SimplifiedModel one = with(1);
  const SimplifiedModel seven = with(7);
  EXPECT_TRUE(is_identical(one.simplified.mesh, seven.simplified.mesh));
  for (std::size_t i = 0; i < one.attributes.layers.size(); ++i)
    EXPECT_EQ(one.attributes.layers[i].bytes(), seven.attributes.layers[i].bytes());
}

TEST(CarryAttributes, SeamOfATextureDoesNotSplitNormals) {
  const Mesh mesh = built(torus(60, 40)).mesh;
  const Attributes attributes = cut_torus(mesh);
  ASSERT_TRUE(attributes.has_seams());
  for (const std::uint32_t target : {2000U, 600U, 200U}) {
    const SimplifiedModel model = simplify_model(Mesh(mesh), attributes, {.target_faces = target});
    const Mesh& result = model.simplified.mesh;
    const AttributeLayer& normals = *model.attributes.find(AttributeKind::normal);
    std::size_t seams = 0;
    for (std::uint32_t i = 0; i < result.halfedge_count(); ++i) {
      const Halfedge h(i);
      const Halfedge t = result.twin(h);
      const auto wedge = [&](Halfedge c) {
        return model.attributes.wedge(result.origins(), c).index();
      };
      if (!t.is_valid() || wedge(h) == wedge(Mesh::next(t))) continue;
      ++seams;
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(load(normals, wedge(h))[k], load(normals, wedge(Mesh::next(t)))[k]) << target;
    }
    EXPECT_GT(seams, 4U) << "the texture is still cut open";
  }
}

TEST(CarryAttributes, SoftNormalsStayWhereNothingCollapses) {
  // A fan whose normals differ by a few degrees from face to face, and a sheet that collapses.
  Mesh mesh = built(grid(20)).mesh;
  CornerAttributes corners;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const bool is_rough = mesh.position(mesh.origin(Halfedge(h))).x < 1.5F;
    const float tilt = is_rough ? 0.01F * static_cast<float>(h % 17) : 0.0F;
    corners.normal.push_back(glm::normalize(glm::vec3(tilt, 0.0F, 1.0F)));
  }
  const Attributes attributes = to_wedges(mesh, CornerAttributes(corners));
  const SimplifiedModel model =
      simplify_model(Mesh(mesh), attributes, {.target_faces = mesh.face_count()});
  const CornerAttributes after = to_corners(model.simplified.mesh, model.attributes);
  EXPECT_EQ(after.normal, corners.normal);
}

TEST(CarryAttributes, ColorsStayWithinTheirRange) {
  const Mesh mesh = built(torus(40, 30)).mesh;
  AttributeType type = color_type();
  type.component = ComponentType::f32;
  type.is_normalized = false;
  AttributeStream stream;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    stream.index.push_back(h);
  AttributeLayer& layer = stream.layers.emplace_back(type, mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const double x = mesh.position(mesh.origin(Halfedge(h))).x > 0.1F ? 1.0 : 0.0;
    store(layer, h, {x, 1.0 - x, 0.0, 1.0});
  }
  std::vector<AttributeStream> streams;
  streams.push_back(std::move(stream));
  const Attributes attributes = make_wedges(mesh, std::move(streams));
  const SimplifiedModel model = simplify_model(Mesh(mesh), attributes, {.target_faces = 200});
  for (std::size_t i = 0; i < model.attributes.layers[0].count(); ++i) {
    for (const double x : load(model.attributes.layers[0], i)) {
      EXPECT_GE(x, 0.0);
      EXPECT_LE(x, 1.0);
    }
  }
}

TEST(CarryAttributes, TextureThatVariesDrawsFacesToIt) {
  // Half of a flat sheet has a wavy texture: the faces that are left are where it is.
  const Mesh mesh = built(grid(60)).mesh;
  CornerAttributes corners;
  const auto is_wavy = [](const glm::vec3& p) { return p.x > 30.0F; };
  for (const Vertex v : mesh.origins()) {
    const glm::vec3 p = mesh.position(v);
    corners.texcoord.push_back({p.x, p.y + (is_wavy(p) ? 2.0F * std::sin(0.5F * p.x) : 0.0F)});
  }
  const SimplifiedModel model =
      simplify_model(Mesh(mesh), to_wedges(mesh, std::move(corners)), {.target_faces = 300});
  std::size_t wavy = 0;
  const Mesh& result = model.simplified.mesh;
  for (std::uint32_t v = 0; v < result.vertex_count(); ++v)
    wavy += is_wavy(result.position(Vertex(v))) ? 1 : 0;
  EXPECT_GT(wavy, result.vertex_count() * 3 / 4);
}

TEST(CarryAttributes, GroupsStayWithTheirFaces) {
  const SimplifiedModel model = Sheet().simplified(60);
  ASSERT_EQ(model.attributes.group.size(), model.simplified.mesh.face_count());
  for (std::uint32_t f = 0; f < model.simplified.mesh.face_count(); ++f)
    EXPECT_EQ(model.attributes.group[f], model.simplified.face_source[f].index() % 3);
  EXPECT_EQ(model.attributes.groups, Sheet().corners.groups);
}

TEST(CarryAttributes, StraightSeamSurvivesToTheLastFaces) {
  Sheet sheet;
  for (std::uint32_t f = 0; f < sheet.mesh.face_count() / 2; ++f) {  // the lower half
    for (std::uint32_t c = 0; c < 3; ++c)
      sheet.corners.texcoord[3 * f + c].x += 10.0F;
  }
  for (const std::uint32_t target : {100U, 20U, 8U}) {
    const SimplifiedModel model = sheet.simplified(target);
    expect_valid_model(model);
    EXPECT_FALSE(model.crosses_seams) << target;
    const Mesh& mesh = model.simplified.mesh;
    ASSERT_LE(mesh.face_count(), target);
    const CornerAttributes carried = to_corners(mesh, model.attributes);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      float center = 0.0F;
      for (std::uint32_t c = 0; c < 3; ++c)
        center += mesh.position(mesh.origin(Halfedge(3 * f + c))).y / 3.0F;
      const float offset = center < 6.0F ? 10.0F : 0.0F;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const glm::vec3& p = mesh.position(mesh.origin(Halfedge(3 * f + c)));
        EXPECT_NEAR(carried.texcoord[3 * f + c].x, Sheet::texcoord_at(p).x + offset, 1e-4F) << f;
      }
    }
    for (const float sharpness : mesh.sharpnesses())
      EXPECT_EQ(sharpness, 0.0F) << "the mark of the seam is gone";
  }
}

/// An open cylinder of `around` x 8 squares whose texture goes around once, from 0 to 1.
struct Tube {
  explicit Tube(std::uint32_t around) {
    constexpr std::uint32_t kRings = 9;
    Soup soup;
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      for (std::uint32_t i = 0; i < around; ++i) {
        const float angle = 6.2831853F * float(i) / float(around);
        soup.positions.push_back({std::cos(angle), std::sin(angle), 0.5F * float(ring)});
      }
    }
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      for (std::uint32_t i = 0; i < around; ++i) {
        const auto add = [&](std::uint32_t di, std::uint32_t dring) {
          soup.corners.push_back((ring + dring) * around + (i + di) % around);
          soup.attributes.texcoord.push_back(
              {float(i + di) / float(around), float(ring + dring) / float(kRings - 1)});
        };
        for (const auto& [di, dring] :
             {std::pair{0U, 0U}, {1U, 0U}, {1U, 1U}, {0U, 0U}, {1U, 1U}, {0U, 1U}})
          add(di, dring);
      }
    }
    BuildResult result = built(std::move(soup));
    mesh = std::move(result.mesh);
    attributes = std::move(result.attributes);
  }
  Mesh mesh;
  Attributes attributes;
};

TEST(CarryAttributes, TextureAroundATubeStaysCutOnce) {
  for (const std::uint32_t around : {5U, 6U, 12U, 40U}) {
    const Tube tube(around);
    EXPECT_EQ(tube.attributes.further.size(), 9U) << around;
    for (const std::uint32_t share : {1U, 2U, 4U}) {
      const SimplifiedModel model = simplify_model(
          Mesh(tube.mesh), tube.attributes, {.target_faces = tube.mesh.face_count() / share});
      expect_valid_model(model);
      const Mesh& mesh = model.simplified.mesh;
      const CornerAttributes carried = to_corners(mesh, model.attributes);
      for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        float low = 1.0F;
        float high = 0.0F;
        for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
          low = std::min(low, carried.texcoord[h].x);
          high = std::max(high, carried.texcoord[h].x);
        }
        EXPECT_LT(high - low, 0.75F) << around << " a face runs around the tube";
      }
    }
  }
}

TEST(CarryAttributes, VerticesThatStayKeepTheirBits) {
  const Tube tube(12);
  const SimplifiedModel model =
      simplify_model(Mesh(tube.mesh), tube.attributes,
                     {.target_faces = 100, .placement = simplify::Placement::endpoint});
  const Mesh& mesh = model.simplified.mesh;
  const CornerAttributes before = to_corners(tube.mesh, tube.attributes);
  const CornerAttributes after = to_corners(mesh, model.attributes);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const glm::vec3& p = mesh.position(mesh.origin(Halfedge(h)));
    bool is_found = false;
    for (std::uint32_t g = 0; g < tube.mesh.halfedge_count(); ++g) {
      is_found |= tube.mesh.position(tube.mesh.origin(Halfedge(g))) == p &&
                  before.texcoord[g] == after.texcoord[h];
    }
    EXPECT_TRUE(is_found) << h;
  }
}

TEST(CarryAttributes, NormalsAndTangentsHaveUnitLength) {
  const Mesh mesh = built(torus(40, 30)).mesh;
  Attributes attributes;
  set_normals(mesh, attributes, corner_normals(mesh, {}));
  AttributeLayer tangents({AttributeKind::tangent, "TANGENT", 4, ComponentType::f32},
                          mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const glm::vec3& p = mesh.position(mesh.origin(Halfedge(h)));
    const glm::vec3 t = glm::normalize(glm::vec3(-p.y, p.x, 0.0F));
    store(tangents, h, {t.x, t.y, t.z, -1.0});
  }
  set_corner_layers(mesh, attributes, {tangents});
  const SimplifiedModel model = simplify_model(Mesh(mesh), attributes, {.target_faces = 200});
  expect_valid_model(model);
  ASSERT_EQ(model.attributes.layers.size(), 2U);
  for (const AttributeLayer& layer : model.attributes.layers) {
    for (std::size_t w = 0; w < layer.count(); ++w) {
      const AttributeValue value = load(layer, w);
      EXPECT_NEAR(glm::length(glm::dvec3(value[0], value[1], value[2])), 1.0, 1e-6);
      if (layer.type().kind == AttributeKind::tangent) {
        EXPECT_EQ(value[3], -1.0);
      }
    }
  }
}

/// Layers of a sheet: its left part follows joints 3 and 9, its right part joints 4 and 8.
std::vector<AttributeLayer> two_parts(const Mesh& mesh, ComponentType weights) {
  std::vector<AttributeLayer> layers;
  layers.emplace_back(AttributeType{AttributeKind::joints, "JOINTS_0", 4, ComponentType::u8},
                      mesh.halfedge_count());
  layers.emplace_back(
      AttributeType{AttributeKind::weights, "WEIGHTS_0", 4, weights, weights != ComponentType::f32},
      mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const bool is_left = mesh.position(mesh.origin(Halfedge(h))).x < 6.0F;
    store(layers[0], h, is_left ? AttributeValue{3, 9, 0, 0} : AttributeValue{4, 8, 0, 0});
    store(layers[1], h, is_left ? AttributeValue{0.8, 0.2, 0, 0} : AttributeValue{0.4, 0.6, 0, 0});
  }
  return layers;
}

TEST(CarryAttributes, WeightsBelongToTheirJoints) {
  for (const ComponentType type : {ComponentType::f32, ComponentType::u8}) {
    Sheet sheet;
    Attributes attributes;
    set_corner_layers(sheet.mesh, attributes, two_parts(sheet.mesh, type));
    const SimplifiedModel model =
        simplify_model(Mesh(sheet.mesh), attributes, {.target_faces = 30, .weight_joint = 0.0F});
    expect_valid_model(model);
    const AttributeLayer& joints = *model.attributes.find("JOINTS_0");
    const AttributeLayer& weights = *model.attributes.find("WEIGHTS_0");
    for (std::size_t w = 0; w < joints.count(); ++w) {
      std::array<double, 10> of_joint{};
      double sum = 0.0;
      for (std::size_t c = 0; c < 4; ++c) {
        of_joint.at(static_cast<std::size_t>(load(joints, w)[c])) += load(weights, w)[c];
        sum += load(weights, w)[c];
      }
      EXPECT_NEAR(sum, 1.0, 1e-6);
      // Any blend of the two parts has these proportions.
      EXPECT_NEAR(of_joint[9], 0.25 * of_joint[3], 0.01);
      EXPECT_NEAR(of_joint[8], 1.5 * of_joint[4], 0.01);
    }
  }
}

TEST(CarryAttributes, JointsAreBlendedWhereAVertexIsNew) {
  const Mesh mesh = built(torus(24, 18)).mesh;
  Attributes attributes;
  std::vector<AttributeLayer> layers = two_parts(mesh, ComponentType::f32);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const glm::vec3 p = mesh.position(mesh.origin(Halfedge(h)));
    const double share = 0.5 + 0.25 * double{p.x} / double{bounding_box(mesh).max.x};
    store(layers[0], h, {3, 4, 0, 0});
    store(layers[1], h, {share, 1.0 - share, 0, 0});
  }
  set_corner_layers(mesh, attributes, std::move(layers));
  const SimplifiedModel model = simplify_model(Mesh(mesh), attributes, {.target_faces = 200});
  const Mesh& result = model.simplified.mesh;
  for (std::uint32_t v = 0; v < result.vertex_count(); ++v) {
    const double x = double{result.position(Vertex(v)).x} / double{bounding_box(mesh).max.x};
    const AttributeValue joints = load(*model.attributes.find("JOINTS_0"), v);
    const AttributeValue weights = load(*model.attributes.find("WEIGHTS_0"), v);
    const double share = joints[0] == 3.0 ? weights[0] : weights[1];
    // The vertex may lie off the surface by a little.
    EXPECT_NEAR(share, 0.5 + 0.25 * x, 0.015);
  }
}

TEST(CarryAttributes, NormalPerFaceStaysNormalPerFace) {
  const Mesh mesh = built(torus(24, 18)).mesh;
  Array<glm::vec3> normals;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const auto p = [&](std::uint32_t c) {
      return mesh.position(mesh.origin(Halfedge(h / 3 * 3 + c)));
    };
    normals.push_back(glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0))));
  }
  Attributes attributes;
  set_normals(mesh, attributes, normals);
  const SimplifiedModel model = simplify_model(Mesh(mesh), attributes, {.target_faces = 300});
  expect_valid_model(model);
  const Mesh& result = model.simplified.mesh;
  ASSERT_LE(result.face_count(), 300U);
  const CornerAttributes carried = to_corners(result, model.attributes);
  for (std::uint32_t h = 0; h < result.halfedge_count(); ++h) {
    const auto p = [&](std::uint32_t c) {
      return result.position(result.origin(Halfedge(h / 3 * 3 + c)));
    };
    const glm::vec3 n = glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
    EXPECT_GT(glm::dot(n, carried.normal[h]), 0.9999F);
  }
}

TEST(CarryAttributes, CornersWithoutAValueStayWithoutOne) {
  Sheet sheet(4);
  for (glm::vec2& t : sheet.corners.texcoord)
    t = glm::vec2(std::numeric_limits<float>::quiet_NaN());
  sheet.corners.texcoord[0] = {0.5F, 0.5F};
  const SimplifiedModel model = sheet.simplified(30);
  expect_valid_model(model);
  std::size_t absent = 0;
  for (const glm::vec2& t : to_corners(model.simplified.mesh, model.attributes).texcoord)
    absent += std::isnan(t.x) ? 1 : 0;
  EXPECT_GE(absent, 80U);
}

TEST(CarryAttributes, NoCollapseKeepsAllAttributes) {
  Sheet sheet(4);
  sheet.corners.texcoord[0] = {7.0F, 7.0F};
  const SimplifiedModel model = sheet.simplified(1'000);
  const CornerAttributes carried = to_corners(model.simplified.mesh, model.attributes);
  EXPECT_EQ(carried.texcoord, sheet.corners.texcoord);
  EXPECT_EQ(carried.normal, sheet.corners.normal);
  EXPECT_EQ(carried.group, sheet.corners.group);
}

TEST(CarryAttributes, EmptyAttributesStayEmpty) {
  const Mesh mesh = built(grid(6)).mesh;
  EXPECT_TRUE(simplify_model(Mesh(mesh), {}, {.target_faces = 20}).attributes.is_empty());
}

TEST(CarryAttributes, DoesNotDependOnThreads) {
  const Tube tube(40);
  Array<std::byte> bytes[2];
  for (const unsigned threads : {1U, 2U}) {
    const ThreadLimit limit(threads);
    bytes[threads - 1] = simplify_model(Mesh(tube.mesh), tube.attributes, {.target_faces = 200})
                             .attributes.layers[0]
                             .bytes();
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(CarryAttributes, CanceledWorkThrows) {
  const Tube tube(12);
  Progress progress;
  progress.cancel();
  std::vector<Face> faces;
  for (std::uint32_t f = 0; f < tube.mesh.face_count(); ++f)
    faces.emplace_back(f);
  EXPECT_THROW(
      (void)simplify::carry_attributes({tube.mesh, tube.attributes}, tube.mesh, faces, &progress),
      Cancelled);
}

TEST(SimplifyModel, CrossesSeamsOnlyIfTheTargetNeedsIt) {
  Sheet sheet;
  for (std::uint32_t h = 0; h < sheet.mesh.halfedge_count(); ++h)
    sheet.corners.texcoord[h].x = float(h / 3);  // each face is a chart of its own
  const SimplifiedModel model = sheet.simplified(100);
  expect_valid_model(model);
  EXPECT_TRUE(model.crosses_seams);
  EXPECT_LE(model.simplified.mesh.face_count(), 100U);
  EXPECT_NE(model.attributes.find("TEXCOORD_0"), nullptr);
  EXPECT_FALSE(Sheet().simplified(2).crosses_seams);
}

TEST(MarkSeams, SoftNormalsAreNoLines) {
  const Mesh plain = built(cube()).mesh;
  for (const auto& [degrees, is_marked] : {std::pair{20.0F, false}, {40.0F, true}}) {
    Array<glm::vec3> normals(plain.halfedge_count(), glm::vec3(0, 0, 1));
    const float angle = degrees * 3.14159265F / 180.0F;
    for (std::size_t h = 0; h < 6; ++h)
      normals[h] = {0, std::sin(angle), std::cos(angle)};
    Attributes attributes;
    set_normals(plain, attributes, normals);
    Mesh mesh(plain);
    simplify::mark_seams(mesh, attributes);
    const auto marked = std::ranges::count(mesh.sharpnesses(), simplify::kSeamSharpness);
    EXPECT_EQ(marked > 0, is_marked) << degrees;
    simplify::unmark_seams(mesh);
    EXPECT_TRUE(std::ranges::equal(mesh.sharpnesses(), plain.sharpnesses()));
  }
}

TEST(MarkSeams, CreasesStayWhatTheyAre) {
  Sheet sheet;
  for (std::uint32_t h = 0; h < sheet.mesh.halfedge_count() / 2; ++h)
    sheet.corners.texcoord[h].x += 10.0F;
  const Attributes attributes = to_wedges(sheet.mesh, std::move(sheet.corners));
  Mesh plain = sheet.mesh;
  simplify::mark_seams(plain, attributes);
  const auto seam = std::ranges::find(plain.sharpnesses(), simplify::kSeamSharpness);
  ASSERT_NE(seam, plain.sharpnesses().end());
  const Halfedge h(static_cast<std::uint32_t>(seam - plain.sharpnesses().begin()));
  Mesh mesh = sheet.mesh;
  mesh.set_sharpness(mesh.edge(h), 2.0F);
  simplify::mark_seams(mesh, attributes);
  EXPECT_EQ(mesh.sharpness(h), 2.0F);
}

}  // namespace
}  // namespace mesher::test
