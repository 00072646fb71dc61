

#include "engine/io/gltf_materials.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/gltf_types.h"
#include "engine/io/image_files.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

/// Bytes that embedded images may take per byte of the file. Views may overlap, and each image has
/// a copy.
constexpr std::uint64_t kMostImageBytesPerByte = 2;

/// Access to a document that counts members of the wrong type as absent.
const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

/// Returns the length of a top-level array; 0 if there is none.
std::size_t length_of(const GltfFile& gltf, const char* array) {
  const Json* list = member(gltf.root(), array);
  return list == nullptr || !list->is_array() ? 0 : list->size();
}

double number_of(const Json& object, const char* key, double fallback) {
  const Json* value = member(object, key);
  if (value == nullptr || !value->is_number()) return fallback;
  const double number = value->get<double>();
  return std::isfinite(number) ? number : fallback;
}

float fraction_of(const Json& object, const char* key, double fallback) {
  return static_cast<float>(std::clamp(number_of(object, key, fallback), 0.0, 1.0));
}

std::uint32_t index_of(const Json& object, const char* key, std::uint32_t fallback) {
  const Json* value = member(object, key);
  if (value == nullptr || !value->is_number_unsigned()) return fallback;
  const auto index = value->get<std::uint64_t>();
  return index < kNone ? static_cast<std::uint32_t>(index) : fallback;
}

std::string text_of(const Json& object, const char* key) {
  const Json* value = member(object, key);
  return value == nullptr || !value->is_string()
             ? std::string()
             : value->get_ref<const std::string&>().substr(0, kMaxNameBytes);
}

bool is_true(const Json& object, const char* key) {
  const Json* value = member(object, key);
  return value != nullptr && *value == true;
}

template <class Vector>
Vector vector_of(const Json& object, const char* key, Vector fallback) {
  const Json* list = member(object, key);
  if (list == nullptr || !list->is_array() ||
      list->size() != static_cast<std::size_t>(Vector::length()))
    return fallback;
  for (int i = 0; i < Vector::length(); ++i) {
    const Json& value = (*list)[static_cast<std::size_t>(i)];
    if (value.is_number() && std::isfinite(value.get<float>())) fallback[i] = value.get<float>();
  }
  return fallback;
}

const Json* extension_of(const Json& object, const char* name) {
  const Json* extensions = member(object, "extensions");
  return extensions == nullptr ? nullptr : member(*extensions, name);
}

Wrap wrap_of(const Json& sampler, const char* key) {
  switch (index_of(sampler, key, 10497)) {
    case 33071:
      return Wrap::clamp;
    case 33648:
      return Wrap::mirrored_repeat;
    default:
      return Wrap::repeat;
  }
}

class MaterialReader {
 public:
  MaterialReader(GltfFile& gltf, FileContents& contents)
      : gltf_(gltf), contents_(contents), files_(contents) {}

  std::shared_ptr<const Materials> run() {
    const std::size_t count = std::min(length_of(gltf_, "materials"), kMostGltfMaterials);
    if (count == 0) return nullptr;
    for (std::size_t i = 0; i < count; ++i)
      result_.materials.push_back(material(gltf_.root()["materials"][i]));
    result_.texture_count = static_cast<std::uint32_t>(textures_.size());
    return std::make_shared<const Materials>(std::move(result_));
  }

 private:
  Material material(const Json& json) {
    Material material;
    material.name = text_of(json, "name");
    read_surface(json, material);
    material.normal_texture = texture(json, "normalTexture", "scale");
    material.occlusion_texture = texture(json, "occlusionTexture", "strength");
    material.emission_texture = texture(json, "emissiveTexture");
    material.emission = glm::clamp(vector_of(json, "emissiveFactor", glm::vec3(0.0F)), 0.0F, 1.0F);
    if (const Json* strength = extension_of(json, "KHR_materials_emissive_strength")) {
      material.emission *=
          static_cast<float>(std::max(0.0, number_of(*strength, "emissiveStrength", 1.0)));
    }
    const std::string mode = text_of(json, "alphaMode");
    if (mode == "MASK") material.alpha = AlphaMode::mask;
    if (mode == "BLEND") material.alpha = AlphaMode::blend;
    material.alpha_cutoff = static_cast<float>(std::max(0.0, number_of(json, "alphaCutoff", 0.5)));
    material.is_two_sided = is_true(json, "doubleSided");
    material.is_unlit = extension_of(json, "KHR_materials_unlit") != nullptr;
    return material;
  }

  void read_surface(const Json& json, Material& material) {
    const Json* const surface = member(json, "pbrMetallicRoughness");
    if (surface == nullptr) return;
    material.base_color =
        glm::clamp(vector_of(*surface, "baseColorFactor", glm::vec4(1.0F)), 0.0F, 1.0F);
    material.base_color_texture = texture(*surface, "baseColorTexture");
    material.metallic = fraction_of(*surface, "metallicFactor", 1.0);
    material.roughness = fraction_of(*surface, "roughnessFactor", 1.0);
    material.metallic_roughness_texture = texture(*surface, "metallicRoughnessTexture");
  }

  /// Reads a texture of a material. `strength_key` is its own factor, or null.
  Texture texture(const Json& object, const char* key, const char* strength_key = nullptr) {
    const Json* const info = member(object, key);
    if (info == nullptr) return {};
    const std::uint32_t index = index_of(*info, "index", kNone);
    if (index >= length_of(gltf_, "textures")) return {};
    const Json& json = gltf_.root()["textures"][index];
    Texture texture;
    texture.image = image(source_of(json));
    if (!texture.is_there()) return {};
    textures_.insert(index);
    texture.set = index_of(*info, "texCoord", 0);
    if (strength_key != nullptr)
      texture.strength = static_cast<float>(number_of(*info, strength_key, 1.0));
    if (const Json* transform = extension_of(*info, "KHR_texture_transform")) {
      texture.set = index_of(*transform, "texCoord", texture.set);
      texture.offset = vector_of(*transform, "offset", texture.offset);
      texture.scale = vector_of(*transform, "scale", texture.scale);
      texture.angle_rad = static_cast<float>(number_of(*transform, "rotation", 0.0));
    }
    read_sampler(index_of(json, "sampler", kNone), texture);
    return texture;
  }

  void read_sampler(std::uint32_t index, Texture& texture) {
    constexpr std::uint32_t kNearest = 9728;
    if (index >= length_of(gltf_, "samplers")) return;
    const Json& sampler = gltf_.root()["samplers"][index];
    texture.wrap_u = wrap_of(sampler, "wrapS");
    texture.wrap_v = wrap_of(sampler, "wrapT");
    texture.magnifies_to_pixels = index_of(sampler, "magFilter", 0) == kNearest;
    const GltfMinFilter minification = min_filter(index_of(sampler, "minFilter", 0));
    texture.minifies_to_pixels = minification.is_nearest;
    texture.mipmaps = minification.mipmaps;
  }

  static std::uint32_t source_of(const Json& texture) {
    const auto extended = [&](const char* name) {
      const Json* extension = extension_of(texture, name);
      return extension == nullptr ? kNone : index_of(*extension, "source", kNone);
    };
    for (const std::uint32_t source :
         {extended("EXT_texture_webp"), index_of(texture, "source", kNone),
          extended("KHR_texture_basisu"), extended("MSFT_texture_dds")}) {
      if (source != kNone) return source;
    }
    return kNone;
  }

  /// Returns the index in the result of an image of the document, which is read on first use.
  std::uint32_t image(std::uint32_t index) {
    if (index >= length_of(gltf_, "images")) return kNone;
    const auto [known, is_new] =
        images_.try_emplace(index, static_cast<std::uint32_t>(result_.images.size()));
    if (!is_new) return known->second;
    const Json& json = gltf_.root()["images"][index];
    EncodedImage image{.name = text_of(json, "name"), .mime_type = text_of(json, "mimeType")};
    const std::string label = image.name.empty() ? std::to_string(index) : image.name;
    try {
      read_bytes(json, label, image);
    } catch (const InputChanged&) {
      throw;
    } catch (const InputError& error) {
      contents_.warn("texture " + label + ": " + error.reason());
    }
    result_.images.push_back(std::move(image));
    return known->second;
  }

  void read_bytes(const Json& json, const std::string& label, EncodedImage& image) {
    const Json* const uri_json = member(json, "uri");
    if (uri_json == nullptr || !uri_json->is_string()) {
      return keep(gltf_.plain_view(index_of(json, "bufferView", kNone)), image);
    }
    const std::string_view uri = uri_json->get_ref<const std::string&>();
    if (uri.starts_with("data:")) {
      return keep(gltf_.resource(uri), image);
    }
    const Beside found = find_uri_beside(gltf_.folder(), uri);
    image.path = found.file.empty() ? std::filesystem::path(uri) : found.relative;
    files_.load(image, found, uri.empty() ? std::string_view(label) : uri);
  }

  void keep(std::string_view bytes, EncodedImage& image) {
    const std::uint64_t most = kMostImageBytesPerByte * gltf_.byte_count();
    if (bytes.size() > most - std::min(most, embedded_bytes_)) {
      gltf_.fail("its images are too long for the size of the file");
    }
    embedded_bytes_ += bytes.size();
    image.bytes = std::make_shared<const std::string>(bytes);
    const std::string_view type = image_type(bytes);
    if (!type.empty()) image.mime_type = type;
  }

  GltfFile& gltf_;
  FileContents& contents_;
  ImageFiles files_;
  Materials result_;
  std::set<std::uint32_t> textures_;  ///< of the document, that the materials use
  std::unordered_map<std::uint32_t, std::uint32_t> images_;
  std::uint64_t embedded_bytes_ = 0;
};

}  // namespace

std::shared_ptr<const Materials> read_gltf_materials(GltfFile& gltf, FileContents& contents) {
  return MaterialReader(gltf, contents).run();
}

}  // namespace mesher::io
