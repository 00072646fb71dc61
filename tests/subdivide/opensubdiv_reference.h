#pragma once

#include <memory>
#include <vector>

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// Subdivision of a mesh by OpenSubdiv, level by level, in our numbering. Bow-tie vertices are
/// passed as in the input, with their copies as one vertex.
class OpenSubdivReference {
 public:
  OpenSubdivReference(const Mesh& mesh, subdivide::BoundaryRounding boundary,
                      subdivide::CreaseDecay decay, std::uint32_t levels);
  ~OpenSubdivReference();
  OpenSubdivReference(const OpenSubdivReference&) = delete;
  OpenSubdivReference& operator=(const OpenSubdivReference&) = delete;

  /// Pre: level <= levels. A sharpness of 10 or more is returned as infinite.
  const PlainMesh& level(std::uint32_t level) const;
  /// Limit positions of the vertices of the last level. Correct only for creases that are smooth or
  /// infinitely sharp: OpenSubdiv treats semi-sharp edges of the last level as sharp.
  std::vector<Point> limit_positions() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mesher::test
