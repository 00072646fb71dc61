#include "engine/subdivide/charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/subdivide/features.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::subdivide {
namespace {

constexpr std::size_t kChartGrain = 4096;
constexpr glm::vec3 kNoValue(std::numeric_limits<float>::quiet_NaN());

/// Builds a mesh from the charts: the faces of the mesh, the values as positions, cut along seams.
/// Its half-edges are those of the mesh, so the corners of both correspond on every level.
class ChartBuilder {
 public:
  ChartBuilder(const Mesh& mesh, const Attributes& attributes, const AttributeLayer& layer)
      : mesh_(mesh), value_(values_of(mesh, attributes, layer)) {}

  Mesh build() {
    cut_seams();
    make_vertices();
    sharpen();
    return std::move(charts_).finish();
  }

 private:
  static Array<glm::vec3> values_of(const Mesh& mesh, const Attributes& attributes,
                                    const AttributeLayer& layer) {
    Array<glm::vec3> values(mesh.halfedge_count());
    parallel_for_each(mesh.halfedge_count(), kChartGrain, [&](std::uint32_t h) {
      const AttributeValue value =
          load(layer, attributes.wedge(mesh.origins(), Halfedge(h)).index());
      const glm::vec3 p(value[0], value[1], value[2]);
      values[h] = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) ? p : kNoValue;
    });
    return values;
  }

  const glm::vec3& value(Halfedge h) const { return value_[h.index()]; }

  /// Equal to itself only if no component is NaN.
  bool is_whole(Face f) const {
    const Halfedge h = Mesh::halfedge(f);
    for (const Halfedge corner : {h, Mesh::next(h), Mesh::prev(h)}) {
      if (value(corner) != value(corner)) return false;
    }
    return true;
  }

  bool is_continuous(Halfedge h, Halfedge twin) const {
    return value(h) == value(Mesh::next(twin)) && value(Mesh::next(h)) == value(twin) &&
           is_whole(Mesh::face(h)) && is_whole(Mesh::face(twin));
  }

  void cut_seams() {
    charts_.twin.resize(mesh_.halfedge_count());
    parallel_for_each(mesh_.halfedge_count(), kChartGrain, [&](std::uint32_t h) {
      const Halfedge twin = mesh_.twin(Halfedge(h));
      charts_.twin[h] = twin.is_valid() && is_continuous(Halfedge(h), twin) ? twin : Halfedge();
    });
  }

  Halfedge twin(Halfedge h) const { return charts_.twin[h.index()]; }

  /// Returns the half-edge at which the sweep around the vertex of `h` starts.
  Halfedge first_of_fan(Halfedge h) const {
    Halfedge first = h;
    while (twin(first).is_valid()) {
      first = Mesh::next(twin(first));
      if (first == h) break;
    }
    return first;
  }

  /// Gives each fan of faces around a vertex a vertex of its own.
  void make_vertices() {
    charts_.origin.assign(mesh_.halfedge_count(), Vertex());
    for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i) {
      if (charts_.origin[i].is_valid()) continue;
      const Vertex v(static_cast<std::uint32_t>(charts_.position.size()));
      const Halfedge first = first_of_fan(Halfedge(i));
      charts_.position.push_back(value_[i]);
      charts_.outgoing.push_back(first);
      Halfedge h = first;
      do {
        charts_.origin[h.index()] = v;
        h = twin(Mesh::prev(h));
      } while (h.is_valid() && h != first);
    }
  }

  /// What the edges at a vertex of the mesh are.
  struct Edges {
    std::uint32_t borders = 0;  ///< seams and boundaries
    float sharpness = 0.0F;     ///< the largest of all other edges
  };

  Array<Edges> edges_at_vertices() const {
    Array<Edges> edges(mesh_.vertex_count(), Edges());
    for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i) {
      const Halfedge h(i);
      if (mesh_.twin(h) < h) continue;  // none is the highest index
      const bool is_border = !twin(h).is_valid();
      for (const Vertex v : {mesh_.origin(h), mesh_.target(h)}) {
        Edges& at = edges[v.index()];
        at.borders += is_border ? 1 : 0;
        if (!is_border) at.sharpness = std::max(at.sharpness, mesh_.sharpness(h));
      }
    }
    return edges;
  }

  /// Returns whether the vertex of a fan has another fan that starts with the same value.
  bool meets_itself(Halfedge first) const {
    for (Halfedge h = Mesh::prev(first); mesh_.twin(h).is_valid(); h = Mesh::prev(mesh_.twin(h))) {
      const Halfedge next = mesh_.twin(h);
      if (next == first) return false;
      if (!twin(h).is_valid() && value(next) == value(first)) return true;
    }
    return false;
  }

  /// Returns whether the vertex of a fan keeps its values on all sides.
  bool is_pinned(Halfedge first, std::uint32_t borders) const {
    if (borders == 1 || borders >= 3 || mesh_.is_bow_tie_copy(mesh_.origin(first))) return true;
    const bool has_one_face = !twin(first).is_valid() && !twin(Mesh::prev(first)).is_valid();
    return has_one_face || (borders == 2 && meets_itself(first));
  }

  /// What sharpens one side of a seam sharpens all sides, so that they stay alike.
  void sharpen() {
    charts_.sharpness.assign(mesh_.sharpnesses().begin(), mesh_.sharpnesses().end());
    const Array<Edges> edges = edges_at_vertices();
    Array<float> sharpness(mesh_.vertex_count(), 0.0F);
    for (const Halfedge first : charts_.outgoing) {
      const Vertex v = mesh_.origin(first);
      const Edges& at = edges[v.index()];
      const float own = std::max(mesh_.sharpness(v), at.borders > 0 ? at.sharpness : 0.0F);
      float& most = sharpness[v.index()];
      most = is_pinned(first, at.borders) ? kInfinitelySharp : std::max(most, own);
    }
    for (const Halfedge first : charts_.outgoing)
      charts_.vertex_sharpness.push_back(sharpness[mesh_.origin(first).index()]);
  }

  const Mesh& mesh_;
  Array<glm::vec3> value_;  ///< one per half-edge, for its corner
  MeshArrays charts_;
};

}  // namespace

AttributeLayer subdivide_charts(const Mesh& mesh, const Attributes& attributes,
                                const AttributeLayer& layer, const SubdivideOptions& options) {
  SubdivideOptions rules = options;
  rules.creases = CreaseRules::derose98;
  const IndexedTriangles fine =
      subdivide_to_triangles(ChartBuilder(mesh, attributes, layer).build(), rules);
  AttributeLayer result(layer.type(), fine.index.size());
  parallel_for_each(fine.index.size(), kChartGrain, [&](std::uint32_t h) {
    const glm::dvec3 p(fine.position[fine.index[h].index()]);
    store(result, h, {p.x, p.y, p.z, 0.0});
  });
  return result;
}

std::size_t chart_bytes(const Mesh& mesh, std::uint32_t levels) {
  // As if each face were a chart: then there are at most 3/2 vertices per face after a level.
  constexpr std::size_t kPerFace = 3 * sizeof(Vertex) + 3 * sizeof(glm::vec3) / 2;
  constexpr std::size_t kPerFaceBefore =
      3 * (2 * sizeof(Vertex) + sizeof(Halfedge) + sizeof(float) + sizeof(glm::vec3)) +
      3 * (sizeof(glm::vec3) + sizeof(Halfedge));
  const std::size_t faces = std::size_t{mesh.face_count()} << (2 * levels);
  const std::size_t sharp_edges = std::size_t{mesh.halfedge_count()} << levels;
  return kPerFace * faces + kPerFaceBefore * faces / 4 +
         kBytesPerSharpEdge * (sharp_edges + sharp_edges / 2);
}

}  // namespace mesher::subdivide
