#include "engine/io/gltf_pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

/// Sets the last row, which glTF prescribes.
void make_affine(glm::dmat4& matrix) {
  for (int i = 0; i < 4; ++i)
    matrix[i][3] = i == 3 ? 1.0 : 0.0;
}

/// Returns all values of an accessor named in an object, or nothing.
Array<float> values_of(GltfFile& gltf, const Json& object, const char* key, std::size_t components,
                       std::size_t first, std::size_t count) {
  const auto accessor = gltf.find_number(object, key);
  return accessor ? gltf.floats(*accessor, components, first, count) : Array<float>();
}

}  // namespace

scene::Transform node_transform(const GltfFile& gltf, const Json& node) {
  scene::Transform transform;
  if (const auto values = gltf.find_vector(node, "matrix", 16)) {
    glm::dmat4& matrix = transform.matrix.emplace(1.0);
    for (int i = 0; i < 16; ++i)
      matrix[i / 4][i % 4] = (*values)[static_cast<std::size_t>(i)];
    make_affine(matrix);
    return transform;
  }
  if (const auto t = gltf.find_vector(node, "translation", 3))
    transform.translation = {(*t)[0], (*t)[1], (*t)[2]};
  if (const auto q = gltf.find_vector(node, "rotation", 4))
    transform.rotation = glm::dquat((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
  if (const auto s = gltf.find_vector(node, "scale", 3))
    transform.scale = {(*s)[0], (*s)[1], (*s)[2]};
  return transform;
}

glm::dmat4 local_transform(const GltfFile& gltf, const Json& node) {
  return node_transform(gltf, node).to_matrix();
}

std::optional<std::vector<glm::dmat4>> instance_transforms(GltfFile& gltf, const Json& node,
                                                           std::size_t most) {
  const Json* const extension = gltf.extension(node, "EXT_mesh_gpu_instancing");
  if (extension == nullptr) return std::nullopt;
  const auto attributes = extension->find("attributes");
  if (attributes == extension->end() || !attributes->is_object()) {
    gltf.fail("instances have no attributes");
  }
  std::optional<std::size_t> count;
  for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"}) {
    const auto accessor = gltf.find_number(*attributes, key);
    if (!accessor) continue;
    const std::size_t own = gltf.element_count(*accessor);
    if (count && *count != own) gltf.fail("attributes of instances have different lengths");
    count = own;
  }
  if (!count) return std::nullopt;
  if (*count > most) gltf.fail("its meshes are instanced too often for the size of the file");
  const Array<float> t = values_of(gltf, *attributes, "TRANSLATION", 3, 0, *count);
  const Array<float> q = values_of(gltf, *attributes, "ROTATION", 4, 0, *count);
  const Array<float> s = values_of(gltf, *attributes, "SCALE", 3, 0, *count);
  std::vector<glm::dmat4> transforms;
  transforms.reserve(*count);
  for (std::size_t i = 0; i < *count; ++i) {
    const glm::dvec3 translation =
        t.empty() ? glm::dvec3(0.0) : glm::dvec3(t[3 * i], t[3 * i + 1], t[3 * i + 2]);
    const glm::dquat rotation =
        q.empty() ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                  : glm::dquat(q[4 * i + 3], q[4 * i], q[4 * i + 1], q[4 * i + 2]);
    const glm::dvec3 scale =
        s.empty() ? glm::dvec3(1.0) : glm::dvec3(s[3 * i], s[3 * i + 1], s[3 * i + 2]);
    transforms.push_back(
        scene::Transform{.translation = translation, .rotation = rotation, .scale = scale}
            .to_matrix());
  }
  return transforms;
}

scene::Skin read_skin(GltfFile& gltf, std::uint64_t skin) {
  const Json& json = gltf.element("skins", skin);
  const auto joints = json.find("joints");
  if (joints == json.end() || !joints->is_array()) gltf.fail("a skin has no joints");
  Array<float> inverse;
  if (const auto accessor = gltf.find_number(json, "inverseBindMatrices")) {
    inverse = gltf.floats(*accessor, 16, 0, joints->size());
  }
  scene::Skin result;
  for (std::size_t j = 0; j < joints->size(); ++j) {
    if (!(*joints)[j].is_number_unsigned()) gltf.fail("a joint is not a node");
    const auto node = (*joints)[j].get<std::uint64_t>();
    gltf.element("nodes", node);
    result.joints.push_back(static_cast<std::uint32_t>(node));
    glm::dmat4& bind = result.inverse_binds.emplace_back(1.0);
    for (std::size_t i = 0; i < 16 && !inverse.empty(); ++i)
      bind[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = double(inverse[16 * j + i]);
    make_affine(bind);
  }
  return result;
}

std::vector<glm::dmat4> joint_transforms(GltfFile& gltf, std::uint64_t skin,
                                         const NodeTransforms& nodes) {
  const scene::Skin read = read_skin(gltf, skin);
  std::vector<glm::dmat4> transforms;
  for (std::size_t j = 0; j < read.joints.size(); ++j) {
    const auto placed = nodes.find(read.joints[j]);
    const glm::dmat4 matrix = placed != nodes.end()
                                  ? placed->second
                                  : local_transform(gltf, gltf.element("nodes", read.joints[j]));
    transforms.push_back(matrix * read.inverse_binds[j]);
  }
  return transforms;
}

std::vector<glm::dmat4> vertex_transforms(
    const GltfFile& gltf, const std::function<Array<float>(const std::string&)>& values,
    const std::vector<glm::dmat4>& joints, std::size_t count) {
  std::vector<glm::dmat4> transforms;
  std::vector<double> sums;
  for (int set = 0;; ++set) {
    const std::string number = std::to_string(set);
    const Array<float> indices = values("JOINTS_" + number);
    const Array<float> weights = values("WEIGHTS_" + number);
    if (indices.empty() || weights.empty()) break;
    transforms.resize(count, glm::dmat4(0.0));
    sums.resize(count, 0.0);
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const auto weight = static_cast<double>(weights[i]);
      if (!(weight > 0.0) || !std::isfinite(weight)) continue;
      // Written so that NaN is refused too.
      if (!(indices[i] >= 0.0F && static_cast<double>(indices[i]) < double(joints.size()))) {
        gltf.fail("a vertex follows a joint that does not exist");
      }
      transforms[i / 4] += weight * joints[static_cast<std::size_t>(indices[i])];
      sums[i / 4] += weight;
    }
  }
  for (std::size_t v = 0; v < transforms.size(); ++v) {
    transforms[v] = sums[v] > 0.0 ? transforms[v] / sums[v] : glm::dmat4(1.0);
  }
  return transforms;
}

void add_morph_targets(GltfFile& gltf, const Json& primitive, const std::vector<double>& weights,
                       const char* key, std::size_t first, Array<glm::vec3>& values) {
  const auto targets = primitive.find("targets");
  if (values.empty() || targets == primitive.end() || !targets->is_array()) return;
  for (std::size_t i = 0; i < std::min(targets->size(), weights.size()); ++i) {
    if (weights[i] == 0.0 || !(*targets)[i].is_object()) continue;
    const Array<float> deltas = values_of(gltf, (*targets)[i], key, 3, first, values.size());
    for (std::size_t v = 0; 3 * v < deltas.size(); ++v) {
      for (int c = 0; c < 3; ++c) {
        values[v][c] =
            static_cast<float>(double(values[v][c]) +
                               weights[i] * double(deltas[3 * v + static_cast<std::size_t>(c)]));
      }
    }
  }
}

std::vector<double> morph_weights(const GltfFile& gltf, const Json& node) {
  std::vector<double> weights;
  const auto read = [&](const Json& object) {
    const auto list = object.find("weights");
    if (list == object.end() || !list->is_array()) return false;
    for (const Json& weight : *list)
      weights.push_back(weight.is_number() ? weight.get<double>() : 0.0);
    return true;
  };
  const auto mesh = gltf.find_number(node, "mesh");
  if (!read(node) && mesh && *mesh < gltf.count("meshes")) read(gltf.element("meshes", *mesh));
  return weights;
}

void turn_normal(const glm::dmat3& of_normals, glm::vec3& n) {
  const glm::dvec3 turned = of_normals * glm::dvec3(n);
  const double length = glm::length(turned);
  if (length > 0.0) n = glm::vec3(turned / length);
}

}  // namespace mesher::io
