#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "app/document/document.h"
#include "engine/render/sources.h"
#include "engine/scene/influences.h"
#include "engine/scene/placed.h"

namespace mesher::app {

/// What the scene of a model shows: copies of its meshes, which the vertex shader moves to their
/// places and poses.
class ScenePicture {
 public:
  /// Copies the meshes that are shown. O(V + F + what is shown). Pre: the model has a scene.
  explicit ScenePicture(const Document& document);

  /// Poses the copies as the document's playback says. Returns whether the arrays of the mesh are
  /// others than before: those with morph targets are. O(matrices), or O(V * targets).
  bool pose(const Document& document);

  Mesh& mesh() { return shown_.shape.mesh; }
  const Mesh& mesh() const { return shown_.shape.mesh; }
  const Attributes& attributes() const { return shown_.shape.attributes; }
  /// For the renderer; valid until the next `pose`.
  render::PoseSource pose_source() const;
  /// Vertices and faces have the numbers of the model.
  bool keeps_elements() const { return shown_.keeps_elements; }

 private:
  void find_influences();
  /// Returns whether the weights are new.
  bool morph(std::vector<std::vector<double>>&& weights);

  scene::Copies still_;  ///< without morph targets; empty if there are none
  scene::Copies shown_;
  std::vector<std::vector<double>> weights_;  ///< that `shown_` has
  std::vector<std::uint32_t> first_matrix_;   ///< of each copy
  Array<render::shared::PoseInfluence> influences_;
  std::vector<glm::vec4> palette_;
  std::vector<Box> boxes_;  ///< of the copies, before they are posed
  Box box_;
};

}  // namespace mesher::app
