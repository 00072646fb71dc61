#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::simplify {

/// The sharpness that `mark_seams` gives to edges: the largest finite one, which no file means.
inline constexpr float kSeamSharpness = std::numeric_limits<float>::max();
inline constexpr double kHardEdgeDegrees = 30.0;

/// Marks the edges along which values or materials differ, so that they simplify as creases: only
/// along themselves. Edges that are creases stay so. Where only normals differ, the edge is marked
/// if they differ by more than kHardEdgeDegrees, since a model with a normal per face has no other
/// edges. O(F). Notes nothing in the change log.
void mark_seams(Mesh& mesh, const Attributes& attributes);
/// Makes marked edges smooth again. O(F).
void unmark_seams(Mesh& mesh);

/// Returns false if no edge can separate values or materials.
bool may_have_lines(const Attributes& attributes);

/// Whether the values of a layer differ across an edge.
class SeamTest {
 public:
  SeamTest(const Mesh& mesh, const Attributes& attributes) : mesh_(mesh), attributes_(attributes) {}

  Wedge wedge(Halfedge h) const { return attributes_.wedge(mesh_.origins(), h); }

  /// Returns whether an edge separates wedges. A boundary does not.
  bool is_seam(Halfedge h) const {
    const Halfedge t = mesh_.twin(h);
    if (!t.is_valid() || !attributes_.has_seams()) return false;
    return wedge(h) != wedge(Mesh::next(t)) || wedge(Mesh::next(h)) != wedge(t);
  }
  /// Returns whether the values of one layer differ across an edge. Pre: it is not a boundary.
  bool is_seam(Halfedge h, const AttributeLayer& layer) const {
    const Halfedge t = mesh_.twin(h);
    return differ(layer, wedge(h), wedge(Mesh::next(t))) ||
           differ(layer, wedge(Mesh::next(h)), wedge(t));
  }

  /// Returns whether most edges separate the values of a layer, as normals of a faceted model do.
  /// O(F).
  bool has_value_per_face(const AttributeLayer& layer) const;

 private:
  static bool differ(const AttributeLayer& layer, Wedge a, Wedge b) {
    return a != b && std::memcmp(layer.value(a.index()).data(), layer.value(b.index()).data(),
                                 layer.type().value_bytes()) != 0;
  }

  const Mesh& mesh_;
  const Attributes& attributes_;
};

/// The edges that `mark_seams` marks. O(F), parallel.
class Lines {
 public:
  Lines(const Mesh& mesh, const Attributes& attributes);
  bool operator[](Halfedge h) const { return !is_line_.empty() && is_line_[h.index()] != 0; }

 private:
  std::vector<std::uint8_t> is_line_;
};

}  // namespace mesher::simplify
