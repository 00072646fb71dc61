#include "engine/io/gltf_compress.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "engine/io/gltf_types.h"

namespace mesher::io {
namespace {

constexpr int kUnitVectorBits = 8;
/// Bits of a float's mantissa that hold its array's extent, and the most that a float has.
constexpr int kExtentBits = 16;
constexpr int kMostBits = 24;

/// The values of an array of floats.
std::vector<float> floats_of(const GltfArray& array) {
  std::vector<float> values(array.bytes.size() / sizeof(float));
  std::memcpy(values.data(), array.bytes.data(), values.size() * sizeof(float));
  return values;
}

std::size_t count_of(const GltfArray& array) {
  return array.json["count"].get<std::size_t>();
}

std::size_t components_of(const GltfArray& array) {
  for (std::size_t components = 1; components <= AttributeType::kMostComponents; ++components) {
    if (array.json["type"] == gltf_shape(components)) return components;
  }
  return 1;
}

std::string encode_vertices(const std::string& bytes, std::size_t count, std::size_t stride) {
  std::string encoded(meshopt_encodeVertexBufferBound(count, stride), '\0');
  encoded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(encoded.data()),
                                            encoded.size(), bytes.data(), count, stride));
  return encoded;
}

/// Encodes an array as it is, or after a filter; `bytes` are those after the filter.
CompressedArray encoded(const std::string& bytes, std::size_t count, std::string filter) {
  CompressedArray result{.mode = "ATTRIBUTES", .filter = std::move(filter), .count = count};
  result.stride = bytes.size() / count;
  result.bytes = encode_vertices(bytes, count, result.stride);
  return result;
}

CompressedArray compress_unit_vectors(GltfArray& array) {
  const std::size_t count = count_of(array);
  const std::size_t components = components_of(array);
  const std::vector<float> values = floats_of(array);
  std::vector<float> quads(4 * count, 0.0F);
  for (std::size_t i = 0; i < count; ++i)
    std::copy_n(&values[i * components], components, &quads[4 * i]);
  std::string bytes(4 * count, '\0');
  meshopt_encodeFilterOct(bytes.data(), count, 4, kUnitVectorBits, quads.data());
  array.json["componentType"] = gltf_number(ComponentType::s8);
  array.json["normalized"] = true;
  array.stride = 4;
  return encoded(bytes, count, "OCTAHEDRAL");
}

/// Turns floats from 0 to 1 into 16-bit fractions.
CompressedArray compress_fractions(GltfArray& array) {
  const std::size_t count = count_of(array);
  const std::size_t components = components_of(array);
  const std::size_t padded = (components + 1) / 2 * 2;
  constexpr float kOne = 65535.0F;
  const std::vector<float> values = floats_of(array);
  std::vector<std::uint16_t> fractions(padded * count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < components; ++c)
      fractions[i * padded + c] =
          static_cast<std::uint16_t>(std::lround(kOne * values[i * components + c]));
  }
  array.json["componentType"] = gltf_number(ComponentType::u16);
  array.json["normalized"] = true;
  array.stride = padded * sizeof(std::uint16_t);
  const std::string bytes(reinterpret_cast<const char*>(fractions.data()),
                          fractions.size() * sizeof(std::uint16_t));
  return encoded(bytes, count, {});
}

/// Returns the bits with which every value is within 2^-15 of the extent of all; more than
/// kMostBits if floats cannot.
int bits_for(const std::vector<float>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double extent = double(*high) - double(*low);
  const double largest = std::max(std::abs(double(*low)), std::abs(double(*high)));
  if (!(extent > 0.0)) return kMostBits + 1;
  return kExtentBits + std::max(0, static_cast<int>(std::ceil(std::log2(largest / extent))));
}

void set_range(GltfArray& array, const std::vector<float>& values) {
  if (!array.json.contains("min")) return;
  const std::size_t components = components_of(array);
  std::vector<float> least(components, std::numeric_limits<float>::max());
  std::vector<float> largest(components, std::numeric_limits<float>::lowest());
  for (std::size_t i = 0; i < values.size(); ++i) {
    least[i % components] = std::min(least[i % components], values[i]);
    largest[i % components] = std::max(largest[i % components], values[i]);
  }
  array.json["min"] = least;
  array.json["max"] = largest;
}

/// Encodes each value by itself. Later versions of the library, as in Debian 13, ask whether values
/// share exponents.
void encode_exponents(std::string& bytes, const std::vector<float>& values, int bits) {
#if MESHOPTIMIZER_VERSION >= 190
  meshopt_encodeFilterExp(bytes.data(), values.size(), sizeof(float), bits, values.data(),
                          meshopt_EncodeExpSeparate);
#else
  meshopt_encodeFilterExp(bytes.data(), values.size(), sizeof(float), bits, values.data());
#endif
}

CompressedArray compress_floats(GltfArray& array) {
  const std::size_t count = count_of(array);
  std::vector<float> values = floats_of(array);
  const bool is_finite =
      std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  const int bits = is_finite ? bits_for(values) : kMostBits + 1;
  if (bits > kMostBits) return encoded(array.bytes, count, {});
  std::string bytes(array.bytes.size(), '\0');
  encode_exponents(bytes, values, bits);
  CompressedArray result = encoded(bytes, count, "EXPONENTIAL");
  meshopt_decodeFilterExp(bytes.data(), values.size(), sizeof(float));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  set_range(array, values);
  return result;
}

bool are_fractions(const GltfArray& array) {
  const std::vector<float> values = floats_of(array);
  return std::all_of(values.begin(), values.end(), [](float v) { return v >= 0.0F && v <= 1.0F; });
}

}  // namespace

CompressedArray compress(GltfArray& array, AttributeKind kind) {
  const bool is_float = array.json["componentType"] == gltf_number(ComponentType::f32);
  const bool is_position = array.name == "POSITION";
  if (is_float && (kind == AttributeKind::normal || kind == AttributeKind::tangent))
    return compress_unit_vectors(array);
  const bool may_be_fractions = kind == AttributeKind::texcoord || kind == AttributeKind::color;
  if (is_float && may_be_fractions && are_fractions(array)) return compress_fractions(array);
  const bool may_be_rounded =
      is_position || kind == AttributeKind::delta || kind == AttributeKind::texcoord;
  if (is_float && may_be_rounded) return compress_floats(array);
  return encoded(array.bytes, count_of(array), {});
}

CompressedArray compress_indices(const GltfArray& indices) {
  const std::size_t count = count_of(indices);
  const std::size_t stride = indices.bytes.size() / count;
  std::vector<unsigned> wide(count);
  unsigned largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&wide[i], indices.bytes.data() + i * stride, stride);
    largest = std::max(largest, wide[i]);
  }
  std::string encoded(meshopt_encodeIndexBufferBound(count, std::size_t{largest} + 1), '\0');
  encoded.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(encoded.data()),
                                           encoded.size(), wide.data(), count));
  return {.bytes = std::move(encoded), .mode = "TRIANGLES", .count = count, .stride = stride};
}

nlohmann::json CompressedViews::add(const CompressedArray& array) {
  const std::size_t decoded = array.count * array.stride;
  nlohmann::json view{{"byteOffset", decoded_bytes_}, {"byteLength", decoded}};
  if (array.mode == "ATTRIBUTES") view["byteStride"] = array.stride;
  nlohmann::json& extension = view["extensions"][kMeshoptExtension];
  extension = {{"count", array.count}, {"byteStride", array.stride}, {"mode", array.mode}};
  if (!array.filter.empty()) extension["filter"] = array.filter;
  constexpr std::size_t kWord = 4;
  decoded_bytes_ += (decoded + kWord - 1) / kWord * kWord;
  return view;
}

nlohmann::json CompressedViews::fallback() const {
  nlohmann::json buffer{{"byteLength", decoded_bytes_}};
  buffer["extensions"][kMeshoptExtension]["fallback"] = true;
  return buffer;
}

}  // namespace mesher::io
