#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/mesh/mesh.h"
#include "engine/render/gpu_morph.h"
#include "engine/render/gpu_normals.h"
#include "engine/render/line_edges.h"
#include "engine/render/mesh_box.h"
#include "engine/render/settings.h"
#include "engine/render/sources.h"
#include "engine/render/upload.h"

namespace mesher::render {

/// Edges that are pointed out, whatever they are: a selection, and what is under the cursor.
struct MarkedEdges {
  std::vector<Edge> selected;
  Edge hovered;  ///< none: no edge is
  friend bool operator==(const MarkedEdges&, const MarkedEdges&) = default;
};

/// The GPU's mirror of a mesh. Positions and indices are the mesh's own arrays, byte for byte; the
/// class of each half-edge is packed to two bits (16 a word, lowest first); normals are made only
/// where shading asks for them. Shaders reach all of it by address, so no limit on the range of a
/// descriptor applies.
class GpuMesh {
 public:
  explicit GpuMesh(gpu::Device& device) : device_(device), normals_(device), morph_(device) {}

  /// Brings the mirror up to date with `mesh` and with the normals that `settings` want, and clears
  /// `mesh.changes()`. Only changed ranges are copied (and the normals of the one-rings they
  /// touch); everything where the mesh is new. Live elements are a prefix of the buffers: a mesh
  /// that shrinks keeps its buffers, and one that grows again within them uploads what it has noted
  /// as changed, new elements included; past them an array is copied whole into a larger buffer (a
  /// progressive mesh has room for all its splits from the start).
  /// Waits for frames in flight where it copies at all. Throws DeviceError where the mesh is too
  /// large for the device. O(changes + crease and boundary edges), O(V + F) when whole. `sources`
  /// are read, not kept.
  UploadStats apply(Mesh& mesh, const Settings& settings, const Sources& sources = {});
  /// Points edges out from now on. Pre: they are edges of the mesh as it is drawn next; so call it
  /// again where edges vanish; a new mesh has none. Returns whether that changes the picture.
  /// O(marked edges).
  bool mark(const MarkedEdges& marked);
  /// The next apply() copies everything: for another mesh object than before.
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
  /// Contains all that is drawn: see MeshBox.
  const Box& box() const { return box_.get(); }

  const gpu::Buffer& positions() const { return positions_; }   ///< vec3 a vertex
  const gpu::Buffer& indices() const { return indices_; }       ///< uint a half-edge
  const gpu::Buffer& classes() const { return class_buffer_; }  ///< 16 half-edges a uint
  const GpuNormals& normals() const { return normals_; }
  const GpuMorph& morph() const { return morph_; }  ///< how vertices move while splits grow
  /// The edges that are lines of their own (Line: half-edge and weight, two words), ascending: so
  /// the picture does not depend on the edits that led to a mesh.
  const gpu::Buffer& creases() const { return crease_buffer_; }
  const gpu::Buffer& boundaries() const { return boundary_buffer_; }
  /// Those that are pointed out, as lines: the selected ones, then the hovered one.
  const gpu::Buffer& marks() const { return mark_buffer_; }

  /// The live part of what the GPU holds, read back: positions, indices, classes, creases,
  /// boundaries, normals, heads, splits, one after the other. For tests: equal to that of a fresh
  /// mirror after any sequence of edits.
  std::vector<std::byte> read_back() const;

 private:
  /// A buffer and how much of it is live.
  struct Part {
    const gpu::Buffer* buffer;
    std::size_t bytes;
  };

  void forget_buffers();
  /// For a mesh whose splits may come at any time: none of them moves a buffer.
  void make_room_for(const Mesh& mesh, std::size_t splits);
  void copy_arrays(const Mesh& mesh, UploadStats& stats);
  void copy_all_classes(const Mesh& mesh, UploadStats& stats);
  void copy_changed_classes(const Mesh& mesh, UploadStats& stats);
  std::array<Part, 8> parts() const;

  gpu::Device& device_;
  bool is_valid_ = false;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t face_count_ = 0;
  MeshBox box_;
  Array<std::uint32_t> classes_;  ///< what class_buffer_ holds
  LineEdges lines_;               ///< what the buffers of lines hold
  gpu::Buffer positions_;
  gpu::Buffer indices_;
  gpu::Buffer class_buffer_;
  gpu::Buffer crease_buffer_;
  gpu::Buffer boundary_buffer_;
  MarkedEdges marked_;  ///< what mark_buffer_ holds
  gpu::Buffer mark_buffer_;
  GpuNormals normals_;
  GpuMorph morph_;
};

}  // namespace mesher::render
