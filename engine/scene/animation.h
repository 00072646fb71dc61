#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mesher::scene {

/// How the values between two keys follow from the keys, as in glTF 2.0, appendix C.
enum class Interpolation : std::uint8_t {
  step,          ///< the value of the earlier key holds
  linear,        ///< rotations take the shorter way around the sphere, at constant speed
  cubic_spline,  ///< a cubic Hermite spline through the values, with a tangent on each side
};

/// What a channel changes of its node.
enum class NodeProperty : std::uint8_t { translation, rotation, scale, weights };

/// The values of one property of a node over time.
///
/// Valid if there is a key, the times are finite and each is later than the one before, and
/// `values` has `components` numbers per key, or three times as many for a cubic spline.
struct Channel {
  std::uint32_t node = 0;
  NodeProperty property = NodeProperty::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;  ///< of the keys, in seconds
  /// Key by key. A rotation is x, y, z, w. A key of a cubic spline is the tangent before it, its
  /// value, and the tangent after it; tangents are in units per second.
  std::vector<float> values;
  /// Numbers per value: 3, 4 for rotations, the number of morph targets for weights.
  std::uint32_t components = 3;
};

struct Animation {
  std::string name;         ///< may be empty
  double duration_s = 0.0;  ///< the time of its last key
  std::vector<Channel> channels;
};

/// The properties of a node at a moment; unset ones are not animated.
struct NodePose {
  std::optional<glm::dvec3> translation;
  std::optional<glm::dquat> rotation;  ///< of length 1
  std::optional<glm::dvec3> scale;
  std::optional<std::vector<double>> weights;  ///< of the morph targets
};

/// Returns the poses of the animated nodes at a time. Before the first key of a channel and after
/// its last one, the values of these keys hold. If several channels change one property of a node,
/// the last one counts. Pre: the channels are valid; the time is not NaN.
/// O(channels * log keys).
std::map<std::uint32_t, NodePose> pose_at(const Animation& animation, double time_s);

}  // namespace mesher::scene
