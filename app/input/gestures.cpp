#include "app/input/gestures.h"

#include <glm/geometric.hpp>
#include <utility>

#include "app/document/shown.h"
#include "engine/render/pick.h"

namespace mesher::app {

void Gestures::press(MouseButton button, Modifiers modifiers, const glm::dvec2& at, double time) {
  at_ = at;
  click_.reset();
  may_be_menu_ = button == MouseButton::right;
  if (button != MouseButton::left) {
    drag_ = Drag::pan;
    return;
  }
  const bool is_double = time - last_press_time_ <= kDoubleClickSeconds &&
                         glm::distance(at, last_press_at_) <= kDoubleClickPixels;
  last_press_time_ = is_double ? -1e9 : time;
  last_press_at_ = at;
  drag_ = modifiers.shift ? Drag::pan : Drag::orbit;
  if (document_.creases.is_on) {
    click_ =
        EdgeClick{.toggles = modifiers.control, .chain = modifiers.shift, .is_second = is_double};
  } else if (is_double) {
    recenter();
  }
}

bool Gestures::release() {
  drag_ = Drag::none;
  if (click_) click_edge(document_, view_, at_, *click_);
  click_.reset();
  return std::exchange(may_be_menu_, false);
}

bool Gestures::move(const glm::dvec2& at) {
  if ((click_ || may_be_menu_) && glm::distance(at, at_) < kClickPixels) return false;
  click_.reset();
  may_be_menu_ = false;
  const glm::dvec2 delta = at - at_;
  at_ = at;
  if (drag_ == Drag::none || delta == glm::dvec2(0.0)) return false;
  if (drag_ == Drag::orbit) {
    view_.camera.orbit(delta, view_.size());
  } else {
    view_.camera.pan(delta, view_.size());
  }
  return true;
}

void Gestures::scroll(double steps, const glm::dvec2& at) {
  view_.camera.zoom(steps, view_.cursor(at));
}

void Gestures::recenter() {
  const auto hit = render::pick(shown_mesh(document_), view_.camera.pick_ray(view_.cursor(at_)));
  if (hit) view_.camera.recenter(hit->point);
}

}  // namespace mesher::app
