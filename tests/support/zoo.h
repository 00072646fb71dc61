#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/build/report.h"

namespace mesher::test {

/// The expected result of reading a specimen. `read`: a mesh whose invariants hold. `refused`: an
/// InputError of one line that names the file.
enum class Fate { read, refused };

/// A file that is broken or unusual.
struct Specimen {
  std::string name;
  std::string extension;  ///< with the dot
  std::string bytes;
  Fate fate = Fate::refused;
  std::optional<std::uint32_t> faces = std::nullopt;  ///< of the mesh, if it is read and known
  /// The repairs that must be reported, with their counts.
  std::vector<std::pair<Repair, std::uint64_t>> repairs = {};
};

/// Adds specimens of one format.
class Enclosure {
 public:
  Enclosure(std::vector<Specimen>& zoo, std::string extension)
      : zoo_(zoo), extension_(std::move(extension)) {}

  void read(std::string name, std::string bytes, std::uint32_t faces,
            std::vector<std::pair<Repair, std::uint64_t>> repairs = {}) const {
    zoo_.push_back(
        {std::move(name), extension_, std::move(bytes), Fate::read, faces, std::move(repairs)});
  }
  void refused(std::string name, std::string bytes) const {
    zoo_.push_back({std::move(name), extension_, std::move(bytes)});
  }

 private:
  std::vector<Specimen>& zoo_;
  std::string extension_;
};

/// Generates broken and unusual files of every format: truncated, with wrong counts, not finite,
/// not manifold, far too large, and with every pattern that has broken parsers of this kind. About
/// 60 MB.
std::vector<Specimen> zoo();

// The specimens of one format.
void add_obj_text(std::vector<Specimen>& zoo);
void add_obj_shapes(std::vector<Specimen>& zoo);
void add_ply(std::vector<Specimen>& zoo);
void add_stl_and_off(std::vector<Specimen>& zoo);
void add_gltf(std::vector<Specimen>& zoo);

/// One small valid file of each format and encoding, from which tests make truncated and mutated
/// files.
std::vector<Specimen> sound_files();

}  // namespace mesher::test
