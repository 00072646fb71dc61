#include "engine/mesh/validate.h"
#include "engine/mesh/circulators.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace mesher {
namespace {

class Validator {
 public:
  Validator(const Mesh& mesh, std::size_t limit) : mesh_(mesh), limit_(limit) {}

  std::vector<Violation> run() {
    // Later checks follow indices that earlier checks have proved to be in range.
    check_sizes();
    if (is_sound_) check_index_ranges();
    if (is_sound_) {
      check_twins();
      check_faces();
      check_values();
    }
    if (is_sound_) {
      check_vertices();
      check_edges();
      check_bow_tie_copies();
    }
    return std::move(violations_);
  }

 private:
  void fail(int invariant, std::string what) {
    is_sound_ = false;
    if (violations_.size() < limit_) violations_.push_back({invariant, std::move(what)});
  }
  static std::string name(Halfedge h) { return "half-edge " + std::to_string(h.index()); }
  static std::string name(Vertex v) { return "vertex " + std::to_string(v.index()); }
  static std::string name(Face f) { return "face " + std::to_string(f.index()); }

  void check_sizes() {
    const std::size_t halfedges = mesh_.origins().size();
    if (halfedges % 3 != 0) fail(1, "the number of origins is not a multiple of three");
    if (mesh_.twins().size() != halfedges) fail(1, "not as many twins as origins");
    if (mesh_.sharpnesses().size() != halfedges) fail(1, "not as many sharpnesses as origins");
    const std::size_t vertices = mesh_.positions().size();
    if (mesh_.outgoings().size() != vertices)
      fail(1, "not as many outgoing half-edges as positions");
    const std::size_t own = mesh_.vertex_sharpnesses().size();
    if (own != 0 && own != vertices) fail(1, "not as many vertex sharpnesses as positions");
  }

  void check_index_ranges() {
    for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i) {
      const Halfedge h(i);
      if (mesh_.origin(h).index() >= mesh_.vertex_count())
        fail(2, name(h) + ": origin out of range");
      const Halfedge t = mesh_.twin(h);
      if (t.is_valid() && t.index() >= mesh_.halfedge_count()) {
        fail(2, name(h) + ": twin out of range");
      }
    }
    for (std::uint32_t i = 0; i < mesh_.vertex_count(); ++i) {
      const Halfedge h = mesh_.outgoing(Vertex(i));
      if (h.is_valid() && h.index() >= mesh_.halfedge_count()) {
        fail(2, name(Vertex(i)) + ": outgoing half-edge out of range");
      }
    }
  }

  void check_twins() {
    for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i) {
      const Halfedge h(i);
      const Halfedge t = mesh_.twin(h);
      if (!t.is_valid()) continue;
      if (t == h || mesh_.twin(t) != h) fail(3, name(h) + ": twin is not mutual");
      if (mesh_.origin(t) != mesh_.target(h) || mesh_.target(t) != mesh_.origin(h)) {
        fail(4, name(h) + ": twin does not run the opposite way");
      }
    }
  }

  void check_faces() {
    std::vector<std::array<std::uint32_t, 3>> triples(mesh_.face_count());
    for (std::uint32_t i = 0; i < mesh_.face_count(); ++i) {
      std::array<std::uint32_t, 3>& t = triples[i];
      for (std::uint32_t c = 0; c < 3; ++c) {
        t[c] = mesh_.origin(Mesh::halfedge(Face(i), c)).index();
      }
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) fail(5, name(Face(i)) + " is degenerate");
      std::sort(t.begin(), t.end());
    }
    std::sort(triples.begin(), triples.end());
    const auto twice = std::adjacent_find(triples.begin(), triples.end());
    if (twice != triples.end()) {
      fail(6, fmt::format("two faces share vertices {}, {}, {}", (*twice)[0], (*twice)[1],
                          (*twice)[2]));
    }
  }

  void check_vertices() {
    std::vector<std::uint32_t> degree(mesh_.vertex_count(), 0);
    for (const Vertex v : mesh_.origins())
      ++degree[v.index()];
    for (std::uint32_t i = 0; i < mesh_.vertex_count(); ++i) {
      const Vertex v(i);
      const Halfedge start = mesh_.outgoing(v);
      if (start.is_valid() != (degree[i] > 0)) {
        fail(7, name(v) + ": outgoing half-edge is none but faces use it, or the reverse");
        continue;
      }
      if (!start.is_valid()) continue;
      if (mesh_.origin(start) != v) {
        fail(7, name(v) + ": outgoing half-edge starts elsewhere");
        continue;
      }
      check_fan(v, start, degree[i]);
    }
  }

  void check_fan(Vertex v, Halfedge start, std::uint32_t degree) {
    std::uint32_t met = 0;
    Circulator at(mesh_, start);
    do {
      ++met;
    } while (at.advance() && met <= degree);
    if (met != degree) {
      fail(8, fmt::format("{}: a sweep visits {} of {} half-edges", name(v), met, degree));
    }
    if (!at.is_closed() && mesh_.twin(start).is_valid()) {
      fail(9, name(v) + ": the sweep does not start at the boundary");
    }
  }

  void check_edges() {
    struct Entry {
      std::uint32_t low, high, h;
      auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries;
    entries.reserve(mesh_.halfedge_count());
    for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i) {
      const std::uint32_t a = mesh_.origin(Halfedge(i)).index();
      const std::uint32_t b = mesh_.target(Halfedge(i)).index();
      entries.push_back({std::min(a, b), std::max(a, b), i});
    }
    std::sort(entries.begin(), entries.end());
    for (std::size_t i = 1; i < entries.size(); ++i) {
      const Entry& a = entries[i - 1];
      const Entry& b = entries[i];
      if (a.low == b.low && a.high == b.high && mesh_.twin(Halfedge(a.h)) != Halfedge(b.h)) {
        fail(10, fmt::format("vertices {} and {} are joined by more than one edge", a.low, a.high));
      }
    }
  }

  void check_values() {
    for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i) {
      const Halfedge h(i);
      const float s = mesh_.sharpness(h);
      if (!(s >= 0.0F)) fail(11, name(h) + ": sharpness is negative or not a number");
      const Halfedge t = mesh_.twin(h);
      if (t.is_valid() && t.index() < mesh_.halfedge_count() && mesh_.sharpness(t) != s) {
        fail(11, name(h) + ": sharpness differs from its twin's");
      }
    }
    for (const float s : mesh_.vertex_sharpnesses()) {
      if (!(s >= 0.0F)) fail(11, "a vertex sharpness is negative or not a number");
    }
    for (std::uint32_t i = 0; i < mesh_.vertex_count(); ++i) {
      const glm::vec3& p = mesh_.position(Vertex(i));
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        fail(12, name(Vertex(i)) + ": position is not finite");
      }
    }
  }

  void check_bow_tie_copies() {
    const std::span<const BowTieCopy> copies = mesh_.bow_tie_copies();
    std::map<Vertex, int> copies_of;
    for (std::size_t i = 0; i < copies.size(); ++i) {
      const auto [v, first] = copies[i];
      if (i > 0 && !(copies[i - 1].v < v)) fail(13, "copies of bow-tie vertices do not ascend");
      if (v.index() >= mesh_.vertex_count() || mesh_.is_isolated(v)) {
        fail(13, "a copy of a bow-tie vertex is not a vertex that faces use");
        continue;
      }
      if (!copies_of.contains(first)) {
        if (first != v) fail(13, name(v) + ": not the lowest copy of its bow-tie vertex");
      } else if (first.index() < mesh_.vertex_count() &&
                 mesh_.position(v) != mesh_.position(first)) {
        fail(14, name(v) + ": position differs from the other copies of its bow-tie vertex");
      }
      ++copies_of[first];
    }
    for (const auto& [first, count] : copies_of) {
      if (count == 1) fail(13, name(first) + ": the only copy of its bow-tie vertex");
    }
  }

  const Mesh& mesh_;
  std::size_t limit_;
  bool is_sound_ = true;  // not derived from violations_, which stays empty with a limit of 0
  std::vector<Violation> violations_;
};

}  // namespace

namespace {

bool has_valid_wedges(const Mesh& mesh, const Attributes& a) {
  const std::uint32_t vertices = mesh.vertex_count();
  return std::all_of(a.corner_wedge.begin(), a.corner_wedge.end(), [&, h = 0U](Wedge w) mutable {
    const Vertex v = mesh.origin(Halfedge(h++));
    return w.index() < vertices + a.further.size() && a.vertex(w, vertices) == v;
  });
}

bool has_used_wedges(const Mesh& mesh, const Attributes& a) {
  std::vector<bool> is_used(a.further.size());
  for (const Wedge w : a.corner_wedge) {
    if (w.index() >= mesh.vertex_count()) is_used[w.index() - mesh.vertex_count()] = true;
  }
  return std::is_sorted(a.further.begin(), a.further.end()) &&
         std::all_of(is_used.begin(), is_used.end(), [](bool used) { return used; });
}

bool has_valid_layers(const Mesh& mesh, const Attributes& a) {
  std::set<std::string> names;
  return std::all_of(a.layers.begin(), a.layers.end(), [&](const AttributeLayer& layer) {
    return layer.count() == mesh.vertex_count() + a.further.size() &&
           names.insert(layer.type().name).second;
  });
}

bool has_valid_groups(const Mesh& mesh, const Attributes& a) {
  return a.group.empty() || (a.group.size() == mesh.face_count() &&
                             std::all_of(a.group.begin(), a.group.end(), [&](std::uint32_t group) {
                               return group < a.groups.size();
                             }));
}

}  // namespace

std::vector<Violation> validate(const Mesh& mesh, const Attributes& attributes) {
  std::vector<Violation> violations;
  const auto check = [&](bool holds, int invariant, const char* what) {
    if (!holds) violations.push_back({invariant, what});
    return holds;
  };
  const bool fits =
      attributes.corner_wedge.empty() || attributes.corner_wedge.size() == mesh.halfedge_count();
  check(fits && attributes.corner_wedge.empty() == attributes.further.empty(), 15,
        "corners have no wedge, or wedges no corner");
  check(has_valid_layers(mesh, attributes), 16,
        "a layer has too few or too many values, or a name "
        "occurs twice");
  if (fits &&
      check(has_valid_wedges(mesh, attributes), 17, "a corner's wedge is of another vertex"))
    check(has_used_wedges(mesh, attributes), 18, "further wedges are unsorted or unused");
  check(has_valid_groups(mesh, attributes), 19, "groups do not match the faces");
  return violations;
}

std::vector<Violation> validate(const Mesh& mesh, std::size_t limit) {
  return Validator(mesh, limit).run();
}

}  // namespace mesher
