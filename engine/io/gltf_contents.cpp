#include "engine/io/gltf_contents.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "engine/io/gltf_types.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

bool starts_with_any(std::string_view name, std::initializer_list<std::string_view> starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return name.starts_with(start); });
}

const Json* array_of(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() || !found->is_array() ? nullptr : &*found;
}

class ContentsNoter {
 public:
  ContentsNoter(const GltfFile& gltf, FileContents& contents) : gltf_(gltf), contents_(contents) {}

  void run() {
    const Json& root = gltf_.root();
    count_names("materials", Content::materials);
    count_names("textures", Content::textures);
    count_names("skins", Content::skins);
    count_names("animations", Content::animations);
    count_names("cameras", Content::cameras);
    if (const Json* lights = gltf_.extension(root, "KHR_lights_punctual")) {
      const Json* list = array_of(*lights, "lights");
      contents_[Content::lights] += list == nullptr ? 0 : list->size();
    }
    if (const Json* variants = gltf_.extension(root, "KHR_materials_variants")) {
      const Json* list = array_of(*variants, "variants");
      contents_[Content::variants] += list == nullptr ? 0 : list->size();
    }
    note_nodes();
    note_meshes();
    note_extensions();
    note_extras();
  }

 private:
  void count_names(const char* key, Content kind) {
    const Json* list = array_of(gltf_.root(), key);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
      contents_.add(kind, name_of((*list)[i]));
  }

  static std::string_view name_of(const Json& object) {
    if (!object.is_object()) return {};
    const auto name = object.find("name");
    if (name == object.end() || !name->is_string()) return {};
    return name->get_ref<const std::string&>();
  }

  /// A single node without name or transform adds nothing to its mesh.
  void note_nodes() {
    const Json* nodes = array_of(gltf_.root(), "nodes");
    if (nodes == nullptr) return;
    const auto is_plain = [](const Json& node) {
      return node.is_object() && name_of(node).empty() && !node.contains("matrix") &&
             !node.contains("rotation") && !node.contains("scale");
    };
    if (nodes->size() == 1 && is_plain(nodes->front())) return;
    for (const Json& node : *nodes)
      contents_.add(Content::nodes, name_of(node));
  }

  void note_meshes() {
    const Json* meshes = array_of(gltf_.root(), "meshes");
    if (meshes == nullptr) return;
    for (const Json& mesh : *meshes) {
      if (!name_of(mesh).empty()) contents_.add(Content::objects, name_of(mesh));
      const Json* primitives = array_of(mesh, "primitives");
      std::size_t targets = 0;
      for (std::size_t i = 0; primitives != nullptr && i < primitives->size(); ++i)
        targets = std::max(targets, note_primitive((*primitives)[i]));
      contents_[Content::morph_targets] += targets;
    }
    for (const std::string& name : own_attributes_)
      contents_.add(Content::own_properties, name);
  }

  /// Returns the number of morph targets.
  std::size_t note_primitive(const Json& primitive) {
    if (!primitive.is_object()) return 0;
    const auto attributes = primitive.find("attributes");
    if (attributes != primitive.end() && attributes->is_object()) note_attributes(*attributes);
    const auto mode = primitive.find("mode");
    const std::uint64_t kind =
        mode != primitive.end() && mode->is_number_unsigned() ? mode->get<std::uint64_t>() : 4;
    const std::uint64_t elements = claimed_elements(gltf_, primitive);
    if (kind == 0) contents_[Content::points] += elements;
    if (kind == 1) contents_[Content::lines] += elements / 2;
    if (kind == 2) contents_[Content::lines] += elements;
    if (kind == 3) contents_[Content::lines] += elements > 0 ? elements - 1 : 0;
    const Json* targets = array_of(primitive, "targets");
    return targets == nullptr ? 0 : targets->size();
  }

  /// Does not judge the accessor.
  void note_type(const std::string& name, const Json& index) {
    const Json* accessors = array_of(gltf_.root(), "accessors");
    if (accessors == nullptr || !index.is_number_unsigned() || name == "POSITION") return;
    if (index.get<std::uint64_t>() >= accessors->size()) return;
    const Json& accessor = (*accessors)[index.get<std::uint64_t>()];
    if (!accessor.is_object() || !accessor.contains("componentType")) return;
    const Json& number = accessor["componentType"];
    const auto component =
        component_type(number.is_number_unsigned() ? number.get<std::uint64_t>() : 0);
    if (!component) return;
    AttributeType type{.name = FileContents::readable(name), .component = *component};
    for (std::size_t count = 1; count <= AttributeType::kMostComponents; ++count) {
      if (accessor.contains("type") && accessor["type"] == gltf_shape(count))
        type.components = static_cast<std::uint8_t>(count);
    }
    type.is_normalized = accessor.contains("normalized") && accessor["normalized"] == true;
    contents_.note_attribute(type_text(type));
  }

  void note_attributes(const Json& attributes) {
    std::size_t sets[4] = {};
    for (const auto& [name, accessor] : attributes.items()) {
      note_type(name, accessor);
      if (name == "NORMAL") contents_[Content::normals] = 1;
      if (name == "TANGENT") contents_[Content::tangents] = 1;
      sets[0] += name.starts_with("TEXCOORD_") ? 1U : 0U;
      sets[1] += name.starts_with("COLOR_") ? 1U : 0U;
      sets[2] += name.starts_with("JOINTS_") ? 1U : 0U;
      if (name.starts_with("_") && own_attributes_.size() < FileContents::kMostNames)
        own_attributes_.insert(name);
    }
    const auto raise = [&](Content kind, std::size_t count) {
      contents_[kind] = std::max<std::uint64_t>(contents_[kind], count);
    };
    raise(Content::uv_sets, sets[0]);
    raise(Content::color_sets, sets[1]);
    raise(Content::joint_sets, sets[2]);
  }

  void note_extensions() {
    const Json* used = array_of(gltf_.root(), "extensionsUsed");
    for (std::size_t i = 0; used != nullptr && i < used->size(); ++i) {
      if (!(*used)[i].is_string()) continue;
      const auto& name = (*used)[i].get_ref<const std::string&>();
      // These say how the shape is stored, and are read.
      const bool is_storage = name == "KHR_mesh_quantization" ||
                              name == "EXT_meshopt_compression" ||
                              name == "KHR_draco_mesh_compression";
      if (!is_storage) contents_.add(Content::extensions, name);
    }
  }

  void note_extras() {
    for (const auto& [key, value] : gltf_.root().items()) {
      if (key == "extras") ++contents_[Content::extras];
      if (value.is_object() && value.contains("extras")) ++contents_[Content::extras];
      if (!value.is_array()) continue;
      for (const Json& element : value) {
        if (!element.is_object()) continue;
        contents_[Content::extras] += element.contains("extras") ? 1 : 0;
        const Json* primitives = array_of(element, "primitives");
        for (std::size_t i = 0; primitives != nullptr && i < primitives->size(); ++i)
          contents_[Content::extras] += (*primitives)[i].contains("extras") ? 1 : 0;
      }
    }
  }

  const GltfFile& gltf_;
  FileContents& contents_;
  std::set<std::string> own_attributes_;
};

}  // namespace

bool is_shape_known(std::string_view name) {
  return starts_with_any(
      name, {"KHR_materials_", "ADOBE_materials_", "KHR_texture_", "KHR_lights_", "EXT_lights_",
             "EXT_texture_", "MSFT_texture_", "MSFT_packing_", "KHR_xmp", "MSFT_lod",
             "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
             "KHR_draco_mesh_compression", "KHR_animation_pointer"});
}

void check_required_extensions(const GltfFile& gltf) {
  const Json* required = array_of(gltf.root(), "extensionsRequired");
  if (required == nullptr) return;
  for (const Json& extension : *required) {
    if (!extension.is_string()) gltf.fail("extensionsRequired holds something that is not a name");
    const auto& name = extension.get_ref<const std::string&>();
    if (!is_shape_known(name)) {
      FileContents readable;  // replaces control characters and truncates
      constexpr std::size_t kMostShown = 64;
      readable.add(Content::extensions, std::string_view(name).substr(0, kMostShown));
      const auto& names = readable.names(Content::extensions);
      gltf.fail("requires the extension " + (names.empty() ? std::string("\"\"") : names.front()) +
                ", which mesher does not support");
    }
  }
}

std::uint64_t claimed_elements(const GltfFile& gltf, const Json& primitive) {
  auto accessor = primitive.find("indices");
  if (accessor == primitive.end()) {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object()) return 0;
    accessor = attributes->find("POSITION");
    if (accessor == attributes->end()) return 0;
  }
  const Json* accessors = array_of(gltf.root(), "accessors");
  if (accessors == nullptr || !accessor->is_number_unsigned()) return 0;
  const auto index = accessor->get<std::uint64_t>();
  if (index >= accessors->size() || !(*accessors)[index].is_object()) return 0;
  const auto count = (*accessors)[index].find("count");
  const bool is_count = count != (*accessors)[index].end() && count->is_number_unsigned();
  return is_count ? count->get<std::uint64_t>() : 0;
}

void note_contents(const GltfFile& gltf, FileContents& contents) {
  ContentsNoter(gltf, contents).run();
}

}  // namespace mesher::io
