#include "engine/render/look.h"

#include <cmath>
#include <string>
#include <vector>

#include "engine/render/offscreen.h"
#include "tests/render/painted_quads.h"
#include "tests/support/gpu_test.h"

namespace mesher::render {
namespace {

constexpr std::uint32_t kSide = 96;
constexpr Rgba kRed{250, 20, 10, 255};
constexpr Rgba kGreen{3, 130, 77, 255};
constexpr Rgba kBlue{0, 64, 200, 255};
constexpr Rgba kGray{127, 128, 129, 255};

Settings look(Look look) {
  return {.look = look, .samples = 1};
}
const Settings kBaseColor = look(Look::base_color);
const Settings kMaterial = look(Look::material);

/// Looks at a square of side 2 that fills the image.
Camera front_camera() {
  Camera camera;
  camera.set_angles(0.0, 0.0);
  camera.set_orthographic(true);
  camera.frame({glm::vec3(-1.0F), glm::vec3(1.0F)}, 1.0);
  return camera;
}

class LookTest : public test::GpuTest {
 protected:
  Image draw(PaintedModel& model, const Settings& settings, const Camera& camera = front_camera()) {
    return render_image(device(), model.mesh, camera, settings, kSide, kSide, model.sources());
  }
};

/// Returns the pixel that shows a point of the square: 0 and 1 are the middles of its left and
/// right (upper and lower) half, or nearly so.
Rgba at(const Image& image, double x, double y) {
  const glm::dvec3 point(0.8 * (x - 0.5), 0.8 * (0.5 - y), 0.0);
  const glm::dvec2 place = front_camera().places({kSide, kSide}).of(point);
  const std::uint8_t* p =
      image.pixel(static_cast<std::uint32_t>(place.x), static_cast<std::uint32_t>(place.y));
  return {p[0], p[1], p[2], p[3]};
}
Rgba middle(const Image& image) {
  return at(image, 0.55, 0.6);
}

int brightness(const Rgba& pixel) {
  return pixel[0] + pixel[1] + pixel[2];
}

double light_of(int byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
int byte_of(double light) {
  const double c = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255.0 * c));
}

Rgba background() {
  const Color color = background_color(Background::light);
  Rgba pixel{0, 0, 0, 255};
  for (int i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>(std::lround(255.0F * color[i]));
  return pixel;
}

void expect_near(const Rgba& pixel, const Rgba& wanted, int most = 1) {
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(pixel[i], wanted[i], most) << "component " << i;
}

TEST_F(LookTest, BaseColorShowsTheBytesOfTheTexture) {
  PaintedModel model = quads({0.0F});
  model.materials.materials[0].base_color_texture =
      add_texture(model, image_of(2, {kRed, kGreen, kBlue, kGray}));
  const Image image = draw(model, kBaseColor);
  EXPECT_EQ(at(image, 0.0, 0.0), kRed);
  EXPECT_EQ(at(image, 1.0, 0.0), kGreen);
  EXPECT_EQ(at(image, 0.0, 1.0), kBlue);
  EXPECT_EQ(at(image, 1.0, 1.0), kGray);
  EXPECT_EQ(image.pixel(0, 0)[0], background()[0]);
}

TEST_F(LookTest, EveryByteOfAColorTextureComesOutUnchanged) {
  PaintedModel model = quads({0.0F});
  std::vector<Rgba> pixels;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    pixels.push_back({byte, byte, byte, 255});
  }
  model.materials.materials[0].base_color_texture = add_texture(model, image_of(16, pixels));
  const Image image = draw(model, kBaseColor);
  for (std::uint32_t row = 0; row < 16; ++row) {
    for (std::uint32_t column = 0; column < 16; ++column) {
      const Rgba pixel =
          at(image, 2.5 * (column + 0.5) / 16.0 - 0.75, 2.5 * (row + 0.5) / 16.0 - 0.75);
      EXPECT_EQ(pixel[0], 16 * row + column);
    }
  }
}

TEST_F(LookTest, BaseColorMultipliesFactorTextureAndVertexColorInLinearLight) {
  PaintedModel model = quads({0.0F});
  Material& material = model.materials.materials[0];
  material.base_color = {0.5F, 1.0F, 0.25F, 1.0F};
  material.base_color_texture = add_texture(model, image_of(1, {kGray}));
  paint<glm::u8vec4>(model, color_type(),
                     [](auto&&...) { return glm::u8vec4(255, 188, 255, 255); });
  const double gray = light_of(127);
  const Rgba wanted{static_cast<std::uint8_t>(byte_of(0.5 * gray)),
                    static_cast<std::uint8_t>(byte_of(light_of(128) * light_of(188))),
                    static_cast<std::uint8_t>(byte_of(0.25 * light_of(129))), 255};
  expect_near(middle(draw(model, kBaseColor)), wanted);
}

TEST_F(LookTest, VertexColorsAloneShowTheirBytes) {
  PaintedModel model = quads({0.0F});
  model.attributes.group.clear();
  model.attributes.groups.clear();
  model.materials = {};
  paint<glm::u8vec4>(model, color_type(), [](auto&&...) { return glm::u8vec4(200, 90, 13, 255); });
  expect_near(middle(draw(model, kBaseColor)), {200, 90, 13, 255});
  EXPECT_EQ(drawn_look({}, &model.attributes, nullptr), Look::material);
}

TEST_F(LookTest, LinearVertexColorsAreEncoded) {
  PaintedModel model = quads({0.0F});
  AttributeType type = color_type();
  type.is_linear = true;
  paint<glm::u8vec4>(model, type, [](auto&&...) { return glm::u8vec4(51, 128, 255, 255); });
  expect_near(middle(draw(model, kBaseColor)),
              {static_cast<std::uint8_t>(byte_of(51 / 255.0)),
               static_cast<std::uint8_t>(byte_of(128 / 255.0)), 255, 255});
}

TEST_F(LookTest, TexturesThatCountUpAreFlipped) {
  PaintedModel model = quads({0.0F});
  model.materials.materials[0].base_color_texture =
      add_texture(model, image_of(2, {kRed, kGreen, kBlue, kGray}));
  paint<glm::vec2>(model, texcoord_type(), [](const glm::vec3& p, std::uint32_t /*face*/) {
    return glm::vec2(0.5F + 0.5F * p.x, 0.5F + 0.5F * p.y);
  });
  const Image image = draw(model, kBaseColor);
  EXPECT_EQ(at(image, 0.0, 0.0), kRed);
  EXPECT_EQ(at(image, 1.0, 1.0), kGray);
  EXPECT_EQ(at(image, 0.0, 1.0), kBlue);
}

TEST_F(LookTest, TransformsTextureCoordinates) {
  PaintedModel model = quads({0.0F});
  Texture& texture = model.materials.materials[0].base_color_texture;
  texture = add_texture(model, image_of(2, {kRed, kGreen, kBlue, kGray}));
  texture.offset = {0.5F, 0.0F};
  Image image = draw(model, kBaseColor);
  EXPECT_EQ(at(image, 0.0, 0.0), kGreen);
  EXPECT_EQ(at(image, 1.0, 0.0), kRed);
  // A quarter turn: u' = v, v' = -u.
  texture.offset = {0.0F, 0.0F};
  texture.angle_rad = 1.5707963F;
  image = draw(model, kBaseColor);
  EXPECT_EQ(at(image, 0.0, 0.0), kBlue);
  EXPECT_EQ(at(image, 1.0, 0.0), kRed);
  EXPECT_EQ(at(image, 0.0, 1.0), kGray);
}

TEST_F(LookTest, WrapsAsTheSamplerSays) {
  PaintedModel model = quads({0.0F});
  Texture& texture = model.materials.materials[0].base_color_texture;
  texture = add_texture(model, image_of(2, {kRed, kGreen}));
  texture.scale = {2.0F, 1.0F};
  texture.offset = {1.0F, 0.0F};
  const auto colors = [&] {
    const Image image = draw(model, kBaseColor);
    return std::vector<Rgba>{at(image, -0.6, 0.5), at(image, 0.3, 0.5), at(image, 0.7, 0.5),
                             at(image, 1.6, 0.5)};
  };
  EXPECT_EQ(colors(), (std::vector<Rgba>{kRed, kGreen, kRed, kGreen}));
  texture.wrap_u = Wrap::mirrored_repeat;
  EXPECT_EQ(colors(), (std::vector<Rgba>{kGreen, kRed, kRed, kGreen}));
  texture.wrap_u = Wrap::clamp;
  EXPECT_EQ(colors(), (std::vector<Rgba>{kGreen, kGreen, kGreen, kGreen}));
}

TEST_F(LookTest, MasksCutHoles) {
  PaintedModel model = quads({0.0F});
  Material& material = model.materials.materials[0];
  material.base_color_texture =
      add_texture(model, image_of(2, {{250, 20, 10, 127}, {3, 130, 77, 129}}));
  for (const Settings& settings : {kBaseColor, kMaterial}) {
    material.alpha = AlphaMode::mask;
    Image image = draw(model, settings);
    expect_near(at(image, 0.0, 0.5), background(), 0);
    EXPECT_LT(at(image, 1.0, 0.5)[0], 100);
    material.alpha = AlphaMode::opaque;
    image = draw(model, settings);
    EXPECT_GT(at(image, 0.0, 0.5)[0], at(image, 0.0, 0.5)[1] + 100);
    EXPECT_EQ(at(image, 0.0, 0.5)[3], 255);
  }
}

TEST_F(LookTest, BlendsWithWhatIsBehindInLinearLight) {
  // The far square is listed last, and the nearest one blends too.
  PaintedModel model = quads({0.0F, 0.5F, 1.0F});
  const auto set = [&](std::uint32_t i, const glm::vec4& color, AlphaMode alpha) {
    model.materials.materials[i].base_color = color;
    model.materials.materials[i].alpha = alpha;
  };
  set(0, {1, 0, 0, 0.25F}, AlphaMode::blend);
  set(1, {0, 1, 0, 0.5F}, AlphaMode::blend);
  set(2, {0, 0, 1, 1}, AlphaMode::opaque);
  const Rgba wanted{static_cast<std::uint8_t>(byte_of(0.25)),
                    static_cast<std::uint8_t>(byte_of(0.75 * 0.5)),
                    static_cast<std::uint8_t>(byte_of(0.75 * 0.5)), 255};
  expect_near(middle(draw(model, kBaseColor)), wanted);
}

TEST_F(LookTest, BacksAreShownOfTwoSidedMaterialsOnly) {
  PaintedModel model = quads({0.0F});
  model.materials.materials[0].base_color = {1, 0, 0, 1};
  Camera behind = front_camera();
  behind.set_angles(3.14159265, 0.0);
  for (const Settings& settings : {kBaseColor, kMaterial}) {
    model.materials.materials[0].is_two_sided = false;
    expect_near(middle(draw(model, settings, behind)), background(), 0);
    EXPECT_GT(middle(draw(model, settings))[0], 100);
    model.materials.materials[0].is_two_sided = true;
    const Rgba back = middle(draw(model, settings, behind));
    EXPECT_GT(back[0], 100);
    EXPECT_LT(back[1], 100);
  }
}

TEST_F(LookTest, BlendingShowsTheFarSideOfATwoSidedSurface) {
  PaintedModel model;
  model.mesh = build_mesh(test::cube()).mesh;
  Material glass;
  glass.base_color = {0.0F, 0.0F, 0.0F, 0.5F};
  glass.alpha = AlphaMode::blend;
  model.materials.materials = {glass};
  FaceGroup group;
  group.material = 0;
  model.attributes.groups = {group};
  model.attributes.group.assign(model.mesh.face_count(), 0);
  const double behind = light_of(background()[0]);
  EXPECT_NEAR(middle(draw(model, kBaseColor))[0], byte_of(0.5 * behind), 1);
  model.materials.materials[0].is_two_sided = true;
  EXPECT_NEAR(middle(draw(model, kBaseColor))[0], byte_of(0.25 * behind), 1);
}

TEST_F(LookTest, NormalMapsTurnTheSurface) {
  PaintedModel model = quads({0.0F});
  Material& material = model.materials.materials[0];
  const auto lit = [&](const Rgba& normal) {
    material.normal_texture = add_texture(model, image_of(1, {normal}));
    return brightness(middle(draw(model, kMaterial)));
  };
  // The key light is at the upper left.
  const int flat = lit({128, 128, 255, 255});
  const int left = lit({60, 128, 220, 255});
  const int right = lit({196, 128, 220, 255});
  const int up = lit({128, 196, 220, 255});
  const int down = lit({128, 60, 220, 255});
  EXPECT_GT(left, right + 30);
  EXPECT_GT(up, down + 30);
  EXPECT_GT(flat, right);
  // Tangents of the file agree with those of the texture coordinates.
  const AttributeType type{AttributeKind::tangent, "TANGENT", 4, ComponentType::f32};
  paint<glm::vec4>(model, type, [](auto&&...) { return glm::vec4(1, 0, 0, 1); });
  EXPECT_NEAR(lit({60, 128, 220, 255}), left, 3);
  EXPECT_NEAR(lit({128, 60, 220, 255}), down, 3);
  paint<glm::vec4>(model, type, [](auto&&...) { return glm::vec4(1, 0, 0, -1); });
  EXPECT_NEAR(lit({128, 60, 220, 255}), up, 3);
}

TEST_F(LookTest, RoughnessMetalOcclusionAndEmissionCount) {
  PaintedModel model = quads({0.0F});
  Material& material = model.materials.materials[0];
  material.base_color = {0.4F, 0.4F, 0.4F, 1.0F};
  const int plain = brightness(middle(draw(model, kMaterial)));
  material.occlusion_texture = add_texture(model, image_of(1, {{64, 255, 255, 255}}));
  EXPECT_LT(brightness(middle(draw(model, kMaterial))), plain - 30);
  material.occlusion_texture.strength = 0.0F;
  EXPECT_EQ(brightness(middle(draw(model, kMaterial))), plain);
  material.occlusion_texture = {};
  material.emission = {0.0F, 0.5F, 0.0F};
  material.emission_texture = add_texture(model, image_of(1, {kGray}));
  const Rgba glowing = middle(draw(model, kMaterial));
  EXPECT_GT(glowing[1], glowing[0] + 15);
  material.emission = {0.0F, 0.0F, 0.0F};
  material.metallic = 1.0F;
  material.metallic_roughness_texture = add_texture(model, image_of(1, {{0, 255, 255, 255}}));
  const Rgba rough = middle(draw(model, kMaterial));
  material.metallic_roughness_texture = add_texture(model, image_of(1, {{0, 10, 255, 255}}));
  const Rgba smooth = middle(draw(model, kMaterial));
  EXPECT_GT(std::abs(brightness(rough) - brightness(smooth)), 10);
}

TEST_F(LookTest, UnlitMaterialsAreTheirBaseColor) {
  PaintedModel model = quads({0.0F});
  Material& material = model.materials.materials[0];
  material.is_unlit = true;
  material.emission = {1.0F, 1.0F, 1.0F};
  material.base_color_texture = add_texture(model, image_of(1, {kGreen}));
  EXPECT_EQ(middle(draw(model, kMaterial)), kGreen);
}

TEST_F(LookTest, NormalsAreColors) {
  PaintedModel model = quads({0.0F});
  expect_near(middle(draw(model, look(Look::normals))), {128, 128, 255, 255});
  paint<glm::vec3>(model, normal_type(), [](auto&&...) { return glm::vec3(0.6F, 0.0F, 0.8F); });
  expect_near(middle(draw(model, look(Look::normals))), {204, 128, 230, 255});
  // Whatever the view is.
  Camera camera = front_camera();
  camera.set_angles(0.3, 0.2);
  expect_near(middle(draw(model, look(Look::normals), camera)), {204, 128, 230, 255});
}

TEST_F(LookTest, CheckerHasEightSquaresPerUnit) {
  PaintedModel model = quads({0.0F});
  const Image image = draw(model, look(Look::uv_checker));
  std::size_t changes = 0;
  const auto is_dark = [&](std::uint32_t x) { return image.pixel(x, kSide / 2 + 2)[2] < 130; };
  for (std::uint32_t x = 1; x < kSide; ++x)
    changes += is_dark(x) != is_dark(x - 1) ? 1 : 0;
  EXPECT_GE(changes, 7U);
  EXPECT_LE(changes, 9U);
  PaintedModel bare;
  bare.mesh = build_mesh(test::cube()).mesh;
  EXPECT_EQ(drawn_look(look(Look::uv_checker), &bare.attributes, nullptr), Look::clay);
}

TEST_F(LookTest, SeamsHaveTheirOwnTextureCoordinates) {
  PaintedModel model = quads({0.0F});
  model.materials.materials[0].base_color_texture = add_texture(model, image_of(2, {kRed, kGreen}));
  AttributeType type = texcoord_type();
  paint<glm::vec2>(model, type, [](const glm::vec3& /*p*/, std::uint32_t face) {
    return glm::vec2(face == 0 ? 0.25F : 0.75F, 0.5F);
  });
  ASSERT_TRUE(model.attributes.has_seams());
  const Image image = draw(model, kBaseColor);
  EXPECT_EQ(at(image, 0.9, 0.6), kRed);
  EXPECT_EQ(at(image, 0.1, 0.4), kGreen);
}

TEST_F(LookTest, ComponentsOfAnyTypeAreRead) {
  PaintedModel model = quads({0.0F});
  model.materials.materials[0].base_color_texture =
      add_texture(model, image_of(2, {kRed, kGreen, kBlue, kGray}));
  const Image wanted = draw(model, kBaseColor);
  const auto value = [](const glm::vec3& p, double most) {
    return glm::dvec2(most * (0.5 + 0.5 * double(p.x)), most * (0.5 - 0.5 * double(p.y)));
  };
  AttributeType type = texcoord_type();
  type.counts_down = true;
  type.is_normalized = true;
  type.component = ComponentType::u8;
  paint<glm::u8vec2>(model, type, [&](const glm::vec3& p, auto) { return value(p, 255.0); });
  EXPECT_EQ(draw(model, kBaseColor).rgba, wanted.rgba);
  type.component = ComponentType::u16;
  paint<glm::u16vec2>(model, type, [&](const glm::vec3& p, auto) { return value(p, 65535.0); });
  EXPECT_EQ(draw(model, kBaseColor).rgba, wanted.rgba);
  type.component = ComponentType::s16;
  paint<glm::i16vec2>(model, type, [&](const glm::vec3& p, auto) { return value(p, 32767.0); });
  EXPECT_EQ(draw(model, kBaseColor).rgba, wanted.rgba);
}

TEST_F(LookTest, ClayIsTheSameWithAndWithoutMaterials) {
  PaintedModel model = quads({0.0F, 0.7F});
  paint<glm::vec3>(model, normal_type(), [](auto&&...) { return glm::vec3(0.6F, 0.0F, 0.8F); });
  const Settings clay{.look = Look::clay};
  const Image bare = render_image(device(), model.mesh, front_camera(), {}, kSide, kSide);
  EXPECT_EQ(draw(model, clay).rgba, bare.rgba);
  PaintedModel plain;
  plain.mesh = model.mesh;
  EXPECT_EQ(draw(plain, {}).rgba, bare.rgba) << "there are no materials";
}

TEST_F(LookTest, WireframeIsDrawnOnAllLooks) {
  PaintedModel model = quads({0.0F});
  for (const Look which : {Look::material, Look::base_color, Look::normals, Look::uv_checker}) {
    Settings settings = look(which);
    const Image plain = draw(model, settings);
    settings.wireframe = true;
    const Image wired = draw(model, settings);
    std::size_t darker = 0;
    for (std::size_t i = 0; i < plain.rgba.size(); i += 4)
      darker += wired.rgba[i + 2] + 20 < plain.rgba[i + 2] ? 1 : 0;
    EXPECT_GT(darker, kSide / 2) << key(which);
    EXPECT_EQ(at(wired, 0.3, 0.9), at(plain, 0.3, 0.9)) << key(which);
  }
}

TEST_F(LookTest, SlicesGiveTheSameBytes) {
  PaintedModel model = quads({0.0F, 0.5F, 1.0F, 1.5F});
  for (std::uint32_t i = 0; i < 3; ++i) {
    model.materials.materials[i].base_color = glm::vec4(0.2F * float(i), 0.8F, 0.3F, 0.5F);
    model.materials.materials[i].alpha = AlphaMode::blend;
  }
  const Image whole = draw(model, kMaterial);
  GpuMesh mirror(device());
  mirror.apply(model.mesh, kMaterial, model.sources());
  Renderer renderer(device());
  const SceneTarget target(device(), {kSide, kSide}, 1);
  for (std::uint64_t begin = 0; begin < Renderer::work(mirror, kMaterial); ++begin) {
    device().run_once([&](VkCommandBuffer commands) {
      renderer.draw_slice(commands, target, mirror, front_camera(), kMaterial, {begin, begin + 1});
    });
  }
  EXPECT_EQ(gpu::read_image(device(), target.color(), gpu::kTransferSource).rgba, whole.rgba);
}

TEST_F(LookTest, EditsWithoutAttributesUploadNothingMore) {
  const auto bytes_of_edit = [&](const Sources& sources) {
    Mesh mesh = build_mesh(test::torus(20, 12)).mesh;
    GpuMesh mirror(device());
    mirror.apply(mesh, {}, sources);
    mesh.set_position(Vertex(7), glm::vec3(0.1F, 0.2F, 0.3F));
    return mirror.apply(mesh, {}, sources).uploaded_bytes;
  };
  const Attributes none;
  Sources sources;
  sources.appearance.attributes = &none;
  EXPECT_GT(bytes_of_edit({}), 0U);
  EXPECT_EQ(bytes_of_edit(sources), bytes_of_edit({}));
}

TEST_F(LookTest, EditsUploadTheChangedAttributes) {
  PaintedModel model = quads({0.0F});
  paint<glm::u8vec4>(model, color_type(), [](auto&&...) { return glm::u8vec4(200, 90, 13, 255); });
  GpuMesh mirror(device());
  const Sources sources = model.sources();
  mirror.apply(model.mesh, kBaseColor, sources);
  EXPECT_EQ(mirror.apply(model.mesh, kBaseColor, sources).uploaded_bytes, 0U);
  model.mesh.set_position(Vertex(0), model.mesh.position(Vertex(0)));
  paint<glm::u8vec4>(model, color_type(), [](auto&&...) { return glm::u8vec4(1, 2, 3, 255); });
  EXPECT_GT(mirror.apply(model.mesh, kBaseColor, sources).uploaded_bytes, 16U);
  Renderer renderer(device());
  expect_near(
      middle(render_image(device(), renderer, mirror, front_camera(), kBaseColor, kSide, kSide)),
      {1, 2, 3, 255});
}

TEST_F(LookTest, ImagesThatCannotBeDecodedAreWhite) {
  PaintedModel model = quads({0.0F});
  model.materials.materials[0].base_color = {1.0F, 0.0F, 0.0F, 1.0F};
  model.materials.materials[0].base_color_texture = add_texture(model, {});
  expect_near(middle(draw(model, kBaseColor)), {255, 0, 0, 255}, 0);
}

}  // namespace
}  // namespace mesher::render
