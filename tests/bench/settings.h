#pragma once

#include <cstdint>
#include <filesystem>

namespace mesher::bench {

/// Parameters of a run. Every benchmark is called TASK/WHO and runs once per repetition, so that
/// Google Benchmark can interleave the repetitions of mesher and its peers. Tasks called
/// NAME_growth_N measure the same work at several sizes N.
struct Settings {
  std::filesystem::path folder;        ///< folder of the generated models
  std::filesystem::path scans;         ///< real models, which may be missing
  std::uint64_t obj_bytes = 0;         ///< size of the generated OBJ files
  std::uint32_t torus_size = 0;        ///< meshes have 2 * n * n triangles
  std::uint32_t frame_torus_size = 0;  ///< the same for the mesh of the frame tasks
  std::uint32_t growth_faces = 0;      ///< the largest mesh of the growth tasks
};

void register_obj(const Settings& settings);
void register_build(const Settings& settings);
void register_normals(const Settings& settings);
void register_frame(const Settings& settings);
void register_simplify(const Settings& settings);
void register_progressive(const Settings& settings);
void register_queue(const Settings& settings);
void register_steps(const Settings& settings);

}  // namespace mesher::bench
