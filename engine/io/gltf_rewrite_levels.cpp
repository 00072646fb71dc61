#include <string>
#include <utility>
#include <vector>

#include "engine/io/gltf_rewrite.h"

namespace mesher::io {

void GltfRewriter::find_nodes_of_meshes() {
  for (std::size_t n = 0; n < gltf_.count("nodes"); ++n) {
    if (const auto mesh = gltf_.find_number(gltf_.element("nodes", n), "mesh"))
      nodes_of_mesh_[*mesh].push_back(n);
  }
}

/// Adds a mesh for each further level, and nodes that show it. A node with children shows its mesh
/// by a child of its own, because a level stands for the node with all below it.
void GltfRewriter::add_levels(const GltfMeshEdit& edit) {
  const Json original = gltf_.element("meshes", edit.mesh);
  std::vector<std::size_t> meshes;
  for (std::size_t i = 1; i < edit.levels.size(); ++i) {
    Json mesh = original;
    if (mesh.contains("name") && mesh["name"].is_string())
      mesh["name"] = mesh["name"].get<std::string>() + "_lod" + std::to_string(i);
    set_primitives(mesh["primitives"], edit.levels[i]);
    document_["meshes"].push_back(std::move(mesh));
    meshes.push_back(document_["meshes"].size() - 1);
  }
  for (const std::size_t n : nodes_of_mesh_[edit.mesh]) {
    if (gltf_.extension(gltf_.element("nodes", n), "MSFT_lod") != nullptr) {
      losses_.emplace_back("new levels of a node that has levels already");
      continue;
    }
    add_node_levels(n, edit, meshes);
  }
}

void GltfRewriter::add_node_levels(std::size_t node, const GltfMeshEdit& edit,
                                   const std::vector<std::size_t>& meshes) {
  Json& nodes = document_["nodes"];
  Json shown = Json::object();  // what a node needs to show a mesh
  for (const char* key : {"mesh", "skin", "weights"}) {
    if (nodes[node].contains(key)) shown[key] = nodes[node][key];
  }
  constexpr const char* kInstances = "EXT_mesh_gpu_instancing";
  if (gltf_.extension(gltf_.element("nodes", node), kInstances) != nullptr)
    shown["extensions"][kInstances] = nodes[node]["extensions"][kInstances];
  std::size_t at = node;
  if (nodes[node].contains("children")) {
    nodes.push_back(shown);
    at = nodes.size() - 1;
    nodes[node]["children"].push_back(at);
    for (const char* key : {"mesh", "skin", "weights"})
      nodes[node].erase(key);
    if (shown.contains("extensions")) nodes[node]["extensions"].erase(kInstances);
    if (nodes[node].contains("extensions") && nodes[node]["extensions"].empty())
      nodes[node].erase("extensions");
  }
  Json coverage = Json::array({edit.levels.front().least_coverage});
  Json ids = Json::array();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    shown["mesh"] = meshes[i];
    if (nodes[node].contains("name") && nodes[node]["name"].is_string())
      shown["name"] = nodes[node]["name"].get<std::string>() + "_lod" + std::to_string(i + 1);
    // A level takes the place of the node, which may stand anywhere.
    if (at == node) {
      for (const char* key : {"matrix", "translation", "rotation", "scale"}) {
        if (nodes[node].contains(key)) shown[key] = nodes[node][key];
      }
    }
    nodes.push_back(shown);
    ids.push_back(nodes.size() - 1);
    coverage.push_back(edit.levels[i + 1].least_coverage);
  }
  animate_levels(node, at, ids);
  nodes[at]["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
  if (!nodes[at].contains("extras") || nodes[at]["extras"].is_object())
    nodes[at]["extras"]["MSFT_screencoverage"] = std::move(coverage);
}

/// Repeats the channels that move a node for its levels, which take its place. If the node shows
/// its mesh by a child, `at`, the child and its levels follow the node anyway, and only the weights
/// of morph targets move on to them.
void GltfRewriter::animate_levels(std::size_t node, std::size_t at, const Json& levels) {
  const auto animations = document_.find("animations");
  if (animations == document_.end() || !animations->is_array()) return;
  for (Json& animation : *animations) {
    if (!animation.is_object() || !animation.contains("channels")) continue;
    Json& channels = animation["channels"];
    if (!channels.is_array()) continue;
    const std::size_t count = channels.size();
    for (std::size_t c = 0; c < count; ++c) {
      const Json target = channels[c].is_object() ? channels[c].value("target", Json()) : Json();
      if (!target.is_object() || target.value("node", Json()) != Json(node)) continue;
      const bool is_of_mesh = target.value("path", Json()) == Json("weights");
      if (at != node && !is_of_mesh) continue;
      channels[c]["target"]["node"] = at;
      for (const Json& level : levels) {
        Json channel = channels[c];
        channel["target"]["node"] = level;
        channels.push_back(std::move(channel));
      }
    }
  }
}

}  // namespace mesher::io
