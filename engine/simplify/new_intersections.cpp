#include "engine/simplify/new_intersections.h"

#include <algorithm>

#include "engine/analysis/self_intersections.h"
#include "engine/analysis/triangle_pair.h"

namespace mesher::simplify {

bool has_new_intersections(const Mesh& input, const Simplified& result, Progress* progress) {
  const auto triangle = [&](Face f) -> analysis::ExactTriangle {
    const auto corner = [&](std::uint32_t c) {
      return glm::dvec3(input.position(input.origin(Mesh::halfedge(f, c))));
    };
    return {corner(0), corner(1), corner(2)};
  };
  return std::ranges::any_of(
      analysis::self_intersections(result.mesh, progress), [&](const analysis::FacePair& pair) {
        const analysis::ExactTriangle a = triangle(result.face_source[pair[0].index()]);
        const analysis::ExactTriangle b = triangle(result.face_source[pair[1].index()]);
        return analysis::is_degenerate(a) || analysis::is_degenerate(b) ||
               !analysis::do_intersect(a, b);
      });
}

}  // namespace mesher::simplify
