#pragma once

#include <memory>
#include <vector>

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// OpenSubdiv's opinion of a mesh, level by level, in our numbering. It is given bow-tie vertices
/// as the input had them: their copies as one vertex.
class OpenSubdivReference {
 public:
  OpenSubdivReference(const Mesh& mesh, BoundaryRounding boundary, CreaseDecay decay,
                      std::uint32_t levels);
  ~OpenSubdivReference();
  OpenSubdivReference(const OpenSubdivReference&) = delete;
  OpenSubdivReference& operator=(const OpenSubdivReference&) = delete;

  /// Pre: level <= levels. Sharpnesses of 10 and more are given as for ever.
  const PlainMesh& level(std::uint32_t level) const;
  /// Limit of the last level's vertices. Right for settled creases only: OpenSubdiv takes what is
  /// semi-sharp on the last level for sharp.
  std::vector<Point> limit_positions() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mesher::test
