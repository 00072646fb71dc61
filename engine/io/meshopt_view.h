#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mesher::io {

/// A buffer view of a glTF file with the extension EXT_meshopt_compression.
struct MeshoptView {
  std::string_view bytes;
  std::uint64_t count = 0;   ///< of decoded elements
  std::uint64_t stride = 0;  ///< bytes per decoded element
  std::string_view mode;
  std::string_view filter;  ///< empty: none
};

/// Returns why a view cannot be decoded, or "". `decoded_bytes` is the length of the view. Refuses
/// lengths that so few bytes cannot decode to.
std::string objection(const MeshoptView& view, std::uint64_t decoded_bytes);

/// Decodes a view into `decoded`. Returns whether its bytes are valid. The decoders of
/// meshoptimizer check all bytes. Pre: there is no objection.
bool decode_meshopt(const MeshoptView& view, std::string& decoded);

}  // namespace mesher::io
