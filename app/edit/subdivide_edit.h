#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/document/document.h"
#include "app/document/edit_task.h"
#include "app/document/subdivision.h"
#include "app/edit/edit_words.h"

namespace mesher::app {

enum class LevelStep : std::uint8_t { finer, coarser, none };

/// Goes to the next finer or coarser level, or rebuilds the shown level by other rules. Refuses,
/// with a notice, if the result would need more memory than is free.
std::unique_ptr<EditTask> subdivide_edit(const subdivide::SubdivideOptions& rules, LevelStep step,
                                         std::uint32_t mesh);

/// The edit that `words` describe: "subdivide", "coarsen" or "change_rules", by `rules` unless
/// `words` have others. Throws UsageError.
std::unique_ptr<EditTask> subdivide_edit(EditWords& words, subdivide::SubdivideOptions rules);

/// Returns why the model, or one mesh of it, cannot be shown at this level by these rules, with the
/// memory that it would need; empty if it can.
std::string level_refusal(const Document& document, std::uint32_t level,
                          const subdivide::SubdivideOptions& rules, std::uint32_t mesh = kNone);

/// Resets the document's rules to those of the shown level. Rules whose edit was refused or undone
/// would otherwise stay. Does nothing at level 0, or if an edit that may change the level is
/// requested.
void follow_shown_level(Edits& edits, subdivide::SubdivideOptions& subdivide);

/// Call after the document's rules have changed. Requests the shown level by these rules, and sets
/// the notice to the rules.
void apply_subdivide_settings(Document& document);

}  // namespace mesher::app
