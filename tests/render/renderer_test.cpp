#include "engine/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/error.h"
#include "engine/render/offscreen.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

using RendererTest = test::GpuTest;

constexpr std::uint32_t kSize = 128;

Camera framed(const Mesh& mesh, double yaw_rad = 0.5, double pitch_rad = 0.4) {
  Camera camera;
  camera.set_angles(yaw_rad, pitch_rad);
  camera.frame(bounding_box(mesh), 1.0);
  return camera;
}

Image draw(gpu::Device& device, Mesh& mesh, const Camera& camera, const Settings& settings) {
  return render_image(device, mesh, camera, settings, kSize, kSize);
}

template <class Predicate>
std::size_t count_pixels(const Image& image, Predicate&& predicate) {
  std::size_t count = 0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      count += predicate(int{p[0]}, int{p[1]}, int{p[2]}) ? 1 : 0;
    }
  }
  return count;
}

bool is_red(int r, int g, int b) {
  return r > 170 && g < 90 && b < 90;
}
bool is_yellow(int r, int g, int b) {
  return r > 200 && g > 150 && b < 100;
}
bool is_blue(int r, int g, int b) {
  return b > r + 40 && b > 60 && g < b;
}

/// An open box: the cube without its top.
Mesh open_box() {
  Soup soup = test::cube();
  soup.corners.resize(30);
  return build_mesh(std::move(soup)).mesh;
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
  return sum / static_cast<double>(a.rgba.size());
}

double mean(const Image& image) {
  double sum = 0.0;
  for (const std::uint8_t value : image.rgba)
    sum += value;
  return sum / static_cast<double>(image.rgba.size());
}

TEST_F(RendererTest, BackgroundHasTheRequestedColor) {
  Mesh empty;
  for (const Background background : {Background::light, Background::dark}) {
    const Image image = draw(device(), empty, Camera(), {.background = background});
    const Color color = background_color(background);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(image.pixel(5, 7)[i], 255.0F * color[i], 1.0F);
    }
    EXPECT_EQ(image.pixel(5, 7)[3], 255);
    EXPECT_EQ(count_pixels(image,
                           [&](int r, int g, int b) {
                             const std::uint8_t* p = image.pixel(0, 0);
                             return r == p[0] && g == p[1] && b == p[2];
                           }),
              std::size_t{kSize} * kSize);
  }
}

TEST_F(RendererTest, ImageIsReproducibleAndIndependentOfTheTarget) {
  Mesh mesh = build_mesh(test::torus(40, 30)).mesh;
  const Settings settings{.shading = Shading::gouraud, .wireframe = true};
  const Camera camera = framed(mesh);
  const Image first = draw(device(), mesh, camera, settings);
  EXPECT_EQ(draw(device(), mesh, camera, settings).rgba, first.rgba);

  // Copy to an image in the format of the swapchain, ready for an overlay, as the window does.
  GpuMesh mirror(device());
  mirror.apply(mesh, settings);
  Renderer renderer(device());
  const SceneTarget target(device(), {kSize, kSize}, 4, VK_FORMAT_B8G8R8A8_UNORM);
  const gpu::DeviceImage window(
      device(), {.format = VK_FORMAT_B8G8R8A8_UNORM,
                 .extent = {kSize, kSize},
                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                          VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  for (int frame = 0; frame < 2; ++frame) {
    device().run_once([&](VkCommandBuffer commands) {
      renderer.draw(commands, target, mirror, camera, settings);
      target.copy_to(commands, window.handle());
    });
    EXPECT_EQ(gpu::read_image(device(), window, gpu::kColorAttachment).rgba, first.rgba);
  }
  // The scene is unchanged, so an overlay can change without drawing it again.
  device().run_once([&](VkCommandBuffer commands) { target.copy_to(commands, window.handle()); });
  EXPECT_EQ(gpu::read_image(device(), window, gpu::kColorAttachment).rgba, first.rgba);
}

TEST_F(RendererTest, BoundariesAreThickRedAndOnlyInWireframe) {
  Mesh mesh = open_box();
  const Camera camera = framed(mesh, -0.8);  // looks into the opening
  const Settings plain{.shading = Shading::flat};
  EXPECT_EQ(count_pixels(draw(device(), mesh, camera, plain), is_red), 0U);
  for (const Shading shading : {Shading::none, Shading::flat, Shading::gouraud}) {
    const Image image = draw(device(), mesh, camera, {.shading = shading, .wireframe = true});
    // Four edges of about 70 pixels, at least two pixels wide.
    EXPECT_GT(count_pixels(image, is_red), 4U * 2 * 60) << static_cast<int>(shading);
  }
}

TEST_F(RendererTest, SurfaceHidesTheBoundaryBehindIt) {
  Mesh mesh = open_box();
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const auto& [yaw, pitch] :
       {std::pair{0.0, 0.0}, std::pair{1.5707963, 0.0}, std::pair{-1.5707963, 0.0},
        std::pair{3.1415926, 0.0}, std::pair{0.0, 1.5707963}, std::pair{0.0, -1.5707963}}) {
    const Image image = draw(device(), mesh, framed(mesh, yaw, pitch),
                             {.shading = Shading::flat, .wireframe = true});
    least = std::min(least, count_pixels(image, is_red));
  }
  EXPECT_EQ(least, 0U) << "seen from below, the boundary of the opening is visible";
}

TEST_F(RendererTest, CreasesAreYellow) {
  Mesh mesh = build_mesh(test::cube()).mesh;
  const Settings settings{.shading = Shading::flat, .wireframe = true};
  EXPECT_EQ(count_pixels(draw(device(), mesh, framed(mesh), settings), is_yellow), 0U);
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    mesh.set_sharpness(mesh.edge(Halfedge(i)), 2.0F);
  }
  // Nine of its edges are visible, about 60 pixels each. The number of fully yellow pixels depends
  // on the driver: 303 with llvmpipe, 300 with an NVIDIA GPU.
  EXPECT_GT(count_pixels(draw(device(), mesh, framed(mesh), settings), is_yellow), 9U * 30);
}

TEST_F(RendererTest, BackFacesAreBlueAndHiddenOnClosedSurfaces) {
  Mesh outside = build_mesh(test::torus(30, 20)).mesh;
  for (const Shading shading : {Shading::flat, Shading::gouraud}) {
    const Image image = draw(device(), outside, framed(outside), {.shading = shading});
    // Faces seen edge-on have no reliable depth, so one pixel of an outline may be wrong.
    EXPECT_LE(count_pixels(image, is_blue), 2U);
  }
  Soup soup = test::torus(30, 20);
  for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
    std::swap(soup.corners[i], soup.corners[i + 1]);
  }
  Mesh inside_out = build_mesh(std::move(soup)).mesh;
  for (const Shading shading : {Shading::flat, Shading::gouraud}) {
    const Image image = draw(device(), inside_out, framed(inside_out), {.shading = shading});
    EXPECT_GT(count_pixels(image, is_blue), 3000U);
  }
}

TEST_F(RendererTest, LooksTheSameAtAnyScaleAndPosition) {
  const Settings settings{.shading = Shading::flat, .wireframe = true};
  Mesh unit = build_mesh(test::torus(20, 12)).mesh;
  const Image expected = draw(device(), unit, framed(unit), settings);
  struct Case {
    float scale;
    float offset;
  };
  for (const Case c : {Case{1.0F / 1048576.0F, 0.0F}, Case{1048576.0F, 0.0F}, Case{1.0F, 8192.0F},
                       Case{1024.0F, 1e7F}}) {
    Soup soup = test::torus(20, 12);
    for (glm::vec3& p : soup.positions)
      p = c.scale * p + c.offset;
    Mesh mesh = build_mesh(std::move(soup)).mesh;
    const Image image = draw(device(), mesh, framed(mesh), settings);
    EXPECT_LT(mean_difference(image, expected), 1.0) << c.scale << " at " << c.offset;
  }
}

TEST_F(RendererTest, WireframeOnlyShowsTheBackgroundBetweenLines) {
  Mesh mesh = build_mesh(test::cube()).mesh;
  for (const Background background : {Background::light, Background::dark}) {
    const Image image =
        draw(device(), mesh, framed(mesh),
             {.shading = Shading::none, .wireframe = true, .background = background});
    const std::uint8_t* empty = image.pixel(0, 0);
    const std::size_t free = count_pixels(image, [&](int r, int g, int b) {
      return r == empty[0] && g == empty[1] && b == empty[2];
    });
    EXPECT_GT(free, std::size_t{kSize} * kSize * 7 / 10);
    EXPECT_LT(free, std::size_t{kSize} * kSize * 97 / 100);
  }
}

TEST_F(RendererTest, EdgesDrawnWithFacesAndAsQuadsLookAlike) {
  // The same torus below and above the face count from which edges are drawn with their faces.
  const Settings settings{.shading = Shading::none, .wireframe = true};
  Mesh few = build_mesh(test::torus(200, 120)).mesh;
  Mesh many = build_mesh(test::torus(260, 120)).mesh;
  ASSERT_LE(few.face_count(), 50'000U);
  ASSERT_GT(many.face_count(), 50'000U);
  const Image a = draw(device(), few, framed(few), settings);
  const Image b = draw(device(), many, framed(many), settings);
  EXPECT_NEAR(mean(a), mean(b), 6.0);
  EXPECT_LT(mean(a), 246.0) << "lines are drawn";
  EXPECT_LT(mean(b), 246.0) << "lines are drawn";
}

TEST_F(RendererTest, EdgesBehindTheEyeDrawNoArtifacts) {
  Mesh mesh = open_box();
  for (const double zoom : {5.0, 50.0, 5000.0}) {
    Camera camera = framed(mesh);
    camera.zoom(zoom);
    const Image image = draw(device(), mesh, camera, {.shading = Shading::flat, .wireframe = true});
    // Only the walls of the box are visible, and edges behind the eye are not smeared over them in
    // red.
    EXPECT_LT(count_pixels(image, is_red), std::size_t{kSize} * kSize / 4) << zoom;
  }
}

TEST_F(RendererTest, EverySettingDrawsEveryMesh) {
  Mesh closed = build_mesh(test::cube()).mesh;
  Mesh open = open_box();
  open.set_sharpness(open.edge(Halfedge(0)), 1.0F);
  Mesh empty;
  for (Mesh* mesh : {&closed, &open, &empty}) {
    GpuMesh mirror(device());
    Renderer renderer(device());
    for (const Shading shading : {Shading::none, Shading::flat, Shading::gouraud}) {
      for (const bool wireframe : {false, true}) {
        for (const float angle : {180.0F, 20.0F}) {
          for (const unsigned samples : {1U, 4U}) {
            const Settings settings{.shading = shading,
                                    .wireframe = wireframe,
                                    .crease_angle_deg = angle,
                                    .samples = samples};
            mirror.apply(*mesh, settings);
            const Image image =
                render_image(device(), renderer, mirror, framed(*mesh), settings, 40, 30);
            EXPECT_EQ(image.rgba.size(), 4U * 40 * 30);
          }
        }
      }
    }
  }
}

TEST_F(RendererTest, RejectsImpossibleSizes) {
  Mesh mesh = build_mesh(test::cube()).mesh;
  EXPECT_THROW(render_image(device(), mesh, Camera(), {}, 0, 10), DeviceError);
  EXPECT_THROW(render_image(device(), mesh, Camera(), {}, 10, 1U << 20), DeviceError);
  EXPECT_NO_THROW(render_image(device(), mesh, Camera(), {}, 1, 1));
}

}  // namespace
}  // namespace mesher::render
