#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "app/job.h"
#include "app/session.h"
#include "engine/render/gpu_mesh.h"

namespace mesher::app {

/// What panels show beside the session.
struct PanelFacts {
  const Job* job = nullptr;    ///< what runs in the background
  bool can_cancel = true;      ///< that
  render::UploadStats upload;  ///< the last upload that was not empty
  double frame_ms = 0.0;       ///< how long the last frame took; 0: not known
  std::string device;
};

/// What a person asked for in a panel, beyond what the session itself can hold.
struct PanelActions {
  std::filesystem::path open;
  bool cancels_job = false;
  bool wants_frames = false;  ///< something moves: draw again
};

/// Where panels are, so that clicks on them do not turn the model.
using PanelAreas = std::vector<glm::vec4>;  ///< x0, y0, x1, y1 in pixels

/// How many edges tagging by angle would tag, and of what that is the answer.
struct TagCount {
  std::uint64_t generation = 0;
  std::uint64_t revision = 0;
  float angle_deg = -1.0F;
  std::uint32_t edges = 0;
};

/// Between panels and the window's border, and between two of them.
inline constexpr float kPanelMargin = 10.0F;

/// All panels. Draw between Overlay::begin and Overlay::end.
class Panels {
 public:
  PanelActions draw(Session& session, const PanelFacts& facts);
  /// Opens what is typed in the open dialog when that is drawn next.
  void submit_path() { submits_path_ = true; }
  /// The same for the save dialog.
  void submit_save() { submits_save_ = true; }
  /// Whether a panel, as last drawn, is at this point.
  bool covers(const glm::dvec2& at) const;

 private:
  void draw_right_column(Session& session, const PanelFacts& facts);

  PanelAreas areas_;
  std::string typed_path_;
  bool submits_path_ = false;
  bool submits_save_ = false;
  int slider_faces_ = 0;
  TagCount tag_count_;
};

// One panel a file; each notes the area it covers.
void draw_info_panel(Session& session, const PanelFacts& facts, PanelAreas& areas);
void draw_help_panel(Session& session, PanelAreas& areas);
void draw_message_bar(Session& session, const PanelFacts& facts, PanelActions& actions,
                      PanelAreas& areas);
/// `submits`: as if the button were pressed.
void draw_open_dialog(Session& session, std::string& typed, bool submits, PanelActions& actions,
                      PanelAreas& areas);
void draw_save_dialog(Session& session, bool submits, PanelAreas& areas);

// The panels at the right border, one below the other: `top` is where each begins.

/// Returns where it ends.
float draw_crease_panel(Session& session, const PanelFacts& facts, float top, TagCount& last,
                        PanelAreas& areas);
/// Returns where it ends.
float draw_progressive_panel(Session& session, const PanelFacts& facts, float top,
                             PanelAreas& areas);
/// Returns where it ends.
float draw_subdivide_panel(Session& session, float top, PanelAreas& areas);
/// `slider_faces`: where the slider stands while it is dragged, and until that is done.
void draw_simplify_panel(Session& session, const PanelFacts& facts, float top, int& slider_faces,
                         PanelAreas& areas);

/// Adds the current ImGui window. Call between its Begin and End.
void note_area(PanelAreas& areas);

}  // namespace mesher::app
