#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "tests/bench/subdividers.h"

namespace mesher::bench {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using Refiner = std::unique_ptr<Far::TopologyRefiner>;

/// A position with the interface that PrimvarRefiner requires.
struct Value {
  glm::vec3 point;
  void Clear() { point = glm::vec3(0.0F); }
  void AddWithWeight(const Value& other, float weight) { point += weight * other.point; }
};
static_assert(sizeof(Value) == sizeof(glm::vec3));

Refiner make_refiner(const Soup& soup) {
  const std::vector<int> corners_of_face(soup.face_count(), 3);
  std::vector<int> crease_ends;
  std::vector<float> sharpness;
  for (const CreaseTag& crease : soup.creases) {
    crease_ends.insert(crease_ends.end(), {static_cast<int>(crease.a), static_cast<int>(crease.b)});
    sharpness.push_back(std::min(crease.sharpness, Sdc::Crease::SHARPNESS_INFINITE));
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(soup.positions.size());
  descriptor.numFaces = static_cast<int>(soup.face_count());
  descriptor.numVertsPerFace = corners_of_face.data();
  descriptor.vertIndicesPerFace = reinterpret_cast<const int*>(soup.corners.data());
  descriptor.numCreases = static_cast<int>(sharpness.size());
  descriptor.creaseVertexIndexPairs = crease_ends.data();
  descriptor.creaseWeights = sharpness.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  Refiner refiner(Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_LOOP, options)));
  if (!refiner) throw std::runtime_error("OpenSubdiv refuses the mesh");
  return refiner;
}

}  // namespace

SubdivisionOutcome subdivide_opensubdiv(SubdivisionWork&& work) {
  const Soup soup = std::move(work.soup);
  const auto levels = static_cast<int>(work.options.levels);
  const Refiner refiner = make_refiner(soup);
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
  const Far::PrimvarRefiner positions(*refiner);
  const Far::TopologyLevel& last = refiner->GetLevel(levels);

  subdivide::IndexedTriangles result;
  result.position.resize(static_cast<std::size_t>(last.GetNumVertices()));
  Array<glm::vec3> between;
  const glm::vec3* from = soup.positions.data();
  for (int level = 1; level <= levels; ++level) {
    Array<glm::vec3> finer;
    if (level < levels) {
      finer.resize(static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
    }
    glm::vec3* const to = level < levels ? finer.data() : result.position.data();
    const auto* source = reinterpret_cast<const Value*>(from);
    auto* target = reinterpret_cast<Value*>(to);
    positions.Interpolate(level, source, target);
    between = std::move(finer);
    from = between.data();
  }

  result.index.resize(3 * static_cast<std::size_t>(last.GetNumFaces()));
  Vertex* corner = result.index.data();
  for (int f = 0; f < last.GetNumFaces(); ++f) {
    const Far::ConstIndexArray vertices = last.GetFaceVertices(f);
    for (int k = 0; k < 3; ++k)
      *corner++ = Vertex(static_cast<std::uint32_t>(vertices[k]));
  }
  return {.triangles = std::move(result)};
}

}  // namespace mesher::bench
