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

/// The difference between two meshes, array by array and bit by bit: what an edit changed, to be
/// taken back and done again. Ranges with their old and new contents; in proportion to what
/// differs.
class MeshDelta {
 public:
  MeshDelta() = default;

  /// The two meshes have the very same arrays.
  bool is_empty() const;
  /// Both meshes have the same vertices, edges and faces under the same ids; positions and
  /// sharpness may differ.
  bool keeps_topology() const { return origin_.is_empty() && twin_.is_empty(); }
  /// Bytes that the difference occupies.
  std::size_t memory_bytes() const;

 private:
  friend MeshDelta difference(const Mesh& before, const Mesh& after);
  friend MeshDelta sharpness_difference(const Mesh& mesh, std::span<const EdgeSharpness> wanted);
  friend void make_room(Mesh& mesh, const MeshDelta& delta);
  friend void apply(Mesh& mesh, const MeshDelta& delta);
  friend void revert(Mesh& mesh, const MeshDelta& delta);

  MeshDelta(const Mesh& before, const Mesh& after);
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

/// What turns `before` into `after`. O(V + F) at the speed of memory, parallel.
MeshDelta difference(const Mesh& before, const Mesh& after);

/// What gives each of these edges its wanted sharpness: the difference to the mesh with that done,
/// without looking at the rest of it. O(n log n) in the number of edges. Pre: every sharpness is 0
/// or more, no edge twice.
MeshDelta sharpness_difference(const Mesh& mesh, std::span<const EdgeSharpness> wanted);

/// Turns the delta's `before` into its `after`, arrays identical bit by bit, and notes what the GPU
/// mirrors of it in `mesh.changes()`: every changed or new element (twins and sharpnesses as edge
/// classes, and the position of a vertex that no face uses any more, whose normal is gone).
/// O(differences), apart from resizing. Throws std::bad_alloc, and nothing has changed then.
/// Pre: `mesh` has the arrays of `before`.
void apply(Mesh& mesh, const MeshDelta& delta);
/// The way back. Pre: `mesh` has the arrays of `after`.
void revert(Mesh& mesh, const MeshDelta& delta);
/// Makes room for either state: apply and revert cannot fail after that. Throws std::bad_alloc.
void make_room(Mesh& mesh, const MeshDelta& delta);

/// The same for what a file says beyond shape.
class AttributesDelta {
 public:
  AttributesDelta() = default;

  bool is_empty() const;
  std::size_t memory_bytes() const;

 private:
  friend AttributesDelta difference(const Attributes& before, const Attributes& after);
  friend void make_room(Attributes& attributes, const AttributesDelta& delta);
  friend void apply(Attributes& attributes, const AttributesDelta& delta);
  friend void revert(Attributes& attributes, const AttributesDelta& delta);

  AttributesDelta(const Attributes& before, const Attributes& after);
  void make_room(Attributes& attributes) const;
  void write(Attributes& attributes, Direction direction) const;

  ArrayDelta texcoord_;
  ArrayDelta normal_;
  ArrayDelta color_;
  ArrayDelta group_;
  std::vector<std::string> old_names_;  ///< as new_names_: empty where they do not differ
  std::vector<std::string> new_names_;
};

AttributesDelta difference(const Attributes& before, const Attributes& after);
/// Pre: `attributes` are those of the delta's `before`.
void apply(Attributes& attributes, const AttributesDelta& delta);
/// Pre: they are those of its `after`.
void revert(Attributes& attributes, const AttributesDelta& delta);
/// Makes room for either state: what can still fail after that are the names of groups, before
/// anything has changed. Throws std::bad_alloc.
void make_room(Attributes& attributes, const AttributesDelta& delta);

}  // namespace mesher
