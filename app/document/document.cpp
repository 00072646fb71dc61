#include "app/document/document.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace mesher::app {
namespace {

std::atomic<std::uint64_t> files_opened{0};

}  // namespace

void replace_model(Document& document, Model&& model, const Statistics& stats,
                   const std::filesystem::path& file) {
  document.model = std::move(model);
  document.statistics = stats;
  document.file = file;
  document.source = {};
  document.stand_in.reset();
  document.opening = ++files_opened;
  document.playback = {};
  document.hidden.clear();
  document.chosen_mesh = kNone;
  document.edits = {};
  document.edits.opened_faces = stats.faces;
  document.edits.opened_diagonal = stats.box.diagonal();
  document.progressive.forget();
  document.creases.forget_edges();
  document.error.clear();
  document.notice.clear();
  ++document.model_generation;
}

bool has_unsaved_edits(const Document& document) {
  const Edits& edits = document.edits;
  const auto changes_model = [](const auto& task) { return task->changes_model(); };
  return edits.history.state() != edits.saved_state || edits.is_changing ||
         std::ranges::any_of(edits.waiting, changes_model);
}

}  // namespace mesher::app
