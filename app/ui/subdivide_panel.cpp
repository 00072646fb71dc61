#include <imgui.h>

#include "app/memory_budget.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/words.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::app {
namespace {

// In the order of the enums.
constexpr Choice kSchemes[kSchemeCount] = {
    {"Loop", "Smooth everywhere: approximates the corners of the mesh. Key: M."},
    {"butterfly", "Goes through the vertices of the mesh, which stay where they are."},
    {"midpoint", "Splits edges in the middle: more triangles, the same surface."}};
constexpr Choice kCreaseRules[kCreaseRulesCount] = {
    {"Hoppe 1994",
     "Darts, regular and non-regular creases, corners: the surface is smooth up to\n"
     "both sides of a crease, and a crease ends smoothly. The default. Key: R."},
    {"DeRose 1998", "As OpenSubdiv and most modelling programs have it."}};
constexpr Choice kBoundaries[kBoundaryRoundingCount] = {
    {"rounded", "The boundary is a smooth curve, at vertices with one face, too."},
    {"corners stay", "A boundary vertex with one face stays where it is."}};
constexpr Choice kDecays[kCreaseDecayCount] = {
    {"uniform", "Semi-sharp edges lose 1 a level."},
    {"Chaikin", "Semi-sharp edges are averaged along the crease, then lose 1 a level."}};

void ask(Session& session, EditRequest::Kind kind) {
  request_edit(session, {.kind = kind});
}

/// What the next level would be.
std::string next_level_text(const Statistics& s) {
  constexpr std::uint64_t kBytesAFace = 44;  // as docs/architecture.md counts them
  const std::uint64_t faces = 4 * static_cast<std::uint64_t>(s.faces);
  return with_commas(faces) + " faces, " + bytes_text(kBytesAFace * faces);
}

void draw_levels(Session& session) {
  const std::uint32_t level = shown_level(session);
  const bool has_faces = session.statistics.faces > 0;
  if (half_button("finer", has_faces && level < kMostLevels,
                  ("S: " + next_level_text(session.statistics)).c_str())) {
    ask(session, EditRequest::Kind::finer);
  }
  ImGui::SameLine();
  if (half_button("coarser", level > 0,
                  level > 0 ? "Shift+S: nothing is lost" : "nothing coarser is kept")) {
    ask(session, EditRequest::Kind::coarser);
  }
  label("level");
  ImGui::Text("%u", level);
  tooltip("What was subdivided is kept: levels go up and down, and rules change, without loss.");
}

/// Returns whether anything was changed.
bool draw_rules(SubdivideSettings& settings) {
  bool is_changed = choose("scheme", kSchemes, settings.scheme);
  ImGui::BeginDisabled(settings.scheme == Scheme::midpoint);
  is_changed |= choose("crease rules", kCreaseRules, settings.creases);
  is_changed |= choose("boundary", kBoundaries, settings.boundary);
  ImGui::EndDisabled();
  is_changed |= choose("crease decay", kDecays, settings.decay);
  ImGui::BeginDisabled(settings.scheme != Scheme::loop);
  label("limit");
  is_changed |= ImGui::Checkbox("##limit", &settings.limit);
  tooltip(
      "Moves every vertex to where it would go in the end, and shades (G) with the normals of\n"
      "the limit surface. Of Loop; the vertices of the other schemes stay. Key: L.");
  ImGui::EndDisabled();
  return is_changed;
}

}  // namespace

float draw_subdivide_panel(Session& session, float top, PanelAreas& areas) {
  if (begin_side_panel("Subdivide", top)) {
    draw_levels(session);
    ImGui::Separator();
    if (draw_rules(session.subdivide)) apply_subdivide_settings(session);
    if (const auto& last = session.edits.last_subdivision) {
      label("last");
      ImGui::Text("%s",
                  (with_commas(last->faces) + " faces in " + seconds_text(last->seconds)).c_str());
    }
  }
  return end_side_panel(areas);
}

}  // namespace mesher::app
