#include "app/edit/simplify_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "app/document/meshes.h"
#include "app/document/words.h"
#include "app/edit/distance_from_input.h"
#include "app/edit/model_edit.h"
#include "engine/core/text.h"
#include "engine/scene/placed.h"
#include "engine/simplify/simplify.h"
#include "engine/simplify/simplify_model.h"

namespace mesher::app {
namespace {

/// Returns a notice of facts that the picture does not show.
std::string notice_for(const SimplifyOutcome& outcome) {
  std::string notice;
  const simplify::SimplifyReport& report = outcome.report;
  if (report.reason == simplify::StopReason::no_legal_collapse ||
      report.reason == simplify::StopReason::error_bound) {
    notice =
        fmt::format("{}: {}", describe(report.reason), count_text(report.faces_reached, "face"));
  }
  if (outcome.crosses_seams) notice += (notice.empty() ? "" : "; ") + std::string(kCrossesSeams);
  if (outcome.is_far()) {
    notice += (notice.empty() ? "" : "; ") + far_from("the opened model", outcome.error_percent());
  }
  return notice;
}

/// Times of simplifying, of carrying attributes over, and of recording the edit.
constexpr double kSimplifyWeights[] = {0.96, 0.0, 0.04};

constexpr const char* kTenthLess = "simplify";
constexpr const char* kOneEdge = "simplify_edge";
constexpr const char* kToFaces = "simplify_to";

class SimplifyEdit final : public ModelEdit {
 public:
  enum class Target { tenth_less, one_edge, faces };

  SimplifyEdit(const SimplifySettings& settings, Target target, std::uint32_t faces)
      : settings_(settings), target_(target), faces_(faces) {}

  void perform(Progress* progress) override {
    Stages stages(progress, kSimplifyWeights);
    stages.next("simplifying");
    options_.progress = progress;
    const Shape result = simplified();
    stages.next("finishing");
    edit_.name = name(result.mesh.face_count());
    if (opened_ != start_ && result.mesh.face_count() <= kManyFaces) {
      outcome_.error_from_opened = distance_from_input(opened_->mesh, result.mesh);
    }
    stages.next();
    record(result, progress);
  }

 private:
  /// Simplifies all meshes, or the chosen one, and notes the outcome.
  Shape simplified() {
    std::optional<Shape> chosen;
    if (settings_.mesh != kNone)
      chosen = scene::mesh_of(*start_, scene_->meshes.size(), settings_.mesh);
    const Shape& from = chosen ? *chosen : *start_;
    auto [result, carried, crosses_seams] =
        simplify::simplify_model(Mesh(from.mesh), from.attributes, options_);
    outcome_ = {result.report, diagonal_, crosses_seams};
    Shape shape{std::move(result.mesh), std::move(carried)};
    if (!chosen) return shape;
    // The other meshes stay as they are shown.
    return scene::with_mesh(*shown_, scene_->meshes.size(), settings_.mesh, std::move(shape));
  }

  bool prepare(Document& document) override {
    if (document.model.mesh.face_count() == 0) {
      document.notice = "there is nothing to simplify";
      return false;
    }
    if (!has_mesh(document, settings_.mesh)) {
      document.notice = "there is no such mesh";
      return false;
    }
    take_shown(document);
    edit_.text = text();
    opened_ = document.edits.opened;
    start_ = target_ == Target::faces ? opened_ : shown_;
    diagonal_ = document.edits.opened_diagonal;
    options_ = options_of(settings_, diagonal_);
    options_.target_faces = target_faces(start_->mesh.face_count());
    const std::string to = options_.target_faces > 0 ? count_text(options_.target_faces, "face")
                                                     : bound_text(settings_);
    if (settings_.mesh != kNone) set_target_of_mesh();
    title_ = target_ == Target::one_edge ? "Collapsing an edge" : "Simplifying to " + to;
    return true;
  }

  void report(Document& document) override {
    document.notice = notice_for(outcome_);
    document.edits.last = outcome_;
  }

  EditOutcome outcome() const override { return {.simplification = outcome_, .subdivision = {}}; }

  /// Name of the edit in the history: "remove 10 % of faces -> 3,000".
  std::string name(std::uint32_t faces_reached) const {
    const std::string reached = count_text(faces_reached);
    if (target_ == Target::tenth_less) return "remove 10 % of faces -> " + reached;
    if (target_ == Target::one_edge) return "collapse an edge -> " + reached;
    if (faces_ == 0)
      return fmt::format("simplify to error {:.6g} % -> {}", settings_.max_error_percent, reached);
    return "simplify to " + count_text(faces_reached, "face");
  }

  std::string text() const {
    std::string words = kToFaces + (faces_ > 0 ? fmt::format(" faces={}", faces_) : "");
    if (target_ == Target::tenth_less) words = kTenthLess;
    if (target_ == Target::one_edge) words = kOneEdge;
    append_rules(words, settings_);
    if (settings_.mesh != kNone) words += fmt::format(" mesh={}", settings_.mesh);
    return words;
  }

  std::uint32_t target_faces(std::uint32_t faces) const {
    switch (target_) {
      case Target::tenth_less:
        return faces - (faces / 10 + (faces % 10 == 0 ? 0 : 1));  // at least one face is removed
      case Target::one_edge:
        return faces - 1;
      case Target::faces:
        break;
    }
    return faces_;
  }

  /// The target counts the faces of all meshes; the others keep theirs.
  void set_target_of_mesh() {
    const std::uint32_t own = face_count_of(shown_->attributes, settings_.mesh);
    if (target_ != Target::faces) {
      options_.target_faces = target_faces(own);
    } else if (options_.target_faces > 0) {
      const std::uint32_t others = shown_->mesh.face_count() - own;
      options_.target_faces = options_.target_faces > others ? options_.target_faces - others : 1;
    }
  }

  SimplifySettings settings_;
  Target target_;
  std::uint32_t faces_;
  std::shared_ptr<const Shape> start_;   ///< the shown model, or `opened_`
  std::shared_ptr<const Shape> opened_;  ///< the model as it was opened
  simplify::SimplifyOptions options_;
  double diagonal_ = 0.0;  ///< of the opened model
  SimplifyOutcome outcome_;
};

}  // namespace

std::unique_ptr<EditTask> remove_tenth_edit(const SimplifySettings& settings) {
  return std::make_unique<SimplifyEdit>(settings, SimplifyEdit::Target::tenth_less, 0);
}

std::unique_ptr<EditTask> collapse_edge_edit(const SimplifySettings& settings) {
  return std::make_unique<SimplifyEdit>(settings, SimplifyEdit::Target::one_edge, 0);
}

std::unique_ptr<EditTask> simplify_to_edit(const SimplifySettings& settings, std::uint32_t faces) {
  return std::make_unique<SimplifyEdit>(settings, SimplifyEdit::Target::faces, faces);
}

std::unique_ptr<EditTask> simplify_edit(EditWords& words, SimplifySettings settings) {
  take_rules(words, settings);
  settings.mesh = words.take_number("mesh", kNone);
  if (words.name() == kTenthLess) return remove_tenth_edit(settings);
  if (words.name() == kOneEdge) return collapse_edge_edit(settings);
  if (settings.max_error_percent > 0.0F)
    return simplify_to_edit(settings, words.take_number("faces", 0));
  return simplify_to_edit(settings, words.take_number("faces"));
}

std::string bound_text(const SimplifySettings& settings) {
  return fmt::format("max error {:.6g} %", settings.max_error_percent);
}

void append_rules(std::string& words, const SimplifySettings& settings) {
  append_options(words, simplify::kSimplifyRules, settings.rules);
  append_options(words, kSimplifyLimits, settings);
}

void take_rules(EditWords& words, SimplifySettings& settings) {
  words.take_options(simplify::kSimplifyRules, settings.rules);
  words.take_options(kSimplifyLimits, settings);
}

simplify::SimplifyOptions options_of(const SimplifySettings& settings, double diagonal) {
  simplify::SimplifyOptions options = settings.rules;
  options.order = simplify::ResultOrder::fill_holes;
  if (settings.max_error_percent > 0.0F) {
    options.max_error = 0.01 * settings.max_error_percent * diagonal;
  }
  return options;
}

}  // namespace mesher::app
