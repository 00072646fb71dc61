#include "app/edit/progressive_edits.h"

#include <fmt/format.h>

#include <algorithm>
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
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/progressive/base.h"
#include "engine/progressive/build.h"
#include "engine/simplify/seams.h"

namespace mesher::app {
namespace {

constexpr const char* kKeepLevel = "keep_level";
constexpr const char* kSplits = "splits";
constexpr const char* kBaseFaces = "base-faces";

/// Times of building a progressive mesh, and of its geomorphs and level errors.
constexpr double kBuildWeights[] = {0.45, 0.55};
/// Times of making a level, and of recording the edit.
constexpr double kKeepWeights[] = {0.9, 0.1};

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
      fmt::format("{} to {} faces: Space plays, PageUp and PageDown change the level{}",
                  count_text(mesh.base_face_count()), count_text(mesh.full_face_count()),
                  remark_on_base(document.progressive, document.statistics));
}

/// How a progressive mesh of the model is built.
struct ProgressiveRules {
  SimplifySettings simplify;
  std::uint32_t base_faces = 0;  ///< as ProgressiveSettings::base_faces
};

simplify::SimplifyOptions options_of(const ProgressiveRules& rules, const Mesh& mesh,
                                     const Attributes& attributes, double diagonal) {
  simplify::SimplifyOptions options = options_of(rules.simplify, diagonal);
  options.max_error = std::numeric_limits<double>::infinity();
  if (rules.base_faces > 0) {
    options.target_faces = rules.base_faces;
  } else {
    progressive::choose_base(options, mesh.face_count(), diagonal,
                             simplify::may_have_lines(attributes));
  }
  return options;
}

/// Builds the progressive mesh of the model.
class BuildProgressive final : public EditTask {
 public:
  BuildProgressive(const SimplifySettings& settings, bool rebuilds)
      : settings_(settings), rebuilds_(rebuilds) {}

  bool start(Document& document) override {
    if (document.progressive.has_mesh() && !rebuilds_) return false;
    start_ = copy_of(document.model);
    const ProgressiveRules rules{settings_, document.progressive.settings().base_faces};
    options_ =
        options_of(rules, start_->mesh, start_->attributes, document.statistics.box.diagonal());
    levels_.built_by = fmt::format(" {}={}", kBaseFaces, rules.base_faces);
    append_rules(levels_.built_by, settings_);
    title_ = "Building the progressive mesh";
    return true;
  }

  void perform(Progress* progress) override {
    Stages stages(progress, kBuildWeights);
    stages.next("simplifying");
    options_.progress = progress;
    progressive::Progressive made =
        progressive::make_progressive(start_->mesh, start_->attributes, options_);
    stages.next();
    const simplify::SimplifyReport report = made.report;
    std::string built_by = std::move(levels_.built_by);
    levels_ = detail_levels(std::move(made), progress);
    levels_.report = report;
    levels_.built_by = std::move(built_by);
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
    progressive_.attributes = view.levels().attributes;
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

std::string name_of_level(const Mesh& level) {
  return "use the level of " + count_text(level.face_count(), "face") + " as the model";
}

/// Uses a level of a progressive mesh as the model.
class KeepLevel : public ModelEdit {
 public:
  void perform(Progress* progress) override {
    Stages stages(progress, kKeepWeights);
    stages.next();
    kept_ = level(progress);
    edit_.name = name_of_level(kept_.mesh);
    stages.next();
    record(kept_, progress);
    far_percent_ = far_percent(shown_->mesh, kept_.mesh, statistics_.box.diagonal());
  }

 protected:
  virtual Shape level(Progress* progress) = 0;

 private:
  void report(Document& document) override {
    if (far_percent_) document.notice = far_from("the model", *far_percent_);
  }

  Shape kept_;
  std::optional<double> far_percent_;
};

/// Uses the shown level.
class KeepShownLevel final : public KeepLevel {
 public:
  bool start(Document& document) override {
    const ProgressiveView& view = document.progressive;
    return view.is_on() && !view.is_arriving() && prepare(document);
  }

 private:
  bool prepare(Document& document) override {
    take_shown(document);
    level_ = shown_shape(document);
    title_ = "Using the level of " + count_text(level_.mesh.face_count(), "face");
    const ProgressiveView& view = document.progressive;
    edit_.text =
        fmt::format("{} {}={}{}", kKeepLevel, kSplits, view.mesh().level(), view.levels().built_by);
    return true;
  }

  Shape level(Progress*) override { return std::move(level_); }

  Shape level_;
};

/// Uses a level of the progressive mesh that was read from a file.
class KeepFileLevel final : public EditTask {
 public:
  explicit KeepFileLevel(std::uint32_t splits) : splits_(splits) {}

  bool start(Document& document) override {
    ProgressiveView& view = document.progressive;
    if (!view.has_mesh() || view.is_arriving() || splits_ > view.mesh().split_count())
      throw UsageError("keep_level: the progressive mesh does not have this level");
    enter_progressive(document);
    view.move_to_level(splits_);
    const bool is_started = shown_.start(document);
    title_ = shown_.title();
    return is_started;
  }
  bool changes_model() const override { return true; }
  void perform(Progress* progress) override { shown_.perform(progress); }
  void finish(Document& document) override { shown_.finish(document); }

 private:
  std::uint32_t splits_;
  KeepShownLevel shown_;
};

/// Builds the progressive mesh of the model, and uses one of its levels.
class KeepBuiltLevel final : public KeepLevel {
 public:
  KeepBuiltLevel(const ProgressiveRules& rules, std::uint32_t splits, std::string text)
      : rules_(rules), splits_(splits), text_(std::move(text)) {}

 private:
  bool prepare(Document& document) override {
    take_shown(document);
    options_ =
        options_of(rules_, shown_->mesh, shown_->attributes, document.statistics.box.diagonal());
    title_ = "Building the progressive mesh";
    edit_.text = std::move(text_);
    return true;
  }

  Shape level(Progress* progress) override {
    options_.progress = progress;
    progressive::Progressive made =
        progressive::make_progressive(shown_->mesh, shown_->attributes, options_);
    made.mesh.go_to(std::min(splits_, made.mesh.split_count()));
    const Mesh& mesh = made.mesh.mesh();
    if (made.attributes.is_empty()) return {mesh, {}};
    made.attributes.go_to(made.mesh.level());
    return {mesh, made.attributes.at_level(mesh)};
  }

  ProgressiveRules rules_;
  std::uint32_t splits_;
  std::string text_;
  simplify::SimplifyOptions options_;
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

simplify::SimplifyOptions progressive_options(const Document& document) {
  return options_of({document.simplify, document.progressive.settings().base_faces},
                    document.model.mesh, document.model.attributes,
                    document.statistics.box.diagonal());
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
    request(document.edits, std::make_unique<KeepShownLevel>());
  } else {
    document.notice = "press P first: this key works in progressive mode";
  }
}

std::unique_ptr<EditTask> keep_level_edit(EditWords& words, const Document& document) {
  const std::string text = words.text();
  const std::uint32_t splits = words.take_number(kSplits);
  ProgressiveRules rules{document.simplify, 0};
  take_rules(words, rules.simplify);
  const bool is_built = words.has(kBaseFaces);
  rules.base_faces = words.take_number(kBaseFaces, 0);
  if (is_built) return std::make_unique<KeepBuiltLevel>(rules, splits, text);
  return std::make_unique<KeepFileLevel>(splits);
}

}  // namespace mesher::app
