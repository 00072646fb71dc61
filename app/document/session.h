#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

#include "app/document/creases.h"
#include "app/document/edits.h"
#include "app/document/progressive_view.h"
#include "app/document/saving.h"
#include "app/document/simplification.h"
#include "engine/mesh/model.h"
#include "engine/mesh/statistics.h"
#include "engine/render/camera.h"
#include "engine/render/settings.h"

namespace mesher::app {

/// The state of the program: one model, its edits and how it is shown. It has no window and no GPU:
/// the viewer and scripts drive the same session, so that both give the same result.
struct Session {
  std::filesystem::path file;
  Model model;
  Statistics statistics;
  Edits edits;
  render::Settings settings;
  SimplifySettings simplify;
  subdivide::SubdivideOptions subdivide;  ///< those of kSubdivideRules
  CreaseMode creases;
  Saving saving;
  ProgressiveView progressive;
  render::Camera camera;
  glm::dvec2 window{800.0, 600.0};  ///< width and height in pixels

  bool shows_info = true;
  bool shows_help = false;
  bool shows_open_dialog = false;
  std::string error;   ///< the last failure, until dismissed
  std::string notice;  ///< the last event that the picture does not show

  // Requests to the viewer or the script that runs the session.
  bool wants_quit = false;
  bool wants_screenshot = false;
  /// Increases with every model that is shown, so that copies of the mesh can tell that they are
  /// outdated.
  std::uint64_t model_generation = 0;

  double aspect() const { return window.x / window.y; }
};

/// Shows a model: computes its statistics, discards the edits of the previous model, and frames the
/// model from the camera's current angle. O(F).
void show_model(Session& session, Model&& model, const std::filesystem::path& file);
/// As above, with statistics that were computed elsewhere, such as in a background job. O(1).
void show_model(Session& session, Model&& model, const Statistics& statistics,
                const std::filesystem::path& file);

/// Sets the angle from which a model is first seen: a little from the right and above.
void set_default_view(render::Camera& camera);

}  // namespace mesher::app
