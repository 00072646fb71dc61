#include "engine/io/gltf_write.h"

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
#include "engine/mesh/circulators.h"
#include "engine/mesh/statistics.h"

namespace mesher::io {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();

/// Vertices of the file.
struct SplitVertices {
  Array<std::uint32_t> index;   ///< one per corner
  Array<std::uint32_t> vertex;  ///< mesh vertex of each file vertex
  Array<std::uint32_t> corner;  ///< a corner with its attributes; kNone for an isolated vertex
};

/// An array of the file with its own buffer view.
struct Accessor {
  const char* type;
  int component_type;
  std::size_t count;
  std::size_t element_bytes;
  int target;
  OrderedJson more;  ///< further JSON members
};

/// Attributes to write.
struct Carried {
  bool normal;
  bool texcoord;
  bool color;
};

bool same_attributes(const Attributes& attributes, const Carried& carried, Halfedge a, Halfedge b) {
  const auto same = [&](const auto& values) {
    return std::memcmp(&values[a.index()], &values[b.index()], sizeof values[0]) == 0;
  };
  return (!carried.normal || same(attributes.normal)) &&
         (!carried.texcoord || same(attributes.texcoord)) &&
         (!carried.color || same(attributes.color));
}

/// Returns the half-edge at which a sweep around a vertex starts, so that no run of equal corners
/// is split: after a change of attributes, or on a boundary at its start.
template <class Same>
Halfedge start_of_run(const Mesh& mesh, Vertex v, Same&& same) {
  const Halfedge start = mesh.outgoing(v);
  if (mesh.is_boundary(v)) return start;
  Circulator<Mesh, Turn::cw> at(mesh, start);
  bool has_more = true;
  while (has_more) {
    const Halfedge h = *at;
    has_more = at.advance();
    if (!same(h, *at)) return h;
  }
  return start;
}

SplitVertices split_vertices(const Mesh& mesh, const Attributes& attributes,
                             const Carried& carried) {
  SplitVertices split;
  split.index.resize(mesh.halfedge_count());
  split.vertex.reserve(mesh.vertex_count());
  split.corner.reserve(mesh.vertex_count());
  const auto add = [&](Vertex v, Halfedge h) {
    split.vertex.push_back(v.index());
    split.corner.push_back(h.index());
  };
  const auto same = [&](Halfedge a, Halfedge b) {
    return same_attributes(attributes, carried, a, b);
  };
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vertex v(i);
    if (mesh.is_isolated(v)) {
      add(v, Halfedge());
      continue;
    }
    Circulator at(mesh, start_of_run(mesh, v, same));
    Halfedge last;
    do {
      if (!last.is_valid() || !same(*at, last)) add(v, *at);
      last = *at;
      split.index[last.index()] = static_cast<std::uint32_t>(split.vertex.size() - 1);
    } while (at.advance());
  }
  return split;
}

/// Writes one level of detail.
class LevelWriter {
 public:
  explicit LevelWriter(const GltfLevel& level)
      : mesh_(*level.mesh), attributes_(*level.attributes) {
    carried_.normal = !attributes_.normal.empty();
    for (const glm::vec3& n : attributes_.normal) {
      if (!std::isfinite(n.x + n.y + n.z)) carried_.normal = false;
    }
    carried_.texcoord = !attributes_.texcoord.empty();
    carried_.color = !attributes_.color.empty();
    split_ = split_vertices(mesh_, attributes_, carried_);
  }

  /// Calls `add_accessor` for each accessor in the order of `write_data`, with type, component
  /// type, count, bytes per element and target. It returns the accessor's index and its JSON.
  /// Returns the primitive.
  template <class AddAccessor>
  OrderedJson describe(AddAccessor&& add_accessor) const {
    constexpr int kFloat = 5126;
    constexpr int kUint = 5125;
    constexpr int kByte = 5121;
    constexpr int kVertexData = 34962;
    constexpr int kIndexData = 34963;
    const std::size_t vertices = split_.vertex.size();
    const auto add = [&](const char* type, int component, std::size_t bytes) {
      return add_accessor(
          Accessor{type, component, vertices, bytes, kVertexData, OrderedJson::object()});
    };
    const Box box = bounding_box(mesh_);
    OrderedJson attributes;
    attributes["POSITION"] = add_accessor(Accessor{
        "VEC3",
        kFloat,
        vertices,
        12,
        kVertexData,
        {{"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}}});
    if (carried_.normal) attributes["NORMAL"] = add("VEC3", kFloat, 12);
    if (carried_.texcoord) attributes["TEXCOORD_0"] = add("VEC2", kFloat, 8);
    if (carried_.color) {
      attributes["COLOR_0"] =
          add_accessor(Accessor{"VEC4", kByte, vertices, 4, kVertexData, {{"normalized", true}}});
    }
    const std::size_t indices = add_accessor(
        Accessor{"SCALAR", kUint, mesh_.halfedge_count(), 4, kIndexData, OrderedJson::object()});
    return {{"attributes", std::move(attributes)}, {"indices", indices}};
  }

  /// Number of corners, in proportion to the time.
  double weight() const { return double(mesh_.halfedge_count()); }

  template <class Sink>
  void write_data(Sink& sink, Progress* progress) const {
    // In proportion to the bytes.
    const double vertex_weight = double(split_.vertex.size());
    Stages stages(progress,
                  {12.0 * vertex_weight, carried_.normal ? 12.0 * vertex_weight : 0.0,
                   carried_.texcoord ? 8.0 * vertex_weight : 0.0,
                   carried_.color ? 4.0 * vertex_weight : 0.0, 4.0 * double(split_.index.size())});
    stages.next();
    const std::size_t vertices = split_.vertex.size();
    write_elements(sink, vertices, 12, progress, [&](Appender& out, std::size_t i) {
      out.raw(mesh_.positions()[split_.vertex[i]]);
    });
    stages.next();
    if (carried_.normal) {
      write_values(sink, progress, attributes_.normal, glm::vec3(0.0F, 0.0F, 1.0F),
                   [](const glm::vec3& n) { return n; });
    }
    stages.next();
    if (carried_.texcoord) {
      write_values(sink, progress, attributes_.texcoord, glm::vec2(0.0F), [](const glm::vec2& t) {
        return std::isfinite(t.x + t.y) ? glm::vec2(t.x, 1.0F - t.y) : glm::vec2(0.0F);
      });
    }
    stages.next();
    if (carried_.color) {
      write_values(sink, progress, attributes_.color, glm::u8vec4(255),
                   [](const glm::u8vec4& c) { return c; });
    }
    stages.next();
    write_elements(sink, split_.index.size(), 4, progress,
                   [&](Appender& out, std::size_t c) { out.raw(split_.index[c]); });
  }

 private:
  template <class Sink, class T, class Convert>
  void write_values(Sink& sink, Progress* progress, const Array<T>& values, const T& unused,
                    Convert&& convert) const {
    write_elements(sink, split_.corner.size(), sizeof(T), progress,
                   [&](Appender& out, std::size_t i) {
                     const std::uint32_t corner = split_.corner[i];
                     out.raw(corner == kNone ? unused : convert(values[corner]));
                   });
  }

  const Mesh& mesh_;
  const Attributes& attributes_;
  Carried carried_ = {};
  SplitVertices split_;
};

class GltfWriter {
 public:
  GltfWriter(AtomicFile& file, std::span<const GltfLevel> levels, const glm::dvec3& origin,
             bool binary, Progress* progress)
      : file_(file), origin_(origin), binary_(binary), progress_(progress) {
    for (const GltfLevel& level : levels) {
      check_cancelled(progress);
      levels_.emplace_back(level);
    }
    describe();
    if (levels.size() > 1) describe_chain(levels);
    if (binary_) document_["buffers"] = OrderedJson::array({{{"byteLength", bytes_}}});
  }

  void run() {
    std::string json = document_.dump();
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
    OrderedJson json{{"bufferView", document_["bufferViews"].size() - 1},
                     {"componentType", accessor.component_type},
                     {"count", accessor.count},
                     {"type", accessor.type}};
    json.update(accessor.more);
    document_["accessors"].push_back(std::move(json));
    bytes_ += bytes;
    return document_["accessors"].size() - 1;
  }

  void describe() {
    document_ = {{"asset", {{"version", "2.0"}, {"generator", "mesher"}}}};
    for (const char* array : {"bufferViews", "accessors", "meshes", "nodes"})
      document_[array] = OrderedJson::array();
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      OrderedJson primitive = levels_[i].describe(
          [&](Accessor&& accessor) { return add_accessor(std::move(accessor)); });
      document_["meshes"].push_back({{"primitives", OrderedJson::array({std::move(primitive)})}});
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
    document_["extensionsUsed"] = OrderedJson::array({"MSFT_lod"});
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
  }

  AtomicFile& file_;
  glm::dvec3 origin_;
  bool binary_;
  Progress* progress_;
  std::vector<LevelWriter> levels_;
  OrderedJson document_;
  std::uint64_t bytes_ = 0;
};

}  // namespace

void write_gltf(AtomicFile& file, std::span<const GltfLevel> levels, const glm::dvec3& origin,
                bool binary, Progress* progress) {
  for (const GltfLevel& level : levels) {
    if (level.mesh->vertex_count() == 0) {
      throw OutputError(file.name(), "glTF cannot hold an empty mesh");
    }
  }
  GltfWriter(file, levels, origin, binary, progress).run();
}

void write_gltf(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
                const glm::dvec3& origin, bool binary, Progress* progress) {
  const GltfLevel level{&mesh, &attributes};
  write_gltf(file, {&level, 1}, origin, binary, progress);
}

}  // namespace mesher::io
