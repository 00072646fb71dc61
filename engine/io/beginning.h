#pragma once

#include <string_view>

namespace mesher::io {

/// Number of bytes that `format_of_beginning` looks at.
inline constexpr std::size_t kFormatBytes = 4096;

/// Returns the extension of the format that a file begins like: ".pm", ".glb", ".gltf", ".ply",
/// ".off", ".stl" or ".obj"; empty if it begins like none. `bytes`: the first kFormatBytes, or all
/// if there are fewer. Binary STL has no mark: it is what is not text, has a number of facets
/// above 0, and has a facet of finite numbers.
std::string_view format_of_beginning(std::string_view bytes);

}  // namespace mesher::io
