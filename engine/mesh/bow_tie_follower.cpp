#include "engine/mesh/bow_tie_follower.h"

namespace mesher {

BowTieFollower::BowTieFollower(const Mesh& mesh) {
  for (const BowTieCopy& copy : mesh.bow_tie_copies()) {
    by_vertex_[copy.v] = followed_.size();
    followed_.push_back({copy, mesh.position(copy.v), copy.v});
  }
}

void BowTieFollower::stop_following(std::unordered_map<Vertex, std::size_t>::iterator entry) {
  followed_[entry->second].now = Vertex{};
  by_vertex_.erase(entry);
}

void BowTieFollower::merge(Vertex removed, Vertex kept, const glm::vec3& p) {
  const auto stays = [&](auto entry) { return followed_[entry->second].position == p; };
  const auto at_kept = by_vertex_.find(kept);
  const bool is_taken = at_kept != by_vertex_.end() && stays(at_kept);
  if (at_kept != by_vertex_.end() && !is_taken) stop_following(at_kept);
  const auto at_removed = by_vertex_.find(removed);
  if (at_removed == by_vertex_.end()) return;
  const std::size_t index = at_removed->second;
  if (is_taken || !stays(at_removed)) return stop_following(at_removed);
  by_vertex_.erase(at_removed);
  by_vertex_[kept] = index;
  followed_[index].now = kept;
}

Array<BowTieCopy> BowTieFollower::before() const {
  Array<BowTieCopy> copies;
  for (const Followed& f : followed_) {
    if (f.now.is_valid()) copies.push_back(f.copy);
  }
  normalize(copies);
  return copies;
}

Array<BowTieCopy> BowTieFollower::after() const {
  Array<BowTieCopy> copies;
  for (const Followed& f : followed_) {
    if (f.now.is_valid()) copies.push_back({f.now, f.copy.first});
  }
  normalize(copies);
  return copies;
}

}  // namespace mesher
