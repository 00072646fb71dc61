#include "engine/simplify/new_intersections.h"

#include <algorithm>

#include "engine/analysis/triangle_pair.h"

namespace mesher::simplify {
namespace {

bool did_intersect(const Mesh& before, Face f, Face g) {
  return analysis::do_areas_intersect(analysis::exact_triangle(before, f),
                                      analysis::exact_triangle(before, g));
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
