#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "engine/mesh/attributes.h"
#include "engine/mesh/build/report.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"
#include "engine/mesh/mesh.h"

namespace mesher {

namespace scene {
struct Scene;
}

/// A mesh with all other data of its file, and the repairs made when it was opened.
struct Model {
  std::string name;  ///< for titles: the file's name without folder
  Mesh mesh;
  Attributes attributes;
  /// What the groups of `attributes` refer to; null if the file has no materials. Edits keep it.
  std::shared_ptr<const Materials> materials;
  /// How the file arranges the meshes that the model is made of; null: the model is all that it
  /// shows. Edits keep it.
  std::shared_ptr<const scene::Scene> scene;
  BuildReport report;
  FileContents contents;  ///< of the file, also what the model does not hold
  /// Added to every position of the mesh, in the file's own coordinates. 0 unless single precision
  /// about zero would lose digits of the file's numbers.
  glm::dvec3 origin{0.0};
};

}  // namespace mesher
