#include <gtest/gtest.h>
#include <mesher/asset.h>
#include <mesher/error.h>
#include <mesher/progressive_mesh.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

const std::string kBunny = MESHER_SOURCE_DIR "/assets/bunny_1k.obj";

/// A tetrahedron; its last face has the wrong direction.
Asset tetrahedron() {
  const std::vector<std::array<float, 3>> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::uint32_t> corners{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 3, 2};
  return Asset::build(positions, corners);
}

bool mentions(const std::vector<std::string>& lines, const char* word) {
  return std::ranges::any_of(
      lines, [&](const std::string& line) { return line.find(word) != std::string::npos; });
}

TEST(Asset, ErrorsNameFileAndLine) {
  const test::TempFolder folder;
  const auto file = folder.write("bad.obj", "v 0 0 0\nv 1 x 0\n");
  try {
    Asset::load(file);
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), file.string());
    EXPECT_EQ(error.line(), 2U);
    EXPECT_FALSE(error.reason().empty());
    EXPECT_EQ(error.exit_code(), ExitCode::bad_input);
  }
  EXPECT_THROW(Asset::load(folder / "missing.obj"), InputError);
}

TEST(Asset, BuildRepairsAndReports) {
  const Asset asset = tetrahedron();
  ASSERT_EQ(asset.repairs().size(), 1U);
  EXPECT_EQ(asset.repairs()[0].name, "faces_flipped");
  EXPECT_EQ(asset.repairs()[0].count, 1U);
  EXPECT_EQ(asset.statistics().euler_characteristic, 2);
  for (std::uint32_t h = 0; h < asset.indices().size(); ++h) {
    ASSERT_NE(asset.twins()[h], kNoElement);
    EXPECT_EQ(asset.twins()[asset.twins()[h]], h);
  }
}

TEST(Asset, BuildRefusesWrongCounts) {
  const std::vector<std::array<float, 3>> positions(3);
  const std::vector<std::uint32_t> missing_vertex{0, 1, 3};
  EXPECT_THROW(Asset::build(positions, missing_vertex), InputError);
  const std::vector<std::uint32_t> corners{0, 1, 2, 0};
  EXPECT_THROW(Asset::build(positions, corners), InputError);
  const std::vector<std::uint32_t> sizes{3, 4};
  EXPECT_THROW(Asset::build(positions, corners, sizes), InputError);
}

TEST(Asset, CopiesShareUntilOneChanges) {
  Asset asset = tetrahedron();
  const Asset copy = asset;
  EXPECT_EQ(copy.positions().data(), asset.positions().data());
  EXPECT_TRUE(asset.set_crease(0, 1, 2.0F));
  EXPECT_EQ(asset.statistics().crease_edges, 1U);
  EXPECT_EQ(copy.statistics().crease_edges, 0U);
  asset.tag_creases(30.0F);
  EXPECT_EQ(asset.statistics().crease_edges, 6U);
}

TEST(Asset, MovedAssetIsEmpty) {
  Asset asset = tetrahedron();
  const Asset taken = std::move(asset);
  EXPECT_EQ(taken.face_count(), 4U);
  asset = Asset();
  EXPECT_EQ(asset.face_count(), 0U);
}

TEST(Asset, SaveReturnsLosses) {
  const test::TempFolder folder;
  Asset asset = tetrahedron();
  asset.tag_creases(30.0F);
  EXPECT_TRUE(asset.save(folder / "a.obj").empty());
  EXPECT_TRUE(mentions(asset.save(folder / "a.stl"), "crease"));
  EXPECT_EQ(Asset::load(folder / "a.obj").statistics().crease_edges, 6U);
  EXPECT_THROW(asset.save(folder / "a.xyz"), UsageError);
  EXPECT_THROW(asset.save(folder / "a.pm"), UsageError);
  EXPECT_THROW(asset.save(folder / "no/a.obj"), OutputError);
}

TEST(Asset, ObserverSeesEveryCollapse) {
  const Asset bunny = Asset::load(kBunny);
  std::vector<bool> is_gone(bunny.face_count());
  std::uint32_t gone = 0;
  std::uint64_t collapses = 0;
  SimplifyReport report;
  SimplifyOptions options{.target_faces = 200};
  options.collapsed = [&](std::span<const EdgeCollapse> some) {
    collapses += some.size();
    for (const EdgeCollapse& collapse : some) {
      for (const std::uint32_t face : {collapse.face, collapse.other_face}) {
        if (face == kNoElement) continue;
        EXPECT_FALSE(is_gone[face]);
        is_gone[face] = true;
        ++gone;
      }
    }
  };
  const Asset coarse = bunny.simplify(options, &report);
  EXPECT_EQ(collapses, report.collapses);
  EXPECT_EQ(bunny.face_count() - gone, coarse.face_count());
  EXPECT_EQ(report.faces_reached, coarse.face_count());
  EXPECT_EQ(report.reason, StopReason::target_reached);
}

TEST(Asset, ObserverSeesOnlyTheRunThatCounts) {
  const test::TempFolder folder;
  // Every face has its own normal, so every edge is a seam.
  Asset::load(kBunny).subdivide({.levels = 0, .limit = true}).save(folder / "n.ply");
  const Asset bunny = Asset::load(folder / "n.ply");
  std::uint64_t collapses = 0;
  SimplifyReport report;
  SimplifyOptions options{.target_faces = 4};
  options.collapsed = [&](std::span<const EdgeCollapse> some) { collapses += some.size(); };
  static_cast<void>(bunny.simplify(options, &report));
  EXPECT_EQ(collapses, report.collapses);
}

TEST(Asset, CallbackCancels) {
  const Asset bunny = Asset::load(kBunny);
  const auto cancel = [](float, std::string_view) { return false; };
  EXPECT_THROW(static_cast<void>(bunny.simplify({.target_faces = 10, .progress = cancel})),
               Cancelled);
  EXPECT_THROW(static_cast<void>(Asset::load(kBunny, {.progress = cancel})), Cancelled);
  EXPECT_THROW(static_cast<void>(bunny.subdivide({.progress = cancel})), Cancelled);
}

TEST(Asset, ProgressNeverFalls) {
  float last = 0.0F;
  int calls = 0;
  const auto watch = [&](float fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    last = fraction;
    ++calls;
    return true;
  };
  static_cast<void>(Asset::load(kBunny, {.progress = watch}));
  EXPECT_GT(calls, 1);
  EXPECT_FLOAT_EQ(last, 1.0F);
}

TEST(Asset, RefusesContradictoryOptions) {
  const Asset asset = tetrahedron();
  const auto simplify = [&](const SimplifyOptions& options) {
    static_cast<void>(asset.simplify(options));
  };
  EXPECT_THROW(simplify({.max_error = 0.0}), UsageError);
  EXPECT_THROW(simplify({.max_error = 0.1, .prune = true}), UsageError);
  EXPECT_THROW(simplify({.prune = true, .collapsed = [](auto) {}}), UsageError);
  EXPECT_THROW(simplify({.weights = {.texcoord = -1.0F}}), UsageError);
  EXPECT_THROW(simplify({.weights = {.joint = std::nanf("")}}), UsageError);
  EXPECT_THROW(ProgressiveMesh(asset, {.weights = {.color = -0.5F}}), UsageError);
}

TEST(Asset, WeightsDecideWhatIsKept) {
  // A flat sheet whose texture bends at x = 4.
  std::string obj;
  for (int y = 0; y <= 8; ++y) {
    for (int x = 0; x <= 8; ++x) {
      obj += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
      obj += "vt " + std::to_string(x < 4 ? 0.1 * x : 0.4 + 0.15 * (x - 4)) + " " +
             std::to_string(0.125 * y) + "\n";
    }
  }
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const auto corner = [&](int i, int j) {
        const std::string v = std::to_string(9 * j + i + 1);
        return " " + v + "/" + v;
      };
      obj += "f" + corner(x, y) + corner(x + 1, y) + corner(x + 1, y + 1) + "\n";
      obj += "f" + corner(x, y) + corner(x + 1, y + 1) + corner(x, y + 1) + "\n";
    }
  }
  const test::TempFolder folder;
  folder.write("sheet.obj", obj);
  const Asset sheet = Asset::load(folder / "sheet.obj");
  const auto keeps_the_bend = [&](const AttributeWeights& weights) {
    const Asset small = sheet.simplify({.target_faces = 4, .weights = weights});
    return std::ranges::any_of(small.positions(), [](const auto& p) { return p[0] == 4.0F; });
  };
  EXPECT_TRUE(keeps_the_bend({}));
  EXPECT_FALSE(keeps_the_bend({.texcoord = 0.0F}));
}

TEST(Asset, MaxErrorBoundsTheComparison) {
  const Asset bunny = Asset::load(kBunny);
  const double bound = 0.01 * bunny.statistics().diagonal;
  SimplifyReport report;
  const Asset coarse = bunny.simplify({.max_error = bound}, &report);
  EXPECT_LT(coarse.face_count(), bunny.face_count());
  EXPECT_LE(report.certified_bound, bound);
  const Comparison distance = bunny.compare(coarse, {.samples = 5000});
  EXPECT_LE(distance.max, bound);
  EXPECT_GE(distance.upper_bound, distance.max);
  EXPECT_NEAR(bunny.compare(bunny, {.samples = 100}).max, 0.0, 1e-9);
  EXPECT_THROW(static_cast<void>(bunny.compare(Asset())), InputError);
}

TEST(Asset, SubdivisionStoresNormalsOfTheLimit) {
  const Asset asset = tetrahedron();
  EXPECT_TRUE(asset.attributes().empty());
  const Asset smooth = asset.subdivide({.levels = 2, .limit = true});
  EXPECT_EQ(smooth.face_count(), 64U);
  EXPECT_TRUE(mentions(smooth.attributes(), "NORMAL"));
  EXPECT_THROW(static_cast<void>(Asset::load(kBunny).subdivide({.levels = 16})), DeviceError);
}

}  // namespace
}  // namespace mesher
