#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/simplify/options.h"

namespace mesher::simplify {

/// Removals of about equal cost.
struct CostStep {
  double cost = 0.0;           ///< of each removal, in the unit of the cost policy
  std::uint32_t faces = 0;     ///< that all removals of the step remove together
  std::uint32_t removals = 0;  ///< mostly collapses, which remove one or two faces each
};

/// What it costs to remove faces from a mesh: its removals in order, so `cost` never falls. A mesh
/// cannot have fewer faces than its steps leave.
using CostCurve = std::vector<CostStep>;

/// Returns the cost curve of a mesh down to the fewest faces that are legal, in units of the mesh.
/// It is that of the collapses `simplify` makes by the rules of `options`, whose targets, error
/// limits and observer are ignored; so is `no_intersections`, which would take most of the time.
/// Costs are exact to 2 %, and to an octave for the cheap collapses at the beginning. Takes the
/// time of one `simplify`. Throws Cancelled. Pre: the mesh is valid.
CostCurve cost_curve(const Mesh& mesh, const SimplifyOptions& options);

/// Returns the number of faces that all steps remove. O(steps).
std::uint64_t removable_faces(const CostCurve& curve);

/// Drops the steps that remove more than this number of faces. O(steps).
void limit_removals(CostCurve& curve, std::uint64_t faces);

/// Converts costs of a curve from units of the mesh to those of the scene. `scale`: factor of
/// lengths. Costs of errors are areas times squared distances, others squared lengths or numbers
/// without a unit.
void scale_costs(CostCurve& curve, CostPolicy policy, double scale);

/// A mesh, or a set of loose cards, that shares a budget with others.
struct BudgetItem {
  std::uint32_t faces = 0;   ///< in full
  std::uint64_t weight = 1;  ///< how often it is shown
  CostCurve curve;           ///< in units that are common to all items
};

/// Distributes a budget: returns the number of faces of each item so that they show at most
/// `faces` faces together, or as few as their curves allow.
///
/// The removals are those of a single queue over all items: the cheapest first, wherever it is.
/// With the costs of errors this minimizes the sum of area-weighted squared distances for the
/// number of faces (M. Garland, P. Heckbert, 1997, for a single mesh). A removal in an item that is
/// shown k times costs k times as much and removes k times as many faces, so k does not change its
/// place in the queue. The sum misses `faces` by less than the faces that one removal takes from
/// the screen. Ties go to the item that comes first. Pre: weights are above 0. O(steps log items).
std::vector<std::uint32_t> distribute(std::span<const BudgetItem> items, std::uint64_t faces);

}  // namespace mesher::simplify
