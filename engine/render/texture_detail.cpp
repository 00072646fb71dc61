#include "engine/render/texture_detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <limits>
#include <optional>

#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

/// Share of the pixels that may be magnified.
constexpr double kMagnifiedShare = 0.005;
constexpr double kMostMagnification = 1.4142;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A triangle as the picture shows it.
struct ShownTriangle {
  std::array<double, 3> nearness{};  ///< 1 / depth; 1 if there is no perspective
  glm::dmat2 edges{1.0};             ///< from the first corner to the others, in pixels
  double pixels = 0.0;               ///< its area
  bool is_front = false;             ///< it faces the viewer
};

/// Whether a triangle lies behind the eye at least in part, or shows no pixel.
enum class Place { shown, unseen, around_the_eye };

class PictureProjection {
 public:
  explicit PictureProjection(const PictureView& view)
      : size_(view.size), projection_(view.camera.places(size_)) {}

  Place place(const Mesh& mesh, std::uint32_t face, ShownTriangle& shown) const {
    std::array<glm::dvec2, 3> at;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const glm::dvec3 p(mesh.position(mesh.origin(Halfedge(3 * face + i))));
      const double depth = projection_.perspective ? projection_.depth(p) : 1.0;
      if (!(depth > 0.0)) return Place::around_the_eye;
      shown.nearness[i] = 1.0 / depth;
      at[i] = projection_.of(p);
    }
    shown.edges = {at[1] - at[0], at[2] - at[0]};
    // Rows of the picture count down.
    const double turned = glm::determinant(shown.edges);
    shown.is_front = turned < 0.0;
    shown.pixels = 0.5 * std::abs(turned);
    const glm::dvec2 least = glm::min(glm::min(at[0], at[1]), at[2]);
    const glm::dvec2 most = glm::max(glm::max(at[0], at[1]), at[2]);
    const bool is_inside =
        most.x >= 0.0 && most.y >= 0.0 && least.x <= size_.x && least.y <= size_.y;
    return is_inside && shown.pixels > 0.0 ? Place::shown : Place::unseen;
  }

 private:
  glm::dvec2 size_;
  WindowProjection projection_;
};

/// Returns a lower bound of the larger difference of a texture coordinate between a pixel and its
/// neighbors. `values`: the coordinate at the corners.
///
/// With q = 1 / depth, u q and q are linear in the picture, so the gradient of u is
/// (grad(u q) q - u q grad(q)) / q^2, and each component of the numerator is linear too.
double least_step(const ShownTriangle& shown, const std::array<double, 3>& values) {
  const std::array<double, 3>& q = shown.nearness;
  const glm::dmat2 to_pixels = glm::inverse(glm::transpose(shown.edges));
  const glm::dvec2 grad_q = to_pixels * glm::dvec2(q[1] - q[0], q[2] - q[0]);
  const double first = values[0] * q[0];
  const glm::dvec2 grad_uq =
      to_pixels * glm::dvec2(values[1] * q[1] - first, values[2] * q[2] - first);
  glm::dvec2 least(kInfinity);
  glm::dvec2 most(-kInfinity);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 numerator = grad_uq * q[i] - values[i] * q[i] * grad_q;
    least = glm::min(least, numerator);
    most = glm::max(most, numerator);
  }
  const double nearest = std::max({q[0], q[1], q[2]});
  const glm::dvec2 bound = glm::max(glm::max(least, -most), glm::dvec2(0.0));
  return std::max(bound.x, bound.y) / (nearest * nearest);
}

/// How many pixels of the picture need how many pixels per side of an image: eight classes per
/// factor of two, up to 2^16.
class NeededSides {
 public:
  void add(double side, double pixels) {
    most_ = std::max(most_, side);
    const double place = std::clamp(kPerOctave * std::log2(side) + 1.0, 0.0, kClasses - 1.0);
    pixels_[static_cast<std::size_t>(place)] += pixels;
  }
  NeededSides& operator+=(const NeededSides& other) {
    most_ = std::max(most_, other.most_);
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      pixels_[i] += other.pixels_[i];
    return *this;
  }
  /// Returns the side that is enough.
  double side() const {
    double all = 0.0;
    for (const double pixels : pixels_)
      all += pixels;
    std::size_t i = pixels_.size() - 1;
    for (double magnified = pixels_[i]; i > 0 && magnified <= kMagnifiedShare * all;)
      magnified += pixels_[--i];
    return std::max(std::exp2(static_cast<double>(i) / kPerOctave), most_ / kMostMagnification);
  }

 private:
  static constexpr double kPerOctave = 8.0;
  static constexpr double kClasses = 16.0 * kPerOctave + 1.0;
  std::array<double, static_cast<std::size_t>(kClasses)> pixels_{};
  double most_ = 0.0;
};

using SidesByImage = std::vector<NeededSides>;

/// The texture coordinates of the corners of a face.
using FaceTexcoords = std::array<glm::dvec2, 3>;

class DetailOfFaces {
 public:
  DetailOfFaces(const Mesh& mesh, const Attributes& attributes, const DrawnMaterials& materials,
                const PictureView& picture)
      : mesh_(mesh), attributes_(attributes), materials_(materials), projection_(picture) {
    for (std::uint32_t i = 0; i < shared::kTexcoordSets; ++i)
      layers_[i] = attributes.find(texcoord_type(i).name);
  }

  void add(std::uint32_t face, SidesByImage& sides) const {
    ShownTriangle shown;
    const Place place = projection_.place(mesh_, face, shown);
    if (place == Place::unseen) return;
    const std::size_t number = material_of(face);
    const bool is_culled = place == Place::shown && !shown.is_front;
    if (is_culled && !materials_.is_two_sided[number]) return;
    const PackedMaterial& material = materials_.packed[number];
    const shared::TextureUse* last = nullptr;
    double side = kInfinity;
    for (std::size_t i = 0; i < material.textures.size(); ++i) {
      if (material.textures[i].image == kNone) continue;
      const shared::TextureUse& use = material.block.textures[i];
      const bool is_minified_in_levels = material.samplers[i].has_mipmaps;
      if (place == Place::around_the_eye || !is_minified_in_levels) {
        sides[material.textures[i].image].add(kInfinity, shown.pixels);
        continue;
      }
      // Most textures of a material have the same coordinates.
      const bool is_same = last != nullptr && last->slot == use.slot && last->matrix == use.matrix;
      if (!is_same) side = side_of(face, material.block, use, shown);
      last = &use;
      sides[material.textures[i].image].add(side, shown.pixels);
    }
  }

 private:
  std::size_t material_of(std::uint32_t face) const {
    const std::uint32_t material =
        attributes_.group.empty() ? kNone : attributes_.groups[attributes_.group[face]].material;
    return std::min<std::size_t>(material, materials_.packed.size() - 1);
  }

  double side_of(std::uint32_t face, const shared::MaterialBlock& block,
                 const shared::TextureUse& use, const ShownTriangle& shown) const {
    const std::uint32_t set = block.sets >> 8 * use.slot & 0xFFU;
    const AttributeLayer& layer = *layers_[set];
    std::array<double, 3> u{};
    std::array<double, 3> v{};
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Wedge wedge = attributes_.wedge(mesh_.origins(), Halfedge(3 * face + i));
      const AttributeValue value = load(layer, wedge.index());
      u[i] = use.matrix[0] * value[0] + use.matrix[2] * value[1];
      v[i] = use.matrix[1] * value[0] + use.matrix[3] * value[1];
    }
    const double step = std::max(least_step(shown, u), least_step(shown, v));
    return step > 0.0 ? 1.0 / step : kInfinity;
  }

  const Mesh& mesh_;
  const Attributes& attributes_;
  const DrawnMaterials& materials_;
  PictureProjection projection_;
  std::array<const AttributeLayer*, shared::kTexcoordSets> layers_{};
};

std::size_t image_count(std::span<const PackedMaterial> packed) {
  std::size_t count = 0;
  for (const PackedMaterial& material : packed) {
    for (const TextureKey& key : material.textures)
      if (key.image != kNone) count = std::max<std::size_t>(count, key.image + std::size_t{1});
  }
  return count;
}

}  // namespace

std::vector<float> needed_sides(const Mesh& mesh, const Attributes& attributes,
                                const DrawnMaterials& materials, const PictureView& picture) {
  const DetailOfFaces detail(mesh, attributes, materials, picture);
  const std::size_t images = image_count(materials.packed);
  constexpr std::size_t kFacesAtOnce = std::size_t{1} << 14U;
  std::vector<SidesByImage> parts(chunk_count(mesh.face_count(), kFacesAtOnce));
  parallel_chunks(mesh.face_count(), kFacesAtOnce, [&](std::size_t chunk, IndexRange faces) {
    parts[chunk].resize(images);
    for (std::size_t face = faces.begin; face < faces.end; ++face)
      detail.add(static_cast<std::uint32_t>(face), parts[chunk]);
  });
  std::vector<float> sides;
  for (std::size_t image = 0; image < images; ++image) {
    NeededSides sum;
    for (const SidesByImage& part : parts)
      sum += part[image];
    sides.push_back(static_cast<float>(sum.side()));
  }
  return sides;
}

}  // namespace mesher::render
