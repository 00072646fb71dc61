#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/budget.h"

namespace mesher::simplify {

/// A tiny open part of a mesh, such as a leaf of a tree or a blade of grass.
struct LooseCard {
  std::uint32_t faces = 0;
  double area = 0.0;
  glm::dvec3 center{0.0};  ///< of the area
};

/// Cards that are alike: of one material, and of areas within a factor of kAlike of their
/// median. `order` lists them in the order in which they survive. It is random, but any beginning
/// of it is spread evenly over the places of the cards. It is always the same, so that a coarse
/// level shows a part of what a finer one shows.
struct CardSet {
  std::vector<LooseCard> cards;
  std::uint32_t faces = 0;
  double area = 0.0;
  std::vector<std::uint32_t> order;
};

/// The loose cards of a mesh. All faces that are no card are the rest.
struct LooseCards {
  static constexpr std::uint32_t kRest = 0xFFFFFFFF;

  std::vector<CardSet> sets;
  /// By face, its card: number of the set, and index in it. Empty if there are no sets.
  std::vector<std::uint32_t> set_of_face;
  std::vector<std::uint32_t> card_of_face;
  std::uint32_t rest_faces = 0;
};

/// A card has at most this number of faces, both sides together.
inline constexpr std::uint32_t kMostCardFaces = 8;
/// A set has at least this number of cards: fewer are parts with a meaning of their own.
inline constexpr std::uint32_t kLeastCards = 16;
/// Ratio of areas to the median within which cards are alike.
inline constexpr double kAlike = 16.0;

/// Finds the cards of a mesh: parts with a boundary and at most kMostCardFaces faces. Parts that
/// have a position in common, such as both sides of a leaf, are one card; what has one in common
/// with a larger part belongs to that part. Parts without area are no cards. O(V + F log F).
LooseCards find_cards(const Mesh& mesh, const Attributes& attributes);

/// What became of the loose cards of a mesh.
struct ThinnedCards {
  std::uint32_t cards = 0;
  std::uint32_t removed = 0;
  double enlarged = 1.0;  ///< largest factor of lengths of the others
};

/// How a set of cards changes as cards are removed at random and the others enlarged, so that their
/// area stays (R. Cook, J. Halstead, M. Planck, D. Ryu, "Stochastic simplification of aggregate
/// detail", 2007).
///
/// The error is the root mean square distance from the cards of the input to those that are left,
/// enlarged. It is sampled where half, a quarter, an eighth, ... of the cards are left, and
/// interpolated between.
class CardThinning {
 public:
  /// Measures. O(F log F) in the faces of the set. Throws Cancelled.
  CardThinning(const Mesh& mesh, const LooseCards& cards, std::uint32_t set,
               Progress* progress = nullptr);

  /// Returns the costs of removing cards, in the unit of costs of errors, down to one card, or
  /// until the error exceeds `stop_before_error`. O(log cards).
  CostCurve curve(double stop_before_error) const;
  /// Returns the number of cards that are left if the set may have this number of faces; at least
  /// 1. O(cards).
  std::uint32_t cards_for(std::uint32_t faces) const;
  /// Returns the error with this number of cards left. O(log cards).
  double error(std::uint32_t left) const;
  /// Returns the factor by which lengths of the cards that are left grow. O(cards).
  double enlargement(std::uint32_t left) const;

 private:
  struct Level {
    std::uint32_t left = 0;
    double mean_square = 0.0;
  };

  const CardSet& set_;
  std::vector<Level> levels_;  ///< from all cards to one
};

/// Enlarges the cards in `mesh`, by which `source` is the face of the input that each face was.
/// `enlargement`: by set. O(V + F). Pre: no two cards share a vertex.
void enlarge_cards(Mesh& mesh, std::span<const Face> source, const LooseCards& cards,
                   std::span<const double> enlargement);

}  // namespace mesher::simplify
