#pragma once

#include <filesystem>
#include <string>

#include "app/document/legend.h"
#include "app/document/picture_options.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"
#include "engine/render/renderer.h"

namespace mesher::app {

/// What a picture shows, and what draws it. Pre: `mesh` has been applied with `settings`.
struct PictureScene {
  gpu::Device& device;
  render::Renderer& renderer;
  const render::GpuMesh& mesh;
  render::Camera camera;
  render::Settings settings;
  Box box;            ///< of the model
  Image legend;       ///< drawn over the picture, as legend_of_picture returns it
  VkExtent2D window;  ///< the size that is shown, in pixels; PictureOptions::scale multiplies it
};

/// Returns why a picture of a window of this size cannot be written to a file of this name; empty
/// if it can. Does not look at the file system (io::AtomicFile::check does).
std::string picture_objection(const std::filesystem::path& file, VkExtent2D window,
                              const PictureOptions& options);

/// Returns the legend of a picture, in its pixels: empty if the options do not ask for one, or if
/// it does not fit. `settings` and `window` as in PictureScene. Call as legend_image.
Image legend_of_picture(const render::Settings& settings, const LegendFacts& facts,
                        VkExtent2D window, const PictureOptions& options);

/// Draws a picture and returns it. Pre: its size is without objection.
Image draw_picture(const PictureScene& scene, const PictureOptions& options, Progress* progress);

/// Draws a picture and writes it as PNG or lossless WebP, by the ending of the file's name. The
/// file appears whole or not at all. A PNG is written while it is drawn, in bands of rows. Pre:
/// picture_objection is empty. Throws OutputError, DeviceError, or Cancelled.
void write_picture(const PictureScene& scene, const PictureOptions& options,
                   const std::filesystem::path& file, Progress* progress,
                   io::Flush flush = io::Flush::now);

}  // namespace mesher::app
