#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/mesh/statistics.h"

namespace mesher::render {

/// A half-line. `direction` is a unit vector.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
};

/// Directions one looks from, with Y up.
enum class View { front, right, top };

/// Where a point of the window is. Any unit, the same for both; y runs down from the top edge.
struct Cursor {
  glm::dvec2 position{0.0};
  glm::dvec2 window{1.0};  ///< width and height
};

/// What a shader needs to place a vertex p (a float, as the mesh stores it):
///     view = rows * (p - origin) + offset         in units of the camera's distance, looking at -z
///     clip = (scale.x * view.x, scale.y * view.y, depth_scale * view.z + depth_offset,
///             perspective ? -view.z : 1)
/// `origin` is the pivot rounded to float, so that p - origin rounds relative to the *difference*
/// (exactly, within a factor of two: Sterbenz 1974): far from zero nothing is lost but what the
/// stored positions have lost. The rest of the pivot is in `offset`. Depth is reversed: 1 near, 0
/// far.
struct ViewTransform {
  glm::vec3 origin{0.0F};
  glm::mat3 rows{1.0F};  ///< rows[i] is the i-th row (that is, glm's i-th column)
  glm::vec3 offset{0.0F};
  glm::vec2 scale{1.0F};
  float depth_scale = 0.0F;
  float depth_offset = 0.0F;
  bool perspective = true;

  /// Clip coordinates of a point, computed as a shader does; for tests and labels.
  glm::vec4 clip(const glm::vec3& p) const;
};

/// Where points appear in a window, for many of them: see Camera::places.
struct WindowPlaces {
  glm::dvec3 eye{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};  ///< unit vectors, as the next two
  glm::dvec3 up{0.0, 1.0, 0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};
  glm::dvec2 middle{0.0};
  double scale = 1.0;  ///< Cursor units a model unit; in perspective, at a depth of 1
  bool perspective = true;

  /// How far a point is before the eye along the line of sight, model units. In perspective, only
  /// what has a depth above 0 appears.
  double depth(const glm::dvec3& point) const;
  glm::dvec2 of(const glm::dvec3& point) const;
};

/// A turntable: it looks at a pivot, turns around the vertical (yaw) and tilts up to the poles
/// (pitch), and never rolls. All double; no Vulkan.
class Camera {
 public:
  static constexpr double kFieldOfViewRad = 0.6108652381980153;  ///< vertical: 35 degrees

  const glm::dvec3& pivot() const { return pivot_; }
  double distance() const { return distance_; }  ///< from pivot to eye, model units
  double yaw_rad() const { return yaw_; }        ///< in (-pi, pi]; 0 looks along -z, pi/2 along -x
  double pitch_rad() const { return pitch_; }    ///< in [-pi/2, pi/2]; positive looks down
  bool is_orthographic() const { return orthographic_; }
  glm::dvec3 eye() const;
  glm::dvec3 right() const;
  glm::dvec3 up() const;
  glm::dvec3 forward() const;

  /// A drag by `delta` (Cursor units): a drag over the window's height is half a turn. The model
  /// follows the hand.
  void orbit(const glm::dvec2& delta, const glm::dvec2& window);
  /// A drag by `delta` moves the pivot in the view plane, so that the point of the pivot's plane
  /// under the cursor stays under it.
  void pan(const glm::dvec2& delta, const glm::dvec2& window);
  /// `steps` wheel clicks nearer (negative: farther), each by a tenth of the distance; the point of
  /// the pivot's plane under the cursor stays where it is.
  void zoom(double steps, const Cursor& cursor);
  /// Divides the distance by `factor`, about the pivot. Pre: factor > 0.
  void zoom(double factor);
  void set_angles(double yaw_rad, double pitch_rad);
  void set_view(View view);
  void set_orthographic(bool orthographic) { orthographic_ = orthographic; }
  /// Puts the whole box in sight, angles unchanged. An empty box counts as the point 0, a box of
  /// one point as one unit wide.
  void frame(const Box& box, double aspect);
  /// Makes `point` the pivot; the eye moves along, at the same distance.
  void recentre(const glm::dvec3& point) { pivot_ = point; }

  /// The half-line of everything under the cursor.
  Ray pick_ray(const Cursor& cursor) const;
  /// Where points appear in a window of that size: the inverse of pick_ray.
  WindowPlaces places(const glm::dvec2& window) const;
  /// Near and far planes are laid around `box`. `aspect` is width / height.
  ViewTransform transform(double aspect, const Box& box) const;

  friend bool operator==(const Camera&, const Camera&) = default;

 private:
  glm::dvec3 plane_offset(const glm::dvec2& delta, const glm::dvec2& window) const;

  glm::dvec3 pivot_{0.0};
  double distance_ = 3.0;
  double yaw_ = 0.0;
  double pitch_ = 0.0;
  bool orthographic_ = false;
};

}  // namespace mesher::render
