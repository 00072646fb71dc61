#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/mesh/mesh.h"
#include "engine/render/gpu_appearance.h"
#include "engine/render/gpu_morph.h"
#include "engine/render/gpu_normals.h"
#include "engine/render/gpu_pose.h"
#include "engine/render/line_edges.h"
#include "engine/render/mesh_box.h"
#include "engine/render/settings.h"
#include "engine/render/sources.h"
#include "engine/render/upload.h"

namespace mesher::render {

/// Marked edges: a selection and the edge under the cursor.
struct MarkedEdges {
  std::vector<Edge> selected;
  Edge hovered;  ///< none: no edge is hovered
  friend bool operator==(const MarkedEdges&, const MarkedEdges&) = default;
};

/// The GPU's mirror of a mesh.
///
/// Positions and indices are the mesh's own arrays, byte for byte. The class of each half-edge is
/// packed into two bits (16 per word, lowest first). Normals are created only if the shading needs
/// them. Shaders access all of it by address, so the range limit of descriptors does not apply.
class GpuMesh {
 public:
  explicit GpuMesh(gpu::Device& device)
      : device_(device), normals_(device), morph_(device), pose_(device), appearance_(device) {}

  /// Updates the mirror from `mesh` and the normals that `settings` need, and clears
  /// `mesh.changes()`.
  ///
  /// Copies only changed ranges (and the normals of the one-rings they touch), or everything if the
  /// mesh is new. Live elements are a prefix of the buffers. A mesh that shrinks keeps its buffers.
  /// A mesh that grows again within them uploads its recorded changes, including new elements.
  /// Beyond them, an array is copied whole into a larger buffer (a progressive mesh has room for
  /// all its splits from the start). `sources` are read, not kept.
  ///
  /// Waits for frames in flight if it copies anything. O(changes + crease and boundary edges), or
  /// O(V + F) for a full copy. Throws DeviceError if the mesh is too large for the device.
  UploadStats apply(Mesh& mesh, const Settings& settings, const Sources& sources = {});
  /// Sets the marked edges. Returns whether that changes the image. O(marked edges).
  ///
  /// Pre: they are edges of the mesh as it is drawn next, so call it again when edges are removed.
  /// A new mesh has no marked edges.
  bool mark(const MarkedEdges& marked);
  /// Makes the next apply() copy everything. Call it when the mesh object changes.
  void invalidate() { is_valid_ = false; }

  gpu::Device& device() const { return device_; }
  std::uint32_t vertex_count() const { return vertex_count_; }
  std::uint32_t face_count() const { return face_count_; }
  std::uint32_t halfedge_count() const { return 3 * face_count_; }
  std::uint32_t crease_count() const { return static_cast<std::uint32_t>(lines_.creases.size()); }
  std::uint32_t boundary_count() const {
    return static_cast<std::uint32_t>(lines_.boundaries.size());
  }
  std::uint32_t selected_count() const {
    return static_cast<std::uint32_t>(marked_.selected.size());
  }
  bool has_hovered() const { return marked_.hovered.is_valid(); }
  /// Returns a box that contains everything drawn: see MeshBox.
  const Box& box() const { return pose_.is_empty() ? box_.get() : pose_.box(); }

  const gpu::Buffer& positions() const { return positions_; }   ///< vec3 per vertex
  const gpu::Buffer& indices() const { return indices_; }       ///< uint per half-edge
  const gpu::Buffer& classes() const { return class_buffer_; }  ///< 16 half-edges per uint
  const GpuNormals& normals() const { return normals_; }
  const GpuMorph& morph() const { return morph_; }  ///< how vertices move during a geomorph
  const GpuPose& pose() const { return pose_; }     ///< how a scene moves vertices
  const GpuAppearance& appearance() const { return appearance_; }
  /// Edges drawn as lines of their own (Line: half-edge and weight, two words), in ascending order.
  /// So the image does not depend on the edits that led to the mesh.
  const gpu::Buffer& creases() const { return crease_buffer_; }
  const gpu::Buffer& boundaries() const { return boundary_buffer_; }
  /// Marked edges as lines: the selected ones, then the hovered one.
  const gpu::Buffer& marks() const { return mark_buffer_; }

  /// Returns the live part of the GPU data, read back: positions, indices, classes, creases,
  /// boundaries, normals, heads and splits, one after another. For tests: it equals that of a fresh
  /// mirror after any sequence of edits.
  std::vector<std::byte> read_back() const;

 private:
  /// A buffer and the size of its live part.
  struct Part {
    const gpu::Buffer* buffer;
    std::size_t bytes;
  };

  void forget_buffers();
  /// Reserves room for `splits` splits, so that later splits do not reallocate buffers.
  void make_room_for(const Mesh& mesh, std::size_t splits);
  void copy_arrays(const Mesh& mesh, UploadStats& stats);
  void copy_all_classes(const Mesh& mesh, UploadStats& stats);
  void copy_changed_classes(const Mesh& mesh, UploadStats& stats);
  std::array<Part, 8> parts() const;
  shared::SurfaceBlock surface_block() const;

  gpu::Device& device_;
  bool is_valid_ = false;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t face_count_ = 0;
  MeshBox box_;
  Array<std::uint32_t> classes_;  ///< contents of class_buffer_
  LineEdges lines_;               ///< contents of the line buffers
  gpu::Buffer positions_;
  gpu::Buffer indices_;
  gpu::Buffer class_buffer_;
  gpu::Buffer crease_buffer_;
  gpu::Buffer boundary_buffer_;
  MarkedEdges marked_;  ///< contents of mark_buffer_
  gpu::Buffer mark_buffer_;
  GpuNormals normals_;
  GpuMorph morph_;
  GpuPose pose_;
  GpuAppearance appearance_;
};

}  // namespace mesher::render
