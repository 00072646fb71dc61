#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/io/read.h"
#include "tests/bench/contenders.h"
#include "tests/bench/memory.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"
#include "tests/bench/surface_quality.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;

/// A large value that is built on first use. A run of a few tasks builds only a few of them.
template <class Value>
class Lazy {
 public:
  explicit Lazy(std::function<Value()> make) : make_(std::move(make)) {}
  const Value& get() {
    if (!value_) value_.emplace(make_());
    return *value_;
  }

 private:
  std::function<Value()> make_;
  std::optional<Value> value_;
};

using SharedReference = std::shared_ptr<Lazy<Reference>>;
using SharedSoup = std::shared_ptr<Lazy<Soup>>;

struct Task {
  std::string name;
  SharedReference model;
  double ratio = 0.0;     ///< fraction of the faces to keep
  bool is_large = false;  ///< slow contenders run it only once
};

/// Times one run and records its result and its peak memory, without the input. Returns the
/// simplified triangles.
Soup measure(State& state, const Soup& soup, SimplifyArrays simplify, double ratio) {
  const auto target = static_cast<std::uint32_t>(ratio * soup.face_count());
  Soup result;
  for (auto _ : state) {
    Soup input = soup;
    const PeakMemory peak;
    const auto start = std::chrono::steady_clock::now();
    result = simplify(std::move(input), target);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(elapsed.count());
    state.counters["peak_bytes_a_face"] =
        static_cast<double>(peak.rise_bytes()) / soup.face_count();
  }
  state.counters["faces"] = result.face_count();
  state.counters["faces_asked"] = target;
  return result;
}

void note_quality(State& state, const Reference& reference, const Soup& result) {
  if (result.corners.empty()) return state.SkipWithError("nothing left");
  const SurfaceQuality quality = surface_quality(reference, result);
  auto& counters = state.counters;
  counters["rms_percent"] = quality.rms_percent;
  counters["max_percent"] = quality.max_percent;
  counters["nonmanifold_edges"] = quality.defects.nonmanifold_edges;
  counters["folded_edges"] = quality.defects.folded_edges;
  counters["folded_edges_before"] = reference.defects.folded_edges;
  counters["euler"] = static_cast<double>(quality.defects.euler_characteristic);
  counters["euler_before"] = static_cast<double>(reference.defects.euler_characteristic);
}

template <class Run>
benchmark::internal::Benchmark* add(const std::string& name, Run run) {
  return benchmark::RegisterBenchmark(name.c_str(), std::move(run))
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void add(const Task& task, const Contender& contender) {
  // Every repetition gives the same mesh, so only the first one is evaluated.
  const auto run = [=, is_judged = false](State& state) mutable {
    const Reference& reference = task.model->get();
    const Soup result = measure(state, reference.soup, contender.simplify, task.ratio);
    if (!std::exchange(is_judged, true)) note_quality(state, reference, result);
  };
  auto* benchmark = add(task.name + "/" + std::string(contender.name), run);
  if (task.is_large && contender.is_slow) benchmark->Repetitions(1);
}

SharedReference share(std::function<Soup()> load) {
  return std::make_shared<Lazy<Reference>>([load = std::move(load)] { return Reference(load()); });
}

void add_model(const std::string& name, std::function<Soup()> load, bool is_large) {
  const SharedReference model = share(std::move(load));
  for (const auto& [percent, ratio] : {std::pair{"_10", 0.1}, std::pair{"_1", 0.01}}) {
    for (const Contender& contender : contenders())
      add({"simplify_" + name + percent, model, ratio, is_large}, contender);
  }
}

void add_scan(const Settings& settings, const std::string& name) {
  const std::filesystem::path file = settings.scans / (name + ".obj");
  if (!std::filesystem::exists(file)) {
    std::fprintf(stderr, "bench_engine: SKIPPED simplify_%s: no %s\n", name.c_str(),
                 file.string().c_str());
    return;
  }
  add_model(
      name, [file] { return triangles_of(io::read_model(file).mesh); }, false);
}

/// Adds the tasks on shuffled models without the slow contenders: the order of vertices and faces
/// affects only caches.
void add_shuffled(std::uint32_t torus_size) {
  const SharedReference model = share([=] { return shuffled(bumpy_torus(torus_size)); });
  for (const Contender& contender : contenders()) {
    if (!contender.is_slow) add({"simplify_shuffled_1", model, 0.01, true}, contender);
  }
}

/// Size n of a grid of 2 n * n triangles with about `faces` triangles.
std::uint32_t grid_size(std::uint32_t faces) {
  return static_cast<std::uint32_t>(std::lround(std::sqrt(faces / 2.0)));
}

void add_growth(std::uint32_t faces) {
  const auto make = [faces] { return bumpy_torus(grid_size(faces)); };
  const auto model = std::make_shared<Lazy<Soup>>(make);
  const auto add_who = [&](const std::string& who, SimplifyArrays simplify) {
    const auto run = [=](State& state) {
      const Soup& soup = model->get();
      measure(state, soup, simplify, 0.01);
      state.counters["items"] = soup.face_count();
    };
    auto* benchmark = add("simplify_growth_" + std::to_string(faces) + "/" + who, run);
    if (faces >= 10'000'000) benchmark->Repetitions(1);
  };
  add_who("mesher", simplify_ours);
  add_who("meshoptimizer", simplify_meshoptimizer);
}

}  // namespace

void register_simplify(const Settings& settings) {
  add_scan(settings, "bunny");
  add_scan(settings, "armadillo");
  add_model(
      "large", [n = settings.torus_size] { return bumpy_torus(n); }, true);
  add_shuffled(settings.torus_size);
  for (std::uint32_t faces = 10'000; faces <= settings.growth_faces; faces *= 10)
    add_growth(faces);
}

}  // namespace mesher::bench
