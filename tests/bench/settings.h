#pragma once

#include <cstdint>
#include <filesystem>

namespace mesher::bench {

/// What a run measures. Every benchmark is called TASK/WHO and runs once a repetition, so that
/// Google Benchmark may interleave the repetitions of ours and its peers.
struct Settings {
  std::filesystem::path folder;        ///< where generated models are kept
  std::uint64_t obj_bytes = 0;         ///< size of the generated OBJ files
  std::uint32_t torus_size = 0;        ///< meshes have 2 * n * n triangles
  std::uint32_t frame_torus_size = 0;  ///< the same for the mesh that is drawn
};

void register_obj(const Settings& settings);
void register_build(const Settings& settings);
void register_normals(const Settings& settings);
void register_frame(const Settings& settings);

}  // namespace mesher::bench
