#pragma once

#include <cstdint>
#include <string>

#include "app/cli/options.h"
#include "app/cli/progressive_command.h"
#include "app/document/picture_options.h"
#include "engine/mesh/geomorph.h"

namespace mesher::app {

/// A moment between the base of a progressive mesh (`lod` 0) and full detail (1), linear in the
/// time of DetailRange. As in the viewer, `window` splits are animated at that moment.
struct DetailMoment {
  double time = 0.0;
  double window = 1.0;
  std::uint32_t level = 0;  ///< the level that is drawn
  GeomorphTime growth;
};
/// Pre: 0 <= lod <= 1.
DetailMoment detail_moment(double lod, std::uint32_t base_vertices, std::uint32_t splits);

/// How the picture is written.
struct PictureArguments {
  PictureOptions options;
  bool turntable = false;
  TurntableOptions turn;
};

/// Draws one picture of a model without a window. `detail` may ask for less detail: `faces`
/// simplifies the model to that number (or takes the level of a progressive mesh), and `lod` draws
/// a moment between the levels of a progressive mesh, which was read or is built for the picture.
///
/// `picture` may ask for a full turn of the camera instead of one picture.
void run_render(const InputOptions& input, const std::string& output, const LookOptions& look,
                const PictureArguments& picture, const DetailArguments& detail,
                const CommonOptions& common);

}  // namespace mesher::app
