#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/document/view.h"
#include "engine/io/atomic_file.h"
#include "engine/io/read.h"

namespace mesher::app {

/// A picture's width and height in pixels.
struct Size {
  std::uint32_t width = 800;
  std::uint32_t height = 600;
};

/// The arguments of every command.
struct CommonOptions {
  bool json = false;
  bool quiet = false;
  unsigned threads = 0;     ///< 0: one per core
  bool compresses = false;  ///< of commands that write glTF: meshes by EXT_meshopt_compression
  bool no_fsync = false;    ///< results need not be on the disk when the command ends

  io::Flush flush() const { return no_fsync ? io::Flush::later : io::Flush::now; }
};

/// Limits for models from strangers.
struct LimitOptions {
  std::string memory;       ///< "512MB"; empty: none
  double seconds = 0.0;     ///< 0: none
  std::uint64_t faces = 0;  ///< 0: none
};

/// How a model is opened.
struct InputOptions {
  std::string model;
  std::optional<int> crease_index_base;
  bool keep_isolated = false;
  bool no_weld = false;
  double weld_distance = 0.0;
  /// Edges whose face normals differ by more become infinitely sharp creases.
  std::optional<float> tag_creases_deg;
  bool keeps_scene = false;              ///< as io::ReadOptions; not an option of the command line
  std::optional<std::string> animation;  ///< name or index; set: the model is posed by it
  double time_s = 0.0;                   ///< of the pose
  bool allow_damaged = false;            ///< use the intact part of a damaged file
};

/// Returns the options as those of reading.
io::ReadOptions read_options(const InputOptions& input);

/// Refuses a pose of a model whose format has none. Throws UsageError.
void check_pose(const InputOptions& input);

/// How a model is shown: the same arguments for `view` and `render`.
struct LookOptions {
  render::Settings settings;  ///< those of kRenderOptions
  std::string size;
  bool gouraud = false;  ///< short for --shading gouraud
  std::string camera;
  std::string view;
  bool orthographic = false;
  bool dark = false;          ///< short for --background dark
  bool split_colors = false;  ///< color by split order; only with a level of detail
  std::string device;
  bool validation = false;
};

/// Parses "1,0.5,0.25". None if a part is not a finite number.
std::optional<std::vector<double>> parse_numbers(const std::string& text);

/// Parses a number of bytes: "1000000", "512MB", "1.5 GiB". Throws UsageError.
std::uint64_t parse_bytes(const std::string& option, const std::string& text);

/// "500" or "640x480". Throws UsageError; sides are 1 to 16384.
Size parse_size(const std::string& text, const std::string& option = "--size");

/// YAW,PITCH,ZOOM: two angles and a zoom factor from 0.001 to 1000. At 1 the whole model fits;
/// beyond about 3 the eye is inside most models.
struct CameraAngles {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  double zoom = 1.0;
};
/// "30,20" or "30,20,2". Throws UsageError.
CameraAngles parse_camera(const std::string& text);

/// Sets settings and camera, and frames a model with this bounding box. Pre: the size of the window
/// is known. Throws UsageError.
void apply_look(View& view, const Box& box, const LookOptions& look);

}  // namespace mesher::app
