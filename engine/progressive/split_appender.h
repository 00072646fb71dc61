#pragma once

#include <cstdint>

#include "engine/progressive/opened_arrays.h"
#include "engine/progressive/parent_fan.h"
#include "engine/progressive/progressive_mesh.h"
#include "engine/progressive/split_step.h"
#include "engine/progressive/vertex_split.h"

namespace mesher::progressive {

/// Appends splits to a progressive mesh, with memory for all of them allocated at the start. While
/// it exists, the mesh's arrays are longer than its level needs, and nothing else may change them.
class SplitAppender {
 public:
  /// Allocates memory for this many splits. Throws std::bad_alloc. Pre: mesh.level() ==
  /// mesh.split_count().
  SplitAppender(ProgressiveMesh& mesh, std::uint32_t splits);
  ~SplitAppender();
  SplitAppender(const SplitAppender&) = delete;
  SplitAppender& operator=(const SplitAppender&) = delete;

  /// Same as ProgressiveMesh::append, for callers that have already gathered the parent's fan.
  /// O(moved). Throws std::bad_alloc; the mesh is unchanged then. Pre: fewer splits were appended
  /// than allocated.
  void append(const NewSplit& split, const ParentFan& fan);
  /// Removes the last split. O(moved). Pre: it was appended by this object.
  void remove_last();

 private:
  void write_record(const NewSplit& split, const ParentFan& fan, VertexSplit& record) const;
  void reserve_moved(std::uint32_t count);
  void add_sharpness(const NewSplit& split);

  ProgressiveMesh& mesh_;
  OpenedArrays arrays_;
  StepArrays at_;
  bool takes_notes_;  ///< false: everything is marked as changed already
};

}  // namespace mesher::progressive
