#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/session.h"

namespace mesher::app {

/// A picture's width and height in pixels.
struct Size {
  std::uint32_t width = 800;
  std::uint32_t height = 600;
};

/// What every command takes.
struct CommonOptions {
  bool json = false;
  bool quiet = false;
  unsigned threads = 0;  ///< 0: as many as the machine has
};

/// How a model is opened.
struct InputOptions {
  std::string model;
  std::optional<int> crease_index_base;
  bool keep_isolated = false;
  std::optional<float> tag_creases_deg;  ///< edges whose faces meet at more get infinitely sharp
};

/// How a model is looked at: the same words for `view` and `render`.
struct LookOptions {
  std::string size;
  std::string shading;
  bool wireframe = false;
  bool gouraud = false;
  std::string camera;
  std::string view;
  bool orthographic = false;
  bool dark = false;
  std::optional<float> crease_angle_deg;
  unsigned samples = 4;
  std::string device;
  bool validation = false;
};

/// "1,0.5,0.25": nothing where a part is no finite number.
std::optional<std::vector<double>> parse_numbers(const std::string& text);

/// "500" or "640x480". Throws UsageError; sides are 1 to 16384.
Size parse_size(const std::string& text);

/// YAW,PITCH,ZOOM: degrees, degrees, and a factor from 0.001 to 1000 that divides the distance at
/// which the whole model fits (beyond about 3 the eye is inside most models).
struct CameraAngles {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  double zoom = 1.0;
};
/// "30,20" or "30,20,2". Throws UsageError.
CameraAngles parse_camera(const std::string& text);

/// Settings and camera of a session from words. Call once the model is shown and the window's size
/// is known. Throws UsageError.
void apply_look(Session& session, const LookOptions& look);

}  // namespace mesher::app
