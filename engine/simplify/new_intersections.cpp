#include "engine/simplify/new_intersections.h"

#include <algorithm>

#include "engine/analysis/triangle_pair.h"

namespace mesher::simplify {
namespace {

bool did_intersect(const Mesh& before, Face f, Face g) {
  const auto triangle = [&](Face face) -> analysis::ExactTriangle {
    const auto corner = [&](std::uint32_t c) {
      return glm::dvec3(before.position(before.origin(Mesh::halfedge(face, c))));
    };
    return {corner(0), corner(1), corner(2)};
  };
  const analysis::ExactTriangle a = triangle(f);
  const analysis::ExactTriangle b = triangle(g);
  return !analysis::is_degenerate(a) && !analysis::is_degenerate(b) && analysis::do_intersect(a, b);
}

}  // namespace

std::vector<analysis::FacePair> new_intersections(const Mesh& before, const Mesh& after,
                                                  Progress* progress) {
  auto pairs = analysis::self_intersections(after, progress);
  std::erase_if(pairs, [&](const analysis::FacePair& pair) {
    return did_intersect(before, pair[0], pair[1]);
  });
  return pairs;
}

bool has_new_intersections(const Mesh& input, const Simplified& result, Progress* progress) {
  const auto pairs = analysis::self_intersections(result.mesh, progress);
  return std::ranges::any_of(pairs, [&](const analysis::FacePair& pair) {
    return !did_intersect(input, result.face_source[pair[0].index()],
                          result.face_source[pair[1].index()]);
  });
}

}  // namespace mesher::simplify
