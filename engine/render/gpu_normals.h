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

/// Sources of normals.
struct NormalSource {
  std::span<const glm::vec3> corner;  ///< one per half-edge, used unchanged; empty: from the faces
  std::span<const std::uint32_t> vertex;  ///< one per vertex, packed: preferred to all others
  std::size_t most_vertices = 0;          ///< largest expected size of `vertex`
  bool can_split = false;                 ///< the mesh has creases
};

/// The normals of a GPU mesh.
///
/// There are none unless the shading interpolates them. There is one per vertex if nothing can
/// split them (vertex normals are given, or there is no tagged crease and the threshold is 180
/// degrees); otherwise one per half-edge.
class GpuNormals {
 public:
  enum class Mode { none, vertex, corner };

  explicit GpuNormals(gpu::Device& device) : device_(device) {}

  /// Creates the normals that `settings` need. Creates all of them if anything but `mesh.changes()`
  /// differs from the last call.
  void update(const Mesh& mesh, const Settings& settings, const NormalSource& source,
              bool is_new_mesh, UploadStats& stats);

  Mode mode() const { return mode_; }
  const gpu::Buffer& buffer() const { return buffer_; }
  /// Returns the size of the live part of the buffer: four bytes per normal.
  std::size_t bytes() const { return count_ * sizeof(std::uint32_t); }

 private:
  /// Source of the normals.
  enum class Origin { faces, corners, vertices };

  static Origin origin(const NormalSource& source);
  void take(const Mesh& mesh, const NormalSource& source, bool is_same, UploadStats& stats);
  void build(const Mesh& mesh, UploadStats& stats);
  void pack(std::span<const glm::vec3> normals, UploadStats& stats);
  void update_changed(const Mesh& mesh, UploadStats& stats);

  gpu::Device& device_;
  Mode mode_ = Mode::none;
  CornerNormalOptions options_;  ///< that the normals were computed by
  Origin origin_ = Origin::faces;
  std::size_t count_ = 0;        ///< live normals
  Array<glm::vec3> corner_;      ///< in corner mode, source of `packed_`
  Array<std::uint32_t> packed_;  ///< contents of `buffer_` if not given
  gpu::Buffer buffer_;
};

}  // namespace mesher::render
