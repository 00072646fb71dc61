#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/mesh/material.h"
#include "engine/mesh/wedges.h"
#include "engine/render/sources.h"
#include "tests/support/meshes.h"

namespace mesher::render {

/// A model for tests of looks.
struct PaintedModel {
  Mesh mesh;
  Attributes attributes;
  Materials materials;
  std::vector<Image> images;  ///< of the materials, decoded

  Sources sources() const {
    Sources sources;
    sources.appearance.attributes = &attributes;
    sources.appearance.materials = std::make_shared<const Materials>(materials);
    sources.appearance.decode = [this](std::span<const ImageRequest> requests,
                                       const TakeImage& take) {
      for (std::size_t i = 0; i < requests.size(); ++i) {
        const Image& image = images.at(requests[i].image);
        if (!image.rgba.empty()) take(i, image);
      }
    };
    return sources;
  }
};

/// Sets values by the position of the corners and their face.
template <class T, class Value>
void paint(PaintedModel& model, const AttributeType& type, Value&& value) {
  std::vector<T> values;
  for (std::uint32_t h = 0; h < model.mesh.halfedge_count(); ++h)
    values.push_back(value(model.mesh.position(model.mesh.origin(Halfedge(h))), h / 3));
  std::vector<AttributeLayer> layers;
  layers.emplace_back(type, std::span<const T>(values));
  set_corner_layers(model.mesh, model.attributes, std::move(layers));
}

/// Squares of side 2 that face the viewer, at these distances behind z = 0, each in a group and
/// with a material of its own. Texture coordinates reach from the upper left corner to the lower
/// right one.
inline PaintedModel quads(const std::vector<float>& depths) {
  Soup soup;
  for (const float depth : depths) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const glm::vec2 p : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      soup.positions.emplace_back(p, -depth);
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U})
      soup.corners.push_back(first + corner);
  }
  PaintedModel model;
  model.mesh = build_mesh(std::move(soup)).mesh;
  AttributeType type = texcoord_type();
  type.counts_down = true;
  paint<glm::vec2>(model, type, [](const glm::vec3& p, std::uint32_t /*face*/) {
    return glm::vec2(0.5F + 0.5F * p.x, 0.5F - 0.5F * p.y);
  });
  for (std::uint32_t i = 0; i < depths.size(); ++i) {
    Material material;
    material.metallic = 0.0F;
    model.materials.materials.push_back(material);
    FaceGroup group;
    group.material = i;
    model.attributes.groups.push_back(group);
  }
  for (std::uint32_t f = 0; f < model.mesh.face_count(); ++f) {
    const glm::vec3 p = model.mesh.position(model.mesh.origin(Halfedge(3 * f)));
    const auto at = std::find(depths.begin(), depths.end(), -p.z) - depths.begin();
    model.attributes.group.push_back(static_cast<std::uint32_t>(at));
  }
  return model;
}

using Rgba = std::array<std::uint8_t, 4>;

inline Image image_of(std::uint32_t width, const std::vector<Rgba>& pixels) {
  Image image{
      .width = width, .height = static_cast<std::uint32_t>(pixels.size()) / width, .rgba = {}};
  for (const Rgba& pixel : pixels)
    image.rgba.insert(image.rgba.end(), pixel.begin(), pixel.end());
  return image;
}

/// Adds an image, and returns a texture that shows its pixels.
inline Texture add_texture(PaintedModel& model, Image image) {
  Texture texture;
  texture.image = static_cast<std::uint32_t>(model.images.size());
  texture.magnifies_to_pixels = true;
  model.images.push_back(std::move(image));
  model.materials.images.emplace_back();
  return texture;
}

}  // namespace mesher::render
