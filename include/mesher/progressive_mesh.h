#pragma once

/// @file
/// @brief A mesh at every level of detail, with a cursor.

#include <mesher/asset.h>
#include <mesher/export.h>
#include <mesher/progress.h>
#include <mesher/simplify.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mesher {

/// How a progressive mesh is made.
struct ProgressiveOptions {
  /// Faces of the coarsest level; 0: chosen by size and error.
  std::uint32_t base_faces = 0;
  CostPolicy cost = CostPolicy::quadric;           ///< which edge is collapsed first
  Placement placement = Placement::optimal;        ///< where the merged vertex is placed
  BoundaryRule boundary = BoundaryRule::preserve;  ///< how boundary edges are simplified
  float crease_angle_deg = 180.0F;  ///< edges whose face normals differ by more are creases, too
  AttributeWeights weights{};       ///< Pre: each is 0 or more
  ProgressCallback progress{};      ///< may be empty
};

/// The elements [begin, end) of an array.
struct ElementRange {
  std::uint32_t begin = 0;  ///< the first element
  std::uint32_t end = 0;    ///< behind the last element
};

/// The parts of the arrays that moves of the cursor wrote: disjoint and ascending.
struct ChangedRanges {
  std::vector<ElementRange> positions;  ///< of ProgressiveMesh::positions
  std::vector<ElementRange> indices;    ///< of ProgressiveMesh::indices
};

/// A coarse base, the vertex splits that refine it up to the full model, and a cursor: the current
/// level (H. Hoppe, "Progressive meshes", 1996). Level i is the base after the first i splits, and
/// the last level is the model itself, bit by bit. Vertices and faces are numbered in the order in
/// which they appear, so each level's arrays are a prefix of the full ones, apart from the indices
/// around the splits.
///
/// Moving the cursor changes the object; so one thread at a time may use it.
class MESHER_API ProgressiveMesh {
 public:
  /// Simplifies a model to its base, and keeps every step. The cursor is at full detail. O(F log
  /// F).
  ///
  /// Throws InputError if the model has no faces; Cancelled.
  explicit ProgressiveMesh(const Asset& model, const ProgressiveOptions& options = {});
  /// Takes over another progressive mesh, which may then only be assigned or destroyed.
  ProgressiveMesh(ProgressiveMesh&&) noexcept;
  /// Takes over another progressive mesh, which may then only be assigned or destroyed.
  ProgressiveMesh& operator=(ProgressiveMesh&&) noexcept;
  ~ProgressiveMesh();

  /// Reads a .pm file (docs/pm-format.md). The cursor is at the finest level in it. If the file is
  /// damaged, `damage` says so, and the levels before the damage are there.
  ///
  /// Throws InputError if not even the base can be read; Cancelled.
  static ProgressiveMesh load(const std::filesystem::path& file,
                              const ProgressCallback& progress = {});
  /// Writes a .pm file, which holds positions, faces and creases. The cursor stays. O(F).
  ///
  /// `coordinate_bits`: 0 keeps every bit of a position; 4 to 24: positions are rounded to a grid
  /// of that many bits per axis. Throws OutputError; UsageError for other numbers of bits;
  /// Cancelled.
  void save(const std::filesystem::path& file, unsigned coordinate_bits = 0,
            const ProgressCallback& progress = {});

  /// Returns the cursor: the number of splits of the current level.
  std::uint32_t level() const;
  /// Returns the number of splits, which is the finest level.
  std::uint32_t level_count() const;
  /// Returns the number of faces of a level. Pre: level <= level_count().
  std::uint32_t face_count(std::uint32_t level) const;

  /// Moves the cursor to a level. O(splits in between). Pre: level <= level_count().
  void set_level(std::uint32_t level);
  /// Moves the cursor to the finest level of at most that many faces, or to the base.
  void set_face_count(std::uint32_t faces);
  /// Moves the cursor one split up. Returns false at full detail. O(valence).
  bool refine();
  /// Moves the cursor one split down. Returns false at the base. O(valence).
  bool coarsen();

  /// Returns the positions of the current level, the vertex buffer. Valid until the cursor moves.
  std::span<const std::array<float, 3>> positions() const;
  /// Returns the indices of the current level, the index buffer. Valid until the cursor moves.
  std::span<const std::uint32_t> indices() const;
  /// Returns which parts of the arrays have changed since the last call, so that a GPU's copies of
  /// them need only these; everything at the first call. O(n log n) in their number.
  ChangedRanges take_changes();
  /// Returns the current level as a model of its own, with the attributes of the model that this
  /// was made of, if any. O(V + F).
  Asset current() const;
  /// Returns why the rest of the file could not be used; empty: nothing is missing.
  const std::string& damage() const;

 private:
  struct Data;
  explicit ProgressiveMesh(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace mesher
