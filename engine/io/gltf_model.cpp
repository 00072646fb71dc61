#include "engine/io/gltf_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/far_origin.h"
#include "engine/io/gltf_animation.h"
#include "engine/io/gltf_materials.h"
#include "engine/io/gltf_mesh.h"
#include "engine/io/gltf_rewrite.h"
#include "engine/io/gltf_scene.h"
#include "engine/mesh/layer_types.h"
#include "engine/mesh/parts.h"
#include "engine/scene/influences.h"
#include "engine/scene/placed.h"
#include "engine/scene/transform.h"

namespace mesher::io {
namespace {

/// What a copy costs besides its faces, in faces.
constexpr std::uint64_t kFacesPerCopy = 100;
/// Bytes of attributes that meshes may gain by sharing their layers: those of one are laid out for
/// all.
constexpr std::uint64_t kMostLayerBytes = std::uint64_t{1} << 30U;
/// Times of finding what was edited, of planning the file, and of writing it.
constexpr double kModelWriteWeights[] = {0.4, 0.3, 0.3};

/// The document that a model was read from, in memory, so that it can be written again even when
/// another program has changed its file.
class GltfSource final : public scene::Source {
 public:
  GltfSource(const std::filesystem::path& file, const ReadOptions& how)
      : scene(file, how, Keep::copied), options(how) {
    options.progress = nullptr;
  }
  GltfScene scene;
  ReadOptions options;    ///< how the meshes were read
  std::mutex is_writing;  ///< the document opens buffers when it needs them
};

/// Returns the mean of the joints' matrices, weighted by the vertices that follow them.
glm::dmat4 mean_joint(const std::vector<glm::dmat4>& joints, const Shape& shape) {
  const scene::Influences influences = scene::influences_of(shape);
  std::vector<double> weights(joints.size(), 0.0);
  for (const auto& [joint, weight] : influences.list)
    weights[joint < joints.size() ? joint : 0] += double(weight);
  double sum = 0.0;
  glm::dmat4 mean(0.0);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    mean += weights[j] * joints[j];
    sum += weights[j];
  }
  return sum > 0.0 ? mean / sum : joints.front();
}

/// Returns whether positions stay numbers when they are transformed, and can be transformed back.
bool can_hold(const Mesh& mesh, const glm::dmat4& transform) {
  if (!scene::is_invertible(transform)) return false;
  const Box own = bounding_box(mesh);
  Box box;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1U) != 0 ? own.max.x : own.min.x,
                       (corner & 2U) != 0 ? own.max.y : own.min.y,
                       (corner & 4U) != 0 ? own.max.z : own.min.z);
    const glm::vec3 q(transform * glm::dvec4(p, 1.0));
    if (!is_finite(q)) return false;
    extend(box, q);
  }
  if (!is_finite(box.max - box.min)) return false;
  // Further away, not even positions about an origin would keep their digits.
  constexpr double kFurthest = 1e9;  // in sizes of the mesh
  double size = 0.0;
  for (int i = 0; i < 3; ++i)
    size = std::max(size, glm::length(glm::dvec3(transform[i])) * own.diagonal());
  return glm::length(glm::dvec3(transform[3])) <= kFurthest * size;
}

/// If all joints agree, their mean is one of them, to the last bit.
glm::dmat4 common_joint(const std::vector<glm::dmat4>& joints, const Shape& shape) {
  const bool is_rigid =
      std::ranges::all_of(joints, [&](const glm::dmat4& joint) { return joint == joints.front(); });
  return is_rigid ? joints.front() : mean_joint(joints, shape);
}

glm::dmat4 to_model(const scene::SceneMesh& mesh, const glm::dvec3& origin) {
  if (origin == glm::dvec3(0.0)) return mesh.to_scene;
  return glm::translate(glm::dmat4(1.0), -origin) * mesh.to_scene;
}

/// Returns the origin about which the meshes keep the digits of their places.
glm::dvec3 origin_for(const std::vector<Shape>& shapes, const scene::Scene& scene) {
  Array<glm::vec3> positions;
  double error = 0.0;
  for (std::size_t m = 0; m < shapes.size(); ++m) {
    const glm::dmat4& transform = scene.meshes[m].to_scene;
    for (const glm::vec3& p : shapes[m].mesh.positions()) {
      const glm::dvec3 wide(transform * glm::dvec4(glm::dvec3(p), 1.0));
      const glm::vec3 narrow(wide);
      positions.push_back(narrow);
      for (int i = 0; i < 3; ++i) {
        const double off = std::abs(wide[i] - static_cast<double>(narrow[i]));
        if (std::isfinite(off)) error = std::max(error, off);
      }
    }
  }
  return choose_origin(positions, error);
}

void set_mesh(std::uint32_t mesh, const std::string& object, Attributes& attributes) {
  for (FaceGroup& group : attributes.groups) {
    group.mesh = mesh;
    group.object = object;
  }
}

/// The name of the first node that shows a mesh, or its own.
const std::string& object_name(const scene::Scene& scene, const scene::SceneMesh& mesh) {
  if (mesh.placements.empty() || mesh.placements.front().node == kNone) return mesh.name;
  const std::string& name = scene.nodes[mesh.placements.front().node].name;
  return name.empty() ? mesh.name : name;
}

bool has_same_values(const AttributeLayer& layer, const AttributeLayer* original) {
  if (original == nullptr) {
    AttributeLayer absent(layer.type(), 1);
    store_absent(absent, 0);
    for (std::size_t i = 0; i < layer.count(); ++i) {
      if (!is_absent(layer, i) && !std::ranges::equal(layer.value(i), absent.value(0)))
        return false;
    }
    return true;
  }
  if (layer.type() == original->type()) return std::ranges::equal(layer.bytes(), original->bytes());
  AttributeLayer converted(layer.type(), 0);
  append_converted(converted, *original);
  return std::ranges::equal(layer.bytes(), converted.bytes());
}

/// Returns whether a mesh is what it was when it was read, as far as glTF holds it.
bool is_unedited(const Shape& shape, const Shape& original) {
  const Attributes& now = shape.attributes;
  const Attributes& before = original.attributes;
  return std::ranges::equal(shape.mesh.positions(), original.mesh.positions()) &&
         std::ranges::equal(shape.mesh.origins(), original.mesh.origins()) &&
         std::ranges::equal(now.corner_wedge, before.corner_wedge) &&
         std::ranges::equal(now.group, before.group) &&
         std::ranges::all_of(now.layers,
                             [&](const AttributeLayer& layer) {
                               return has_same_values(layer, before.find(layer.type().name));
                             }) &&
         std::ranges::all_of(before.layers, [&](const AttributeLayer& layer) {
           return now.find(layer.type().name) != nullptr;
         });
}

class ModelReader {
 public:
  ModelReader(const std::filesystem::path& file, const ReadOptions& options)
      : source_(std::make_shared<GltfSource>(file, options)) {
    model_.name = file.filename().string();
    model_.contents = source_->scene.contents();
    scene_ = source_->scene.graph();
  }

  /// Returns nothing if the meshes differ so much in their attributes that one model of them would
  /// take too much memory.
  std::optional<Model> run(const ReadOptions& options) {
    std::vector<Shape> shapes = read_shapes(options);
    if (joined_layer_bytes(shapes) > kMostLayerBytes) return std::nullopt;
    scene_.origin = origin_for(shapes, scene_);
    std::vector<Shape> parts;
    for (std::size_t m = 0; m < shapes.size(); ++m) {
      if (!scene_.meshes[m].has_faces) continue;
      scene::apply(to_model(scene_.meshes[m], scene_.origin), shapes[m]);
      set_mesh(static_cast<std::uint32_t>(m), object_name(scene_, scene_.meshes[m]),
               shapes[m].attributes);
      parts.push_back(std::move(shapes[m]));
    }
    if (parts.empty()) source_->scene.document().fail("no triangles");
    Shape all = joined(std::move(parts));
    model_.mesh = std::move(all.mesh);
    model_.attributes = std::move(all.attributes);
    model_.materials = read_gltf_materials(source_->scene.document(), model_.contents);
    model_.origin = scene_.origin;
    read_animations();
    scene_.source = source_;
    model_.scene = std::make_shared<const scene::Scene>(std::move(scene_));
    return std::move(model_);
  }

 private:
  /// The shape is whole without them.
  void read_animations() {
    try {
      scene_.animations = read_gltf_animations(source_->scene.document());
    } catch (const InputError& error) {
      model_.contents.warn("animations cannot be played: " + error.reason());
    }
  }

  /// The meshes in their own coordinates, by their numbers in the document.
  std::vector<Shape> read_shapes(const ReadOptions& options) {
    const std::vector<glm::dmat4> nodes = node_transforms(scene_);
    std::vector<Shape> shapes(scene_.meshes.size());
    for (GltfSceneMesh& read : source_->scene.read_meshes(options)) {
      Shape& shape = shapes[read.index];
      shape = {std::move(read.model.mesh), std::move(read.model.attributes)};
      model_.report += read.model.report;
      scene::SceneMesh& mesh = scene_.meshes[read.index];
      mesh.has_faces = true;
      if (mesh.placements.empty()) continue;
      const auto joints = mesh_transforms(scene_, mesh.placements.front(), nodes);
      const glm::dmat4 mean = common_joint(joints, shape);
      mesh.to_scene = can_hold(shape.mesh, mean) ? mean : glm::dmat4(1.0);
    }
    place_if_none_is();
    limit_copies(shapes);
    return shapes;
  }

  /// A scene that shows no triangles shows each mesh where it is.
  void place_if_none_is() {
    const bool shows_any = std::ranges::any_of(scene_.meshes, [](const scene::SceneMesh& mesh) {
      return mesh.has_faces && !mesh.placements.empty();
    });
    for (scene::SceneMesh& mesh : scene_.meshes) {
      if (!shows_any && mesh.has_faces) mesh.placements.emplace_back();
    }
  }

  /// Shows each mesh once if there would be too much to draw. The file keeps its instances.
  void limit_copies(const std::vector<Shape>& shapes) {
    std::uint64_t faces = 0;
    bool has_copies = false;
    for (std::size_t m = 0; m < shapes.size(); ++m) {
      const std::size_t places = scene_.meshes[m].placements.size();
      if (places <= 1 || shapes[m].mesh.face_count() == 0) continue;
      has_copies = true;
      faces += places * (shapes[m].mesh.face_count() + kFacesPerCopy + joints_of(scene_.meshes[m]));
    }
    if (!has_copies || faces <= scene::kMostCopiedFaces) return;
    for (scene::SceneMesh& mesh : scene_.meshes)
      mesh.placements.resize(std::min<std::size_t>(mesh.placements.size(), 1));
    model_.contents.warn(fmt::format(
        "its meshes are shown once each: all instances together would take as long as {} faces, "
        "and more than {} are not drawn",
        faces, scene::kMostCopiedFaces));
  }

  std::size_t joints_of(const scene::SceneMesh& mesh) const {
    const std::uint32_t node = mesh.placements.front().node;
    const std::uint32_t skin = node == kNone ? kNone : scene_.nodes[node].skin;
    return skin == kNone ? 0 : scene_.skins[skin].joints.size();
  }

  std::shared_ptr<GltfSource> source_;
  scene::Scene scene_;
  Model model_;
};

/// Returns the edited meshes of a shape in their own coordinates, by their numbers.
std::vector<std::pair<std::uint64_t, Shape>> edited_meshes(GltfSource& source, const Shape& shape,
                                                           const scene::Scene& scene,
                                                           Progress* progress) {
  std::vector<Shape> now = split(shape.mesh, shape.attributes,
                                 scene::mesh_of_groups(shape.attributes), scene.meshes.size());
  ReadOptions options = source.options;
  options.progress = progress;
  options.keep_isolated_vertices = false;  // no part has them
  std::vector<std::pair<std::uint64_t, Shape>> edited;
  for (GltfSceneMesh& read : source.scene.read_meshes(options)) {
    const glm::dmat4 transform = to_model(scene.meshes[read.index], scene.origin);
    Shape original{std::move(read.model.mesh), std::move(read.model.attributes)};
    scene::apply(transform, original);
    Shape& mesh = now[read.index];
    if (is_unedited(mesh, original)) continue;
    scene::apply(glm::inverse(transform), mesh);
    edited.emplace_back(read.index, std::move(mesh));
  }
  return edited;
}

}  // namespace

Model read_gltf_model(const std::filesystem::path& file, const ReadOptions& options) {
  if (std::optional<Model> model = ModelReader(file, options).run(options))
    return std::move(*model);
  ReadOptions without_scene = options;
  without_scene.keeps_scene = false;
  Model model = read_model(file, without_scene);
  model.contents.warn(
      "opened as one mesh: its meshes have so many different attributes that the scene would take "
      "too much memory");
  return model;
}

std::vector<std::string> write_gltf_model(AtomicFile& file, const Shape& shape,
                                          const scene::Scene& scene, bool binary,
                                          Progress* progress) {
  auto& source = dynamic_cast<GltfSource&>(*scene.source);
  const std::lock_guard lock(source.is_writing);
  Stages stages(progress, kModelWriteWeights);
  stages.next();
  const auto edited = edited_meshes(source, shape, scene, progress);
  std::vector<GltfMeshEdit> edits;
  std::vector<std::string> kept;
  for (const auto& [number, mesh] : edited) {
    if (mesh.mesh.face_count() > 0) {
      edits.push_back({.mesh = number, .levels = {{&mesh.mesh, &mesh.attributes}}});
    } else {
      kept.push_back(fmt::format("the removal of mesh {} '{}', which is written as it was", number,
                                 scene.meshes[number].name));
    }
  }
  stages.next();
  const GltfRewriter rewriter(source.scene.document(), edits, false, progress);
  stages.next();
  rewriter.write(file, binary, progress);
  std::vector<std::string> losses = rewriter.losses();
  losses.insert(losses.end(), kept.begin(), kept.end());
  return losses;
}

}  // namespace mesher::io
