#pragma once

#include <csignal>
#include <filesystem>
#include <string>

namespace mesher::io {

/// A time in which the signals that end a program (INT, TERM, HUP) wait, on every thread.
///
/// The list of temporary files changes only within one, as does what it lists: a signal therefore
/// finds each file either listed or not there. May be nested. Keep it short: a signal waits no
/// longer than two seconds.
class NoSignals {
 public:
  NoSignals();
  ~NoSignals();
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_;  ///< signals that the thread blocked before
};

/// Has INT, TERM and HUP remove the listed files and folders before they end the process as usual.
/// A signal that the process ignores (nohup) stays ignored. Call once, in `main`.
void remove_temporaries_on_signals();

/// Removes the listed files and folders. Call it just before the process ends without its
/// destructors: a thread that names files afterwards waits for that end.
void remove_temporaries();

/// Lists a file or an empty folder that has to go if a signal ends the process. Pre: the thread is
/// within NoSignals.
void list_temporary(const std::filesystem::path& path);

/// Takes one off the list. Pre: as above.
void unlist_temporary(const std::filesystem::path& path) noexcept;

/// Removes the temporary files in `folder` whose writer is dead: those of temporary_name that
/// nobody has locked. Files of other users stay. Looks into a folder once per process. O(entries).
void sweep_temporaries(const std::filesystem::path& folder) noexcept;

/// Returns a new name for a temporary file: random, so that no other process has it.
std::string temporary_name();

/// Locks an open temporary file, so that no other process removes it while it is open. Returns
/// false if another process removes it just now; true also where the file system has no locks.
bool lock_temporary(int descriptor) noexcept;

}  // namespace mesher::io
