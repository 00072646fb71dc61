#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/gpu/buffer.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/normals.h"
#include "engine/render/settings.h"
#include "engine/render/upload.h"

namespace mesher::render {

/// Where normals come from.
struct NormalSource {
  std::span<const glm::vec3> corner;      ///< one a half-edge, as they are; empty: from the faces
  std::span<const std::uint32_t> vertex;  ///< one a vertex, packed: before all others
  std::size_t most_vertices = 0;          ///< how many there may be of `vertex`, as far as is known
  bool can_split = false;                 ///< the mesh has creases
};

/// The normals of a GPU mesh: none unless shading interpolates them; one a vertex where nothing can
/// split them (given so; or no tagged crease and a threshold of 180 degrees), otherwise one a
/// half-edge.
class GpuNormals {
 public:
  enum class Mode { none, vertex, corner };

  explicit GpuNormals(gpu::Device& device) : device_(device) {}

  /// Makes what `settings` want, whole where anything but `mesh.changes()` differs from before.
  void update(const Mesh& mesh, const Settings& settings, const NormalSource& source,
              bool is_new_mesh, UploadStats& stats);

  Mode mode() const { return mode_; }
  const gpu::Buffer& buffer() const { return buffer_; }
  /// How much of the buffer is live: four bytes a normal.
  std::size_t bytes() const { return count_ * sizeof(std::uint32_t); }

 private:
  /// What they are made of.
  enum class Origin { faces, corners, vertices };

  static Origin origin(const NormalSource& source);
  void take(const Mesh& mesh, const NormalSource& source, bool is_same, UploadStats& stats);
  void build(const Mesh& mesh, UploadStats& stats);
  void pack(std::span<const glm::vec3> normals, UploadStats& stats);
  void update_changed(const Mesh& mesh, UploadStats& stats);

  gpu::Device& device_;
  Mode mode_ = Mode::none;
  float crease_angle_deg_ = 0.0F;
  Origin origin_ = Origin::faces;
  std::size_t count_ = 0;        ///< live normals
  Array<glm::vec3> corner_;      ///< in corner mode, what `packed_` was made of
  Array<std::uint32_t> packed_;  ///< what `buffer_` holds where it is not given
  gpu::Buffer buffer_;
};

}  // namespace mesher::render
