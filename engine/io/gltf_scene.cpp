#include "engine/io/gltf_scene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/io/gltf_budget.h"
#include "engine/io/gltf_contents.h"
#include "engine/io/gltf_mesh.h"
#include "engine/io/gltf_packed.h"
#include "engine/io/gltf_scene_graph.h"
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

}  // namespace

GltfScene::GltfScene(const std::filesystem::path& file, const ReadOptions& options, Keep keep)
    : file_(file, options.progress, keep), gltf_(file_, options.progress) {
  const GltfFile::Reports reports(gltf_, options.progress);
  check_required_extensions(gltf_);
  note_contents(gltf_, contents_);
  graph_ = read_scene_graph(gltf_, options.progress);
  for (const scene::SceneMesh& mesh : graph_.meshes) {
    contents_[Content::instances] += static_cast<std::uint64_t>(
        std::ranges::count_if(mesh.placements, &scene::Placement::is_instance));
  }
}

std::vector<GltfSceneMesh> GltfScene::read_meshes(const ReadOptions& options) {
  const GltfFile::Reports reports(gltf_, options.progress);
  return read_unchanged(gltf_, [&] { return read_meshes_once(options); });
}

std::vector<GltfSceneMesh> GltfScene::read_meshes_once(const ReadOptions& options) {
  PackedPrimitives packed;
  GltfBudget budget;
  std::vector<GltfSceneMesh> meshes;
  std::vector<double> weights;
  for (std::uint64_t i = 0; i < gltf_.count("meshes"); ++i)
    weights.push_back(mesh_work(gltf_, i));
  const std::vector<glm::dmat4> nodes = node_transforms(graph_);
  Stages stages(options.progress, weights);
  for (std::uint64_t i = 0; i < gltf_.count("meshes"); ++i) {
    stages.next();
    GltfSceneMesh mesh{.index = i, .model = read_gltf_mesh(gltf_, packed, budget, i, options)};
    if (mesh.model.mesh.face_count() == 0) continue;
    const std::vector<scene::Placement>& placements = graph_.meshes[i].placements;
    mesh.placements = graph_.order.empty() ? 0 : placements.size();
    double scale = 0.0;
    for (const scene::Placement& placement : placements)
      scale = std::max(scale, stretch(first_transform(graph_, placement, nodes)));
    if (scale > 0.0) mesh.scale = scale;
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

Box GltfScene::bounds(const std::vector<GltfSceneMesh>& meshes) const {
  const std::vector<glm::dmat4> nodes = node_transforms(graph_);
  const bool shows_any =
      std::ranges::any_of(meshes, [](const GltfSceneMesh& mesh) { return mesh.placements > 0; });
  Box box;
  for (const GltfSceneMesh& mesh : meshes) {
    const Box own = bounding_box(mesh.model.mesh);
    if (!shows_any) extend(box, own, glm::dmat4(1.0));
    for (const scene::Placement& placement : graph_.meshes[mesh.index].placements)
      extend(box, own, first_transform(graph_, placement, nodes));
  }
  return box;
}

}  // namespace mesher::io
