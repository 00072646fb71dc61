#pragma once

#include <filesystem>
#include <string>

namespace mesher::app {

/// The font of panels and legends.
inline constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// Returns whether there is a file or folder of this name.
bool is_there(const std::filesystem::path& path);

/// Returns whether there is a folder of this name.
bool is_folder(const std::filesystem::path& path);

/// Returns the folder, or the nearest one above it that is there, or the current folder.
std::filesystem::path nearest_folder(const std::filesystem::path& folder);

/// Makes a folder and those above it, unless they are there. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// Returns the file that a name refers to: the path as given, or a file in the assets folder, whose
/// ".obj" may be omitted. If neither exists, returns the path as given, so that the reader reports
/// the error.
std::filesystem::path find_model(const std::string& name);

/// Returns a name that no file has: `folder`/`stem``extension` or, if that exists, the same with a
/// number ("bunny-2.png").
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& stem,
                                const std::string& extension);
/// As above, with ".png".
std::filesystem::path free_picture_name(const std::filesystem::path& folder,
                                        const std::string& stem);

/// Returns the file of the next screenshot: "mesher-bunny.png", or with the next free number. The
/// folder is XDG_PICTURES_DIR, ~/Pictures or the current folder: the first that exists.
std::filesystem::path next_screenshot(const std::string& model_name);

/// Returns the folder of the journals: "mesher" in XDG_STATE_HOME or in ~/.local/state; empty if
/// there is no home, or if HOME is not absolute.
std::filesystem::path state_folder();

/// Returns the folder of the settings: "mesher" in XDG_CONFIG_HOME or in ~/.config; empty if there
/// is no home, or if HOME is not absolute.
std::filesystem::path config_folder();
/// The home folder; empty if there is none.
std::filesystem::path home_folder();
/// The folder of the models that come with the program: ../share/mesher/assets from the program's
/// own folder, so that the program may be installed anywhere.
std::filesystem::path samples_folder();

/// Returns a time of a file as people read it: "2026-11-29 21:30", local time.
std::string time_text(std::filesystem::file_time_type time);

/// Returns whether a name ends in .png, in upper or lower case.
bool is_png_name(const std::filesystem::path& file);
/// The same for .webp.
bool is_webp_name(const std::filesystem::path& file);

/// Returns a path that was typed or pasted, without blanks and quotes around it. A leading ~ is
/// replaced by the home folder.
std::filesystem::path typed_path(std::string text);

}  // namespace mesher::app
