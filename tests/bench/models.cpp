#include "tests/bench/models.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/common.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace mesher::bench {
namespace {

glm::vec3 torus_point(std::uint32_t i, std::uint32_t j, std::uint32_t n) {
  const float step = 2.0F * std::numbers::pi_v<float> / static_cast<float>(n);
  const float u = step * static_cast<float>(i);
  const float v = step * static_cast<float>(j);
  const float tube = 0.4F + 0.03F * std::sin(17.0F * u) * std::sin(11.0F * v);
  const float ring = 1.0F + tube * std::cos(v);
  return {ring * std::cos(u), tube * std::sin(v), -ring * std::sin(u)};
}

/// A pseudorandom number in [-1, 1] for each point of the integer grid.
double lattice_value(glm::ivec3 p) {
  std::uint32_t hash = static_cast<std::uint32_t>(p.x) * 0x8DA6B343U ^
                       static_cast<std::uint32_t>(p.y) * 0xD8163841U ^
                       static_cast<std::uint32_t>(p.z) * 0xCB1AB31FU;
  hash = (hash ^ (hash >> 15)) * 0x2C1B3C6DU;
  hash = (hash ^ (hash >> 12)) * 0x297A2D39U;
  return (hash ^ (hash >> 15)) / 2147483647.5 - 1.0;
}

/// Smooth noise with a wavelength of about 1: interpolated grid values (K. Perlin, "An image
/// synthesizer", 1985).
double value_noise(const glm::dvec3& p) {
  const glm::dvec3 floor = glm::floor(p);
  const glm::dvec3 t = p - floor;
  const glm::dvec3 weight = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 w = glm::mix(1.0 - weight, weight, glm::dvec3(step));
    sum += w.x * w.y * w.z * lattice_value(glm::ivec3(floor) + step);
  }
  return sum;
}

glm::vec3 bumpy_torus_point(std::uint32_t i, std::uint32_t j, std::uint32_t n) {
  constexpr int kOctaves = 8;
  const double step = 2.0 * std::numbers::pi / n;
  const double u = step * i;
  const double v = step * j;
  const auto on_tube = [&](double tube) {
    const double ring = 1.0 + tube * std::cos(v);
    return glm::dvec3(ring * std::cos(u), tube * std::sin(v), -ring * std::sin(u));
  };
  const glm::dvec3 smooth = on_tube(0.4);
  double tube = 0.4;
  double frequency = 1.7;
  double height = 0.1;
  for (int octave = 0; octave < kOctaves; ++octave, frequency *= 2.0, height *= 0.45)
    tube += height * value_noise(frequency * smooth);
  return glm::vec3(on_tube(tube));
}

/// A torus of n x n quads, each split into two triangles.
template <class Point>
Soup torus_of(std::uint32_t n, Point point) {
  Soup soup;
  soup.positions.reserve(std::size_t{n} * n);
  soup.corners.reserve(std::size_t{6} * n * n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t row = i * n;
    const std::uint32_t next_row = (i + 1) % n * n;
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t k = (j + 1) % n;
      soup.positions.push_back(point(i, j, n));
      for (const std::uint32_t corner : {row + j, next_row + j, next_row + k}) {
        soup.corners.push_back(corner);
      }
      for (const std::uint32_t corner : {row + j, next_row + k, row + k}) {
        soup.corners.push_back(corner);
      }
    }
  }
  return soup;
}

/// A shuffle that is the same everywhere; std::shuffle differs between standard libraries.
std::vector<std::uint32_t> permutation(std::uint32_t n) {
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937 random(1);
  for (std::uint32_t i = n; i > 1; --i)
    std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

Soup torus(std::uint32_t n) {
  return torus_of(n, torus_point);
}

Soup bumpy_torus(std::uint32_t n) {
  return torus_of(n, bumpy_torus_point);
}

Soup triangles_of(const Mesh& mesh) {
  Soup soup;
  soup.positions.assign(mesh.positions().begin(), mesh.positions().end());
  soup.corners.resize(mesh.halfedge_count());
  std::ranges::transform(mesh.origins(), soup.corners.begin(), &Vertex::index);
  return soup;
}

Soup shuffled(const Soup& soup) {
  const auto vertices = static_cast<std::uint32_t>(soup.positions.size());
  const std::vector<std::uint32_t> vertex_order = permutation(vertices);
  Soup result;
  result.positions.resize(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    result.positions[vertex_order[v]] = soup.positions[v];
  }
  result.corners.reserve(soup.corners.size());
  for (const std::uint32_t f : permutation(soup.face_count())) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      result.corners.push_back(vertex_order[soup.corners[3 * std::size_t{f} + corner]]);
    }
  }
  return result;
}

void write_obj(const std::filesystem::path& file, std::uint64_t bytes, ObjContent content) {
  if (std::filesystem::exists(file)) return;
  const bool is_full = content == ObjContent::positions_texcoords_normals;
  // Approximate bytes of text per vertex of the grid, including its two faces.
  const double bytes_per_vertex = is_full ? 200.0 : 79.0;
  const Soup soup =
      torus(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(bytes) / bytes_per_vertex)));
  const std::filesystem::path temporary = file.string() + ".tmp";
  {
    std::ofstream out(temporary, std::ios::binary);
    char line[160];
    const auto put = [&](int length) { out.write(line, length); };
    for (const glm::vec3& p : soup.positions) {
      put(std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", double{p.x}, double{p.y},
                        double{p.z}));
      if (!is_full) continue;
      put(std::snprintf(line, sizeof line, "vt %.6f %.6f\n", 0.5 + 0.3 * double{p.x},
                        0.5 + 0.3 * double{p.z}));
      put(std::snprintf(line, sizeof line, "vn %.6f %.6f %.6f\n", double{p.x} / 2, double{p.y} / 2,
                        double{p.z} / 2));
    }
    for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
      const unsigned a = soup.corners[c] + 1;
      const unsigned b = soup.corners[c + 1] + 1;
      const unsigned d = soup.corners[c + 2] + 1;
      put(is_full ? std::snprintf(line, sizeof line, "f %u/%u/%u %u/%u/%u %u/%u/%u\n", a, a, a, b,
                                  b, b, d, d, d)
                  : std::snprintf(line, sizeof line, "f %u %u %u\n", a, b, d));
    }
    out.flush();
    if (!out) throw std::runtime_error("cannot write " + temporary.string());
  }
  std::filesystem::rename(temporary, file);
}

}  // namespace mesher::bench
