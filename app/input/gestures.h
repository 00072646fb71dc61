#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "app/document/session.h"
#include "app/edit/crease_edits.h"

namespace mesher::app {

enum class MouseButton { left, middle, right };

struct Modifiers {
  bool shift = false;
  bool control = false;
};

/// Turns what the mouse does into camera moves. Left drag orbits; right or middle drag, or left
/// with shift, pans; the wheel zooms toward the cursor; a double click recentres on what is under
/// it. While creases are edited, a click (a press of the left button that lets go where it was)
/// picks the edge under it, a double click its chain. Positions are in pixels from the top left
/// corner; times in seconds.
class Gestures {
 public:
  static constexpr double kDoubleClickSeconds = 0.35;
  static constexpr double kDoubleClickPixels = 5.0;
  /// A press that moves farther is a drag.
  static constexpr double kClickPixels = 4.0;

  explicit Gestures(Session& session) : session_(session) {}

  void press(MouseButton button, Modifiers modifiers, const glm::dvec2& at, double time);
  /// Any button.
  void release();
  bool is_dragging() const { return drag_ != Drag::none; }
  /// Returns whether the picture changed.
  bool move(const glm::dvec2& at);
  void scroll(double steps, const glm::dvec2& at);

 private:
  enum class Drag { none, orbit, pan };

  void recenter();

  Session& session_;
  Drag drag_ = Drag::none;
  std::optional<EdgeClick> click_;  ///< what letting go now does: while a press may be a click yet
  glm::dvec2 at_{0.0};
  glm::dvec2 last_press_at_{-1e9};
  double last_press_time_ = -1e9;
};

}  // namespace mesher::app
