#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "engine/io/obj_chunk.h"
#include "engine/mesh/corner_attributes.h"

namespace mesher::io {

/// Returns whether a smoothing group (`s` of OBJ) joins nothing.
bool is_smoothing_off(std::string_view smoothing);

/// Collects the statements of an OBJ that hold for all faces after them: `o`, `g`, `s`, `usemtl`,
/// and the files of `mtllib`. The names are views of the file's text.
class ObjGroups {
 public:
  /// Takes in a statement that comes before face `face` of the file. The statements come in order.
  void add(const ObjName& statement, std::uint32_t face);
  /// Sets the groups of `faces` faces, numbered by their first face. A single group that says
  /// nothing is left out. A material is an index of materials().
  void finish(std::size_t faces, CornerAttributes& attributes) const;

  /// The names of `usemtl` and the texts of `mtllib`, each once, in the order of the file.
  const std::vector<std::string_view>& materials() const { return materials_; }
  const std::vector<std::string_view>& libraries() const { return libraries_; }

 private:
  using Key = std::tuple<std::string_view, std::string_view, std::string_view, std::uint32_t>;
  struct Change {
    std::uint32_t face;
    std::uint32_t state;  ///< index of states_
  };

  std::uint32_t state_of(const Key& key);
  std::uint32_t material(std::string_view name);

  std::string_view object_, name_, smoothing_;
  std::uint32_t material_ = kNone;
  std::map<Key, std::uint32_t> state_ids_;
  std::vector<Key> states_;
  std::vector<Change> changes_;
  std::unordered_map<std::string_view, std::uint32_t> material_ids_;
  std::vector<std::string_view> materials_, libraries_;
  std::unordered_set<std::string_view> seen_libraries_;
};

}  // namespace mesher::io
