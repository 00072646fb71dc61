// Compares images of subdivision with approved images (tests/golden). Each sheet has several small
// images. All of them use the camera that frames the model before subdivision.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "engine/render/offscreen.h"
#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/models.h"
#include "tests/support/assets.h"
#include "tests/support/golden.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr std::uint32_t kTile = 160;

const render::Settings kSurface{.shading = render::Shading::gouraud};
const render::Settings kSurfaceAndEdges{.shading = render::Shading::gouraud, .wireframe = true};

struct View {
  double yaw_deg = 30.0;
  double pitch_deg = 25.0;
};

/// A cube whose twelve edges have the given sharpness; the diagonals of its sides are smooth.
Mesh cube_of_sharpness(float sharpness) {
  Mesh mesh = build_mesh(cube()).mesh;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    const float length =
        glm::distance(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)));
    if (length < 1.1F) {
      mesh.set_sharpness(mesh.find_edge(mesh.origin(h), mesh.target(h)), sharpness);
    }
  }
  return mesh;
}

/// Places small images in rows, from left to right and from top to bottom.
class Sheet {
 public:
  Sheet(std::uint32_t columns, std::uint32_t rows) : columns_(columns) {
    image_.width = columns * kTile;
    image_.height = rows * kTile;
    image_.rgba.assign(std::size_t{4} * image_.width * image_.height, 255);
  }

  void add(const Image& tile) {
    const std::uint32_t left = count_ % columns_ * kTile;
    const std::uint32_t top = count_ / columns_ * kTile;
    ASSERT_LE(top + kTile, image_.height);
    for (std::uint32_t y = 0; y < kTile; ++y) {
      std::copy_n(tile.pixel(0, y), std::size_t{4} * kTile,
                  image_.rgba.data() + 4 * (std::size_t{top + y} * image_.width + left));
    }
    ++count_;
  }

  const Image& image() const { return image_; }

 private:
  std::uint32_t columns_;
  std::uint32_t count_ = 0;
  Image image_;
};

class SubdivideGolden : public GpuTest {
 protected:
  /// Renders `mesh` subdivided by `options`. The limit surface is shaded with limit normals.
  Image tile(const Mesh& mesh, const subdivide::SubdivideOptions& options,
             const render::Settings& settings, const View& view = {}) {
    subdivide::Subdivided result = subdivide::subdivide(mesh, options);
    render::Camera camera;
    camera.set_angles(glm::radians(view.yaw_deg), glm::radians(view.pitch_deg));
    camera.frame(bounding_box(mesh), 1.0);
    render::GpuMesh mirror(device());
    mirror.apply(result.mesh, settings, {.corner_normals = result.limit_normal});
    render::Renderer renderer(device());
    return render::render_image(device(), renderer, mirror, camera, settings, kTile, kTile);
  }
};

/// Levels 0 to 4 and the limit. Top row: Hoppe's rules. Bottom row: DeRose's rules.
TEST_F(SubdivideGolden, CreasedCubeMatches) {
  const Mesh mesh = asset("creased_cube.obj");
  Sheet sheet(6, 2);
  for (const subdivide::CreaseRules creases :
       {subdivide::CreaseRules::hoppe94, subdivide::CreaseRules::derose98}) {
    for (std::uint32_t level = 0; level <= 4; ++level)
      sheet.add(tile(mesh, {.levels = level, .creases = creases}, kSurfaceAndEdges));
    sheet.add(tile(mesh, {.levels = 4, .creases = creases, .limit = true}, kSurfaceAndEdges));
  }
  expect_golden(device(), "subdivide_creased_cube", sheet.image());
}

/// The cube, then with edge sharpness 0, 0.5, 1, 1.5, 2, 3 and infinity.
TEST_F(SubdivideGolden, SharpnessMatches) {
  Sheet sheet(4, 2);
  sheet.add(tile(cube_of_sharpness(0.0F), {.levels = 0}, kSurfaceAndEdges));
  for (const float sharpness : {0.0F, 0.5F, 1.0F, 1.5F, 2.0F, 3.0F, kInfinitelySharp}) {
    sheet.add(tile(cube_of_sharpness(sharpness),
                   {.levels = 4, .creases = subdivide::CreaseRules::derose98}, kSurface));
  }
  expect_golden(device(), "subdivide_sharpness", sheet.image());
}

/// The model, then three levels each of Loop, butterfly and midpoint.
TEST_F(SubdivideGolden, SchemesMatch) {
  Sheet sheet(4, 2);
  const auto add_row = [&](const Mesh& mesh, const View& view) {
    sheet.add(tile(mesh, {.levels = 0}, kSurfaceAndEdges, view));
    for (const subdivide::Scheme scheme :
         {subdivide::Scheme::loop, subdivide::Scheme::butterfly, subdivide::Scheme::midpoint})
      sheet.add(tile(mesh, {.levels = 3, .scheme = scheme}, kSurfaceAndEdges, view));
  };
  add_row(build_mesh(octahedron()).mesh, {});
  add_row(asset("bunny_200.obj"), {.yaw_deg = 0.0, .pitch_deg = 10.0});
  expect_golden(device(), "subdivide_loop_butterfly", sheet.image());
}

/// The model, its boundary with edges only and with corners, and next to it a closed model. The box
/// has no vertex with one face; the sheet has two.
TEST_F(SubdivideGolden, BoundariesMatch) {
  constexpr View kFromAbove{.yaw_deg = 30.0, .pitch_deg = 40.0};
  Sheet sheet(4, 2);
  const auto add_three = [&](const Mesh& mesh, const View& view) {
    sheet.add(tile(mesh, {.levels = 0}, kSurfaceAndEdges, view));
    for (const auto boundary :
         {subdivide::BoundaryRounding::edge_only, subdivide::BoundaryRounding::edge_and_corner})
      sheet.add(tile(mesh, {.levels = 3, .boundary = boundary}, kSurfaceAndEdges, view));
  };
  add_three(asset("open_box.obj"), kFromAbove);
  sheet.add(tile(asset("cube.obj"), {.levels = 3}, kSurfaceAndEdges, kFromAbove));
  const Mesh flat = build_mesh(grid(2)).mesh;
  add_three(flat, {});
  sheet.add(tile(
      flat, {.levels = 3, .boundary = subdivide::BoundaryRounding::edge_and_corner, .limit = true},
      kSurfaceAndEdges));
  expect_golden(device(), "subdivide_open_box", sheet.image());
}

}  // namespace
}  // namespace mesher::test
