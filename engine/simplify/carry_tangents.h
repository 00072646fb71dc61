#pragma once

#include "engine/mesh/mesh.h"
#include "engine/mesh/wedges.h"
#include "engine/simplify/carry_attributes.h"

namespace mesher::simplify {

/// Replaces the tangents of a result by those that MikkTSpace makes of its normals and of a set of
/// texture coordinates (engine/mesh/tangents.h), if nearly all tangents of the input are those of
/// its normals and that set. Tangents that somebody drew, as for brushed metal, stay as they were
/// carried. So do the values of corners without a tangent.
///
/// `stream`: the result's layers, one value per corner. O(F) in the input and the result, parallel.
void rebuild_tangents(const Attributed& input, const Mesh& result, AttributeStream& stream);

}  // namespace mesher::simplify
