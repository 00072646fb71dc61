#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/shape.h"
#include "engine/subdivide/options.h"

namespace mesher {
class Progress;
}

namespace mesher::app {

struct Session;

/// By which rules the next subdivision goes, as the panel shows them.
struct SubdivideSettings {
  Scheme scheme = Scheme::loop;
  CreaseRules creases = CreaseRules::hoppe94;
  BoundaryRounding boundary = BoundaryRounding::edge_only;
  CreaseDecay decay = CreaseDecay::uniform;
  bool limit = false;

  friend bool operator==(const SubdivideSettings&, const SubdivideSettings&) = default;
};

/// What is shown is `base`, subdivided `level` times by these rules. The base is kept, so that
/// levels go up and down, and rules change, without loss.
struct SubdivisionLevel {
  std::shared_ptr<const Shape> base;
  std::uint32_t level = 0;
  SubdivideSettings settings;
};

/// The most that a person can ask for: 4^12 faces a face.
inline constexpr std::uint32_t kMostLevels = 12;

/// How the last subdivision went.
struct SubdivideOutcome {
  std::uint32_t level = 0;
  std::uint32_t faces = 0;
  double seconds = 0.0;
};

/// The level that is shown: 0 where nothing is subdivided.
std::uint32_t shown_level(const Session& session);

/// The step from what is shown to `level`, by these rules. None where there is nothing to
/// do or it cannot be done, which the session's notice says; so it does where that would take more
/// memory than is free, and how much. Without a base where that is what is shown, of which nothing
/// is kept yet. O(F).
std::optional<SubdivisionLevel> begin_subdivision(Session& session, std::uint32_t level,
                                                  const SubdivideSettings& settings);

/// Takes the session's rules back to those of the level that is shown, if there is one and nothing
/// waits that may still change it: what is not done, or undone, has no rules to show.
void follow_shown_level(Session& session);

/// The shape on the level that is wanted. Touches no session. Throws Cancelled.
Shape subdivided(const SubdivisionLevel& wanted, Progress* progress);

/// Call when the session's rules have changed: the level that is shown is made anew, once edits
/// that wait are done, and the notice says what the rules are.
void apply_subdivide_settings(Session& session);

/// Normals to shade the model with, one a corner: those of the limit surface where it is that;
/// otherwise empty, and the faces' are taken.
std::span<const glm::vec3> shading_normals(const Session& session);

/// "subdivide to level 2", "back to level 1": for the history.
std::string name_of(const SubdivisionLevel& before, const SubdivisionLevel& after);

}  // namespace mesher::app
