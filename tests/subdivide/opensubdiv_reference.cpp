#include "tests/subdivide/opensubdiv_reference.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <stdexcept>

namespace mesher::test {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A position with the interface that PrimvarRefiner requires.
struct Value {
  Point point{};
  void Clear() { point = Point(0.0); }
  void AddWithWeight(const Value& other, double weight) { point += weight * other.point; }
};

/// The arrays that a TopologyDescriptor points to.
struct Lists {
  std::vector<int> corners_of_face;
  std::vector<int> corners;
  std::vector<int> creases;
  std::vector<float> crease_sharpness;
  std::vector<int> sharp_vertices;
  std::vector<float> vertex_sharpness;
};

/// The lowest copy of a bow-tie vertex; for all others the vertex itself.
Vertex first_copy(const Mesh& mesh, Vertex v) {
  for (const BowTieCopy& copy : mesh.bow_tie_copies()) {
    if (copy.v == v) return copy.first;
  }
  return v;
}

Lists lists_of(const Mesh& mesh, const std::vector<std::uint32_t>& number) {
  constexpr float kInfinite = 10.0F;
  Lists lists;
  lists.corners_of_face.assign(mesh.face_count(), 3);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const Halfedge half(h);
    const int from = int(number[mesh.origin(half).index()]);
    const int to = int(number[mesh.target(half).index()]);
    lists.corners.push_back(from);
    if (mesh.sharpness(half) == 0.0F || mesh.edge(half).index() != h) continue;
    lists.creases.insert(lists.creases.end(), {from, to});
    lists.crease_sharpness.push_back(std::min(mesh.sharpness(half), kInfinite));
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const float sharpness = mesh.sharpness(Vertex(v));
    if (sharpness == 0.0F || mesh.is_isolated(Vertex(v))) continue;
    if (first_copy(mesh, Vertex(v)) != Vertex(v)) continue;
    lists.sharp_vertices.push_back(int(number[v]));
    lists.vertex_sharpness.push_back(std::min(sharpness, kInfinite));
  }
  return lists;
}

Far::TopologyRefiner* make_refiner(const Lists& lists, std::size_t vertices,
                                   subdivide::BoundaryRounding boundary,
                                   subdivide::CreaseDecay decay) {
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = int(vertices);
  descriptor.numFaces = int(lists.corners_of_face.size());
  descriptor.numVertsPerFace = lists.corners_of_face.data();
  descriptor.vertIndicesPerFace = lists.corners.data();
  descriptor.numCreases = int(lists.crease_sharpness.size());
  descriptor.creaseVertexIndexPairs = lists.creases.data();
  descriptor.creaseWeights = lists.crease_sharpness.data();
  descriptor.numCorners = int(lists.sharp_vertices.size());
  descriptor.cornerVertexIndices = lists.sharp_vertices.data();
  descriptor.cornerWeights = lists.vertex_sharpness.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(boundary == subdivide::BoundaryRounding::edge_only
                                          ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                          : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  options.SetCreasingMethod(decay == subdivide::CreaseDecay::uniform
                                ? Sdc::Options::CREASE_UNIFORM
                                : Sdc::Options::CREASE_CHAIKIN);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  Far::TopologyRefiner* refiner =
      Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_LOOP, options));
  if (refiner == nullptr) throw std::runtime_error("OpenSubdiv refuses the mesh");
  return refiner;
}

/// One level in both numberings.
struct Level {
  PlainMesh mesh;
  std::vector<std::uint32_t> ours;  ///< indexed by their vertex
  std::vector<int> their_face;      ///< indexed by our face
  std::vector<Value> values;        ///< indexed by their vertex
};

void note_sharpness(const Far::TopologyLevel& topology, Level& level) {
  for (int e = 0; e < topology.GetNumEdges(); ++e) {
    const float sharpness = topology.GetEdgeSharpness(e);
    const Far::ConstIndexArray ends = topology.GetEdgeVertices(e);
    if (sharpness > 0.0F)
      level.mesh.sharpness[pair_of(level.ours[ends[0]], level.ours[ends[1]])] = settled(sharpness);
  }
  level.mesh.vertex_sharpness.assign(level.mesh.positions.size(), 0.0);
  for (int v = 0; v < topology.GetNumVertices(); ++v)
    level.mesh.vertex_sharpness[level.ours[v]] = settled(topology.GetVertexSharpness(v));
}

int local_corner(const Far::TopologyLevel& topology, const Level& level, int face,
                 std::uint32_t vertex) {
  const Far::ConstIndexArray corners = topology.GetFaceVertices(face);
  for (int k = 0; k < 3; ++k) {
    if (level.ours[corners[k]] == vertex) return k;
  }
  throw std::runtime_error("a face of OpenSubdiv lacks one of our vertices");
}

/// Numbers the vertices of the child level in our order.
void number_vertices(const Far::TopologyLevel& topology, const Level& parent, Level& child) {
  constexpr std::uint32_t kUnset = 0xFFFFFFFFU;
  child.ours.assign(child.values.size(), kUnset);
  for (int v = 0; v < topology.GetNumVertices(); ++v)
    child.ours[topology.GetVertexChildVertex(v)] = parent.ours[v];
  auto next = static_cast<std::uint32_t>(parent.mesh.positions.size());
  for (std::size_t f = 0; f < parent.mesh.triangles.size(); ++f) {
    const int face = parent.their_face[f];
    for (const std::uint32_t v : parent.mesh.triangles[f]) {
      const int k = local_corner(topology, parent, face, v);
      std::uint32_t& number =
          child.ours[topology.GetEdgeChildVertex(topology.GetFaceEdges(face)[k])];
      if (number == kUnset) number = next++;
    }
  }
  child.mesh.positions = parent.mesh.positions;  // isolated vertices do not move
  child.mesh.positions.resize(next);
  for (std::size_t v = 0; v < child.values.size(); ++v)
    child.mesh.positions.at(child.ours[v]) = child.values[v].point;
}

/// Rotates the corners of a triangle so that it starts with `first`, which must be one of them.
Triangle turned(Triangle triangle, std::uint32_t first) {
  for (int k = 0; k < 3 && triangle[0] != first; ++k)
    std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  if (triangle[0] != first) throw std::runtime_error("an unexpected child face of OpenSubdiv");
  return triangle;
}

/// Puts their child faces into our order: sorted by the parent's corner that each contains, the
/// center face last. Each is rotated so that this corner is at our index.
void order_faces(const Far::TopologyLevel& parent_topology,
                 const Far::TopologyLevel& child_topology, const Level& parent, Level& child) {
  for (std::size_t f = 0; f < parent.mesh.triangles.size(); ++f) {
    const int face = parent.their_face[f];
    const Far::ConstIndexArray children = parent_topology.GetFaceChildFaces(face);
    const auto mapped = [&](int k) {
      const Far::ConstIndexArray corners = child_topology.GetFaceVertices(children[k]);
      return Triangle{child.ours[corners[0]], child.ours[corners[1]], child.ours[corners[2]]};
    };
    std::uint32_t ab = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = parent.mesh.triangles[f][k];
      const int local = local_corner(parent_topology, parent, face, corner);
      Triangle triangle = turned(mapped(local), corner);
      if (k == 0) ab = triangle[1];
      std::rotate(triangle.begin(), triangle.end() - std::ptrdiff_t(k), triangle.end());
      child.mesh.triangles.push_back(triangle);
      child.their_face.push_back(children[local]);
    }
    child.mesh.triangles.push_back(turned(mapped(3), ab));
    child.their_face.push_back(children[3]);
  }
}

Level base_level(const Mesh& mesh, const std::vector<std::uint32_t>& used) {
  Level base;
  base.mesh.positions = points_of(mesh.positions());
  base.ours = used;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Triangle triangle{};
    for (std::uint32_t k = 0; k < 3; ++k)
      triangle[k] = first_copy(mesh, mesh.origin(Mesh::halfedge(Face(f), k))).index();
    base.mesh.triangles.push_back(triangle);
    base.their_face.push_back(int(f));
  }
  for (const std::uint32_t v : used)
    base.values.push_back({base.mesh.positions[v]});
  return base;
}

/// Gives the copies of a bow-tie vertex, which is a single vertex in OpenSubdiv, the values of the
/// first copy.
void tell_copies_apart(const Mesh& mesh, std::vector<Level>& levels) {
  for (std::size_t l = 0; l < levels.size() && !mesh.bow_tie_copies().empty(); ++l) {
    PlainMesh& level = levels[l].mesh;
    const std::vector<Triangle> merged = level.triangles;
    for (std::uint32_t h = 0; h < 3 * level.triangles.size(); ++h) {
      if (level.triangles[h / 3][h % 3] >= mesh.vertex_count()) continue;
      // The child at a corner has this corner at the same index.
      std::uint32_t base = h / 3;
      for (std::size_t up = 0; up < l; ++up)
        base /= 4;
      level.triangles[h / 3][h % 3] = mesh.origin(Halfedge(3 * base + h % 3)).index();
    }
    std::map<VertexPair, double> sharpness;
    for (std::size_t f = 0; f < merged.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double s = sharpness_of(level, merged[f][k], merged[f][(k + 1) % 3]);
        const Triangle& t = level.triangles[f];
        if (s > 0.0) sharpness[pair_of(t[k], t[(k + 1) % 3])] = s;
      }
    }
    level.sharpness = std::move(sharpness);
    for (const auto& [v, first] : mesh.bow_tie_copies()) {
      level.positions[v.index()] = level.positions[first.index()];
      level.vertex_sharpness[v.index()] = level.vertex_sharpness[first.index()];
    }
  }
}

}  // namespace

struct OpenSubdivReference::Implementation {
  std::unique_ptr<Far::TopologyRefiner> refiner;
  std::vector<Level> levels;
  Array<BowTieCopy> copies;
};

OpenSubdivReference::OpenSubdivReference(const Mesh& mesh, subdivide::BoundaryRounding boundary,
                                         subdivide::CreaseDecay decay, std::uint32_t levels)
    : implementation_(std::make_unique<Implementation>()) {
  // OpenSubdiv does not accept isolated vertices.
  std::vector<std::uint32_t> used;
  std::vector<std::uint32_t> number(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vertex first = first_copy(mesh, Vertex(v));
    number[v] = static_cast<std::uint32_t>(used.size());
    if (first != Vertex(v)) {
      number[v] = number[first.index()];
    } else if (!mesh.is_isolated(first)) {
      used.push_back(v);
    }
  }
  Implementation& it = *implementation_;
  it.refiner.reset(make_refiner(lists_of(mesh, number), used.size(), boundary, decay));
  Far::TopologyRefiner::UniformOptions options{int(levels)};
  options.fullTopologyInLastLevel = true;
  it.refiner->RefineUniform(options);
  it.levels.push_back(base_level(mesh, used));
  note_sharpness(it.refiner->GetLevel(0), it.levels.back());
  const Far::PrimvarRefinerReal<double> primvars(*it.refiner);
  for (int l = 1; l <= int(levels); ++l) {
    const Far::TopologyLevel& parent_topology = it.refiner->GetLevel(l - 1);
    const Far::TopologyLevel& topology = it.refiner->GetLevel(l);
    Level child;
    child.values.resize(static_cast<std::size_t>(topology.GetNumVertices()));
    primvars.Interpolate(l, it.levels.back().values, child.values);
    number_vertices(parent_topology, it.levels.back(), child);
    order_faces(parent_topology, topology, it.levels.back(), child);
    note_sharpness(topology, child);
    it.levels.push_back(std::move(child));
  }
  it.copies.assign(mesh.bow_tie_copies().begin(), mesh.bow_tie_copies().end());
  tell_copies_apart(mesh, it.levels);
}

OpenSubdivReference::~OpenSubdivReference() = default;

const PlainMesh& OpenSubdivReference::level(std::uint32_t level) const {
  return implementation_->levels.at(level).mesh;
}

std::vector<Point> OpenSubdivReference::limit_positions() const {
  const Level& last = implementation_->levels.back();
  std::vector<Value> limit(last.values.size());
  Far::PrimvarRefinerReal<double>(*implementation_->refiner).Limit(last.values, limit);
  std::vector<Point> positions = last.mesh.positions;
  for (std::size_t v = 0; v < limit.size(); ++v)
    positions[last.ours[v]] = limit[v].point;
  for (const auto& [v, first] : implementation_->copies)
    positions[v.index()] = positions[first.index()];
  return positions;
}

}  // namespace mesher::test
