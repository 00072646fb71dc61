#include "engine/render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace mesher::render {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dvec2 kWindow(800.0, 600.0);
const double kAspect = kWindow.x / kWindow.y;

Box box_of(const glm::vec3& min, const glm::vec3& max) {
  Box box;
  box.min = min;
  box.max = max;
  return box;
}

/// Projected position of a point, in window units.
glm::dvec2 window_position(const Camera& camera, const glm::dvec3& p) {
  const glm::dvec3 local = p - camera.eye();
  const double depth =
      camera.is_orthographic() ? camera.distance() : glm::dot(local, camera.forward());
  const double unit = depth * std::tan(0.5 * Camera::kFieldOfViewRad);
  const glm::dvec2 ndc(glm::dot(local, camera.right()) / (unit * kAspect),
                       glm::dot(local, camera.up()) / unit);
  return {0.5 * kWindow.x * (1.0 + ndc.x), 0.5 * kWindow.y * (1.0 - ndc.y)};
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " and " << b.x << " " << b.y << " " << b.z;
}

void expect_near(const glm::dvec2& a, const glm::dvec2& b, double tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance) << a.x << " " << a.y << " and " << b.x << " " << b.y;
}

TEST(Camera, ViewsLookAlongTheAxesWithYUp) {
  Camera camera;
  camera.set_view(View::front);
  expect_near(camera.forward(), {0, 0, -1});
  expect_near(camera.right(), {1, 0, 0});
  expect_near(camera.up(), {0, 1, 0});
  camera.set_view(View::right);
  expect_near(camera.forward(), {-1, 0, 0});
  expect_near(camera.right(), {0, 0, -1});
  camera.set_view(View::top);
  expect_near(camera.forward(), {0, -1, 0});
  expect_near(camera.right(), {1, 0, 0});
  expect_near(camera.up(), {0, 0, -1});
}

TEST(Camera, OrbitNeverRollsAndStopsAtThePoles) {
  Camera camera;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> drag(-300.0, 300.0);
  for (int i = 0; i < 1000; ++i) {
    camera.orbit({drag(random), drag(random)}, kWindow);
    EXPECT_EQ(camera.right().y, 0.0);
    EXPECT_GE(camera.up().y, -1e-12);
    EXPECT_LE(std::abs(camera.pitch_rad()), 0.5 * kPi);
    EXPECT_NEAR(glm::length(camera.forward()), 1.0, 1e-12);
  }
  camera.orbit({0.0, 1e6}, kWindow);
  EXPECT_EQ(camera.pitch_rad(), 0.5 * kPi);
  camera.orbit({0.0, -60.0}, kWindow);
  EXPECT_NEAR(camera.pitch_rad(), 0.4 * kPi, 1e-12)
      << "the opposite motion must leave the pole at once";
}

TEST(Camera, OrbitMovesTheModelWithTheCursor) {
  Camera camera;
  const glm::dvec3 nearest = camera.eye() + 0.5 * camera.distance() * camera.forward();
  const glm::dvec2 before = window_position(camera, nearest);
  camera.orbit({40.0, 30.0}, kWindow);
  const glm::dvec2 after = window_position(camera, nearest);
  EXPECT_GT(after.x, before.x);
  EXPECT_GT(after.y, before.y);
}

TEST(Camera, FullTurnReturnsToTheStart) {
  Camera camera;
  const glm::dvec3 before = camera.eye();
  for (int i = 0; i < 4; ++i)
    camera.orbit({0.5 * kWindow.y, 0.0}, kWindow);
  expect_near(camera.eye(), before, 1e-9);
}

TEST(Camera, PanKeepsThePointUnderTheCursor) {
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.set_orthographic(orthographic);
    camera.set_angles(0.7, 0.4);
    const glm::dvec3 grabbed = camera.pivot();
    camera.pan({120.0, -75.0}, kWindow);
    expect_near(window_position(camera, grabbed), {400.0 + 120.0, 300.0 - 75.0}, 1e-9);
    EXPECT_NEAR(glm::dot(camera.pivot() - grabbed, camera.forward()), 0.0, 1e-12);
  }
}

TEST(Camera, ZoomKeepsThePointUnderTheCursor) {
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.set_orthographic(orthographic);
    camera.set_angles(-0.3, 0.2);
    const Cursor cursor{{650.0, 120.0}, kWindow};
    const Ray ray = camera.pick_ray(cursor);
    const double along = glm::dot(camera.pivot() - ray.origin, camera.forward()) /
                         glm::dot(ray.direction, camera.forward());
    const glm::dvec3 point = ray.origin + along * ray.direction;
    const double before = camera.distance();
    camera.zoom(3.0, cursor);
    EXPECT_NEAR(camera.distance(), before * std::pow(0.9, 3.0), 1e-12);
    expect_near(window_position(camera, point), cursor.position, 1e-6);
    camera.zoom(-3.0, cursor);
    EXPECT_NEAR(camera.distance(), before, 1e-12);
  }
}

TEST(Camera, ZoomIsUnlimitedAndNeverReachesZero) {
  Camera camera;
  const Cursor middle{0.5 * kWindow, kWindow};
  for (int i = 0; i < 100; ++i)
    camera.zoom(100.0, middle);
  EXPECT_GT(camera.distance(), 0.0);
  for (int i = 0; i < 100; ++i)
    camera.zoom(-100.0, middle);
  EXPECT_TRUE(std::isfinite(camera.distance()));
  EXPECT_TRUE(std::isfinite(camera.transform(1.0, box_of({-1, -1, -1}, {1, 1, 1})).offset.z));
}

TEST(Camera, FrameShowsTheWholeBoxFromEverySide) {
  const Box box = box_of({-3, 1, 10}, {4, 2, 10.5F});
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  for (int i = 0; i < 200; ++i) {
    Camera camera;
    camera.set_orthographic(i % 2 == 0);
    camera.set_angles(angle(random), 0.5 * angle(random));
    camera.frame(box, kAspect);
    double widest = 0.0;
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 corner((k & 1) != 0 ? box.max.x : box.min.x,
                              (k & 2) != 0 ? box.max.y : box.min.y,
                              (k & 4) != 0 ? box.max.z : box.min.z);
      const glm::dvec2 at = window_position(camera, corner) / kWindow * 2.0 - 1.0;
      widest = std::max({widest, std::abs(at.x), std::abs(at.y)});
    }
    EXPECT_LE(widest, 1.0);
    EXPECT_GT(widest, 0.85);
  }
}

TEST(Camera, FrameAcceptsAnEmptyBoxAndAPoint) {
  Camera camera;
  camera.frame(Box{}, 1.0);
  EXPECT_GT(camera.distance(), 0.0);
  camera.frame(box_of({5, 5, 5}, {5, 5, 5}), 1.0);
  EXPECT_GT(camera.distance(), 0.0);
  expect_near(camera.pivot(), {5, 5, 5});
}

TEST(Camera, RecenterKeepsAnglesAndDistance) {
  Camera camera;
  camera.set_angles(0.5, 0.5);
  const double distance = camera.distance();
  camera.recenter({1, 2, 3});
  expect_near(camera.pivot(), {1, 2, 3});
  EXPECT_EQ(camera.distance(), distance);
  expect_near(window_position(camera, {1, 2, 3}), 0.5 * kWindow, 1e-9);
}

TEST(Camera, SwitchingProjectionKeepsThePivotPlane) {
  Camera camera;
  camera.set_angles(0.3, 0.2);
  const glm::dvec3 point = camera.pivot() + 0.4 * camera.right() + 0.3 * camera.up();
  const glm::dvec2 before = window_position(camera, point);
  camera.set_orthographic(true);
  expect_near(window_position(camera, point), before, 1e-9);
}

TEST(Camera, PickRayHitsThePointUnderTheCursor) {
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.set_orthographic(orthographic);
    camera.set_angles(1.0, -0.6);
    const glm::dvec3 point = camera.pivot() + glm::dvec3(0.2, -0.1, 0.3);
    const Ray ray = camera.pick_ray({window_position(camera, point), kWindow});
    EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-12);
    const glm::dvec3 nearest =
        ray.origin + glm::dot(point - ray.origin, ray.direction) * ray.direction;
    expect_near(nearest, point, 1e-9);
    EXPECT_GT(glm::dot(point - ray.origin, ray.direction), 0.0);
  }
}

/// A unit cube of any size at any position looks the same, except for the rounding of its
/// positions.
TEST(Camera, TransformIsPreciseAtAnyScaleAndPosition) {
  struct Case {
    double size;
    double offset;
  };
  for (const Case c : {Case{1e-6, 0.0}, Case{1.0, 0.0}, Case{1e6, 0.0}, Case{1.0, 1e6},
                       Case{1e-6, 1.0}, Case{1e-30, 0.0}, Case{1e30, 0.0}}) {
    const glm::vec3 min(static_cast<float>(c.offset - c.size));
    const glm::vec3 max(static_cast<float>(c.offset + c.size));
    Camera camera;
    camera.set_angles(0.7, 0.3);
    camera.frame(box_of(min, max), kAspect);
    const ViewTransform transform = camera.transform(kAspect, box_of(min, max));
    for (const glm::vec3& p : {min, max, glm::vec3(min.x, max.y, min.z)}) {
      const glm::vec4 clip = transform.clip(p);
      const glm::dvec2 expected = window_position(camera, glm::dvec3(p)) / kWindow * 2.0 - 1.0;
      EXPECT_NEAR(clip.x / clip.w, expected.x, 2e-6) << c.size << " at " << c.offset;
      EXPECT_NEAR(clip.y / clip.w, -expected.y, 2e-6) << c.size << " at " << c.offset;
      EXPECT_GT(clip.z / clip.w, 0.0F);
      EXPECT_LT(clip.z / clip.w, 1.0F);
    }
  }
}

TEST(Camera, DepthIsReversedAndTheBoxIsBetweenThePlanes) {
  const Box box = box_of({-1, -1, -1}, {1, 1, 1});
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.set_orthographic(orthographic);
    camera.frame(box, 1.0);
    const ViewTransform transform = camera.transform(1.0, box);
    const glm::vec4 near = transform.clip({0, 0, 1});
    const glm::vec4 far = transform.clip({0, 0, -1});
    EXPECT_LT(near.z / near.w, 1.0F);
    EXPECT_GT(near.z / near.w, far.z / far.w);
    EXPECT_GT(far.z / far.w, 0.0F);
  }
}

TEST(Camera, InsideTheModelTheNearPlaneIsInFrontOfTheEye) {
  const Box box = box_of({-1, -1, -1}, {1, 1, 1});
  Camera camera;
  camera.frame(box, 1.0);
  camera.zoom(1000.0);
  const ViewTransform transform = camera.transform(1.0, box);
  const float near = transform.depth_offset / (1.0F + transform.depth_scale);
  EXPECT_GT(near, 0.0F);
  EXPECT_LE(near, 0.01F);
}

TEST(Camera, DepthsOfSimilarModelsAreEqualIfFittedToOneBox) {
  const Box small{glm::vec3(-1), glm::vec3(1)};
  const Box large{glm::vec3(-1.5F), glm::vec3(1.01F)};
  const auto depths = [&](const render::Camera& camera, const Box& box) {
    const render::ViewTransform transform = camera.transform(1.5, box);
    return std::pair(transform.depth_scale, transform.depth_offset);
  };
  for (const bool orthographic : {false, true}) {
    render::Camera camera;
    camera.set_orthographic(orthographic);
    camera.frame(small, 1.5);
    EXPECT_NE(depths(camera, small), depths(camera, large));
    const auto expected = depths(camera, large);
    camera.fit_depth(large);
    EXPECT_EQ(depths(camera, small), expected);
    EXPECT_EQ(depths(camera, large), expected);
  }
}

}  // namespace
}  // namespace mesher::render
