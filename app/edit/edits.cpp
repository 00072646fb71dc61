#include "app/edit/edits.h"

#include <utility>

#include "app/edit/model_edit.h"
#include "app/edit/simplify_edit.h"
#include "app/edit/subdivide_edit.h"

namespace mesher::app {
namespace {

/// An edit that is fast enough to run on the main thread.
class InstantEdit final : public ModelEdit {
 public:
  explicit InstantEdit(std::function<void(Document&)> change) : change_(std::move(change)) {}

 private:
  bool prepare(Document& document) override {
    change_(document);
    return false;
  }
  void perform(Progress*) override {}
  void report(Document&) override {}

  std::function<void(Document&)> change_;
};

SimplifySettings simplify_settings(const Document& document) {
  SimplifySettings settings = document.simplify;
  settings.mesh = document.chosen_mesh;
  return settings;
}

}  // namespace

void request(Edits& edits, std::unique_ptr<EditTask> task) {
  edits.waiting.push_back(std::move(task));
}

void request_remove_tenth(Document& document) {
  request(document.edits, remove_tenth_edit(simplify_settings(document)));
}

void request_collapse_edge(Document& document) {
  request(document.edits, collapse_edge_edit(simplify_settings(document)));
}

void request_simplify_to(Document& document, std::uint32_t faces) {
  request(document.edits, simplify_to_edit(simplify_settings(document), faces));
}

void request_subdivide(Document& document) {
  request(document.edits,
          subdivide_edit(document.subdivide, LevelStep::finer, document.chosen_mesh));
}

void request_previous_level(Document& document) {
  request(document.edits,
          subdivide_edit(document.subdivide, LevelStep::coarser, document.chosen_mesh));
}

void request_same_level(Document& document) {
  request(document.edits,
          subdivide_edit(document.subdivide, LevelStep::none, document.chosen_mesh));
}

std::unique_ptr<EditTask> crease_edit(const CreaseRequest& crease_request) {
  return std::make_unique<InstantEdit>(
      [crease_request](Document& d) { edit_creases(d, crease_request); });
}

void request_crease_edit(Document& document, const CreaseRequest& crease_request) {
  request(document.edits, crease_edit(crease_request));
}

void request_undo(Document& document) {
  request(document.edits, std::make_unique<InstantEdit>(undo));
}

void request_redo(Document& document) {
  request(document.edits, std::make_unique<InstantEdit>(redo));
}

void request_history_step(Document& document, std::size_t steps) {
  request(document.edits,
          std::make_unique<InstantEdit>([steps](Document& d) { go_to_step(d, steps); }));
}

std::unique_ptr<EditTask> start_next_edit(Document& document) {
  std::unique_ptr<EditTask> task = std::move(document.edits.waiting.front());
  document.edits.waiting.pop_front();
  document.notice.clear();
  if (!task->start(document)) task.reset();
  return task;
}

void run_waiting_edits(Document& document) {
  while (!document.edits.waiting.empty()) {
    const std::unique_ptr<EditTask> task = start_next_edit(document);
    if (!task) continue;
    task->perform(nullptr);
    task->finish(document);
  }
}

}  // namespace mesher::app
