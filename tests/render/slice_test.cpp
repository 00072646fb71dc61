// Tests that a scene drawn in slices is the scene drawn at once.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/gpu/device_image.h"
#include "engine/render/renderer.h"
#include "tests/render/looks.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

class SliceTest : public test::GpuTest {
 protected:
  static constexpr VkExtent2D kExtent{160, 120};

  /// Draws in slices that end at these shares of the work.
  Image draw(Mesh& mesh, const Settings& settings, unsigned samples,
             const std::vector<double>& ends) {
    GpuMesh mirror(device());
    mirror.apply(mesh, settings);
    mirror.invalidate();
    Renderer renderer(device());
    const SceneTarget target(device(), kExtent, samples);
    Camera camera;
    camera.set_angles(0.5, 0.4);
    camera.frame(bounding_box(mesh), double(kExtent.width) / kExtent.height);
    const std::uint64_t work = Renderer::work(mirror, settings);
    std::uint64_t begin = 0;
    for (const double share : ends) {
      const auto end = static_cast<std::uint64_t>(share * double(work));
      if (end <= begin) continue;
      device().run_once([&](VkCommandBuffer commands) {
        renderer.draw_slice(commands, target, mirror, camera, settings, {begin, end});
      });
      begin = end;
    }
    return gpu::read_image(device(), target.color(), gpu::kTransferSource);
  }
};

TEST_F(SliceTest, SlicesGiveTheSameBytes) {
  std::mt19937 random(1);
  const auto share = [&] { return std::uniform_real_distribution<>(0.0, 1.0)(random); };
  // Without a surface, meshes beyond 50,000 faces are drawn by faces.
  Mesh mesh = build_mesh(test::torus(200, 140)).mesh;
  mesh.set_sharpness(mesh.edge(Halfedge(30)), 2.0F);
  const Settings alone{.shading = Shading::none, .wireframe = true};
  for (const Settings& settings : {kFlat, kGouraud, kFlatWire, kGouraudWire, alone}) {
    for (const unsigned samples : {1U, 4U}) {
      const Image whole = draw(mesh, settings, samples, {1.0});
      for (int i = 0; i < 4; ++i) {
        std::vector<double> ends{share(), share(), share(), share(), 1.0};
        std::ranges::sort(ends);
        EXPECT_EQ(draw(mesh, settings, samples, ends).rgba, whole.rgba)
            << key(settings.shading) << " with " << samples << " samples";
      }
    }
  }
}

TEST_F(SliceTest, EmptyMeshHasOneSlice) {
  Mesh none;
  const Image image = draw(none, kFlat, 4, {1.0});
  for (std::size_t i = 4; i < image.rgba.size(); i += 4)
    ASSERT_EQ(image.rgba[i], image.rgba[0]);
}

}  // namespace
}  // namespace mesher::render
