#include "app/edit/progressive_edits.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "app/document/shown.h"
#include "app/document/words.h"
#include "app/edit/crease_edits.h"
#include "app/edit/distance_from_input.h"
#include "app/edit/edits.h"
#include "app/edit/model_edit.h"
#include "app/edit/simplify_edit.h"
#include "engine/core/text.h"
#include "engine/progressive/base.h"
#include "engine/progressive/build.h"

namespace mesher::app {
namespace {

constexpr const char* kArriving = "the file is still loading; press Esc to stop loading";

/// Returns a remark on the base ("; ..."), or an empty string.
std::string remark_on_base(const ProgressiveView& progressive, const Statistics& statistics) {
  const std::optional<simplify::SimplifyReport>& report = progressive.levels().report;
  if (!report) return {};
  const SimplifyOutcome base{*report, statistics.box.diagonal(), {}};
  if (base.is_far()) return "; the base is " + far_from("the model", base.error_percent());
  if (report->reason == simplify::StopReason::target_reached) return {};
  return "; the base: " + stop_text(report->reason);
}

/// Shows the levels. The first ones turn the mode on, unless creases are being edited.
void show_levels(Session& session, DetailLevels&& levels) {
  ProgressiveView& view = session.progressive;
  const bool is_new = !view.has_mesh();
  view.show(std::move(levels));
  // If the mode was left meanwhile, or creases are being edited, the mode does not change.
  if (!view.is_on() && (!is_new || session.creases.is_on)) return;
  enter_progressive(session);
  if (!is_new) return;
  const progressive::ProgressiveMesh& mesh = view.mesh();
  session.notice =
      fmt::format("{} to {} faces: Space plays, PageUp and PageDown refine{}",
                  count_text(mesh.base_face_count()), count_text(mesh.full_face_count()),
                  remark_on_base(session.progressive, session.statistics));
}

/// Builds the progressive mesh of the model.
class BuildProgressive final : public EditTask {
 public:
  BuildProgressive(const SimplifySettings& settings, bool rebuilds)
      : settings_(settings), rebuilds_(rebuilds) {}

  bool start(Session& session) override {
    if (session.progressive.has_mesh() && !rebuilds_) return false;
    start_ = copy_of(session.model);
    const double diagonal = session.statistics.box.diagonal();
    options_ = options_of(settings_, diagonal);
    options_.max_error = std::numeric_limits<double>::infinity();
    const std::uint32_t base_faces = session.progressive.settings().base_faces;
    if (base_faces > 0) {
      options_.target_faces = base_faces;
    } else {
      progressive::choose_base(options_, start_->mesh.face_count(), diagonal);
    }
    title_ = "Building the progressive mesh";
    return true;
  }

  void perform(Progress* progress) override {
    begin_stage(progress, "simplifying");
    options_.progress = progress;
    progressive::Progressive made = progressive::make_progressive(start_->mesh, options_);
    const simplify::SimplifyReport report = made.report;
    levels_ = detail_levels(std::move(made), progress);
    levels_.report = report;
  }

  void finish(Session& session) override { show_levels(session, std::move(levels_)); }

 private:
  SimplifySettings settings_;
  bool rebuilds_;
  std::shared_ptr<const Shape> start_;
  simplify::SimplifyOptions options_;
  DetailLevels levels_;
};

/// Computes the geomorphs and level errors, which a file does not contain.
class BuildGeomorph final : public EditTask {
 public:
  bool start(Session& session) override {
    const ProgressiveView& view = session.progressive;
    if (!view.is_on() || view.is_arriving() || view.has_geomorph()) return false;
    progressive_.mesh = view.mesh();
    title_ = "Preparing geomorphs";
    return true;
  }

  void perform(Progress* progress) override {
    levels_ = detail_levels(std::move(progressive_), progress);
  }

  void finish(Session& session) override { show_levels(session, std::move(levels_)); }

 private:
  progressive::Progressive progressive_;
  DetailLevels levels_;
};

/// Uses the shown level as the model.
class KeepLevel final : public ModelEdit {
 public:
  bool start(Session& session) override {
    const ProgressiveView& view = session.progressive;
    return view.is_on() && !view.is_arriving() && prepare(session);
  }

  void perform(Progress*) override {
    record(kept_);
    far_percent_ = far_percent(shown_->mesh, kept_.mesh, statistics_.box.diagonal());
  }

 private:
  bool prepare(Session& session) override {
    take_shown(session);
    kept_ = shown_shape(session);
    const std::string faces = count_text(kept_.mesh.face_count(), "face");
    title_ = "Using the level of " + faces;
    edit_.name = "use the level of " + faces + " as the model";
    return true;
  }

  void report(Session& session) override {
    if (far_percent_) session.notice = far_from("the model", *far_percent_);
  }

  Shape kept_;
  std::optional<double> far_percent_;
};

}  // namespace

void toggle_progressive(Session& session) {
  ProgressiveView& view = session.progressive;
  if (view.is_on()) {
    if (view.is_arriving()) {
      session.notice = kArriving;
    } else {
      leave_progressive(session);
    }
  } else if (view.has_mesh()) {
    enter_progressive(session);
  } else if (session.model.mesh.face_count() == 0) {
    session.notice = "the model has no faces to build a progressive mesh from";
  } else {
    // Not when the mesh is built: if creases are edited meanwhile, their mode stays on.
    if (session.creases.is_on) set_crease_mode(session, false);
    request(session.edits, std::make_unique<BuildProgressive>(session.simplify, false));
  }
}

void enter_progressive(Session& session) {
  if (session.creases.is_on) set_crease_mode(session, false);
  session.progressive.turn(true);
  ++session.model_generation;
  const ProgressiveView& view = session.progressive;
  if (!view.has_geomorph() && !view.is_arriving()) request_geomorph(session);
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

void request_rebuilt_progressive(Session& session) {
  request(session.edits, std::make_unique<BuildProgressive>(session.simplify, true));
}

void request_geomorph(Session& session) {
  request(session.edits, std::make_unique<BuildGeomorph>());
}

void request_keep_level(Session& session) {
  if (session.progressive.is_on() && session.progressive.is_arriving()) {
    session.notice = kArriving;
  } else if (session.progressive.is_on()) {
    request(session.edits, std::make_unique<KeepLevel>());
  } else {
    session.notice = "press P first: this key works in progressive mode";
  }
}

}  // namespace mesher::app
