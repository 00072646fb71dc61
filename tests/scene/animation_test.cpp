#include "engine/scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mesher::scene {
namespace {

constexpr double kTolerance = 1e-7;  // the keys are floats
constexpr float kHalfRoot = 0.70710678F;

NodePose pose_of(const Channel& channel, double time_s) {
  const auto poses = pose_at({.name = "", .duration_s = 0.0, .channels = {channel}}, time_s);
  EXPECT_EQ(poses.size(), 1U);
  EXPECT_TRUE(poses.contains(channel.node));
  return poses.begin()->second;
}

Channel translation(Interpolation interpolation, std::vector<float> times,
                    std::vector<float> values) {
  return {.node = 4,
          .property = NodeProperty::translation,
          .interpolation = interpolation,
          .times = std::move(times),
          .values = std::move(values),
          .components = 3};
}

Channel rotation(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
  Channel channel = translation(interpolation, std::move(times), std::move(values));
  channel.property = NodeProperty::rotation;
  channel.components = 4;
  return channel;
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[i], kTolerance) << i;
}

/// `angle_deg`: about z.
void expect_turned(const glm::dquat& found, double angle_deg) {
  const double half = angle_deg * 3.14159265358979323846 / 360.0;
  // A quaternion and its negative are one rotation.
  const double sign = found.w * std::cos(half) + found.z * std::sin(half) < 0.0 ? -1.0 : 1.0;
  EXPECT_NEAR(sign * found.w, std::cos(half), kTolerance);
  EXPECT_NEAR(sign * found.z, std::sin(half), kTolerance);
  EXPECT_NEAR(found.x, 0.0, kTolerance);
  EXPECT_NEAR(found.y, 0.0, kTolerance);
}

TEST(Animation, StepHoldsTheEarlierKey) {
  const Channel channel = translation(Interpolation::step, {1, 2, 4}, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(pose_of(channel, 1.0).translation, glm::dvec3(1, 2, 3));
  EXPECT_EQ(pose_of(channel, 1.999).translation, glm::dvec3(1, 2, 3));
  EXPECT_EQ(pose_of(channel, 2.0).translation, glm::dvec3(4, 5, 6));
  EXPECT_EQ(pose_of(channel, 3.9).translation, glm::dvec3(4, 5, 6));
}

TEST(Animation, LinearDividesTheDistanceBetweenKeys) {
  const Channel channel =
      translation(Interpolation::linear, {1, 2, 4}, {0, 0, 0, 1, 2, 3, 5, 2, -5});
  expect_near(*pose_of(channel, 1.25).translation, {0.25, 0.5, 0.75});
  expect_near(*pose_of(channel, 2.0).translation, {1, 2, 3});
  expect_near(*pose_of(channel, 3.0).translation, {3, 2, -1});
}

TEST(Animation, FirstAndLastKeyHoldOutside) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
    const Channel channel = translation(interpolation, {1, 2}, {1, 2, 3, 4, 5, 6});
    for (const double time_s : {-kInfinity, 0.0, 1.0})
      EXPECT_EQ(pose_of(channel, time_s).translation, glm::dvec3(1, 2, 3)) << time_s;
    for (const double time_s : {2.0, 3.0, kInfinity})
      EXPECT_EQ(pose_of(channel, time_s).translation, glm::dvec3(4, 5, 6)) << time_s;
  }
  const Channel spline = translation(Interpolation::cubic_spline, {1, 2},
                                     {9, 9, 9, 1, 2, 3, 9, 9, 9, 8, 8, 8, 4, 5, 6, 8, 8, 8});
  EXPECT_EQ(pose_of(spline, 0.5).translation, glm::dvec3(1, 2, 3));
  EXPECT_EQ(pose_of(spline, 2.5).translation, glm::dvec3(4, 5, 6));
}

TEST(Animation, OneKeyHoldsForAllTimes) {
  for (const double time_s : {-1.0, 0.5, 7.0}) {
    EXPECT_EQ(pose_of(translation(Interpolation::linear, {0.5F}, {1, 2, 3}), time_s).translation,
              glm::dvec3(1, 2, 3));
    EXPECT_EQ(pose_of(translation(Interpolation::cubic_spline, {0.5F}, {7, 7, 7, 1, 2, 3, 8, 8, 8}),
                      time_s)
                  .translation,
              glm::dvec3(1, 2, 3));
    expect_turned(
        *pose_of(rotation(Interpolation::linear, {0.5F}, {0, 0, kHalfRoot, kHalfRoot}), time_s)
             .rotation,
        90.0);
  }
}

// By hand, for t = 1/4: 27/32 v0 + 9/64 td b0 + 5/32 v1 - 3/64 td a1.
TEST(Animation, CubicSplineScalesTangentsByTheTimeBetweenKeys) {
  const Channel channel = translation(Interpolation::cubic_spline, {1, 3},
                                      {0, 0, 0, 1, 1, 0, 4, 0, 1, /**/ 8, 0, 2, 2, 1, 0, 0, 0, 0});
  expect_near(*pose_of(channel, 1.5).translation,
              {27.0 / 32 + 2 * 4 * 9.0 / 64 + 2 * 5.0 / 32 - 2 * 8 * 3.0 / 64, 1.0,
               2 * 9.0 / 64 - 2 * 2 * 3.0 / 64});
  expect_near(*pose_of(channel, 2.0).translation,
              {1.5 + 2 * 4 * 0.125 - 2 * 8 * 0.125, 1.0, 2 * 0.125 - 2 * 2 * 0.125});
}

TEST(Animation, RotationsTurnAtConstantSpeed) {
  const Channel channel =
      rotation(Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, kHalfRoot, kHalfRoot});
  expect_turned(*pose_of(channel, 0.0).rotation, 0.0);
  expect_turned(*pose_of(channel, 1.0 / 3).rotation, 30.0);
  expect_turned(*pose_of(channel, 0.9).rotation, 81.0);
  expect_turned(*pose_of(channel, 1.0).rotation, 90.0);
}

TEST(Animation, QuaternionsOfOppositeSignTakeTheShorterWay) {
  const Channel same = rotation(Interpolation::linear, {0, 1},
                                {0, 0, kHalfRoot, kHalfRoot, 0, 0, -kHalfRoot, -kHalfRoot});
  for (const double time_s : {0.0, 0.3, 0.5, 1.0})
    expect_turned(*pose_of(same, time_s).rotation, 90.0);
  const Channel quarter =
      rotation(Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, -kHalfRoot, -kHalfRoot});
  expect_turned(*pose_of(quarter, 0.5).rotation, 45.0);
}

// Half way between 0 and 90 degrees without tangents, the mean of both quaternions has length
// 0.924; its direction is that of 45 degrees.
TEST(Animation, RotationsHaveLengthOne) {
  const Channel spline = rotation(
      Interpolation::cubic_spline, {0, 1},
      {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, kHalfRoot, kHalfRoot, 0, 0, 0, 0});
  const glm::dquat middle = *pose_of(spline, 0.5).rotation;
  EXPECT_NEAR(glm::length(middle), 1.0, 1e-12);
  expect_turned(middle, 45.0);
  for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
    const Channel longer = rotation(interpolation, {0, 1}, {0, 0, 3, 3, 0, 0, 0, 2});
    expect_turned(*pose_of(longer, 0.0).rotation, 90.0);
    expect_turned(*pose_of(longer, 1.0).rotation, 0.0);
  }
  expect_turned(*pose_of(rotation(Interpolation::step, {0}, {0, 0, 0, 0}), 0.0).rotation, 0.0);
}

TEST(Animation, WeightsHaveOneValuePerTarget) {
  Channel channel = translation(Interpolation::linear, {0, 2}, {0, 1, 1, 0});
  channel.property = NodeProperty::weights;
  channel.components = 2;
  EXPECT_EQ(pose_of(channel, 0.5).weights, (std::vector<double>{0.25, 0.75}));
  EXPECT_FALSE(pose_of(channel, 0.5).translation);
}

TEST(Animation, ChannelsOfANodeMakeOnePose) {
  Channel scale = translation(Interpolation::step, {0}, {2, 2, 2});
  scale.property = NodeProperty::scale;
  Channel other = translation(Interpolation::step, {0}, {3, 3, 3});
  other.node = 1;
  const auto poses =
      pose_at({.name = "",
               .duration_s = 0.0,
               .channels = {translation(Interpolation::step, {0}, {9, 9, 9}), scale, other,
                            translation(Interpolation::step, {0}, {1, 1, 1})}},
              0.0);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses.at(1).translation, glm::dvec3(3, 3, 3));
  EXPECT_FALSE(poses.at(1).scale);
  EXPECT_EQ(poses.at(4).translation, glm::dvec3(1, 1, 1)) << "the last channel counts";
  EXPECT_EQ(poses.at(4).scale, glm::dvec3(2, 2, 2));
  EXPECT_FALSE(poses.at(4).rotation);
  EXPECT_TRUE(pose_at({}, 0.0).empty());
}

}  // namespace
}  // namespace mesher::scene
