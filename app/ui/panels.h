#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <string>
#include <vector>

#include "app/document/session.h"
#include "app/files/folder.h"
#include "app/ui/code_points.h"
#include "app/ui/layout.h"
#include "engine/core/job.h"
#include "engine/core/time_left.h"
#include "engine/render/gpu_mesh.h"

namespace mesher::app {

struct Command;

/// Facts that panels show and the session does not hold.
struct PanelFacts {
  glm::dvec2 window{0.0};      ///< width and height in pixels
  const Job* job = nullptr;    ///< the background job, or null
  bool can_cancel = true;      ///< the job can be canceled
  render::UploadStats upload;  ///< the last upload that was not empty
  double frame_ms = 0.0;       ///< time of the last frame; 0: unknown
  std::string device;
};

/// Requests from panels that the session does not hold.
struct PanelActions {
  bool cancels_job = false;
  bool wants_frames = false;  ///< something is animated: draw again
};

/// The areas of the panels, so that clicks on them do not rotate the model.
using PanelAreas = std::vector<glm::vec4>;  ///< x0, y0, x1, y1 in pixels
/// Where the widgets are, by name: "simplify/remove 10 %". For tests and the state log.
using WidgetAreas = std::map<std::string, glm::vec4, std::less<>>;

/// What panels note while they are drawn.
struct Noted {
  WidgetAreas widgets;
  CodePoints code_points;  ///< of texts that may hold names: what the font needs
  /// Tooltips are shown: not those of what lies behind a dialog, which they would cover.
  bool shows_tooltips = true;
};

/// The number of edges that marking by angle would mark, and the state it was counted for.
struct TagCount {
  std::uint64_t generation = 0;
  std::uint64_t revision = 0;
  float angle_deg = -1.0F;
  std::uint32_t edges = 0;
};

/// The number of faces of each mesh of a scene and the nodes that are listed, and the state that
/// they were found for.
struct SceneList {
  std::uint64_t generation = 0;
  std::uint64_t revision = 0;
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> nodes;  ///< that lead to a mesh with faces
};

/// A folder that a dialog lists, as it was read.
struct ShownFolder {
  Folder folder;
  std::filesystem::file_time_type read_at{};  ///< time of the last change of the folder
  CodePoints code_points;                     ///< of the names
  std::vector<Place> places;                  ///< as they were when the dialog was opened
  std::uint32_t text_shown = 0;               ///< FileBrowser::texts_set of the last frame
};

/// What a file that is about to be saved loses, and the state it was found for.
struct ShownLosses {
  std::uint64_t opening = 0;
  std::uint64_t revision = 0;
  std::uint32_t faces = 0;
  std::string extension;
  std::vector<std::string> losses;
};

/// What panels share while a frame is drawn, and what they keep until the next one.
struct Ui {
  Layout layout;
  PanelFacts facts;
  PanelActions actions;
  PanelAreas areas;
  Noted noted;
  const Command* chosen = nullptr;  ///< in a menu: run after all panels are drawn

  // Kept from frame to frame.
  ShownFolder open_list;        ///< of the open dialog
  ShownFolder save_list;        ///< of the save dialog
  ShownFolder picture_list;     ///< of the dialog of pictures
  ShownLosses losses;           ///< of the save dialog
  std::uint64_t tab_shown = 0;  ///< Document::opening of the tab that ImGui has selected
  std::string help_filter;      ///< in the help
  std::string palette_filter;   ///< in the command palette
  int palette_row = 0;          ///< the chosen one
  bool submits = false;         ///< Enter was pressed in a dialog
  int row_moves = 0;            ///< by the arrow keys, in the list of a dialog
  int slider_faces = 0;  ///< of the detail bar, while it is dragged and until the edit is done
  std::uint64_t target_of = 0;  ///< Document::opening that `target_faces` belongs to
  std::uint32_t target_faces = 0;
  float apply_height = 0.0F;  ///< of the tool's buttons, in the last frame
  TagCount tag_count;
  SceneList scene_list;
  TimeLeft time_left;          ///< of the shown job
  std::size_t shown_step = 0;  ///< of the history, which was scrolled to it
};

/// All panels. Draw between Overlay::begin and Overlay::end.
class Panels {
 public:
  /// Lays the window out, and tells the view what is left for the model.
  PanelActions draw(Session& session, const PanelFacts& facts);
  /// Acts as if the button of the open dialog were pressed, when it is drawn next.
  void submit_dialog() { ui_.submits = true; }
  /// Moves the choice in the list of the open dialog, when it is drawn next.
  void move_row(int rows) { ui_.row_moves += rows; }
  /// Returns whether a panel, as last drawn, covers this point.
  bool covers(const glm::dvec2& at) const;
  const WidgetAreas& widgets() const { return ui_.noted.widgets; }
  /// The code points of the names that were drawn last, other than Latin.
  const CodePoints& code_points() const { return ui_.noted.code_points; }

 private:
  void follow_modes(Session& session);
  void draw_dialogs(Session& session);

  Ui ui_;
  bool had_creases_ = false;
  bool had_levels_ = false;
};

// The parts of the window, one in each file. Each notes the area that it covers.
void draw_menu_bar(Session& session, Ui& ui);
/// The open models, if there are several.
void draw_tabs(Session& session, Ui& ui);
/// The menus without a bar, for the rail of small windows and the context menu.
void draw_menus(const Session& session, Ui& ui);
/// The menu that a right click on the model opens.
void draw_context_menu(Session& session, Ui& ui);
void draw_rail(Session& session, Ui& ui);
void draw_facts(Document& document, Ui& ui);
/// The nodes of the model's scene, if it has one.
void draw_scene(Document& document, Ui& ui);
/// The panel of the tool.
void draw_tool_panel(Session& session, Ui& ui);
void draw_detail_bar(Document& document, Ui& ui);
void draw_status_line(Session& session, Ui& ui);
/// Height of a strip above the model for the legend: in small windows it would cover the model.
float legend_strip(const Session& session, const Layout& layout);
/// Explains what is colored by a value: over the model, or in the strip above it.
void draw_legend(const Session& session, float strip, Ui& ui);
/// What does not fit into the status line.
void draw_message(Document& document, Ui& ui);

/// The blocks of a tool's panel. Where it is low, the buttons stay in sight below the others.
enum class Block {
  settings,  ///< target and rules
  apply,     ///< buttons
  result,
};
// The contents of a tool's panel.
void draw_model_tool(Document& document, Ui& ui);
void draw_look_tool(View& view);
void draw_simplify_tool(Document& document, Block block, Ui& ui);
void draw_subdivide_tool(Document& document, Block block);
void draw_crease_tool(Document& document, Block block, Ui& ui);
void draw_levels_tool(Document& document, const View& view, Block block, Ui& ui);

// The dialogs.
void draw_help(bool& is_open, Ui& ui);
void draw_palette(Session& session, Ui& ui);
void draw_open_dialog(Session& session, Ui& ui);
void draw_save_dialog(Session& session, Ui& ui);
/// The window that the program starts with if no model was named.
void draw_start(Session& session, Ui& ui);
void draw_picture_dialog(Session& session, Ui& ui);
/// The list of places, the list of files and the text of a dialog of files. Returns the entries
/// that are shown. `rest_points`: height that the dialog needs below.
std::vector<const FolderEntry*> draw_browser(FileBrowser& browser, Session& session,
                                             ShownFolder& list, float rest_points, Ui& ui);
/// The open question, over everything else. Returns whether one was drawn.
bool draw_question(Session& session, Ui& ui);

}  // namespace mesher::app
