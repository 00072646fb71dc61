#pragma once

#include <span>

#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/simplify.h"

namespace mesher::simplify {

/// A mesh with its attributes.
struct Attributed {
  const Mesh& mesh;
  const Attributes& attributes;
};

/// Returns the groups of faces that were those of the input, and no values.
Attributes carried_groups(const Attributes& attributes, std::span<const Face> face_source);

/// Returns the attributes of a simplified mesh.
///
/// The value of a corner is that of the nearest point of the input that is reached from the source
/// of its face without crossing a seam, so both sides of a seam stay apart. Numbers are blended by
/// barycentric coordinates; normals and tangents have unit length again; joints are those of all
/// three corners, as many as there is room for (JointSum); other integers come from the nearest
/// corner. Tangents that followed from the normals and the texture coordinates follow from those of
/// the result (carry_tangents.h). If most edges of the input separate normals, as with a normal per
/// face, the result has a normal per face, too. Groups follow their faces. A vertex that has not
/// moved keeps its other values, bit for bit.
///
/// `face_source` is the face of the input that each face of the result was. O(F) in the result,
/// with a short walk per wedge; parallel. Throws Cancelled.
Attributes carry_attributes(const Attributed& input, const Mesh& result,
                            std::span<const Face> face_source, Progress* progress = nullptr);

/// Same for a result of `simplify` with a metric: the layers of the metric get the values that the
/// simplification found.
Attributes carry_attributes(const Attributed& input, const Simplified& result,
                            const AttributeMetric& metric, Progress* progress = nullptr);

}  // namespace mesher::simplify
