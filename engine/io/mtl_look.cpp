#include "engine/io/mtl_look.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <set>

namespace mesher::io {
namespace {

/// The transfer function of sRGB (IEC 61966-2-1) and its inverse.
double linear_from_srgb(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
double srgb_from_linear(double l) {
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
}

glm::vec3 linear_color(const glm::vec3& color) {
  glm::vec3 linear;
  for (int i = 0; i < 3; ++i)
    linear[i] = static_cast<float>(linear_from_srgb(std::max(0.0F, color[i])));
  return linear;
}

/// A file may say any exponent; more than this is a mirror.
constexpr double kLargestExponent = 1e6;

float roughness_from(float exponent) {
  const double n = std::clamp(static_cast<double>(exponent), 0.0, kLargestExponent);
  return static_cast<float>(std::pow(2.0 / (n + 2.0), 0.25));
}

double exponent_from(float roughness) {
  const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
  return std::clamp(2.0 / std::max(alpha * alpha, 1e-9) - 2.0, 0.0, kLargestExponent);
}

/// Six digits: colors come back from sRGB as they went.
std::string mtl_text(double value) {
  char text[32];
  const int length = std::snprintf(text, sizeof text, "%.6g", value);
  return {text, static_cast<std::size_t>(length)};
}

std::string color_statement(const char* keyword, const glm::vec3& linear) {
  std::string line = keyword;
  for (int i = 0; i < 3; ++i)
    line += " " + mtl_text(srgb_from_linear(std::max(0.0F, linear[i])));
  return line;
}

/// The offset of a transform whose v counts from the other end of the image. The same both ways.
glm::vec2 turned_offset(const glm::vec2& offset, const glm::vec2& scale) {
  return {offset.x, 1.0F - scale.y - offset.y};
}

std::string map_statement(std::string keyword, const Texture& texture, const std::string& file) {
  const glm::vec2 offset = turned_offset(texture.offset, texture.scale);
  const auto add = [&](const char* option, const glm::vec2& v) {
    keyword += std::string(option) + mtl_text(v.x) + " " + mtl_text(v.y) + " " +
               (option[2] == 's' ? "1" : "0");
  };
  if (texture.scale != glm::vec2(1.0F)) add(" -s ", texture.scale);
  if (offset != glm::vec2(0.0F)) add(" -o ", offset);
  if (texture.wrap_u == Wrap::clamp && texture.wrap_v == Wrap::clamp) keyword += " -clamp on";
  // A name that begins with a hyphen would be an option.
  return keyword + " " + (file.starts_with('-') ? "./" : "") + file;
}

/// Statements that have no counterpart in glTF, and how messages name them.
struct Untranslated {
  std::string_view keyword;
  std::string_view name;
};
constexpr Untranslated kUntranslated[] = {
    {"ka", "ambient color"},
    {"ks", "specular color"},
    {"ni", "index of refraction"},
    {"tf", "transmission filter"},
    {"sharpness", "sharpness of reflections"},
    {"map_ka", "ambient map"},
    {"map_ks", "specular map"},
    {"map_ns", "map of the specular exponent"},
    {"map_tr", "transparency map"},
    {"map_bump", "bump map"},
    {"bump", "bump map"},
    {"disp", "displacement map"},
    {"decal", "decal"},
    {"refl", "reflection map"},
    {"map_aat", "anti-aliasing of textures"},
    {"ps", "sheen"},
    {"map_ps", "sheen map"},
    {"pc", "clearcoat"},
    {"pcr", "clearcoat roughness"},
    {"aniso", "anisotropy"},
    {"anisor", "rotation of anisotropy"},
};
constexpr std::string_view kTranslated[] = {"kd", "ke", "ns",     "d",      "tr",
                                            "pr", "pm", "map_kd", "map_ke", "norm"};

/// The maps that have a counterpart only together with others.
struct JointMaps {
  std::string_view color, opacity, roughness, metallic;
  char roughness_channel = '\0';
  char metallic_channel = '\0';

  bool has_gltf_surface() const {
    return !roughness.empty() && roughness == metallic && roughness_channel == 'g' &&
           metallic_channel == 'b';
  }
};

JointMaps joint_maps(const Material& material) {
  JointMaps maps;
  for (const std::string& line : *material.mtl_statements) {
    const MtlStatement statement = split_mtl(line);
    if (!is_mtl_map(statement.keyword)) continue;
    const MtlMap map = parse_mtl_map(statement);
    if (statement.keyword == "map_kd") maps.color = map.file;
    if (statement.keyword == "map_d") maps.opacity = map.file;
    if (statement.keyword == "map_pr") {
      maps.roughness = map.file;
      maps.roughness_channel = map.channel;
    } else if (statement.keyword == "map_pm") {
      maps.metallic = map.file;
      maps.metallic_channel = map.channel;
    }
  }
  return maps;
}

/// Returns how a message names the loss of a statement; empty if nothing is lost.
std::string lost_by(const MtlStatement& statement, const JointMaps& maps) {
  const std::string& keyword = statement.keyword;
  if (keyword.empty() || keyword.starts_with('#')) return {};
  if (is_mtl_map(keyword) && parse_mtl_map(statement).has_others) return "options of maps";
  if (keyword == "map_d") return maps.opacity == maps.color ? "" : "opacity map";
  if (keyword == "map_pr") return maps.has_gltf_surface() ? "" : "roughness map";
  if (keyword == "map_pm") return maps.has_gltf_surface() ? "" : "metallic map";
  if (keyword == "illum") {
    return mtl_number(statement.rest).value_or(2.0F) <= 2.0F ? "" : "illumination model";
  }
  const bool is_color = keyword == "kd" || keyword == "ke";
  if (is_color && !mtl_color(statement.rest)) return "spectral color";
  if (std::ranges::find(kTranslated, keyword) != std::end(kTranslated)) return {};
  const auto* found = std::ranges::find(kUntranslated, keyword, &Untranslated::keyword);
  return found != std::end(kUntranslated) ? std::string(found->name) : keyword;
}

}  // namespace

bool MtlLook::add(std::string_view line) {
  const MtlStatement statement = split_mtl(line);
  const std::string& keyword = statement.keyword;
  if (is_mtl_map(keyword)) return add_map(statement);
  const auto color = [&](std::optional<glm::vec3>& to) {
    // Curves of a spectrum and other color spaces are known, but have no counterpart.
    if (statement.rest.starts_with("spectral") || statement.rest.starts_with("xyz")) return true;
    const std::optional<glm::vec3> value = mtl_color(statement.rest);
    if (value) to = value;
    return value.has_value();
  };
  const auto number = [&](std::optional<float>& to) {
    const std::optional<float> value = mtl_number(statement.rest);
    if (value) to = value;
    return value.has_value();
  };
  if (keyword == "kd") return color(diffuse_);
  if (keyword == "ks") return color(specular_);
  if (keyword == "ke") return color(emission_);
  if (keyword == "ns") return number(exponent_);
  if (keyword == "pr") return number(roughness_);
  if (keyword == "pm") return number(metallic_);
  std::optional<glm::vec3> ambient;
  if (keyword == "ka") return color(ambient);
  std::optional<float> other;
  if (keyword == "ni") return number(other);
  if (keyword == "illum") {
    if (!number(other)) return false;
    illumination_ = static_cast<int>(std::clamp(*other, 0.0F, 100.0F));
  }
  if (keyword == "tr") {
    if (!number(other)) return false;
    opacity_ = 1.0F - *other;
  }
  if (keyword == "d") {
    std::string_view rest = statement.rest;
    // `-halo` lets the opacity depend on the angle of view.
    if (rest.starts_with("-halo")) next_word(rest);
    other = mtl_number(rest);
    if (!other) return false;
    opacity_ = other;
  }
  return true;
}

bool MtlLook::add_map(const MtlStatement& statement) {
  const MtlMap map = parse_mtl_map(statement);
  if (map.file.empty()) return false;
  const Texture found = texture(map, statement.keyword == "norm");
  if (statement.keyword == "map_kd") diffuse_map_ = found;
  if (statement.keyword == "map_ke") emission_map_ = found;
  if (statement.keyword == "map_d") opacity_map_ = found;
  if (statement.keyword == "norm") normal_map_ = found;
  if (statement.keyword == "map_pr") {
    roughness_map_ = found;
    roughness_channel_ = map.channel;
  } else if (statement.keyword == "map_pm") {
    metallic_map_ = found;
    metallic_channel_ = map.channel;
  }
  return !map.is_malformed;
}

Texture MtlLook::texture(const MtlMap& map, bool is_normal_map) const {
  Texture texture{.image = image_of_(map.file), .offset = turned_offset(map.offset, map.scale)};
  texture.scale = map.scale;
  texture.strength = is_normal_map ? map.strength : 1.0F;
  if (map.clamps) texture.wrap_u = texture.wrap_v = Wrap::clamp;
  return texture;
}

void MtlLook::finish(Material& material) const {
  const float opacity = std::clamp(opacity_.value_or(1.0F), 0.0F, 1.0F);
  const glm::vec3 color = diffuse_ ? linear_color(*diffuse_) : glm::vec3(1.0F);
  material.base_color = glm::vec4(glm::min(color, 1.0F), opacity);
  material.base_color_texture = diffuse_map_;
  const bool is_alpha_used = opacity_map_.is_there() && opacity_map_.image == diffuse_map_.image;
  if (opacity < 1.0F || is_alpha_used) material.alpha = AlphaMode::blend;
  material.emission_texture = emission_map_;
  if (emission_) material.emission = linear_color(*emission_);
  if (!emission_ && emission_map_.is_there()) material.emission = glm::vec3(1.0F);
  material.normal_texture = normal_map_;
  material.is_unlit = illumination_ == 0;
  const bool shines = illumination_ != 1 && !(specular_ && *specular_ == glm::vec3(0.0F));
  material.roughness = exponent_ && shines ? roughness_from(*exponent_) : 1.0F;
  if (roughness_) material.roughness = std::clamp(*roughness_, 0.0F, 1.0F);
  material.metallic = std::clamp(metallic_.value_or(0.0F), 0.0F, 1.0F);
  const bool is_gltf_surface = roughness_map_.is_there() &&
                               roughness_map_.image == metallic_map_.image &&
                               roughness_channel_ == 'g' && metallic_channel_ == 'b';
  if (is_gltf_surface) material.metallic_roughness_texture = roughness_map_;
}

std::vector<std::string> mtl_statements(const Material& material,
                                        const std::vector<std::string>& files) {
  std::vector<std::string> lines;
  const auto add_map_of = [&](const std::string& keyword, const Texture& texture) {
    if (!fits_mtl(texture) || files[texture.image].empty()) return;
    lines.push_back(map_statement(keyword, texture, files[texture.image]));
  };
  lines.push_back(color_statement("Kd", material.base_color));
  if (material.emission != glm::vec3(0.0F))
    lines.push_back(color_statement("Ke", material.emission));
  lines.push_back("Ns " + mtl_text(exponent_from(material.roughness)));
  lines.push_back("Pr " + mtl_text(material.roughness));
  lines.push_back("Pm " + mtl_text(material.metallic));
  if (material.alpha != AlphaMode::opaque) lines.push_back("d " + mtl_text(material.base_color.a));
  lines.emplace_back(material.is_unlit ? "illum 0" : "illum 2");
  add_map_of("map_Kd", material.base_color_texture);
  if (material.alpha != AlphaMode::opaque) add_map_of("map_d", material.base_color_texture);
  add_map_of("map_Ke", material.emission_texture);
  add_map_of("map_Pr -imfchan g", material.metallic_roughness_texture);
  add_map_of("map_Pm -imfchan b", material.metallic_roughness_texture);
  const float strength = material.normal_texture.strength;
  add_map_of(strength == 1.0F ? "norm" : "norm -bm " + mtl_text(strength), material.normal_texture);
  return lines;
}

bool fits_mtl(const Texture& texture) {
  return texture.is_there() && texture.set == 0;
}

std::vector<std::string> lost_in_gltf(const Material& material) {
  if (!material.mtl_statements) return {};
  const JointMaps maps = joint_maps(material);
  std::set<std::string> lost;
  for (const std::string& line : *material.mtl_statements) {
    const std::string name = lost_by(split_mtl(line), maps);
    if (!name.empty()) lost.insert(name);
  }
  return {lost.begin(), lost.end()};
}

std::vector<std::string> lost_in_mtl(const Material& material) {
  if (material.mtl_statements || material.is_name_only) return {};
  std::set<std::string> lost;
  if (material.is_two_sided) lost.insert("two-sidedness");
  if (material.alpha == AlphaMode::mask) lost.insert("alpha cutoff");
  if (material.occlusion_texture.is_there()) lost.insert("occlusion texture");
  for (const Texture* texture : {&material.base_color_texture, &material.metallic_roughness_texture,
                                 &material.normal_texture, &material.emission_texture}) {
    if (!texture->is_there()) continue;
    if (!fits_mtl(*texture)) lost.insert("texture with another UV set");
    if (texture->angle_rad != 0.0F) lost.insert("rotation of textures");
    const bool is_mirrored =
        texture->wrap_u == Wrap::mirrored_repeat || texture->wrap_v == Wrap::mirrored_repeat;
    if (is_mirrored || texture->wrap_u != texture->wrap_v) lost.insert("wrapping of textures");
    if (texture->magnifies_to_pixels || texture->minifies_to_pixels ||
        texture->mipmaps != Mipmaps::blended)
      lost.insert("unfiltered texture");
  }
  return {lost.begin(), lost.end()};
}

}  // namespace mesher::io
