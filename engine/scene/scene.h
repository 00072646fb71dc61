#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/ids.h"
#include "engine/scene/animation.h"

namespace mesher::scene {

/// The transform of a node relative to its parent: a matrix, or else scale, rotation and
/// translation, in that order.
struct Transform {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  std::optional<glm::dmat4> matrix;

  glm::dmat4 to_matrix() const;
};

struct Node {
  std::string name;
  std::uint32_t parent = kNone;  ///< known of the nodes of Scene::order
  std::uint32_t depth = 0;       ///< 0: it has no parent
  Transform to_parent;
  std::uint32_t mesh = kNone;   ///< index into Scene::meshes; none: it shows no triangles
  std::uint32_t skin = kNone;   ///< index into Scene::skins
  std::vector<double> weights;  ///< of the mesh's morph targets
};

struct Skin {
  std::vector<std::uint32_t> joints;      ///< nodes
  std::vector<glm::dmat4> inverse_binds;  ///< from the mesh's coordinates to those of each joint
};

/// A place where the scene shows a mesh.
struct Placement {
  std::uint32_t node = kNone;  ///< none: the file has no nodes
  bool is_instance = false;    ///< one of many at its node
  glm::dmat4 instance{1.0};    ///< to the node
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// A mesh of the scene. A model holds each once, however often the scene shows it.
struct SceneMesh {
  std::string name;
  /// From the mesh's own coordinates to the scene, where the model shows it: at its first
  /// placement. A skinned mesh follows the mean of its joints, weighted by the vertices that follow
  /// them. If this mirrors, the model's faces are turned over.
  glm::dmat4 to_scene{1.0};
  bool has_faces = false;             ///< triangles, in the file
  std::vector<Placement> placements;  ///< in the order of the nodes; empty: it is not shown
};

/// Everything of a file that writing it again needs, besides the model.
class Source {
 public:
  virtual ~Source() = default;
};

/// How a file arranges the meshes of a model. Edits of the model keep it.
///
/// The faces of a model know their mesh by FaceGroup::mesh. No vertex belongs to two meshes.
struct Scene {
  std::vector<Node> nodes;           ///< as in the document
  std::vector<std::uint32_t> order;  ///< those of the default scene, depth first
  std::vector<SceneMesh> meshes;     ///< as in the document; some may have no triangles
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  glm::dvec3 origin{0.0};          ///< as Model::origin
  std::shared_ptr<Source> source;  ///< of the file; null: it cannot be written again
};

/// Poses of nodes that an animation moves; the others are at rest.
using NodePoses = std::map<std::uint32_t, NodePose>;

/// Returns the transforms of all nodes to the scene. Nodes outside the default scene have no
/// parent. O(nodes).
std::vector<glm::dmat4> node_transforms(const Scene& scene, const NodePoses& poses = {});

/// Returns the weights of the morph targets that a placement shows; empty: none.
std::vector<double> target_weights(const Scene& scene, const Placement& placement,
                                   const NodePoses& poses = {});

/// Returns the matrices that take a mesh from its own coordinates to a placement: one, or one for
/// each joint if it is skinned. `nodes`: transforms to the scene.
std::vector<glm::dmat4> mesh_transforms(const Scene& scene, const Placement& placement,
                                        const std::vector<glm::dmat4>& nodes);

/// Returns the first of them. O(1).
glm::dmat4 first_transform(const Scene& scene, const Placement& placement,
                           const std::vector<glm::dmat4>& nodes);

/// The same as mesh_transforms from where the model has the mesh, and about the model's origin: the
/// identity for a first placement at rest, unless joints move its vertices apart.
std::vector<glm::dmat4> palette(const Scene& scene, const SceneMesh& mesh,
                                const Placement& placement, const std::vector<glm::dmat4>& nodes);

}  // namespace mesher::scene
