#include "app/document/view.h"

#include <algorithm>

namespace mesher::app {
namespace {

constexpr double kDegree = 3.14159265358979 / 180.0;

bool is_framed(const render::Camera& camera, const Box& box, double aspect) {
  render::Camera framed = camera;
  framed.frame(box, aspect);
  return framed == camera;
}

/// The distance is in units of the height: a narrow rectangle has to be farther away.
double distance_factor(double aspect) {
  return std::max(1.0, 1.0 / aspect);
}

}  // namespace

glm::dvec2 View::size() const {
  return {std::max(1.0, window.x - insets.left - insets.right),
          std::max(1.0, window.y - insets.top - insets.bottom)};
}

void resize(View& view, const Box& box, const glm::dvec2& window, const Insets& insets) {
  if (view.window == window && view.insets == insets) return;
  const double before = view.aspect();
  const bool was_framed = is_framed(view.camera, box, before);
  view.window = window;
  view.insets = insets;
  if (was_framed) {
    view.camera.frame(box, view.aspect());
  } else {
    view.camera.zoom(distance_factor(before) / distance_factor(view.aspect()));
  }
}

void set_default_view(render::Camera& camera) {
  camera.set_angles(25.0 * kDegree, 15.0 * kDegree);
}

void set_default_view(render::Camera& camera, const Box& box) {
  set_default_view(camera);
  if (box.is_empty()) return;
  constexpr double kFlat = 0.5;
  const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
  if (size.y < kFlat * std::min(size.x, size.z)) camera.set_angles(25.0 * kDegree, 40.0 * kDegree);
  if (size.x < kFlat * std::min(size.y, size.z)) camera.set_angles(60.0 * kDegree, 15.0 * kDegree);
}

void frame_from_default_view(View& view, const Box& box) {
  set_default_view(view.camera, box);
  view.camera.frame(box, view.aspect());
}

}  // namespace mesher::app
