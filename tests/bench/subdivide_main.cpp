// bench_subdivide TASK WHO: measures one subdivision by one contender in a fresh process and prints
// a line of JSON. bench_subdivide --list GROWTH_FACES: lists all benchmarks, one TASK/WHO per line.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/io/read.h"
#include "engine/mesh/build/build.h"
#include "tests/bench/memory.h"
#include "tests/bench/models.h"
#include "tests/bench/subdividers.h"

namespace mesher::bench {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kParents = "subdivide_parents";
constexpr std::string_view kGrowth = "subdivide_growth_";

struct NamedSubdivider {
  std::string_view name;
  SubdivideArrays subdivide;
};
constexpr NamedSubdivider kSubdividers[] = {
    {"mesher", subdivide_ours},
    {"mesher, one thread", subdivide_ours_one_thread},
    {"mesher, half-edge mesh", subdivide_ours_to_mesh},
    {"mesher, half-edge mesh, one thread", subdivide_ours_to_mesh_one_thread},
    {"OpenSubdiv", subdivide_opensubdiv},
    {"OpenMesh", subdivide_openmesh},
    {"filling small pages", fill_small_pages},
    {"filling arrays", fill_arrays},
};

struct ScanTask {
  std::string_view name;
  const char* model;
  std::uint32_t levels;
  bool is_creased;
};
constexpr ScanTask kScans[] = {
    {"subdivide_armadillo", "armadillo.obj", 2, false},
    {"subdivide_bunny", "bunny.obj", 3, false},
    {"subdivide_bunny_creased", "bunny.obj", 3, true},
};

std::filesystem::path file_of(const char* model) {
  return std::filesystem::path(MESHER_SHARED_MODELS) / model;
}

/// OpenMesh has no creases and uses different rules at boundaries. It takes part only where it does
/// the same work.
bool takes_part(std::string_view who, std::string_view task) {
  if (who == "OpenMesh") return task == "subdivide_armadillo";
  if (task.starts_with(kGrowth))
    return who != "filling arrays" && who.find("half-edge") == std::string_view::npos;
  return true;
}

/// Makes every twentieth edge infinitely sharp, at random, with the same result on every machine.
void add_creases(const Mesh& mesh, Soup& soup) {
  std::mt19937 random(1);
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (mesh.edge(h).index() != i || random() % 20 != 0) continue;
    soup.creases.push_back({mesh.origin(h).index(), mesh.target(h).index(), kInfinitelySharp});
  }
}

SubdivisionWork work_of(std::string_view task) {
  const auto sized = [](Soup soup, std::uint32_t levels) {
    const Mesh mesh = build_mesh(Soup(soup)).mesh;
    return SubdivisionWork{
        .soup = std::move(soup),
        .options = {.levels = levels, .creases = subdivide::CreaseRules::derose98},
        .size = subdivide::subdivision_size(mesh, {.levels = levels})};
  };
  if (task.starts_with(kGrowth)) {
    const double faces = std::stod(std::string(task.substr(kGrowth.size())));
    return sized(bumpy_torus(static_cast<std::uint32_t>(std::lround(std::sqrt(faces / 2.0)))), 1);
  }
  const auto scan = std::ranges::find(kScans, task, &ScanTask::name);
  if (scan == std::end(kScans)) throw std::runtime_error("no such task: " + std::string(task));
  const Mesh mesh = io::read_model(file_of(scan->model)).mesh;
  SubdivisionWork work = sized(triangles_of(mesh), scan->levels);
  if (scan->is_creased) add_creases(mesh, work.soup);
  return work;
}

/// Bytes of the output and of the level from which it is made, including half-edges. Mesher holds
/// both at the same time.
double output_and_level_before(const SubdivisionWork& work, bool is_mesh) {
  constexpr double kPosition = sizeof(glm::vec3);
  constexpr double kCorners = 3.0 * sizeof(Vertex);
  constexpr double kOutgoing = sizeof(Halfedge);
  constexpr double kTwins = 3.0 * sizeof(Halfedge);
  constexpr double kSharpness = 3.0 * sizeof(float);
  const auto vertices = static_cast<double>(work.size.vertices);
  const auto faces = static_cast<double>(work.size.faces);
  double output = kPosition * vertices + kCorners * faces;
  if (is_mesh) output += kOutgoing * vertices + (kTwins + kSharpness) * faces;
  const subdivide::SubdivisionSize before = subdivide::subdivision_size(
      build_mesh(Soup(work.soup)).mesh, {.levels = work.options.levels - 1});
  const double sharpness = work.options.levels == 1 ? kSharpness : 0.0;
  return output + (kPosition + kOutgoing) * static_cast<double>(before.vertices) +
         (kCorners + kTwins + sharpness) * static_cast<double>(before.faces);
}

/// Sum of the positions divided by the number of vertices. All contenders must agree on it.
void note_result(const SubdivisionOutcome& outcome, Json& json) {
  const auto positions = outcome.mesh.face_count() > 0
                             ? outcome.mesh.positions()
                             : std::span<const glm::vec3>(outcome.triangles.position);
  if (positions.empty()) return;
  glm::dvec3 sum(0.0);
  for (const glm::vec3& p : positions)
    sum += glm::dvec3(p);
  sum /= static_cast<double>(positions.size());
  json["centre"] = {sum.x, sum.y, sum.z};
  json["faces"] =
      std::max<std::size_t>(outcome.mesh.face_count(), outcome.triangles.index.size() / 3);
}

struct Time {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of all threads; least affected by other load on the machine
};

template <class Run>
Time time_of(const Run& run) {
  const std::clock_t cpu = std::clock();
  const auto start = std::chrono::steady_clock::now();
  run();
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  return {elapsed.count(), 1000.0 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

void note_time(std::vector<Time> times, Json& json) {
  const auto middle = times.begin() + std::ptrdiff_t(times.size() / 2);
  std::ranges::nth_element(times, middle, {}, &Time::wall_ms);
  json["ms"] = middle->wall_ms;
  json["cpu_ms"] = middle->cpu_ms;
}

/// Records the peak memory of the first run, which uses fresh memory.
void note_memory(const SubdivisionWork& work, const NamedSubdivider& who, std::uint64_t bytes,
                 Json& json) {
  const auto rise = static_cast<double>(bytes);
  if (work.options.levels == 1) {
    json["peak_bytes_a_face"] = rise / work.soup.face_count();
  } else if (!who.name.starts_with("filling")) {
    const bool is_mesh = who.name.find("half-edge") != std::string_view::npos;
    json["peak_of_levels"] = rise / output_and_level_before(work, is_mesh);
  }
}

/// Small meshes of the growth tasks are subdivided repeatedly, until the time is long enough to
/// measure.
Json measure(const SubdivisionWork& work, const NamedSubdivider& who) {
  constexpr std::uint32_t kEnough = 300'000;
  const std::uint32_t faces = work.soup.face_count();
  const std::uint32_t runs = work.options.levels == 1 ? std::max(kEnough / faces, 1U) : 1U;
  Json json{{"items", faces}};
  std::vector<Time> times;
  for (std::uint32_t i = 0; i < runs; ++i) {
    SubdivisionWork input = work;
    SubdivisionOutcome outcome;
    const PeakMemory peak;
    times.push_back(time_of([&] { outcome = who.subdivide(std::move(input)); }));
    if (i > 0) continue;
    note_memory(work, who, peak.rise_bytes(), json);
    note_result(outcome, json);
  }
  note_time(std::move(times), json);
  return json;
}

constexpr std::string_view kSplitters[] = {"mesher", "mesher, building half-edges first",
                                           "hashing, std::unordered_map",
                                           "hashing, buckets reserved"};

subdivide::IndexedTriangles split(std::string_view who, const Mesh& mesh, const Soup& soup) {
  if (who == kSplitters[0]) return split_by_arithmetic(mesh);
  if (who == kSplitters[1]) return split_by_arithmetic(build_mesh(Soup(soup)).mesh);
  return split_by_hashing(soup, who == kSplitters[3]);
}

Json measure_split(std::string_view who) {
  const ThreadLimit one(1);
  const Mesh mesh = io::read_model(file_of("bunny.obj")).mesh;
  const Soup soup = triangles_of(mesh);
  subdivide::IndexedTriangles result;
  Json json;
  note_time({time_of([&] { result = split(who, mesh, soup); })}, json);
  const subdivide::IndexedTriangles expected = split_by_arithmetic(mesh);
  if (result.index != expected.index || result.position != expected.position) {
    throw std::runtime_error(std::string(who) + " makes other triangles");
  }
  json["faces"] = result.index.size() / 3;
  return json;
}

Json measure(std::string_view task, std::string_view who) {
  if (task == kParents) {
    if (std::ranges::find(kSplitters, who) != std::end(kSplitters)) return measure_split(who);
  } else {
    const auto subdivider = std::ranges::find(kSubdividers, who, &NamedSubdivider::name);
    if (subdivider != std::end(kSubdividers)) return measure(work_of(task), *subdivider);
  }
  throw std::runtime_error("nobody is called " + std::string(who));
}

void list_task(const std::string& task) {
  for (const NamedSubdivider& who : kSubdividers) {
    if (takes_part(who.name, task)) std::printf("%s/%s\n", task.c_str(), who.name.data());
  }
}

void list(std::uint32_t growth_faces) {
  for (const ScanTask& scan : kScans) {
    if (std::filesystem::exists(file_of(scan.model))) {
      list_task(std::string(scan.name));
    } else {
      std::fprintf(stderr, "bench_subdivide: SKIPPED %s: no %s\n", scan.name.data(),
                   file_of(scan.model).c_str());
    }
  }
  if (std::filesystem::exists(file_of("bunny.obj"))) {
    for (const std::string_view who : kSplitters)
      std::printf("%s/%s\n", kParents.data(), who.data());
  }
  for (std::uint32_t faces = 1'000; faces <= growth_faces; faces *= 10)
    list_task(std::string(kGrowth) + std::to_string(faces));
}

}  // namespace
}  // namespace mesher::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bench_subdivide TASK WHO | --list GROWTH_FACES\n");
    return 1;
  }
  try {
    if (std::strcmp(argv[1], "--list") == 0) {
      mesher::bench::list(static_cast<std::uint32_t>(std::stoul(argv[2])));
    } else {
      std::printf("%s\n", mesher::bench::measure(argv[1], argv[2]).dump().c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_subdivide: %s\n", error.what());
    return 1;
  }
  return 0;
}
