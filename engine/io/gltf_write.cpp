#include "engine/io/gltf_write.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/io/base64.h"
#include "engine/io/block_writer.h"
#include "engine/io/gltf_material_write.h"
#include "engine/io/material_losses.h"
#include "engine/mesh/statistics.h"

namespace mesher::io {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();

/// An array of the file with its own buffer view.
struct Accessor {
  const char* type;
  int component_type;
  std::size_t count;
  std::size_t element_bytes;
  int target;
  OrderedJson more;           ///< further JSON members
  bool needs_stride = false;  ///< its elements are shorter
};

/// Bytes of a value in the file, where each begins at a multiple of 4.
std::size_t aligned_bytes(const AttributeType& type) {
  return (type.value_bytes() + 3) / 4 * 4;
}

/// Returns the number by which glTF knows the type of a component.
int gltf_number(ComponentType type) {
  switch (type) {
    case ComponentType::s8:
      return 5120;
    case ComponentType::u8:
      return 5121;
    case ComponentType::s16:
      return 5122;
    case ComponentType::u16:
      return 5123;
    case ComponentType::u32:
      return 5125;
    case ComponentType::f32:
      break;
  }
  return 5126;
}

const char* gltf_shape(std::size_t components) {
  constexpr const char* kShapes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kShapes[components - 1];
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
    constexpr int kFloat = 5126;
    constexpr int kUint = 5125;
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
        {{"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}}});
    for (const AttributeLayer* layer : layers_) {
      const AttributeType& type = layer->type();
      OrderedJson more = OrderedJson::object();
      if (type.is_normalized) more["normalized"] = true;
      attributes[type.name] = add_accessor(
          Accessor{gltf_shape(type.components), gltf_number(type.component), vertex_count(),
                   aligned_bytes(type), kVertexData, std::move(more), type.value_bytes() % 4 != 0});
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
    AttributeLayer turned(type, 1);
    write_elements(sink, layer.count(), bytes, progress, [&](Appender& out, std::size_t w) {
      std::span<const std::byte> value = layer.value(w);
      if (type.kind == AttributeKind::texcoord && !type.counts_down) {
        store(turned, 0, from_top(load(layer, w)));
        value = std::as_const(turned).value(0);
      }
      char padded[AttributeType::kMostComponents * sizeof(float)] = {};
      std::memcpy(padded, value.data(), value.size());
      out << std::string_view(padded, bytes);
    });
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
    if (binary_) document_["buffers"] = OrderedJson::array({{{"byteLength", bytes_}}});
  }

  void run() {
    // Names of other formats need not be UTF-8, and JSON has to be.
    std::string json = document_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    if (!binary_) {
      // The data is written before the rest of the document, which is complete by now, so that the
      // document need not hold it as well.
      file_.write("{\"buffers\":[{\"byteLength\":" + std::to_string(bytes_) +
                  ",\"uri\":\"data:application/octet-stream;base64,");
      Base64Writer<AtomicFile> text(file_);
      write_data(text);
      text.finish();
      file_.write("\"}]," + json.substr(1));
      return;
    }
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::uint64_t total = 12 + 8 + json.size() + 8 + bytes_;
    if (total > kMostBytes) throw OutputError(file_.name(), "glTF cannot hold more than 4 GB");
    Appender head;
    head.need(64);
    head << "glTF";
    head.raw(std::uint32_t{2}).raw(static_cast<std::uint32_t>(total));
    head.raw(static_cast<std::uint32_t>(json.size())) << "JSON";
    file_.write(head.text());
    file_.write(json);
    head.clear();
    head.raw(static_cast<std::uint32_t>(bytes_)) << std::string_view("BIN\0", 4);
    file_.write(head.text());
    write_data(file_);
  }

 private:
  /// Adds an accessor with its own buffer view and returns the accessor's index.
  std::size_t add_accessor(Accessor&& accessor) {
    const std::uint64_t bytes = accessor.count * accessor.element_bytes;
    document_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", bytes_},
                                        {"byteLength", bytes},
                                        {"target", accessor.target}});
    if (accessor.needs_stride)
      document_["bufferViews"].back()["byteStride"] = accessor.element_bytes;
    OrderedJson json{{"bufferView", document_["bufferViews"].size() - 1},
                     {"componentType", accessor.component_type},
                     {"count", accessor.count},
                     {"type", accessor.type}};
    json.update(accessor.more);
    document_["accessors"].push_back(std::move(json));
    bytes_ += bytes;
    return document_["accessors"].size() - 1;
  }

  /// Adds a buffer view for an image and returns its index. The views after it stay aligned.
  std::size_t add_image(const std::string& bytes) {
    document_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", bytes.size()}});
    bytes_ += (bytes.size() + 3) / 4 * 4;
    images_.push_back(&bytes);
    return document_["bufferViews"].size() - 1;
  }

  void describe() {
    document_ = {{"asset", {{"version", "2.0"}, {"generator", "mesher"}}}};
    for (const char* array : {"bufferViews", "accessors", "meshes", "nodes"})
      document_[array] = OrderedJson::array();
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      OrderedJson primitives = levels_[i].describe(
          [&](Accessor&& accessor) { return add_accessor(std::move(accessor)); });
      document_["meshes"].push_back({{"primitives", std::move(primitives)}});
      document_["nodes"].push_back({{"mesh", i}});
      if (origin_ != glm::dvec3(0.0)) {
        document_["nodes"].back()["translation"] = {origin_.x, origin_.y, origin_.z};
      }
    }
    document_["scenes"] = OrderedJson::array({{{"nodes", OrderedJson::array({0})}}});
    document_["scene"] = 0;
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
    std::vector<double> weights;
    for (const LevelWriter& level : levels_)
      weights.push_back(level.weight());
    Stages stages(progress_, weights);
    for (const LevelWriter& level : levels_) {
      stages.next();
      level.write_data(sink, progress_);
    }
    for (const std::string* image : images_) {
      sink.write(*image);
      sink.write(std::string_view("\0\0\0", (4 - image->size() % 4) % 4));
    }
  }

  AtomicFile& file_;
  glm::dvec3 origin_;
  bool binary_;
  const Materials* materials_;
  Progress* progress_;
  std::vector<LevelWriter> levels_;
  OrderedJson document_;
  std::uint64_t bytes_ = 0;
  std::vector<const std::string*> images_;  ///< after the data of the levels
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
