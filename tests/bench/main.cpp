// bench_engine FOLDER OBJ_BYTES TORUS_SIZE FRAME_TORUS_SIZE [Google Benchmark's flags]; see
// scripts/bench.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <string>

#include "tests/bench/settings.h"

int main(int argc, char** argv) {
  using namespace mesher::bench;
  if (argc < 5) {
    std::fprintf(
        stderr,
        "usage: bench_engine FOLDER OBJ_BYTES TORUS_SIZE FRAME_TORUS_SIZE [benchmark flags]\n");
    return 1;
  }
  try {
    const Settings settings{.folder = argv[1],
                            .obj_bytes = std::stoull(argv[2]),
                            .torus_size = static_cast<std::uint32_t>(std::stoul(argv[3])),
                            .frame_torus_size = static_cast<std::uint32_t>(std::stoul(argv[4]))};
    register_obj(settings);
    register_build(settings);
    register_normals(settings);
    register_frame(settings);
    argv[4] = argv[0];
    argc -= 4;
    benchmark::Initialize(&argc, argv + 4);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_engine: %s\n", error.what());
    return 1;
  }
  return 0;
}
