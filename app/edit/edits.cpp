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
  explicit InstantEdit(std::function<void(Session&)> change) : change_(std::move(change)) {}

 private:
  bool prepare(Session& session) override {
    change_(session);
    return false;
  }
  void perform(Progress*) override {}
  void report(Session&) override {}

  std::function<void(Session&)> change_;
};

}  // namespace

void request(Edits& edits, std::unique_ptr<EditTask> task) {
  edits.waiting.push_back(std::move(task));
}

void request_remove_tenth(Session& session) {
  request(session.edits, remove_tenth_edit(session.simplify));
}

void request_collapse_edge(Session& session) {
  request(session.edits, collapse_edge_edit(session.simplify));
}

void request_simplify_to(Session& session, std::uint32_t faces) {
  request(session.edits, simplify_to_edit(session.simplify, faces));
}

void request_subdivide(Session& session) {
  request(session.edits, subdivide_edit(session.subdivide, LevelStep::finer));
}

void request_previous_level(Session& session) {
  request(session.edits, subdivide_edit(session.subdivide, LevelStep::coarser));
}

void request_same_level(Session& session) {
  request(session.edits, subdivide_edit(session.subdivide, LevelStep::none));
}

void request_crease_edit(Session& session, const CreaseRequest& crease_request) {
  request(session.edits, std::make_unique<InstantEdit>(
                             [crease_request](Session& s) { edit_creases(s, crease_request); }));
}

void request_undo(Session& session) {
  request(session.edits, std::make_unique<InstantEdit>(undo));
}

void request_redo(Session& session) {
  request(session.edits, std::make_unique<InstantEdit>(redo));
}

std::unique_ptr<EditTask> start_next_edit(Session& session) {
  std::unique_ptr<EditTask> task = std::move(session.edits.waiting.front());
  session.edits.waiting.pop_front();
  session.notice.clear();
  if (!task->start(session)) task.reset();
  return task;
}

void run_waiting_edits(Session& session) {
  while (!session.edits.waiting.empty()) {
    const std::unique_ptr<EditTask> task = start_next_edit(session);
    if (!task) continue;
    task->perform(nullptr);
    task->finish(session);
  }
}

}  // namespace mesher::app
