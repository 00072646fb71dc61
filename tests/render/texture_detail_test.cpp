#include "engine/render/texture_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/offscreen.h"
#include "tests/render/painted_quads.h"
#include "tests/support/gpu_test.h"

namespace mesher::render {
namespace {

constexpr float kAll = std::numeric_limits<float>::infinity();
/// One class of densities, of which there are eight per factor of two.
constexpr double kClass = 1.0906;

/// Squares at these distances, each with a texture of its own as its base color.
PaintedModel textured_quads(const std::vector<float>& depths, const Image& image) {
  PaintedModel model = quads(depths);
  for (Material& material : model.materials.materials)
    material.base_color_texture = add_texture(model, image);
  return model;
}

PaintedModel textured_quad() {
  return textured_quads({0.0F}, image_of(1, {{255, 255, 255, 255}}));
}

std::vector<float> sides_of(const PaintedModel& model, const PictureView& picture) {
  std::vector<PackedMaterial> packed;
  std::vector<std::string> problems;
  const TexcoordSets sets = texcoord_sets(model.attributes);
  std::vector<bool> is_two_sided;
  std::vector<Material> all = model.materials.materials;
  all.push_back(plain_material());
  for (const Material& material : all) {
    packed.push_back(pack(material, sets, Look::material, problems));
    is_two_sided.push_back(material.is_two_sided);
  }
  return needed_sides(model.mesh, model.attributes, {packed, is_two_sided}, picture);
}

/// A picture that a square of side 2 fills from top to bottom.
PictureView filled_picture(std::uint32_t side) {
  PictureView picture{.camera = {}, .size = {2 * side, side}};
  picture.camera.set_orthographic(true);
  const double scale = picture.camera.places(picture.size).scale;
  picture.camera.zoom(0.5 * side / scale);
  return picture;
}

TEST(TextureDetail, IsOneTexelPerPixel) {
  for (const std::uint32_t side : {16U, 100U, 4000U}) {
    const float needed = sides_of(textured_quad(), filled_picture(side)).at(0);
    EXPECT_GE(needed, 0.999 * side);
    EXPECT_LE(needed, kClass * side);
  }
}

TEST(TextureDetail, RepeatedTexturesNeedLess) {
  PaintedModel model = textured_quad();
  Texture& texture = model.materials.materials[0].base_color_texture;
  texture.scale = {4.0F, 0.5F};
  texture.angle_rad = 0.3F;
  // The finer of both coordinates decides, where it is steepest.
  const double step = 4.0 * std::cos(0.3);
  EXPECT_NEAR(sides_of(model, filled_picture(256)).at(0), 256 / step, 0.1 * 256 / step);
}

TEST(TextureDetail, TexturesWithoutMipLevelsNeedAll) {
  PaintedModel model = textured_quad();
  model.materials.materials[0].base_color_texture.mipmaps = Mipmaps::none;
  EXPECT_EQ(sides_of(model, filled_picture(64)).at(0), kAll);
}

TEST(TextureDetail, OneColorOfATextureNeedsAll) {
  PaintedModel model = textured_quad();
  AttributeType type = texcoord_type();
  type.counts_down = true;
  paint<glm::vec2>(model, type, [](const glm::vec3&, std::uint32_t) { return glm::vec2(0.3F); });
  EXPECT_EQ(sides_of(model, filled_picture(64)).at(0), kAll);
}

TEST(TextureDetail, FacesAroundTheEyeNeedAllAndThoseBesideThePictureNothing) {
  PictureView picture{.camera = {}, .size = {100, 100}};
  picture.camera.zoom(3.0);  // to z = 1
  EXPECT_LT(sides_of(textured_quad(), picture).at(0), 400.0F);
  picture.camera.recenter({0.0, 0.0, -2.0});
  EXPECT_EQ(sides_of(textured_quad(), picture).at(0), kAll);
  PictureView aside = filled_picture(64);
  aside.camera.recenter({10.0, 0.0, 0.0});
  EXPECT_LE(sides_of(textured_quad(), aside).at(0), 1.0F);
}

/// Returns the texture coordinates of the square z = 0 under a pixel; none beside it.
std::optional<glm::dvec2> texcoord_at(const PictureView& picture, glm::dvec2 pixel) {
  const Ray ray = picture.camera.pick_ray({.position = pixel, .window = picture.size});
  const glm::dvec3 p = ray.origin - ray.origin.z / ray.direction.z * ray.direction;
  if (std::max(std::abs(p.x), std::abs(p.y)) > 1.0) return std::nullopt;
  return glm::dvec2(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y);
}

TEST(TextureDetail, BacksThatAreNotDrawnNeedNothing) {
  PaintedModel model = textured_quad();
  PictureView behind = filled_picture(64);
  behind.camera.set_angles(3.0, 0.0);
  EXPECT_LE(sides_of(model, behind).at(0), 1.0F);
  model.materials.materials[0].is_two_sided = true;
  EXPECT_GT(sides_of(model, behind).at(0), 32.0F);
}

TEST(TextureDetail, HoldsForEveryPixelInPerspective) {
  PaintedModel model = textured_quad();
  for (const auto& [yaw, pitch] : {std::pair{0.0, 0.0}, {1.2, 0.3}, {-0.4, 1.3}, {2.5, -0.9}}) {
    PictureView picture{.camera = {}, .size = {120, 90}};
    picture.camera.set_angles(yaw, pitch);
    picture.camera.zoom(1.4);
    model.materials.materials[0].is_two_sided = true;
    const double needed = sides_of(model, picture).at(0);
    int pixels = 0;
    int magnified = 0;
    for (double y = 0.5; y < 90; ++y) {
      for (double x = 0.5; x < 120; ++x) {
        const auto here = texcoord_at(picture, {x, y});
        const auto right = texcoord_at(picture, {x + 1, y});
        const auto below = texcoord_at(picture, {x, y + 1});
        if (!here || !right || !below) continue;
        const glm::dvec2 dx = glm::abs(*right - *here);
        const glm::dvec2 dy = glm::abs(*below - *here);
        const double texels = needed * std::max({dx.x, dx.y, dy.x, dy.y});
        ++pixels;
        if (texels < 0.999) ++magnified;
        EXPECT_GT(texels, 0.7) << yaw << ' ' << x << ' ' << y;
      }
    }
    EXPECT_GT(pixels, 100);
    EXPECT_LE(magnified, 0.01 * pixels);
  }
}

TEST(TextureDetail, NearestUseDecides) {
  PaintedModel model = textured_quads({0.0F, 5.0F}, image_of(1, {{255, 255, 255, 255}}));
  PictureView picture{.camera = {}, .size = {200, 200}};
  picture.camera.zoom(0.3);
  const std::vector<float> apart = sides_of(model, picture);
  EXPECT_GT(apart[0], 1.2F * apart[1]);
  for (Material& material : model.materials.materials)
    material.base_color_texture.image = 0;
  EXPECT_GE(sides_of(model, picture)[0], 0.999F * apart[0] / 1.4142F);
}

class TextureDetailPicture : public test::GpuTest {};

TEST_F(TextureDetailPicture, LooksTheSame) {
  std::vector<Rgba> pixels;
  for (std::uint32_t i = 0; i < 256 * 256; ++i) {
    const auto value = static_cast<std::uint8_t>(i / 16 % 2 == i / 4096 % 2 ? 250 : i % 251);
    pixels.push_back({value, static_cast<std::uint8_t>(i / 256), 90, 255});
  }
  PaintedModel model = textured_quads({0.0F}, image_of(256, pixels));
  model.materials.materials[0].base_color_texture.magnifies_to_pixels = false;
  Camera camera;
  camera.set_angles(0.3, 0.2);
  camera.zoom(0.7);
  Sources sources = model.sources();
  const auto picture = [&] {
    return render_image(device(), model.mesh, camera, {.look = Look::base_color}, 80, 60, sources);
  };
  const Image full = picture();
  sources.appearance.picture = PictureView{.camera = camera, .size = {80, 60}};
  float needed = kAll;
  sources.appearance.decode = [&, decode = sources.appearance.decode](
                                  std::span<const ImageRequest> requests, const TakeImage& take) {
    needed = requests.front().needed_side;
    decode(requests, take);
  };
  const Image coarse = picture();
  EXPECT_EQ(halvings(256, 256, needed), 2U);
  ASSERT_EQ(coarse.rgba.size(), full.rgba.size());
  for (std::size_t i = 0; i < full.rgba.size(); ++i)
    EXPECT_NEAR(coarse.rgba[i], full.rgba[i], 2) << i;
}

}  // namespace
}  // namespace mesher::render
