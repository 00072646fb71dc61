#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/array_delta.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/creases.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// The bitwise difference between two meshes, array by array: the undo and redo data of an edit. It
/// stores the changed ranges with their old and new contents; its size is proportional to the
/// difference.
class MeshDelta {
 public:
  MeshDelta() = default;

  /// Returns whether both meshes have identical arrays.
  bool is_empty() const;
  /// Returns whether both meshes have the same vertices, edges and faces under the same ids;
  /// positions and sharpness may differ.
  bool keeps_topology() const { return origin_.is_empty() && twin_.is_empty(); }
  /// Returns the number of bytes that the difference occupies.
  std::size_t memory_bytes() const;

 private:
  friend MeshDelta difference(const Mesh& before, const Mesh& after, Progress* progress);
  friend MeshDelta sharpness_difference(const Mesh& mesh, std::span<const EdgeSharpness> wanted);
  friend void make_room(Mesh& mesh, const MeshDelta& delta);
  friend void apply(Mesh& mesh, const MeshDelta& delta);
  friend void revert(Mesh& mesh, const MeshDelta& delta);

  MeshDelta(const Mesh& before, const Mesh& after, Progress* progress);
  MeshDelta(const Mesh& mesh, std::span<const ElementWrite<float>> sharpness);
  void make_room(Mesh& mesh) const;
  void write(Mesh& mesh, Direction direction) const;

  ArrayDelta position_;
  ArrayDelta origin_;
  ArrayDelta twin_;
  ArrayDelta outgoing_;
  ArrayDelta sharpness_;
  ArrayDelta vertex_sharpness_;
  ArrayDelta bow_tie_copies_;
};

/// Returns the difference that turns `before` into `after`. O(V + F) at memory bandwidth, parallel.
/// Throws Cancelled.
MeshDelta difference(const Mesh& before, const Mesh& after, Progress* progress = nullptr);

/// Returns the difference that sets these edges to their new sharpness, without reading the rest of
/// the mesh. O(n log n) in the number of edges. Pre: every sharpness is at least 0, no edge occurs
/// twice.
MeshDelta sharpness_difference(const Mesh& mesh, std::span<const EdgeSharpness> wanted);

/// Changes the delta's `before` into its `after`, bit for bit. Notes in `mesh.changes()` every
/// element of a GPU array that changes or is new: twins and sharpnesses as edge classes, and also
/// the position of a vertex that lost its last face, because its normal is gone. O(differences),
/// apart from resizing. Throws std::bad_alloc; the mesh is then unchanged. Pre: `mesh` has the
/// arrays of `before`.
void apply(Mesh& mesh, const MeshDelta& delta);
/// Changes the delta's `after` back into its `before`. Pre: `mesh` has the arrays of `after`.
void revert(Mesh& mesh, const MeshDelta& delta);
/// Reserves memory for either state, so that apply and revert cannot fail. Throws std::bad_alloc.
void make_room(Mesh& mesh, const MeshDelta& delta);

/// The difference between two Attributes, like MeshDelta.
class AttributesDelta {
 public:
  AttributesDelta() = default;

  bool is_empty() const;
  std::size_t memory_bytes() const;

 private:
  friend AttributesDelta difference(const Attributes& before, const Attributes& after,
                                    Progress* progress);
  friend void make_room(Attributes& attributes, const AttributesDelta& delta);
  friend void apply(Attributes& attributes, const AttributesDelta& delta);
  friend void revert(Attributes& attributes, const AttributesDelta& delta);

  AttributesDelta(const Attributes& before, const Attributes& after, Progress* progress);
  void make_room(Attributes& attributes) const;
  void write(Attributes& attributes, Direction direction) const;
  bool keeps_types() const { return old_layers_.empty() && new_layers_.empty(); }

  ArrayDelta corner_wedge_;
  ArrayDelta further_;
  std::vector<ArrayDelta> layers_;  ///< of each layer, while both states have the same types
  /// All layers of both states, if their types differ.
  std::vector<AttributeLayer> old_layers_;
  std::vector<AttributeLayer> new_layers_;
  ArrayDelta group_;
  std::vector<FaceGroup> old_groups_;  ///< like new_groups_, empty if they do not differ
  std::vector<FaceGroup> new_groups_;
};

/// As the difference of meshes.
AttributesDelta difference(const Attributes& before, const Attributes& after,
                           Progress* progress = nullptr);
/// Changes `before` into `after`. Pre: `attributes` are those of the delta's `before`.
void apply(Attributes& attributes, const AttributesDelta& delta);
/// Changes `after` back into `before`. Pre: `attributes` are those of the delta's `after`.
void revert(Attributes& attributes, const AttributesDelta& delta);
/// Reserves memory for either state. After that, only copying groups and, where the types of layers
/// differ, layers can fail, before any change. Throws std::bad_alloc.
void make_room(Attributes& attributes, const AttributesDelta& delta);

}  // namespace mesher
