// Compares images of small models in every mode with approved images (tests/golden).

#include <array>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "engine/render/offscreen.h"
#include "tests/render/looks.h"
#include "tests/support/assets.h"
#include "tests/support/golden.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

constexpr std::uint32_t kGoldenSize = 320;

struct Scene {
  std::string name;
  std::string model;
  Settings settings;
  double yaw_deg = 30.0;
  double pitch_deg = 25.0;
  bool orthographic = false;
  /// Edges of a selection, given by their ends. The last one is drawn as the edge under the cursor.
  std::vector<std::array<std::uint32_t, 2>> marked;
};

void PrintTo(const Scene& scene, std::ostream* out) {
  *out << scene.name;
}

const Settings kWire{.shading = Shading::none, .wireframe = true};
const Settings kGouraudSplit{.shading = Shading::gouraud, .crease_angle_deg = 40.0F};
const Settings kGouraudSplitWire{
    .shading = Shading::gouraud, .wireframe = true, .crease_angle_deg = 40.0F};

Settings dark(Settings settings) {
  settings.background = Background::dark;
  return settings;
}

/// Settings of the crease editor without the wireframe.
Settings line_edges(Settings settings) {
  settings.wireframe = false;
  settings.line_edges = true;
  return settings;
}

Settings one_sample(Settings settings) {
  settings.samples = 1;
  return settings;
}

std::vector<Scene> scenes() {
  return {
      {"cube_flat", "cube", kFlat},
      {"cube_gouraud", "cube", kGouraud},
      {"cube_wireframe", "cube", kWire},
      {"cube_wireframe_dark", "cube", dark(kWire)},
      {"cube_flat_wireframe", "cube", kFlatWire},
      {"cube_gouraud_wireframe", "cube", kGouraudWire},
      {"cube_gouraud_split", "cube", kGouraudSplit},
      {"cube_flat_front", "cube", kFlatWire, 0.0, 0.0},
      {"cube_flat_orthographic", "cube", kFlatWire, 45.0, 35.26438968, true},
      {"open_box_flat", "open_box", kFlat, 30.0, 40.0},
      {"open_box_gouraud", "open_box", kGouraud, 30.0, 40.0},
      {"open_box_wireframe", "open_box", kWire, 30.0, 40.0},
      {"open_box_flat_wireframe", "open_box", kFlatWire, 30.0, 40.0},
      {"open_box_gouraud_wireframe", "open_box", kGouraudWire, 30.0, 40.0},
      {"open_box_flat_wireframe_dark", "open_box", dark(kFlatWire), 30.0, 40.0},
      {"open_box_from_below", "open_box", kFlatWire, 30.0, -40.0},
      {"creased_cube_flat_wireframe", "creased_cube", kFlatWire},
      {"creased_cube_gouraud", "creased_cube", kGouraud},
      {"creased_cube_wireframe", "creased_cube", kWire},
      {"creased_cube_gouraud_wireframe", "creased_cube", kGouraudWire},
      {"semi_sharp_cube_flat_wireframe", "semi_sharp_cube", kFlatWire},
      {"semi_sharp_cube_wireframe", "semi_sharp_cube", kWire},
      {"semi_sharp_cube_wireframe_dark", "semi_sharp_cube", dark(kWire)},
      {"semi_sharp_cube_line_edges", "semi_sharp_cube", line_edges(kFlat)},
      {"selection_line_edges",
       "semi_sharp_cube",
       line_edges(kFlat),
       30.0,
       25.0,
       false,
       {{4, 6}, {6, 7}, {5, 6}, {4, 7}}},
      {"selection_flat_wireframe",
       "semi_sharp_cube",
       kFlatWire,
       30.0,
       25.0,
       false,
       {{4, 6}, {6, 7}, {5, 6}, {4, 7}}},
      {"selection_wireframe_dark",
       "semi_sharp_cube",
       dark(kWire),
       30.0,
       25.0,
       false,
       {{4, 6}, {6, 7}, {5, 6}, {4, 7}}},
      {"selection_open_box",
       "open_box",
       line_edges(kFlat),
       30.0,
       40.0,
       false,
       {{2, 3}, {3, 7}, {1, 5}, {6, 7}}},
      {"hypersheet_gouraud_wireframe", "hypersheet", kGouraudWire},
      {"dense_torus_wireframe", "dense_torus", kWire},
      {"dense_torus_flat_wireframe", "dense_torus", kFlatWire},
      {"bunny_flat", "bunny", kFlat, 0.0, 10.0},
      {"bunny_flat_one_sample", "bunny", one_sample(kFlat), 0.0, 10.0},
      {"bunny_gouraud", "bunny", kGouraud, 0.0, 10.0},
      {"bunny_gouraud_dark", "bunny", dark(kGouraud), 0.0, 10.0},
      {"bunny_gouraud_split_wireframe", "bunny", kGouraudSplitWire, 40.0, 10.0},
      {"bunny_wireframe", "bunny", kWire, 0.0, 10.0},
      {"bunny_wireframe_dark", "bunny", dark(kWire), 0.0, 10.0},
      {"bunny_flat_wireframe", "bunny", kFlatWire, 0.0, 10.0},
      {"bunny_gouraud_wireframe", "bunny", kGouraudWire, 0.0, 10.0},
      {"bunny_from_below", "bunny", kFlatWire, 20.0, -60.0},
      {"bunny_top_orthographic", "bunny", kFlat, 0.0, 90.0, true},
  };
}

/// A cube with an edge of each kind in view.
Mesh semi_sharp_cube() {
  Mesh mesh = build_mesh(test::cube()).mesh;
  const auto tag = [&](std::uint32_t a, std::uint32_t b, float sharpness) {
    mesh.set_sharpness(mesh.find_edge(Vertex(a), Vertex(b)), sharpness);
  };
  tag(6, 7, kInfinitelySharp);
  tag(5, 6, 4.0F);
  tag(4, 5, 2.0F);
  tag(4, 7, 1.0F);
  tag(2, 6, 0.5F);
  tag(2, 3, kInfinitelySharp);
  return mesh;
}

/// Returns a model of assets/, or one that is built here. One of the latter has too many edges to
/// be drawn one by one.
Mesh load(const std::string& model) {
  if (model == "semi_sharp_cube") return semi_sharp_cube();
  if (model == "dense_torus") return build_mesh(test::torus(400, 150)).mesh;
  return test::asset(model + ".obj");
}

MarkedEdges marked_edges(const Mesh& mesh, const Scene& scene) {
  MarkedEdges marked;
  for (const auto [a, b] : scene.marked)
    marked.selected.push_back(mesh.find_edge(Vertex(a), Vertex(b)));
  if (marked.selected.empty()) return marked;
  marked.hovered = marked.selected.back();
  marked.selected.pop_back();
  return marked;
}

Image draw(gpu::Device& device, const Scene& scene) {
  Mesh mesh = load(scene.model);
  Camera camera;
  camera.set_angles(glm::radians(scene.yaw_deg), glm::radians(scene.pitch_deg));
  camera.set_orthographic(scene.orthographic);
  camera.frame(bounding_box(mesh), 1.0);
  GpuMesh mirror(device);
  mirror.apply(mesh, scene.settings);
  mirror.mark(marked_edges(mesh, scene));
  Renderer renderer(device);
  return render_image(device, renderer, mirror, camera, scene.settings, kGoldenSize, kGoldenSize);
}

class Golden : public test::GpuTest, public ::testing::WithParamInterface<Scene> {};

TEST_P(Golden, MatchesTheApprovedImage) {
  const Scene& scene = GetParam();
  test::expect_golden(device(), scene.name, draw(device(), scene));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, ::testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param.name; });

TEST(GoldenComparison, DetectsOneBitAndCountsPixels) {
  Image a;
  a.width = 2;
  a.height = 1;
  a.rgba.assign(8, 100);
  Image b = a;
  EXPECT_EQ(test::difference_of(a, b).pixels, 0U);
  b.rgba[5] = 101;
  EXPECT_EQ(test::difference_of(a, b).pixels, 1U);
  EXPECT_EQ(test::difference_of(a, b).share_visible, 0.0);
  EXPECT_EQ(test::difference_of(a, b).largest, 1);
  EXPECT_FALSE(test::agrees(test::difference_of(a, b), test::Agreement::exact));
  EXPECT_FALSE(test::agrees(test::difference_of(a, b),
                            test::Agreement::same_driver));  // two pixels: 0.125 on average
  EXPECT_TRUE(test::agrees(test::difference_of(a, b), test::Agreement::other_driver));
  b.rgba[5] = 180;
  EXPECT_DOUBLE_EQ(test::difference_of(a, b).mean, 10.0);
  EXPECT_DOUBLE_EQ(test::difference_of(a, b).share_visible, 0.5);
}

}  // namespace
}  // namespace mesher::render
