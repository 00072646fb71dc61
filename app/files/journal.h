#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/document.h"
#include "app/document/lost_edits.h"

namespace mesher::app {

/// A lock on a file, which the system releases when the process ends, however it ends.
class FileLock {
 public:
  /// Creates the file and locks it. None if another process holds the lock or the file cannot be
  /// created.
  static std::unique_ptr<FileLock> try_lock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Returns the journals in `folder` whose processes have ended. Reads the files that the models
/// came from, to compare their stamps. A journal that cannot be read has a `problem`.
std::vector<LostEdits> lost_edits(const std::filesystem::path& folder);

/// Keeps the edits of the document on disk, so that a crash or a kill loses none: the stamp of the
/// file that was opened, and the text of every edit. There is one journal per process, and only
/// while there are unsaved edits.
class Journal {
 public:
  /// Journals beyond this size are not written.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 26;

  /// `folder`: created when the first edit is noted; empty: nothing is kept.
  explicit Journal(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Call after each change of the document. Writes the journal if it is outdated, or removes it if
  /// there is nothing unsaved. When all lost edits were repeated (Edits::restored), removes their
  /// journal. O(1) if nothing has changed, else O(text of all edits). Never throws.
  /// Returns why the edits cannot be kept, once per opened file, or an empty string.
  std::string note(Document& document);
  /// Removes the journal. Call when the edits are saved or discarded.
  void remove();

 private:
  /// What the journal on disk holds.
  struct Noted {
    std::uint64_t opening = 0;
    std::uint64_t state = 0;
    std::size_t steps = 0;
    friend bool operator==(const Noted&, const Noted&) = default;
  };

  void write(const Document& document);

  std::filesystem::path folder_;
  std::filesystem::path file_;  ///< empty: not created yet
  std::shared_ptr<void> lock_;
  std::optional<Noted> noted_;
  std::optional<std::uint64_t> failed_opening_;  ///< whose edits cannot be kept
};

/// Removes the journal of lost edits.
void discard(LostEdits&& lost);

/// Returns the stamp of a file; none if it is not a regular file or cannot be read. O(bytes).
std::optional<ModelSource::Stamp> stamp_of(const std::filesystem::path& file);

}  // namespace mesher::app
