#include "app/edit/edge_list.h"

#include <fmt/format.h>

#include <charconv>

namespace mesher::app {
namespace {

/// Reads a number at the start of `text`, and removes it.
std::optional<std::uint32_t> take_number(std::string_view& text) {
  std::uint32_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return value;
}

bool take(std::string_view& text, char character) {
  if (!text.starts_with(character)) return false;
  text.remove_prefix(1);
  return true;
}

bool is_edge(const Mesh& mesh, std::uint32_t id) {
  return id < mesh.halfedge_count() && mesh.edge(Halfedge(id)) == Edge(id);
}

}  // namespace

std::string edge_list_text(std::span<const Edge> edges) {
  std::string text;
  for (std::size_t i = 0; i < edges.size();) {
    const std::uint32_t first = edges[i].index();
    std::uint32_t last = first;
    for (++i; i < edges.size() && edges[i].index() == last + 1; ++i)
      ++last;
    if (!text.empty()) text += ',';
    text += first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
  }
  return text;
}

std::optional<std::vector<Edge>> parse_edge_list(std::string_view text, const Mesh& mesh) {
  std::vector<Edge> edges;
  std::uint32_t least = 0;
  while (true) {
    const auto first = take_number(text);
    const auto last = take(text, '-') ? take_number(text) : first;
    if (!first || !last || *first < least || *last < *first) return std::nullopt;
    if (*last >= mesh.halfedge_count()) return std::nullopt;
    for (std::uint32_t id = *first; id <= *last; ++id) {
      if (!is_edge(mesh, id)) return std::nullopt;
      edges.emplace_back(id);
    }
    least = *last + 1;
    if (text.empty()) return edges;
    if (!take(text, ',')) return std::nullopt;
  }
}

}  // namespace mesher::app
