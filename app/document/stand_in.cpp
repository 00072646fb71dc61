#include "app/document/stand_in.h"

#include "engine/simplify/clustering.h"

namespace mesher::app {

std::shared_ptr<const Mesh> make_stand_in(const Mesh& mesh, const Statistics& statistics) {
  return std::make_shared<const Mesh>(simplify::cluster(mesh, statistics, kStandInFaces));
}

std::shared_ptr<const Mesh> level_as_stand_in(progressive::ProgressiveMesh& mesh,
                                              Progress* progress) {
  const std::uint32_t level = mesh.level();
  progressive::go_to_level(mesh, mesh.level_for_faces(kStandInFaces), progress);
  auto made = std::make_shared<const Mesh>(mesh.mesh());
  progressive::go_to_level(mesh, level, progress);
  return made;
}

}  // namespace mesher::app
