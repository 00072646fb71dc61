#include "engine/scene/animation.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/core/assert.h"

namespace mesher::scene {
namespace {

/// The two keys around a time; one key twice before the first key and after the last one.
struct KeySpan {
  std::size_t from = 0;
  std::size_t to = 0;
  double length_s = 0.0;
  double fraction = 0.0;  ///< of the span, at the time
};

/// A part of a key.
enum class KeyPart : std::uint8_t { tangent_before, value, tangent_after };

KeySpan span_at(const std::vector<float>& times, double time_s) {
  const auto is_before = [](double time, float key) { return time < static_cast<double>(key); };
  const auto after = std::upper_bound(times.begin(), times.end(), time_s, is_before);
  if (after == times.begin()) return {};
  const auto from = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end()) return {.from = from, .to = from};
  const auto start_s = static_cast<double>(times[from]);
  const double length_s = static_cast<double>(*after) - start_s;
  return {.from = from,
          .to = from + 1,
          .length_s = length_s,
          .fraction = (time_s - start_s) / length_s};
}

double number(const Channel& channel, std::size_t key, std::size_t component,
              KeyPart part = KeyPart::value) {
  const std::size_t element = channel.interpolation == Interpolation::cubic_spline
                                  ? 3 * key + static_cast<std::size_t>(part)
                                  : key;
  return static_cast<double>(channel.values[element * channel.components + component]);
}

glm::dquat rotation_of_key(const Channel& channel, std::size_t key) {
  return glm::normalize(glm::dquat(number(channel, key, 3), number(channel, key, 0),
                                   number(channel, key, 1), number(channel, key, 2)));
}

double hermite(const Channel& channel, const KeySpan& span, std::size_t component) {
  const double t = span.fraction;
  const double t2 = t * t;
  const double t3 = t2 * t;
  const double leaving =
      span.length_s * number(channel, span.from, component, KeyPart::tangent_after);
  const double arriving =
      span.length_s * number(channel, span.to, component, KeyPart::tangent_before);
  return (2.0 * t3 - 3.0 * t2 + 1.0) * number(channel, span.from, component) +
         (t3 - 2.0 * t2 + t) * leaving +
         (3.0 * t2 - 2.0 * t3) * number(channel, span.to, component) + (t3 - t2) * arriving;
}

double interpolated(const Channel& channel, const KeySpan& span, std::size_t component) {
  const double from = number(channel, span.from, component);
  switch (channel.interpolation) {
    case Interpolation::step:
      break;
    case Interpolation::linear:
      return from + span.fraction * (number(channel, span.to, component) - from);
    case Interpolation::cubic_spline:
      return hermite(channel, span, component);
  }
  return from;
}

glm::dvec3 vector_at(const Channel& channel, const KeySpan& span) {
  return {interpolated(channel, span, 0), interpolated(channel, span, 1),
          interpolated(channel, span, 2)};
}

glm::dquat rotation_at(const Channel& channel, const KeySpan& span) {
  if (channel.interpolation == Interpolation::linear) {
    return glm::normalize(glm::slerp(rotation_of_key(channel, span.from),
                                     rotation_of_key(channel, span.to), span.fraction));
  }
  const glm::dvec3 axis = vector_at(channel, span);
  return glm::normalize(glm::dquat(interpolated(channel, span, 3), axis));
}

std::vector<double> weights_at(const Channel& channel, const KeySpan& span) {
  std::vector<double> weights(channel.components);
  for (std::size_t i = 0; i < weights.size(); ++i)
    weights[i] = interpolated(channel, span, i);
  return weights;
}

}  // namespace

std::map<std::uint32_t, NodePose> pose_at(const Animation& animation, double time_s) {
  std::map<std::uint32_t, NodePose> poses;
  for (const Channel& channel : animation.channels) {
    MESHER_ASSERT(!channel.times.empty());
    const KeySpan span = span_at(channel.times, time_s);
    NodePose& pose = poses[channel.node];
    switch (channel.property) {
      case NodeProperty::translation:
        pose.translation = vector_at(channel, span);
        break;
      case NodeProperty::rotation:
        pose.rotation = rotation_at(channel, span);
        break;
      case NodeProperty::scale:
        pose.scale = vector_at(channel, span);
        break;
      case NodeProperty::weights:
        pose.weights = weights_at(channel, span);
        break;
    }
  }
  return poses;
}

}  // namespace mesher::scene
