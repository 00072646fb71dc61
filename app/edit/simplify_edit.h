#pragma once

#include <cstdint>
#include <memory>

#include "app/document/edit_task.h"
#include "app/document/simplification.h"

namespace mesher::app {

/// Removes about 10 % of the shown faces, and at least one edge.
std::unique_ptr<EditTask> remove_tenth_edit(const SimplifySettings& settings);
/// Collapses one edge of the shown model.
std::unique_ptr<EditTask> collapse_edge_edit(const SimplifySettings& settings);
/// Simplifies the model as it was opened to `faces`; at least 1.
std::unique_ptr<EditTask> simplify_to_edit(const SimplifySettings& settings, std::uint32_t faces);

/// The engine's options for these settings. `diagonal`: of the model's bounding box.
simplify::SimplifyOptions options_of(const SimplifySettings& settings, double diagonal);

}  // namespace mesher::app
