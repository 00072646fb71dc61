#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/io/atomic_file.h"
#include "engine/io/gltf_compress.h"
#include "engine/io/gltf_data.h"
#include "engine/io/gltf_file.h"
#include "engine/io/gltf_primitive_write.h"
#include "engine/io/gltf_uses.h"
#include "engine/io/gltf_write.h"

namespace mesher::io {

/// New levels of detail of a mesh of a document, finest first.
struct GltfMeshEdit {
  std::uint64_t mesh = 0;
  /// The levels from the second one on become nodes of MSFT_lod.
  std::vector<GltfLevel> levels;
  /// The first level replaces the mesh. Otherwise the mesh is written as it was.
  bool replaces = true;
};

/// Writes a glTF document again, with some meshes edited.
///
/// Everything else is written as it was: JSON (also unknown extensions and extras), animations,
/// skins, images with their bytes, and the vertices of unedited meshes, bit for bit and in their
/// order. Indices stay what they were: what an edit leaves unused gives its place to what it adds.
/// All data goes into one buffer, also that of files beside the document.
class GltfRewriter {
 public:
  /// Plans the file. Keeps the new arrays in memory, and refers to the buffers of `gltf`.
  /// O(document + faces of the edits). Pre: each mesh occurs once, with groups as read_gltf_mesh
  /// makes them. Throws InputError if a buffer that is needed is missing, or a member of the
  /// document has the wrong type; Cancelled. `compresses`: the edited meshes by
  /// EXT_meshopt_compression, as `compress` describes.
  GltfRewriter(GltfFile& gltf, std::span<const GltfMeshEdit> edits, bool compresses = false,
               Progress* progress = nullptr);

  /// Returns what the file does not hold of the document, as phrases for the user.
  const std::vector<std::string>& losses() const { return losses_; }
  /// Writes the file. Does not commit. Throws OutputError; Cancelled.
  void write(AtomicFile& file, bool binary, Progress* progress = nullptr) const;

 private:
  using Json = nlohmann::json;
  /// The lists of a document whose unused elements are used again.
  struct Slots {
    std::vector<std::size_t> free;  ///< falling
    std::size_t take(Json& array);
  };

  void plan(std::span<const GltfMeshEdit> edits);
  void find_free_slots(std::span<const GltfMeshEdit> edits);
  void keep_data();
  void find_virtual_buffers();
  void keep_range(const Json& range);
  void embed_images();
  void embed(Json& image);
  void replace(const GltfMeshEdit& edit);
  std::vector<std::string> set_primitives(Json& primitives, const GltfLevel& level);
  void set_primitive(Json& primitive, GltfPrimitiveArrays&& arrays);
  std::uint64_t add_array(GltfArray&& array, std::optional<std::uint64_t> old, AttributeKind kind,
                          bool is_index = false);
  std::size_t add_view(std::string&& bytes);
  std::size_t add_compressed(CompressedArray&& array);
  void drop_extensions(Json& primitive);
  void find_nodes_of_meshes();
  void add_levels(const GltfMeshEdit& edit);
  void add_node_levels(std::size_t node, const GltfMeshEdit& edit,
                       const std::vector<std::size_t>& meshes);
  void animate_levels(std::size_t node, std::size_t at, const Json& levels);
  void clear_free_slots();
  void set_offsets();
  void set_extension_lists(bool has_levels);
  void note_missing(std::uint64_t mesh, const std::vector<std::string>& names);

  GltfFile& gltf_;
  Progress* progress_;
  Json document_;
  GltfData data_;
  std::vector<std::pair<std::size_t, std::size_t>> view_pieces_;  ///< view, piece
  std::vector<bool> is_new_view_;
  Slots accessors_;
  Slots views_;
  std::vector<std::uint64_t> virtual_buffers_;  ///< without data: fallbacks of compressed views
  bool compresses_;
  CompressedViews compressed_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> nodes_of_mesh_;
  std::set<std::string> dropped_extensions_;
  std::vector<std::string> losses_;
};

}  // namespace mesher::io
