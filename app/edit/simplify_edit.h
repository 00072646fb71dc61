#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/document/edit_task.h"
#include "app/document/simplification.h"
#include "app/edit/edit_words.h"

namespace mesher::app {

/// Removes about 10 % of the shown faces, and at least one edge.
std::unique_ptr<EditTask> remove_tenth_edit(const SimplifySettings& settings);
/// Collapses one edge of the shown model.
std::unique_ptr<EditTask> collapse_edge_edit(const SimplifySettings& settings);
/// Simplifies the model as it was opened to `faces`; 0: as far as the largest error allows. Pre:
/// one of them is set.
std::unique_ptr<EditTask> simplify_to_edit(const SimplifySettings& settings, std::uint32_t faces);

/// The edit that `words` describe: "simplify", "simplify_edge" or "simplify_to faces=N", with the
/// rules of `settings` unless `words` have others. Throws UsageError.
std::unique_ptr<EditTask> simplify_edit(EditWords& words, SimplifySettings settings);
/// The bound as words: "max error 0.5 %".
std::string bound_text(const SimplifySettings& settings);
/// Appends all rules to the text of an edit, and takes them from it again.
void append_rules(std::string& words, const SimplifySettings& settings);
void take_rules(EditWords& words, SimplifySettings& settings);

/// The engine's options for these settings. `diagonal`: of the model's bounding box.
simplify::SimplifyOptions options_of(const SimplifySettings& settings, double diagonal);

}  // namespace mesher::app
