#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "engine/io/byte_stream.h"
#include "engine/mesh/model.h"
#include "engine/progressive/codec/pm_read.h"

namespace mesher::app {

class ProgressiveView;
struct Document;
struct Session;

/// Loads a progressive mesh from a file or a pipe into a session, which shows the part that is
/// loaded. Another thread reads the bytes; only the main thread uses the mesh.
class PmArrival {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit PmArrival(const std::filesystem::path& file);
  /// See ByteStream.
  void set_wake(void (*wake)()) { stream_.set_wake(wake); }

  const std::filesystem::path& file() const { return file_; }
  /// Returns whether `advance` has something to do. Below full detail it does not read in every
  /// frame, because each reading goes to full detail and back.
  bool has_news(const ProgressiveView& progressive) const;
  /// Reads for about `seconds`; below full detail for longer, at least as long as going to full
  /// detail and back takes. Returns whether the picture changes. When the base is loaded, it
  /// becomes the model of a new tab, in progressive mode. At the end the full mesh becomes the
  /// model, and geomorphs are requested. If splits are missing or wrong, or bytes follow the last
  /// one, the document's error says so, and reading ends. Throws InputError if there is no base;
  /// the session is unchanged then.
  bool advance(Session& session, double seconds);
  /// Returns when the base is shown, or after some seconds. Throws as `advance`.
  void wait_for_base(Session& session, double seconds);
  /// Returns when everything is loaded. Throws as `advance`.
  void finish(Session& session);
  /// Stops loading; the part that was loaded becomes the whole mesh. Pre: the base is shown.
  void stop(Document& document);
  bool is_done() const { return is_done_; }
  bool has_base() const { return has_base_; }

 private:
  bool is_over(ProgressiveView& progressive) const;
  double climb(ProgressiveView& progressive) const;
  bool feed(Session& session, double seconds);
  void show_base(Session& session);
  void end(Session& session);
  Model model_at_full_detail(ProgressiveView& view, std::span<const std::byte> materials) const;

  std::filesystem::path file_;
  bool is_pipe_;
  std::unique_ptr<progressive::PmReader>
      reader_;  ///< until the base is loaded; then the document owns it
  bool has_base_ = false;
  bool is_done_ = false;
  double last_fed_s_ = 0.0;  ///< when the last reading ended
  io::ByteStream stream_;
};

}  // namespace mesher::app
