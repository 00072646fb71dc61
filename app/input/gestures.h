#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "app/document/document.h"
#include "app/document/view.h"
#include "app/edit/crease_edits.h"

namespace mesher::app {

enum class MouseButton { left, middle, right };

struct Modifiers {
  bool shift = false;
  bool control = false;
};

/// Turns mouse events into camera moves. A left drag orbits. A right or middle drag, or a left drag
/// with Shift, pans. The wheel zooms toward the cursor. A double click makes the point under the
/// cursor the center of rotation. While creases are edited, a click (the left button is pressed and
/// released at one point) selects the edge under the cursor, and a double click its chain.
/// Positions are in pixels from the top left corner, times in seconds.
class Gestures {
 public:
  static constexpr double kDoubleClickSeconds = 0.35;
  static constexpr double kDoubleClickPixels = 5.0;
  /// A press that moves farther is a drag.
  static constexpr double kClickPixels = 4.0;

  Gestures(Document& document, View& view) : document_(document), view_(view) {}

  void press(MouseButton button, Modifiers modifiers, const glm::dvec2& at, double time);
  /// Call for any button. Returns whether it was a right click without a drag: a menu is wanted.
  bool release();
  bool is_dragging() const { return drag_ != Drag::none; }
  /// Returns whether the picture changed.
  bool move(const glm::dvec2& at);
  void scroll(double steps, const glm::dvec2& at);

 private:
  enum class Drag { none, orbit, pan };

  void recenter();

  Document& document_;
  View& view_;
  Drag drag_ = Drag::none;
  bool may_be_menu_ = false;        ///< the right button is pressed and was not dragged
  std::optional<EdgeClick> click_;  ///< the click that a release makes; none: the press is a drag
  glm::dvec2 at_{0.0};
  glm::dvec2 last_press_at_{-1e9};
  double last_press_time_ = -1e9;
};

}  // namespace mesher::app
