// Writes and reads progressive meshes with attributes and compares them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>

#include "engine/core/parallel.h"
#include "engine/io/read.h"
#include "engine/mesh/model.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/layer_format.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/pm_read.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/progressive/charts.h"
#include "tests/progressive/checks.h"
#include "tests/progressive/codec/pm_files.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using progressive::Progressive;

Attributes with_groups(Attributes attributes, const Mesh& mesh, std::uint32_t every) {
  attributes.groups = named_groups({"left", "right", "unused"});
  attributes.groups[1].object = "head";
  attributes.groups[1].smoothing = "2";
  attributes.groups[0].material = 7;
  attributes.group.resize(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    attributes.group[f] = f / every % 2;
  return attributes;
}

/// Layers of every component type, some with values that are not numbers.
Attributes with_odd_layers(const Mesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  Attributes attributes;
  std::vector<AttributeLayer> layers;
  for (std::uint32_t k = 0; k < 6; ++k) {
    AttributeType type{.kind = static_cast<AttributeKind>(random() % 8),
                       .name = "_" + std::to_string(k),
                       .components = static_cast<std::uint8_t>(1 + random() % 4),
                       .component = static_cast<ComponentType>(k),
                       .is_normalized = random() % 2 == 0};
    AttributeLayer layer(type, mesh.halfedge_count());
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      const std::uint32_t v = mesh.origin(Halfedge(h)).index();
      for (std::byte& byte : layer.value(h))
        byte = static_cast<std::byte>(random() % 40 == 0 ? random() : v % 5 + h % 2);
    }
    layers.push_back(std::move(layer));
  }
  set_corner_layers(mesh, attributes, std::move(layers));
  return attributes;
}

void expect_exact(const Mesh& mesh, const Attributes& attributes, std::uint32_t faces = 1) {
  Progressive made = progressive::make_progressive(mesh, attributes, {.target_faces = faces});
  made.attributes.go_to(made.mesh.split_count() / 3);
  const Bytes bytes = written(made.mesh, made.attributes);
  EXPECT_EQ(made.attributes.level(), made.mesh.split_count() / 3);
  ReadBack read = read_back(bytes);
  ASSERT_EQ(read.error, "");
  ASSERT_EQ(read.damage, "");
  ASSERT_TRUE(read.is_complete);
  expect_same(made.mesh, read.mesh);
  ASSERT_EQ(read.attributes.split_count(), made.mesh.split_count());
  expect_same_attributes(made.mesh, made.attributes, read.attributes);
  if (testing::Test::HasFatalFailure()) return;
  for (const std::uint32_t level : some_levels(read.mesh, 6)) {
    read.mesh.go_to(level);
    read.attributes.go_to(level);
    expect_valid_level(read.mesh, read.attributes);
  }
  EXPECT_EQ(written(read.mesh, read.attributes), bytes);
}

TEST(PmAttributes, RoundTripIsExactWithAndWithoutSeams) {
  const Mesh mesh = built(torus(24, 16)).mesh;
  expect_exact(mesh, charted(mesh, [](std::uint32_t) { return 0; }));
  expect_exact(mesh, charted(mesh, [](std::uint32_t f) { return f / 256; }));
  expect_exact(mesh, charted(mesh, [](std::uint32_t f) { return f % 5; }));
  expect_exact(mesh, charted(mesh, [](std::uint32_t f) { return f; }));
  const Mesh flat = built(grid(16)).mesh;
  const Attributes halves = charted(flat, [](std::uint32_t f) { return f < 256 ? 0 : 1; });
  expect_exact(flat, halves);
  expect_exact(flat, with_groups(halves, flat, 100));
  expect_exact(flat, with_groups({}, flat, 3));
}

TEST(PmAttributes, RoundTripIsExactForRandomSeams) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = build_mesh(random_soup(seed)).mesh;
    std::mt19937 random(seed);
    std::vector<int> charts(mesh.face_count());
    for (int& chart : charts)
      chart = static_cast<int>(random() % (1 + seed % 4));
    expect_exact(mesh, charted(mesh, [&](std::uint32_t f) { return charts[f]; }));
    expect_exact(mesh, with_groups(with_odd_layers(mesh, seed), mesh, 2));
    ASSERT_FALSE(HasFailure());
  }
}

TEST(PmAttributes, RoundTripIsExactForMeshesOfAllKinds) {
  for (const auto& [name, mesh] : meshes_of_all_kinds()) {
    SCOPED_TRACE(name);
    if (mesh.face_count() == 0) continue;
    expect_exact(mesh, charted(mesh, [](std::uint32_t f) { return f / 40; }));
    expect_exact(mesh, with_odd_layers(mesh, 5), mesh.face_count());
    ASSERT_FALSE(HasFailure());
  }
}

/// Returns how far a value may be from the nearest on the grid of its layer, in one component.
double tolerance(const progressive::AttributeTable& table, std::size_t layer, std::size_t c) {
  const progressive::LayerFormat& format = table.layers[layer];
  constexpr double kFloatError = 1e-5;
  switch (format.rounding) {
    case progressive::Rounding::none:
      return 0.0;
    case progressive::Rounding::grid:
      return 0.5001 * format.step[c] + kFloatError;
    case progressive::Rounding::octahedral:
      break;
  }
  return 3.0 / (1U << (format.bits - 1));
}

void expect_rounded(Progressive& made, unsigned bits) {
  const progressive::AttributeRounding rounding;
  const auto table = progressive::make_table(made.attributes, &rounding);
  ReadBack read = read_back(written(made.mesh, made.attributes, bits));
  ASSERT_EQ(read.error, "");
  ASSERT_TRUE(read.is_complete) << read.damage;
  for (const std::uint32_t level : some_levels(read.mesh, 8)) {
    made.attributes.go_to(level);
    read.attributes.go_to(level);
    read.mesh.go_to(level);
    expect_valid_level(read.mesh, read.attributes);
    for (std::uint32_t h = 0; h < read.mesh.mesh().halfedge_count(); ++h)
      ASSERT_EQ(made.attributes.corner_wedges()[h], read.attributes.corner_wedges()[h]);
    for (std::size_t k = 0; k < table.layers.size(); ++k) {
      const AttributeType& type = table.layers[k].type;
      for (std::uint32_t w = 0; w < made.attributes.wedge_count(level); ++w) {
        const auto was = progressive::raw_value(type, made.attributes.layers()[k].value(w));
        const auto is = progressive::raw_value(type, read.attributes.layers()[k].value(w));
        for (std::size_t c = 0; c < type.components; ++c)
          ASSERT_NEAR(was[c], is[c], tolerance(table, k, c)) << type.name;
      }
    }
  }
}

TEST(PmAttributes, RoundedValuesAreTheNearest) {
  const Mesh mesh = built(torus(24, 16)).mesh;
  for (const std::uint32_t charts : {1000U, 256U, 1U}) {
    Progressive made = progressive::make_progressive(
        mesh, charted(mesh, [&](std::uint32_t f) { return f / charts; }), {.target_faces = 20});
    expect_rounded(made, 14);
    expect_rounded(made, 8);
  }
}

TEST(PmAttributes, RoundedFilesAreSmaller) {
  const Mesh mesh = built(torus(40, 30)).mesh;
  Progressive made = progressive::make_progressive(
      mesh, charted(mesh, [](std::uint32_t f) { return f / 500; }), {.target_faces = 40});
  EXPECT_LT(written(made.mesh, made.attributes, 14).size(),
            written(made.mesh, made.attributes).size() * 2 / 3);
}

TEST(PmAttributes, GeometryIsThatOfVersion1) {
  const Mesh mesh = built(torus(40, 30)).mesh;
  Progressive made = progressive::make_progressive(
      mesh, charted(mesh, [](std::uint32_t f) { return f / 500; }), {.target_faces = 40});
  for (const unsigned bits : {0U, 14U}) {
    const auto sizes = progressive::write_pm(
        made.mesh, {.coordinate_bits = bits, .attributes = &made.attributes}, [](auto) {});
    EXPECT_EQ(sizes.geometry(), written(made.mesh, bits).size());
    EXPECT_EQ(sizes.layers.size(), 2U);
    std::uint64_t values = 0;
    for (const progressive::PmLayerSize& layer : sizes.layers)
      values += layer.bytes;
    EXPECT_LE(values + sizes.wedges, sizes.attributes);
    EXPECT_GT(values + sizes.wedges + 600, sizes.attributes);
    // Where nothing has a seam, it says little about wedges.
    const Attributes whole = charted(mesh, [](std::uint32_t) { return 0; });
    Progressive seamless = progressive::make_progressive(mesh, whole, {.target_faces = 40});
    const auto little = progressive::write_pm(
        seamless.mesh, {.coordinate_bits = bits, .attributes = &seamless.attributes}, [](auto) {});
    EXPECT_LT(8 * little.wedges, mesh.vertex_count());
  }
}

TEST(PmAttributes, WithoutAttributesTheFileHasVersion1) {
  const Mesh mesh = built(torus(12, 9)).mesh;
  Progressive made = progressive::make_progressive(mesh, Attributes(), {.target_faces = 10});
  EXPECT_EQ(written(made.mesh, made.attributes), written(made.mesh));
}

TEST(PmAttributes, FilesHoldOtherBytes) {
  const std::string text = "materials";
  const auto appendix = std::as_bytes(std::span(text));
  const Mesh mesh = built(torus(24, 16)).mesh;
  for (const std::uint32_t charts : {1U, 0U}) {
    Attributes attributes;
    if (charts > 0) attributes = charted(mesh, [](std::uint32_t) { return 0; });
    Progressive made = progressive::make_progressive(mesh, attributes, {.target_faces = 20});
    const Bytes bytes = written(made.mesh, made.attributes, 0, appendix);
    for (const std::size_t piece : {0U, 1U, 100U}) {
      ReadBack read = read_back(bytes, piece);
      ASSERT_TRUE(read.is_complete) << read.error << read.damage;
      EXPECT_EQ(read.appendix, Bytes(appendix.begin(), appendix.end()));
      expect_same_attributes(made.mesh, made.attributes, read.attributes);
    }
    EXPECT_EQ(progressive::PmReader::count_splits(bytes), made.mesh.split_count());
  }
}

TEST(PmAttributes, EveryPrefixOfBlocksIsALevel) {
  const Mesh mesh = built(torus(40, 30)).mesh;
  Progressive made = progressive::make_progressive(
      mesh, charted(mesh, [](std::uint32_t f) { return f / 500; }), {.target_faces = 40});
  const Bytes bytes = written(made.mesh, made.attributes, 12);
  ReadBack whole = read_back(bytes);
  progressive::PmReader reader("x.pm");
  std::uint32_t levels = 0;
  std::uint32_t before = kNone;
  for (std::size_t at = 0; at < bytes.size(); at += 50) {
    reader.feed(std::span(bytes).subspan(at, std::min<std::size_t>(50, bytes.size() - at)));
    if (!reader.has_base() || reader.mesh().split_count() == before) continue;
    before = reader.mesh().split_count();
    ++levels;
    ASSERT_EQ(reader.attributes().split_count(), before);
    expect_valid_level(reader.mesh(), reader.attributes());
    expect_same_attributes(reader.mesh(), whole.attributes, reader.attributes());
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(levels, 4U);
  EXPECT_TRUE(reader.is_complete());
}

TEST(PmAttributes, BytesDoNotDependOnThreads) {
  const Mesh mesh = built(torus(80, 50)).mesh;
  const Attributes attributes = charted(mesh, [](std::uint32_t f) { return f / 999; });
  const auto bytes = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    Progressive made = progressive::make_progressive(mesh, attributes, {.target_faces = 300});
    return written(made.mesh, made.attributes, 14);
  };
  EXPECT_EQ(bytes(1), bytes(2));
}

class PmScene : public testing::TestWithParam<const char*> {};

TEST_P(PmScene, IsExact) {
  const auto file = std::filesystem::path(MESHER_SHARED_MODELS) / "scenes" / GetParam();
  if (!std::filesystem::exists(file)) {
    std::cerr << "*** NOT TESTED: " << file << " is missing ***\n";
    return;
  }
  const Model model = io::read_model(file, {});
  expect_exact(model.mesh, model.attributes, model.mesh.face_count() / 50);
  Progressive made = progressive::make_progressive(model.mesh, model.attributes,
                                                   {.target_faces = model.mesh.face_count() / 50});
  expect_rounded(made, 14);
}

INSTANTIATE_TEST_SUITE_P(Shared, PmScene,
                         testing::Values("CesiumMan.glb", "BoxVertexColors.glb", "chr_knight.glb",
                                         "greySnapper_vertColor.glb", "DamagedHelmet.glb"));

}  // namespace
}  // namespace mesher::test
