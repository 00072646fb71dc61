#pragma once

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// Returns the values of a layer of texture coordinates on the subdivided mesh, one per corner. The
/// values are subdivided like positions, chart by chart: a chart is a set of faces across whose
/// edges the values are continuous. Its border is an infinitely sharp crease by the rules of
/// `derose98`, which both sides of a seam follow alike. These vertices keep their values, on all
/// sides: where three or more seams or boundaries meet, where a seam ends, where a chart has one
/// face, and bow ties (as OpenSubdiv's FVAR_LINEAR_CORNERS_PLUS2). A vertex of a seam is as sharp
/// as the sharpest edge there that is not of the border. A face with a value that is missing or
/// infinite is a chart of its own. The result is the same for any number of threads. O(faces of the
/// result). Throws Cancelled. Pre: the layer is one of `attributes`, with at most three components,
/// which may be blended.
AttributeLayer subdivide_charts(const Mesh& mesh, const Attributes& attributes,
                                const AttributeLayer& layer, const SubdivideOptions& options);

/// Returns the number of bytes that subdivide_charts needs at most besides its result. O(1).
std::size_t chart_bytes(const Mesh& mesh, std::uint32_t levels);

}  // namespace mesher::subdivide
