#include "engine/io/gltf_scene_graph.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "engine/io/format.h"
#include "engine/io/gltf_budget.h"
#include "engine/io/gltf_nodes.h"
#include "engine/io/gltf_pose.h"
#include "engine/scene/transform.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

std::string short_name(const GltfFile& gltf, const Json& object) {
  return std::string(gltf.text(object, "name").substr(0, kMaxNameBytes));
}

/// Returns the index of another object, which exists.
std::uint32_t checked_index(const GltfFile& gltf, const Json& object, const char* key,
                            const char* list) {
  const auto index = gltf.find_number(object, key);
  if (!index) return kNone;
  gltf.element(list, *index);
  return static_cast<std::uint32_t>(*index);
}

/// Reads only what the default scene refers to, so that mistakes in the rest do no harm.
class GraphReader {
 public:
  explicit GraphReader(GltfFile& gltf) : gltf_(gltf) {
    scene_.nodes.resize(gltf.count("nodes"));
    scene_.skins.resize(gltf.count("skins"));
    for (std::uint64_t i = 0; i < gltf.count("meshes"); ++i)
      scene_.meshes.push_back({.name = short_name(gltf, gltf.element("meshes", i))});
  }

  void add(std::uint32_t index) {
    const Json& json = gltf_.element("nodes", index);
    scene::Node& node = scene_.nodes[index];
    node.name = short_name(gltf_, json);
    node.to_parent = node_transform(gltf_, json);
    node.mesh = checked_index(gltf_, json, "mesh", "meshes");
    for (const std::uint64_t child : gltf_.index_list(json, "children")) {
      gltf_.element("nodes", child);
      scene_.nodes[child].parent = index;
      scene_.nodes[child].depth = node.depth + 1;
    }
    scene_.order.push_back(index);
    if (node.mesh == kNone) return;
    node.weights = morph_weights(gltf_, json);
    node.skin = checked_index(gltf_, json, "skin", "skins");
    if (node.skin != kNone) add_skin(scene_.skins[node.skin], node.skin);
    place(index, json);
  }
  scene::Scene take() { return std::move(scene_); }

 private:
  void add_skin(scene::Skin& skin, std::uint32_t index) {
    if (!skin.joints.empty()) return;
    skin = read_skin(gltf_, index);
    // Joints outside the scene follow no parent.
    for (const std::uint32_t joint : skin.joints)
      scene_.nodes[joint].to_parent = node_transform(gltf_, gltf_.element("nodes", joint));
  }

  void place(std::uint32_t index, const Json& json) {
    const auto instances = instance_transforms(gltf_, json, GltfBudget::kAlwaysAllowed);
    std::vector<scene::Placement>& placements = scene_.meshes[scene_.nodes[index].mesh].placements;
    if (!instances) placements.push_back({.node = index});
    if (!instances) return;
    for (const glm::dmat4& instance : *instances)
      placements.push_back({.node = index, .is_instance = true, .instance = instance});
  }

  GltfFile& gltf_;
  scene::Scene scene_;
};

void set_places(scene::Scene& scene) {
  const std::vector<glm::dmat4> nodes = node_transforms(scene);
  for (scene::SceneMesh& mesh : scene.meshes) {
    if (mesh.placements.empty()) continue;
    const glm::dmat4 first = first_transform(scene, mesh.placements.front(), nodes);
    if (scene::is_invertible(first)) mesh.to_scene = first;
  }
}

}  // namespace

scene::Scene read_scene_graph(GltfFile& gltf, const Progress* progress) {
  GraphReader reader(gltf);
  for (const PlacedNode& placed : placed_nodes(gltf, progress))
    reader.add(static_cast<std::uint32_t>(placed.node));
  scene::Scene scene = reader.take();
  if (scene.nodes.empty()) {
    for (scene::SceneMesh& mesh : scene.meshes)
      mesh.placements.emplace_back();
  }
  set_places(scene);
  return scene;
}

}  // namespace mesher::io
