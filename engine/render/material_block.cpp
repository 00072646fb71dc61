#include "engine/render/material_block.h"

#include <algorithm>
#include <cmath>

namespace mesher::render {
namespace {

constexpr std::uint32_t kNoSlot = 2;

VkSamplerAddressMode address_mode(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case Wrap::mirrored_repeat:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case Wrap::clamp:
      break;
  }
  return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

gpu::SamplerOptions sampler_of(const Texture& texture) {
  return {.wrap_u = address_mode(texture.wrap_u),
          .wrap_v = address_mode(texture.wrap_v),
          .magnifies_to_pixels = texture.magnifies_to_pixels,
          .minifies_to_pixels = texture.minifies_to_pixels,
          .has_mipmaps = texture.mipmaps != Mipmaps::none,
          .blends_mipmaps = texture.mipmaps == Mipmaps::blended};
}

/// Returns the transform of a texture's coordinates, from those of the mesh. Images have v = 0 at
/// the top.
shared::TextureUse transform_of(const Texture& texture, bool counts_down) {
  const float c = std::cos(texture.angle_rad);
  const float s = std::sin(texture.angle_rad);
  const glm::vec2 u = texture.scale.x * glm::vec2(c, -s);
  const glm::vec2 v = texture.scale.y * glm::vec2(s, c);
  if (counts_down) return {.matrix = {u, v}, .offset = texture.offset};
  return {.matrix = {u, -v}, .offset = texture.offset + v};
}

/// Gives a material's sets of texture coordinates the two slots of the vertex shader.
class Slots {
 public:
  explicit Slots(const TexcoordSets& sets) : sets_(sets) {}

  /// Returns the slot of a set; kNoSlot if there is none.
  std::uint32_t slot(std::uint32_t set) {
    if (set >= shared::kTexcoordSets || !sets_.exists[set]) return kNoSlot;
    const auto found = std::find(used_.begin(), used_.end(), set);
    if (found != used_.end()) return static_cast<std::uint32_t>(found - used_.begin());
    if (used_.size() == kNoSlot) return kNoSlot;
    used_.push_back(set);
    return static_cast<std::uint32_t>(used_.size() - 1);
  }
  std::uint32_t packed() const {
    return (used_.empty() ? 0 : used_[0]) | (used_.size() < 2 ? 0 : used_[1] << 8U);
  }

 private:
  const TexcoordSets& sets_;
  std::vector<std::uint32_t> used_;
};

struct NamedTexture {
  const Texture& texture;
  bool is_srgb;
  const char* name;
};

std::array<NamedTexture, shared::kTextureCount> textures_of(const Material& m) {
  return {{{m.base_color_texture, true, "base color"},
           {m.metallic_roughness_texture, false, "metallic-roughness"},
           {m.normal_texture, false, "normal"},
           {m.occlusion_texture, false, "occlusion"},
           {m.emission_texture, true, "emission"}}};
}

bool is_shown(std::uint32_t binding, Look look, const Material& material) {
  if (look == Look::base_color || (look == Look::material && material.is_unlit))
    return binding == shared::kBaseColorTexture;
  return look == Look::material;
}

std::uint32_t flags_of(const Material& material) {
  return (material.alpha == AlphaMode::mask ? shared::kMasksAlpha : 0) |
         (material.alpha == AlphaMode::blend ? shared::kBlendsAlpha : 0) |
         (material.is_unlit ? shared::kIsUnlit : 0);
}

}  // namespace

TexcoordSets texcoord_sets(const Attributes& attributes) {
  TexcoordSets sets;
  for (std::uint32_t i = 0; i < shared::kTexcoordSets; ++i) {
    const AttributeLayer* layer = attributes.find(texcoord_type(i).name);
    if (layer == nullptr) continue;
    sets.exists[i] = true;
    sets.counts_down[i] = layer->type().counts_down;
  }
  return sets;
}

PackedMaterial pack(const Material& material, const TexcoordSets& sets, Look look,
                    std::vector<std::string>& problems) {
  PackedMaterial packed;
  Slots slots(sets);
  const auto textures = textures_of(material);
  for (std::uint32_t binding = 0; binding < shared::kTextureCount; ++binding) {
    const auto& [texture, is_srgb, name] = textures[binding];
    shared::TextureUse& use = packed.block.textures[binding];
    use.slot = kNoSlot;
    if (!texture.is_there() || !is_shown(binding, look, material)) continue;
    const std::uint32_t slot = slots.slot(texture.set);
    if (slot == kNoSlot) {
      problems.push_back("material '" + material.name + "': its " + name +
                         " texture is not drawn, because texture coordinates " +
                         std::to_string(texture.set) + " are missing or one set too many");
      continue;
    }
    use = transform_of(texture, sets.counts_down[texture.set]);
    use.slot = slot;
    use.strength = texture.strength;
    packed.textures[binding] = {texture.image, is_srgb};
    packed.samplers[binding] = sampler_of(texture);
  }
  packed.block.base_color = material.base_color;
  packed.block.emission = material.emission;
  packed.block.metallic = material.metallic;
  packed.block.roughness = material.roughness;
  packed.block.alpha_cutoff = material.alpha_cutoff;
  packed.block.flags = flags_of(material);
  packed.block.sets = slots.packed();
  return packed;
}

Material plain_material() {
  Material plain;
  plain.metallic = 0.0F;
  plain.roughness = 0.7F;
  plain.is_two_sided = true;
  return plain;
}

}  // namespace mesher::render
