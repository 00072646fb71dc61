#include "tests/subdivide/models.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "engine/subdivide/options.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using Path = std::vector<std::uint32_t>;

/// Collects models: a shape with its sharp edges and vertices.
class Collector {
 public:
  Model& add(std::string name, Soup soup) {
    const auto seed = static_cast<std::uint32_t>(models_.size() + 1);
    Mesh mesh =
        build_mesh(jittered(std::move(soup), 0.05F, seed), {.keep_isolated_vertices = true}).mesh;
    models_.push_back({std::move(name), std::move(mesh)});
    return models_.back();
  }
  std::vector<Model> take() { return std::move(models_); }

 private:
  std::vector<Model> models_;
};

/// Makes the edges of a path sharp. Fails the test if an edge does not exist.
void sharpen(Model& model, const Path& path, float sharpness = kInfinitelySharp) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Edge e = model.mesh.find_edge(Vertex(path[i]), Vertex(path[i + 1]));
    ASSERT_NE(e, Edge()) << model.name << ": " << path[i] << ' ' << path[i + 1];
    model.mesh.set_sharpness(e, sharpness);
  }
}

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::set<Edge> edges;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    edges.insert(mesh.edge(Halfedge(h)));
  return {edges.begin(), edges.end()};
}

Soup without_faces(Soup soup, std::uint32_t first, std::uint32_t count) {
  const auto begin = soup.corners.begin() + 3 * std::ptrdiff_t(first);
  soup.corners.erase(begin, begin + 3 * std::ptrdiff_t(count));
  return soup;
}

Soup with_isolated(Soup soup) {
  soup.positions.emplace_back(9, 9, 9);
  soup.positions.insert(soup.positions.begin(), {-9, -9, -9});
  for (std::uint32_t& v : soup.corners)
    ++v;
  return soup;
}

/// Two octahedra that touch at two vertices.
Soup octahedra_that_touch_twice() {
  Soup soup = join(octahedron(), octahedron(), {0, 3, 0});
  for (std::uint32_t& v : soup.corners)
    v = v == 6 ? 0 : v == 8 ? 2 : v;
  return soup;
}

void add_smooth_ones(Collector& all) {
  all.add("tetrahedron", tetrahedron());
  all.add("octahedron", octahedron());
  all.add("icosahedron", icosahedron());
  all.add("cube", cube());
  all.add("torus", torus(6, 5));
  for (const std::uint32_t n : {3, 5, 6, 7, 8, 9, 12, 16, 23, 32, 48, 64})
    all.add("bipyramid of " + std::to_string(n), bipyramid(n));
  Soup every = bipyramid(3);
  for (std::uint32_t n = 4; n <= 64; ++n)
    every = join(std::move(every), bipyramid(n), {3.0F * float(n), 0, 0});
  all.add("bipyramids of 3 to 64", std::move(every));
}

void add_open_ones(Collector& all) {
  all.add("one triangle", soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}));
  all.add("two triangles",
          soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2, 1, 3, 2}));
  for (const std::uint32_t n : {2, 3, 4, 6, 13})
    all.add("open fan of " + std::to_string(n), fan(n, false));
  for (const std::uint32_t n : {3, 5, 6, 64})
    all.add("closed fan of " + std::to_string(n), fan(n, true));
  all.add("grid", grid(3));
  all.add("open box", without_faces(cube(), 2, 2));
  all.add("tetrahedron with a hole", without_faces(tetrahedron(), 1, 1));
  all.add("two components", join(tetrahedron(), grid(2), {2, 0, 0}));
  all.add("isolated vertices", with_isolated(fan(5, true)));
}

void add_creased_ones(Collector& all) {
  sharpen(all.add("torus, regular crease", torus(6, 6)), {0, 6, 12, 18, 24, 30, 0});
  sharpen(all.add("torus, crease 2|4", torus(6, 6)), {0, 6, 13, 19, 26, 32, 33});
  Model& crossing = all.add("torus, crossing creases", torus(6, 5));
  sharpen(crossing, {0, 5, 10, 15, 20, 25, 0});
  sharpen(crossing, {0, 1, 2, 3, 4, 0});
  sharpen(all.add("octahedron, equator", octahedron()), {0, 1, 2, 3, 0});
  Model& three = all.add("octahedron, three loops", octahedron());
  sharpen(three, {0, 1, 2, 3, 0});
  sharpen(three, {0, 4, 2, 5, 0});
  sharpen(three, {1, 4, 3, 5, 1});
  sharpen(all.add("icosahedron, crease loop", icosahedron()), {1, 2, 3, 4, 5, 1});
  sharpen(all.add("icosahedron, path with two darts", icosahedron()), {0, 1, 6});
  sharpen(all.add("octahedron, one edge with two darts", octahedron()), {0, 1});
  Model& darts = all.add("tetrahedron, four darts", tetrahedron());
  sharpen(darts, {0, 1});
  sharpen(darts, {2, 3});
  sharpen(all.add("tetrahedron, two darts", tetrahedron()), {0, 1});
  sharpen(all.add("tetrahedron, three at a corner", tetrahedron()), {1, 0, 2});
  sharpen(all.add("torus, long dart", torus(6, 6)), {0, 6, 12, 18});
  sharpen(all.add("bipyramid of 64, crease 32|32", bipyramid(64)), {2, 0, 34});
  sharpen(all.add("bipyramid of 64, crease 1|63", bipyramid(64)), {2, 0, 3});
  sharpen(all.add("bipyramid of 7, dart at the tip", bipyramid(7)), {0, 4});
  sharpen(all.add("bipyramid of 6, crease 3|3", bipyramid(6)), {3, 0, 6, 1, 3});
  sharpen(all.add("grid, crease to the boundary", grid(3)), {4, 5, 6, 7});
  sharpen(all.add("grid, dart from the boundary", grid(3)), {4, 5});
  sharpen(all.add("closed fan of 6, crease across", fan(6, true)), {1, 0, 4});
  sharpen(all.add("two triangles, crease between",
                  soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2, 1, 3, 2})),
          {1, 2});
  Model& box = all.add("open box, sharp corners", without_faces(cube(), 2, 2));
  sharpen(box, {0, 1, 2, 3, 0, 4});
  sharpen(box, {1, 5});
}

void add_corners(Collector& all) {
  const auto set = [](Model& model, std::uint32_t v, float sharpness) {
    model.mesh.set_sharpness(Vertex(v), sharpness);
  };
  set(all.add("icosahedron, a corner", icosahedron()), 3, kInfinitelySharp);
  Model& crease = all.add("torus, corner on a crease", torus(6, 6));
  sharpen(crease, {0, 6, 12, 18, 24, 30, 0});
  set(crease, 12, kInfinitelySharp);
  set(all.add("grid, corner on the boundary", grid(3)), 1, kInfinitelySharp);
  Model& soft = all.add("icosahedron, soft corners", icosahedron());
  set(soft, 0, 0.4F);
  set(soft, 5, 1.7F);
  set(soft, 9, 2.0F);
  set(soft, 10, 12.0F);
  Model& mixed = all.add("octahedron, soft corners on a soft crease", octahedron());
  sharpen(mixed, {0, 1, 2, 3, 0}, 1.3F);
  set(mixed, 0, 0.6F);
  set(mixed, 2, 2.2F);
  set(all.add("grid, soft corner on the boundary", grid(3)), 0, 1.5F);
}

void add_soft_ones(Collector& all) {
  for (const float s : {0.25F, 0.5F, 1.0F, 1.5F, 2.0F, 2.75F, 3.3F, 5.0F, 9.9F, 10.0F, 10.5F}) {
    const std::string value = std::to_string(s).substr(0, 4);
    sharpen(all.add("icosahedron, loop of " + value, icosahedron()), {1, 2, 3, 4, 5, 1}, s);
    Model& model = all.add("cube, crossing of " + value, cube());
    sharpen(model, {0, 1, 2, 3, 0}, s);
    sharpen(model, {1, 5}, s);
    sharpen(model, {4, 7}, s);
  }
  Model& zero = all.add("icosahedron, loop of 0", icosahedron());
  sharpen(zero, {1, 2, 3, 4, 5, 1}, 0.0F);
  const Path loop{0, 6, 12, 18, 24, 30, 0};
  Model& varying = all.add("torus, varying loop", torus(6, 6));
  const std::vector<float> along{0.25F, 1.2F, 0.1F, 3.3F, 9.9F, kInfinitelySharp};
  for (std::size_t i = 0; i < along.size(); ++i)
    sharpen(varying, {loop[i], loop[i + 1]}, along[i]);
  Model& star = all.add("bipyramid of 7, spokes of all kinds", bipyramid(7));
  const std::vector<float> spokes{0.5F, 1.5F, 2.75F, 0.25F, 0.9F, 5.0F, 0.0F};
  for (std::uint32_t i = 0; i < 7; ++i)
    sharpen(star, {0, 2 + i}, spokes[i]);
  Model& sheet = all.add("grid, soft crease to the boundary", grid(3));
  sharpen(sheet, {4, 5, 6, 7}, 2.5F);
  sharpen(sheet, {1, 5, 9, 13}, 0.7F);
  sharpen(sheet, {0, 1, 2, 3}, 0.5F);
}

void add_bow_ties(Collector& all) {
  all.add("two tetrahedra that touch", bow_tie({tetrahedron(), tetrahedron()}));
  all.add("two cubes that touch", bow_tie({cube(), cube()}));
  all.add("three fans at a vertex", bow_tie({cube(), fan(5, true), tetrahedron()}));
  all.add("open fans at a vertex", bow_tie({fan(4, false), fan(1, false), fan(2, false)}));
  all.add("grid corners that touch", bow_tie({grid(2), grid(3), cube()}));
  Model& creased = all.add("creased cubes that touch", bow_tie({cube(), cube()}));
  sharpen(creased, {0, 1, 2, 3, 0});
  sharpen(creased, {8, 15, 11}, 2.5F);
  creased.mesh.set_sharpness(Vertex(15), 0.7F);
  Model& both = all.add("two bow ties", octahedra_that_touch_twice());
  EXPECT_EQ(both.mesh.bow_tie_copies().size(), 4U);
}

void add_random_ones(Collector& all) {
  const std::vector<float> soft{0.25F, 0.5F, 1.0F, 1.5F, 2.75F, 3.3F, 9.9F, kInfinitelySharp};
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    std::mt19937 random(seed);
    const bool is_soft = seed % 2 == 1;
    const auto shape = [&]() -> Soup {
      if (seed % 8 < 2) return icosahedron();
      if (seed % 8 < 4) return torus(5, 4);
      if (seed % 8 < 6) return grid(4);
      return join(bipyramid(5), fan(7, seed % 3 == 0), {4, 0, 0});
    };
    Model& model = all.add("random " + std::to_string(seed), shape());
    for (const Edge e : edges_of(model.mesh)) {
      if (random() % 4 != 0) continue;
      model.mesh.set_sharpness(e, is_soft ? soft[random() % soft.size()] : kInfinitelySharp);
    }
    for (std::uint32_t v = 0; v < model.mesh.vertex_count(); ++v) {
      if (random() % 8 != 0) continue;
      model.mesh.set_sharpness(Vertex(v),
                               is_soft ? soft[random() % soft.size()] : kInfinitelySharp);
    }
  }
}

}  // namespace

const std::vector<Model>& models() {
  static const std::vector<Model> all = [] {
    Collector collector;
    add_smooth_ones(collector);
    add_open_ones(collector);
    add_creased_ones(collector);
    add_corners(collector);
    add_soft_ones(collector);
    add_random_ones(collector);
    add_bow_ties(collector);
    return collector.take();
  }();
  return all;
}

bool is_settled(const Mesh& mesh) {
  const auto settled = [](float s) { return s == 0.0F || s >= subdivide::kSharpForEver; };
  return std::ranges::all_of(mesh.sharpnesses(), settled) &&
         std::ranges::all_of(mesh.vertex_sharpnesses(), settled);
}

bool is_untagged(const Mesh& mesh) {
  const auto zero = [](float s) { return s == 0.0F; };
  return mesh.bow_tie_copies().empty() && std::ranges::all_of(mesh.sharpnesses(), zero) &&
         std::ranges::all_of(mesh.vertex_sharpnesses(), zero);
}

Soup bipyramid(std::uint32_t valence) {
  Soup soup = soup_of({{0, 0, 1}, {0, 0, -1}}, {});
  for (std::uint32_t i = 0; i < valence; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / valence;
    soup.positions.emplace_back(glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
    const std::uint32_t a = 2 + i;
    const std::uint32_t b = 2 + (i + 1) % valence;
    for (const std::uint32_t v : {0U, a, b, 1U, b, a})
      soup.corners.push_back(v);
  }
  return soup;
}

Soup fan(std::uint32_t faces, bool is_closed) {
  Soup soup = soup_of({{0, 0, 0.5F}}, {});
  const std::uint32_t rim = is_closed ? faces : faces + 1;
  for (std::uint32_t i = 0; i < rim; ++i) {
    const double angle = (is_closed ? 2.0 : 1.5) * std::numbers::pi * i / faces;
    soup.positions.emplace_back(glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
  }
  for (std::uint32_t i = 0; i < faces; ++i) {
    for (const std::uint32_t v : {0U, 1 + i, 1 + (i + 1) % rim})
      soup.corners.push_back(v);
  }
  return soup;
}

/// Vertex 0 on top, a ring of 1 to 5, a ring of 6 to 10, vertex 11 at the bottom.
Soup icosahedron() {
  Soup soup = soup_of({{0, 0, 1}}, {});
  for (std::uint32_t i = 0; i < 10; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % 5 + (i < 5 ? 0.0 : 0.5)) / 5.0;
    const double z = i < 5 ? std::sqrt(0.2) : -std::sqrt(0.2);
    const double r = std::sqrt(0.8);
    soup.positions.emplace_back(glm::dvec3(r * std::cos(angle), r * std::sin(angle), z));
  }
  soup.positions.emplace_back(0, 0, -1);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::uint32_t a = 1 + i;
    const std::uint32_t b = 1 + (i + 1) % 5;
    for (const std::uint32_t v : {0U, a, b, a, a + 5, b, b, a + 5, b + 5, 11U, b + 5, a + 5})
      soup.corners.push_back(v);
  }
  return soup;
}

/// An equator of 0 to 3, vertex 4 on top, vertex 5 at the bottom.
Soup octahedron() {
  return soup_of({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5});
}

Soup jittered(Soup soup, float by, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto step = [&] { return by * (float(random() % 2001) / 1000.0F - 1.0F); };
  for (glm::vec3& p : soup.positions)
    p += glm::vec3(step(), step(), step());
  return soup;
}

std::uint32_t affordable_levels(const Mesh& mesh, std::uint32_t most) {
  constexpr std::uint64_t kMostFaces = 70'000;
  std::uint64_t faces = mesh.face_count();
  std::uint32_t levels = 0;
  for (; levels < most && 4 * faces <= kMostFaces; ++levels)
    faces *= 4;
  return levels;
}

}  // namespace mesher::test
