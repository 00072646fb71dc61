#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/render/material_block.h"
#include "engine/render/picture_view.h"

namespace mesher::render {

/// The materials of a model as they are drawn. The last one is for faces without.
struct DrawnMaterials {
  std::span<const PackedMaterial> packed;
  const std::vector<bool>& is_two_sided;
};

/// Returns how many pixels per side each image needs in a picture: infinity if it needs all. In an
/// image of that size, at most 0.5 % of the picture's textured pixels would be magnified, and none
/// by more than the square root of 2.
///
/// The density of texture coordinates is bounded from below for each triangle: it is least at one
/// of the corners but for the perspective, whose factor is taken where it is least. A triangle that
/// reaches behind the eye needs everything. One beside the picture, or seen from behind if only its
/// front is drawn, needs nothing. O(F + materials).
std::vector<float> needed_sides(const Mesh& mesh, const Attributes& attributes,
                                const DrawnMaterials& materials, const PictureView& picture);

}  // namespace mesher::render
