#include "app/gestures.h"

#include <glm/geometric.hpp>

#include "engine/render/pick.h"

namespace mesher::app {

void Gestures::press(MouseButton button, bool shift, const glm::dvec2& at, double time) {
  at_ = at;
  if (button != MouseButton::left) {
    drag_ = Drag::pan;
    return;
  }
  const bool is_double = time - last_press_time_ <= kDoubleClickSeconds &&
                         glm::distance(at, last_press_at_) <= kDoubleClickPixels;
  last_press_time_ = is_double ? -1e9 : time;
  last_press_at_ = at;
  if (is_double) recentre();
  drag_ = shift ? Drag::pan : Drag::orbit;
}

void Gestures::release() {
  drag_ = Drag::none;
}

bool Gestures::move(const glm::dvec2& at) {
  const glm::dvec2 delta = at - at_;
  at_ = at;
  if (drag_ == Drag::none || delta == glm::dvec2(0.0)) return false;
  if (drag_ == Drag::orbit) {
    session_.camera.orbit(delta, session_.window);
  } else {
    session_.camera.pan(delta, session_.window);
  }
  return true;
}

void Gestures::scroll(double steps, const glm::dvec2& at) {
  session_.camera.zoom(steps, {at, session_.window});
}

void Gestures::recentre() {
  const auto hit =
      render::pick(session_.model.mesh, session_.camera.pick_ray({at_, session_.window}));
  if (hit) session_.camera.recentre(hit->point);
}

}  // namespace mesher::app
