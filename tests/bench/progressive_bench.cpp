#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/io/read.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_read.h"
#include "engine/progressive/codec/pm_write.h"
#include "engine/simplify/simplify.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;
using Clock = std::chrono::steady_clock;

constexpr double kRatio = 0.01;
/// Bytes read from a file at a time.
constexpr std::size_t kPiece = std::size_t{64} << 10U;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <class Run>
void add(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(name.c_str(), std::move(run))
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

simplify::SimplifyOptions options_for(const Mesh& mesh) {
  return {.target_faces = static_cast<std::uint32_t>(kRatio * mesh.face_count())};
}

/// Simplifies a mesh. With `records`, also builds the progressive mesh that leads back to it.
void simplify_once(State& state, const Mesh& input, bool records, unsigned threads) {
  const ThreadLimit limit(threads);
  for (auto _ : state) {
    Mesh copy = input;
    simplify::CollapseRecorder recorder;
    simplify::SimplifyOptions options = options_for(input);
    if (records) options.observer = &recorder;
    const auto start = Clock::now();
    const simplify::Simplified simplified = simplify::simplify(std::move(copy), options);
    progressive::Progressive progressive;
    if (records) progressive = progressive::build_progressive(input, recorder.records());
    state.SetIterationTime(seconds_since(start));
    benchmark::DoNotOptimize(simplified.mesh.face_count() + progressive.mesh.split_count());
  }
}

/// Applies all splits in one direction.
void play(State& state, const Mesh& input, bool up) {
  const ThreadLimit one(1);
  progressive::ProgressiveMesh mesh =
      std::move(progressive::make_progressive(input, options_for(input)).mesh);
  mesh.go_to(mesh.split_count());  // allocates all memory before the measurement
  mesh.go_to(up ? 0 : mesh.split_count());
  for (auto _ : state) {
    const auto start = Clock::now();
    mesh.go_to(up ? mesh.split_count() : 0);
    const double seconds = seconds_since(start);
    state.SetIterationTime(seconds);
    state.counters["million_splits_per_s"] = 1e-6 * mesh.split_count() / seconds;
  }
}

/// Reads a whole file from memory up to the finest level.
void read(State& state, const Mesh& input, unsigned coordinate_bits) {
  const ThreadLimit one(1);
  progressive::ProgressiveMesh mesh =
      std::move(progressive::make_progressive(input, {.target_faces = 200}).mesh);
  std::vector<std::byte> file;
  progressive::write_pm(mesh, {.coordinate_bits = coordinate_bits},
                        [&](std::span<const std::byte> bytes) {
                          file.insert(file.end(), bytes.begin(), bytes.end());
                        });
  const double plain_bytes = 12.0 * input.vertex_count() + 12.0 * input.face_count();
  for (auto _ : state) {
    const auto start = Clock::now();
    progressive::PmReader reader("benchmark");
    for (std::size_t at = 0; at < file.size(); at += kPiece)
      reader.feed(std::span(file).subspan(at, std::min(kPiece, file.size() - at)));
    reader.finish();
    const double seconds = seconds_since(start);
    if (!reader.is_complete()) state.SkipWithError("the file is not whole");
    state.SetIterationTime(seconds);
    state.counters["decoded_mb_per_s"] = 1e-6 * plain_bytes / seconds;
    state.counters["bits_a_vertex"] = 8.0 * static_cast<double>(file.size()) / input.vertex_count();
    state.counters["share_of_indexed"] = static_cast<double>(file.size()) / plain_bytes;
  }
}

}  // namespace

void register_progressive(const Settings& settings) {
  const std::filesystem::path file = settings.scans / "armadillo.obj";
  if (!std::filesystem::exists(file)) {
    std::fprintf(stderr, "bench_engine: SKIPPED progressive_*: no %s\n", file.string().c_str());
    return;
  }
  const auto mesh = std::make_shared<const Mesh>(io::read_model(file, {}).mesh);
  const auto add_simplify = [&](const std::string& who, bool records, unsigned threads) {
    add("progressive_record/" + who,
        [=](State& state) { simplify_once(state, *mesh, records, threads); });
  };
  add_simplify("mesher", true, 0);
  add_simplify("mesher, one thread", true, 1);
  add_simplify("simplification alone", false, 0);
  add_simplify("simplification alone, one thread", false, 1);
  add("progressive_up/mesher", [=](State& state) { play(state, *mesh, true); });
  add("progressive_read/mesher", [=](State& state) { read(state, *mesh, 0); });
  add("progressive_read_14/mesher", [=](State& state) { read(state, *mesh, 14); });
  add("progressive_down/mesher", [=](State& state) { play(state, *mesh, false); });
}

}  // namespace mesher::bench
