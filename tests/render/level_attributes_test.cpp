// Compares images of levels with attributes, and during their geomorphs, with images of meshes that
// have the same values and stand still.
#include <algorithm>
#include <cstdlib>
#include <random>

#include "engine/mesh/wedges.h"
#include "engine/progressive/attribute_morph.h"
#include "engine/progressive/build.h"
#include "engine/progressive/geomorph.h"
#include "engine/render/offscreen.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

using LevelAttributesTest = test::GpuTest;

constexpr std::uint32_t kLevelSize = 256;
constexpr std::uint32_t kBaseOfLevels = 120;

Settings looking(Look look, const GeomorphTime& time = GeomorphTime::done()) {
  return {.look = look, .geomorph = time};
}

/// A torus with three charts of texture coordinates, with colors and with normals.
Attributes painted(const Mesh& mesh) {
  AttributeLayer uv(texcoord_type(), mesh.halfedge_count());
  AttributeLayer normal(normal_type(), mesh.halfedge_count());
  AttributeLayer color({.kind = AttributeKind::color, .name = "COLOR_0", .components = 3},
                       mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const glm::vec3& p = mesh.position(mesh.origin(Halfedge(h)));
    const auto chart = static_cast<float>(h / (mesh.face_count() + 1));
    uv.values<glm::vec2>()[h] = {0.3F * p.x + 0.1F * p.z + chart, 0.3F * p.y};
    normal.values<glm::vec3>()[h] =
        glm::normalize(p - 2.0F * glm::normalize(glm::vec3(p.x, p.y, 0)));
    color.values<glm::vec3>()[h] = 0.5F + 0.15F * p;
  }
  Attributes attributes;
  std::vector<AttributeLayer> layers;
  layers.push_back(std::move(uv));
  layers.push_back(std::move(normal));
  layers.push_back(std::move(color));
  set_corner_layers(mesh, attributes, std::move(layers));
  return attributes;
}

/// A progressive mesh with attributes, and all that is needed to draw it.
struct PaintedLevels {
  progressive::Progressive made;
  progressive::Geomorph geomorph;
  progressive::AttributeMorph morph;
  Camera camera;

  explicit PaintedLevels(const Mesh& full)
      : made(progressive::make_progressive(full, painted(full), {.target_faces = kBaseOfLevels})),
        geomorph(made.mesh),
        morph(made.attributes) {
    camera.set_angles(0.5, 0.4);
    camera.frame(bounding_box(full), 1.0);
    go_to(count());
  }
  std::uint32_t count() const { return made.mesh.split_count(); }
  Mesh& mesh() { return made.mesh.mesh(); }
  void go_to(std::uint32_t level) {
    made.mesh.go_to(level);
    geomorph.follow(made.mesh);
    made.attributes.go_to(level);
    morph.follow(made.attributes);
  }
  Sources sources() {
    Sources sources{.vertex_normals = geomorph.normals(),
                    .morph = {.heads = geomorph.heads(), .splits = geomorph.splits()}};
    sources.appearance.attributes = &made.attributes.arrays();
    sources.appearance.changes = &made.attributes.changes();
    sources.appearance.morph = morph.view();
    return sources;
  }
  Image draw(GpuMesh& mirror, const Settings& settings) {
    last = mirror.apply(mesh(), settings, sources());
    return render_image(mirror.device(), renderer(mirror.device()), mirror, camera, settings,
                        kLevelSize, kLevelSize);
  }
  Renderer& renderer(gpu::Device& device) {
    if (!renderer_) renderer_.emplace(device);
    return *renderer_;
  }
  UploadStats last;

 private:
  std::optional<Renderer> renderer_;
};

std::size_t pixels_off(const Image& a, const Image& b, int allowed) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int most = 0;
    for (std::size_t k = i; k < i + 4; ++k)
      most = std::max(most, std::abs(int{a.rgba[k]} - int{b.rgba[k]}));
    count += most > allowed ? 1 : 0;
  }
  return count;
}

/// Draws a level that stands still with the positions and values of the C++ formulas.
Image draw_by_formula(PaintedLevels& levels, gpu::Device& device, Look look,
                      const GeomorphTime& time) {
  Mesh still = levels.mesh();
  for (std::uint32_t v = 0; v < still.vertex_count(); ++v) {
    still.set_position(Vertex(v),
                       morphed_position(still.position(Vertex(v)), levels.geomorph.heads()[v],
                                        levels.geomorph.splits(), time));
  }
  Attributes values = levels.made.attributes.arrays();
  const std::uint32_t wedges = levels.made.attributes.wedge_count(levels.made.attributes.level());
  for (std::size_t k = 0; k < values.layers.size(); ++k) {
    AttributeLayer& layer = values.layers[k];
    for (std::uint32_t w = 0; w < wedges; ++w) {
      store(layer, w, morphed_value(layer, levels.morph.view(), k, Wedge(w), time));
    }
  }
  GpuMesh mirror(device);
  Sources sources;
  sources.appearance.attributes = &values;
  mirror.apply(still, looking(look), sources);
  return render_image(device, levels.renderer(device), mirror, levels.camera, looking(look),
                      kLevelSize, kLevelSize);
}

constexpr Look kMovingLooks[] = {Look::base_color, Look::normals, Look::uv_checker};

TEST_F(LevelAttributesTest, ShadersAgreeWithTheCppFormula) {
  PaintedLevels levels(build_mesh(test::torus(40, 24)).mesh);
  GpuMesh mirror(device());
  const double count = levels.count();
  for (const GeomorphTime& time :
       {GeomorphTime::between(levels.count() / 4, 0.3F), GeomorphTime::between(0, 0.71F),
        GeomorphTime::continuous(0.6 * count, 0.25 * count), GeomorphTime::continuous(0.0, 1.0)}) {
    for (const Look look : kMovingLooks) {
      const Image image = levels.draw(mirror, looking(look, time));
      const Image expected = draw_by_formula(levels, device(), look, time);
      // The checker has sharp edges, where a rounding error shows. In a thin face, one of the
      // position turns the normal by up to 3 of 255.
      EXPECT_LE(pixels_off(image, expected, 3), look == Look::uv_checker ? 60U : 8U)
          << static_cast<int>(look);
      EXPECT_GT(pixels_off(image, levels.draw(mirror, looking(look)), 2), 300U)
          << static_cast<int>(look);
    }
  }
}

TEST_F(LevelAttributesTest, StartOfTheRangeMatchesTheCoarseLevel) {
  PaintedLevels levels(build_mesh(test::torus(40, 24)).mesh);
  GpuMesh mirror(device());
  for (const std::uint32_t coarse : {0U, levels.count() / 3, levels.count() - 1}) {
    for (const Look look : kMovingLooks) {
      levels.go_to(coarse);
      const Image expected = levels.draw(mirror, looking(look));
      levels.go_to(levels.count());
      const Image image = levels.draw(mirror, looking(look, GeomorphTime::between(coarse, 0.0F)));
      EXPECT_LE(pixels_off(image, expected, 2), look == Look::uv_checker ? 60U : 12U)
          << coarse << " " << static_cast<int>(look);
    }
  }
}

TEST_F(LevelAttributesTest, AnySequenceOfLevelsEqualsAFreshMirror) {
  PaintedLevels levels(build_mesh(test::torus(60, 40)).mesh);
  GpuMesh mirror(device());
  std::mt19937 random(5);
  for (int round = 0; round < 16; ++round) {
    const bool is_far = random() % 3 == 0;
    const int step = is_far ? 100'000 : 9;
    const int to = static_cast<int>(levels.made.mesh.level()) - step +
                   static_cast<int>(random() % (2 * step + 1));
    levels.go_to(std::clamp(to, 0, static_cast<int>(levels.count())));
    if (random() % 4 == 0) continue;  // apply several level changes at once
    const Settings settings =
        looking(kMovingLooks[round % 3], GeomorphTime::between(levels.made.mesh.level() / 2, 0.5F));
    const Image image = levels.draw(mirror, settings);
    GpuMesh fresh(device());
    EXPECT_EQ(pixels_off(image, levels.draw(fresh, settings), 0), 0U) << round;
  }
}

TEST_F(LevelAttributesTest, LevelChangesUploadInProportionToTheirDistance) {
  PaintedLevels levels(build_mesh(test::torus(150, 100)).mesh);
  GpuMesh mirror(device());
  const std::uint32_t middle = levels.count() / 2;
  levels.go_to(middle);
  levels.draw(mirror, looking(Look::base_color));
  for (const std::uint32_t steps : {1U, 10U, 100U}) {
    for (const std::uint32_t level : {middle + steps, middle, middle - steps, middle}) {
      levels.go_to(level);
      levels.draw(mirror, looking(Look::base_color));
      EXPECT_LE(levels.last.uploaded_bytes, 2000U * steps) << level;
    }
  }
}

}  // namespace
}  // namespace mesher::render
