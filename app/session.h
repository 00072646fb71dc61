#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

#include "app/crease_edits.h"
#include "app/edits.h"
#include "app/progressive_view.h"
#include "app/save.h"
#include "engine/mesh/model.h"
#include "engine/mesh/statistics.h"
#include "engine/render/camera.h"
#include "engine/render/settings.h"

namespace mesher::app {

/// What a person sees and can change: one model and how it is looked at. No window, no GPU: a
/// viewer and a script drive the same session, so that both give the same result.
struct Session {
  std::filesystem::path file;
  Model model;
  Statistics statistics;
  Edits edits;
  render::Settings settings;
  SimplifySettings simplify;
  SubdivideSettings subdivide;
  CreaseMode creases;
  Saving saving;
  ProgressiveView progressive;
  render::Camera camera;
  glm::dvec2 window{800.0, 600.0};  ///< width and height in pixels: what "the whole model" must fit

  bool shows_info = true;
  bool shows_help = false;
  bool shows_open_dialog = false;
  std::string error;   ///< last thing that went wrong, until dismissed
  std::string notice;  ///< last thing done that leaves no trace in the picture

  // What a command asks of whoever runs the session.
  bool wants_quit = false;
  bool wants_screenshot = false;
  /// Grows with every model shown, so that mirrors of the mesh know that theirs is another one.
  std::uint64_t model_generation = 0;

  double aspect() const { return window.x / window.y; }
};

/// Shows a model: statistics are computed, the camera frames it from its present angle. Edits of
/// the one before are forgotten. O(F).
void show_model(Session& session, Model&& model, const std::filesystem::path& file);
/// The same with statistics that were computed elsewhere (a background job). O(1).
void show_model(Session& session, Model&& model, const Statistics& statistics,
                const std::filesystem::path& file);

/// The angle from which a model is first seen: a little from the right and above.
void set_default_view(render::Camera& camera);

}  // namespace mesher::app
