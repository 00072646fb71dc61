#include "engine/render/picture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/render/offscreen.h"
#include "engine/render/pixel_average.h"
#include "tests/render/looks.h"
#include "tests/support/assets.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

const Settings kLinesAlone{.shading = Shading::none, .wireframe = true};

class PictureTest : public test::GpuTest {
 protected:
  void show(Mesh&& mesh, const Settings& settings, bool is_orthographic = false) {
    mesh_ = std::move(mesh);
    settings_ = settings;
    if (!mirror_) mirror_.emplace(device());
    if (!renderer_) renderer_.emplace(device());
    mirror_->invalidate();
    mirror_->apply(mesh_, settings);
    camera_ = Camera();
    camera_.set_angles(0.5, 0.4);
    camera_.set_orthographic(is_orthographic);
    camera_.frame(bounding_box(mesh_), 1.2);
  }
  Image draw(const PictureOptions& options) {
    return draw_picture(device(), *renderer_, *mirror_, camera_, settings_, options);
  }
  void TearDown() override {
    mirror_.reset();
    renderer_.reset();
    GpuTest::TearDown();
  }

  Mesh mesh_;
  Settings settings_;
  Camera camera_;
  std::optional<GpuMesh> mirror_;
  std::optional<Renderer> renderer_;
};

struct Difference {
  std::size_t any = 0;    ///< components that differ
  std::size_t large = 0;  ///< by more than 1
  int most = 0;
};

Difference compared(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.rgba.size(), b.rgba.size());
  Difference result;
  for (std::size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i) {
    const int difference = std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    result.any += difference > 0 ? 1 : 0;
    result.large += difference > 1 ? 1 : 0;
    result.most = std::max(result.most, difference);
  }
  return result;
}

double mean_error(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgba.size(), b.rgba.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
  return sum / static_cast<double>(a.rgba.size());
}

/// Tiles move vertices by whole pixels. Sums of floats round differently, so a component may be off
/// by one, and a vertex in many thousands snaps to the next of the 256 positions within a pixel.
void expect_same_pixels(const Image& a, const Image& b) {
  const Difference difference = compared(a, b);
  EXPECT_LE(difference.any, a.rgba.size() / 500);
  EXPECT_LE(difference.large, a.rgba.size() / 100'000);
  EXPECT_LE(difference.most, 32);
}

TEST_F(PictureTest, OfTheWindowsSizeEqualsTheWindowsImage) {
  for (const Settings& settings : {kFlat, kGouraudWire, kLinesAlone}) {
    show(test::asset("creased_cube.obj"), settings);
    const Image picture = draw({.window = {233, 141}});
    EXPECT_EQ(picture.rgba,
              render_image(device(), *renderer_, *mirror_, camera_, settings_, 233, 141).rgba);
  }
}

TEST_F(PictureTest, DoesNotDependOnTiles) {
  for (const char* name : {"bunny.obj", "cactus.obj", "open_box.obj"}) {
    for (const Settings& settings : {kFlat, kFlatWire, kGouraudWire, kLinesAlone}) {
      for (const bool is_orthographic : {false, true}) {
        show(test::asset(name), settings, is_orthographic);
        PictureOptions options{.window = {301, 250}, .scale = 2};
        const Image whole = draw(options);
        options.tiles = {.side = 97};
        expect_same_pixels(draw(options), whole);
        options.tiles = {.side = 256, .pixels = 256 * 40};
        expect_same_pixels(draw(options), whole);
      }
    }
  }
}

TEST_F(PictureTest, DoesNotDependOnTheLargestViewport) {
  for (const Settings& settings : {kGouraudWire, kLinesAlone}) {
    for (const bool is_orthographic : {false, true}) {
      show(test::asset("bunny.obj"), settings, is_orthographic);
      PictureOptions options{.window = {301, 250}, .scale = 2};
      const Image whole = draw(options);
      for (const std::uint32_t viewport : {512U, 200U}) {
        options.tiles = {.viewport = viewport};
        expect_same_pixels(draw(options), whole);
      }
    }
  }
}

TEST_F(PictureTest, ScaledLooksLikeTheWindowButSharper) {
  for (const Settings& settings : {kFlatWire, kLinesAlone}) {
    show(test::asset("bunny.obj"), settings);
    const Image window = draw({.window = {300, 250}});
    const Image scaled = average_pixels(draw({.window = {300, 250}, .scale = 4}), 4);
    // As a larger window, the same model has thinner lines, which are less faded.
    const Image larger = average_pixels(draw({.window = {1200, 1000}}), 4);
    EXPECT_LT(mean_error(scaled, window), 0.5 * mean_error(larger, window));
  }
}

TEST_F(PictureTest, LinesGrowWithTheScale) {
  show(test::asset("open_box.obj"), {.line_edges = true});
  const auto red_pixels = [](const Image& image) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      count += image.rgba[i] > 170 && image.rgba[i + 1] < 90 ? 1 : 0;
    return static_cast<double>(count);
  };
  const double once = red_pixels(draw({.window = {300, 250}}));
  EXPECT_NEAR(red_pixels(draw({.window = {300, 250}, .scale = 4})), 16.0 * once, 1.6 * once);
}

TEST_F(PictureTest, SupersamplingAveragesALargerPicture) {
  show(test::asset("creased_cube.obj"), kGouraudWire);
  const Image larger = draw({.window = {100, 90}, .scale = 3});
  const Image averaged = draw({.window = {100, 90}, .supersample = 3});
  EXPECT_EQ(averaged.rgba, average_pixels(larger, 3).rgba);
  const Image tiled =
      draw({.window = {100, 90}, .supersample = 3, .tiles = {.side = 100, .pixels = 5000}});
  expect_same_pixels(tiled, averaged);
}

/// Returns the picture over the background, composed in linear light.
Image over_background(const Image& picture, const Color& background) {
  const auto light = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const auto byte = [](double l) {
    const double c = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * c));
  };
  Image result = picture;
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    const double alpha = picture.rgba[i - i % 4 + 3] / 255.0;
    if (i % 4 == 3) {
      result.rgba[i] = 255;
    } else {
      result.rgba[i] = byte(alpha * light(picture.rgba[i] / 255.0) +
                            (1.0 - alpha) * light(background[static_cast<int>(i % 4)]));
    }
  }
  return result;
}

TEST_F(PictureTest, TransparentOverTheBackgroundEqualsOpaque) {
  for (Settings settings : {kFlat, kGouraudWire, kLinesAlone}) {
    for (const Background background : {Background::light, Background::dark}) {
      settings.background = background;
      show(test::asset("open_box.obj"), settings);
      for (const unsigned supersample : {1U, 2U}) {
        const PictureOptions opaque{.window = {200, 160}, .supersample = supersample};
        PictureOptions transparent = opaque;
        transparent.is_transparent = true;
        const Image composed = over_background(draw(transparent), background_color(background));
        const Difference difference = compared(composed, draw(opaque));
        EXPECT_LE(difference.most, 5) << "alpha and light have 8 bits each";
      }
    }
  }
}

TEST_F(PictureTest, TransparentHasNoFringe) {
  Settings settings{.front = {0.9F, 0.1F, 0.1F}, .back = {0.9F, 0.1F, 0.1F}};
  for (const Background background : {Background::light, Background::dark}) {
    settings.background = background;
    show(build_mesh(test::torus(60, 40)).mesh, settings);
    const Image picture = draw({.window = {200, 160}, .supersample = 2, .is_transparent = true});
    std::size_t partial = 0;
    std::size_t empty = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      const std::uint8_t* p = picture.rgba.data() + i;
      if (p[3] == 0) {
        ++empty;
        EXPECT_EQ(p[0] + p[1] + p[2], 0);
        continue;
      }
      partial += p[3] < 255 ? 1 : 0;
      // A background in the color would show as green and blue.
      EXPECT_GT(p[0], 2 * p[1]);
      EXPECT_GT(p[0], 2 * p[2]);
    }
    EXPECT_GT(empty, picture.rgba.size() / 4 / 10);
    EXPECT_GT(partial, 200U) << "the outline is antialiased";
  }
}

TEST_F(PictureTest, PassesRowsOnFromTheTop) {
  show(build_mesh(test::cube()).mesh, kFlatWire);
  PictureOptions options{.window = {120, 101}, .tiles = {.side = 64, .pixels = 64 * 20}};
  const Image whole = draw(options);
  std::vector<std::uint32_t> heights;
  Array<std::uint8_t> bytes;
  draw_picture(device(), *renderer_, *mirror_, camera_, settings_, options, [&](const Image& rows) {
    EXPECT_EQ(rows.width, 120U);
    heights.push_back(rows.height);
    bytes.insert(bytes.end(), rows.rgba.begin(), rows.rgba.end());
  });
  EXPECT_EQ(heights, (std::vector<std::uint32_t>{20, 20, 20, 20, 20, 1}));
  EXPECT_EQ(bytes, whole.rgba);
}

TEST_F(PictureTest, CanBeCancelledBetweenTiles) {
  show(build_mesh(test::cube()).mesh, kFlat);
  Progress progress;
  const PictureOptions options{.window = {64, 64}, .tiles = {.side = 16}, .progress = &progress};
  std::size_t bands = 0;
  EXPECT_THROW(draw_picture(device(), *renderer_, *mirror_, camera_, settings_, options,
                            [&](const Image&) {
                              ++bands;
                              progress.cancel();
                            }),
               Cancelled);
  EXPECT_EQ(bands, 1U);
}

TEST_F(PictureTest, ReportsItsProgress) {
  show(build_mesh(test::cube()).mesh, kFlat);
  Progress progress;
  draw({.window = {64, 64}, .tiles = {.side = 16}, .progress = &progress});
  EXPECT_EQ(progress.fraction(), 1.0F);
}

}  // namespace
}  // namespace mesher::render
