#include "engine/io/gltf_mesh.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/io/gltf_contents.h"
#include "engine/io/gltf_triangles.h"
#include "engine/io/gltf_types.h"
#include "engine/io/join.h"
#include "engine/mesh/build/build.h"
#include "engine/mesh/layer_types.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

/// Times of reading the primitives, and of building the mesh with its attributes.
constexpr double kMeshReadWeights[] = {0.3, 0.7};

/// The vertices of a primitive that its triangles use: `count` from `first` on.
struct UsedVertices {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The values of one attribute in some primitives.
struct GatheredLayer {
  AttributeLayer values;
  /// For each primitive with the attribute, its number and that of its first value.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parts;
};

/// Returns the type in which values are kept. Integers that are no fractions cannot be blended;
/// quantized coordinates and normals become floats.
AttributeType kept_type(std::string name, AttributeKind kind, const GltfFile::Accessor& accessor) {
  AttributeType type{.kind = kind,
                     .name = std::move(name),
                     .components = static_cast<std::uint8_t>(accessor.components),
                     .component = accessor.type,
                     .is_normalized = accessor.is_normalized,
                     .counts_down = kind == AttributeKind::texcoord,
                     .is_linear = kind == AttributeKind::color};
  const bool is_free = kind == AttributeKind::joints || kind == AttributeKind::custom;
  if (kind == AttributeKind::delta || (!is_free && !accessor.is_normalized)) {
    type.component = ComponentType::f32;
    type.is_normalized = false;
  }
  return type;
}

/// A primitive with triangles.
struct Part {
  std::size_t first_corner = 0;
  std::size_t corners = 0;
  std::uint32_t first_vertex = 0;
};

class GltfMeshReader {
 public:
  GltfMeshReader(GltfFile& gltf, PackedPrimitives& packed, GltfBudget& budget,
                 const ReadOptions& options)
      : gltf_(gltf), packed_(packed), budget_(budget), options_(options) {}

  Soup run(const Json& mesh) {
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) {
      gltf_.fail("a mesh has no primitives");
    }
    for (std::size_t i = 0; i < primitives->size(); ++i) {
      check_cancelled(options_.progress);
      if (!(*primitives)[i].is_object()) gltf_.fail("a primitive is not an object");
      add_primitive((*primitives)[i], static_cast<std::uint32_t>(i));
    }
    make_streams();
    if (options_.weld) join_vertices(soup_, *options_.weld, options_.progress);
    return std::move(soup_);
  }

 private:
  void add_primitive(const Json& json, std::uint32_t number) {
    budget_.spend(gltf_, GltfBudget::kPrimitiveCost);
    const auto mode = triangle_mode(gltf_, json);
    const auto attributes = json.find("attributes");
    if (!mode || attributes == json.end() || !attributes->contains("POSITION")) return;
    const PackedPrimitive* const packed = packed_.find(gltf_, json, options_.progress);
    const std::size_t vertices =
        packed != nullptr ? packed->mesh.points
                          : gltf_.element_count(*gltf_.find_number(*attributes, "POSITION"));
    Array<std::uint32_t> triangles =
        packed != nullptr ? packed->mesh.indices : triangle_indices(gltf_, json, *mode, vertices);
    if (triangles.empty()) return;
    FaceLimit::check((soup_.corners.size() + triangles.size()) / 3);
    // Many primitives may share one long accessor and each use a part of it.
    const auto [low, high] = std::minmax_element(triangles.begin(), triangles.end());
    const UsedVertices used{*low, *high - *low + std::size_t{1}};
    budget_.spend(gltf_, triangles.size() + used.count);
    part_ = static_cast<std::uint32_t>(parts_.size());
    const auto first_vertex = static_cast<std::uint32_t>(soup_.positions.size());
    add_positions(*gltf_.find_number(*attributes, "POSITION"), packed, used);
    for (const auto& [name, accessor] : attributes->items()) {
      if (name == "POSITION") continue;
      add_layer(name, attribute_kind(name), name, *attributes, packed, used);
    }
    add_targets(json, used);
    parts_.push_back({soup_.corners.size(), triangles.size(), first_vertex});
    for (const std::uint32_t index : triangles)
      soup_.corners.push_back(first_vertex + index - static_cast<std::uint32_t>(used.first));
    add_group(json, number, triangles.size() / 3);
  }

  void add_positions(std::uint64_t accessor, const PackedPrimitive* packed, UsedVertices used) {
    const Array<float> values = packed != nullptr
                                    ? packed->values("POSITION", 3, used.first, used.count)
                                    : gltf_.floats(accessor, 3, used.first, used.count);
    for (std::size_t i = 0; i < used.count; ++i)
      soup_.positions.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }

  /// Adds the values of `key` of an object to the layer `name`.
  void add_layer(const std::string& name, AttributeKind kind, const std::string& key,
                 const Json& object, const PackedPrimitive* packed, UsedVertices used) {
    const auto index = gltf_.find_number(object, key.c_str());
    budget_.spend(gltf_, used.count);
    std::optional<AttributeLayer> values =
        packed != nullptr && packed->names.contains(key)
            ? packed_values(name, kind, key, *index, *packed, used)
            : stored_values(name, kind, *index, used);
    if (values) gather(std::move(*values));
  }

  /// Returns nothing for matrices, which no layer holds.
  std::optional<AttributeLayer> stored_values(const std::string& name, AttributeKind kind,
                                              std::uint64_t index, UsedVertices used) {
    const GltfFile::Accessor accessor = gltf_.open_accessor(index);
    if (accessor.components > AttributeType::kMostComponents) return std::nullopt;
    if (used.first > accessor.count || used.count > accessor.count - used.first) {
      gltf_.fail("attributes have different lengths");
    }
    const AttributeType type = kept_type(name, kind, accessor);
    AttributeType as_stored = type;
    as_stored.component = accessor.type;
    as_stored.is_normalized = accessor.is_normalized;
    AttributeLayer values(as_stored, used.count);
    for (std::size_t i = 0; i < used.count; ++i) {
      std::memcpy(values.value(i).data(),
                  accessor.bytes.data() + (used.first + i) * accessor.stride,
                  accessor.element_bytes());
    }
    if (type == as_stored) return values;
    AttributeLayer converted(type, 0);
    append_converted(converted, values);
    return converted;
  }

  std::optional<AttributeLayer> packed_values(const std::string& name, AttributeKind kind,
                                              const std::string& key, std::uint64_t index,
                                              const PackedPrimitive& packed, UsedVertices used) {
    const GltfFile::Json& json = gltf_.element("accessors", index);
    const auto components = packed.mesh.attributes[packed.names.at(key)].components;
    if (components == 0 || components > AttributeType::kMostComponents) return std::nullopt;
    GltfFile::Accessor declared{.components = components};
    const auto type = component_type(gltf_.find_number(json, "componentType").value_or(0));
    if (!type) gltf_.fail("unknown componentType");
    declared.type = *type;
    declared.is_normalized = gltf_.full_value(index) != 0.0;
    AttributeLayer values(kept_type(name, kind, declared), used.count);
    const Array<float> numbers = packed.values(key, components, used.first, used.count);
    for (std::size_t i = 0; i < used.count; ++i) {
      AttributeValue value{};
      for (std::size_t c = 0; c < components; ++c)
        value[c] = double(numbers[i * components + c]);
      store(values, i, value);
    }
    return values;
  }

  void add_targets(const Json& json, UsedVertices used) {
    const auto targets = json.find("targets");
    if (targets == json.end() || !targets->is_array()) return;
    for (std::size_t t = 0; t < targets->size(); ++t) {
      const Json& target = (*targets)[t];
      if (!target.is_object()) gltf_.fail("a morph target is not an object");
      for (const auto& [key, accessor] : target.items())
        add_layer(morph_layer(t, key), AttributeKind::delta, key, target, nullptr, used);
    }
  }

  void gather(AttributeLayer&& values) {
    const auto [found, is_new] = layer_of_name_.try_emplace(values.type().name, layers_.size());
    if (is_new) layers_.push_back({AttributeLayer(values.type(), 0), {}});
    GatheredLayer* const layer = &layers_[found->second];
    const AttributeType type = common_type(layer->values.type(), values.type());
    if (type != layer->values.type()) {
      AttributeLayer converted(type, 0);
      append_converted(converted, layer->values);
      layer->values = std::move(converted);
    }
    layer->parts.emplace_back(part_, static_cast<std::uint32_t>(layer->values.count()));
    append_converted(layer->values, values);
  }

  void add_group(const Json& json, std::uint32_t number, std::size_t faces) {
    FaceGroup group{.primitive = number};
    if (const auto material = gltf_.find_number(json, "material")) {
      gltf_.element("materials", *material);
      group.material = static_cast<std::uint32_t>(*material);
    }
    soup_.attributes.group.resize(soup_.attributes.group.size() + faces,
                                  static_cast<std::uint32_t>(soup_.attributes.groups.size()));
    soup_.attributes.groups.push_back(std::move(group));
  }

  /// Layers of the same primitives share a stream. Corners still have the indices of the file.
  void make_streams() {
    std::map<std::vector<std::pair<std::uint32_t, std::uint32_t>>, std::size_t> stream_of;
    for (GatheredLayer& layer : layers_) {
      const auto [found, is_new] = stream_of.try_emplace(layer.parts, soup_.streams.size());
      if (is_new) soup_.streams.emplace_back().index = indices_of(layer.parts);
      soup_.streams[found->second].layers.push_back(std::move(layer.values));
    }
  }

  Array<std::uint32_t> indices_of(
      const std::vector<std::pair<std::uint32_t, std::uint32_t>>& parts) const {
    Array<std::uint32_t> index(soup_.corners.size(), kNone);
    for (const auto& [number, first_value] : parts) {
      const Part& part = parts_[number];
      for (std::size_t c = part.first_corner; c < part.first_corner + part.corners; ++c)
        index[c] = soup_.corners[c] - part.first_vertex + first_value;
    }
    return index;
  }

  GltfFile& gltf_;
  PackedPrimitives& packed_;
  GltfBudget& budget_;
  const ReadOptions& options_;
  Soup soup_;
  std::vector<Part> parts_;
  std::uint32_t part_ = 0;  ///< the one being read
  std::vector<GatheredLayer> layers_;
  std::unordered_map<std::string, std::size_t> layer_of_name_;
};

}  // namespace

AttributeKind attribute_kind(std::string_view name) {
  static constexpr std::pair<std::string_view, AttributeKind> kKinds[] = {
      {"TEXCOORD_", AttributeKind::texcoord}, {"NORMAL", AttributeKind::normal},
      {"TANGENT", AttributeKind::tangent},    {"COLOR_", AttributeKind::color},
      {"JOINTS_", AttributeKind::joints},     {"WEIGHTS_", AttributeKind::weights}};
  for (const auto& [start, kind] : kKinds) {
    if (name.starts_with(start)) return kind;
  }
  return AttributeKind::custom;
}

std::string morph_layer(std::size_t target, std::string_view attribute) {
  return "target " + std::to_string(target) + " " + std::string(attribute);
}

Model read_gltf_mesh(GltfFile& gltf, PackedPrimitives& packed, GltfBudget& budget,
                     std::uint64_t mesh, const ReadOptions& options) {
  Stages stages(options.progress, kMeshReadWeights);
  stages.next();
  const Json& json = gltf.element("meshes", mesh);
  Soup soup = GltfMeshReader(gltf, packed, budget, options).run(json);
  Model model;
  model.name = gltf.text(json, "name");
  stages.next();
  if (soup.corners.empty()) return model;
  try {
    BuildResult built = build_mesh(
        std::move(soup),
        {.keep_isolated_vertices = options.keep_isolated_vertices, .progress = options.progress});
    model.mesh = std::move(built.mesh);
    model.attributes = std::move(built.attributes);
    model.report = built.report;
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    gltf.fail(error.reason());
  }
  return model;
}

}  // namespace mesher::io
