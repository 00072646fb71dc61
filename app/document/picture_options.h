#pragma once

#include <array>
#include <cstdint>

#include "engine/core/option.h"
#include "engine/render/picture.h"

namespace mesher::app {

/// How a picture is written, beside what it shows.
struct PictureOptions {
  std::uint32_t scale = 1;
  std::uint32_t supersample = 1;
  bool is_transparent = false;
  /// Draw the lines of the view: edges, creases, boundaries and marked edges. Without a surface,
  /// lines are drawn in any case, because the picture would be empty.
  bool has_lines = true;
  /// Explain what is colored by a value, if anything is.
  bool has_legend = false;

  friend bool operator==(const PictureOptions&, const PictureOptions&) = default;
};

/// The options of `render`. The lines have options of their own there (kRenderOptions).
inline constexpr std::array kPictureOptions{
    Option<PictureOptions>{.key = "scale",
                           .label = "scale",
                           .help = "multiply the size and all line widths",
                           .member = &PictureOptions::scale,
                           .least = 1.0,
                           .most = render::kMostScale},
    Option<PictureOptions>{
        .key = "supersample",
        .label = "supersample",
        .help = "draw N x N pixels for each pixel, and average them in linear light",
        .member = &PictureOptions::supersample,
        .least = 1.0,
        .most = render::kMostSupersample},
    Option<PictureOptions>{.key = "transparent",
                           .label = "transparent",
                           .help = "draw no background: alpha is 0 where nothing is drawn",
                           .member = &PictureOptions::is_transparent},
    Option<PictureOptions>{
        .key = "legend",
        .label = "legend",
        .help = "explain what colors and lines stand for: sharpness of creases, split order",
        .member = &PictureOptions::has_legend},
};

/// A full turn of the camera around the model.
struct TurntableOptions {
  std::uint32_t frames = 72;
  float seconds = 6.0F;

  friend bool operator==(const TurntableOptions&, const TurntableOptions&) = default;
};

inline constexpr std::array kTurntableOptions{
    Option<TurntableOptions>{.key = "frames",
                             .label = "frames",
                             .help = "number of frames of the turn",
                             .member = &TurntableOptions::frames,
                             .least = 2.0,
                             .most = 720.0},
    Option<TurntableOptions>{.key = "seconds",
                             .label = "seconds",
                             .help = "duration of the turn in an animated WebP",
                             .member = &TurntableOptions::seconds,
                             .unit = "s",
                             .least = 0.1,
                             .most = 600.0},
};

}  // namespace mesher::app
