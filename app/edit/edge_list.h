#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher::app {

/// Returns ascending edges as text, with ranges of consecutive ids: "0-4,7,11".
std::string edge_list_text(std::span<const Edge> edges);
/// Returns the edges that such a text lists, ascending. None if the text is malformed, or if the
/// mesh has no such edge. O(edges).
std::optional<std::vector<Edge>> parse_edge_list(std::string_view text, const Mesh& mesh);

}  // namespace mesher::app
