#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace mesher {

/// The index that means "none" in every id type, and the limit on counts: arrays hold at most
/// `kNone` entries, so that ids fit in 32 bits.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// A 32-bit index with its own type, so that a Vertex cannot be passed as a Face. An array of ids
/// has the bytes of an array of `uint32_t`: it is the index buffer that the GPU reads.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t index) : index_(index) {}

  constexpr std::uint32_t index() const { return index_; }
  constexpr bool is_valid() const { return index_ != kNone; }

  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  std::uint32_t index_ = kNone;
};

using Vertex = Id<struct VertexTag>;
/// Half-edge `h = 3*face + corner`, from the vertex of its corner to the vertex of the next corner.
using Halfedge = Id<struct HalfedgeTag>;
/// An undirected edge, identified by the lower of its half-edges (so edge ids have gaps).
using Edge = Id<struct EdgeTag>;
using Face = Id<struct FaceTag>;
/// The corners of a vertex that share all attribute values (engine/mesh/attributes.h).
using Wedge = Id<struct WedgeTag>;

static_assert(sizeof(Vertex) == 4 && sizeof(Halfedge) == 4);

}  // namespace mesher

template <class Tag>
struct std::hash<mesher::Id<Tag>> {
  std::size_t operator()(mesher::Id<Tag> id) const noexcept { return id.index(); }
};
