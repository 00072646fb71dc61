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
void show_levels(Document& document, DetailLevels&& levels) {
  ProgressiveView& view = document.progressive;
  const bool is_new = !view.has_mesh();
  view.show(std::move(levels));
  // If the mode was left meanwhile, or creases are being edited, the mode does not change.
  if (!view.is_on() && (!is_new || document.creases.is_on)) return;
  enter_progressive(document);
  if (!is_new) return;
  const progressive::ProgressiveMesh& mesh = view.mesh();
  document.notice =
      fmt::format("{} to {} faces: Space plays, PageUp and PageDown refine{}",
                  count_text(mesh.base_face_count()), count_text(mesh.full_face_count()),
                  remark_on_base(document.progressive, document.statistics));
}

/// Builds the progressive mesh of the model.
class BuildProgressive final : public EditTask {
 public:
  BuildProgressive(const SimplifySettings& settings, bool rebuilds)
      : settings_(settings), rebuilds_(rebuilds) {}

  bool start(Document& document) override {
    if (document.progressive.has_mesh() && !rebuilds_) return false;
    start_ = copy_of(document.model);
    const double diagonal = document.statistics.box.diagonal();
    options_ = options_of(settings_, diagonal);
    options_.max_error = std::numeric_limits<double>::infinity();
    const std::uint32_t base_faces = document.progressive.settings().base_faces;
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

  void finish(Document& document) override { show_levels(document, std::move(levels_)); }

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
  bool start(Document& document) override {
    const ProgressiveView& view = document.progressive;
    if (!view.is_on() || view.is_arriving() || view.has_geomorph()) return false;
    progressive_.mesh = view.mesh();
    title_ = "Preparing geomorphs";
    return true;
  }

  void perform(Progress* progress) override {
    levels_ = detail_levels(std::move(progressive_), progress);
  }

  void finish(Document& document) override { show_levels(document, std::move(levels_)); }

 private:
  progressive::Progressive progressive_;
  DetailLevels levels_;
};

/// Uses the shown level as the model.
class KeepLevel final : public ModelEdit {
 public:
  bool start(Document& document) override {
    const ProgressiveView& view = document.progressive;
    return view.is_on() && !view.is_arriving() && prepare(document);
  }

  void perform(Progress*) override {
    record(kept_);
    far_percent_ = far_percent(shown_->mesh, kept_.mesh, statistics_.box.diagonal());
  }

 private:
  bool prepare(Document& document) override {
    take_shown(document);
    kept_ = shown_shape(document);
    const std::string faces = count_text(kept_.mesh.face_count(), "face");
    title_ = "Using the level of " + faces;
    edit_.name = "use the level of " + faces + " as the model";
    return true;
  }

  void report(Document& document) override {
    if (far_percent_) document.notice = far_from("the model", *far_percent_);
  }

  Shape kept_;
  std::optional<double> far_percent_;
};

}  // namespace

void toggle_progressive(Document& document) {
  ProgressiveView& view = document.progressive;
  if (view.is_on()) {
    if (view.is_arriving()) {
      document.notice = kArriving;
    } else {
      leave_progressive(document);
    }
  } else if (view.has_mesh()) {
    enter_progressive(document);
  } else if (document.model.mesh.face_count() == 0) {
    document.notice = "the model has no faces to build a progressive mesh from";
  } else {
    // Not when the mesh is built: if creases are edited meanwhile, their mode stays on.
    if (document.creases.is_on) set_crease_mode(document, false);
    request(document.edits, std::make_unique<BuildProgressive>(document.simplify, false));
  }
}

void enter_progressive(Document& document) {
  if (document.creases.is_on) set_crease_mode(document, false);
  document.progressive.turn(true);
  ++document.model_generation;
  const ProgressiveView& view = document.progressive;
  if (!view.has_geomorph() && !view.is_arriving()) request_geomorph(document);
}

void leave_progressive(Document& document) {
  if (!document.progressive.is_on()) return;
  document.progressive.turn(false);
  ++document.model_generation;
}

void forget_progressive(Document& document) {
  leave_progressive(document);
  document.progressive.forget();
}

void request_rebuilt_progressive(Document& document) {
  request(document.edits, std::make_unique<BuildProgressive>(document.simplify, true));
}

void request_geomorph(Document& document) {
  request(document.edits, std::make_unique<BuildGeomorph>());
}

void request_keep_level(Document& document) {
  if (document.progressive.is_on() && document.progressive.is_arriving()) {
    document.notice = kArriving;
  } else if (document.progressive.is_on()) {
    request(document.edits, std::make_unique<KeepLevel>());
  } else {
    document.notice = "press P first: this key works in progressive mode";
  }
}

}  // namespace mesher::app
