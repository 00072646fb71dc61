#pragma once

#include <glm/vec2.hpp>

#include "engine/render/camera.h"
#include "engine/render/settings.h"

namespace mesher::app {

/// The width of what lies at each side of the model in the window, in pixels.
struct Insets {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;
  friend bool operator==(const Insets&, const Insets&) = default;
};

/// How a document is looked at.
struct View {
  render::Settings settings;  ///< as chosen; `shown_settings` adds what the document asks for
  render::Camera camera;
  glm::dvec2 window{800.0, 600.0};  ///< width and height in pixels
  bool is_finished = true;   ///< the window shows the model, and not a stand-in or an older picture
  bool shows_legend = true;  ///< in the window, of what is colored by a value
  Insets insets;             ///< of panels; the model is drawn into the rest of the window

  /// The upper left corner of the rectangle that shows the model, in pixels.
  glm::dvec2 corner() const { return {insets.left, insets.top}; }
  /// Width and height of that rectangle, in pixels; at least 1.
  glm::dvec2 size() const;
  double aspect() const { return size().x / size().y; }
  /// A point of the window, as the camera takes it.
  render::Cursor cursor(const glm::dvec2& at) const { return {at - corner(), size()}; }
};

/// Changes window and insets. A model that was framed stays framed; otherwise the size of the model
/// keeps its share of the rectangle's smaller side.
void resize(View& view, const Box& box, const glm::dvec2& window, const Insets& insets);

/// Sets the angle from which a model is first seen: a little from the right and above.
void set_default_view(render::Camera& camera);
/// As above, but turned so that a flat model is not seen from its edge.
void set_default_view(render::Camera& camera, const Box& box);
/// Frames a model from that angle.
void frame_from_default_view(View& view, const Box& box);

}  // namespace mesher::app
