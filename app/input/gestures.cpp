#include "app/input/gestures.h"

#include <glm/geometric.hpp>

#include "app/document/shown.h"
#include "engine/render/pick.h"

namespace mesher::app {

void Gestures::press(MouseButton button, Modifiers modifiers, const glm::dvec2& at, double time) {
  at_ = at;
  click_.reset();
  if (button != MouseButton::left) {
    drag_ = Drag::pan;
    return;
  }
  const bool is_double = time - last_press_time_ <= kDoubleClickSeconds &&
                         glm::distance(at, last_press_at_) <= kDoubleClickPixels;
  last_press_time_ = is_double ? -1e9 : time;
  last_press_at_ = at;
  drag_ = modifiers.shift ? Drag::pan : Drag::orbit;
  if (session_.creases.is_on) {
    click_ =
        EdgeClick{.toggles = modifiers.control, .chain = modifiers.shift, .is_second = is_double};
  } else if (is_double) {
    recenter();
  }
}

void Gestures::release() {
  drag_ = Drag::none;
  if (!click_) return;
  click_edge(session_, at_, *click_);
  click_.reset();
}

bool Gestures::move(const glm::dvec2& at) {
  if (click_ && glm::distance(at, at_) < kClickPixels) return false;
  click_.reset();
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

void Gestures::recenter() {
  const auto hit =
      render::pick(shown_mesh(session_), session_.camera.pick_ray({at_, session_.window}));
  if (hit) session_.camera.recenter(hit->point);
}

}  // namespace mesher::app
