#include "app/subdivision.h"

#include <utility>

#include "app/memory_budget.h"
#include "app/session.h"
#include "engine/core/memory.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::app {
namespace {

// The model that will be shown: that, the result, its arrays in the history, and the GPU's mirror.
constexpr unsigned kCopies = 4;
// The model that is shown: the task's, and its arrays in the history.
constexpr unsigned kCopiesBefore = 2;

/// What is shown, as a level; without its base where nothing is subdivided.
SubdivisionLevel shown(const Session& session) {
  return session.edits.subdivision.value_or(SubdivisionLevel{});
}

SubdivideOptions options_of(const SubdivideSettings& settings, std::uint32_t level) {
  return {.levels = level,
          .scheme = settings.scheme,
          .creases = settings.creases,
          .boundary = settings.boundary,
          .decay = settings.decay,
          .limit = settings.limit};
}

std::uint64_t shown_bytes(const Session& session) {
  const Attributes& a = session.model.attributes;
  return session.model.mesh.memory_bytes() + std::span(a.texcoord).size_bytes() +
         std::span(a.normal).size_bytes() + std::span(a.color).size_bytes() +
         std::span(a.group).size_bytes();
}

std::string refusal(const Session& session, const SubdivisionLevel& from, std::uint32_t level,
                    const SubdivideSettings& settings) {
  if (level == 0) return "";  // nothing is made, and it is the way out of want of memory
  const Mesh& base = from.base ? from.base->mesh : session.model.mesh;
  const Attributes& attributes = from.base ? from.base->attributes : session.model.attributes;
  if (base.face_count() == 0) return "there is nothing to subdivide";
  if (level > kMostLevels) return "that is the finest level there is";
  return subdivision_refusal(subdivision_size(base, options_of(settings, level)), level,
                             {.available = available_memory_bytes(),
                              .copies = kCopies,
                              .beside = subdivided_attribute_bytes(attributes, level),
                              .held = kCopiesBefore * shown_bytes(session)});
}

}  // namespace

std::uint32_t shown_level(const Session& session) {
  return shown(session).level;
}

std::optional<SubdivisionLevel> begin_subdivision(Session& session, std::uint32_t level,
                                                  const SubdivideSettings& settings) {
  SubdivisionLevel wanted = shown(session);
  const bool is_shown = wanted.level == level && (level == 0 || wanted.settings == settings);
  if (is_shown) return std::nullopt;
  if (std::string reason = refusal(session, wanted, level, settings); !reason.empty()) {
    session.notice = std::move(reason);
    follow_shown_level(session);
    return std::nullopt;
  }
  wanted.level = level;
  wanted.settings = settings;
  return wanted;
}

void follow_shown_level(Session& session) {
  const auto& level = session.edits.subdivision;
  if (level && level->level > 0 && session.edits.waiting.empty()) {
    session.subdivide = level->settings;
  }
}

void apply_subdivide_settings(Session& session) {
  const SubdivideSettings& settings = session.subdivide;
  session.notice = "subdivision: " + std::string(key(settings.scheme)) + ", " +
                   std::string(key(settings.creases)) + (settings.limit ? ", limit surface" : "");
  request_edit(session, {.kind = EditRequest::Kind::same_level});
}

Shape subdivided(const SubdivisionLevel& wanted, Progress* progress) {
  if (wanted.level == 0) return *wanted.base;
  SubdivideOptions options = options_of(wanted.settings, wanted.level);
  options.progress = progress;
  Subdivided result = subdivide(wanted.base->mesh, options);
  Shape shape{std::move(result.mesh),
              subdivide_attributes(wanted.base->attributes, wanted.level, progress)};
  if (!result.limit_normal.empty()) shape.attributes.normal = std::move(result.limit_normal);
  return shape;
}

std::span<const glm::vec3> shading_normals(const Session& session) {
  const auto& level = session.edits.subdivision;
  const Array<glm::vec3>& normals = session.model.attributes.normal;
  const bool has_limit =
      level && level->level > 0 && level->settings.limit && level->settings.scheme == Scheme::loop;
  if (!has_limit || normals.size() != session.model.mesh.halfedge_count()) return {};
  return normals;
}

std::string name_of(const SubdivisionLevel& before, const SubdivisionLevel& after) {
  const std::string level = std::to_string(after.level);
  if (after.level < before.level) return "back to level " + level;
  if (after.level == before.level) return "other rules at level " + level;
  return "subdivide to level " + level;
}

}  // namespace mesher::app
