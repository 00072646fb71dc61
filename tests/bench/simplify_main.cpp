// bench_simplify MODEL RATIO [WHO...]: simplifies a model to RATIO of its faces with mesher and
// each peer (or with those whose names start with a WHO) and prints time, accuracy and defects.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <string_view>

#include "engine/io/read.h"
#include "tests/bench/contenders.h"
#include "tests/bench/models.h"
#include "tests/bench/surface_quality.h"

namespace mesher::bench {
namespace {

/// Loads a file, or generates "bumpy:N", the closed surface of 2 N * N triangles that scripts/bench
/// uses, or "shuffled:N", the same in random order.
Soup load(const std::string& name) {
  const auto generated = [&](std::string_view kind) {
    return bumpy_torus(static_cast<std::uint32_t>(std::stoul(name.substr(kind.size()))));
  };
  if (name.starts_with("bumpy:")) return generated("bumpy:");
  if (name.starts_with("shuffled:")) return shuffled(generated("shuffled:"));
  return triangles_of(io::read_model(name).mesh);
}

void print_run(const Contender& contender, const Reference& reference, std::uint32_t target) {
  Soup input = reference.soup;
  const auto start = std::chrono::steady_clock::now();
  const Soup result = contender.simplify(std::move(input), target);
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  const SurfaceQuality quality = surface_quality(reference, result);
  std::printf("%-22s %10.1f %9u %9.5f %9.4f %12u %6lld %7u\n", contender.name.data(),
              elapsed.count(), result.face_count(), quality.rms_percent, quality.max_percent,
              quality.defects.nonmanifold_edges,
              static_cast<long long>(quality.defects.euler_characteristic),
              quality.defects.folded_edges);
  std::fflush(stdout);
}

void run(const std::string& model, double ratio, std::span<char*> who) {
  const Reference reference(load(model));
  const auto target = static_cast<std::uint32_t>(ratio * reference.soup.face_count());
  std::printf("%u faces to %u; Euler characteristic %lld, %u folded edges\n",
              reference.soup.face_count(), target,
              static_cast<long long>(reference.defects.euler_characteristic),
              reference.defects.folded_edges);
  std::printf("%-22s %10s %9s %9s %9s %12s %6s %7s\n", "who", "ms", "faces", "RMS %", "max %",
              "non-manifold", "Euler", "folded");
  for (const Contender& contender : contenders()) {
    const auto is_named = [&](const char* prefix) { return contender.name.starts_with(prefix); };
    if (who.empty() || std::ranges::any_of(who, is_named)) print_run(contender, reference, target);
  }
}

}  // namespace
}  // namespace mesher::bench

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_simplify MODEL|bumpy:N|shuffled:N RATIO [WHO...]\n");
    return 1;
  }
  try {
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    mesher::bench::run(argv[1], std::stod(argv[2]), arguments.subspan(3));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_simplify: %s\n", error.what());
    return 1;
  }
  return 0;
}
