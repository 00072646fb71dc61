#include "app/progressive_edits.h"

#include <utility>

#include "app/session.h"
#include "app/words.h"
#include "engine/progressive/build.h"
#include "engine/simplify/attributes.h"

namespace mesher::app {
namespace {

/// What carry_attributes asks for, of a level.
Simplified as_simplified(const ProgressiveMesh& mesh, const DetailLevels& levels,
                         std::uint32_t vertices_before) {
  Simplified result;
  result.mesh = mesh.mesh();
  const auto vertices = levels.vertex_source.begin();
  result.vertex_source.assign(vertices, vertices + result.mesh.vertex_count());
  result.face_source.resize(result.mesh.face_count());
  for (std::size_t f = 0; f < result.face_source.size(); ++f)
    result.face_source[f] = Mesh::face(levels.face_source[f]);
  result.report.vertices_before = vertices_before;
  result.report.collapses = 1;  // ids are others even at full detail
  return result;
}

/// What a person should know of the base: "; ...", or nothing.
std::string words_on_base(const Session& session) {
  const std::optional<SimplifyReport>& report = session.progressive.levels().report;
  if (!report) return {};
  const SimplifyOutcome base{*report, session.statistics.box.diagonal(), {}};
  if (base.is_far()) return "; the base is " + far_from("the model", base.error_percent());
  if (report->reason == StopReason::target_reached) return {};
  return "; the base: " + stop_text(report->reason);
}

}  // namespace

void toggle_progressive(Session& session) {
  ProgressiveView& view = session.progressive;
  if (view.is_on()) {
    if (view.is_arriving()) {
      session.notice = "the file is still arriving (Esc: no more of it)";
    } else {
      leave_progressive(session);
    }
  } else if (view.has_mesh()) {
    enter_progressive(session);
  } else if (session.model.mesh.face_count() == 0) {
    session.notice = "there is nothing to refine";
  } else {
    // Now, not when it is made: who turns creases on meanwhile wants to see them.
    if (session.creases.is_on) set_crease_mode(session, false);
    request_edit(session, {.kind = EditRequest::Kind::progressive});
  }
}

void enter_progressive(Session& session) {
  if (session.creases.is_on) set_crease_mode(session, false);
  session.progressive.turn(true);
  ++session.model_generation;
  const ProgressiveView& view = session.progressive;
  if (!view.has_geomorph() && !view.is_arriving()) {
    request_edit(session, {.kind = EditRequest::Kind::geomorph});
  }
}

void leave_progressive(Session& session) {
  if (!session.progressive.is_on()) return;
  session.progressive.turn(false);
  ++session.model_generation;
}

void forget_progressive(Session& session) {
  leave_progressive(session);
  session.progressive.forget();
}

bool refuse_in_progressive(Session& session) {
  if (!session.progressive.is_on()) return false;
  session.notice = "a progressive mesh is shown: P leaves it, K keeps this level as the model";
  return true;
}

void request_keep_level(Session& session) {
  if (session.progressive.is_on() && session.progressive.is_arriving()) {
    session.notice = "the file is still arriving (Esc: no more of it)";
  } else if (session.progressive.is_on()) {
    request_edit(session, {.kind = EditRequest::Kind::keep_level});
  } else {
    session.notice = "P shows the model as a progressive mesh; then its levels can be kept";
  }
}

DetailLevels perform_progressive(const ProgressiveWork& work, Progress* progress) {
  begin_stage(progress, "simplifying");
  SimplifyOptions options = work.options;
  options.progress = progress;
  Progressive made = make_progressive(work.start->mesh, options);
  const SimplifyReport report = made.report;
  DetailLevels levels = detail_levels(std::move(made), progress);
  levels.report = report;
  return levels;
}

void finish_progressive(Session& session, DetailLevels&& levels) {
  ProgressiveView& view = session.progressive;
  const bool is_new = !view.has_mesh();
  view.show(std::move(levels));
  // Who has left the mode meanwhile, or turned creases on, is not taken back.
  if (!view.is_on() && (!is_new || session.creases.is_on)) return;
  enter_progressive(session);
  if (!is_new) return;
  const ProgressiveMesh& mesh = view.mesh();
  session.notice = with_commas(mesh.base_face_count()) + " to " +
                   with_commas(mesh.full_face_count()) +
                   " faces: Space plays, PageUp and PageDown refine" + words_on_base(session);
}

const Mesh& shown_mesh(const Session& session) {
  return session.progressive.is_on() ? session.progressive.mesh().mesh() : session.model.mesh;
}

Mesh& shown_mesh(Session& session) {
  return session.progressive.is_on() ? session.progressive.mesh().mesh() : session.model.mesh;
}

Shape shown_shape(const Session& session) {
  if (!session.progressive.is_on()) return {session.model.mesh, session.model.attributes};
  const DetailLevels& levels = session.progressive.levels();
  const Model& model = session.model;
  if (levels.vertex_source.empty() || model.attributes.is_empty()) {
    return {shown_mesh(session), {}};
  }
  Simplified level = as_simplified(session.progressive.mesh(), levels, model.mesh.vertex_count());
  Attributes attributes =
      carry_attributes(model.attributes, model.mesh.origins(), level).attributes;
  return {std::move(level.mesh), std::move(attributes)};
}

render::Settings shown_settings(const Session& session) {
  render::Settings settings = session.settings;
  const ProgressiveView& view = session.progressive;
  if (!view.is_on()) return settings;
  settings.geomorph = view.growth();
  settings.colors_by_split_order = view.settings().colors_by_split_order;
  settings.first_split_vertex = view.mesh().base_vertex_count();
  return settings;
}

render::Sources shown_sources(const Session& session) {
  const ProgressiveView& view = session.progressive;
  if (!view.is_on()) return {.corner_normals = shading_normals(session)};
  if (!view.has_geomorph()) return {};
  const Geomorph& geomorph = view.levels().geomorph;
  return {.vertex_normals = geomorph.normals(),
          .morph = {.heads = geomorph.heads(), .splits = geomorph.splits()}};
}

double shown_pixels_a_unit(const Session& session) {
  return pixels_a_unit(session.camera, session.statistics.box, session.window);
}

}  // namespace mesher::app
