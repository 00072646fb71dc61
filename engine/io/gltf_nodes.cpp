#include "engine/io/gltf_nodes.h"

#include <nlohmann/json.hpp>

#include "engine/io/gltf_pose.h"

namespace mesher::io {
namespace {

std::vector<std::uint64_t> roots_of(const GltfFile& gltf) {
  if (gltf.count("scenes") > 0) {
    const std::uint64_t scene = gltf.find_number(gltf.root(), "scene").value_or(0);
    return gltf.index_list(gltf.element("scenes", scene), "nodes");
  }
  std::vector<bool> is_child(gltf.count("nodes"), false);
  for (std::uint64_t node = 0; node < is_child.size(); ++node) {
    for (const std::uint64_t child : gltf.index_list(gltf.element("nodes", node), "children")) {
      if (child < is_child.size()) is_child[child] = true;
    }
  }
  std::vector<std::uint64_t> list;
  for (std::uint64_t node = 0; node < is_child.size(); ++node) {
    if (!is_child[node]) list.push_back(node);
  }
  return list;
}

}  // namespace

std::vector<PlacedNode> placed_nodes(const GltfFile& gltf, const Progress* progress) {
  std::vector<PlacedNode> placed;
  std::vector<bool> is_visited(gltf.count("nodes"), false);
  // Not recursive, because files can nest to any depth.
  std::vector<PlacedNode> stack;
  const auto push = [&](const std::vector<std::uint64_t>& nodes, const glm::dmat4& to_world) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
      stack.push_back({*node, to_world});
  };
  push(roots_of(gltf), glm::dmat4(1.0));
  while (!stack.empty()) {
    check_cancelled(progress);
    const PlacedNode at = stack.back();
    stack.pop_back();
    const GltfFile::Json& node = gltf.element("nodes", at.node);
    if (is_visited[at.node]) gltf.fail("the nodes do not form a tree");
    is_visited[at.node] = true;
    const glm::dmat4 to_world = at.to_world * local_transform(gltf, node);
    placed.push_back({at.node, to_world});
    push(gltf.index_list(node, "children"), to_world);
  }
  return placed;
}

}  // namespace mesher::io
