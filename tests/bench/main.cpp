// bench_engine FOLDER OBJ_BYTES TORUS_SIZE FRAME_TORUS_SIZE GROWTH_FACES PREFIX [Google Benchmark
// flags]; see scripts/bench. Runs only tasks whose names start with PREFIX.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "engine/io/cut_mapping.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

constexpr int kArguments = 6;

/// Tasks that are registered together, because they share models.
struct Group {
  std::string_view tasks;  ///< prefix of their names
  void (*add)(const Settings&);
};

constexpr std::array kGroups{
    Group{"obj_", register_obj},           Group{"build", register_build},
    Group{"normals_", register_normals},   Group{"frame_", register_frame},
    Group{"simplify_", register_simplify}, Group{"queue_", register_queue},
    Group{"steps_", register_steps},       Group{"progressive_", register_progressive},
};

Settings read_settings(char** argv) {
  const auto number = [&](int i) { return static_cast<std::uint32_t>(std::stoul(argv[i])); };
  return {.folder = argv[1],
          .scans = MESHER_SHARED_MODELS,
          .obj_bytes = std::stoull(argv[2]),
          .torus_size = number(3),
          .frame_torus_size = number(4),
          .growth_faces = number(5)};
}

void run(int argc, char** argv) {
  const Settings settings = read_settings(argv);
  const std::string_view prefix = argv[kArguments];
  for (const Group& group : kGroups) {
    if (group.tasks.starts_with(prefix) || prefix.starts_with(group.tasks)) group.add(settings);
  }
  const std::string filter = "--benchmark_filter=^" + std::string(prefix);
  argv[kArguments - 1] = argv[0];
  argv[kArguments] = const_cast<char*>(filter.c_str());
  argc -= kArguments - 1;
  benchmark::Initialize(&argc, argv + kArguments - 1);
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace
}  // namespace mesher::bench

int main(int argc, char** argv) {
  mesher::io::survive_cut_mappings();  // as the program: files are mapped then
  if (argc <= mesher::bench::kArguments) {
    std::fprintf(stderr,
                 "usage: bench_engine FOLDER OBJ_BYTES TORUS_SIZE FRAME_TORUS_SIZE GROWTH_FACES "
                 "PREFIX [benchmark flags]\n");
    return 1;
  }
  try {
    mesher::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_engine: %s\n", error.what());
    return 1;
  }
  return 0;
}
