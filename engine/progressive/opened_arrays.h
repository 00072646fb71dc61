#pragma once

#include <cstddef>

#include "engine/mesh/mesh.h"
#include "engine/progressive/split_step.h"

namespace mesher::progressive {

/// The mesh's arrays, resized together.
class OpenedArrays {
 public:
  explicit OpenedArrays(Mesh& mesh) : arrays_(MeshArrays::open(mesh)) {}

  /// Throws std::bad_alloc; sizes may differ afterward, but no data is lost: resize to the
  /// previous sizes.
  void resize(std::size_t vertices, std::size_t faces) {
    arrays_.position.resize(vertices);
    arrays_.outgoing.resize(vertices);
    if (!arrays_.vertex_sharpness.empty()) arrays_.vertex_sharpness.resize(vertices);
    arrays_.origin.resize(3 * faces);
    arrays_.twin.resize(3 * faces);
    arrays_.sharpness.resize(3 * faces);
  }
  void grow(std::size_t vertices, std::size_t faces) {
    const std::size_t vertices_before = arrays_.position.size();
    const std::size_t faces_before = arrays_.origin.size() / 3;
    try {
      resize(vertices, faces);
    } catch (...) {
      resize(vertices_before, faces_before);
      throw;
    }
  }

  StepArrays step_arrays() {
    return {arrays_.position.data(),
            arrays_.origin.data(),
            arrays_.twin.data(),
            arrays_.outgoing.data(),
            arrays_.sharpness.data(),
            arrays_.vertex_sharpness.empty() ? nullptr : arrays_.vertex_sharpness.data()};
  }

 private:
  MeshArrays::InPlace arrays_;
};

}  // namespace mesher::progressive
