#pragma once

/// @file
/// @brief Pictures of a mesh, drawn by Vulkan without a window.

#include <mesher/asset.h>
#include <mesher/export.h>
#include <mesher/progress.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mesher {

/// How faces are shaded.
enum class Shading {
  none,     ///< edges alone
  flat,     ///< one normal per face
  gouraud,  ///< normals interpolated over each face
};

/// What the surface shows.
enum class Look {
  automatic,   ///< materials or colors if the model has any, otherwise clay
  material,    ///< materials and textures under the light of a studio
  clay,        ///< one color; blue at the back
  base_color,  ///< base colors and their textures, without light
  normals,     ///< normals as colors
  uv_checker,  ///< a checkerboard on the texture coordinates
};

/// How a picture is drawn.
struct RenderOptions {
  std::uint32_t width = 800;        ///< pixels, 1 to 16384
  std::uint32_t height = 600;       ///< pixels, 1 to 16384
  Shading shading = Shading::flat;  ///< how faces are shaded
  Look look = Look::automatic;      ///< what the surface shows
  bool wireframe = false;           ///< edges: thin; boundaries red, creases yellow
  bool dark_background = false;     ///< otherwise light
  bool transparent = false;         ///< no background: alpha is 0 where nothing is drawn
  double yaw_deg = 25.0;            ///< of the camera around the vertical axis
  double pitch_deg = 15.0;          ///< of the camera, -90 to 90; above 0 it looks down
  double zoom = 1.0;                ///< 1 shows the whole model. Pre: above 0
  bool orthographic = false;        ///< no perspective
  float crease_angle_deg = 180.0F;  ///< split Gouraud normals at sharper edges
  unsigned supersample = 1;         ///< squared, pixels drawn per pixel, 1 to 3
  ProgressCallback progress{};      ///< may be empty
};

/// An 8-bit RGBA picture, sRGB-encoded, top row first, rows without padding.
struct MESHER_API Picture {
  std::uint32_t width = 0;         ///< pixels
  std::uint32_t height = 0;        ///< pixels
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes
  /// Textures that could not be drawn, one line each.
  std::vector<std::string> problems;

  /// Writes a PNG that appears whole or not at all. Throws OutputError. Pre: not empty.
  void save(const std::filesystem::path& file) const;
};

/// Draws pictures with a Vulkan device, which it opens once. One thread at a time may use it.
/// Textures are decoded in child processes (fork), so that a damaged one cannot harm the caller.
class MESHER_API Renderer {
 public:
  /// Opens a device. `device`: part of its name, or its number; empty: the best one. Throws
  /// DeviceError if there is none with Vulkan 1.3, and lists the devices.
  explicit Renderer(const std::string& device = {});
  /// Takes over another renderer, which may then only be assigned or destroyed.
  Renderer(Renderer&&) noexcept;
  /// Takes over another renderer, which may then only be assigned or destroyed.
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Returns the name of the device.
  std::string device() const;
  /// Draws a model as the command `mesher render` does: the same options make the same picture. O(V
  /// + F + pixels). Throws InputError if the model has no faces; UsageError if an option is out of
  /// its range; DeviceError if it does not fit into the device; Cancelled.
  Picture render(const Asset& model, const RenderOptions& options = {});

 private:
  struct Device;
  std::unique_ptr<Device> device_;
};

}  // namespace mesher
