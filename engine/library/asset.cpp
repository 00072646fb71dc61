#include <mesher/asset.h>
#include <mesher/error.h>

#include <atomic>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <utility>

#include "engine/core/text.h"
#include "engine/library/asset_data.h"
#include "engine/library/watch.h"
#include "engine/mesh/build/build.h"
#include "engine/mesh/creases.h"
#include "engine/mesh/statistics.h"

namespace mesher {
namespace {

std::array<float, 3> face_point(const glm::vec3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

Asset::Asset() {
  static const auto kEmpty = std::make_shared<Data>();
  data_ = kEmpty;
}

Asset::Asset(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
Asset::Asset(const Asset&) = default;
Asset::Asset(Asset&& other) noexcept : Asset() {
  data_.swap(other.data_);
}
Asset& Asset::operator=(const Asset&) = default;
Asset& Asset::operator=(Asset&& other) noexcept {
  data_ = std::exchange(other.data_, Asset().data_);
  return *this;
}
Asset::~Asset() = default;

Asset Asset::build(std::span<const std::array<float, 3>> positions,
                   std::span<const std::uint32_t> corners,
                   std::span<const std::uint32_t> face_sizes) {
  Soup soup;
  soup.positions.reserve(positions.size());
  for (const auto& [x, y, z] : positions)
    soup.positions.emplace_back(x, y, z);
  soup.corners.assign(corners.begin(), corners.end());
  if (face_sizes.empty() && corners.size() % 3 != 0) {
    throw InputError("the number of corners of triangles is not a multiple of three");
  }
  if (!face_sizes.empty()) {
    std::uint64_t sum = 0;
    soup.face_start.push_back(0);
    for (const std::uint32_t size : face_sizes) {
      sum += size;
      soup.face_start.push_back(static_cast<std::uint32_t>(sum));
    }
    if (sum != corners.size()) throw InputError("the sizes of the faces are not those of corners");
  }
  BuildResult built = build_mesh(std::move(soup));
  auto data = std::make_shared<Data>();
  data->model.mesh = std::move(built.mesh);
  data->model.report = built.report;
  return Asset(std::move(data));
}

std::uint32_t Asset::vertex_count() const {
  return data_->model.mesh.vertex_count();
}

std::uint32_t Asset::face_count() const {
  return data_->model.mesh.face_count();
}

std::span<const std::array<float, 3>> Asset::positions() const {
  return face_positions(data_->model.mesh);
}

std::span<const std::uint32_t> Asset::indices() const {
  return face_ids(data_->model.mesh.origins());
}

std::span<const std::uint32_t> Asset::twins() const {
  return face_ids(data_->model.mesh.twins());
}

std::span<const float> Asset::sharpnesses() const {
  return data_->model.mesh.sharpnesses();
}

std::array<double, 3> Asset::origin() const {
  const glm::dvec3& origin = data_->model.origin;
  return {origin.x, origin.y, origin.z};
}

std::vector<std::string> Asset::attributes() const {
  std::vector<std::string> texts;
  for (const AttributeLayer& layer : data_->model.attributes.layers)
    texts.push_back(type_text(layer.type()));
  return texts;
}

std::vector<RepairCount> Asset::repairs() const {
  std::vector<RepairCount> repairs;
  for (const auto& [repair, text] : kRepairs) {
    const std::uint64_t count = data_->model.report[repair];
    if (count == 0) continue;
    repairs.push_back(
        {text.key, count_phrase(static_cast<std::int64_t>(count), text.label), count});
  }
  return repairs;
}

MeshStatistics Asset::statistics() const {
  const Statistics s = mesher::statistics(data_->model.mesh);
  MeshStatistics result{.vertices = s.vertices,
                        .edges = s.edges,
                        .faces = s.faces,
                        .boundary_edges = s.boundary_edges,
                        .boundary_loops = s.boundary_loops,
                        .components = s.components,
                        .crease_edges = s.crease_edges,
                        .euler_characteristic = s.euler_characteristic,
                        .area = s.area,
                        .volume = s.volume};
  if (s.box.is_empty()) return result;
  result.box_min = face_point(s.box.min);
  result.box_max = face_point(s.box.max);
  result.diagonal = s.box.diagonal();
  return result;
}

/// Returns data that no other asset shares.
Asset::Data& Asset::own_data() {
  if (data_.use_count() > 1) {
    data_ = std::make_shared<Data>(*data_);
  } else {
    // Another thread may just have read the copy that it dropped.
    std::atomic_thread_fence(std::memory_order_acquire);
  }
  // All data are created without const.
  return const_cast<Data&>(*data_);
}

void Asset::tag_creases(float angle_deg) {
  tag_creases_by_angle(own_data().model.mesh, glm::radians(angle_deg));
}

bool Asset::set_crease(std::uint32_t a, std::uint32_t b, float sharpness) {
  const Edge edge = data_->model.mesh.find_edge(Vertex(a), Vertex(b));
  if (!edge.is_valid()) return false;
  own_data().model.mesh.set_sharpness(edge, sharpness);
  return true;
}

}  // namespace mesher
