#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/image.h"
#include "engine/core/image_request.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/change_log.h"
#include "engine/mesh/geomorph.h"
#include "engine/mesh/material.h"
#include "engine/mesh/statistics.h"
#include "engine/render/picture_view.h"
#include "shaders/shared/constants.h"

namespace mesher::render {

/// The data to draw a mesh during a geomorph: see SplitMorph.
struct MorphSource {
  /// One per vertex. A head may change only if the mesh's change log lists that vertex's position
  /// as changed.
  std::span<const std::uint32_t> heads;
  /// Splits must stay the same between calls; more may be appended. Otherwise it is another mesh
  /// (GpuMesh::invalidate). Their normals count only if Sources::vertex_normals is set. They may
  /// change after calls without vertex normals, because the normals are unknown while splits
  /// arrive.
  std::span<const SplitMorph> splits;

  bool is_empty() const { return heads.empty() || splits.empty(); }
  /// Returns the number of splits after the level of the heads. The last vertex's head is the split
  /// that created it.
  std::size_t splits_to_come() const {
    if (is_empty()) return 0;
    return splits.size() - (heads.back() == kNoHead ? 0 : heads.back() / 2 + std::size_t{1});
  }
};

/// Decodes images of Materials::images, and passes each on as soon as it is there. Images that
/// cannot be decoded are not passed on: they are drawn white.
using DecodeImages =
    std::function<void(std::span<const ImageRequest> requests, const TakeImage& take)>;

/// How the vertices of a mesh are moved when they are drawn: each by the mean of some matrices.
struct PoseSource {
  /// Three rows of each matrix; they may change between calls.
  std::span<const glm::vec4> palette;
  /// The same number for every vertex. They may change only with the mesh.
  std::span<const shared::PoseInfluence> influences;
  Box box;  ///< around all that is drawn

  bool is_empty() const { return influences.empty(); }
};

/// What the surface of a mesh looks like.
struct Appearance {
  /// May change only with the positions or origins of the mesh; null: the mesh is drawn as clay.
  const Attributes* attributes = nullptr;
  std::shared_ptr<const Materials> materials;  ///< may be null; must not change behind the pointer
  DecodeImages decode;                         ///< called for the images that the look needs
  /// The only picture of this mesh that will be drawn: textures get no more pixels than it needs.
  std::optional<PictureView> picture{};
  /// Set if the attributes are those of a level of a progressive mesh
  /// (progressive::ProgressiveAttributes::arrays). It lists which elements of corner_wedge and
  /// wedge_value have changed since the last call, which cleared it; all others are the same,
  /// unless the mesh is new.
  ChangeLog* changes = nullptr;
  /// How such attributes move during a geomorph: their heads may change only for wedges whose
  /// values `changes` lists. May be empty.
  WedgeMorph morph{};
};

/// Inputs of a mirror besides the mesh. Each may be empty.
struct Sources {
  /// One per half-edge: used for Gouraud shading instead of the faces' normals. They may change
  /// only with the mesh.
  std::span<const glm::vec3> corner_normals;
  /// One per vertex, as encode_normal returns them. Preferred to all others and never split,
  /// whatever creases there are. They may change like the heads.
  std::span<const std::uint32_t> vertex_normals;
  MorphSource morph;
  PoseSource pose;  ///< of a mesh without `morph`
  Appearance appearance;
};

}  // namespace mesher::render
