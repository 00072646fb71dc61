#pragma once

#include <cstdint>

#include "engine/progressive/opened_arrays.h"
#include "engine/progressive/progressive_mesh.h"
#include "engine/progressive/split_step.h"
#include "engine/progressive/vertex_split.h"

namespace mesher {

struct ParentSlots;

/// Appends splits to a progressive mesh, with room for all of them from the beginning. While it
/// lives the arrays of the mesh are longer than its level needs, and nothing else changes them.
class SplitAppender {
 public:
  /// Room for so many splits. Throws std::bad_alloc. Pre: mesh.level() == mesh.split_count().
  SplitAppender(ProgressiveMesh& mesh, std::uint32_t splits);
  ~SplitAppender();
  SplitAppender(const SplitAppender&) = delete;
  SplitAppender& operator=(const SplitAppender&) = delete;

  /// As ProgressiveMesh::append, for whoever has been around the parent already. O(moved). Throws
  /// std::bad_alloc; nothing has changed then. Pre: there is room.
  void append(const NewSplit& split, const ParentFan& fan);

 private:
  void write_record(const NewSplit& split, const ParentSlots& slots, VertexSplit& record) const;
  void add_sharpness(const NewSplit& split);

  ProgressiveMesh& mesh_;
  OpenedArrays arrays_;
  StepArrays at_;
  bool takes_notes_;  ///< otherwise everything counts as changed already
};

}  // namespace mesher
