#include "engine/io/gltf_compress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/io/gltf_types.h"
#include "engine/io/meshopt_view.h"
#include "tests/support/bytes.h"

namespace mesher::io {
namespace {

GltfArray floats(const std::string& name, const char* type, std::size_t components,
                 const std::vector<float>& values) {
  GltfArray array;
  array.name = name;
  array.bytes = test::bytes_of(values);
  array.json = {{"componentType", gltf_number(ComponentType::f32)},
                {"count", values.size() / components},
                {"type", type}};
  return array;
}

std::string decoded(const CompressedArray& array) {
  const MeshoptView view{.bytes = array.bytes,
                         .count = array.count,
                         .stride = array.stride,
                         .mode = array.mode,
                         .filter = array.filter};
  EXPECT_EQ(objection(view, array.count * array.stride), "");
  std::string bytes;
  EXPECT_TRUE(decode_meshopt(view, bytes));
  return bytes;
}

std::vector<float> decoded_floats(const CompressedArray& array) {
  const std::string bytes = decoded(array);
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

// The bound holds near zero and far from it; what floats cannot express is not rounded at all.
TEST(GltfCompress, PositionsAreWithinTheBound) {
  for (const float center : {0.0F, 1.0F, 1000.0F, 1e6F}) {
    for (const float extent : {1e-6F, 1.0F, 100.0F}) {
      std::vector<float> values;
      for (int i = 0; i < 300; ++i)
        values.push_back(center + extent * std::sin(static_cast<float>(i)));
      GltfArray array = floats("POSITION", "VEC3", 3, values);
      array.json["min"] = {-1e9, -1e9, -1e9};
      array.json["max"] = {1e9, 1e9, 1e9};
      const CompressedArray packed = compress(array, AttributeKind::custom);
      const std::vector<float> result = decoded_floats(packed);
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      ASSERT_EQ(result.size(), values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_LE(std::abs(result[i] - values[i]), std::ldexp(*high - *low, -15)) << center;
      // The declared range is that of the stored values.
      if (packed.filter.empty()) continue;
      EXPECT_LE(array.json["max"][0].get<float>(), center + 1.01F * extent);
      for (std::size_t i = 0; i < result.size(); ++i) {
        EXPECT_GE(result[i], array.json["min"][i % 3].get<float>());
        EXPECT_LE(result[i], array.json["max"][i % 3].get<float>());
      }
    }
  }
}

TEST(GltfCompress, UnitVectorsTakeBytes) {
  GltfArray array = floats("TANGENT", "VEC4", 4, {0, 0, 1, -1, 0.6F, 0.8F, 0, 1});
  const CompressedArray packed = compress(array, AttributeKind::tangent);
  EXPECT_EQ(array.json["componentType"], 5120);
  EXPECT_EQ(array.json["normalized"], true);
  EXPECT_EQ(array.stride, 4U);
  const std::string bytes = decoded(packed);
  const auto value = [&](std::size_t i) { return static_cast<signed char>(bytes[i]) / 127.0; };
  EXPECT_NEAR(value(2), 1.0, 0.01);
  EXPECT_EQ(value(3), -1.0);
  EXPECT_NEAR(value(4), 0.6, 0.02);
  EXPECT_EQ(value(7), 1.0);
}

TEST(GltfCompress, TextureCoordinatesAreFractionsIfTheyCanBe) {
  GltfArray inside = floats("TEXCOORD_0", "VEC2", 2, {0, 0.25F, 1, 0.5F});
  const std::string bytes = decoded(compress(inside, AttributeKind::texcoord));
  EXPECT_EQ(inside.json["componentType"], 5123);
  EXPECT_EQ(bytes, test::bytes_of<std::uint16_t>({0, 16384, 65535, 32768}));
  GltfArray outside = floats("TEXCOORD_0", "VEC2", 2, {0, 0.25F, 1.5F, -2});
  compress(outside, AttributeKind::texcoord);
  EXPECT_EQ(outside.json["componentType"], 5126);
}

TEST(GltfCompress, EverythingElseKeepsItsBits) {
  const std::vector<float> values = {0.1F, 1e-30F, -7.25F, std::nanf("")};
  for (const AttributeKind kind : {AttributeKind::weights, AttributeKind::custom}) {
    GltfArray array = floats("_ANY", "VEC4", 4, values);
    EXPECT_EQ(decoded(compress(array, kind)), array.bytes);
  }
  GltfArray broken = floats("POSITION", "VEC4", 4, values);
  EXPECT_EQ(decoded(compress(broken, AttributeKind::custom)), broken.bytes);
}

TEST(GltfCompress, IndicesKeepTheirTriangles) {
  GltfArray array;
  array.bytes = test::bytes_of<std::uint16_t>({0, 1, 2, 2, 1, 3});
  array.json = {{"count", 6}, {"type", "SCALAR"}};
  const CompressedArray packed = compress_indices(array);
  EXPECT_EQ(packed.mode, "TRIANGLES");
  EXPECT_EQ(packed.stride, 2U);
  const std::string bytes = decoded(packed);
  std::vector<std::uint16_t> indices(6);
  std::memcpy(indices.data(), bytes.data(), bytes.size());
  for (const std::size_t first : {0U, 3U}) {
    const auto begin = indices.begin() + static_cast<std::ptrdiff_t>(first);
    std::rotate(begin, std::min_element(begin, begin + 3), begin + 3);
  }
  EXPECT_EQ(indices, (std::vector<std::uint16_t>{0, 1, 2, 1, 3, 2}));
}

}  // namespace
}  // namespace mesher::io
