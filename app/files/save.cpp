#include "app/files/save.h"

#include <fmt/format.h>

#include <utility>

#include "app/document/document.h"
#include "app/document/saving.h"
#include "app/document/shown.h"
#include "app/files/paths.h"
#include "engine/core/text.h"
#include "engine/io/format.h"
#include "engine/io/losses.h"
#include "engine/io/write.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

bool is_writable(const fs::path& file) {
  const io::FormatInfo* format = io::format_of(file);
  return format != nullptr && format->write != nullptr;
}

bool has_creases(const Model& model, const Statistics& statistics) {
  return statistics.crease_edges > 0 || !model.mesh.vertex_sharpnesses().empty();
}

/// Returns why the requested file cannot be written; empty if it can.
std::string objection(Saving& saving, const Statistics& statistics, const fs::path& file) {
  if (statistics.faces == 0) return "there is nothing to save";
  if (file.empty()) return "enter a file name";
  if (!is_writable(file)) return "the name must end in " + io::writable_formats();
  if (!is_there(file) || saving.asked == file) return "";
  saving.asked = file;
  return file.filename().string() + " already exists; press Enter again to overwrite it";
}

}  // namespace

fs::path suggested_file(const Document& document) {
  const std::string own = document.file.extension().string();
  const std::string extension =
      has_creases(document.model, document.statistics) || !is_writable(document.file) ? ".obj"
                                                                                      : own;
  return free_name(document.file.parent_path(), document.file.stem().string() + "-edited",
                   extension);
}

void open_save_dialog(Saving& saving, const Document& document) {
  saving = {.shows_dialog = true,
            .typed = suggested_file(document).string(),
            .remark = {},
            .asked = {},
            .then = {},
            .waiting = saving.waiting};
}

void submit_save(Saving& saving, const Document& document) {
  const fs::path file = typed_path(saving.typed);
  saving.remark = objection(saving, document.statistics, file);
  if (!saving.remark.empty()) return;
  saving.waiting = file;
  saving.shows_dialog = false;
  saving.asked.clear();
}

std::optional<SaveTask> begin_save(Saving& saving, const Document& document) {
  if (!saving.waiting) return std::nullopt;
  SaveTask task{.file = *saving.waiting,
                .shape = std::make_shared<const Shape>(shown_shape(document)),
                .opening = document.opening,
                .state = std::nullopt,
                .then = std::exchange(saving.then, std::nullopt)};
  if (!document.progressive.is_on()) task.state = document.edits.history.state();
  saving.waiting.reset();
  return task;
}

Saved perform(const SaveTask& task) {
  const auto& [mesh, attributes] = *task.shape;
  io::write_model(task.file, mesh, attributes);
  return {.file = task.file,
          .faces = mesh.face_count(),
          .losses = io::losses_in_format(task.file, mesh, attributes),
          .opening = task.opening,
          .state = task.state,
          .then = task.then};
}

std::string notice_of(const Saved& saved) {
  std::string notice =
      fmt::format("saved {}: {}", saved.file.string(), count_text(saved.faces, "face"));
  for (std::size_t i = 0; i < saved.losses.size(); ++i)
    notice += (i == 0 ? "; the format cannot hold " : ", ") + saved.losses[i];
  return notice;
}

}  // namespace mesher::app
