#include "app/document/view.h"

namespace mesher::app {

void set_default_view(render::Camera& camera) {
  constexpr double kDegree = 3.14159265358979 / 180.0;
  camera.set_angles(25.0 * kDegree, 15.0 * kDegree);
}

}  // namespace mesher::app
