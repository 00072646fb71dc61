#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

#include "app/document/edit_task.h"
#include "app/edit/edit_words.h"

namespace mesher::app {

struct Document;
struct View;

/// A change of the sharpness of edges. It applies to the edges that are selected when it runs,
/// because earlier edits may change the mesh.
struct CreaseRequest {
  enum class Kind : std::uint8_t {
    set,           ///< the selected edges get the sharpness `value`
    change,        ///< the selected edges get sharper by `value` (smoother if it is negative)
    clear_all,     ///< all edges become smooth
    tag_by_angle,  ///< edges whose face normals differ by more than `value` degrees become
                   ///< infinitely sharp
  };
  Kind kind = Kind::set;
  float value = 0.0F;
  /// The edges to change, for `set` and `change`, as edge_list_text writes them; none: those that
  /// are selected.
  std::optional<std::string> edges{};
  /// Requests with the same number become one step of the history; 0: a separate step.
  std::uint64_t drag = 0;
};

/// What a click on an edge does to the selection. By default the edge becomes the selection.
struct EdgeClick {
  bool toggles = false;    ///< adds the edge to the selection, or removes it
  bool chain = false;      ///< selects the chain of the edge (crease_chain)
  bool is_second = false;  ///< of a double click: the chain follows what the first click did
};

/// Turns crease editing on or off. While it is on, creases and boundaries are drawn.
void set_crease_mode(Document& document, bool is_on);
/// Handles a click at a point of the window. A click that hits no edge clears the selection, unless
/// it toggles.
void click_edge(Document& document, const View& view, const glm::dvec2& at, const EdgeClick& click);
/// Call when the cursor has moved (none: it is not over the model). Returns whether the edge under
/// it has changed. O(F), parallel.
bool hover_edge(Document& document, const View& view, const std::optional<glm::dvec2>& at);
/// Selects all creases.
void select_sharp_edges(Document& document);

/// Changes the sharpness of edges, as an edit that can be undone. If nothing changes, the notice
/// says why. Throws UsageError if the model does not have the edges of the request. O(edges) for
/// `set` and `change`; O(E) for the other kinds.
void edit_creases(Document& document, const CreaseRequest& request);

/// The request that `words` describe: "set_sharpness to=2 edges=0-4,7" (`to` may be inf),
/// "change_sharpness by=-1 edges=3", "clear_all_creases" or "mark_creases angle=40". Without
/// `edges`, the selected ones are meant. Throws UsageError.
CreaseRequest crease_request(EditWords& words);

/// The largest finite sharpness that the slider and the keys reach.
inline constexpr float kMaxFiniteSharpness = 10.0F;
/// Changes a sharpness by one step. The result is at least 0; beyond kMaxFiniteSharpness it is
/// infinite.
float changed_sharpness(float sharpness, float by);

}  // namespace mesher::app
