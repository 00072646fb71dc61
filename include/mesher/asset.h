#pragma once

/// @file
/// @brief A mesh with its attributes and materials: load, save, build, simplify, subdivide,
/// compare.

#include <mesher/compare.h>
#include <mesher/export.h>
#include <mesher/progress.h>
#include <mesher/simplify.h>
#include <mesher/subdivide.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mesher {

/// The number that stands for no vertex, no half-edge and no face.
inline constexpr std::uint32_t kNoElement = 0xFFFFFFFF;

/// How a file is read.
struct LoadOptions {
  /// Vertices at most this far apart are joined, in model units. 0: those at equal positions.
  /// Unset: none.
  std::optional<double> weld = 0.0;
  bool keep_isolated_vertices = false;  ///< keep vertices that no face uses
  /// Base of the vertex numbers in the `e` lines of an OBJ, 0 or 1. Unset: the one that fits.
  std::optional<int> crease_index_base{};
  ProgressCallback progress{};  ///< may be empty
};

/// How a file is written.
struct SaveOptions {
  bool ascii = false;           ///< PLY and STL as text
  bool compress = false;        ///< glTF with EXT_meshopt_compression
  bool fsync = true;            ///< return only when the file is on the disk
  ProgressCallback progress{};  ///< may be empty
};

/// A kind of repair that was made when a mesh was built, and how often.
struct RepairCount {
  std::string name;         ///< "degenerate_faces_dropped": does not change between versions
  std::string text;         ///< "2 degenerate faces dropped": for people
  std::uint64_t count = 0;  ///< at least 1
};

/// Counts and measures of a mesh.
struct MeshStatistics {
  std::uint32_t vertices = 0;             ///< number of vertices
  std::uint32_t edges = 0;                ///< number of edges
  std::uint32_t faces = 0;                ///< number of faces
  std::uint32_t boundary_edges = 0;       ///< edges with one face
  std::uint32_t boundary_loops = 0;       ///< closed chains of boundary edges
  std::uint32_t components = 0;           ///< connected parts
  std::uint32_t crease_edges = 0;         ///< sharp edges that are not on a boundary
  std::int64_t euler_characteristic = 0;  ///< V - E + F, without isolated vertices
  double area = 0.0;                      ///< square model units
  double volume = 0.0;                    ///< signed, cubic model units; meaningful if closed
  std::array<float, 3> box_min{};         ///< lowest corner of the bounding box
  std::array<float, 3> box_max{};         ///< highest corner of the bounding box
  double diagonal = 0.0;                  ///< of the bounding box, in model units
};

/// A triangle mesh with its attributes (texture coordinates, normals, colors, ...) and materials.
///
/// The mesh is an oriented manifold in flat half-edge arrays. Face f owns the half-edges 3f, 3f+1
/// and 3f+2, counterclockwise; half-edge h runs from `indices()[h]` to the origin of the next
/// half-edge of its face. These arrays are what a GPU draws from: `positions()` is the vertex
/// buffer and `indices()` the index buffer, without any conversion.
///
/// An asset does not change, except by assignment, `tag_creases` and `set_crease`. Operations
/// return new assets. A copy shares the arrays and costs O(1). Several threads may use one asset at
/// once if none of them changes it.
///
/// All errors are exceptions (mesher/error.h). Results do not depend on the number of threads.
class MESHER_API Asset {
 public:
  /// Makes an asset without vertices. O(1).
  Asset();
  /// Shares the arrays of another asset. O(1).
  Asset(const Asset&);
  /// Takes over another asset, which is empty afterwards. O(1).
  Asset(Asset&&) noexcept;
  /// Shares the arrays of another asset. O(1).
  Asset& operator=(const Asset&);
  /// Takes over another asset. O(1).
  Asset& operator=(Asset&&) noexcept;
  ~Asset();

  /// Reads a file in the format of its extension: OBJ, PLY, STL, OFF, glTF, GLB, or a progressive
  /// mesh (.pm) at full detail. A glTF scene becomes one mesh in world coordinates. Builds the mesh
  /// as `build` does; `repairs` says what was repaired. O(size of the file).
  ///
  /// Throws InputError with file, line and reason, also for a damaged progressive mesh and for a
  /// file that another program changes meanwhile; DeviceError if out of memory; Cancelled.
  static Asset load(const std::filesystem::path& file, const LoadOptions& options = {});

  /// Makes an oriented manifold of any polygons. Repairs what it can, and counts the repairs:
  /// polygons are triangulated, degenerate and repeated faces dropped, neighbors oriented alike,
  /// edges of more than two faces and vertices of several fans cut. Clean triangles keep their
  /// order and numbers. O(V + F), parallel.
  ///
  /// `corners`: for each corner, face after face, an index into `positions`. `face_sizes`: the
  /// number of corners per face; empty: all faces are triangles. Positions are in model units.
  ///
  /// Throws InputError if an index is out of range, or if the number of corners does not match.
  static Asset build(std::span<const std::array<float, 3>> positions,
                     std::span<const std::uint32_t> corners,
                     std::span<const std::uint32_t> face_sizes = {});

  /// Writes a file in the format of its extension: OBJ, PLY, STL, OFF, glTF or GLB. The file
  /// appears whole or not at all. Returns what the format does not hold, one line each. O(V + F).
  ///
  /// Throws OutputError if it cannot be written; UsageError if the extension is unknown, or .pm,
  /// which ProgressiveMesh writes; Cancelled, and then an older file stays as it was.
  std::vector<std::string> save(const std::filesystem::path& file,
                                const SaveOptions& options = {}) const;

  /// Returns the number of vertices. O(1).
  std::uint32_t vertex_count() const;
  /// Returns the number of faces. O(1).
  std::uint32_t face_count() const;

  /// Returns V positions, in model units: the vertex buffer. Valid until the asset changes or dies.
  std::span<const std::array<float, 3>> positions() const;
  /// Returns 3F indices of vertices, the origins of the half-edges: the index buffer. Valid until
  /// the asset changes or dies.
  std::span<const std::uint32_t> indices() const;
  /// Returns, for each of the 3F half-edges, the opposite one; kNoElement on a boundary. Valid
  /// until the asset changes or dies.
  std::span<const std::uint32_t> twins() const;
  /// Returns, for each of the 3F half-edges, the sharpness of its edge: 0 smooth, infinity a crease
  /// that never becomes smooth, otherwise a number of subdivision levels. Valid until the asset
  /// changes or dies.
  std::span<const float> sharpnesses() const;
  /// Returns what is added to each position to get the file's own coordinates. 0 unless the file is
  /// so far from zero that single precision would lose digits.
  std::array<double, 3> origin() const;
  /// Returns the attributes, one line each: "TEXCOORD_0: 2 x f32".
  std::vector<std::string> attributes() const;

  /// Returns the repairs that `load` or `build` made; empty: none.
  std::vector<RepairCount> repairs() const;
  /// Returns counts and measures. O(F).
  MeshStatistics statistics() const;

  /// Makes the edges whose face normals differ by more than this infinitely sharp creases. O(F).
  void tag_creases(float angle_deg);
  /// Sets the sharpness of the edge between two vertices. Returns false if there is no such edge.
  /// O(V + F) if the arrays are shared with a copy, otherwise O(valence). Pre: both are vertices;
  /// sharpness >= 0.
  bool set_crease(std::uint32_t a, std::uint32_t b, float sharpness);

  /// Returns the mesh with fewer faces, and fills in the report if it is not null. Every step keeps
  /// an oriented manifold of the same topology. O(F log F), about 160 bytes per face.
  ///
  /// Throws Cancelled; UsageError if the options contradict each other.
  Asset simplify(const SimplifyOptions& options, SimplifyReport* report = nullptr) const;

  /// Returns the mesh with every face split into four, `levels` times. O(faces of the result).
  ///
  /// Throws DeviceError if memory or numbers do not suffice; Cancelled.
  Asset subdivide(const SubdivideOptions& options = {}) const;

  /// Measures the distance between this surface and another one. O((samples + V) log F).
  ///
  /// Throws InputError if a surface has no faces; Cancelled.
  Comparison compare(const Asset& other, const CompareOptions& options = {}) const;

 private:
  friend class ProgressiveMesh;
  friend class Renderer;
  struct Data;
  explicit Asset(std::shared_ptr<const Data> data);
  Data& own_data();

  std::shared_ptr<const Data> data_;
};

}  // namespace mesher
