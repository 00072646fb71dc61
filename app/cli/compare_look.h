#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/document/json.h"
#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/look_deviation.h"
#include "engine/mesh/model.h"

namespace mesher::app {

/// Returns how the groups of a model are textured: the size of their base color textures in texels.
std::vector<analysis::FaceTexture> face_textures(const Model& model);

/// Measures how much the look of the second model deviates from that of the first.
analysis::LookDeviation look_deviation(const Model& a, const Model& b, std::uint64_t samples,
                                       Progress* progress);

/// Adds the measures, and why others are missing. `diagonal` is what percentages are of.
void add_look(Json& json, const analysis::LookDeviation& look, double diagonal);
/// A label and what is printed behind it.
std::vector<std::pair<std::string, std::string>> rows_of(const analysis::LookDeviation& look,
                                                         double diagonal);

}  // namespace mesher::app
