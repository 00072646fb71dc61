#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <queue>
#include <span>
#include <vector>

#include "engine/mesh/ids.h"

namespace mesher {

/// Triangulates one outline by clipping ears, best shape first. Internal to triangulate.cpp.
///
/// Corners form a doubly linked ring, and candidate ears are in a heap by shape. Only reflex
/// corners can block an ear; a grid finds them. A blocked candidate is stored in its blocker's list
/// and retried when the blocker stops blocking. A budget proportional to n limits the point tests,
/// so that a hostile outline also terminates (its triangles may then overlap).
class EarClipper {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  explicit EarClipper(std::span<const glm::vec3> polygon);
  /// Appends n-2 triangles.
  void run(std::vector<Triangle>& triangles);

 private:
  struct Candidate {
    double shape;
    std::uint32_t corner;
    std::uint32_t version;
    // Best shape on top; equal shapes by lowest corner, to make the order total.
    bool operator<(const Candidate& other) const {
      return shape != other.shape ? shape < other.shape : corner > other.corner;
    }
  };

  /// Subtracts `cost` point tests from the budget. If that is too much, returns false and sets the
  /// budget to 0.
  bool spend(std::uint64_t cost);
  struct Blocked {
    std::uint32_t corner;
    std::uint32_t next;  ///< in blocked_, or kNone
  };

  void project();
  void build_grid();
  std::array<std::uint32_t, 2> cell_of(const glm::dvec2& p) const;
  std::size_t cell_index(std::uint32_t i) const;
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  bool is_convex(std::uint32_t i) const { return turn(prev_[i], i, next_[i]) > 0.0; }
  bool blocks(std::uint32_t i, std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  /// Returns a corner that prevents `i` from being an ear, or kNone.
  std::uint32_t find_blocker(std::uint32_t i);
  std::array<std::uint32_t, 2> columns_in_row(const std::array<glm::dvec2, 3>& t,
                                              std::uint32_t row) const;
  double shape(std::uint32_t i) const;
  void push(std::uint32_t i);
  void clip(std::uint32_t i, std::vector<Triangle>& triangles);
  void stop_blocking(std::uint32_t i);
  std::uint32_t best_fallback_corner() const;

  std::span<const glm::vec3> polygon_;
  std::vector<glm::dvec2> point_;
  std::vector<std::uint32_t> prev_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> version_;
  std::vector<bool> is_alive_;
  std::vector<std::uint32_t> first_blocked_;  ///< per corner, a list of the candidates that it
                                              ///< blocks
  std::vector<Blocked> blocked_;
  std::priority_queue<Candidate> candidates_;
  std::uint32_t remaining_;
  std::uint32_t some_corner_ = 0;
  std::uint64_t budget_;

  glm::dvec2 grid_min_{0.0};
  glm::dvec2 cell_size_{1.0};
  std::uint32_t grid_side_ = 1;
  std::vector<std::uint32_t> cell_start_;
  std::vector<std::uint32_t> cell_end_;     ///< corners leave their cell when they stop blocking
  std::vector<std::uint32_t> cell_corner_;  ///< corners by cell
  std::vector<std::uint32_t> slot_;         ///< per corner, its index in cell_corner_, or kNone
  std::size_t blockers_ = 0;                ///< corners in the grid
};

}  // namespace mesher
