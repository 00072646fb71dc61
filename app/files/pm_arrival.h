#pragma once

#include <filesystem>
#include <memory>

#include "engine/io/byte_stream.h"
#include "engine/progressive/pm_read.h"

namespace mesher::app {

struct Session;

/// A progressive mesh on its way from a file or a pipe into a session, which shows what is there.
/// The bytes are read on another thread; the mesh is the session's alone.
class PmArrival {
 public:
  /// Throws InputError where the file cannot be opened.
  explicit PmArrival(const std::filesystem::path& file);
  /// See ByteStream.
  void set_wake(void (*wake)()) { stream_.set_wake(wake); }

  const std::filesystem::path& file() const { return file_; }
  /// There is something for `advance` to do. (Where a person looks at less than all the detail, not
  /// in every frame: reading on takes the way up and back.)
  bool has_news(const Session& session) const;
  /// Reads on for about so many seconds. When the base is there it becomes the session's model, in
  /// progressive mode; at the end all of it does, and geomorphs are asked for. Where splits are
  /// missing or wrong, or bytes follow after the last, the session's error says so; nothing more is
  /// read. Below full detail it takes longer, at least as long as the way up and back. Returns
  /// whether there is anything new to see.
  /// Throws InputError where there is no base: the session is as it was.
  bool advance(Session& session, double seconds);
  /// Returns when the base is shown. Throws as `advance`.
  void wait_for_base(Session& session);
  /// Returns when all has arrived. Throws as `advance`.
  void finish(Session& session);
  /// What has arrived is all that comes. Pre: the base is shown.
  void stop(Session& session);
  bool is_done() const { return is_done_; }
  bool has_base() const { return has_base_; }

 private:
  bool is_over(Session& session) const;
  double climb(Session& session) const;
  bool feed(Session& session, double seconds);
  void show_base(Session& session);
  void end(Session& session);

  std::filesystem::path file_;
  std::unique_ptr<PmReader> reader_;  ///< until the base is there: then it is the session's
  bool has_base_ = false;
  bool is_done_ = false;
  double last_fed_s_ = 0.0;  ///< when that ended
  ByteStream stream_;
};

}  // namespace mesher::app
