#include "engine/io/gltf_scene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "engine/io/gltf_budget.h"
#include "engine/io/gltf_contents.h"
#include "engine/io/gltf_mesh.h"
#include "engine/io/gltf_nodes.h"
#include "engine/io/gltf_packed.h"
#include "engine/io/gltf_pose.h"
#include "engine/mesh/statistics.h"

namespace mesher::io {
namespace {

/// Returns the largest factor by which a transform stretches an axis.
double stretch(const glm::dmat4& transform) {
  double most = 0.0;
  for (int i = 0; i < 3; ++i)
    most = std::max(most, glm::length(glm::dvec3(transform[i])));
  return most;
}

void extend(Box& box, const Box& by, const glm::dmat4& transform) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1U) != 0 ? by.max.x : by.min.x,
                       (corner & 2U) != 0 ? by.max.y : by.min.y,
                       (corner & 4U) != 0 ? by.max.z : by.min.z, 1.0);
    const glm::vec3 q(transform * p);
    box = box.is_empty() ? Box{q, q} : Box{glm::min(box.min, q), glm::max(box.max, q)};
  }
}

}  // namespace

GltfScene::GltfScene(const std::filesystem::path& file, const ReadOptions& options)
    : file_(file, options.progress), gltf_(file_, options.progress) {
  check_required_extensions(gltf_);
  note_contents(gltf_, contents_);
  find_placements(options.progress);
}

void GltfScene::find_placements(const Progress* progress) {
  uses_.resize(gltf_.count("meshes"));
  NodeTransforms transforms;
  const std::vector<PlacedNode> nodes = placed_nodes(gltf_, progress);
  for (const PlacedNode& placed : nodes)
    transforms[placed.node] = placed.to_world;
  for (const PlacedNode& placed : nodes) {
    const GltfFile::Json& node = gltf_.element("nodes", placed.node);
    const auto mesh = gltf_.find_number(node, "mesh");
    if (!mesh) continue;
    const auto instances = instance_transforms(gltf_, node, GltfBudget::kAlwaysAllowed);
    // The transform of the node of a skinned mesh does not count.
    glm::dmat4 to_world = placed.to_world;
    if (const auto skin = gltf_.find_number(node, "skin")) {
      const auto joints = joint_transforms(gltf_, *skin, transforms);
      if (!joints.empty()) to_world = joints.front();
    }
    if (!instances) {
      place(*mesh, to_world);
      continue;
    }
    contents_[Content::instances] += instances->size();
    for (const glm::dmat4& instance : *instances)
      place(*mesh, to_world * instance);
  }
}

void GltfScene::place(std::uint64_t mesh, const glm::dmat4& to_world) {
  gltf_.element("meshes", mesh);
  placements_.push_back({mesh, to_world});
  Use& use = uses_[mesh];
  ++use.count;
  use.scale = std::max(use.scale, stretch(to_world));
}

std::vector<GltfSceneMesh> GltfScene::read_meshes(const ReadOptions& options) {
  PackedPrimitives packed;
  GltfBudget budget;
  std::vector<GltfSceneMesh> meshes;
  std::vector<double> weights;
  for (std::uint64_t i = 0; i < gltf_.count("meshes"); ++i)
    weights.push_back(mesh_work(gltf_, i));
  Stages stages(options.progress, weights);
  for (std::uint64_t i = 0; i < gltf_.count("meshes"); ++i) {
    stages.next();
    GltfSceneMesh mesh{.index = i, .model = read_gltf_mesh(gltf_, packed, budget, i, options)};
    if (mesh.model.mesh.face_count() == 0) continue;
    mesh.placements = uses_[i].count;
    if (uses_[i].scale > 0.0) mesh.scale = uses_[i].scale;
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

Box GltfScene::bounds(const std::vector<GltfSceneMesh>& meshes) const {
  Box box;
  std::unordered_map<std::uint64_t, Box> own;
  for (const GltfSceneMesh& mesh : meshes) {
    own[mesh.index] = bounding_box(mesh.model.mesh);
    if (placements_.empty()) extend(box, own[mesh.index], glm::dmat4(1.0));
  }
  for (const Placement& placement : placements_) {
    const auto found = own.find(placement.mesh);
    if (found != own.end()) extend(box, found->second, placement.to_world);
  }
  return box;
}

}  // namespace mesher::io
