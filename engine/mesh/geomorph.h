#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace mesher {

/// What a split moves: of parent and child, the way from where the parent was to where they are
/// after it, and normals (encode_normal). GPU layout, 40 bytes: shaders read an array of these.
struct SplitMorph {
  glm::vec3 parent_delta;
  /// The split before this in which the parent took part, as a head (see below).
  std::uint32_t previous;
  glm::vec3 child_delta;
  std::uint32_t coarse_normal;
  std::uint32_t parent_normal;
  std::uint32_t child_normal;
};
static_assert(sizeof(SplitMorph) == 40);

/// A head names the last split in which a vertex took part and its part in it: 2 * split + (1 for
/// the child); kNoHead where it took part in none. From there `previous` leads to all that moved
/// the vertex or an ancestor of it before the vertex was its own.
inline constexpr std::uint32_t kNoHead = 0xFFFFFFFFU;

/// How far each split has grown: 0 where parent and child are still in one place, 1 where it is
/// done. Splits before `first_growing` are done; split i from there on has grown by
/// clamp(fixed + rate * (whole - i + fraction), 0, 1).
///
/// Of the same layout and meaning in shaders/shared/constants.h.
struct GeomorphTime {
  std::uint32_t first_growing = 0xFFFFFFFFU;
  std::int32_t whole = 0;
  float fraction = 0.0F;
  float rate = 0.0F;
  float fixed = 1.0F;

  /// Continuous: split i grows while `time` goes from i to i + range. Draw level min(splits,
  /// ceil(time)). At time = splits + range everything has grown. Pre: time >= 0, range > 0.
  static GeomorphTime continuous(double time, double range);
  /// Between two levels: splits from `coarse` on have all grown by `alpha`.
  static GeomorphTime between(std::uint32_t coarse, float alpha);
  /// Everything has grown: the mesh as it is.
  static GeomorphTime done() { return {}; }

  friend bool operator==(const GeomorphTime&, const GeomorphTime&) = default;
};

/// How far split `i` has grown, 0 to 1.
float growth(const GeomorphTime& time, std::uint32_t i);

/// Where a vertex is drawn: the formula of shaders/geomorph.glsl. `position`: where it is in the
/// level that is drawn. O(splits that moved it since time.first_growing).
glm::vec3 morphed_position(const glm::vec3& position, std::uint32_t head,
                           std::span<const SplitMorph> splits, const GeomorphTime& time);
/// The same for its normal (`normal`: encoded, in the level that is drawn); unit length.
glm::vec3 morphed_normal(std::uint32_t normal, std::uint32_t head,
                         std::span<const SplitMorph> splits, const GeomorphTime& time);

}  // namespace mesher
