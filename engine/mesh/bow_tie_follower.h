#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "engine/mesh/bow_tie.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Tracks the copies of bow-tie vertices through a sequence of edge collapses. A copy survives in
/// the vertex that it is merged into, as long as that vertex stays at the position of the copy.
class BowTieFollower {
 public:
  /// Starts from the mesh before the collapses. O(k).
  explicit BowTieFollower(const Mesh& mesh);

  bool is_empty() const { return followed_.empty(); }
  /// Records that `removed` was merged into `kept`, which moved to `p`. Ids are those of the mesh
  /// before the collapses. O(1) expected.
  void merge(Vertex removed, Vertex kept, const glm::vec3& p);

  /// Returns the surviving copies, with their ids before the collapses.
  Array<BowTieCopy> before() const;
  /// Returns the same copies, each with the id of the vertex that it was merged into.
  Array<BowTieCopy> after() const;

 private:
  struct Followed {
    BowTieCopy copy;
    glm::vec3 position;
    Vertex now;  ///< invalid once the copy has moved
  };
  void stop_following(std::unordered_map<Vertex, std::size_t>::iterator entry);

  std::vector<Followed> followed_;
  std::unordered_map<Vertex, std::size_t> by_vertex_;  ///< indices into followed_
};

}  // namespace mesher
