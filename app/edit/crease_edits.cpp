#include "app/edit/crease_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <string>

#include "app/document/session.h"
#include "app/edit/model_edit.h"
#include "engine/core/text.h"
#include "engine/mesh/creases.h"
#include "engine/render/pick.h"

namespace mesher::app {
namespace {

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

/// Name of the edit in the history.
std::string name_of(const CreaseRequest& request, std::size_t count) {
  const std::string edges = count_text(count, "edge");
  switch (request.kind) {
    case CreaseRequest::Kind::change:
      return "make " + edges + (request.value > 0.0F ? " sharper" : " smoother");
    case CreaseRequest::Kind::clear_all:
      return "clear all creases";
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
void take_back_same_drag(Session& session, std::uint64_t drag) {
  History& history = session.edits.history;
  if (drag == 0 || history.undo_depth() == 0 || history.undo_edit().drag != drag) return;
  const Edit taken_back = history.take_back(session.model, session.statistics);
  session.edits.subdivision = taken_back.subdivision_before;
}

}  // namespace

void set_crease_mode(Session& session, bool is_on) {
  if (is_on && refuse_in_progressive(session)) return;
  CreaseMode& creases = session.creases;
  creases.is_on = is_on;
  session.settings.line_edges = is_on;
  session.creases.forget_edges();
  if (is_on) session.notice = "creases: click an edge, Shift+click a chain, Ctrl+click for more";
}

void click_edge(Session& session, const glm::dvec2& at, const EdgeClick& click) {
  const Mesh& mesh = session.model.mesh;
  CreaseMode& creases = session.creases;
  session.notice.clear();
  const auto hit = render::pick_edge(mesh, session.camera, {at, session.window});
  if (!hit) {
    if (!click.toggles) creases.selected.clear();
    return;
  }
  const bool was_in = is_selected(creases, hit->edge);
  std::vector<Edge> edges{hit->edge};
  if (click.chain || click.is_second) edges = crease_chain(mesh, hit->edge);
  if (!click.toggles) creases.selected.clear();
  include(creases.selected, std::move(edges), !click.toggles || was_in == click.is_second);
  if (mesh.is_boundary(hit->edge)) session.notice = kBoundaryNotice;
}

bool hover_edge(Session& session, const std::optional<glm::dvec2>& at) {
  Edge hovered;
  if (session.creases.is_on && at) {
    const auto hit = render::pick_edge(session.model.mesh, session.camera, {*at, session.window});
    if (hit) hovered = hit->edge;
  }
  if (hovered == session.creases.hovered) return false;
  session.creases.hovered = hovered;
  return true;
}

void select_sharp_edges(Session& session) {
  if (refuse_in_progressive(session)) return;
  if (!session.creases.is_on) set_crease_mode(session, true);
  session.creases.selected = sharp_edges(session.model.mesh);
  session.notice = session.creases.selected.empty()
                       ? "there are no creases"
                       : count_text(session.creases.selected.size(), "edge") + " selected";
}

void edit_creases(Session& session, const CreaseRequest& request) {
  take_back_same_drag(session, request.drag);
  const Mesh& mesh = session.model.mesh;
  std::vector<EdgeSharpness> wanted;
  for (const Edge e : edges_of(session.model, session.creases, request)) {
    wanted.push_back({e, wanted_sharpness(request, mesh.sharpness(Mesh::halfedge(e)))});
  }
  const Attributes& attributes = session.model.attributes;
  Edit edit{.name = name_of(request, wanted.size()),
            .mesh = sharpness_difference(mesh, wanted),
            .attributes = difference(attributes, attributes),
            .before = session.statistics,
            .after = counted(session.model, session.statistics, wanted),
            .drag = request.drag};
  if (edit.changes_anything()) return record_edit(session, std::move(edit));
  session.notice = notice_of_nothing(session.creases, request, wanted.size());
  note_model_changed(session, true);
}

float changed_sharpness(float sharpness, float by) {
  if (by < 0.0F) {
    return sharpness == kInfinitelySharp ? kMaxFiniteSharpness : std::max(sharpness + by, 0.0F);
  }
  if (sharpness >= kMaxFiniteSharpness) return kInfinitelySharp;
  return std::min(sharpness + by, kMaxFiniteSharpness);
}

}  // namespace mesher::app
