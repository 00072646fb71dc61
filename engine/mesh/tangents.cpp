#include "engine/mesh/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/unit_vector.h"

namespace mesher {
namespace {

constexpr std::size_t kTangentGrain = 1024;

/// Returns the part of a vector that is perpendicular to a normal, with length 1.
glm::dvec3 along_plane(const glm::dvec3& v, const glm::dvec3& normal) {
  return unit_or_zero(v - glm::dot(v, normal) * normal);
}

/// How a face lies in the texture.
struct TextureFrame {
  glm::dvec3 along_u{0.0};
  int orientation = 0;  ///< 1, or -1 if the texture is mirrored, or 0 without area
};

class Tangents {
 public:
  Tangents(const Mesh& mesh, std::span<const glm::vec3> normals,
           std::span<const glm::vec2> texcoords)
      : mesh_(mesh), normals_(normals), texcoords_(texcoords) {}

  void find_frames() {
    frames_.resize(mesh_.face_count());
    parallel_for_each(mesh_.face_count(), kTangentGrain,
                      [&](std::uint32_t f) { frames_[f] = frame_of(Face(f)); });
  }

  /// Sets the tangents of the corners at one vertex.
  void find_at(Vertex v, std::span<glm::vec4> tangents) const {
    if (mesh_.is_isolated(v)) return;
    std::vector<Halfedge> corners;
    Circulator at(mesh_, mesh_.outgoing(v));
    do {
      corners.push_back(*at);
    } while (at.advance());
    if (at.is_closed()) begin_at_border(corners);
    for (std::size_t begin = 0; begin < corners.size();) {
      int orientation = frame(corners[begin]).orientation;
      std::size_t end = begin + 1;
      for (; end < corners.size() && are_joined(corners[end - 1], corners[end]); ++end) {
        const int next = frame(corners[end]).orientation;
        if (orientation * next < 0) break;
        orientation = orientation != 0 ? orientation : next;
      }
      const std::span<const Halfedge> run = std::span(corners).subspan(begin, end - begin);
      const glm::vec3 tangent = tangent_of(run);
      if (tangent != glm::vec3(0.0F)) {
        for (const Halfedge h : run)
          tangents[h.index()] = glm::vec4(tangent, static_cast<float>(orientation));
      }
      begin = end;
    }
  }

 private:
  glm::dvec3 position(Halfedge h) const { return mesh_.position(mesh_.origin(h)); }
  const TextureFrame& frame(Halfedge h) const { return frames_[Mesh::face(h).index()]; }

  TextureFrame frame_of(Face f) const {
    const Halfedge a = Mesh::halfedge(f, 0);
    const Halfedge b = Mesh::halfedge(f, 1);
    const Halfedge c = Mesh::halfedge(f, 2);
    const auto texcoord = [&](Halfedge h) { return glm::dvec2(texcoords_[h.index()]); };
    const glm::dvec2 ab = texcoord(b) - texcoord(a);
    const glm::dvec2 ac = texcoord(c) - texcoord(a);
    // In float, as in MikkTSpace, so that the same thin faces have no area.
    const glm::vec2 float_ab(ab);
    const glm::vec2 float_ac(ac);
    const float area = float_ab.x * float_ac.y - float_ab.y * float_ac.x;
    const glm::dvec3 along_u =
        ac.y * (position(b) - position(a)) - ab.y * (position(c) - position(a));
    const glm::dvec3 along_v =
        ab.x * (position(c) - position(a)) - ac.x * (position(b) - position(a));
    TextureFrame frame;
    if (!(std::abs(area) > std::numeric_limits<float>::min()) || along_u == glm::dvec3(0.0) ||
        along_v == glm::dvec3(0.0))
      return frame;
    frame.orientation = area > 0.0F ? 1 : -1;
    frame.along_u = static_cast<double>(frame.orientation) * unit_or_zero(along_u);
    return frame;
  }

  bool agree(Halfedge a, Halfedge b) const {
    return normals_[a.index()] == normals_[b.index()] &&
           texcoords_[a.index()] == texcoords_[b.index()];
  }
  /// Returns whether two corners that follow one another around a vertex may share a tangent, apart
  /// from the orientation.
  bool are_joined(Halfedge first, Halfedge second) const {
    return agree(first, second) && agree(Mesh::prev(first), Mesh::next(second));
  }
  bool is_border(Halfedge first, Halfedge second) const {
    return !are_joined(first, second) || frame(first).orientation * frame(second).orientation < 0;
  }
  /// Rotates the corners around a vertex such that no run goes across the end.
  void begin_at_border(std::vector<Halfedge>& corners) const {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Halfedge before = i > 0 ? corners[i - 1] : corners.back();
      if (!is_border(before, corners[i])) continue;
      std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(i), corners.end());
      return;
    }
  }

  glm::vec3 tangent_of(std::span<const Halfedge> run) const {
    const glm::dvec3 normal(normals_[run.front().index()]);
    glm::dvec3 sum(0.0);
    for (const Halfedge h : run) {
      if (frame(h).orientation == 0) continue;
      const glm::dvec3 p = position(h);
      const glm::dvec3 next = along_plane(position(Mesh::next(h)) - p, normal);
      const glm::dvec3 prev = along_plane(position(Mesh::prev(h)) - p, normal);
      const double angle = std::acos(std::clamp(glm::dot(next, prev), -1.0, 1.0));
      sum += angle * along_plane(frame(h).along_u, normal);
    }
    return glm::vec3(unit_or_zero(sum));
  }

  const Mesh& mesh_;
  std::span<const glm::vec3> normals_;
  std::span<const glm::vec2> texcoords_;
  Array<TextureFrame> frames_;
};

}  // namespace

Array<glm::vec4> corner_tangents(const Mesh& mesh, std::span<const glm::vec3> normals,
                                 std::span<const glm::vec2> texcoords) {
  Array<glm::vec4> result;
  result.assign(mesh.halfedge_count(), glm::vec4(0.0F));
  Tangents tangents(mesh, normals, texcoords);
  tangents.find_frames();
  parallel_for_each(mesh.vertex_count(), kTangentGrain,
                    [&](std::uint32_t v) { tangents.find_at(Vertex(v), result); });
  return result;
}

}  // namespace mesher
