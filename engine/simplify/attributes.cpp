#include "engine/simplify/attributes.h"

#include <fmt/format.h>

#include <cstring>
#include <string_view>

namespace mesher::simplify {
namespace {

/// One representative input corner per vertex, and the vertices whose corners disagree.
struct RepresentativeCorners {
  std::vector<Halfedge> corner;  ///< by input vertex; none: no face uses it
  std::vector<bool> has_seam;
};

// Bitwise, because a corner without a value has NaN, which equals nothing.
template <class T>
bool is_same(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

template <class T>
RepresentativeCorners find_representatives(const Array<T>& values, std::span<const Vertex> origins,
                                           std::size_t vertices) {
  RepresentativeCorners found{std::vector<Halfedge>(vertices), std::vector<bool>(vertices)};
  for (std::uint32_t i = 0; i < origins.size(); ++i) {
    const std::uint32_t v = origins[i].index();
    Halfedge& corner = found.corner[v];
    if (!corner.is_valid()) {
      corner = Halfedge(i);
    } else if (!is_same(values[corner.index()], values[i])) {
      found.has_seam[v] = true;
    }
  }
  return found;
}

/// Returns the carried values. If a surviving vertex has a seam, returns none and appends to
/// `dropped`.
template <class T>
Array<T> carry(const Array<T>& values, std::span<const Vertex> origins, const Survivors& result,
               std::string_view name, std::vector<std::string>& dropped) {
  if (values.empty()) return {};
  const RepresentativeCorners input = find_representatives(values, origins, result.vertices_before);
  std::size_t seams = 0;
  for (const Vertex source : result.vertex_source)
    seams += input.has_seam[source.index()] ? 1 : 0;
  if (seams > 0) {
    dropped.push_back(fmt::format("{} (seams at {} of the {} vertices that are left)", name, seams,
                                  result.vertex_source.size()));
    return {};
  }
  Array<T> carried(result.mesh.halfedge_count());
  for (std::uint32_t i = 0; i < result.mesh.halfedge_count(); ++i) {
    const Vertex source = result.vertex_source[result.mesh.origin(Halfedge(i)).index()];
    carried[i] = values[input.corner[source.index()].index()];
  }
  return carried;
}

}  // namespace

CarriedAttributes carry_attributes(const Attributes& before, std::span<const Vertex> origins,
                                   const Simplified& result) {
  if (result.report.collapses == 0 && result.report.pruned_faces == 0) return {before, {}};
  return carry_attributes(before, origins,
                          Survivors{result.mesh, result.vertex_source, result.face_source,
                                    result.report.vertices_before});
}

CarriedAttributes carry_attributes(const Attributes& before, std::span<const Vertex> origins,
                                   const Survivors& result) {
  CarriedAttributes carried;
  Attributes& after = carried.attributes;
  after.texcoord = carry(before.texcoord, origins, result, "texture coordinates", carried.dropped);
  after.normal = carry(before.normal, origins, result, "normals", carried.dropped);
  after.color = carry(before.color, origins, result, "colors", carried.dropped);
  if (!before.group.empty()) {
    after.group.resize(result.face_source.size());
    for (std::size_t f = 0; f < result.face_source.size(); ++f)
      after.group[f] = before.group[result.face_source[f].index()];
  }
  after.group_names = before.group_names;
  return carried;
}

}  // namespace mesher::simplify
