#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/document.h"
#include "app/document/lost_edits.h"
#include "engine/core/progress.h"

namespace mesher::app {

/// A lock on a file, which the system releases when the process ends, however it ends.
class FileLock {
 public:
  /// Creates the file and locks it. None if another process holds the lock or the file cannot be
  /// created; errno says why.
  static std::unique_ptr<FileLock> try_lock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Returns the journals in `folder` whose processes have ended. Reads the files that the models
/// came from, to compare their stamps: O(bytes of those files). A journal that cannot be read has a
/// `problem`. Throws Cancelled.
std::vector<LostEdits> lost_edits(const std::filesystem::path& folder,
                                  Progress* progress = nullptr);

/// Keeps the edits of the document on disk, so that a crash or a kill loses none: the stamp of the
/// file that was opened, and the text of every edit. There is one journal per document, and only
/// while there are unsaved edits. It is on the disk, and not only in the memory of the system, so
/// that a power failure loses none either.
class Journal {
 public:
  /// Journals beyond this size are not written.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 26;
  /// Time until a write that failed is tried again, if there is no new edit before.
  static constexpr double kRetrySeconds = 2.0;

  /// `folder`: created when the first edit is noted; empty: there is none, and
  /// nothing is kept.
  explicit Journal(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Call after each change of the document. Writes the journal if it is outdated, or removes it if
  /// there is nothing unsaved. When all lost edits were repeated (Edits::restored), removes their
  /// journal. O(1) if nothing has changed, else O(text of all edits). Never throws.
  /// Returns what a person has to know, once: why the edits cannot be kept, or that they are kept
  /// again. Otherwise returns an empty string.
  std::string note(Document& document);
  /// Whether the last write failed: then call `note` again, after kRetrySeconds at the latest.
  bool is_failing() const { return failure_.has_value(); }
  /// Whether there is a journal on disk.
  bool has_edits() const { return noted_.has_value(); }
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

  /// A write that failed.
  struct Failure {
    Noted tried;
    std::chrono::steady_clock::time_point when;
  };

  bool is_up_to_date(const Document& document, const Noted& now) const;
  std::string write_noted(const Document& document, const Noted& now);
  void write(const Document& document);
  void open();

  std::filesystem::path folder_;
  std::filesystem::path file_;  ///< empty: not created yet
  std::shared_ptr<void> lock_;
  std::optional<Noted> noted_;
  std::optional<Failure> failure_;
  std::optional<std::uint64_t> refused_opening_;  ///< whose edits cannot be kept
};

/// Removes the journal of lost edits.
void discard(LostEdits&& lost);

/// Returns the stamp of a file; none if it is not a regular file or cannot be read. O(bytes).
/// Throws Cancelled.
std::optional<ModelSource::Stamp> stamp_of(const std::filesystem::path& file,
                                           Progress* progress = nullptr);

}  // namespace mesher::app
