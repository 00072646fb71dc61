#include "engine/io/obj_groups.h"

#include <algorithm>
#include <string>

#include "engine/io/format.h"

namespace mesher::io {

bool is_smoothing_off(std::string_view smoothing) {
  return smoothing.empty() || smoothing == "off" || smoothing == "0";
}

void ObjGroups::add(const ObjName& statement, std::uint32_t face) {
  if (statement.kind == 'm') {
    const bool is_new = seen_libraries_.insert(statement.name).second;
    if (is_new && !statement.name.empty()) libraries_.push_back(statement.name);
    return;
  }
  const std::string_view name = statement.name.substr(0, kMaxNameBytes);
  switch (statement.kind) {
    case 'o':
      object_ = name;
      break;
    case 'g':
      name_ = name;
      break;
    case 's':
      smoothing_ = name;
      break;
    default:
      material_ = material(name);
      break;
  }
  changes_.push_back({face, state_of({object_, name_, smoothing_, material_})});
}

std::uint32_t ObjGroups::material(std::string_view name) {
  if (name.empty()) return kNone;
  const auto [entry, is_new] =
      material_ids_.try_emplace(name, static_cast<std::uint32_t>(materials_.size()));
  if (is_new) materials_.push_back(name);
  return entry->second;
}

std::uint32_t ObjGroups::state_of(const Key& key) {
  const auto [entry, is_new] =
      state_ids_.try_emplace(key, static_cast<std::uint32_t>(states_.size()));
  if (is_new) states_.push_back(key);
  return entry->second;
}

void ObjGroups::finish(std::size_t faces, CornerAttributes& attributes) const {
  Array<std::uint32_t> group(faces);
  std::vector<std::uint32_t> numbers(states_.size() + 1, kNone);
  std::vector<FaceGroup> groups;
  for (std::size_t i = 0; i <= changes_.size(); ++i) {
    const std::size_t begin = i == 0 ? 0 : changes_[i - 1].face;
    const std::size_t end = i == changes_.size() ? faces : changes_[i].face;
    if (begin == end) continue;
    const std::size_t state = i == 0 ? states_.size() : changes_[i - 1].state;
    std::uint32_t& number = numbers[state];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back();
      if (i > 0) {
        const auto& [object, name, smoothing, material] = states_[state];
        groups.back() = {.object = std::string(object),
                         .name = std::string(name),
                         .smoothing = std::string(smoothing),
                         .material = material};
      }
    }
    std::fill(group.data() + begin, group.data() + end, number);
  }
  if (groups.size() < 2 && (groups.empty() || groups.front() == FaceGroup())) return;
  attributes.group = std::move(group);
  attributes.groups = std::move(groups);
}

}  // namespace mesher::io
