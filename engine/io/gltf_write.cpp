#include "engine/io/gltf_write.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/io/block_writer.h"
#include "engine/io/gltf_compress.h"
#include "engine/io/gltf_container.h"
#include "engine/io/gltf_material_write.h"
#include "engine/io/gltf_types.h"
#include "engine/io/material_losses.h"
#include "engine/mesh/statistics.h"

namespace mesher::io {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// An array of the file with its own buffer view.
struct Accessor {
  const char* type;
  std::uint32_t component_type;
  std::size_t count;
  std::size_t element_bytes;
  int target;
  OrderedJson more;           ///< further JSON members
  bool needs_stride = false;  ///< its elements are shorter
  std::string name{};         ///< of the attribute; empty for indices
  AttributeKind kind = AttributeKind::custom;

  std::uint64_t bytes() const { return std::uint64_t{count} * element_bytes; }
  OrderedJson json() const {
    OrderedJson json{{"componentType", component_type}, {"count", count}, {"type", type}};
    json.update(more);
    return json;
  }
};

/// Bytes of a value in the file, where each begins at a multiple of 4.
std::size_t aligned_bytes(const AttributeType& type) {
  return (type.value_bytes() + 3) / 4 * 4;
}

/// Returns whether a layer can be written: glTF has no value for a corner without a normal.
bool can_write(const AttributeLayer& layer) {
  if (layer.type().kind != AttributeKind::normal) return true;
  for (std::size_t w = 0; w < layer.count(); ++w) {
    if (is_absent(layer, w)) return false;
  }
  return true;
}

/// Writes one level of detail.
class LevelWriter {
 public:
  LevelWriter(const GltfLevel& level, const Materials* materials)
      : mesh_(*level.mesh), attributes_(*level.attributes) {
    for (const AttributeLayer& layer : attributes_.layers) {
      if (can_write(layer)) layers_.push_back(&layer);
    }
    if (materials != nullptr && !attributes_.group.empty())
      part_faces(static_cast<std::uint32_t>(materials->materials.size()));
  }

  /// Calls `add_accessor` for each accessor in the order of `write_data`, with type, component
  /// type, count, bytes per element and target. It returns the accessor's index and its JSON.
  /// Returns the primitives.
  template <class AddAccessor>
  OrderedJson describe(AddAccessor&& add_accessor) const {
    constexpr std::uint32_t kFloat = gltf_number(ComponentType::f32);
    constexpr std::uint32_t kUint = gltf_number(ComponentType::u32);
    constexpr int kVertexData = 34962;
    constexpr int kIndexData = 34963;
    const Box box = bounding_box(mesh_);
    OrderedJson attributes;
    attributes["POSITION"] = add_accessor(Accessor{
        "VEC3",
        kFloat,
        vertex_count(),
        12,
        kVertexData,
        {{"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}},
        false,
        "POSITION"});
    for (const AttributeLayer* layer : layers_) {
      const AttributeType& type = layer->type();
      OrderedJson more = OrderedJson::object();
      if (type.is_normalized) more["normalized"] = true;
      attributes[type.name] =
          add_accessor(Accessor{gltf_shape(type.components), gltf_number(type.component),
                                vertex_count(), aligned_bytes(type), kVertexData, std::move(more),
                                type.value_bytes() % 4 != 0, type.name, type.kind});
    }
    OrderedJson primitives = OrderedJson::array();
    for (const Part& part : parts_) {
      const std::size_t indices = add_accessor(
          Accessor{"SCALAR", kUint, 3 * part.faces, 4, kIndexData, OrderedJson::object()});
      primitives.push_back({{"attributes", attributes}, {"indices", indices}});
      if (part.material != kNone) primitives.back()["material"] = part.material;
    }
    return primitives;
  }

  /// Number of corners, in proportion to the time.
  double weight() const { return double(mesh_.halfedge_count()); }

  template <class Sink>
  void write_data(Sink& sink, Progress* progress) const {
    // In proportion to the bytes.
    std::vector<double> weights{12.0 * double(vertex_count())};
    for (const AttributeLayer* layer : layers_)
      weights.push_back(double(layer->bytes().size()));
    weights.push_back(4.0 * mesh_.halfedge_count());
    Stages stages(progress, weights);
    stages.next();
    write_elements(sink, vertex_count(), 12, progress, [&](Appender& out, std::size_t w) {
      const Vertex v =
          attributes_.vertex(Wedge(static_cast<std::uint32_t>(w)), mesh_.vertex_count());
      out.raw(mesh_.position(v));
    });
    for (const AttributeLayer* layer : layers_) {
      stages.next();
      write_layer(sink, progress, *layer);
    }
    stages.next();
    write_elements(sink, mesh_.halfedge_count(), 4, progress, [&](Appender& out, std::size_t c) {
      const std::size_t corner = order_.empty() ? c : 3 * std::size_t{order_[c / 3]} + c % 3;
      const Halfedge h(static_cast<std::uint32_t>(corner));
      out.raw(attributes_.wedge(mesh_.origins(), h).index());
    });
  }

 private:
  /// The faces of one material.
  struct Part {
    std::uint32_t material = kNone;
    std::size_t faces = 0;
  };

  /// Orders the faces by material, and those of one as in the mesh. Faces without material are
  /// last.
  void part_faces(std::uint32_t materials) {
    const auto material_of = [&](std::uint32_t face) {
      return std::min(attributes_.groups[attributes_.group[face]].material, materials);
    };
    std::vector<std::uint32_t> start(materials + std::size_t{2}, 0);
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
      ++start[material_of(f) + std::size_t{1}];
    parts_.clear();
    for (std::uint32_t m = 0; m <= materials; ++m) {
      if (start[m + 1] > 0) parts_.push_back({m == materials ? kNone : m, start[m + 1]});
      start[m + 1] += start[m];
    }
    if (parts_.size() < 2) return;
    order_.resize(mesh_.face_count());
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
      order_[start[material_of(f)]++] = f;
  }

  /// One vertex per wedge.
  std::size_t vertex_count() const { return mesh_.vertex_count() + attributes_.further.size(); }

  template <class Sink>
  void write_layer(Sink& sink, Progress* progress, const AttributeLayer& layer) const {
    const AttributeType& type = layer.type();
    const std::size_t bytes = aligned_bytes(type);
    const bool is_turned = type.kind == AttributeKind::texcoord && !type.counts_down;
    const AttributeLayer turned = is_turned ? from_top(layer) : AttributeLayer(type, 0);
    const AttributeLayer& written = is_turned ? turned : layer;
    write_elements(sink, layer.count(), bytes, progress, [&](Appender& out, std::size_t w) {
      const std::span<const std::byte> value = written.value(w);
      char padded[AttributeType::kMostComponents * sizeof(float)] = {};
      std::memcpy(padded, value.data(), value.size());
      out << std::string_view(padded, bytes);
    });
  }

  static AttributeLayer from_top(const AttributeLayer& layer) {
    constexpr std::size_t kGrain = std::size_t{1} << 13;
    AttributeLayer turned(layer.type(), layer.count());
    parallel_for_each(layer.count(), kGrain,
                      [&](std::uint32_t w) { store(turned, w, from_top(load(layer, w))); });
    return turned;
  }

  /// Texture coordinates of a corner without any are 0.
  static AttributeValue from_top(const AttributeValue& value) {
    if (!std::isfinite(value[0] + value[1])) return {};
    return {value[0], static_cast<double>(1.0F - static_cast<float>(value[1])), value[2], value[3]};
  }

  const Mesh& mesh_;
  const Attributes& attributes_;
  std::vector<const AttributeLayer*> layers_;
  std::vector<Part> parts_ = {{kNone, mesh_.face_count()}};
  Array<std::uint32_t> order_;  ///< faces in the order of the parts; empty: that of the mesh
};

class GltfWriter {
 public:
  GltfWriter(AtomicFile& file, std::span<const GltfLevel> levels, const GltfWriteOptions& options)
      : file_(file),
        origin_(options.origin),
        binary_(options.binary),
        compresses_(options.compresses),
        materials_(options.materials),
        progress_(options.progress) {
    for (const GltfLevel& level : levels) {
      check_cancelled(progress_);
      levels_.emplace_back(level, materials_);
    }
    describe();
    if (materials_ != nullptr && !materials_->materials.empty()) {
      std::uint32_t uv_sets = kNone;
      for (const GltfLevel& level : levels)
        uv_sets = std::min(uv_sets, count_uv_sets(*level.attributes));
      add_gltf_materials(document_, *materials_, uv_sets,
                         [&](const std::string& bytes) { return add_image(bytes); });
    }
    if (levels.size() > 1) describe_chain(levels);
  }

  void run() {
    // Names of other formats need not be UTF-8, and JSON has to be.
    GltfParts parts;
    parts.document = document_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    parts.buffers.push_back(OrderedJson{{"byteLength", bytes_}}.dump());
    if (!compressed_.is_empty()) parts.buffers.push_back(compressed_.fallback().dump());
    parts.bytes = bytes_;
    write_container(file_, parts, binary_, [&](auto& sink) { write_data(sink); });
  }

 private:
  /// Adds an accessor with its own buffer view and returns the accessor's index.
  std::size_t add_accessor(Accessor&& accessor) {
    document_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", bytes_},
                                        {"byteLength", accessor.bytes()},
                                        {"target", accessor.target}});
    if (accessor.needs_stride)
      document_["bufferViews"].back()["byteStride"] = accessor.element_bytes;
    bytes_ += accessor.bytes();
    return add_accessor_json(accessor.json());
  }

  /// Lets an accessor refer to the last buffer view and returns the accessor's index.
  std::size_t add_accessor_json(const OrderedJson& json) {
    OrderedJson accessor{{"bufferView", document_["bufferViews"].size() - 1}};
    accessor.update(json);
    document_["accessors"].push_back(std::move(accessor));
    return document_["accessors"].size() - 1;
  }

  /// As add_accessor, with its data, which is encoded now: the document needs its length.
  std::size_t add_compressed(const Accessor& accessor, std::string&& bytes) {
    GltfArray array{.name = accessor.name, .json = accessor.json(), .bytes = std::move(bytes)};
    const bool is_index = accessor.name.empty();
    CompressedArray packed = is_index ? compress_indices(array) : compress(array, accessor.kind);
    OrderedJson view(compressed_.add(packed));
    view["buffer"] = 1;
    view["target"] = accessor.target;
    OrderedJson& extension = view["extensions"][kMeshoptExtension];
    extension["buffer"] = 0;
    extension["byteOffset"] = bytes_;
    extension["byteLength"] = packed.bytes.size();
    document_["bufferViews"].push_back(std::move(view));
    append(packed_.emplace_back(std::move(packed.bytes)));
    return add_accessor_json(OrderedJson(array.json));
  }

  /// Adds the accessors of a level with its data.
  OrderedJson describe_compressed(const LevelWriter& level) {
    struct Text {
      std::string text;
      void write(std::string_view more) { text += more; }
    } data;
    level.write_data(data, progress_);
    std::size_t at = 0;
    return level.describe([&](Accessor&& accessor) {
      const std::size_t begin = std::exchange(at, at + accessor.bytes());
      return add_compressed(accessor, data.text.substr(begin, accessor.bytes()));
    });
  }

  /// Adds a buffer view for an image and returns its index.
  std::size_t add_image(const std::string& bytes) {
    document_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", bytes.size()}});
    append(bytes);
    return document_["bufferViews"].size() - 1;
  }

  /// Puts bytes after the data so far. What follows stays aligned.
  void append(const std::string& bytes) {
    bytes_ += (bytes.size() + 3) / 4 * 4;
    pieces_.push_back(&bytes);
  }

  void describe() {
    document_ = {{"asset", {{"version", "2.0"}, {"generator", "mesher"}}}};
    for (const char* array : {"bufferViews", "accessors", "meshes", "nodes"})
      document_[array] = OrderedJson::array();
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      OrderedJson primitives = compresses_ ? describe_compressed(levels_[i])
                                           : levels_[i].describe([&](Accessor&& accessor) {
                                               return add_accessor(std::move(accessor));
                                             });
      document_["meshes"].push_back({{"primitives", std::move(primitives)}});
      document_["nodes"].push_back({{"mesh", i}});
      if (origin_ != glm::dvec3(0.0)) {
        document_["nodes"].back()["translation"] = {origin_.x, origin_.y, origin_.z};
      }
    }
    document_["scenes"] = OrderedJson::array({{{"nodes", OrderedJson::array({0})}}});
    document_["scene"] = 0;
    if (compresses_)
      for (const char* list : {"extensionsUsed", "extensionsRequired"})
        document_[list] = {kMeshoptExtension, kQuantizationExtension};
  }

  /// The first node names the others, which are in no scene. A reader without support for levels
  /// shows the first.
  void describe_chain(std::span<const GltfLevel> levels) {
    OrderedJson ids = OrderedJson::array();
    OrderedJson coverage = OrderedJson::array();
    for (std::size_t i = 0; i < levels.size(); ++i) {
      document_["nodes"][i]["name"] = "lod" + std::to_string(i);
      coverage.push_back(levels[i].least_coverage);
      if (i > 0) ids.push_back(i);
    }
    document_["extensionsUsed"].push_back("MSFT_lod");
    document_["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
    document_["nodes"][0]["extras"]["MSFT_screencoverage"] = std::move(coverage);
  }

  template <class Sink>
  void write_data(Sink& sink) const {
    if (!compresses_) write_levels(sink);
    for (const std::string* piece : pieces_) {
      sink.write(*piece);
      sink.write(std::string_view("\0\0\0", (4 - piece->size() % 4) % 4));
    }
  }

  template <class Sink>
  void write_levels(Sink& sink) const {
    std::vector<double> weights;
    for (const LevelWriter& level : levels_)
      weights.push_back(level.weight());
    Stages stages(progress_, weights);
    for (const LevelWriter& level : levels_) {
      stages.next();
      level.write_data(sink, progress_);
    }
  }

  AtomicFile& file_;
  glm::dvec3 origin_;
  bool binary_;
  bool compresses_;
  const Materials* materials_;
  Progress* progress_;
  std::vector<LevelWriter> levels_;
  OrderedJson document_;
  std::uint64_t bytes_ = 0;
  CompressedViews compressed_;
  std::deque<std::string> packed_;          ///< compressed arrays
  std::vector<const std::string*> pieces_;  ///< compressed arrays and images; after the levels
};

}  // namespace

void write_gltf(AtomicFile& file, std::span<const GltfLevel> levels,
                const GltfWriteOptions& options) {
  for (const GltfLevel& level : levels) {
    if (level.mesh->vertex_count() == 0) {
      throw OutputError(file.name(), "glTF cannot hold an empty mesh");
    }
  }
  GltfWriter(file, levels, options).run();
}

void write_gltf(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
                const GltfWriteOptions& options) {
  const GltfLevel level{&mesh, &attributes};
  write_gltf(file, {&level, 1}, options);
}

}  // namespace mesher::io
