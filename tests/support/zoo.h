#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/report.h"

namespace mesher::test {

/// What reading a specimen must lead to. Whatever it is: a mesh whose invariants hold, or an
/// InputError of one line that names the file; never anything else.
enum class Fate { read, refused };

/// A file as strangers send them.
struct Specimen {
  std::string name;
  std::string extension;  ///< with the dot
  std::string bytes;
  Fate fate = Fate::refused;
  std::optional<std::uint32_t> faces = std::nullopt;  ///< of the mesh, where it is read and known
  /// Repairs that must have been counted, and how often.
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

/// Broken and odd files of every format, made here: truncated, miscounted, not finite, not
/// manifold, far too large, and every pattern that parsers of this kind have stumbled over. About
/// 60 MB.
std::vector<Specimen> zoo();

// Parts of it, by format.
void add_obj_text(std::vector<Specimen>& zoo);
void add_obj_shapes(std::vector<Specimen>& zoo);
void add_ply(std::vector<Specimen>& zoo);
void add_stl_and_off(std::vector<Specimen>& zoo);
void add_gltf(std::vector<Specimen>& zoo);

/// One small sound file of each format and encoding: what truncations and mutations start from.
std::vector<Specimen> sound_files();

}  // namespace mesher::test
