// Compares images during a geomorph with images of static meshes.
#include "engine/mesh/geomorph.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "engine/mesh/packed_normal.h"
#include "engine/progressive/build.h"
#include "engine/progressive/geomorph.h"
#include "engine/render/offscreen.h"
#include "tests/render/looks.h"
#include "tests/support/assets.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

using GeomorphTest = test::GpuTest;

constexpr std::uint32_t kMorphSize = 256;

const Settings kWireAlone{.shading = Shading::none, .wireframe = true};

Settings at(Settings settings, const GeomorphTime& time) {
  settings.geomorph = time;
  return settings;
}

/// A progressive mesh with everything that is needed to draw it.
struct Growing {
  progressive::ProgressiveMesh mesh;
  progressive::Geomorph geomorph;
  Camera camera;

  explicit Growing(const Mesh& full, std::uint32_t base_faces = 50)
      : mesh(progressive::make_progressive(full, {.target_faces = base_faces}).mesh),
        geomorph(mesh) {
    camera.set_angles(0.5, 0.4);
    camera.frame(bounding_box(full), 1.0);
    go_to(count());
  }
  std::uint32_t count() const { return mesh.split_count(); }
  void go_to(std::uint32_t level) {
    mesh.go_to(level);
    geomorph.follow(mesh);
  }
  Sources sources() const {
    return {.vertex_normals = geomorph.normals(),
            .morph = {.heads = geomorph.heads(), .splits = geomorph.splits()}};
  }
};

Mesh bunny() {
  return test::asset("bunny_1k.obj");
}
Mesh torus() {
  return build_mesh(test::torus(40, 24)).mesh;
}
/// A sheet with boundaries and creases, to test lines.
Mesh sheet() {
  Mesh mesh = build_mesh(test::grid(16)).mesh;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    glm::vec3 p = mesh.position(Vertex(v));
    p.z = 2.0F * std::sin(0.5F * p.x) * std::cos(0.4F * p.y);
    mesh.set_position(Vertex(v), p);
  }
  for (std::uint32_t x = 0; x < 16; ++x) {
    const Edge e = mesh.find_edge(Vertex(8 * 17 + x), Vertex(8 * 17 + x + 1));
    mesh.set_sharpness(e, kInfinitelySharp);
  }
  return mesh;
}

/// Draws one mesh repeatedly.
class Drawer {
 public:
  explicit Drawer(gpu::Device& device) : mirror_(device), renderer_(device) {}

  Image draw(Growing& growing, const Settings& settings) {
    return draw(growing.mesh.mesh(), growing.camera, settings, growing.sources());
  }
  Image draw(Mesh& mesh, const Camera& camera, const Settings& settings, const Sources& sources) {
    stats_ = mirror_.apply(mesh, settings, sources);
    return render_image(mirror_.device(), renderer_, mirror_, camera, settings, kMorphSize,
                        kMorphSize);
  }
  GpuMesh& mirror() { return mirror_; }
  const UploadStats& stats() const { return stats_; }

 private:
  GpuMesh mirror_;
  Renderer renderer_;
  UploadStats stats_;
};

/// Number of pixels with a component that differs by more than `allowed`.
std::size_t count_different(const Image& a, const Image& b, int allowed = 0) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int most = 0;
    for (std::size_t k = i; k < i + 4; ++k)
      most = std::max(most, std::abs(int{a.rgba[k]} - int{b.rgba[k]}));
    count += most > allowed ? 1 : 0;
  }
  return count;
}

/// The mesh with its vertices at the positions that the C++ formula gives.
Mesh standing_still(const Growing& growing, const GeomorphTime& time,
                    std::vector<std::uint32_t>& normals) {
  Mesh still = growing.mesh.mesh();
  const std::span splits = growing.geomorph.splits();
  normals.clear();
  for (std::uint32_t v = 0; v < still.vertex_count(); ++v) {
    const std::uint32_t head = growing.geomorph.heads()[v];
    still.set_position(Vertex(v), morphed_position(still.position(Vertex(v)), head, splits, time));
    const glm::vec3 n = morphed_normal(growing.geomorph.normals()[v], head, splits, time);
    normals.push_back(encode_normal(n));
  }
  return still;
}

TEST_F(GeomorphTest, StartOfTheRangeMatchesTheCoarseLevel) {
  for (const Mesh& full : {bunny(), torus(), sheet()}) {
    Growing growing(full);
    Drawer drawer(device());
    Drawer plain(device());
    for (const std::uint32_t coarse : {0U, growing.count() / 3, growing.count() - 1}) {
      for (const Settings& settings : {kFlat, kGouraud}) {
        growing.go_to(coarse);
        const Image expected = plain.draw(growing, settings);
        plain.mirror().invalidate();
        growing.go_to(growing.count());
        const Image image = drawer.draw(growing, at(settings, GeomorphTime::between(coarse, 0.0F)));
        // Faces that have not opened yet are slivers as wide as the rounding error of floats.
        EXPECT_LE(count_different(image, expected, 2), 12U) << coarse;
      }
    }
  }
}

TEST_F(GeomorphTest, EndOfTheRangeMatchesTheFineLevelExactly) {
  // Test both a time at which the formula gives full growth, drawn by the shaders that move
  // vertices, and the time `done`.
  const GeomorphTime grown{.first_growing = 0, .whole = 1'000'000, .rate = 1.0F, .fixed = 0.0F};
  for (const Mesh& full : {bunny(), sheet()}) {
    Growing growing(full);
    Drawer drawer(device());
    for (const Settings& settings : {kFlat, kGouraud, kFlatWire, kGouraudWire, kWireAlone}) {
      const Image expected = drawer.draw(growing, settings);
      ASSERT_TRUE(needs_geomorph(drawer.mirror(), at(settings, grown)));
      EXPECT_EQ(count_different(drawer.draw(growing, at(settings, grown)), expected), 0U);
      const Settings one = at(settings, GeomorphTime::between(3, 1.0F));
      EXPECT_FALSE(needs_geomorph(drawer.mirror(), one)) << "drawn without geomorph shaders";
      EXPECT_EQ(count_different(drawer.draw(growing, one), expected), 0U);
    }
  }
}

TEST_F(GeomorphTest, ShadersAgreeWithTheCppFormula) {
  for (const Mesh& full : {bunny(), torus(), sheet()}) {
    Growing growing(full);
    Drawer drawer(device());
    const double count = growing.count();
    for (const GeomorphTime& time :
         {GeomorphTime::between(growing.count() / 4, 0.3F), GeomorphTime::between(0, 0.71F),
          GeomorphTime::continuous(0.6 * count, 0.25 * count),
          GeomorphTime::continuous(0.9 * count, 7.0), GeomorphTime::continuous(0.0, 1.0)}) {
      std::vector<std::uint32_t> normals;
      Mesh still = standing_still(growing, time, normals);
      for (const Settings& settings : {kFlat, kGouraud, kFlatWire, kGouraudWire, kWireAlone}) {
        const Image image = drawer.draw(growing, at(settings, time));
        Drawer plain(device());
        const Image expected =
            plain.draw(still, growing.camera, settings, {.vertex_normals = normals});
        // Normals were rounded to 32 bits, and the depth planes differ.
        EXPECT_LE(count_different(image, expected, 2), 8U)
            << static_cast<int>(settings.shading) << " " << settings.wireframe;
      }
    }
  }
}

/// Attributes with a color for each vertex, by its number.
Attributes colored(const Mesh& mesh) {
  Attributes attributes;
  AttributeLayer colors(color_type(), mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    store(colors, v, {0.1 + 0.08 * (v % 11), 0.1 + 0.12 * (v % 7), 0.1 + 0.2 * (v % 4), 1.0});
  attributes.layers.push_back(std::move(colors));
  return attributes;
}

TEST_F(GeomorphTest, LooksWithAttributesMoveAsClayDoes) {
  Growing growing(torus());
  const Attributes attributes = colored(growing.mesh.mesh());
  const GeomorphTime time = GeomorphTime::continuous(0.6 * growing.count(), 0.3 * growing.count());
  std::vector<std::uint32_t> normals;
  Mesh still = standing_still(growing, time, normals);
  for (const bool wireframe : {false, true}) {
    const Settings settings{.look = Look::base_color, .wireframe = wireframe};
    Drawer drawer(device());
    Sources moving = growing.sources();
    moving.appearance.attributes = &attributes;
    const Image before = drawer.draw(growing.mesh.mesh(), growing.camera, settings, moving);
    const Image image =
        drawer.draw(growing.mesh.mesh(), growing.camera, at(settings, time), moving);
    Drawer plain(device());
    Sources standing{.vertex_normals = normals};
    standing.appearance.attributes = &attributes;
    const Image expected = plain.draw(still, growing.camera, settings, standing);
    EXPECT_LE(count_different(image, expected, 2), 8U) << wireframe;
    EXPECT_GT(count_different(image, before, 2), 500U) << wireframe;
  }
}

TEST_F(GeomorphTest, EdgesOfLargeMeshesMoveToo) {
  // Above 50,000 faces, edges are drawn with their faces.
  Growing growing(build_mesh(test::torus(260, 120)).mesh, 20'000);
  Drawer drawer(device());
  ASSERT_GT(growing.mesh.mesh().face_count(), 50'000U);
  const GeomorphTime time = GeomorphTime::between(0, 0.5F);
  std::vector<std::uint32_t> normals;
  Mesh still = standing_still(growing, time, normals);
  const Image image = drawer.draw(growing, at(kWireAlone, time));
  Drawer plain(device());
  const Image expected = plain.draw(still, growing.camera, kWireAlone, {.vertex_normals = normals});
  EXPECT_LE(count_different(image, expected, 2), 8U);
}

TEST_F(GeomorphTest, CornerNormalsStayFixedWhileVerticesMove) {
  Growing growing(bunny());
  Settings split = kGouraud;
  split.crease_angle_deg = 30.0F;
  const GeomorphTime time = GeomorphTime::between(growing.count() / 2, 0.5F);
  for (const bool wireframe : {false, true}) {
    split.wireframe = wireframe;
    Drawer drawer(device());
    const Sources moving{.morph = growing.sources().morph};
    const Image still = drawer.draw(growing.mesh.mesh(), growing.camera, split, moving);
    EXPECT_EQ(drawer.mirror().normals().mode(), GpuNormals::Mode::corner);
    const Image moved = drawer.draw(growing.mesh.mesh(), growing.camera, at(split, time), moving);
    EXPECT_GT(count_different(moved, still, 2), 500U);
    drawer.draw(growing, split);
    EXPECT_EQ(drawer.mirror().normals().mode(), GpuNormals::Mode::vertex)
        << "given normals take precedence";
  }
}

TEST_F(GeomorphTest, TimeIsContinuousAcrossLevels) {
  Growing growing(bunny());
  Drawer drawer(device());
  const double range = 20.0;
  const double middle = growing.count() / 2;
  const auto picture = [&](double time) {
    growing.go_to(std::min(growing.count(), static_cast<std::uint32_t>(std::ceil(time))));
    return drawer.draw(growing, at(kGouraud, GeomorphTime::continuous(time, range)));
  };
  Image before = picture(middle - 2.0);
  std::size_t most = 0;
  for (double time = middle - 2.0; time < middle + 2.0; time += 0.05) {
    Image now = picture(time);
    most = std::max(most, count_different(now, before, 4));
    before = std::move(now);
  }
  EXPECT_LE(most, 60U) << "one step is a twentieth of a split";
  growing.go_to(growing.count() / 2 + 40);
  const Image popped = drawer.draw(growing, kGouraud);
  EXPECT_GT(count_different(popped, before, 4), 10 * most) << "the difference without a geomorph";
}

TEST_F(GeomorphTest, TimeIsIgnoredWithoutASource) {
  Growing growing(bunny());
  Drawer drawer(device());
  const Image plain = drawer.draw(growing.mesh.mesh(), growing.camera, kFlat, {});
  const Settings early = at(kFlat, GeomorphTime::between(0, 0.0F));
  EXPECT_EQ(drawer.draw(growing.mesh.mesh(), growing.camera, early, {}).rgba, plain.rgba);
  EXPECT_GT(count_different(drawer.draw(growing, early), plain), 1000U)
      << "a source that was added later";
  EXPECT_EQ(drawer.draw(growing.mesh.mesh(), growing.camera, early, {}).rgba, plain.rgba);
}

TEST_F(GeomorphTest, CoarseLevelOutsideTheFineBoxIsNotClipped) {
  // The fine level lies within the box of the coarse one: the last split removes a spike.
  Mesh mesh = build_mesh(test::cube()).mesh;
  std::vector<std::uint32_t> heads(mesh.vertex_count(), kNoHead);
  heads[6] = 0;
  const std::uint32_t up = encode_normal({0, 0, 1});
  const std::vector<SplitMorph> splits{{glm::vec3(-100.0F), kNoHead, glm::vec3(0.0F), up, up, up}};
  Drawer drawer(device());
  Camera camera;
  drawer.draw(mesh, camera, kFlat, {.morph = {heads, splits}});
  EXPECT_GE(drawer.mirror().box().max.x, 100.0F);
  EXPECT_EQ(drawer.mirror().box().min, glm::vec3(-0.5F));
}

TEST_F(GeomorphTest, ChangingTheTimeUploadsNothing) {
  Growing growing(torus());
  GpuMesh mirror(device());
  mirror.apply(growing.mesh.mesh(), kGouraud, growing.sources());
  for (int i = 0; i < 10; ++i) {
    const Settings settings = at(kGouraud, GeomorphTime::continuous(100.0 + i, 50.0));
    EXPECT_EQ(mirror.apply(growing.mesh.mesh(), settings, growing.sources()).uploaded_bytes, 0U);
  }
}

TEST_F(GeomorphTest, LevelChangesUploadInProportionToTheirDistance) {
  Growing growing(build_mesh(test::torus(150, 100)).mesh);
  GpuMesh mirror(device());
  const std::uint32_t middle = growing.count() / 2;
  growing.go_to(middle);
  const UploadStats whole = mirror.apply(growing.mesh.mesh(), kGouraud, growing.sources());
  EXPECT_EQ(whole.uploaded_bytes, whole.total_bytes);
  for (const std::uint32_t steps : {1U, 10U, 100U}) {
    for (const std::uint32_t level : {middle + steps, middle, middle - steps, middle}) {
      growing.go_to(level);
      const UploadStats stats = mirror.apply(growing.mesh.mesh(), kGouraud, growing.sources());
      EXPECT_LE(stats.uploaded_bytes, 1000U * steps) << level;
      EXPECT_GT(stats.uploaded_bytes, 40U * steps) << level;
    }
  }
}

TEST_F(GeomorphTest, AnySequenceOfLevelsEqualsAFreshMirror) {
  for (const Settings& settings : {kFlat, kGouraud}) {
    Growing growing(sheet());
    GpuMesh mirror(device());
    std::mt19937 random(5);
    for (int round = 0; round < 25; ++round) {
      const bool far = random() % 3 == 0;
      const auto level = static_cast<int>(growing.mesh.level());
      const int step = far ? 100'000 : 5;
      const int to = level - step + static_cast<int>(random() % (2 * step + 1));
      growing.go_to(std::clamp(to, 0, static_cast<int>(growing.count())));
      if (random() % 4 == 0) continue;  // apply several level changes at once
      mirror.apply(growing.mesh.mesh(), settings, growing.sources());
      GpuMesh fresh(device());
      Mesh copy = growing.mesh.mesh();
      fresh.apply(copy, settings, growing.sources());
      ASSERT_TRUE(mirror.read_back() == fresh.read_back()) << round;
    }
  }
}

TEST_F(GeomorphTest, LaterSplitsAreAppended) {
  Growing growing(torus());
  GpuMesh mirror(device());
  const std::span all = growing.geomorph.splits();
  std::uint64_t split_bytes = 0;
  for (std::uint32_t count = 1; count < growing.count(); count += 7) {
    growing.go_to(count);
    const Sources sources{.vertex_normals = growing.geomorph.normals(),
                          .morph = {growing.geomorph.heads(), all.first(count)}};
    const VkBuffer before = mirror.morph().splits().handle();
    mirror.apply(growing.mesh.mesh(), kGouraud, sources);
    const bool is_moved = mirror.morph().splits().handle() != before;
    split_bytes += is_moved ? mirror.morph().split_bytes() : 7 * sizeof(SplitMorph);
    GpuMesh fresh(device());
    Mesh copy = growing.mesh.mesh();
    fresh.apply(copy, kGouraud, sources);
    ASSERT_TRUE(mirror.read_back() == fresh.read_back()) << count;
  }
  EXPECT_LT(split_bytes, 5 * all.size_bytes()) << "each split is copied only a few times";
  EXPECT_LE(mirror.morph().splits().size(), 3 * all.size_bytes() / 2)
      << "the capacity is not wasted";
  // When normals become available, all splits are uploaded again.
  const Sources unknown{.morph = {growing.geomorph.heads(), all}};
  mirror.apply(growing.mesh.mesh(), kGouraud, unknown);
  EXPECT_GE(mirror.apply(growing.mesh.mesh(), kGouraud, growing.sources()).uploaded_bytes,
            all.size_bytes());
  EXPECT_LT(mirror.apply(growing.mesh.mesh(), kGouraud, growing.sources()).uploaded_bytes, 1U);
  // Fewer splits belong to another mesh, so all are uploaded again.
  growing.go_to(3);
  const Sources fewer{.morph = {growing.geomorph.heads(), all.first(3)}};
  mirror.apply(growing.mesh.mesh(), kFlat, fewer);
  EXPECT_EQ(mirror.morph().split_count(), 3U);
}

TEST_F(GeomorphTest, SplitOrderColorsFollowTheOrder) {
  Growing growing(bunny());
  Drawer drawer(device());
  for (Settings settings : {kFlat, kGouraud, kFlatWire, kGouraudWire}) {
    const Image plain = drawer.draw(growing, settings);
    settings.colors_by_split_order = true;
    settings.first_split_vertex = growing.mesh.base_vertex_count();
    const Image image = drawer.draw(growing, settings);
    EXPECT_GT(count_different(image, plain, 8), 5000U);
    settings.first_split_vertex = growing.mesh.mesh().vertex_count();
    EXPECT_EQ(count_different(drawer.draw(growing, settings), plain, 1), 0U)
        << "the base looks unchanged";
  }
  // Without a source, colors follow the order of the mesh itself.
  Mesh mesh = bunny();
  Settings settings = kFlat;
  settings.colors_by_split_order = true;
  Drawer other(device());
  const Image colored = other.draw(mesh, growing.camera, settings, {});
  EXPECT_GT(count_different(colored, other.draw(mesh, growing.camera, kFlat, {}), 8), 5000U);
}

TEST_F(GeomorphTest, FramesInFlightKeepTheirTime) {
  // Two frames in one submission, with separate targets: each uses the time with which it was
  // recorded.
  Growing growing(bunny());
  GpuMesh mirror(device());
  Renderer renderer(device());
  mirror.apply(growing.mesh.mesh(), kFlat, growing.sources());
  const Settings early = at(kFlat, GeomorphTime::between(0, 0.0F));
  const Settings late = at(kFlat, GeomorphTime::between(0, 0.9F));
  const SceneTarget first(device(), {kMorphSize, kMorphSize}, 4);
  const SceneTarget second(device(), {kMorphSize, kMorphSize}, 4);
  device().run_once([&](VkCommandBuffer commands) {
    renderer.draw(commands, first, mirror, growing.camera, early);
    renderer.draw(commands, second, mirror, growing.camera, late);
  });
  const Image a = gpu::read_image(device(), first.color(), gpu::kTransferSource);
  const Image b = gpu::read_image(device(), second.color(), gpu::kTransferSource);
  Drawer drawer(device());
  EXPECT_EQ(a.rgba, drawer.draw(growing, early).rgba);
  EXPECT_EQ(b.rgba, drawer.draw(growing, late).rgba);
}

}  // namespace
}  // namespace mesher::render
