#include "engine/io/format.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "engine/io/extension.h"
#include "engine/io/gltf_model.h"
#include "engine/io/gltf_read.h"
#include "engine/io/obj_read.h"
#include "engine/io/obj_write.h"
#include "engine/io/off_read.h"
#include "engine/io/ply_read.h"
#include "engine/io/polygon_write.h"
#include "engine/io/stl_read.h"

namespace mesher::io {
namespace {

constexpr FormatContents kGltfContents{.materials = HoldsMaterials::as_gltf,
                                       .any_attribute = true,
                                       .far_positions = true,
                                       .texcoord = Holds::all_or_none,
                                       .normal = Holds::all_or_none,
                                       .color = Holds::each_corner};

GltfWriteOptions gltf_options(const WriteOptions& options, bool binary) {
  return {.binary = binary,
          .compresses = options.compresses,
          .origin = options.origin,
          .materials = options.materials.get(),
          .progress = options.progress};
}

constexpr FormatInfo kFormats[] = {
    {.name = "Wavefront OBJ",
     .extension = ".obj",
     .holds = {.creases = true,
               .groups = true,
               .materials = HoldsMaterials::as_mtl,
               .far_positions = true,
               .texcoord = Holds::each_corner,
               .normal = Holds::each_corner,
               .color = Holds::one_per_vertex},
     .read_weight = 0.65,
     .read = [](const MappedFile& file, const ReadOptions& o) { return read_obj(file, o); },
     .write = [](AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& o) { write_obj(file, mesh, attributes, o); }},
    {.name = "Stanford PLY",
     .extension = ".ply",
     .holds = {.materials = HoldsMaterials::color_textures,
               .far_positions = true,
               .texcoord = Holds::each_corner,
               .normal = Holds::one_per_vertex,
               .color = Holds::one_per_vertex},
     .read_weight = 0.3,  // binary 0.15, text 0.6
     .read = [](const MappedFile& file,
                const ReadOptions& o) { return read_ply(file, o.progress); },
     .write = [](AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& o) { write_ply(file, mesh, attributes, o); }},
    {.name = "STL",
     .extension = ".stl",
     .read_weight = 5.0,
     .join_part = 0.9,
     .read = [](const MappedFile& file,
                const ReadOptions& o) { return read_stl(file, o.progress); },
     .write = [](AtomicFile& file, const Mesh& mesh, const Attributes&,
                 const WriteOptions& o) { write_stl(file, mesh, o.origin, o.ascii, o.progress); }},
    {.name = "OFF",
     .extension = ".off",
     .holds = {.far_positions = true, .color = Holds::one_per_vertex},
     .read_weight = 0.8,
     .read = [](const MappedFile& file,
                const ReadOptions& o) { return read_off(file, o.progress); },
     .write =
         [](AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
            const WriteOptions& o) { write_off(file, mesh, attributes, o.origin, o.progress); }},
    {.name = "glTF",
     .extension = ".gltf",
     .holds = kGltfContents,
     .read_weight = 2.8,
     .joins_itself = true,
     .has_animations = true,
     .read = [](const MappedFile& file, const ReadOptions& o) { return read_gltf(file, o); },
     .write =
         [](AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
            const WriteOptions& o) { write_gltf(file, mesh, attributes, gltf_options(o, false)); },
     .write_levels =
         [](AtomicFile& file, std::span<const GltfLevel> levels, const WriteOptions& o) {
           write_gltf(file, levels, gltf_options(o, false));
         },
     .read_scene = read_gltf_model,
     .write_scene =
         [](AtomicFile& file, const Shape& shape, const scene::Scene& scene, Progress* progress) {
           return write_gltf_model(file, shape, scene, false, progress);
         }},
    {.name = "binary glTF",
     .extension = ".glb",
     .holds = kGltfContents,
     .read_weight = 0.45,
     .joins_itself = true,
     .has_animations = true,
     .read = [](const MappedFile& file, const ReadOptions& o) { return read_gltf(file, o); },
     .write =
         [](AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
            const WriteOptions& o) { write_gltf(file, mesh, attributes, gltf_options(o, true)); },
     .write_levels = [](AtomicFile& file, std::span<const GltfLevel> levels,
                        const WriteOptions& o) { write_gltf(file, levels, gltf_options(o, true)); },
     .read_scene = read_gltf_model,
     .write_scene =
         [](AtomicFile& file, const Shape& shape, const scene::Scene& scene, Progress* progress) {
           return write_gltf_model(file, shape, scene, true, progress);
         }},
    {.name = "progressive mesh",
     .extension = ".pm",
     .holds = {.creases = true,
               .groups = true,
               .materials = HoldsMaterials::as_gltf,
               .any_attribute = true,
               .texcoord = Holds::each_corner,
               .normal = Holds::each_corner,
               .color = Holds::each_corner}},
};

/// Returns the words as "a, b or c".
std::string list_of(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 == words.size() ? " or " : ", ";
    list += words[i];
  }
  return list;
}

}  // namespace

std::span<const FormatInfo> formats() {
  return kFormats;
}

const FormatInfo* format_of(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  const auto found = std::ranges::find_if(
      kFormats, [&](const FormatInfo& format) { return extension == format.extension; });
  return found == std::end(kFormats) ? nullptr : &*found;
}

HoldsMaterials held_materials(const FormatInfo& format, const std::filesystem::path& file) {
  const HoldsMaterials holds = format.holds.materials;
  const bool needs_files = holds != HoldsMaterials::as_gltf;
  return needs_files && is_open_file(file) ? HoldsMaterials::nothing : holds;
}

std::string readable_formats() {
  std::vector<std::string> words;
  for (const FormatInfo& format : kFormats)
    words.emplace_back(format.extension + 1);
  return list_of(words);
}

std::string writable_formats() {
  std::vector<std::string> words;
  for (const FormatInfo& format : kFormats) {
    if (format.write != nullptr) words.emplace_back(format.extension + 1);
  }
  return list_of(words);
}

}  // namespace mesher::io
