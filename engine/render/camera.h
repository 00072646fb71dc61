#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/mesh/statistics.h"

namespace mesher::render {

/// A half-line. `direction` is a unit vector.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
};

/// View directions, with Y up.
enum class View { front, right, top };

/// A position in the window. Any unit, the same for both members; y runs down from the top edge.
struct Cursor {
  glm::dvec2 position{0.0};
  glm::dvec2 window{1.0};  ///< width and height
};

/// The transform that a shader applies to a vertex p (a float, as the mesh stores it):
///     view = rows * (p - origin) + offset         in units of the camera's distance, looking at -z
///     clip = (scale.x * view.x, scale.y * view.y, depth_scale * view.z + depth_offset,
///             perspective ? -view.z : 1)
/// `origin` is the pivot rounded to float, so p - origin rounds relative to the *difference*
/// (exactly, within a factor of two: Sterbenz 1974). Far from zero, this loses no more precision
/// than the stored positions have lost already. `offset` holds the rest of the pivot. Depth is
/// reversed: 1 near, 0 far.
struct ViewTransform {
  glm::vec3 origin{0.0F};
  glm::mat3 rows{1.0F};  ///< rows[i] is the i-th row (that is, glm's i-th column)
  glm::vec3 offset{0.0F};
  glm::vec2 scale{1.0F};
  float depth_scale = 0.0F;
  float depth_offset = 0.0F;
  bool perspective = true;

  /// Returns the clip coordinates of a point, computed as the shader does; for tests and labels.
  glm::vec4 clip(const glm::vec3& p) const;
};

/// Projects many points to a window: see Camera::places.
struct WindowProjection {
  glm::dvec3 eye{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};  ///< unit vectors, like the next two
  glm::dvec3 up{0.0, 1.0, 0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};
  glm::dvec2 middle{0.0};
  double scale = 1.0;  ///< Cursor units per model unit; in perspective, at depth 1
  bool perspective = true;

  /// Returns the depth of a point along the line of sight, in model units. In perspective, only
  /// points at a depth above 0 are visible.
  double depth(const glm::dvec3& point) const;
  glm::dvec2 of(const glm::dvec3& point) const;
};

/// A turntable camera. It looks at a pivot, turns around the vertical axis (yaw), tilts up to the
/// poles (pitch), and never rolls. All values are double; no Vulkan.
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

  /// Orbits by a drag of `delta` (Cursor units). A drag over the window's height is half a turn.
  /// The model follows the cursor.
  void orbit(const glm::dvec2& delta, const glm::dvec2& window);
  /// Moves the pivot in the view plane by a drag of `delta`. The point of the pivot's plane under
  /// the cursor stays under it.
  void pan(const glm::dvec2& delta, const glm::dvec2& window);
  /// Moves nearer by `steps` wheel clicks (negative: farther), each by a tenth of the distance. The
  /// point of the pivot's plane under the cursor stays in place.
  void zoom(double steps, const Cursor& cursor);
  /// Divides the distance to the pivot by `factor`. Pre: factor > 0.
  void zoom(double factor);
  void set_angles(double yaw_rad, double pitch_rad);
  void set_view(View view);
  void set_orthographic(bool orthographic) { orthographic_ = orthographic; }
  /// Fits the whole box into the view and keeps the angles. An empty box counts as the point 0; for
  /// a single point the view is two units high.
  void frame(const Box& box, double aspect);
  /// Makes `point` the pivot. The eye moves with it at the same distance.
  void recenter(const glm::dvec3& point) { pivot_ = point; }

  /// From now on, near and far planes are fitted to this box, whatever is drawn. Faces at one place
  /// then hide one another alike in pictures of similar models. Pre: the box contains all of them.
  void fit_depth(const Box& box) { depth_ = box; }

  /// Returns the ray of all points under the cursor.
  Ray pick_ray(const Cursor& cursor) const;
  /// Returns the projection to a window of that size: the inverse of pick_ray.
  WindowProjection places(const glm::dvec2& window) const;
  /// Returns the transform with near and far planes fitted to `box`, or to that of fit_depth.
  /// `aspect` is width / height.
  ViewTransform transform(double aspect, const Box& box) const;

  friend bool operator==(const Camera&, const Camera&) = default;

 private:
  glm::dvec3 plane_offset(const glm::dvec2& delta, const glm::dvec2& window) const;

  glm::dvec3 pivot_{0.0};
  double distance_ = 3.0;
  double yaw_ = 0.0;
  double pitch_ = 0.0;
  bool orthographic_ = false;
  std::optional<Box> depth_;
};

}  // namespace mesher::render
