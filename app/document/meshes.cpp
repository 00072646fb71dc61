#include "app/document/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace mesher::app {
namespace {

/// Calls `visit` with a node and everything below it, parents first.
template <class Visit>
void for_each_below(const scene::Scene& scene, std::uint32_t node, const Visit& visit) {
  std::vector<bool> is_below(scene.nodes.size(), false);
  is_below[node] = true;
  for (const std::uint32_t other : scene.order) {
    const std::uint32_t parent = scene.nodes[other].parent;
    if (parent != kNone && is_below[parent]) is_below[other] = true;
    if (is_below[other]) visit(other);
  }
}

/// No node is hidden if the list says so of none, so that equal views have equal lists.
void clear_if_all_shown(scene::HiddenNodes& hidden) {
  if (std::ranges::find(hidden, true) == hidden.end()) hidden.clear();
}

}  // namespace

bool has_mesh(const Document& document, std::uint32_t mesh) {
  if (mesh == kNone) return true;
  const scene::Scene* const scene = document.model.scene.get();
  return scene != nullptr && mesh < scene->meshes.size() && scene->meshes[mesh].has_faces;
}

std::vector<std::uint32_t> face_counts(const Attributes& attributes, std::size_t meshes) {
  std::vector<std::uint32_t> of_group(attributes.groups.size(), 0);
  for (const std::uint32_t group : attributes.group)
    ++of_group[group];
  std::vector<std::uint32_t> counts(meshes, 0);
  for (std::size_t g = 0; g < of_group.size(); ++g) {
    const std::uint32_t mesh = attributes.groups[g].mesh;
    if (mesh < meshes) counts[mesh] += of_group[g];
  }
  return counts;
}

std::uint32_t face_count_of(const Attributes& attributes, std::uint32_t mesh) {
  return face_counts(attributes, std::size_t{mesh} + 1)[mesh];
}

std::vector<std::uint32_t> nodes_with_faces(const scene::Scene& scene) {
  std::vector<bool> leads(scene.nodes.size(), false);
  // Parents come before what is below them.
  for (auto node = scene.order.rbegin(); node != scene.order.rend(); ++node) {
    const scene::Node& own = scene.nodes[*node];
    if (own.mesh != kNone && scene.meshes[own.mesh].has_faces) leads[*node] = true;
    if (leads[*node] && own.parent != kNone) leads[own.parent] = true;
  }
  std::vector<std::uint32_t> nodes;
  std::ranges::copy_if(scene.order, std::back_inserter(nodes),
                       [&](std::uint32_t node) { return leads[node]; });
  return nodes;
}

std::string mesh_name(const scene::Scene& scene, std::uint32_t mesh) {
  const std::string& name = scene.meshes[mesh].name;
  return name.empty() ? fmt::format("mesh {}", mesh) : name;
}

void choose_mesh(Document& document, std::uint32_t mesh) {
  document.chosen_mesh = mesh;
  document.notice =
      mesh == kNone ? "edits apply to all meshes"
                    : fmt::format("edits apply to {} only", mesh_name(*document.model.scene, mesh));
}

void show_node(Document& document, std::uint32_t node, bool is_shown) {
  const scene::Scene& scene = *document.model.scene;
  document.hidden.resize(scene.nodes.size(), false);
  for_each_below(scene, node, [&](std::uint32_t below) { document.hidden[below] = !is_shown; });
  clear_if_all_shown(document.hidden);
}

void isolate_node(Document& document, std::uint32_t node) {
  const scene::Scene& scene = *document.model.scene;
  document.hidden.assign(scene.nodes.size(), true);
  for_each_below(scene, node, [&](std::uint32_t below) { document.hidden[below] = false; });
  clear_if_all_shown(document.hidden);
}

void show_all_nodes(Document& document) {
  document.hidden.clear();
}

void isolate_chosen(Document& document) {
  const scene::Scene& scene = *document.model.scene;
  document.hidden.assign(scene.nodes.size(), true);
  for (const scene::Placement& placement : scene.meshes[document.chosen_mesh].placements) {
    if (placement.node != kNone) document.hidden[placement.node] = false;
  }
  clear_if_all_shown(document.hidden);
}

const char* need_chosen(const Document& document) {
  return document.chosen_mesh == kNone ? "choose a mesh in the list of the scene first" : nullptr;
}

const char* need_hidden(const Document& document) {
  return document.hidden.empty() ? "nothing is hidden" : nullptr;
}

}  // namespace mesher::app
