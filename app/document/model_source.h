#pragma once

#include <cstdint>
#include <optional>

namespace mesher::app {

/// How the model was read from its file, so that the same model can be read once more.
struct ModelSource {
  /// Size and CRC-32 of the file.
  struct Stamp {
    std::uint64_t bytes = 0;
    std::uint32_t crc = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  std::optional<Stamp> stamp;  ///< none: the model cannot be read again, such as from a pipe
  std::optional<int> crease_index_base;  ///< as io::ReadOptions
  bool keep_isolated_vertices = false;
  std::optional<double> weld = 0.0;
  std::optional<float> tag_creases_deg;  ///< edges were marked as creases by this angle
};

}  // namespace mesher::app
