#include "tests/bench/subdividers.h"

#include <sys/mman.h>

#include <algorithm>
#include <new>
#include <unordered_map>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/build/build.h"
#include "engine/subdivide/butterfly.h"

namespace mesher::bench {
namespace {

void fill(std::uint32_t* words, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    words[i] = static_cast<std::uint32_t>(i);
  asm volatile("" : : "r"(words) : "memory");  // keeps the compiler from removing the stores
}

}  // namespace

SubdivisionOutcome subdivide_ours(SubdivisionWork&& work) {
  const Mesh mesh = build_mesh(std::move(work.soup)).mesh;
  return {.triangles = subdivide::subdivide_to_triangles(mesh, work.options)};
}

SubdivisionOutcome subdivide_ours_one_thread(SubdivisionWork&& work) {
  const ThreadLimit one(1);
  return subdivide_ours(std::move(work));
}

SubdivisionOutcome subdivide_ours_to_mesh(SubdivisionWork&& work) {
  const Mesh mesh = build_mesh(std::move(work.soup)).mesh;
  return {.mesh = subdivide::subdivide(mesh, work.options).mesh};
}

SubdivisionOutcome subdivide_ours_to_mesh_one_thread(SubdivisionWork&& work) {
  const ThreadLimit one(1);
  return subdivide_ours_to_mesh(std::move(work));
}

SubdivisionOutcome fill_small_pages(SubdivisionWork&& work) {
  const std::size_t words = 3 * (work.size.vertices + work.size.faces);
  const std::size_t bytes = sizeof(std::uint32_t) * words;
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, bytes, MADV_NOHUGEPAGE);
  fill(static_cast<std::uint32_t*>(memory), words);
  return {.memory = std::shared_ptr<void>(memory, [bytes](void* m) { munmap(m, bytes); })};
}

SubdivisionOutcome fill_arrays(SubdivisionWork&& work) {
  const auto position = std::make_shared<Array<std::uint32_t>>(3 * work.size.vertices);
  fill(position->data(), position->size());
  const auto corner = std::make_shared<Array<std::uint32_t>>(3 * work.size.faces);
  fill(corner->data(), corner->size());
  return {.memory =
              std::make_shared<std::pair<decltype(position), decltype(corner)>>(position, corner)};
}

subdivide::IndexedTriangles split_by_arithmetic(const Mesh& mesh) {
  subdivide::Level level = subdivide::midpoint_step(subdivide::view_of(mesh), {}, true);
  return {std::move(level.position), std::move(level.origin)};
}

subdivide::IndexedTriangles split_by_hashing(const Soup& soup, bool is_reserved) {
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_on;
  if (is_reserved) vertex_on.reserve(soup.corners.size() / 2);
  subdivide::IndexedTriangles fine;
  fine.position = soup.positions;
  fine.index.resize(4 * soup.corners.size());
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(fine.position.size());
    const std::uint64_t ends = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
    const auto [found, is_new] = vertex_on.try_emplace(ends, next);
    if (is_new) fine.position.push_back(0.5F * (soup.positions[a] + soup.positions[b]));
    return found->second;
  };
  for (std::size_t f = 0; f < soup.corners.size(); f += 3) {
    const std::uint32_t a = soup.corners[f];
    const std::uint32_t b = soup.corners[f + 1];
    const std::uint32_t c = soup.corners[f + 2];
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    Vertex* child = &fine.index[4 * f];
    for (const std::uint32_t v : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca})
      *child++ = Vertex(v);
  }
  return fine;
}

}  // namespace mesher::bench
