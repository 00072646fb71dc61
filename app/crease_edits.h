#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/render/gpu_mesh.h"

namespace mesher::app {

struct Session;

/// The most that a slider and the keys reach before "for ever".
inline constexpr float kMostSharpness = 10.0F;

/// The mode in which clicks pick edges, and what is picked.
struct CreaseMode {
  bool is_on = false;
  std::vector<Edge> selected;     ///< ascending
  Edge hovered;                   ///< under the cursor; none: no edge is
  float finite_sharpness = 2.0F;  ///< what an edge gets that shall be infinitely sharp no more
  float tag_angle_deg = 40.0F;
  std::uint64_t drags = 0;  ///< of the sharpness slider so far: the number of the last one
};

/// What a command or the panel asks to be done to creases. It is done to the edges that are
/// selected *then*: edits that wait before it may change the mesh.
struct CreaseRequest {
  enum class Kind : std::uint8_t {
    set,           ///< the selected edges get the sharpness `value`
    change,        ///< they get sharper by `value` (or smoother, where it is negative)
    clear_all,     ///< every edge gets smooth
    tag_by_angle,  ///< edges whose faces meet at more than `value` degrees get infinitely sharp
  };
  Kind kind = Kind::set;
  float value = 0.0F;
  /// Requests with the same number become one step of the history; 0: a step of its own.
  std::uint64_t drag = 0;
};

/// What a click on an edge does to the selection. By itself: the edge becomes the selection.
struct EdgeClick {
  bool toggles = false;    ///< adds it, or removes it
  bool chain = false;      ///< it and what continues it (crease_chain)
  bool is_second = false;  ///< of a double click: the chain follows what the first did to the edge
};

/// Starts and ends the mode. Creases and boundaries are drawn while it lasts.
void set_crease_mode(Session& session, bool is_on);
/// A click at a point of the window; beside the edges it ends the selection, unless it toggles.
void click_edge(Session& session, const glm::dvec2& at, const EdgeClick& click);
/// The cursor is there (none: it is not over the model). Returns whether the edge under it is
/// another one than before. O(F), parallel.
bool hover_edge(Session& session, const std::optional<glm::dvec2>& at);
void select_sharp_edges(Session& session);
/// The mesh has other edges now: those picked are no more.
void forget_edges(Session& session);

/// Does it, as an edit that can be undone; says in the notice where nothing or less comes of it.
/// O(edges it changes), but for a look at every edge where it is not about the selected ones.
void edit_creases(Session& session, const CreaseRequest& request);

/// How sharp the selected edges are. The boundary does not count: it is sharp by itself.
struct SelectedSharpness {
  std::uint32_t edges = 0;  ///< that are not on the boundary
  float least = 0.0F;
  float most = 0.0F;
  bool is_mixed() const { return least != most; }
};
SelectedSharpness selected_sharpness(const Session& session);

/// By one step of `by`: below 0 comes nothing, beyond kMostSharpness "for ever".
float changed_sharpness(float sharpness, float by);

/// What a mirror of the mesh shall point out.
render::MarkedEdges marked_edges(const Session& session);

}  // namespace mesher::app
