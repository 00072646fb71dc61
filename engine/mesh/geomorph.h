#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/mesh/attributes.h"

namespace mesher {

/// The displacements of one vertex split: for parent and child, the vector from the parent's
/// position before the split to the position after it, and the normals (encode_normal). GPU layout
/// of 40 bytes; shaders read an array of these.
struct SplitMorph {
  glm::vec3 parent_delta;
  /// The previous split in which the parent took part, as a head (see below).
  std::uint32_t previous;
  glm::vec3 child_delta;
  std::uint32_t coarse_normal;
  std::uint32_t parent_normal;
  std::uint32_t child_normal;
};
static_assert(sizeof(SplitMorph) == 40);

/// A head encodes the last split in which a vertex took part and its role: 2 * split + (1 for the
/// child); kNoHead without any split. From there, `previous` links all earlier splits that moved
/// the vertex, or an ancestor of it before the vertex existed.
inline constexpr std::uint32_t kNoHead = 0xFFFFFFFFU;

/// The morph state of all splits: 0 while parent and child coincide, 1 when the split is complete.
/// Splits before `first_growing` are complete; a later split i has the state clamp(fixed + rate *
/// (whole - i + fraction), 0, 1).
///
/// The same layout and meaning as in shaders/shared/constants.h.
struct GeomorphTime {
  std::uint32_t first_growing = 0xFFFFFFFFU;
  std::int32_t whole = 0;
  float fraction = 0.0F;
  float rate = 0.0F;
  float fixed = 1.0F;

  /// Returns the state at a continuous time: split i grows while `time` goes from i to i + range.
  /// Draw level min(splits, ceil(time)). At time = splits + range all splits are complete. Pre:
  /// time >= 0, range > 0.
  static GeomorphTime continuous(double time, double range);
  /// Returns a state between two levels: all splits from `coarse` on have the state `alpha`.
  static GeomorphTime between(std::uint32_t coarse, float alpha);
  /// Returns the state with all splits complete: the mesh as it is.
  static GeomorphTime done() { return {}; }

  friend bool operator==(const GeomorphTime&, const GeomorphTime&) = default;
};

/// The displacements of the values of wedges by vertex splits, as the GPU reads them. A change is
/// that of one wedge by one split: `stride` words, of which the first two are the split and the
/// wedge's previous change (kNoHead: none). Then come floats: for each layer that takes part, from
/// its first word on, value after the split minus value before it.
struct WedgeMorph {
  std::span<const std::uint32_t> heads;  ///< per wedge: its last change, or kNoHead
  std::span<const std::uint32_t> words;  ///< of all changes
  std::uint32_t stride = 0;
  /// By layer of the attributes: its first word in a change; 0: it takes no part.
  std::span<const std::uint32_t> first_word;

  bool is_empty() const { return heads.empty() || words.empty(); }
};

/// Returns the morph state of split `i`, 0 to 1.
float growth(const GeomorphTime& time, std::uint32_t i);

/// Returns the morphed position of a vertex, by the formula of shaders/geomorph.glsl. `position`:
/// its position in the level that is drawn. O(splits that moved it since time.first_growing).
glm::vec3 morphed_position(const glm::vec3& position, std::uint32_t head,
                           std::span<const SplitMorph> splits, const GeomorphTime& time);
/// Returns the morphed unit normal of a vertex. `normal`: its encoded normal in the level that is
/// drawn.
glm::vec3 morphed_normal(std::uint32_t normal, std::uint32_t head,
                         std::span<const SplitMorph> splits, const GeomorphTime& time);

/// Returns the morphed value of a wedge in one layer, before normals get unit length again.
/// `values`: the layer of that index, in the level that is drawn. O(splits that changed it since
/// time.first_growing).
AttributeValue morphed_value(const AttributeLayer& values, const WedgeMorph& morph,
                             std::size_t layer, Wedge w, const GeomorphTime& time);

}  // namespace mesher
