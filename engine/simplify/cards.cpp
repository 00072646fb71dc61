#include "engine/simplify/cards.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "engine/analysis/distance.h"
#include "engine/core/progress.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/error_samples.h"
#include "engine/simplify/morton.h"
#include "engine/simplify/reorder.h"

namespace mesher::simplify {
namespace {

constexpr std::uint64_t kCardSamples = 4096;
/// A collapse removes two faces, so costs of faces are compared by twos.
constexpr double kFacesOfCollapse = 2.0;
/// Share of its squared distance that a removed card costs. Cards are seen as a whole, which looks
/// as before because its area stays. With the full share, the trunk of the oak at 5 % becomes a
/// sliver.
constexpr double kShareOfDistance = 0.25;

/// The bits of a position, for finding equal ones.
struct PositionKey {
  std::uint32_t bits[3];
  explicit PositionKey(const glm::vec3& p) {
    const glm::vec3 positive = p + 0.0F;  // makes -0 a 0
    std::memcpy(bits, &positive, sizeof bits);
  }
  friend bool operator==(const PositionKey&, const PositionKey&) = default;
};
struct PositionHash {
  std::size_t operator()(const PositionKey& key) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t bits : key.bits)
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(hash ^ hash >> 32U);
  }
};

/// Sets of parts that have a position in common.
class Unions {
 public:
  explicit Unions(std::size_t count) : into_(count) { std::iota(into_.begin(), into_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (into_[i] != i)
      i = into_[i] = into_[into_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    into_[high] = low;
  }

 private:
  std::vector<std::uint32_t> into_;
};

/// A pseudorandom number of an index (the finalizer of SplitMix64).
std::uint64_t shuffled(std::uint64_t index) {
  std::uint64_t x = (index + 1) * 0x9E3779B97F4A7C15U;
  x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9U;
  x = (x ^ x >> 27U) * 0x94D049BB133111EBU;
  return x ^ x >> 31U;
}

/// Returns the place of item `i` of 2^bits in an order that is random, but of which every beginning
/// is spread evenly over the items: at each halving of the items, chance decides which half comes
/// first (A. Owen, "Randomly permuted (t,m,s)-nets", 1995).
std::uint64_t scrambled(std::uint64_t i, unsigned bits) {
  std::uint64_t place = 0;
  for (unsigned depth = 0; depth < bits; ++depth) {
    const std::uint64_t half = i >> (bits - 1 - depth);
    const std::uint64_t parent = (half >> 1U) + (std::uint64_t{1} << depth);
    place |= ((half ^ shuffled(parent)) & 1U) << depth;
  }
  return place;
}

/// Returns the order in which cards survive: random, but spread evenly over the places of the
/// cards.
std::vector<std::uint32_t> order_of_survival(std::span<const LooseCard> cards) {
  Array<glm::vec3> centers;
  Array<Vertex> all;
  for (std::uint32_t i = 0; i < cards.size(); ++i) {
    centers.push_back(glm::vec3(cards[i].center));
    all.emplace_back(i);
  }
  const auto bits = static_cast<unsigned>(std::bit_width(cards.size()));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;
  std::uint64_t rank = 0;
  for (const Vertex card : morton_order(centers, all, {})) {
    const std::uint64_t item = (rank++ << bits) / cards.size();
    places.emplace_back(scrambled(item, bits), card.index());
  }
  std::ranges::sort(places);
  std::vector<std::uint32_t> order;
  order.reserve(places.size());
  for (const auto& [place, card] : places)
    order.push_back(card);
  return order;
}

glm::dvec3 corner_of(const Mesh& mesh, std::uint32_t f, std::uint32_t c) {
  return glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(Face(f), c))));
}

/// Finds cards in steps: components, those that are small, what they touch, sets.
class CardFinder {
 public:
  CardFinder(const Mesh& mesh, const Attributes& attributes)
      : mesh_(mesh), attributes_(attributes), part_of_face_(face_components(mesh)) {}

  LooseCards run() {
    count();
    if (small_ < kLeastCards) return {};
    unite();
    gather();
    return sets();
  }

 private:
  void count() {
    for (const std::uint32_t part : part_of_face_)
      parts_ = std::max(parts_, part + 1);
    faces_.assign(parts_, 0);
    is_open_.assign(parts_, false);
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      ++faces_[part_of_face_[f]];
      for (std::uint32_t c = 0; c < 3; ++c) {
        if (!mesh_.twin(Mesh::halfedge(Face(f), c)).is_valid()) is_open_[part_of_face_[f]] = true;
      }
    }
    for (std::uint32_t p = 0; p < parts_; ++p)
      small_ += is_small(p) ? 1U : 0U;
  }

  bool is_small(std::uint32_t part) const {
    return is_open_[part] && faces_[part] <= kMostCardFaces;
  }

  /// Unites small parts with what they touch. All that touches a larger part becomes part of it.
  void unite() {
    unions_ = Unions(parts_);
    std::unordered_map<PositionKey, std::uint32_t, PositionHash> part_at;
    const auto for_each_corner = [&](bool small, auto&& visit) {
      for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
        const std::uint32_t part = part_of_face_[f];
        if (is_small(part) != small) continue;
        for (std::uint32_t c = 0; c < 3; ++c)
          visit(part, PositionKey(mesh_.position(mesh_.origin(Mesh::halfedge(Face(f), c)))));
      }
    };
    for_each_corner(true, [&](std::uint32_t part, const PositionKey& key) {
      unions_.unite(part, part_at.try_emplace(key, part).first->second);
    });
    for_each_corner(false, [&](std::uint32_t part, const PositionKey& key) {
      if (const auto at = part_at.find(key); at != part_at.end()) unions_.unite(part, at->second);
    });
  }

  /// Gathers the faces of each union that is a card.
  void gather() {
    std::vector<std::uint32_t> faces_together(parts_, 0);
    for (std::uint32_t p = 0; p < parts_; ++p)
      faces_together[unions_.root(p)] += std::min(faces_[p], kMostCardFaces + 1);
    card_of_union_.assign(parts_, kNone);
    card_of_face_.assign(mesh_.face_count(), kNone);
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      const std::uint32_t root = unions_.root(part_of_face_[f]);
      if (!is_small(part_of_face_[f]) || faces_together[root] > kMostCardFaces) continue;
      std::uint32_t& card = card_of_union_[root];
      if (card == kNone) {
        card = static_cast<std::uint32_t>(cards_.size());
        cards_.emplace_back();
        material_.push_back(material(f));
      }
      card_of_face_[f] = card;
      add(cards_[card], f);
    }
    for (LooseCard& card : cards_)
      card.center = card.area > 0.0 ? card.center / card.area : glm::dvec3(0.0);
  }

  void add(LooseCard& card, std::uint32_t f) const {
    const glm::dvec3 a = corner_of(mesh_, f, 0);
    const glm::dvec3 b = corner_of(mesh_, f, 1);
    const glm::dvec3 c = corner_of(mesh_, f, 2);
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    ++card.faces;
    card.area += area;
    card.center += area * (a + b + c) / 3.0;
  }

  /// Primitives of a glTF mesh are apart even if their material is the same.
  std::pair<std::uint32_t, std::uint32_t> material(std::uint32_t f) const {
    if (attributes_.group.empty()) return {kNone, kNone};
    const FaceGroup& group = attributes_.groups[attributes_.group[f]];
    return {group.material, group.primitive};
  }

  LooseCards sets() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> by_material;
    for (std::uint32_t card = 0; card < cards_.size(); ++card) {
      if (cards_[card].area > 0.0) by_material[material_[card]].push_back(card);
    }
    LooseCards found;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> place(cards_.size(), {kNone, kNone});
    for (auto& [material, cards] : by_material) {
      keep_alike(cards);
      if (cards.size() < kLeastCards) continue;
      const auto set = static_cast<std::uint32_t>(found.sets.size());
      CardSet& all = found.sets.emplace_back();
      for (const std::uint32_t card : cards) {
        place[card] = {set, static_cast<std::uint32_t>(all.cards.size())};
        all.cards.push_back(cards_[card]);
        all.faces += cards_[card].faces;
        all.area += cards_[card].area;
      }
      all.order = order_of_survival(all.cards);
    }
    if (found.sets.empty()) return found;
    found.set_of_face.assign(mesh_.face_count(), LooseCards::kRest);
    found.card_of_face.assign(mesh_.face_count(), 0);
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
      const auto at = card_of_face_[f] == kNone ? std::pair{kNone, kNone} : place[card_of_face_[f]];
      if (at.first == kNone) {
        ++found.rest_faces;
      } else {
        std::tie(found.set_of_face[f], found.card_of_face[f]) = at;
      }
    }
    return found;
  }

  void keep_alike(std::vector<std::uint32_t>& cards) const {
    std::vector<double> areas;
    areas.reserve(cards.size());
    for (const std::uint32_t card : cards)
      areas.push_back(cards_[card].area);
    const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
    std::nth_element(areas.begin(), middle, areas.end());
    const double median = *middle;
    std::erase_if(cards, [&](std::uint32_t card) {
      return cards_[card].area > kAlike * median || cards_[card].area * kAlike < median;
    });
  }

  const Mesh& mesh_;
  const Attributes& attributes_;
  std::vector<std::uint32_t> part_of_face_;
  std::uint32_t parts_ = 0;
  std::vector<std::uint32_t> faces_;  ///< by part
  std::vector<bool> is_open_;         ///< by part
  std::uint32_t small_ = 0;
  Unions unions_{0};
  std::vector<std::uint32_t> card_of_union_;
  std::vector<std::uint32_t> card_of_face_;
  std::vector<LooseCard> cards_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> material_;  ///< by card
};

/// The faces of one set, and the mesh that they make.
struct SetMesh {
  Mesh mesh;
  Array<Face> faces;
};

SetMesh mesh_of(const Mesh& mesh, const LooseCards& cards, std::uint32_t set,
                const std::vector<bool>& is_left) {
  KeptIds kept;
  std::vector<bool> is_used(mesh.vertex_count(), false);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (cards.set_of_face[f] != set || !is_left[cards.card_of_face[f]]) continue;
    kept.faces.emplace_back(f);
    for (std::uint32_t c = 0; c < 3; ++c)
      is_used[mesh.origin(Mesh::halfedge(Face(f), c)).index()] = true;
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (is_used[v]) kept.vertices.emplace_back(v);
  }
  return {compact(mesh, kept), std::move(kept.faces)};
}

}  // namespace

LooseCards find_cards(const Mesh& mesh, const Attributes& attributes) {
  return CardFinder(mesh, attributes).run();
}

CardThinning::CardThinning(const Mesh& mesh, const LooseCards& cards, std::uint32_t set,
                           Progress* progress)
    : set_(cards.sets[set]) {
  const auto count = static_cast<std::uint32_t>(set_.cards.size());
  levels_.push_back({count, 0.0});
  std::vector<bool> is_left(count, true);
  // Later levels are small, so only the faces of the set are visited again.
  const SetMesh all = mesh_of(mesh, cards, set, is_left);
  LooseCards own{.sets = cards.sets, .rest_faces = 0};
  for (const Face f : all.faces) {
    own.set_of_face.push_back(set);
    own.card_of_face.push_back(cards.card_of_face[f.index()]);
  }
  std::vector<double> enlargements(cards.sets.size(), 1.0);
  for (std::uint32_t left = count / 2; left > 0; left /= 2) {
    check_cancelled(progress);
    for (std::uint32_t i = left; i < levels_.back().left; ++i)
      is_left[set_.order[i]] = false;
    SetMesh thinned = mesh_of(all.mesh, own, set, is_left);
    enlargements[set] = enlargement(left);
    enlarge_cards(thinned.mesh, thinned.faces, own, enlargements);
    const double rms =
        analysis::surface_distance(all.mesh, thinned.mesh, {.samples = kCardSamples}).forward.rms;
    levels_.push_back({left, std::max(rms * rms, levels_.back().mean_square)});
  }
}

CostCurve CardThinning::curve(double stop_before_error) const {
  CostCurve curve;
  const double faces_per_card = double(set_.faces) / double(set_.cards.size());
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    if (std::sqrt(levels_[i].mean_square) > stop_before_error) break;
    CostStep step;
    for (std::uint32_t k = levels_[i].left; k < levels_[i - 1].left; ++k)
      step.faces += set_.cards[set_.order[k]].faces;
    step.removals = levels_[i - 1].left - levels_[i].left;
    const double worse = levels_[i].mean_square - levels_[i - 1].mean_square;
    step.cost = kShareOfDistance * kTimesCounted * set_.area * worse / double(step.removals) *
                kFacesOfCollapse / faces_per_card;
    if (!curve.empty()) step.cost = std::max(step.cost, curve.back().cost);
    curve.push_back(step);
  }
  return curve;
}

std::uint32_t CardThinning::cards_for(std::uint32_t faces) const {
  std::uint32_t left = 0;
  for (std::uint32_t sum = 0; left < set_.order.size(); ++left) {
    sum += set_.cards[set_.order[left]].faces;
    if (sum > faces) break;
  }
  return std::max(left, 1U);
}

double CardThinning::error(std::uint32_t left) const {
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const Level& more = levels_[i - 1];
    const Level& less = levels_[i];
    if (left < less.left) continue;
    const double part = double(more.left - left) / double(more.left - less.left);
    return std::sqrt(more.mean_square + part * (less.mean_square - more.mean_square));
  }
  return std::sqrt(levels_.back().mean_square);
}

double CardThinning::enlargement(std::uint32_t left) const {
  double area = 0.0;
  for (std::uint32_t i = 0; i < left; ++i)
    area += set_.cards[set_.order[i]].area;
  return left < set_.cards.size() && area > 0.0 ? std::sqrt(set_.area / area) : 1.0;
}

void enlarge_cards(Mesh& mesh, std::span<const Face> source, const LooseCards& cards,
                   std::span<const double> enlargement) {
  std::vector<std::uint32_t> face_of(mesh.vertex_count(), kNone);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t set = cards.set_of_face[source[f].index()];
    if (set == LooseCards::kRest || enlargement[set] == 1.0) continue;
    for (std::uint32_t c = 0; c < 3; ++c)
      face_of[mesh.origin(Mesh::halfedge(Face(f), c)).index()] = source[f].index();
  }
  constexpr double kMost = std::numeric_limits<float>::max();
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (face_of[v] == kNone) continue;
    const std::uint32_t set = cards.set_of_face[face_of[v]];
    const glm::dvec3& center = cards.sets[set].cards[cards.card_of_face[face_of[v]]].center;
    const glm::dvec3 moved =
        center + enlargement[set] * (glm::dvec3(mesh.position(Vertex(v))) - center);
    mesh.set_position(Vertex(v), glm::vec3(glm::clamp(moved, -kMost, kMost)));
  }
}

}  // namespace mesher::simplify
