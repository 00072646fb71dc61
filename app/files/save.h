#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/leaving.h"

namespace mesher::app {

struct Document;
struct Saving;
struct Shape;

/// Returns a new name in the folder of the opened file, such as "bunny-edited.obj". The format is
/// that of the file, or OBJ if only that can hold the creases.
std::filesystem::path suggested_file(const Document& document);
/// Opens the save dialog with the suggested file.
void open_save_dialog(Saving& saving, const Document& document);
/// Handles the dialog's button: requests the file and closes the dialog, or sets the remark to the
/// reason why it cannot. An existing file is overwritten only if its path is submitted twice.
void submit_save(Saving& saving, const Document& document);

/// A copy of everything that is written, so that another thread can write it.
struct SaveTask {
  std::filesystem::path file;
  std::shared_ptr<const Shape> shape;
  std::uint64_t opening = 0;  ///< Document::opening
  /// History::state of the model; none: a level of a progressive mesh is written instead.
  std::optional<std::uint64_t> state;
  std::optional<Leaving> then;  ///< as Saving::then
};
struct Saved {
  std::filesystem::path file;
  std::uint32_t faces = 0;
  std::vector<std::string> losses;  ///< what the format cannot hold
  std::uint64_t opening = 0;        ///< this and the next two as in the task
  std::optional<std::uint64_t> state;
  std::optional<Leaving> then;
};

/// Takes the requested file, if there is one. O(V + F), because the model is copied.
std::optional<SaveTask> begin_save(Saving& saving, const Document& document);
/// Writes the file; touches no document. Throws OutputError.
Saved perform(const SaveTask& task);
/// Returns the file's name and what the file could not hold.
std::string notice_of(const Saved& saved);

}  // namespace mesher::app
