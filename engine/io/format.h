#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

namespace mesher {

/// The kinds of files that hold a mesh.
enum class Format { obj, ply, stl, off, gltf, glb };

/// For messages: "obj, ply, ...".
inline constexpr std::string_view kFormatNames = "obj, ply, stl, off, gltf, glb";

/// Names of objects, groups and materials are cut to so many bytes: what a reader joins and copies
/// for each face or node must not grow with a hostile name.
inline constexpr std::size_t kMostNameBytes = 256;

/// The format that the extension names, in any case; nothing where it names none.
std::optional<Format> format_of(const std::filesystem::path& file);

}  // namespace mesher
