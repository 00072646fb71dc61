#include "app/edits.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "app/distance_from_input.h"
#include "app/session.h"
#include "app/words.h"
#include "engine/progressive/base.h"
#include "engine/simplify/attributes.h"
#include "engine/simplify/simplify.h"

namespace mesher::app {
namespace {

/// Faces that are left to ask for. One that does not divide evenly counts: at least one goes.
std::uint32_t target_of(const EditRequest& request, std::uint32_t faces) {
  switch (request.kind) {
    case EditRequest::Kind::remove_tenth:
      return faces - (faces / 10 + (faces % 10 == 0 ? 0 : 1));
    case EditRequest::Kind::remove_edge:
      return faces - 1;
    default:
      return std::max(request.target_faces, 1U);
  }
}

SimplifyOptions options_of(const SimplifySettings& settings, double diagonal) {
  SimplifyOptions options{.cost = settings.cost,
                          .placement = settings.placement,
                          .boundary = settings.boundary,
                          .crease_angle_deg = settings.crease_angle_deg,
                          .seed = settings.seed,
                          .order = ResultOrder::fill_holes};
  if (settings.max_error_percent > 0.0F) {
    options.max_error = 0.01 * settings.max_error_percent * diagonal;
  }
  return options;
}

std::shared_ptr<const Shape> copy_of(const Model& model) {
  return std::make_shared<const Shape>(Shape{model.mesh, model.attributes});
}

/// Everything but sharpness is the same.
bool has_same_surface(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.origins(), b.origins()) && std::ranges::equal(a.twins(), b.twins()) &&
         std::ranges::equal(a.positions(), b.positions());
}

void undo(Session& session) {
  History& history = session.edits.history;
  if (history.undo_depth() == 0) {
    session.notice = "nothing to undo";
    return;
  }
  std::string notice = "undone: " + history.undo_name();
  const bool keeps_topology = history.undo_edit().mesh.keeps_topology();
  history.undo(session.model, session.statistics);
  session.notice = std::move(notice);
  session.edits.subdivision = history.redo_edit().subdivision_before;
  session.edits.was_undone = true;
  note_model_changed(session, keeps_topology);
  follow_shown_level(session);
}

void redo(Session& session) {
  History& history = session.edits.history;
  if (history.redo_depth() == 0) {
    session.notice = "nothing to redo";
    return;
  }
  std::string notice = "done again: " + history.redo_name();
  const bool keeps_topology = history.redo_edit().mesh.keeps_topology();
  history.redo(session.model, session.statistics);
  session.notice = std::move(notice);
  session.edits.subdivision = history.undo_edit().subdivision_after;
  session.edits.was_undone = false;
  note_model_changed(session, keeps_topology);
  follow_shown_level(session);
}

/// A task that starts from what is shown. The first one also keeps that, as what was opened.
EditTask task_for_shown(Session& session) {
  Edits& edits = session.edits;
  EditTask task;
  task.shown = edits.opened ? copy_of(session.model) : nullptr;
  if (!edits.opened) edits.opened = task.shown = copy_of(session.model);
  task.statistics = session.statistics;
  return task;
}

bool is_about_detail(EditRequest::Kind kind) {
  return kind == EditRequest::Kind::progressive || kind == EditRequest::Kind::geomorph ||
         kind == EditRequest::Kind::keep_level;
}

bool is_subdivision(EditRequest::Kind kind) {
  return kind == EditRequest::Kind::finer || kind == EditRequest::Kind::coarser ||
         kind == EditRequest::Kind::same_level;
}

std::optional<EditTask> subdivision_task(Session& session, const EditRequest& request) {
  const std::uint32_t level = shown_level(session);
  std::uint32_t wanted = level;
  if (request.kind == EditRequest::Kind::finer) wanted = level + 1;
  if (request.kind == EditRequest::Kind::coarser) {
    if (level == 0) {
      session.notice = "nothing coarser is kept";
      return std::nullopt;
    }
    wanted = level - 1;
  }
  auto step = begin_subdivision(session, wanted, request.subdivide);
  if (!step) return std::nullopt;
  EditTask task = task_for_shown(session);
  task.title = "Subdividing to level " + std::to_string(wanted);
  task.name = name_of(session.edits.subdivision.value_or(SubdivisionLevel{}), *step);
  if (!step->base) step->base = task.shown;
  task.work = *std::move(step);
  return task;
}

EditTask simplify_task(Session& session, const EditRequest& request) {
  Edits& edits = session.edits;
  EditTask task = task_for_shown(session);
  const bool is_from_opened = request.kind == EditRequest::Kind::simplify_to;
  Simplification work{is_from_opened ? edits.opened : task.shown, edits.opened,
                      options_of(request.simplify, session.statistics.box.diagonal())};
  const std::uint32_t target = target_of(request, work.start->mesh.face_count());
  work.options.target_faces = target;
  if (request.kind == EditRequest::Kind::remove_edge) {
    task.title = "Collapsing an edge";
    task.name = "collapse an edge";
  } else {
    task.title = "Simplifying to " + with_commas(target) + " faces";
  }
  task.work = std::move(work);
  return task;
}

EditTask progressive_task(const Session& session, const EditRequest& request) {
  ProgressiveWork work{copy_of(session.model),
                       options_of(request.simplify, session.statistics.box.diagonal())};
  work.options.max_error = std::numeric_limits<double>::infinity();
  const std::uint32_t base_faces = session.progressive.settings().base_faces;
  if (base_faces > 0) {
    work.options.target_faces = base_faces;
  } else {
    choose_base(work.options, work.start->mesh.face_count(), session.statistics.box.diagonal());
  }
  EditTask task;
  task.title = "Making a progressive mesh";
  task.work = std::move(work);
  return task;
}

EditTask geomorph_task(const Session& session) {
  EditTask task;
  task.title = "Preparing geomorphs";
  task.work = GeomorphWork{std::make_shared<ProgressiveMesh>(session.progressive.mesh())};
  return task;
}

EditTask keep_task(Session& session) {
  EditTask task = task_for_shown(session);
  KeptLevel kept{std::make_shared<const Shape>(shown_shape(session))};
  const std::string faces = with_commas(kept.shape->mesh.face_count()) + " faces";
  task.title = "Keeping " + faces;
  task.name = "keep a level of " + faces;
  task.work = std::move(kept);
  return task;
}

/// What is about the progressive mesh. None where it has gone.
std::optional<EditTask> detail_task(Session& session, const EditRequest& request) {
  const ProgressiveView& view = session.progressive;
  if (request.kind == EditRequest::Kind::progressive) {
    if (view.has_mesh() && !request.rebuilds) return std::nullopt;
    return progressive_task(session, request);
  }
  if (!view.is_on() || view.is_arriving()) return std::nullopt;
  if (request.kind == EditRequest::Kind::keep_level) return keep_task(session);
  if (view.has_geomorph()) return std::nullopt;  // asked for twice
  return geomorph_task(session);
}

/// What a person cannot see in the picture.
std::string notice_for(const SimplifyOutcome& outcome) {
  std::string notice;
  const SimplifyReport& report = outcome.report;
  if (report.reason == StopReason::no_legal_collapse || report.reason == StopReason::error_bound) {
    notice = std::string(describe(report.reason)) + ": " + with_commas(report.faces_reached) +
             (report.faces_reached == 1 ? " face" : " faces");
  }
  for (const std::string& dropped : outcome.dropped)
    notice += (notice.empty() ? "dropped " : "; dropped ") + dropped;
  if (outcome.is_far()) {
    notice += (notice.empty() ? "" : "; ") + far_from("what was opened", outcome.error_percent());
  }
  return notice;
}

/// What the task's shape becomes, as an edit.
void take_difference(const EditTask& task, const Shape& shape, Edit& edit) {
  edit.mesh = difference(task.shown->mesh, shape.mesh);
  edit.attributes = difference(task.shown->attributes, shape.attributes);
  edit.before = task.statistics;
  edit.after = statistics(shape.mesh);
}

EditResult perform_work(const EditTask& task, const Simplification& work, Progress* progress) {
  begin_stage(progress, "simplifying");
  SimplifyOptions options = work.options;
  options.progress = progress;
  Simplified simplified = simplify(Mesh(work.start->mesh), options);
  CarriedAttributes carried =
      carry_attributes(work.start->attributes, work.start->mesh.origins(), simplified);
  EditResult result;
  result.edit.name = task.name.empty()
                         ? "simplify to " + with_commas(simplified.report.faces_reached) + " faces"
                         : task.name;
  result.simplified = {simplified.report, task.statistics.box.diagonal(),
                       std::move(carried.dropped)};
  if (work.opened != work.start && simplified.mesh.face_count() <= kManyFaces) {
    result.simplified->error_from_opened = distance_from_input(work.opened->mesh, simplified.mesh);
  }
  take_difference(task, {std::move(simplified.mesh), std::move(carried.attributes)}, result.edit);
  return result;
}

EditResult perform_work(const EditTask& task, const SubdivisionLevel& wanted, Progress* progress) {
  const auto start = std::chrono::steady_clock::now();
  const Shape shape = subdivided(wanted, progress);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  EditResult result;
  result.edit.name = task.name;
  take_difference(task, shape, result.edit);
  result.edit.subdivision_after = wanted;
  result.subdivided = {wanted.level, shape.mesh.face_count(), elapsed.count()};
  return result;
}

EditResult perform_work(const EditTask&, const ProgressiveWork& work, Progress* progress) {
  EditResult result;
  result.levels = perform_progressive(work, progress);
  return result;
}

EditResult perform_work(const EditTask&, const GeomorphWork& work, Progress* progress) {
  Progressive progressive;
  progressive.mesh = std::move(*work.mesh);
  EditResult result;
  result.levels = detail_levels(std::move(progressive), progress);
  return result;
}

EditResult perform_work(const EditTask& task, const KeptLevel& kept, Progress*) {
  EditResult result;
  result.edit.name = task.name;
  take_difference(task, *kept.shape, result.edit);
  const double diagonal = task.statistics.box.diagonal();
  if (const auto percent = far_percent(task.shown->mesh, kept.shape->mesh, diagonal)) {
    result.notice = far_from("the model", *percent);
  }
  return result;
}

}  // namespace

void request_edit(Session& session, EditRequest request) {
  request.simplify = session.simplify;
  request.subdivide = session.subdivide;
  session.edits.waiting.push_back(request);
}

std::optional<EditTask> begin_edit(Session& session) {
  const EditRequest request = session.edits.waiting.front();
  session.edits.waiting.pop_front();
  // New rules have been said already.
  if (request.kind != EditRequest::Kind::same_level) session.notice.clear();
  if (is_about_detail(request.kind)) return detail_task(session, request);
  if (refuse_in_progressive(session)) {
    follow_shown_level(session);
  } else if (request.kind == EditRequest::Kind::undo) {
    undo(session);
  } else if (request.kind == EditRequest::Kind::redo) {
    redo(session);
  } else if (request.kind == EditRequest::Kind::creases) {
    edit_creases(session, request.creases);
  } else if (is_subdivision(request.kind)) {
    return subdivision_task(session, request);
  } else if (session.model.mesh.face_count() == 0) {
    session.notice = "there is nothing to simplify";
  } else {
    return simplify_task(session, request);
  }
  return std::nullopt;
}

EditResult perform(const EditTask& task, Progress* progress) {
  return std::visit([&](const auto& work) { return perform_work(task, work, progress); },
                    task.work);
}

void finish_edit(Session& session, EditResult&& result) {
  Edits& edits = session.edits;
  if (result.levels) return finish_progressive(session, *std::move(result.levels));
  const bool is_kept = session.progressive.is_on();
  if (result.simplified) {
    session.notice = notice_for(*result.simplified);
    edits.last = std::move(result.simplified);
  }
  if (!result.notice.empty()) session.notice = result.notice;
  if (result.subdivided) edits.last_subdivision = result.subdivided;
  if (result.edit.changes_anything()) {
    record_edit(session, std::move(result.edit));
  } else if (result.subdivided) {
    edits.subdivision = std::move(result.edit.subdivision_after);  // other rules, the same surface
  }
  if (is_kept) leave_progressive(session);
  follow_shown_level(session);
}

void record_edit(Session& session, Edit&& edit) {
  edit.subdivision_before = session.edits.subdivision;
  const bool keeps_topology = edit.mesh.keeps_topology();
  History& history = session.edits.history;
  history.perform(std::move(edit), session.model, session.statistics);
  session.edits.subdivision = history.undo_edit().subdivision_after;
  session.edits.was_undone = false;
  note_model_changed(session, keeps_topology);
}

bool take_back_last_edit(Session& session) {
  History& history = session.edits.history;
  if (session.edits.was_undone && history.redo_depth() > 0) {
    redo(session);
    session.edits.was_undone = true;  // where there were more in a row, they come next
    return true;
  }
  if (history.undo_depth() == 0) return false;
  const Edit taken_back = history.take_back(session.model, session.statistics);
  session.edits.subdivision = taken_back.subdivision_before;
  note_model_changed(session, taken_back.mesh.keeps_topology());
  follow_shown_level(session);
  return true;
}

void note_model_changed(Session& session, bool keeps_topology) {
  Edits& edits = session.edits;
  ++edits.revision;
  forget_progressive(session);
  if (!keeps_topology) return forget_edges(session);
  if (edits.opened && has_same_surface(edits.opened->mesh, session.model.mesh)) {
    edits.opened.reset();
  }
}

void run_waiting_edits(Session& session) {
  while (!session.edits.waiting.empty()) {
    if (const auto task = begin_edit(session)) finish_edit(session, perform(*task, nullptr));
  }
}

}  // namespace mesher::app
