#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "tests/bench/contenders.h"

namespace mesher::bench {
namespace {

namespace Simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using PeerMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using GarlandHeckbert = Simplification::GarlandHeckbert_plane_policies<PeerMesh, Kernel>;

PeerMesh make_mesh(const Soup& soup) {
  PeerMesh mesh;
  mesh.reserve(static_cast<PeerMesh::size_type>(soup.positions.size()),
               static_cast<PeerMesh::size_type>(soup.corners.size() / 2), soup.face_count());
  for (const glm::vec3& p : soup.positions)
    mesh.add_vertex(Kernel::Point_3(double{p.x}, double{p.y}, double{p.z}));
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const auto corner = [&](std::size_t i) { return PeerMesh::Vertex_index(soup.corners[c + i]); };
    mesh.add_face(corner(0), corner(1), corner(2));
  }
  return mesh;
}

/// Pre: no garbage.
Soup make_arrays(const PeerMesh& mesh) {
  Soup soup;
  soup.positions.reserve(mesh.number_of_vertices());
  soup.corners.reserve(3 * std::size_t{mesh.number_of_faces()});
  for (const auto v : mesh.vertices()) {
    const Kernel::Point_3& p = mesh.point(v);
    soup.positions.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      soup.corners.push_back(v);
  }
  return soup;
}

/// A stop condition by faces, because CGAL 5.5 counts only edges.
struct FacesAtMost {
  std::size_t target = 0;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return profile.surface_mesh().number_of_faces() <= target;
  }
};

}  // namespace

Soup simplify_cgal_lindstrom_turk(Soup&& soup, std::uint32_t target_faces) {
  PeerMesh mesh = make_mesh(soup);
  // The default cost and placement of CGAL. Without the filter it is no faster and folds more
  // faces.
  const Simplification::Bounded_normal_change_filter<> filter;
  Simplification::edge_collapse(mesh, FacesAtMost{target_faces}, CGAL::parameters::filter(filter));
  mesh.collect_garbage();
  return make_arrays(mesh);
}

Soup simplify_cgal_garland_heckbert(Soup&& soup, std::uint32_t target_faces) {
  PeerMesh mesh = make_mesh(soup);
  const GarlandHeckbert policies(mesh);
  Simplification::edge_collapse(
      mesh, FacesAtMost{target_faces},
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  mesh.collect_garbage();
  return make_arrays(mesh);
}

}  // namespace mesher::bench
