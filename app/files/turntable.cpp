#include "app/files/turntable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "app/files/paths.h"
#include "engine/io/png_writer.h"
#include "engine/io/webp.h"

namespace mesher::app {
namespace {

/// Browsers show frames that are much shorter as slowly as ten per second.
constexpr double kMostFramesPerSecond = 60.0;

bool has_number(const std::filesystem::path& file) {
  return file.filename().string().find('#') != std::string::npos;
}

std::uint32_t begin_ms(const TurntableOptions& turn, std::uint32_t frame) {
  return static_cast<std::uint32_t>(
      std::lround(1000.0 * double{turn.seconds} * frame / turn.frames));
}

PictureScene scene_at(const PictureScene& start, std::uint32_t frame, std::uint32_t frames) {
  PictureScene scene = start;
  scene.camera = turned(start.camera, frame, frames);
  return scene;
}

void write_animation(const PictureScene& start, const PictureOptions& options,
                     const TurntableOptions& turn, const std::filesystem::path& file,
                     Progress* progress, io::Flush flush) {
  io::WebpAnimation animation(file, options.scale * start.window.width,
                              options.scale * start.window.height);
  Stages stages(progress, std::vector<double>(turn.frames, 1.0));
  for (std::uint32_t frame = 0; frame < turn.frames; ++frame) {
    stages.next();
    animation.append(draw_picture(scene_at(start, frame, turn.frames), options, progress),
                     begin_ms(turn, frame));
  }
  seal(progress);
  animation.finish(begin_ms(turn, turn.frames), flush);
}

/// Commits the files only after the last one is complete.
void write_frames(const PictureScene& start, const PictureOptions& options,
                  const TurntableOptions& turn, const std::filesystem::path& file,
                  Progress* progress, io::Flush flush) {
  std::vector<std::unique_ptr<io::AtomicFile>> files;
  Stages stages(progress, std::vector<double>(turn.frames, 1.0));
  for (std::uint32_t frame = 0; frame < turn.frames; ++frame) {
    stages.next();
    const Image image = draw_picture(scene_at(start, frame, turn.frames), options, progress);
    files.push_back(std::make_unique<io::AtomicFile>(frame_file(file, frame)));
    io::PngWriter writer(*files.back(), image.width, image.height);
    writer.append(image, progress);
    writer.finish();
  }
  seal(progress);
  io::AtomicFile::commit_all(files, flush);
}

}  // namespace

render::Camera turned(const render::Camera& start, std::uint32_t frame, std::uint32_t frames) {
  render::Camera camera = start;
  camera.set_angles(start.yaw_rad() + 2.0 * std::numbers::pi * frame / frames, start.pitch_rad());
  return camera;
}

render::Camera turn_start(const render::Camera& camera, const Box& box, double aspect,
                          std::uint32_t frames) {
  render::Camera framed = camera;
  framed.frame(box, aspect);
  if (framed.pivot() != camera.pivot()) return camera;
  const double first = framed.distance();
  double most = first;
  for (std::uint32_t frame = 1; frame < frames; ++frame) {
    render::Camera other = turned(camera, frame, frames);
    other.frame(box, aspect);
    most = std::max(most, other.distance());
  }
  render::Camera start = camera;
  start.zoom(first / most);
  return start;
}

std::filesystem::path frame_file(const std::filesystem::path& file, std::uint32_t frame) {
  std::string name = file.filename().string();
  const std::size_t first = name.find('#');
  const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
  name.replace(first, end - first, fmt::format("{:0{}}", frame, end - first));
  return file.parent_path() / name;
}

std::string turntable_objection(const std::filesystem::path& file, VkExtent2D window,
                                const PictureOptions& options, const TurntableOptions& turn) {
  const std::string objection = picture_objection(file, window, options);
  if (!objection.empty()) return objection;
  if (is_png_name(file)) {
    if (has_number(file)) return "";
    return "'" + file.string() +
           "' holds one picture: name a .webp, or numbered frames such as turn_###.png";
  }
  if (has_number(file)) {
    return "'" + file.string() +
           "' is one file: '#' stands for the number of a frame in .png names";
  }
  if (turn.frames > kMostFramesPerSecond * double{turn.seconds}) {
    return fmt::format("{} frames in {:g} s are more than {:g} per second", turn.frames,
                       turn.seconds, kMostFramesPerSecond);
  }
  return "";
}

void check_turntable_files(const std::filesystem::path& file, const TurntableOptions& turn) {
  if (!is_png_name(file)) return io::AtomicFile::check(file);
  for (std::uint32_t frame = 0; frame < turn.frames; ++frame)
    io::AtomicFile::check(frame_file(file, frame));
}

void write_turntable(const PictureScene& scene, const PictureOptions& options,
                     const TurntableOptions& turn, const std::filesystem::path& file,
                     Progress* progress, io::Flush flush) {
  begin_stage(progress, "drawing the turn");
  PictureScene start = scene;
  const double aspect = static_cast<double>(scene.window.width) / scene.window.height;
  start.camera = turn_start(scene.camera, scene.box, aspect, turn.frames);
  if (is_png_name(file)) return write_frames(start, options, turn, file, progress, flush);
  write_animation(start, options, turn, file, progress, flush);
}

}  // namespace mesher::app
