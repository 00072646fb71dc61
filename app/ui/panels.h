#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "app/document/session.h"
#include "engine/core/job.h"
#include "engine/render/gpu_mesh.h"

namespace mesher::app {

/// Facts that panels show and the session does not hold.
struct PanelFacts {
  const Job* job = nullptr;    ///< the background job, or null
  bool can_cancel = true;      ///< the job can be canceled
  render::UploadStats upload;  ///< the last upload that was not empty
  double frame_ms = 0.0;       ///< time of the last frame; 0: unknown
  std::string device;
};

/// Requests from panels that the session does not hold.
struct PanelActions {
  std::filesystem::path open;
  bool cancels_job = false;
  bool wants_frames = false;  ///< something is animated: draw again
};

/// The areas of the panels, so that clicks on them do not rotate the model.
using PanelAreas = std::vector<glm::vec4>;  ///< x0, y0, x1, y1 in pixels

/// The number of edges that marking by angle would mark, and the state it was counted for.
struct TagCount {
  std::uint64_t generation = 0;
  std::uint64_t revision = 0;
  float angle_deg = -1.0F;
  std::uint32_t edges = 0;
};

/// Space between panels and the window's border, and between panels, in pixels.
inline constexpr float kPanelMargin = 10.0F;

/// All panels. Draw between Overlay::begin and Overlay::end.
class Panels {
 public:
  PanelActions draw(Session& session, const PanelFacts& facts);
  /// Opens the path in the open dialog when the dialog is drawn next.
  void submit_path() { submits_path_ = true; }
  /// As above, for the save dialog.
  void submit_save() { submits_save_ = true; }
  /// Returns whether a panel, as last drawn, covers this point.
  bool covers(const glm::dvec2& at) const;

 private:
  void draw_right_column(Document& document, const View& view, const PanelFacts& facts);

  PanelAreas areas_;
  std::string typed_path_;
  bool submits_path_ = false;
  bool submits_save_ = false;
  int slider_faces_ = 0;
  TagCount tag_count_;
};

// One panel per file. Each notes the area that it covers.
void draw_info_panel(Document& document, render::Settings& settings, const PanelFacts& facts,
                     bool& is_open, PanelAreas& areas);
void draw_help_panel(bool& is_open, PanelAreas& areas);
void draw_message_bar(Document& document, const PanelFacts& facts, PanelActions& actions,
                      PanelAreas& areas);
/// `submits`: acts as if the button were pressed.
void draw_open_dialog(bool& is_open, std::string& typed, bool submits, PanelActions& actions,
                      PanelAreas& areas);
/// The open question, over everything else. Returns whether one was drawn.
bool draw_question(Session& session, PanelAreas& areas);
void draw_save_dialog(Saving& saving, const Document& document, bool submits, PanelAreas& areas);

// The panels at the right border, one below the other. `top` is the upper end of each.

/// Returns the lower end of the panel.
float draw_crease_panel(Document& document, const PanelFacts& facts, float top, TagCount& last,
                        PanelAreas& areas);
/// Returns the lower end of the panel.
float draw_progressive_panel(Document& document, const View& view, const PanelFacts& facts,
                             float top, PanelAreas& areas);
/// Returns the lower end of the panel.
float draw_subdivide_panel(Document& document, float top, PanelAreas& areas);
/// `slider_faces`: the value of the slider while it is dragged and until the edit is finished.
void draw_simplify_panel(Document& document, const PanelFacts& facts, float top, int& slider_faces,
                         PanelAreas& areas);

/// Adds the current ImGui window. Call between its Begin and End.
void note_area(PanelAreas& areas);

}  // namespace mesher::app
