#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/document/edit_task.h"
#include "app/document/session.h"
#include "app/document/subdivision.h"

namespace mesher::app {

enum class LevelStep : std::uint8_t { finer, coarser, none };

/// Goes one level up or down from the shown one, or rebuilds it by other rules. Refuses, with a
/// notice, where the result would need more memory than is free.
std::unique_ptr<EditTask> subdivide_edit(const SubdivideOptions& rules, LevelStep step);

/// Why the model cannot be shown at this level by these rules, with the memory that it would need;
/// empty: it can.
std::string level_refusal(const Session& session, std::uint32_t level,
                          const SubdivideOptions& rules);

/// Resets the session's rules to those of the shown level, if there is one and no edit is waiting
/// that may still change it: rules whose edit was refused or undone are not in force.
void follow_shown_level(Session& session);

/// Call after the session's rules have changed. Requests the shown level by these rules, and says
/// in the notice what the rules are.
void apply_subdivide_settings(Session& session);

}  // namespace mesher::app
