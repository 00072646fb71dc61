#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "engine/io/block_writer.h"
#include "engine/io/polygon_write.h"

namespace mesher::io {
namespace {

struct Facet {
  glm::vec3 normal;
  glm::vec3 corners[3];
};

Facet facet_of(const Mesh& mesh, const glm::dvec3& origin, std::size_t f) {
  Facet facet = {};
  // In double: products of small or large coordinates would leave the range of float.
  glm::dvec3 local[3];
  for (std::size_t c = 0; c < 3; ++c) {
    local[c] = glm::dvec3(mesh.position(mesh.origins()[3 * f + c]));
    facet.corners[c] = glm::vec3(origin + local[c]);
  }
  const glm::dvec3 area = glm::cross(local[1] - local[0], local[2] - local[0]);
  const double length = glm::length(area);
  facet.normal = length > 0.0 ? glm::vec3(area / length) : glm::vec3(0.0F);
  return facet;
}

void append_vector(Appender& out, const glm::vec3& v) {
  out << ' ' << v.x << ' ' << v.y << ' ' << v.z << '\n';
}

void write_text(AtomicFile& file, const Mesh& mesh, const glm::dvec3& origin, Progress* progress) {
  file.write("solid mesher\n");
  constexpr std::size_t kMostBytes = 128 + 12 * 16;
  write_elements(file, mesh.face_count(), kMostBytes, progress, [&](Appender& out, std::size_t f) {
    const Facet facet = facet_of(mesh, origin, f);
    out << "facet normal";
    append_vector(out, facet.normal);
    out << "  outer loop\n";
    for (const glm::vec3& corner : facet.corners) {
      out << "    vertex";
      append_vector(out, corner);
    }
    out << "  endloop\nendfacet\n";
  });
  file.write("endsolid mesher\n");
}

void write_binary(AtomicFile& file, const Mesh& mesh, const glm::dvec3& origin,
                  Progress* progress) {
  std::string header = "binary STL written by mesher";
  header.resize(80, ' ');
  const std::uint32_t facets = mesh.face_count();
  header.append(reinterpret_cast<const char*>(&facets), sizeof facets);
  file.write(header);
  write_elements(file, facets, 50, progress, [&](Appender& out, std::size_t f) {
    out.raw(facet_of(mesh, origin, f)).raw(std::uint16_t{0});
  });
}

}  // namespace

void write_stl(AtomicFile& file, const Mesh& mesh, const glm::dvec3& origin, bool ascii,
               Progress* progress) {
  if (ascii) {
    write_text(file, mesh, origin, progress);
  } else {
    write_binary(file, mesh, origin, progress);
  }
}

}  // namespace mesher::io
