#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace mesher {

/// The kinds of files that hold a mesh.
enum class Format { obj, ply, stl, off, gltf, glb };

/// For messages: "obj, ply, ...".
inline constexpr std::string_view kFormatNames = "obj, ply, stl, off, gltf, glb";

/// The format that the extension names, in any case; nothing where it names none.
std::optional<Format> format_of(const std::filesystem::path& file);

}  // namespace mesher
