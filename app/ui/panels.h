#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "app/load_job.h"
#include "app/session.h"
#include "engine/render/gpu_mesh.h"

namespace mesher::app {

/// What panels show beside the session.
struct PanelFacts {
  const LoadJob* load = nullptr;  ///< a file being opened
  render::UploadStats upload;     ///< the last upload that was not empty
  double frame_ms = 0.0;          ///< how long the last frame took; 0: not known
  std::string device;
};

/// What a person asked for in a panel, beyond what the session itself can hold.
struct PanelActions {
  std::filesystem::path open;
  bool cancels_load = false;
  bool wants_frames = false;  ///< something moves: draw again
};

/// Where panels are, so that clicks on them do not turn the model.
using PanelAreas = std::vector<glm::vec4>;  ///< x0, y0, x1, y1 in pixels

/// All panels. Draw between Overlay::begin and Overlay::end.
class Panels {
 public:
  PanelActions draw(Session& session, const PanelFacts& facts);
  /// Whether a panel, as last drawn, is at this point.
  bool covers(const glm::dvec2& at) const;

 private:
  PanelAreas areas_;
  std::string typed_path_;
};

// One panel a file; each notes the area it covers.
void draw_info_panel(Session& session, const PanelFacts& facts, PanelAreas& areas);
void draw_help_panel(Session& session, PanelAreas& areas);
void draw_message_bar(Session& session, const PanelFacts& facts, PanelActions& actions,
                      PanelAreas& areas);
void draw_open_dialog(Session& session, std::string& typed, PanelActions& actions,
                      PanelAreas& areas);

/// Adds the current ImGui window. Call between its Begin and End.
void note_area(PanelAreas& areas);

}  // namespace mesher::app
