#include "engine/io/gltf_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/io/gltf_budget.h"
#include "engine/mesh/contents.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

/// A property of a node that glTF animates.
struct AnimatedProperty {
  std::string_view path;
  scene::NodeProperty property;
  std::uint32_t components;  ///< of the accessor
};
constexpr AnimatedProperty kAnimatedProperties[] = {
    {"translation", scene::NodeProperty::translation, 3},
    {"rotation", scene::NodeProperty::rotation, 4},
    {"scale", scene::NodeProperty::scale, 3},
    {"weights", scene::NodeProperty::weights, 1}};

constexpr std::pair<std::string_view, scene::Interpolation> kInterpolations[] = {
    {"", scene::Interpolation::linear},
    {"LINEAR", scene::Interpolation::linear},
    {"STEP", scene::Interpolation::step},
    {"CUBICSPLINE", scene::Interpolation::cubic_spline}};

const AnimatedProperty* animated_property(std::string_view path) {
  const auto* const found = std::ranges::find(kAnimatedProperties, path, &AnimatedProperty::path);
  return found == std::end(kAnimatedProperties) ? nullptr : found;
}

class AnimationReader {
 public:
  explicit AnimationReader(GltfFile& gltf) : gltf_(gltf) {}

  scene::Animation read(std::uint64_t index) {
    const Json& json = gltf_.element("animations", index);
    const Json& channels = list_in(json, "channels");
    const Json& samplers = list_in(json, "samplers");
    scene::Animation animation{.name = std::string(gltf_.text(json, "name"))};
    for (const Json& channel : channels) {
      auto read = read_channel(channel, samplers);
      if (!read) continue;
      const auto end_s = static_cast<double>(read->times.back());
      animation.duration_s = std::max(animation.duration_s, end_s);
      animation.channels.push_back(std::move(*read));
    }
    return animation;
  }

 private:
  const Json& list_in(const Json& animation, const char* key) const {
    const auto list = animation.find(key);
    if (list == animation.end() || !list->is_array()) {
      gltf_.fail(fmt::format("an animation has no {}", key));
    }
    return *list;
  }

  /// Returns nothing for a channel that is left out.
  std::optional<scene::Channel> read_channel(const Json& json, const Json& samplers) {
    const auto target = json.find("target");
    if (target == json.end() || !target->is_object()) gltf_.fail("a channel has no target");
    const AnimatedProperty* const property = animated_property(gltf_.text(*target, "path"));
    const auto node = gltf_.find_number(*target, "node");
    if (property == nullptr || !node) return std::nullopt;
    const Json& node_json = gltf_.element("nodes", *node);
    const auto sampler = gltf_.find_number(json, "sampler");
    if (!sampler || *sampler >= samplers.size()) gltf_.fail("a channel's sampler is out of range");
    scene::Channel channel = read_sampler(samplers[*sampler], *property);
    channel.node = static_cast<std::uint32_t>(*node);
    const bool is_weights = property->property == scene::NodeProperty::weights;
    if (channel.components != (is_weights ? target_count(node_json) : property->components)) {
      gltf_.fail("an animation's times and values have different lengths");
    }
    return channel;
  }

  /// Reads keys. The number of components follows from the number of values.
  scene::Channel read_sampler(const Json& json, const AnimatedProperty& property) {
    scene::Channel channel;
    channel.property = property.property;
    channel.interpolation = interpolation_of(json);
    channel.times = values_of(json, "input", 1);
    check_times(channel.times);
    channel.values = values_of(json, "output", property.components);
    const bool is_spline = channel.interpolation == scene::Interpolation::cubic_spline;
    const std::size_t per_component = channel.times.size() * (is_spline ? 3 : 1);
    const bool is_whole = channel.values.size() % per_component == 0;
    channel.components =
        is_whole ? static_cast<std::uint32_t>(channel.values.size() / per_component) : 0;
    if (channel.components == 0) {
      gltf_.fail("an animation's times and values have different lengths");
    }
    return channel;
  }

  scene::Interpolation interpolation_of(const Json& sampler) const {
    const std::string_view name = gltf_.text(sampler, "interpolation");
    for (const auto& [known, interpolation] : kInterpolations) {
      if (name == known) return interpolation;
    }
    gltf_.fail("an animation has an unknown interpolation");
  }

  std::vector<float> values_of(const Json& sampler, const char* key, std::size_t components) {
    const auto index = gltf_.find_number(sampler, key);
    if (!index) gltf_.fail(fmt::format("an animation has no {}", key));
    const GltfFile::Accessor accessor = gltf_.open_accessor(*index);
    if (accessor.components != components) {
      gltf_.fail("an animation's accessor has the wrong type");
    }
    budget_.spend(gltf_, accessor.count * components);
    const Array<float> values = gltf_.floats(*index, components, 0, accessor.count);
    return {values.begin(), values.end()};
  }

  void check_times(const std::vector<float>& times) const {
    if (times.empty()) gltf_.fail("an animation has no keys");
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1])) {
        gltf_.fail("the times of an animation do not rise");
      }
    }
  }

  /// Returns the number of morph targets of a node's mesh.
  std::size_t target_count(const Json& node) const {
    const auto mesh = gltf_.find_number(node, "mesh");
    if (!mesh) return 0;
    const Json& json = gltf_.element("meshes", *mesh);
    const auto primitives = json.find("primitives");
    if (primitives == json.end() || !primitives->is_array() || primitives->empty()) return 0;
    const Json& first = primitives->front();
    const auto targets = first.find("targets");
    return targets != first.end() && targets->is_array() ? targets->size() : 0;
  }

  GltfFile& gltf_;
  GltfBudget budget_{"its animations repeat their data too often for the size of the file"};
};

/// Returns the animations of a document for a message: `0 "Walk", 1 "Run"`.
std::string animation_list(const GltfFile& gltf) {
  constexpr std::size_t kMostShownBytes = 64;  // of a name
  const std::size_t count = gltf.count("animations");
  std::string list;
  for (std::size_t i = 0; i < std::min(count, FileContents::kMostNames); ++i) {
    const std::string_view name = gltf.text(gltf.element("animations", i), "name");
    list += fmt::format("{}{} \"{}\"", i > 0 ? ", " : "", i,
                        FileContents::readable(name.substr(0, kMostShownBytes)));
  }
  return count > FileContents::kMostNames ? list + ", ..." : list;
}

/// Returns the index of the animation that a person names.
std::uint64_t find_animation(const GltfFile& gltf, const std::string& word) {
  const std::size_t count = gltf.count("animations");
  if (count == 0) gltf.fail("has no animations");
  for (std::size_t i = 0; i < count && !word.empty(); ++i) {
    if (gltf.text(gltf.element("animations", i), "name") == word) return i;
  }
  std::uint64_t index = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, index);
  if (error == std::errc() && stop == end && index < count) return index;
  const std::string missing =
      word.empty() ? "" : fmt::format("has no animation \"{}\"; ", FileContents::readable(word));
  gltf.fail(missing + "its animations are " + animation_list(gltf));
}

void set_pose(Json& node, const scene::NodePose& pose) {
  if (pose.translation || pose.rotation || pose.scale) node.erase("matrix");
  if (const auto& t = pose.translation) node["translation"] = {t->x, t->y, t->z};
  if (const auto& q = pose.rotation) node["rotation"] = {q->x, q->y, q->z, q->w};
  if (const auto& s = pose.scale) node["scale"] = {s->x, s->y, s->z};
  if (pose.weights) node["weights"] = *pose.weights;
}

}  // namespace

std::vector<scene::Animation> read_gltf_animations(GltfFile& gltf) {
  AnimationReader reader(gltf);
  std::vector<scene::Animation> animations;
  for (std::uint64_t i = 0; i < gltf.count("animations"); ++i)
    animations.push_back(reader.read(i));
  return animations;
}

void pose_gltf(GltfFile& gltf, const PoseChoice& choice) {
  const std::uint64_t index = find_animation(gltf, choice.animation);
  const scene::Animation animation = AnimationReader(gltf).read(index);
  for (const auto& [node, pose] : scene::pose_at(animation, choice.time_s))
    set_pose(gltf.mutable_node(node), pose);
}

}  // namespace mesher::io
