#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mesher::app {

struct Session;
struct Shape;

/// The dialog that saves the shown model, and what has been asked for in it.
struct Saving {
  bool shows_dialog = false;
  std::string typed;            ///< the path in its field
  std::string remark;           ///< why it has not been saved yet
  std::filesystem::path asked;  ///< is there already, as the remark says: once more overwrites it
  /// What the dialog asks of whoever runs the session.
  std::optional<std::filesystem::path> waiting;
};

/// Opens the dialog on a new name beside the opened file: "bunny-edited.obj". In the file's own
/// format, or in OBJ where only that holds the creases.
void open_save_dialog(Session& session);
/// What its button does: asks for the file to be written and closes the dialog; or says in the
/// remark why not. A file that is there is overwritten only where the same path is submitted again.
void submit_save(Session& session);

/// All that writing takes: it may be done on another thread.
struct SaveTask {
  std::filesystem::path file;
  std::shared_ptr<const Shape> shape;
};
struct Saved {
  std::filesystem::path file;
  std::uint32_t faces = 0;
  std::vector<std::string> losses;  ///< what the format cannot hold
};

/// Takes what waits, if anything does. O(V + F): the model is copied.
std::optional<SaveTask> begin_save(Session& session);
/// Writes the file; touches no session. Throws OutputError.
Saved perform(const SaveTask& task);
/// Says in the notice where it went, and what is not in it.
void finish_save(Session& session, const Saved& saved);

/// What waits, here and now. Throws OutputError.
void run_waiting_save(Session& session);

}  // namespace mesher::app
