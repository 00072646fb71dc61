#pragma once

#include <filesystem>
#include <string>

#include "app/files/picture.h"

namespace mesher::app {

/// Returns the camera for a frame of a turn that begins at `start`. Frame 0 follows the last frame
/// by the same step as any other, so the turn repeats without a jump.
render::Camera turned(const render::Camera& start, std::uint32_t frame, std::uint32_t frames);

/// Returns the camera that a turn begins at. If `camera` looks at the center of the model, it moves
/// back until no frame cuts off more of the model than the first one did. `aspect` is width /
/// height.
render::Camera turn_start(const render::Camera& camera, const Box& box, double aspect,
                          std::uint32_t frames);

/// Returns the file of a frame: in the name, `#` characters stand for the digits of the number from
/// 0. "turn_###.png" gives "turn_007.png". Pre: the name has one.
std::filesystem::path frame_file(const std::filesystem::path& file, std::uint32_t frame);

/// Returns why a turn cannot be written to a file of this name; empty if it can. As
/// picture_objection.
std::string turntable_objection(const std::filesystem::path& file, VkExtent2D window,
                                const PictureOptions& options, const TurntableOptions& turn);

/// Throws OutputError if a file of the turn obviously cannot be written: see io::AtomicFile::check.
void check_turntable_files(const std::filesystem::path& file, const TurntableOptions& turn);

/// Draws a full turn around the model, and writes it as one animated WebP that repeats forever or
/// as one PNG per frame (frame_file). All files appear or none. Reports progress per frame. Pre:
/// turntable_objection is empty. Throws as write_picture.
void write_turntable(const PictureScene& scene, const PictureOptions& options,
                     const TurntableOptions& turn, const std::filesystem::path& file,
                     Progress* progress, io::Flush flush = io::Flush::now);

}  // namespace mesher::app
