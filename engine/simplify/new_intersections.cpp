#include "engine/simplify/new_intersections.h"

#include <algorithm>

#include "engine/analysis/self_intersections.h"
#include "engine/analysis/triangle_pair.h"

namespace mesher {

bool has_new_intersections(const Mesh& input, const Simplified& result, Progress* progress) {
  const auto triangle = [&](Face f) -> ExactTriangle {
    const auto corner = [&](std::uint32_t c) {
      return glm::dvec3(input.position(input.origin(Mesh::halfedge(f, c))));
    };
    return {corner(0), corner(1), corner(2)};
  };
  return std::ranges::any_of(self_intersections(result.mesh, progress), [&](const FacePair& pair) {
    const ExactTriangle a = triangle(result.face_source[pair[0].index()]);
    const ExactTriangle b = triangle(result.face_source[pair[1].index()]);
    return is_degenerate(a) || is_degenerate(b) || !do_intersect(a, b);
  });
}

}  // namespace mesher
