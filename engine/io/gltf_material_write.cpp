
#include "engine/io/gltf_material_write.h"
#include <algorithm>
#include <glm/common.hpp>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <tuple>
#include "engine/io/gltf_types.h"

namespace mesher::io {
namespace {

using MaterialJson = nlohmann::ordered_json;

/// The images of glTF, and the extension of a texture that refers to one; null: none is needed.
struct EmbeddableType {
  std::string_view mime_type;
  const char* extension;
};
constexpr EmbeddableType kEmbeddable[] = {
    {"image/png", nullptr},
    {"image/jpeg", nullptr},
    {"image/webp", "EXT_texture_webp"},
    {"image/ktx2", "KHR_texture_basisu"},
    {"image/vnd-ms.dds", "MSFT_texture_dds"},
};

const EmbeddableType* type_of(const EncodedImage& image) {
  const auto* found = std::ranges::find(kEmbeddable, image.mime_type, &EmbeddableType::mime_type);
  return found == std::end(kEmbeddable) ? nullptr : found;
}

template <class Vector>
MaterialJson json_of(const Vector& v) {
  MaterialJson list = MaterialJson::array();
  for (int i = 0; i < Vector::length(); ++i)
    list.push_back(v[i]);
  return list;
}

int wrap_number(Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp:
      return 33071;
    case Wrap::mirrored_repeat:
      return 33648;
    case Wrap::repeat:
      break;
  }
  return 10497;
}

class MaterialsWriter {
 public:
  MaterialsWriter(MaterialJson& document, const Materials& materials, std::uint32_t uv_sets,
                  const std::function<std::size_t(const std::string&)>& add_bytes)
      : document_(document), materials_(materials), uv_sets_(uv_sets), add_bytes_(add_bytes) {}

  void run() {
    // Put together apart, because textures add members to the document.
    MaterialJson list = MaterialJson::array();
    for (const Material& material : materials_.materials)
      list.push_back(json_of_material(material));
    document_["materials"] = std::move(list);
    for (const std::string& name : extensions_)
      document_["extensionsUsed"].push_back(name);
    for (const std::string& name : required_)
      document_["extensionsRequired"].push_back(name);
  }

 private:
  MaterialJson json_of_material(const Material& material) {
    MaterialJson json = MaterialJson::object();
    if (!material.name.empty()) json["name"] = material.name;
    json["pbrMetallicRoughness"] = surface(material);
    add_texture(json, "normalTexture", material.normal_texture, "scale");
    add_texture(json, "occlusionTexture", material.occlusion_texture, "strength");
    add_texture(json, "emissiveTexture", material.emission_texture);
    add_emission(json, material.emission);
    if (material.alpha == AlphaMode::mask) {
      json["alphaMode"] = "MASK";
      json["alphaCutoff"] = material.alpha_cutoff;
    }
    if (material.alpha == AlphaMode::blend) json["alphaMode"] = "BLEND";
    if (material.is_two_sided) json["doubleSided"] = true;
    if (material.is_unlit) {
      json["extensions"]["KHR_materials_unlit"] = MaterialJson::object();
      extensions_.insert("KHR_materials_unlit");
    }
    return json;
  }

  MaterialJson surface(const Material& material) {
    MaterialJson json = MaterialJson::object();
    json["baseColorFactor"] = json_of(material.base_color);
    add_texture(json, "baseColorTexture", material.base_color_texture);
    json["metallicFactor"] = material.metallic;
    json["roughnessFactor"] = material.roughness;
    add_texture(json, "metallicRoughnessTexture", material.metallic_roughness_texture);
    return json;
  }

  /// Factors above 1 need an extension.
  void add_emission(MaterialJson& json, const glm::vec3& emission) {
    const float strength = std::max({emission.r, emission.g, emission.b, 1.0F});
    if (emission == glm::vec3(0.0F)) return;
    json["emissiveFactor"] = json_of(emission / strength);
    if (strength == 1.0F) return;
    json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    extensions_.insert("KHR_materials_emissive_strength");
  }

  void add_texture(MaterialJson& json, const char* key, const Texture& texture,
                   const char* strength_key = nullptr) {
    if (!texture.is_there() || !can_embed(materials_.images[texture.image])) return;
    if (texture.set >= uv_sets_) return;
    MaterialJson info{{"index", texture_index(texture)}};
    if (texture.set != 0) info["texCoord"] = texture.set;
    if (strength_key != nullptr && texture.strength != 1.0F) info[strength_key] = texture.strength;
    MaterialJson transform = MaterialJson::object();
    if (texture.offset != glm::vec2(0.0F)) transform["offset"] = json_of(texture.offset);
    if (texture.scale != glm::vec2(1.0F)) transform["scale"] = json_of(texture.scale);
    if (texture.angle_rad != 0.0F) transform["rotation"] = texture.angle_rad;
    if (!transform.empty()) {
      info["extensions"]["KHR_texture_transform"] = std::move(transform);
      extensions_.insert("KHR_texture_transform");
    }
    json[key] = std::move(info);
  }

  std::size_t texture_index(const Texture& texture) {
    const std::size_t image = image_index(texture.image);
    const std::size_t sampler = sampler_index(texture);
    const auto [entry, is_new] =
        textures_.try_emplace({image, sampler}, document_["textures"].size());
    if (!is_new) return entry->second;
    MaterialJson json{{"sampler", sampler}};
    const char* const extension = type_of(materials_.images[texture.image])->extension;
    if (extension == nullptr) {
      json["source"] = image;
    } else {
      json["extensions"][extension]["source"] = image;
      extensions_.insert(extension);
      required_.insert(extension);  // there is no other image to fall back to
    }
    document_["textures"].push_back(std::move(json));
    return entry->second;
  }

  std::size_t image_index(std::uint32_t index) {
    const auto [entry, is_new] = images_.try_emplace(index, document_["images"].size());
    if (!is_new) return entry->second;
    const EncodedImage& image = materials_.images[index];
    MaterialJson json{{"bufferView", add_bytes_(*image.bytes)}, {"mimeType", image.mime_type}};
    const std::string name = image.name.empty() ? image.path.stem().string() : image.name;
    if (!name.empty()) json["name"] = name;
    document_["images"].push_back(std::move(json));
    return entry->second;
  }

  std::size_t sampler_index(const Texture& texture) {
    const SamplerKey key{texture.wrap_u, texture.wrap_v, texture.magnifies_to_pixels,
                         texture.minifies_to_pixels, texture.mipmaps};
    const auto [entry, is_new] = samplers_.try_emplace(key, document_["samplers"].size());
    if (!is_new) return entry->second;
    constexpr int kNearest = 9728;
    constexpr int kLinear = 9729;
    document_["samplers"].push_back(
        {{"magFilter", texture.magnifies_to_pixels ? kNearest : kLinear},
         {"minFilter", min_filter_number({texture.minifies_to_pixels, texture.mipmaps})},
         {"wrapS", wrap_number(texture.wrap_u)},
         {"wrapT", wrap_number(texture.wrap_v)}});
    return entry->second;
  }

  using SamplerKey = std::tuple<Wrap, Wrap, bool, bool, Mipmaps>;

  MaterialJson& document_;
  const Materials& materials_;
  std::uint32_t uv_sets_;
  const std::function<std::size_t(const std::string&)>& add_bytes_;
  std::map<std::uint32_t, std::size_t> images_;
  std::map<SamplerKey, std::size_t> samplers_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> textures_;
  std::set<std::string> extensions_, required_;
};

}  // namespace

bool can_embed(const EncodedImage& image) {
  return image.bytes && !image.bytes->empty() && type_of(image) != nullptr;
}

void add_gltf_materials(nlohmann::ordered_json& document, const Materials& materials,
                        std::uint32_t uv_sets,
                        const std::function<std::size_t(const std::string&)>& add_bytes) {
  MaterialsWriter(document, materials, uv_sets, add_bytes).run();
}

}  // namespace mesher::io
