#include "engine/render/gpu_normals.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <optional>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/packed_normal.h"

namespace mesher::render {
namespace {

constexpr std::size_t kGrain = 1U << 14;

CornerNormalOptions options_of(const Settings& settings) {
  return {.weight = settings.normal_weight,
          .crease_angle_rad = glm::radians(settings.crease_angle_deg)};
}

GpuNormals::Mode wanted_mode(const Settings& settings, const NormalSource& source) {
  if (settings.shading != Shading::gouraud) return GpuNormals::Mode::none;
  if (!source.vertex.empty()) return GpuNormals::Mode::vertex;
  const bool can_split =
      !source.corner.empty() || source.can_split || settings.crease_angle_deg < 180.0F;
  return can_split ? GpuNormals::Mode::corner : GpuNormals::Mode::vertex;
}

/// Returns the vertices whose normals the changes may have affected, sorted; none if that is most
/// vertices.
std::optional<std::vector<Vertex>> touched_vertices(const Mesh& mesh) {
  const ChangeLog& changes = mesh.changes();
  std::vector<Vertex> touched;
  const auto add_around = [&](GpuArray array, std::uint32_t i) {
    if (array == GpuArray::position) {  // the faces around it have changed shape
      touched.push_back(Vertex(i));
      for (const Vertex neighbor : vertices_around(mesh, Vertex(i)))
        touched.push_back(neighbor);
      return;
    }
    // The face has other corners, or an end of the edge has another fan or another split of its
    // fan.
    touched.push_back(mesh.origin(Halfedge(i)));
    touched.push_back(mesh.target(Halfedge(i)));
    if (array == GpuArray::origin) touched.push_back(mesh.origin(Mesh::prev(Halfedge(i))));
  };
  for (const GpuArray array : {GpuArray::position, GpuArray::origin, GpuArray::edge_class}) {
    if (changes.is_whole(array)) return std::nullopt;
    const std::uint32_t count =
        array == GpuArray::position ? mesh.vertex_count() : mesh.halfedge_count();
    for (const ChangedRange range : changes.merged(array, 0, count)) {
      if (touched.size() > mesh.vertex_count()) return std::nullopt;
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        add_around(array, i);
      }
    }
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

}  // namespace

GpuNormals::Origin GpuNormals::origin(const NormalSource& source) {
  if (!source.vertex.empty()) return Origin::vertices;
  return source.corner.empty() ? Origin::faces : Origin::corners;
}

void GpuNormals::update(const Mesh& mesh, const Settings& settings, const NormalSource& source,
                        bool is_new_mesh, UploadStats& stats) {
  const Mode wanted = wanted_mode(settings, source);
  const Origin from = wanted == Mode::none ? Origin::faces : origin(source);
  const CornerNormalOptions options = options_of(settings);
  const bool is_same =
      !is_new_mesh && wanted == mode_ && from == origin_ && options.weight == options_.weight &&
      (wanted != Mode::corner || options.crease_angle_rad == options_.crease_angle_rad);
  mode_ = wanted;
  origin_ = from;
  options_ = options;
  if (mode_ == Mode::none) {
    corner_ = {};
    packed_ = {};
    buffer_ = {};
    count_ = 0;
  } else if (origin_ == Origin::vertices) {
    take(mesh, source, is_same, stats);
  } else if (origin_ == Origin::corners) {
    if (is_same && mesh.changes().is_empty()) return;
    corner_ = {};
    buffer_ = {};
    pack(source.corner, stats);
  } else if (!is_same) {
    buffer_ = {};
    build(mesh, stats);
  } else {
    update_changed(mesh, stats);
  }
}

void GpuNormals::take(const Mesh& mesh, const NormalSource& source, bool is_same,
                      UploadStats& stats) {
  constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
  const auto normals = std::as_bytes(source.vertex);
  MESHER_ASSERT(source.vertex.size() == mesh.vertex_count());
  corner_ = {};
  packed_ = {};
  count_ = source.vertex.size();
  if (is_same) {
    upload_changes(device_, buffer_, normals,
                   {mesh.changes(), GpuArray::position, sizeof(std::uint32_t)}, kUsage, stats);
    return;
  }
  buffer_ = {};
  make_room(device_, buffer_, std::max(count_, source.most_vertices) * sizeof(std::uint32_t),
            kUsage);
  upload_whole(device_, buffer_, normals, kUsage, stats);
}

void GpuNormals::build(const Mesh& mesh, UploadStats& stats) {
  corner_ = {};
  Array<glm::vec3> normals = mode_ == Mode::vertex ? vertex_normals(mesh, options_.weight)
                                                   : corner_normals(mesh, options_);
  pack(normals, stats);
  if (mode_ == Mode::corner) corner_ = std::move(normals);
}

void GpuNormals::pack(std::span<const glm::vec3> normals, UploadStats& stats) {
  packed_.resize(normals.size());
  count_ = packed_.size();
  parallel_for(normals.size(), kGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      packed_[i] = encode_normal(normals[i]);
  });
  upload_whole(device_, buffer_, std::as_bytes(std::span(packed_)),
               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, stats);
}

void GpuNormals::update_changed(const Mesh& mesh, UploadStats& stats) {
  const std::optional<std::vector<Vertex>> touched = touched_vertices(mesh);
  if (!touched) return build(mesh, stats);
  packed_.resize(mode_ == Mode::vertex ? mesh.vertex_count() : mesh.halfedge_count());
  count_ = packed_.size();
  if (mode_ == Mode::corner) corner_.resize(mesh.halfedge_count());
  ChangeLog log;  // sorts and merges; counts normals here
  const auto store = [&](std::uint32_t i, const glm::vec3& normal) {
    packed_[i] = encode_normal(normal);
    log.note(GpuArray::position, i);
  };
  for (const Vertex v : *touched) {
    if (mode_ == Mode::vertex) {
      store(v.index(), vertex_normal(mesh, v, options_.weight));
      continue;
    }
    update_corner_normals(mesh, v, options_, corner_);
    for (const Halfedge h : halfedges_around(mesh, v))
      store(h.index(), corner_[h.index()]);
  }
  upload_changes(device_, buffer_, std::as_bytes(std::span(packed_)),
                 {log, GpuArray::position, sizeof(std::uint32_t)},
                 VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, stats);
}

}  // namespace mesher::render
