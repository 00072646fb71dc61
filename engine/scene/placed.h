#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/mesh/shape.h"
#include "engine/mesh/statistics.h"
#include "engine/scene/scene.h"

namespace mesher::scene {

/// Which nodes of a scene are hidden, each with its mesh. Empty: none.
using HiddenNodes = std::vector<bool>;

/// Returns for each group of a shape its mesh, for `split`.
std::vector<std::uint32_t> mesh_of_groups(const Attributes& attributes);

/// Returns a shape with one of its meshes replaced. O(V + F). Pre: it is of a scene's model with
/// this number of meshes.
Shape with_mesh(const Shape& shape, std::size_t meshes, std::uint32_t mesh, Shape&& replacement);
/// Returns one mesh of a shape. O(V + F). Pre: as above.
Shape mesh_of(const Shape& shape, std::size_t meshes, std::uint32_t mesh);

/// Returns whether the scene shows something else than the model is: a mesh at several places or at
/// none, posed by joints or morph targets, or hidden. O(scene).
bool differs_from_model(const Scene& scene, const HiddenNodes& hidden = {});

/// The meshes of a scene, once for every shown placement, but where the model has them.
struct Copies {
  struct Copy {
    std::uint32_t mesh = 0;
    std::uint32_t placement = 0;  ///< index into SceneMesh::placements
  };
  Shape shape;
  std::vector<Copy> list;
  Array<std::uint32_t> of_vertex;  ///< index into `list`, or kNone if no face uses the vertex
  bool keeps_elements = false;     ///< vertices and faces have the numbers of the model
};

/// Faces that copies may have together.
inline constexpr std::uint64_t kMostCopiedFaces = 20'000'000;

/// Returns the copies that are shown, but each mesh once if all together would have more than
/// kMostCopiedFaces: edits can make that many. Groups' objects are named after the nodes, unless
/// each mesh is shown once. O(V + F + what is shown). Pre: mesh and attributes are of the scene's
/// model.
Copies copies_of(const Mesh& mesh, const Attributes& attributes, const Scene& scene,
                 const HiddenNodes& hidden = {});

/// Returns the palette of each copy.
std::vector<std::vector<glm::dmat4>> palettes_of(const Copies& copies, const Scene& scene,
                                                 const NodePoses& poses = {});
/// Returns the weights of each copy's morph targets.
std::vector<std::vector<double>> target_weights_of(const Copies& copies, const Scene& scene,
                                                   const NodePoses& poses = {});

/// Moves the copies to where they are shown: each vertex by its morph targets, and then by the
/// matrix of its copy, or by the mean of its joints. O(V * targets + F).
void pose(const Scene& scene, const NodePoses& poses, Copies& copies);

/// Returns what the scene shows, at rest: each mesh once for every placement. The groups' objects
/// are named after the nodes. O(V + F + what is shown). Throws DeviceError if that is more than
/// kMostCopiedFaces. Pre: they are of the scene's model.
Shape placed(const Mesh& mesh, const Attributes& attributes, const Scene& scene,
             const HiddenNodes& hidden = {});

/// Returns a box around what the scene shows, at rest: around boxes of the meshes, each taken to
/// its placements, and by all joints if it is skinned. O(V + F + placements). Pre: as for `placed`.
Box bounds(const Mesh& mesh, const Attributes& attributes, const Scene& scene,
           const HiddenNodes& hidden = {});

/// Returns the statistics of a model's mesh, with the box of what its scene shows. `scene` may be
/// null. O(V + F). Throws Cancelled.
Statistics statistics(const Mesh& mesh, const Attributes& attributes, const Scene* scene,
                      Progress* progress = nullptr);

}  // namespace mesher::scene
