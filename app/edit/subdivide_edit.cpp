#include "app/edit/subdivide_edit.h"

#include <fmt/format.h>

#include <chrono>
#include <span>
#include <string>
#include <utility>

#include "app/document/meshes.h"
#include "app/edit/edits.h"
#include "app/edit/memory_budget.h"
#include "app/edit/model_edit.h"
#include "engine/core/memory.h"
#include "engine/mesh/wedges.h"
#include "engine/scene/placed.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::app {
namespace {

// Copies of the result: the shown model, the result of the task, the arrays in the history, and the
// GPU's mirror.
constexpr unsigned kCopies = 4;
// Copies of the shown model: the task's copy, and the arrays in the history.
constexpr unsigned kCopiesBefore = 2;

/// Returns the shown model as a level of a mesh, or of all. It has no base if that is not
/// subdivided.
SubdivisionLevel shown_as_level(const Edits& edits, std::uint32_t mesh) {
  const bool is_level = edits.subdivision && edits.subdivision->mesh == mesh;
  return is_level ? *edits.subdivision : SubdivisionLevel{.mesh = mesh};
}

subdivide::SubdivideOptions at_level(subdivide::SubdivideOptions rules, std::uint32_t level) {
  rules.levels = level;
  return rules;
}

std::uint64_t shown_bytes(const Model& model) {
  return model.mesh.memory_bytes() + model.attributes.memory_bytes();
}

std::string rules_text(const subdivide::SubdivideOptions& rules) {
  return fmt::format("subdivision: {}, {}{}", key(rules.scheme), key(rules.creases),
                     rules.limit ? ", limit surface" : "");
}

/// Name of the edit in the history: "subdivide to level 2 -> 48,000".
std::string name_of(std::uint32_t level_before, std::uint32_t level, const std::string& rules,
                    std::uint32_t faces) {
  if (level == level_before) return fmt::format("change the rules at level {}: {}", level, rules);
  return fmt::format("{} to level {} -> {}", level < level_before ? "back" : "subdivide", level,
                     count_text(faces));
}

/// Times of subdividing the mesh and its attributes.
constexpr double kAttributeWeights[] = {0.75, 0.25};
constexpr double kBareWeights[] = {1.0, 0.0};
/// Times of subdividing, and of recording the edit, mostly its statistics.
constexpr double kEditWeights[] = {0.7, 0.3};

/// Returns the level, and sets its limit normals.
Shape subdivided(const Shape& base, SubdivisionLevel& wanted, Progress* progress) {
  subdivide::SubdivideOptions options = at_level(wanted.rules, wanted.level);
  options.progress = progress;
  Stages stages(progress, base.attributes.is_empty() ? kBareWeights : kAttributeWeights);
  stages.next();
  subdivide::Subdivided result = subdivide::subdivide(base.mesh, options);
  stages.next();
  Shape shape{std::move(result.mesh), {}};
  shape.attributes =
      subdivide::subdivide_attributes(base.mesh, base.attributes, shape.mesh, options);
  if (!result.limit_normal.empty()) {
    set_normals(shape.mesh, shape.attributes, result.limit_normal);
    wanted.limit_normals = std::make_shared<const Array<glm::vec3>>(std::move(result.limit_normal));
  }
  return shape;
}

/// Returns the level of all meshes, or the model with that of one of them.
Shape subdivided(SubdivisionLevel& wanted, std::size_t meshes, Progress* progress) {
  if (wanted.level == 0) return *wanted.base;
  if (wanted.mesh == kNone) return subdivided(*wanted.base, wanted, progress);
  Shape finer = subdivided(scene::mesh_of(*wanted.base, meshes, wanted.mesh), wanted, progress);
  wanted.limit_normals.reset();  // the other meshes have none
  return scene::with_mesh(*wanted.base, meshes, wanted.mesh, std::move(finer));
}

const char* word_of(LevelStep step) {
  switch (step) {
    case LevelStep::finer:
      return "subdivide";
    case LevelStep::coarser:
      return "coarsen";
    case LevelStep::none:
      break;
  }
  return "change_rules";
}

class SubdivideEdit final : public ModelEdit {
 public:
  SubdivideEdit(const subdivide::SubdivideOptions& rules, LevelStep step, std::uint32_t mesh)
      : rules_(rules), step_(step), mesh_(mesh) {}

  void perform(Progress* progress) override {
    const auto start = std::chrono::steady_clock::now();
    Stages stages(progress, kEditWeights);
    stages.next();
    const Shape shape = subdivided(wanted_, scene_ ? scene_->meshes.size() : 0, progress);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    stages.next();
    record(shape, progress);
    edit_.subdivision_after = wanted_;
    outcome_ = {wanted_.level, shape.mesh.face_count(), elapsed.count()};
    edit_.name = name_of(level_before_, wanted_.level, rules_text(rules_), outcome_.faces);
  }

 private:
  bool prepare(Document& document) override {
    if (step_ == LevelStep::none) document.notice = rules_text(rules_);
    if (!has_mesh(document, mesh_)) {
      document.notice = "there is no such mesh";
      return false;
    }
    const SubdivisionLevel before = shown_as_level(document.edits, mesh_);
    if (step_ == LevelStep::coarser && before.level == 0) {
      document.notice = "already at the coarsest level";
      return false;
    }
    const std::uint32_t level = step_ == LevelStep::finer     ? before.level + 1
                                : step_ == LevelStep::coarser ? before.level - 1
                                                              : before.level;
    if (level == before.level && (level == 0 || before.rules == rules_)) return false;
    if (std::string reason = level_refusal(document, level, rules_, mesh_); !reason.empty()) {
      document.notice = std::move(reason);
      follow_shown_level(document.edits, document.subdivide);
      return false;
    }
    take_shown(document);
    wanted_ = {before.base ? before.base : shown_, level, rules_, mesh_, nullptr};
    title_ = fmt::format("Subdividing to level {}", level);
    level_before_ = before.level;
    edit_.text = word_of(step_);
    append_options(edit_.text, subdivide::kSubdivideRules, rules_);
    if (mesh_ != kNone) edit_.text += fmt::format(" mesh={}", mesh_);
    return true;
  }

  void report(Document& document) override {
    document.edits.last_subdivision = outcome_;
    // Other rules may give the same surface: that is not an edit.
    if (!edit_.changes_anything()) document.edits.subdivision = std::move(edit_.subdivision_after);
  }

  EditOutcome outcome() const override { return {.simplification = {}, .subdivision = outcome_}; }

  subdivide::SubdivideOptions rules_;
  std::uint32_t level_before_ = 0;
  LevelStep step_;
  std::uint32_t mesh_;  ///< of the scene; none: all
  SubdivisionLevel wanted_;
  SubdivideOutcome outcome_;
};

}  // namespace

std::unique_ptr<EditTask> subdivide_edit(const subdivide::SubdivideOptions& rules, LevelStep step,
                                         std::uint32_t mesh) {
  return std::make_unique<SubdivideEdit>(rules, step, mesh);
}

std::unique_ptr<EditTask> subdivide_edit(EditWords& words, subdivide::SubdivideOptions rules) {
  words.take_options(subdivide::kSubdivideRules, rules);
  const std::uint32_t mesh = words.take_number("mesh", kNone);
  for (const LevelStep step : {LevelStep::finer, LevelStep::coarser}) {
    if (words.name() == word_of(step)) return subdivide_edit(rules, step, mesh);
  }
  return subdivide_edit(rules, LevelStep::none, mesh);
}

std::string level_refusal(const Document& document, std::uint32_t level,
                          const subdivide::SubdivideOptions& rules, std::uint32_t mesh) {
  if (level == 0) return "";  // needs no memory, so it stays possible when memory runs out
  const SubdivisionLevel shown = shown_as_level(document.edits, mesh);
  const Mesh& whole = shown.base ? shown.base->mesh : document.model.mesh;
  const Attributes& all = shown.base ? shown.base->attributes : document.model.attributes;
  std::optional<Shape> part;
  if (mesh != kNone) part = scene::mesh_of({whole, all}, document.model.scene->meshes.size(), mesh);
  const Mesh& base = part ? part->mesh : whole;
  const Attributes& attributes = part ? part->attributes : all;
  if (base.face_count() == 0) return "there is nothing to subdivide";
  if (level > kMaxLevel) return "already at the finest level";
  const subdivide::SubdivideOptions options = at_level(rules, level);
  return subdivision_refusal(
      subdivide::subdivision_size(base, options), level,
      {.available = available_memory_bytes(),
       .copies = kCopies,
       .beside = subdivide::subdivided_attribute_bytes(base, attributes, options),
       .held = kCopiesBefore * shown_bytes(document.model)});
}

void follow_shown_level(Edits& edits, subdivide::SubdivideOptions& subdivide) {
  const auto& level = edits.subdivision;
  if (level && level->level > 0 && edits.waiting.empty()) {
    subdivide = level->rules;
  }
}

void apply_subdivide_settings(Document& document) {
  document.notice = rules_text(document.subdivide);
  request_same_level(document);
}

}  // namespace mesher::app
