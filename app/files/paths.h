#pragma once

#include <filesystem>
#include <string>

namespace mesher::app {

/// The file that a person means: the path as given; else the name in the assets folder, also
/// without its ".obj". Returns the path as given where neither is there, so that the reader says
/// what is wrong with it.
std::filesystem::path find_model(const std::string& name);

/// `folder`/`stem``extension`, or with a number ("bunny-2.png") where that is taken: nothing is
/// overwritten that nobody asked to write.
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& stem,
                                const std::string& extension);
/// The same with ".png".
std::filesystem::path free_picture_name(const std::filesystem::path& folder,
                                        const std::string& stem);

/// Where the next screenshot goes: XDG_PICTURES_DIR, else ~/Pictures where there is one, else the
/// current folder; "mesher-bunny.png", or the next free number.
std::filesystem::path next_screenshot(const std::string& model_name);

/// Whether a name ends in .png, in any case.
bool is_png_name(const std::filesystem::path& file);

/// A path as a person types or pastes it: blanks and quotes around it go, a leading ~ is the home.
std::filesystem::path typed_path(std::string text);

}  // namespace mesher::app
