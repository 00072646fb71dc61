#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/normals.h"
#include "engine/mesh/statistics.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// What bringing a mirror up to date cost.
struct UploadStats {
  std::uint64_t uploaded_bytes = 0;
  std::uint64_t total_bytes = 0;  ///< size of the whole mirror
  std::uint32_t ranges = 0;       ///< pieces copied
};

/// The GPU's mirror of a mesh. Positions and indices are the mesh's own arrays, byte for byte; the
/// class of each half-edge is packed to two bits (16 a word, lowest first); normals are made only
/// where shading asks for them, as two 16-bit numbers (octahedral), one a vertex where no corner
/// splits and one a half-edge otherwise.
class GpuMesh {
 public:
  explicit GpuMesh(gpu::Device& device) : device_(device) {}

  /// Brings the mirror up to date with `mesh` and with the normals that `settings` want, and clears
  /// `mesh.changes()`. Only changed ranges are copied (and the normals of the one-rings they
  /// touch); everything where the array sizes differ or the mesh is new. Waits for frames in flight
  /// where it copies at all. Throws DeviceError where the mesh is too large for the device.
  /// O(changes), O(V + F) when whole.
  UploadStats apply(Mesh& mesh, const Settings& settings);
  /// The next apply() copies everything: `mesh` is another object than before.
  void invalidate() { is_valid_ = false; }

  gpu::Device& device() const { return device_; }
  std::uint32_t vertex_count() const { return vertex_count_; }
  std::uint32_t face_count() const { return face_count_; }
  std::uint32_t crease_count() const { return static_cast<std::uint32_t>(creases_.size()); }
  std::uint32_t boundary_count() const { return static_cast<std::uint32_t>(boundaries_.size()); }
  /// Contains every position; never shrinks while edits go on.
  const Box& box() const { return box_; }
  bool has_normals() const { return normals_.mode != NormalMode::none; }
  bool has_corner_normals() const { return normals_.mode == NormalMode::corner; }

  const gpu::Buffer& positions() const { return position_buffer_; }  ///< vec3 a vertex
  const gpu::Buffer& indices() const { return index_buffer_; }       ///< uint a half-edge
  const gpu::Buffer& classes() const { return class_buffer_; }       ///< 16 half-edges a uint
  const gpu::Buffer& normals() const { return normals_.buffer; }     ///< uint a vertex or half-edge
  /// Half-edges of the edges that the wire pass draws: creases, then (at crease_count())
  /// boundaries.
  const gpu::Buffer& line_edges() const { return line_buffer_; }

  /// Everything the GPU holds, read back: positions, indices, classes, line edges, normals, one
  /// after the other. For tests: equal to that of a fresh mirror after any sequence of edits.
  std::vector<std::byte> read_back() const;

 private:
  enum class NormalMode { none, vertex, corner };
  struct Normals {
    NormalMode mode = NormalMode::none;
    CornerNormalOptions options;
    Array<glm::vec3> corner;  ///< kept in corner mode, for update_corner_normals
    Array<std::uint32_t> packed;
    gpu::Buffer buffer;
  };

  void upload_whole(const Mesh& mesh, UploadStats& stats);
  void upload_changes(const Mesh& mesh, UploadStats& stats);
  void upload_classes(const Mesh& mesh, UploadStats& stats);
  void upload_lines(UploadStats& stats);
  void update_normals(const Mesh& mesh, const Settings& settings, bool whole, UploadStats& stats);
  void build_normals(const Mesh& mesh, UploadStats& stats);
  void update_changed_normals(const Mesh& mesh, UploadStats& stats);
  void copy(gpu::Buffer& buffer, std::span<const std::byte> source,
            std::span<const gpu::ByteRange> ranges, UploadStats& stats);

  gpu::Device& device_;
  bool is_valid_ = false;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t face_count_ = 0;
  Box box_;
  gpu::Buffer position_buffer_;
  gpu::Buffer index_buffer_;
  gpu::Buffer class_buffer_;
  gpu::Buffer line_buffer_;
  Array<std::uint32_t> classes_;      ///< what class_buffer_ holds
  std::vector<Halfedge> creases_;     ///< sorted
  std::vector<Halfedge> boundaries_;  ///< sorted
  Normals normals_;
};

}  // namespace mesher::render
