#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/leaving.h"
#include "app/files/folder.h"
#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"
#include "engine/mesh/shape.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"
#include "engine/scene/scene.h"
#include "engine/simplify/options.h"

namespace mesher::app {

struct Document;
struct Preferences;
struct Saving;

/// Returns a new name in the folder of the opened file, such as "bunny-edited.obj". The format is
/// that of the file, or OBJ if only that can hold the creases.
std::filesystem::path suggested_file(const Document& document);
/// Opens the save dialog with a new name, in the folder and the format of the last saved file if
/// there are.
void open_save_dialog(Saving& saving, const Document& document, const Preferences& preferences);
/// Returns the extensions of the formats that can be saved: ".obj", ".ply", ..., ".pm".
std::vector<std::string> saved_extensions();
/// Returns a file with the extension of `suggested`, if its own is none of a format.
std::filesystem::path with_format(std::filesystem::path file,
                                  const std::filesystem::path& suggested);
/// Gives the typed name another extension.
void choose_format(Saving& saving, const std::string& extension);
/// Returns what no file of a format can hold of the shown model: "creases", "colors". O(1).
std::vector<std::string> always_lost(const Document& document, const std::string& extension);
/// Returns what a file of this name would lose of the shown model. O(F).
std::vector<std::string> losses_of(const Document& document, const std::filesystem::path& file);
/// Handles the dialog's button: requests the file and closes the dialog, or goes to a folder, or
/// sets the problem to the reason why it cannot. An existing file is overwritten only if its path
/// is submitted twice. `shown`: the list of the dialog.
void submit_save(Saving& saving, const Document& document,
                 const std::vector<const FolderEntry*>& shown = {});

/// A copy of everything that is written, so that another thread can write it.
struct SaveTask {
  std::filesystem::path file;
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Materials> materials;  ///< this and the next three as in Model
  std::shared_ptr<const scene::Scene> scene;
  FileContents contents;
  glm::dvec3 origin{0.0};
  /// The progressive mesh to write into a .pm file; null: it is built by `rules` first.
  std::shared_ptr<progressive::ProgressiveMesh> levels;
  std::shared_ptr<progressive::ProgressiveAttributes> attributes;  ///< of the levels
  simplify::SimplifyOptions rules;
  std::uint64_t opening = 0;  ///< Document::opening
  /// Once the file is saved, the journal of its edits is removed.
  io::Flush flush = io::Flush::now;
  /// History::state of the model; none: a level of a progressive mesh is written instead.
  std::optional<std::uint64_t> state;
  std::optional<Leaving> then;  ///< as Saving::then
};
struct Saved {
  std::filesystem::path file;
  std::uint32_t vertices = 0;
  std::uint32_t faces = 0;
  std::vector<std::string> losses;  ///< what the format cannot hold
  std::uint64_t opening = 0;        ///< this and the next two as in the task
  std::optional<std::uint64_t> state;
  std::optional<Leaving> then;
};

/// Takes the requested file, if there is one. O(V + F), because the model is copied.
std::optional<SaveTask> begin_save(Saving& saving, const Document& document);
/// Writes the file; touches no document. Throws OutputError; Cancelled while a progressive mesh is
/// built.
Saved perform(const SaveTask& task, Progress* progress = nullptr);
/// Returns the file's name and what the file could not hold.
std::string notice_of(const Saved& saved);

}  // namespace mesher::app
