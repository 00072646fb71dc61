#include "app/edit/crease_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <string>

#include "app/document/document.h"
#include "app/document/view.h"
#include "app/edit/edge_list.h"
#include "app/edit/model_edit.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/mesh/creases.h"
#include "engine/render/pick.h"

namespace mesher::app {
namespace {

constexpr const char* kSet = "set_sharpness";
constexpr const char* kChange = "change_sharpness";
constexpr const char* kClearAll = "clear_all_creases";
constexpr const char* kMark = "mark_creases";

constexpr const char* kBoundaryNotice =
    "boundary edges are always sharp: their sharpness cannot be changed";

bool is_selected(const CreaseMode& creases, Edge e) {
  return std::binary_search(creases.selected.begin(), creases.selected.end(), e);
}

/// Adds `edges` to a sorted selection, or removes them.
void include(std::vector<Edge>& selected, std::vector<Edge> edges, bool is_in) {
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> result;
  if (is_in) {
    std::set_union(selected.begin(), selected.end(), edges.begin(), edges.end(),
                   std::back_inserter(result));
  } else {
    std::set_difference(selected.begin(), selected.end(), edges.begin(), edges.end(),
                        std::back_inserter(result));
  }
  selected = std::move(result);
}

/// The edges that a request changes.
std::vector<Edge> edges_of(const Model& model, const CreaseMode& creases,
                           const CreaseRequest& request) {
  if (request.edges) {
    const auto edges = parse_edge_list(*request.edges, model.mesh);
    if (!edges) throw UsageError("the model does not have the edges " + *request.edges);
    return inner_edges(model.mesh, *edges);
  }
  switch (request.kind) {
    case CreaseRequest::Kind::clear_all:
      return sharp_edges(model.mesh);
    case CreaseRequest::Kind::tag_by_angle:
      return untagged_edges_beyond(model.mesh, glm::radians(request.value));
    case CreaseRequest::Kind::set:
    case CreaseRequest::Kind::change:
      break;
  }
  return creases.selected_inner_edges(model.mesh);
}

/// The request as text, with the edges that it changes.
std::string text_of(const CreaseRequest& request, std::span<const Edge> edges) {
  switch (request.kind) {
    case CreaseRequest::Kind::set:
      return fmt::format("{} to={} edges={}", kSet, request.value, edge_list_text(edges));
    case CreaseRequest::Kind::change:
      return fmt::format("{} by={} edges={}", kChange, request.value, edge_list_text(edges));
    case CreaseRequest::Kind::clear_all:
      return kClearAll;
    case CreaseRequest::Kind::tag_by_angle:
      break;
  }
  return fmt::format("{} angle={}", kMark, request.value);
}

float wanted_sharpness(const CreaseRequest& request, float before) {
  switch (request.kind) {
    case CreaseRequest::Kind::set:
      return request.value;
    case CreaseRequest::Kind::change:
      return changed_sharpness(before, request.value);
    case CreaseRequest::Kind::clear_all:
      return 0.0F;
    case CreaseRequest::Kind::tag_by_angle:
      break;
  }
  return kInfinitelySharp;
}

std::string sharpness_text(float sharpness) {
  return sharpness == kInfinitelySharp ? "infinite" : number_text(sharpness);
}

/// "1.5", or "0.5 to 2". Pre: there are edges.
std::string sharpness_range(const std::vector<EdgeSharpness>& wanted) {
  float least = kInfinitelySharp;
  float most = 0.0F;
  for (const EdgeSharpness& each : wanted) {
    least = std::min(least, each.sharpness);
    most = std::max(most, each.sharpness);
  }
  const std::string to = least < most ? " to " + sharpness_text(most) : "";
  return sharpness_text(least) + to;
}

/// Name of the edit in the history: "make 12 edges smoother -> 1.5". It fits the dock.
std::string name_of(const CreaseRequest& request, const std::vector<EdgeSharpness>& wanted) {
  const std::string edges = count_text(wanted.size(), "edge");
  switch (request.kind) {
    case CreaseRequest::Kind::change:
      if (wanted.empty()) return "";
      return fmt::format("make {} {} -> {}", edges, request.value > 0.0F ? "sharper" : "smoother",
                         sharpness_range(wanted));
    case CreaseRequest::Kind::clear_all:
      return "clear all creases (" + edges + ")";
    case CreaseRequest::Kind::tag_by_angle:
      return fmt::format("mark {} by an angle of {} degrees", edges, number_text(request.value));
    case CreaseRequest::Kind::set:
      break;
  }
  if (request.value == 0.0F) return "make " + edges + " smooth";
  if (request.value == kInfinitelySharp) return "make " + edges + " infinitely sharp";
  return fmt::format("set {} to sharpness {}", edges, number_text(request.value));
}

/// Why a request changes nothing.
std::string notice_of_nothing(const CreaseMode& creases, const CreaseRequest& request,
                              std::size_t edges) {
  switch (request.kind) {
    case CreaseRequest::Kind::clear_all:
      return "there are no creases";
    case CreaseRequest::Kind::tag_by_angle:
      return fmt::format("no unmarked edge has face normals that differ by more than {} degrees",
                         number_text(request.value));
    case CreaseRequest::Kind::set:
    case CreaseRequest::Kind::change:
      break;
  }
  if (edges > 0) return "";  // the edges already have that sharpness, as the picture shows
  return creases.selected.empty() ? "no edge is selected" : kBoundaryNotice;
}

/// Statistics after the sharpness of some edges has changed. O(edges).
Statistics counted(const Model& model, const Statistics& statistics,
                   const std::vector<EdgeSharpness>& wanted) {
  Statistics after = statistics;
  const Mesh& mesh = model.mesh;
  for (const auto& [edge, sharpness] : wanted) {
    if (mesh.is_boundary(edge)) continue;
    const bool was_sharp = mesh.sharpness(Mesh::halfedge(edge)) > 0.0F;
    const bool is_sharp = sharpness > 0.0F;
    if (is_sharp && !was_sharp) ++after.crease_edges;
    if (!is_sharp && was_sharp) --after.crease_edges;
  }
  return after;
}

/// The steps of one drag become one step of the history: each replaces the one before.
void take_back_same_drag(Document& document, std::uint64_t drag) {
  History& history = document.edits.history;
  if (drag == 0 || history.undo_depth() == 0 || history.undo_edit().drag != drag) return;
  const Edit taken_back = history.take_back(document.model, document.statistics);
  document.edits.subdivision = taken_back.subdivision_before;
}

}  // namespace

void set_crease_mode(Document& document, bool is_on) {
  if (is_on && refuse_in_progressive(document)) return;
  CreaseMode& creases = document.creases;
  creases.is_on = is_on;
  document.creases.forget_edges();
  if (is_on) document.notice = "creases: click an edge, Shift+click a chain, Ctrl+click for more";
}

void click_edge(Document& document, const View& view, const glm::dvec2& at,
                const EdgeClick& click) {
  const Mesh& mesh = document.model.mesh;
  CreaseMode& creases = document.creases;
  document.notice.clear();
  const auto hit = render::pick_edge(mesh, view.camera, view.cursor(at));
  if (!hit) {
    if (!click.toggles) creases.selected.clear();
    return;
  }
  const bool was_in = is_selected(creases, hit->edge);
  std::vector<Edge> edges{hit->edge};
  if (click.chain || click.is_second) edges = crease_chain(mesh, hit->edge);
  if (!click.toggles) creases.selected.clear();
  include(creases.selected, std::move(edges), !click.toggles || was_in == click.is_second);
  if (mesh.is_boundary(hit->edge)) document.notice = kBoundaryNotice;
}

bool hover_edge(Document& document, const View& view, const std::optional<glm::dvec2>& at) {
  Edge hovered;
  if (document.creases.is_on && at) {
    const auto hit = render::pick_edge(document.model.mesh, view.camera, view.cursor(*at));
    if (hit) hovered = hit->edge;
  }
  if (hovered == document.creases.hovered) return false;
  document.creases.hovered = hovered;
  return true;
}

void select_sharp_edges(Document& document) {
  if (refuse_in_progressive(document)) return;
  if (!document.creases.is_on) set_crease_mode(document, true);
  document.creases.selected = sharp_edges(document.model.mesh);
  document.notice = document.creases.selected.empty()
                        ? "there are no creases"
                        : count_text(document.creases.selected.size(), "edge") + " selected";
}

void edit_creases(Document& document, const CreaseRequest& request) {
  take_back_same_drag(document, request.drag);
  const Mesh& mesh = document.model.mesh;
  const std::vector<Edge> edges = edges_of(document.model, document.creases, request);
  std::vector<EdgeSharpness> wanted;
  wanted.reserve(edges.size());
  for (const Edge e : edges) {
    wanted.push_back({e, wanted_sharpness(request, mesh.sharpness(Mesh::halfedge(e)))});
  }
  const Attributes& attributes = document.model.attributes;
  Edit edit{.name = name_of(request, wanted),
            .text = text_of(request, edges),
            .mesh = sharpness_difference(mesh, wanted),
            .attributes = difference(attributes, attributes),
            .before = document.statistics,
            .after = counted(document.model, document.statistics, wanted),
            .drag = request.drag};
  if (edit.changes_anything()) return record_edit(document, std::move(edit));
  document.notice = notice_of_nothing(document.creases, request, wanted.size());
  note_model_changed(document, true);
}

CreaseRequest crease_request(EditWords& words) {
  using Kind = CreaseRequest::Kind;
  if (words.name() == kClearAll) return {.kind = Kind::clear_all};
  if (words.name() == kMark)
    return {.kind = Kind::tag_by_angle, .value = words.take_float("angle", 0, 180)};
  if (words.name() == kChange) {
    const float by = words.take_float("by", -kMaxFiniteSharpness, kMaxFiniteSharpness);
    return {.kind = Kind::change, .value = by, .edges = words.take("edges")};
  }
  const float to = words.take_float("to", 0, kInfinitelySharp);
  return {.kind = Kind::set, .value = to, .edges = words.take("edges")};
}

float changed_sharpness(float sharpness, float by) {
  if (by < 0.0F) {
    return sharpness == kInfinitelySharp ? kMaxFiniteSharpness : std::max(sharpness + by, 0.0F);
  }
  if (sharpness >= kMaxFiniteSharpness) return kInfinitelySharp;
  return std::min(sharpness + by, kMaxFiniteSharpness);
}

}  // namespace mesher::app
