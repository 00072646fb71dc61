#include "app/files/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/files/legend_image.h"
#include "app/files/paths.h"
#include "engine/io/png_writer.h"
#include "engine/io/webp.h"
#include "engine/render/picture.h"

namespace mesher::app {
namespace {

/// Times of drawing a picture, and of compressing it as WebP.
constexpr double kWebpWeights[] = {0.75, 0.25};

render::PictureOptions options_of(const PictureScene& scene, const PictureOptions& options,
                                  Progress* progress) {
  return {.window = scene.window,
          .scale = options.scale,
          .supersample = options.supersample,
          .is_transparent = options.is_transparent,
          .tiles = {},
          .progress = progress};
}

/// Between a legend and the borders of the picture.
std::uint32_t margin(const PictureOptions& options) {
  return 8 * options.scale;
}

render::Settings settings_of(render::Settings settings, const PictureOptions& options) {
  if (options.has_lines || settings.shading == render::Shading::none) return settings;
  settings.wireframe = false;
  settings.line_edges = false;
  return settings;
}

void write_png_picture(const PictureScene& scene, const PictureOptions& options,
                       const std::filesystem::path& file, Progress* progress, io::Flush flush) {
  io::AtomicFile out(file);
  const render::PictureOptions drawn = options_of(scene, options, progress);
  const VkExtent2D size = render::picture_size(drawn);
  io::PngWriter writer(out, size.width, size.height);
  std::uint32_t row = 0;
  render::draw_picture(scene.device, scene.renderer, scene.mesh, scene.camera,
                       settings_of(scene.settings, options), drawn, [&](const Image& rows) {
                         const std::uint32_t first = std::exchange(row, row + rows.height);
                         const bool has_legend = first < scene.legend.height + margin(options);
                         if (!has_legend) return writer.append(rows, progress);
                         Image whole = rows;
                         blend_over(whole, first, scene.legend, glm::uvec2(margin(options)));
                         writer.append(whole, progress);
                       });
  writer.finish();
  seal(progress);
  out.commit(flush);
}

}  // namespace

std::string picture_objection(const std::filesystem::path& file, VkExtent2D window,
                              const PictureOptions& options) {
  if (!is_png_name(file) && !is_webp_name(file)) {
    return "'" + file.string() + "' does not end in .png or .webp";
  }
  const std::uint32_t side = options.scale * std::max(window.width, window.height);
  const std::string size =
      fmt::format("{} x {} pixels", options.scale * window.width, options.scale * window.height);
  if (side > render::kMostPictureSide) {
    return fmt::format("{} are too large: a side has at most {} pixels", size,
                       render::kMostPictureSide);
  }
  if (is_webp_name(file) && side > io::kMostWebpSide) {
    return fmt::format("{} are too large for WebP: a side has at most {} pixels; write a .png",
                       size, io::kMostWebpSide);
  }
  if (options.supersample * side > render::kMostDrawnSide) {
    return fmt::format("{} cannot be supersampled {} times: a side has at most {} pixels then",
                       size, options.supersample, render::kMostDrawnSide / options.supersample);
  }
  return "";
}

Image legend_of_picture(const render::Settings& settings, const LegendFacts& facts,
                        VkExtent2D window, const PictureOptions& options) {
  if (!options.has_legend) return {};
  const auto room = [&](std::uint32_t side) {
    return options.scale * side - std::min(options.scale * side, 2 * margin(options));
  };
  return legend_image(legend_of(settings_of(settings, options), facts),
                      static_cast<float>(options.scale), room(window.width), room(window.height));
}

Image draw_picture(const PictureScene& scene, const PictureOptions& options, Progress* progress) {
  Image image = render::draw_picture(scene.device, scene.renderer, scene.mesh, scene.camera,
                                     settings_of(scene.settings, options),
                                     options_of(scene, options, progress));
  blend_over(image, 0, scene.legend, glm::uvec2(margin(options)));
  return image;
}

void write_picture(const PictureScene& scene, const PictureOptions& options,
                   const std::filesystem::path& file, Progress* progress, io::Flush flush) {
  if (!is_webp_name(file)) {
    begin_stage(progress, "drawing");
    return write_png_picture(scene, options, file, progress, flush);
  }
  Stages stages(progress, kWebpWeights);
  stages.next("drawing");
  const Image image = draw_picture(scene, options, progress);
  stages.next("compressing");
  io::write_webp(file, image, progress, flush);
}

}  // namespace mesher::app
