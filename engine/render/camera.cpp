#include "engine/render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

#include "engine/core/assert.h"

namespace mesher::render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFrameMargin = 1.08;
constexpr double kWheelStep = 0.9;
/// Limits on the distance: beyond any model in single precision, and safe to square.
constexpr double kLeastDistance = 1e-42;
constexpr double kMostDistance = 1e42;
/// Near limit: geometry nearer to the eye than this fraction of the pivot's distance is not drawn.
constexpr double kLeastNear = 1e-3;

double half_height_at_unit_distance() {
  return std::tan(0.5 * Camera::kFieldOfViewRad);
}

template <class Function>
void for_each_corner(const Box& box, Function&& function) {
  for (int i = 0; i < 8; ++i) {
    function(glm::dvec3((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                        (i & 4) != 0 ? box.max.z : box.min.z));
  }
}

struct DepthRange {
  double near;
  double far;
};

/// Returns the depths of the box along the line of sight, measured from the eye in units of the
/// camera's distance.
DepthRange depth_range(const Camera& camera, const Box& box) {
  if (box.is_empty()) return {0.1, 10.0};
  DepthRange range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for_each_corner(box, [&](const glm::dvec3& corner) {
    const double depth =
        1.0 + glm::dot(corner - camera.pivot(), camera.forward()) / camera.distance();
    range.near = std::min(range.near, depth);
    range.far = std::max(range.far, depth);
  });
  const double margin = 0.01 * (range.far - range.near) + 1e-3;
  return {range.near - margin, range.far + margin};
}

}  // namespace

glm::vec4 ViewTransform::clip(const glm::vec3& p) const {
  const glm::vec3 local = p - origin;
  const glm::vec3 view =
      glm::vec3(glm::dot(rows[0], local), glm::dot(rows[1], local), glm::dot(rows[2], local)) +
      offset;
  return {scale.x * view.x, scale.y * view.y, depth_scale * view.z + depth_offset,
          perspective ? -view.z : 1.0F};
}

double WindowProjection::depth(const glm::dvec3& point) const {
  return glm::dot(point - eye, forward);
}

glm::dvec2 WindowProjection::of(const glm::dvec3& point) const {
  const glm::dvec3 from_eye = point - eye;
  const double unit = perspective ? scale / glm::dot(from_eye, forward) : scale;
  return middle + unit * glm::dvec2(glm::dot(from_eye, right), -glm::dot(from_eye, up));
}

glm::dvec3 Camera::right() const {
  return {std::cos(yaw_), 0.0, -std::sin(yaw_)};
}

glm::dvec3 Camera::forward() const {
  return {-std::sin(yaw_) * std::cos(pitch_), -std::sin(pitch_),
          -std::cos(yaw_) * std::cos(pitch_)};
}

glm::dvec3 Camera::up() const {
  return glm::cross(right(), forward());
}

glm::dvec3 Camera::eye() const {
  return pivot_ - distance_ * forward();
}

void Camera::set_angles(double yaw_rad, double pitch_rad) {
  yaw_ = std::remainder(yaw_rad, 2.0 * kPi);
  pitch_ = std::clamp(pitch_rad, -0.5 * kPi, 0.5 * kPi);
}

void Camera::set_view(View view) {
  switch (view) {
    case View::front:
      return set_angles(0.0, 0.0);
    case View::right:
      return set_angles(0.5 * kPi, 0.0);
    case View::top:
      return set_angles(0.0, 0.5 * kPi);
  }
}

void Camera::orbit(const glm::dvec2& delta, const glm::dvec2& window) {
  const double turn = kPi / std::max(window.y, 1.0);
  set_angles(yaw_ - turn * delta.x, pitch_ + turn * delta.y);
}

glm::dvec3 Camera::plane_offset(const glm::dvec2& delta, const glm::dvec2& window) const {
  const double unit = 2.0 * distance_ * half_height_at_unit_distance() / std::max(window.y, 1.0);
  return unit * (delta.x * right() - delta.y * up());
}

void Camera::pan(const glm::dvec2& delta, const glm::dvec2& window) {
  pivot_ -= plane_offset(delta, window);
}

void Camera::zoom(double steps, const Cursor& cursor) {
  const double before = distance_;
  const glm::dvec3 offset = plane_offset(cursor.position - 0.5 * cursor.window, cursor.window);
  zoom(std::pow(kWheelStep, -steps));
  pivot_ += (1.0 - distance_ / before) * offset;
}

void Camera::zoom(double factor) {
  MESHER_ASSERT(factor > 0.0);
  distance_ = std::clamp(distance_ / factor, kLeastDistance, kMostDistance);
}

void Camera::frame(const Box& box, double aspect) {
  pivot_ = box.is_empty() ? glm::dvec3(0.0) : box.center();
  const double per_height = 1.0 / half_height_at_unit_distance();
  double needed = 0.0;
  if (!box.is_empty()) {
    for_each_corner(box, [&](const glm::dvec3& corner) {
      const glm::dvec3 p = corner - pivot_;
      const double half_height =
          std::max(std::abs(glm::dot(p, right())) / aspect, std::abs(glm::dot(p, up())));
      const double toward_eye = orthographic_ ? 0.0 : -glm::dot(p, forward());
      needed = std::max(needed, toward_eye + kFrameMargin * per_height * half_height);
    });
  }
  distance_ = needed > 0.0 ? std::clamp(needed, kLeastDistance, kMostDistance) : per_height;
}

Ray Camera::pick_ray(const Cursor& cursor) const {
  const glm::dvec3 in_plane = plane_offset(cursor.position - 0.5 * cursor.window, cursor.window);
  if (!orthographic_) {
    return {eye(), glm::normalize(distance_ * forward() + in_plane)};
  }
  // An orthographic projection also shows points behind the eye.
  constexpr double kBehind = 1e5;
  return {pivot_ + in_plane - kBehind * distance_ * forward(), forward()};
}

WindowProjection Camera::places(const glm::dvec2& window) const {
  const double scale = 0.5 * window.y / half_height_at_unit_distance();
  return {.eye = eye(),
          .right = right(),
          .up = up(),
          .forward = forward(),
          .middle = 0.5 * window,
          .scale = orthographic_ ? scale / distance_ : scale,
          .perspective = !orthographic_};
}

ViewTransform Camera::transform(double aspect, const Box& box) const {
  const double scale = 1.0 / half_height_at_unit_distance();
  ViewTransform result;
  result.origin = glm::vec3(pivot_);
  result.perspective = !orthographic_;
  result.scale = glm::vec2(scale / aspect, scale);
  const glm::dvec3 axes[3] = {right(), up(), -forward()};
  const glm::dvec3 rest = glm::dvec3(result.origin) - pivot_;
  glm::dvec3 offset(0.0, 0.0, -1.0);
  for (int i = 0; i < 3; ++i) {
    result.rows[i] = glm::vec3(axes[i] / distance_);
    offset[i] += glm::dot(axes[i], rest) / distance_;
  }
  result.offset = glm::vec3(offset);

  const DepthRange range = depth_range(*this, depth_.value_or(box));
  if (orthographic_) {
    const double depth = range.far - range.near;
    result.depth_scale = static_cast<float>(1.0 / depth);
    result.depth_offset = static_cast<float>(range.far / depth);
  } else {
    const double near = std::max(range.near, kLeastNear);
    const double far = std::max(range.far, 2.0 * near);
    result.depth_scale = static_cast<float>(near / (far - near));
    result.depth_offset = static_cast<float>(near * far / (far - near));
  }
  return result;
}

}  // namespace mesher::render
