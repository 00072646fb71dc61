#pragma once

#include <cstdint>
#include <string>

#include "app/cli/options.h"
#include "app/cli/progressive_command.h"
#include "engine/mesh/geomorph.h"

namespace mesher::app {

/// A moment on the way from the base of a progressive mesh (`lod` 0) to all detail (1), even in
/// DetailRange's time; `window` splits are growing then, as in the viewer.
struct DetailMoment {
  double time = 0.0;
  double window = 1.0;
  std::uint32_t level = 0;  ///< that is drawn
  GeomorphTime growth;
};
/// Pre: 0 <= lod <= 1.
DetailMoment detail_moment(double lod, std::uint32_t base_vertices, std::uint32_t splits);

/// Draws one picture of a model without a window. In less detail where `detail` says so: simplified
/// to so many faces (the level of a progressive mesh, where it is one), or at a moment between the
/// levels of a progressive mesh, read or made on the fly.
void run_render(const InputOptions& input, const std::string& output, const LookOptions& look,
                const DetailArguments& detail, const CommonOptions& common);

}  // namespace mesher::app
