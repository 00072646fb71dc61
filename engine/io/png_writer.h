#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"

struct spng_ctx;

namespace mesher::io {

/// Writes an 8-bit RGBA PNG piece by piece, so that the picture is never whole in memory. Favors
/// speed over size: a cheap filter and light compression.
class PngWriter {
 public:
  /// Writes into `file`, which has to outlive the writer. Pre: width and height are at least 1.
  /// Throws OutputError.
  PngWriter(AtomicFile& file, std::uint32_t width, std::uint32_t height);
  ~PngWriter();
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  /// Appends rows. Pre: `rows` has the width of the picture, and no more rows than are missing.
  /// Throws OutputError; Cancelled between rows.
  void append(const Image& rows, const Progress* progress = nullptr);
  /// Writes the rest of the file, but does not commit it. Pre: no row is missing. Throws
  /// OutputError.
  void finish();

 private:
  struct FreeContext {
    void operator()(spng_ctx* context) const;
  };

  static int take_bytes(spng_ctx* context, void* writer, void* bytes, std::size_t size);
  void check(int error);
  void flush();

  AtomicFile& file_;
  std::unique_ptr<spng_ctx, FreeContext> context_;
  std::uint32_t width_;
  std::uint32_t missing_rows_;
  std::string bytes_;           ///< not written yet, because libspng writes small pieces
  std::exception_ptr failure_;  ///< of a write: an exception must not pass through libspng
};

}  // namespace mesher::io
