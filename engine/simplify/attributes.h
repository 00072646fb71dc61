#pragma once

#include <span>

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/seams.h"
#include "engine/simplify/simplify.h"

namespace mesher::simplify {

/// A mesh with its attributes.
struct Attributed {
  const Mesh& mesh;
  const Attributes& attributes;
};

/// Returns the attributes of a simplified mesh.
///
/// The value of a corner is that of the nearest point of the input that is reached from the source
/// of its face without crossing a seam, so both sides of a seam stay apart. Numbers are blended by
/// barycentric coordinates; normals and tangents have unit length again; joints are those of all
/// three corners, as many as there is room for (JointSum); other integers come from the nearest
/// corner. If most edges of the input separate normals, as with a normal per face,
/// the result has a normal per face, too. Groups follow their faces. A vertex that has not moved
/// keeps its values, bit for bit.
///
/// `face_source` is the face of the input that each face of the result was. O(F) in the result,
/// with a short walk per wedge; parallel. Throws Cancelled.
Attributes carry_attributes(const Attributed& input, const Mesh& result,
                            std::span<const Face> face_source, Progress* progress = nullptr);

/// Same for a result of `simplify` with a metric: the layers of the metric get the values that the
/// simplification found.
Attributes carry_attributes(const Attributed& input, const Simplified& result,
                            const AttributeMetric& metric, Progress* progress = nullptr);

/// A simplified mesh with its attributes.
struct SimplifiedModel {
  Simplified simplified;
  Attributes attributes;
  /// Seams were crossed, because that cost less or no other collapse was left.
  bool crosses_seams = false;
};

/// Simplifies a mesh with its attributes: along seams as `mark_seams` describes, or across them
/// where that costs less (SimplifyOptions::crosses_seams), if there is a target number of faces. A
/// target that is still out of reach is simplified without seams and without a metric. `prunes` as
/// in simplify_pruned; the preconditions are those of `simplify` and simplify_pruned. Without
/// attributes this is `simplify`. The last resort takes twice the time. Keeps one copy of a mesh
/// with attributes. Throws Cancelled.
[[nodiscard]] SimplifiedModel simplify_model(Mesh&& mesh, const Attributes& attributes,
                                             const SimplifyOptions& options, bool prunes = false);

}  // namespace mesher::simplify
