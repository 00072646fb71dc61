#include "engine/io/gltf_read.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/io/color_byte.h"
#include "engine/io/far_origin.h"
#include "engine/io/format.h"
#include "engine/io/gltf_animation.h"
#include "engine/io/gltf_budget.h"
#include "engine/io/gltf_contents.h"
#include "engine/io/gltf_file.h"
#include "engine/io/gltf_materials.h"
#include "engine/io/gltf_nodes.h"
#include "engine/io/gltf_packed.h"
#include "engine/io/gltf_pose.h"
#include "engine/io/gltf_triangles.h"
#include "engine/io/join.h"
#include "engine/scene/transform.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kCornersBetweenReports = std::size_t{1} << 16;
/// Shares of the time of the two containers, measured with 0.1, 1.4 and 13 million faces.
struct GltfWeights {
  double document;  ///< of the whole, reading the JSON; the rest is for meshes
  double join;      ///< of a mesh, joining its vertices; the rest is for its primitives
  double decode;    ///< of reading a primitive, decoding the buffer of the first one
};
constexpr GltfWeights kGltfTextWeights{.document = 0.54, .join = 0.16, .decode = 0.63};
constexpr GltfWeights kGltfBinaryWeights{.document = 0.01, .join = 0.72, .decode = 0.01};
/// Of adding a primitive, the part that reads it.
constexpr double kReadPart = 0.85;

const GltfWeights& weights_of(const MappedFile& file) {
  return file.bytes().substr(0, 4) == "glTF" ? kGltfBinaryWeights : kGltfTextWeights;
}

struct PlacedMesh {
  std::uint64_t mesh;
  glm::dmat4 to_world;
  std::string_view node_name;
  std::optional<std::uint64_t> skin = std::nullopt;
  std::vector<double> weights = {};  ///< of morph targets
};

template <class Vector>
Array<Vector> as_vectors(const Array<float>& values) {
  Array<Vector> vectors(values.size() / static_cast<std::size_t>(Vector::length()));
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    for (int c = 0; c < Vector::length(); ++c) {
      vectors[i][c] = values[i * static_cast<std::size_t>(Vector::length()) + c];
    }
  }
  return vectors;
}

/// Vertex attributes of a primitive, each empty or one per vertex.
struct Primitive {
  Array<glm::vec3> positions;
  Array<glm::vec3> normals;
  Array<glm::vec2> texcoords;
  Array<glm::vec4> colors;
  Array<std::uint32_t> triangles;           ///< three indices per triangle
  std::vector<glm::dmat4> transforms = {};  ///< of the vertices of a skinned mesh
};

class GltfReader {
 public:
  GltfReader(const MappedFile& file, const ReadOptions& options,
             const glm::dvec3& origin = glm::dvec3(0.0))
      : options_(options),
        origin_(origin),
        progress_(options.progress),
        weights_(weights_of(file)),
        gltf_(file, options.progress) {
    soup_.origin = origin;
  }

  /// Returns the largest distance of a coordinate from its value in double precision.
  double position_error() const { return position_error_; }
  const GltfFile& document() const { return gltf_; }

  Soup run() {
    check_required_extensions(gltf_);
    note_contents(gltf_, soup_.contents);
    if (options_.pose) pose_gltf(gltf_, *options_.pose);
    if (gltf_.count("nodes") == 0) {
      for (std::uint64_t mesh = 0; mesh < gltf_.count("meshes"); ++mesh)
        placed_.push_back({mesh, glm::dmat4(1.0), ""});
    } else {
      for (const PlacedNode& placed : placed_nodes(gltf_, progress_)) {
        const Json& node = gltf_.element("nodes", placed.node);
        node_transforms_[placed.node] = placed.to_world;
        if (const auto mesh = gltf_.find_number(node, "mesh")) place(node, *mesh, placed.to_world);
      }
    }
    add_meshes();
    if (soup_.positions.empty()) gltf_.fail("no triangles");
    keep_groups();
    soup_.materials = read_gltf_materials(gltf_, soup_.contents);
    return std::move(soup_);
  }

 private:
  /// Adds the mesh of a node, once for each instance.
  void place(const Json& node, std::uint64_t mesh, const glm::dmat4& to_world) {
    PlacedMesh placed{.mesh = mesh,
                      .to_world = to_world,
                      .node_name = gltf_.text(node, "name"),
                      .skin = gltf_.find_number(node, "skin"),
                      .weights = morph_weights(gltf_, node)};
    const auto instances =
        instance_transforms(gltf_, node, GltfBudget::kAlwaysAllowed / GltfBudget::kPrimitiveCost);
    if (!instances) {
      placed_.push_back(std::move(placed));
      return;
    }
    soup_.contents[Content::instances] += instances->size();
    for (const glm::dmat4& instance : *instances) {
      placed.to_world = to_world * instance;
      placed_.push_back(placed);
      budget_.spend(gltf_, GltfBudget::kPrimitiveCost);
    }
  }

  void add_meshes() {
    std::vector<double> of_mesh(gltf_.count("meshes"), 0.0);
    std::vector<double> weights;
    for (const PlacedMesh& placed : placed_) {
      double weight = 0.0;
      if (placed.mesh < of_mesh.size()) {
        double& known = of_mesh[placed.mesh];
        if (known == 0.0) known = mesh_work(gltf_, placed.mesh);
        weight = known;
      }
      weights.push_back(weight);
    }
    Stages stages(progress_, weights);
    for (const PlacedMesh& placed : placed_) {
      stages.next();
      add_mesh(placed);
    }
  }

  void add_mesh(const PlacedMesh& placed) {
    const Json& mesh = gltf_.element("meshes", placed.mesh);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) gltf_.fail("a mesh has no primitives");
    const std::string_view name =
        placed.node_name.empty() ? gltf_.text(mesh, "name") : placed.node_name;
    Array<glm::vec3> positions;
    const std::size_t first_corner = soup_.corners.size();
    Stages stages(progress_, {1.0 - weights_.join, weights_.join});
    stages.next();
    add_primitives(*primitives, placed, name, positions);
    stages.next();
    join(positions, first_corner);
  }

  void add_primitives(const Json& primitives, const PlacedMesh& placed, std::string_view name,
                      Array<glm::vec3>& positions) {
    std::vector<glm::dmat4> joints;
    if (placed.skin) joints = joint_transforms(gltf_, *placed.skin, node_transforms_);
    std::vector<double> weights;
    for (const Json& json : primitives)
      weights.push_back(primitive_work(gltf_, json));
    Stages stages(progress_, weights);
    for (const Json& json : primitives) {
      stages.next();
      if (!json.is_object()) gltf_.fail("a primitive is not an object");
      Stages parts(progress_, {kReadPart, 1.0 - kReadPart});
      parts.next();
      Primitive primitive = read_primitive(json, placed.weights, joints);
      parts.next();
      budget_.spend(gltf_, GltfBudget::kPrimitiveCost + primitive.positions.size() +
                               primitive.triangles.size());
      if (primitive.triangles.empty()) continue;
      FaceLimit::check((soup_.corners.size() + primitive.triangles.size()) / 3);
      // The transform of the node of a skinned mesh does not count.
      if (primitive.transforms.empty()) {
        transform(primitive, placed.to_world);
      } else {
        pose(primitive);
      }
      begin_group(json, name, primitive.triangles.size() / 3);
      add_corners(primitive, static_cast<std::uint32_t>(positions.size()));
      positions.insert(positions.end(), primitive.positions.begin(), primitive.positions.end());
    }
  }

  Primitive read_primitive(const Json& json, const std::vector<double>& weights,
                           const std::vector<glm::dmat4>& joints) {
    Primitive primitive;
    const auto mode = triangle_mode(gltf_, json);
    const auto attributes = json.find("attributes");
    if (!mode) return primitive;
    if (attributes == json.end() || !attributes->contains("POSITION")) return primitive;
    const auto position = gltf_.find_number(*attributes, "POSITION");
    const PackedPrimitive* const packed = packed_.find(gltf_, json, progress_);
    const double rest = 1.0 - weights_.decode;
    Stages stages(progress_, {weights_.decode, 0.55 * rest, 0.35 * rest, 0.04 * rest, 0.03 * rest,
                              0.03 * rest});
    stages.next();
    const std::size_t vertices =
        packed != nullptr ? packed->mesh.points : gltf_.element_count(*position);
    stages.next();
    primitive.triangles =
        packed != nullptr ? packed->mesh.indices : triangle_indices(gltf_, json, *mode, vertices);
    if (primitive.triangles.empty()) return primitive;
    // Many primitives may share one long accessor and each use a part of it.
    const auto [low, high] =
        std::minmax_element(primitive.triangles.begin(), primitive.triangles.end());
    const std::uint32_t first = *low;
    const std::size_t count = *high - first + std::size_t{1};
    const auto values = [&](const char* key, std::size_t components) {
      stages.next();
      const auto accessor = gltf_.find_number(*attributes, key);
      if (packed != nullptr && packed->names.contains(key)) {
        return packed->values(key, components, first, count);
      }
      return accessor ? gltf_.floats(*accessor, components, first, count) : Array<float>();
    };
    primitive.positions = as_vectors<glm::vec3>(values("POSITION", 3));
    primitive.normals = as_vectors<glm::vec3>(values("NORMAL", 3));
    primitive.texcoords = as_vectors<glm::vec2>(values("TEXCOORD_0", 2));
    primitive.colors = as_vectors<glm::vec4>(values("COLOR_0", 4));
    add_morph_targets(gltf_, json, weights, "POSITION", first, primitive.positions);
    add_morph_targets(gltf_, json, weights, "NORMAL", first, primitive.normals);
    if (!joints.empty()) {
      const auto of_vertices = [&](const std::string& key) {
        if (packed != nullptr && packed->names.contains(key))
          return packed->values(key, 4, first, count);
        const auto accessor = gltf_.find_number(*attributes, key.c_str());
        return accessor ? gltf_.floats(*accessor, 4, first, count) : Array<float>();
      };
      primitive.transforms = vertex_transforms(gltf_, of_vertices, joints, count);
    }
    for (std::uint32_t& index : primitive.triangles)
      index -= first;
    return primitive;
  }

  void transform(Primitive& primitive, const glm::dmat4& to_world) {
    if (to_world == glm::dmat4(1.0) && origin_ == glm::dvec3(0.0)) return;  // preserves every bit
    for (glm::vec3& p : primitive.positions)
      p = placed_position(to_world, p);
    const glm::dmat3 linear(to_world);
    const glm::dmat3 of_normals = scene::normal_transform(linear);
    for (glm::vec3& n : primitive.normals)
      turn_normal(of_normals, n);
    if (glm::determinant(linear) < 0.0) turn_inside_out(primitive);
  }

  void pose(Primitive& primitive) {
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
      glm::vec3& p = primitive.positions[v];
      p = placed_position(primitive.transforms[v], p);
      if (primitive.normals.empty()) continue;
      turn_normal(scene::normal_transform(glm::dmat3(primitive.transforms[v])),
                  primitive.normals[v]);
    }
    if (glm::determinant(glm::dmat3(primitive.transforms[primitive.triangles[0]])) < 0.0) {
      turn_inside_out(primitive);
    }
  }

  /// Returns a position of the scene about the origin, and notes what single precision costs.
  glm::vec3 placed_position(const glm::dmat4& to_world, const glm::vec3& p) {
    const glm::dvec3 wide = glm::dvec3(to_world * glm::dvec4(glm::dvec3(p), 1.0)) - origin_;
    const glm::vec3 position(wide);
    for (int i = 0; i < 3; ++i) {
      const double distance = std::abs(wide[i] - static_cast<double>(position[i]));
      if (std::isfinite(distance)) position_error_ = std::max(position_error_, distance);
    }
    return position;
  }

  /// A mirroring transform turns the mesh inside out; swaps two corners to undo that.
  static void turn_inside_out(Primitive& primitive) {
    for (std::size_t i = 0; i + 2 < primitive.triangles.size(); i += 3) {
      std::swap(primitive.triangles[i + 1], primitive.triangles[i + 2]);
    }
  }

  /// Appends one value per corner. Corners of primitives without the attribute get `absent`.
  template <class Out, class In, class Convert>
  void add_values(Array<Out>& out, const Array<In>& in, const Primitive& primitive, Out absent,
                  Convert&& convert) {
    if (in.empty() && out.empty()) return;
    const std::size_t before = soup_.corners.size();
    out.resize(before, absent);  // earlier corners without the attribute
    out.resize(before + primitive.triangles.size());
    ordered_chunks(primitive.triangles.size(), kCornersBetweenReports, progress_,
                   [&](IndexRange range) {
                     for (std::size_t i = range.begin; i < range.end; ++i) {
                       out[before + i] = in.empty() ? absent : convert(in[primitive.triangles[i]]);
                     }
                   });
  }

  void add_corners(const Primitive& primitive, std::uint32_t first_vertex) {
    CornerAttributes& attributes = soup_.attributes;
    add_values(attributes.normal, primitive.normals, primitive, glm::vec3(kAbsent),
               [](const glm::vec3& n) { return n; });
    add_values(attributes.texcoord, primitive.texcoords, primitive, glm::vec2(kAbsent),
               [](const glm::vec2& t) { return glm::vec2(t.x, 1.0F - t.y); });
    attributes.has_linear_color = true;
    add_values(attributes.color, primitive.colors, primitive, glm::u8vec4(255), color_bytes);
    const std::size_t before = soup_.corners.size();
    soup_.corners.resize(before + primitive.triangles.size());
    ordered_chunks(primitive.triangles.size(), kCornersBetweenReports, progress_,
                   [&](IndexRange range) {
                     for (std::size_t i = range.begin; i < range.end; ++i)
                       soup_.corners[before + i] = first_vertex + primitive.triangles[i];
                   });
  }

  /// Adds the distinct positions of a mesh and sets its corners to them.
  void join(const Array<glm::vec3>& positions, std::size_t first_corner) {
    const auto first_vertex = static_cast<std::uint32_t>(soup_.positions.size());
    const std::optional<Weld> joined =
        options_.weld ? joined_positions(positions, *options_.weld, soup_.report, progress_)
                      : std::nullopt;
    check_cancelled(progress_);
    if (!joined) {
      soup_.positions.insert(soup_.positions.end(), positions.begin(), positions.end());
    } else {
      for (const std::uint32_t v : joined->first)
        soup_.positions.push_back(positions[v]);
    }
    ordered_chunks(soup_.corners.size() - first_corner, kCornersBetweenReports, progress_,
                   [&](IndexRange range) {
                     for (std::size_t i = range.begin; i < range.end; ++i) {
                       std::uint32_t& corner = soup_.corners[first_corner + i];
                       corner = first_vertex + (joined ? joined->index[corner] : corner);
                     }
                   });
  }

  void begin_group(const Json& primitive, std::string_view name, std::size_t faces) {
    FaceGroup group{.object = std::string(name.substr(0, kMaxNameBytes))};
    if (const auto material = gltf_.find_number(primitive, "material")) {
      gltf_.element("materials", *material);
      if (*material < kMostGltfMaterials) group.material = static_cast<std::uint32_t>(*material);
    }
    const auto [entry, is_new] = group_ids_.try_emplace(
        {group.object, group.material}, static_cast<std::uint32_t>(group_ids_.size()));
    if (is_new) soup_.attributes.groups.push_back(std::move(group));
    soup_.attributes.group.resize(soup_.attributes.group.size() + faces, entry->second);
  }

  /// Drops a single group that says nothing.
  void keep_groups() {
    const std::vector<FaceGroup>& groups = soup_.attributes.groups;
    if (groups.size() > 1 || (groups.size() == 1 && groups.front() != FaceGroup())) return;
    soup_.attributes.group = {};
    soup_.attributes.groups.clear();
  }

  const ReadOptions& options_;
  glm::dvec3 origin_;
  double position_error_ = 0.0;
  NodeTransforms node_transforms_;
  PackedPrimitives packed_;
  Progress* progress_;
  const GltfWeights& weights_;
  GltfFile gltf_;
  std::vector<PlacedMesh> placed_;
  Soup soup_;
  GltfBudget budget_;
  std::map<std::pair<std::string, std::uint32_t>, std::uint32_t> group_ids_;
};

}  // namespace

Soup read_gltf(const MappedFile& file, const ReadOptions& options) {
  const GltfWeights& weights = weights_of(file);
  Stages stages(options.progress, {weights.document, 1.0 - weights.document});
  stages.next();
  GltfReader reader(file, options);
  stages.next();
  Soup soup = read_unchanged(reader.document(), [&] { return reader.run(); });
  const glm::dvec3 origin = choose_origin(soup.positions, reader.position_error());
  if (origin == glm::dvec3(0.0)) return soup;
  soup = {};
  return GltfReader(file, options, origin).run();
}

}  // namespace mesher::io
