#include "engine/scene/placed.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/mesh/parts.h"
#include "engine/scene/influences.h"
#include "engine/scene/morph.h"
#include "engine/scene/transform.h"

namespace mesher::scene {
namespace {

bool is_hidden(const HiddenNodes& hidden, const Placement& placement) {
  return placement.node != kNone && placement.node < hidden.size() && hidden[placement.node];
}

void name_objects(const std::string& name, Attributes& attributes) {
  if (name.empty()) return;
  for (FaceGroup& group : attributes.groups)
    group.object = name;
}

/// Returns whether each mesh with faces is shown at exactly one place.
bool is_one_to_one(const Scene& scene, const HiddenNodes& hidden) {
  return std::ranges::all_of(scene.meshes, [&](const SceneMesh& mesh) {
    return !mesh.has_faces ||
           (mesh.placements.size() == 1 && !is_hidden(hidden, mesh.placements.front()));
  });
}

Copies same_elements(const Mesh& mesh, const Attributes& attributes, const Scene& scene) {
  Copies copies{.shape = {mesh, attributes}, .keeps_elements = true};
  std::vector<std::uint32_t> copy_of_mesh(scene.meshes.size(), kNone);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    if (!scene.meshes[m].has_faces) continue;
    copy_of_mesh[m] = static_cast<std::uint32_t>(copies.list.size());
    copies.list.push_back({.mesh = m});
  }
  copies.of_vertex.assign(mesh.vertex_count(), kNone);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const std::uint32_t group = attributes.group[h / 3];
    copies.of_vertex[mesh.origin(Halfedge(h)).index()] =
        copy_of_mesh[attributes.groups[group].mesh];
  }
  return copies;
}

/// Returns the number of faces of all copies that are shown.
std::uint64_t copied_faces(const Attributes& attributes, const Scene& scene,
                           const HiddenNodes& hidden) {
  std::vector<std::uint64_t> places(scene.meshes.size(), 0);
  for (std::size_t m = 0; m < places.size(); ++m) {
    places[m] = static_cast<std::uint64_t>(std::ranges::count_if(
        scene.meshes[m].placements,
        [&](const Placement& placement) { return !is_hidden(hidden, placement); }));
  }
  std::uint64_t faces = 0;
  for (const std::uint32_t group : attributes.group)
    faces += places[attributes.groups[group].mesh];
  return faces;
}

Copies copied_elements(const Mesh& mesh, const Attributes& attributes, const Scene& scene,
                       const HiddenNodes& hidden) {
  const std::vector<glm::dmat4> nodes = node_transforms(scene);
  const std::vector<Shape> parts =
      split(mesh, attributes, mesh_of_groups(attributes), scene.meshes.size());
  const std::uint64_t faces = copied_faces(attributes, scene, hidden);
  FaceLimit::check(faces, "the scene ");
  const bool shows_all = faces <= kMostCopiedFaces;
  Copies copies;
  std::vector<Shape> shapes;
  for (std::uint32_t m = 0; m < parts.size(); ++m) {
    const std::vector<Placement>& placements = scene.meshes[m].placements;
    bool is_shown = false;
    for (std::uint32_t p = 0; p < placements.size() && parts[m].mesh.face_count() > 0; ++p) {
      if (is_hidden(hidden, placements[p]) || (is_shown && !shows_all)) continue;
      is_shown = true;
      Shape& copy = shapes.emplace_back(parts[m]);
      const glm::dmat4 first = palette(scene, scene.meshes[m], placements[p], nodes).front();
      if (glm::determinant(glm::dmat3(first)) < 0.0) turn_over(copy);
      if (placements[p].node != kNone)
        name_objects(scene.nodes[placements[p].node].name, copy.attributes);
      copies.of_vertex.resize(copies.of_vertex.size() + copy.mesh.vertex_count(),
                              static_cast<std::uint32_t>(copies.list.size()));
      copies.list.push_back({.mesh = m, .placement = p});
    }
  }
  if (!shapes.empty()) copies.shape = joined(std::move(shapes));
  return copies;
}

/// Returns the transform of each vertex: that of its copy, or the mean of its joints.
std::vector<glm::dmat4> vertex_transforms(const Copies& copies,
                                          const std::vector<std::vector<glm::dmat4>>& palettes) {
  const Influences influences = influences_of(copies.shape);
  std::vector<glm::dmat4> transforms(copies.of_vertex.size(), glm::dmat4(1.0));
  for (std::uint32_t v = 0; v < transforms.size(); ++v) {
    if (copies.of_vertex[v] == kNone) continue;
    const std::vector<glm::dmat4>& own = palettes[copies.of_vertex[v]];
    transforms[v] = own.front();
    if (own.size() == 1 || influences.per_vertex == 0) continue;
    glm::dmat4 mean(0.0);
    for (const auto& [joint, weight] : influences.of(Vertex(v)))
      mean += double(weight) * own[joint < own.size() ? joint : 0];
    transforms[v] = mean;
  }
  return transforms;
}

void move_vertices(const std::vector<glm::dmat4>& transforms, Shape& shape) {
  MeshArrays arrays = MeshArrays::take(std::move(shape.mesh));
  for (std::size_t v = 0; v < transforms.size(); ++v) {
    if (transforms[v] == glm::dmat4(1.0)) continue;  // preserves every bit
    const glm::vec3 p(transforms[v] * glm::dvec4(glm::dvec3(arrays.position[v]), 1.0));
    if (is_finite(p)) arrays.position[v] = p;
  }
  shape.mesh = std::move(arrays).finish();
  const std::uint32_t vertices = shape.mesh.vertex_count();
  for (AttributeLayer& layer : shape.attributes.layers) {
    if (!has_direction(layer.type())) continue;
    for (std::uint32_t w = 0; w < layer.count(); ++w) {
      const glm::dmat3 linear(transforms[shape.attributes.vertex(Wedge(w), vertices).index()]);
      if (linear != glm::dmat3(1.0)) transform_value(linear, layer, w);
    }
  }
}

}  // namespace

std::vector<std::uint32_t> mesh_of_groups(const Attributes& attributes) {
  std::vector<std::uint32_t> meshes;
  for (const FaceGroup& group : attributes.groups)
    meshes.push_back(group.mesh);
  return meshes;
}

Shape with_mesh(const Shape& shape, std::size_t meshes, std::uint32_t mesh, Shape&& replacement) {
  std::vector<Shape> parts =
      split(shape.mesh, shape.attributes, mesh_of_groups(shape.attributes), meshes);
  parts[mesh] = std::move(replacement);
  return joined(std::move(parts));
}

Shape mesh_of(const Shape& shape, std::size_t meshes, std::uint32_t mesh) {
  return std::move(
      split(shape.mesh, shape.attributes, mesh_of_groups(shape.attributes), meshes)[mesh]);
}

bool differs_from_model(const Scene& scene, const HiddenNodes& hidden) {
  const std::vector<glm::dmat4> nodes = node_transforms(scene);
  return std::ranges::any_of(scene.meshes, [&](const SceneMesh& mesh) {
    if (!mesh.has_faces) return false;
    if (mesh.placements.size() != 1) return true;
    const Placement& placement = mesh.placements.front();
    const std::vector<double> weights = target_weights(scene, placement);
    return is_hidden(hidden, placement) ||
           std::ranges::any_of(weights, [](double weight) { return weight != 0.0; }) ||
           std::ranges::any_of(palette(scene, mesh, placement, nodes),
                               [](const glm::dmat4& m) { return m != glm::dmat4(1.0); });
  });
}

Copies copies_of(const Mesh& mesh, const Attributes& attributes, const Scene& scene,
                 const HiddenNodes& hidden) {
  return is_one_to_one(scene, hidden) ? same_elements(mesh, attributes, scene)
                                      : copied_elements(mesh, attributes, scene, hidden);
}

std::vector<std::vector<glm::dmat4>> palettes_of(const Copies& copies, const Scene& scene,
                                                 const NodePoses& poses) {
  const std::vector<glm::dmat4> nodes = node_transforms(scene, poses);
  std::vector<std::vector<glm::dmat4>> palettes;
  for (const Copies::Copy& copy : copies.list) {
    const SceneMesh& mesh = scene.meshes[copy.mesh];
    palettes.push_back(palette(scene, mesh, mesh.placements[copy.placement], nodes));
  }
  return palettes;
}

std::vector<std::vector<double>> target_weights_of(const Copies& copies, const Scene& scene,
                                                   const NodePoses& poses) {
  std::vector<std::vector<double>> weights;
  for (const Copies::Copy& copy : copies.list)
    weights.push_back(
        target_weights(scene, scene.meshes[copy.mesh].placements[copy.placement], poses));
  return weights;
}

void pose(const Scene& scene, const NodePoses& poses, Copies& copies) {
  add_targets(target_weights_of(copies, scene, poses), copies);
  move_vertices(vertex_transforms(copies, palettes_of(copies, scene, poses)), copies.shape);
}

Shape placed(const Mesh& mesh, const Attributes& attributes, const Scene& scene,
             const HiddenNodes& hidden) {
  if (!is_one_to_one(scene, hidden) && copied_faces(attributes, scene, hidden) > kMostCopiedFaces)
    throw DeviceError("the instances of the scene have too many faces to write each of them");
  Copies copies = copies_of(mesh, attributes, scene, hidden);
  pose(scene, {}, copies);
  return std::move(copies.shape);
}

Box bounds(const Mesh& mesh, const Attributes& attributes, const Scene& scene,
           const HiddenNodes& hidden) {
  std::vector<Box> own(scene.meshes.size());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Box& box = own[attributes.groups[attributes.group[f]].mesh];
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      extend(box, mesh.position(mesh.origin(Mesh::halfedge(Face(f), corner))));
  }
  const std::vector<glm::dmat4> nodes = node_transforms(scene);
  Box all;
  for (std::size_t m = 0; m < own.size(); ++m) {
    if (own[m].is_empty()) continue;
    for (const Placement& placement : scene.meshes[m].placements) {
      if (is_hidden(hidden, placement)) continue;
      for (const glm::dmat4& transform : palette(scene, scene.meshes[m], placement, nodes))
        extend(all, own[m], transform);
    }
  }
  return all;
}

Statistics statistics(const Mesh& mesh, const Attributes& attributes, const Scene* scene,
                      Progress* progress) {
  Statistics result = mesher::statistics(mesh, progress);
  if (scene != nullptr && differs_from_model(*scene)) result.box = bounds(mesh, attributes, *scene);
  return result;
}

}  // namespace mesher::scene
