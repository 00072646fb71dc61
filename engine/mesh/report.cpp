#include "engine/mesh/report.h"

#include <algorithm>

namespace mesher {
namespace {

struct Words {
  std::string_view key;
  std::string_view text;
};

constexpr std::array<Words, kRepairCount> kWords{{
    {"polygons_triangulated", "polygons triangulated"},
    {"degenerate_faces_dropped", "degenerate faces dropped"},
    {"duplicate_faces_dropped", "duplicate faces dropped"},
    {"non_finite_vertices_dropped", "non-finite vertices dropped"},
    {"non_finite_faces_dropped", "faces with a non-finite vertex dropped"},
    {"faces_flipped", "faces flipped to agree with their neighbours"},
    {"unorientable_edges_cut", "edges of a one-sided surface cut"},
    {"non_manifold_edges_cut", "non-manifold edges cut"},
    {"non_manifold_vertices_cut", "non-manifold vertices cut"},
    {"isolated_vertices_dropped", "isolated vertices dropped"},
    {"isolated_vertices_kept", "isolated vertices kept"},
    {"creases_on_missing_edges", "creases on missing edges ignored"},
    {"invalid_sharpness_ignored", "invalid sharpness values ignored"},
    {"contradictory_creases", "contradictory creases (the last counts)"},
}};

}  // namespace

std::string_view key(Repair repair) {
  return kWords[static_cast<std::size_t>(repair)].key;
}

std::string_view describe(Repair repair) {
  return kWords[static_cast<std::size_t>(repair)].text;
}

bool BuildReport::is_clean() const {
  return std::all_of(counts_.begin(), counts_.end(), [](std::uint64_t n) { return n == 0; });
}

}  // namespace mesher
