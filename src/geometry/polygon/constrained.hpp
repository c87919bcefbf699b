// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace strake::geometry::polygon {

/// A point of the projected face; |coordinate| <= 2^29.
struct Point2 {
  std::int64_t x = 0, y = 0;

  friend bool operator==(const Point2&, const Point2&) = default;
  friend auto operator<=>(const Point2&, const Point2&) = default;
};

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// The side of the line through p and q on which r lies: 1 left, -1 right, 0 on it.
[[nodiscard]] int side_of(const Point2& p, const Point2& q, const Point2& r);

/// Whether d lies within the circle through a, b and c, which are counter-clockwise.
[[nodiscard]] bool inside_circle(const Point2& a, const Point2& b, const Point2& c,
                                 const Point2& d);

/// A triangulation of the convex hull of points in which chosen segments are edges.
///
/// Edge i of a triangle lies opposite its vertex i; all triangles are counter-clockwise and have
/// an area.
class Constrained {
 public:
  struct Cell {
    std::array<std::uint32_t, 3> vertex{};
    std::array<std::uint32_t, 3> neighbour{kNone, kNone, kNone};
    std::array<bool, 3> fixed{};  ///< lies on a segment
    std::array<bool, 3> odd{};    ///< lies on an odd number of segments
  };

  /// The points must be distinct and ascending. No triangles when all are collinear.
  explicit Constrained(std::vector<Point2> points);

  /// Forces the segment between two points; false when it crosses one forced before.
  [[nodiscard]] bool force(std::uint32_t a, std::uint32_t b);
  /// Restores the Delaunay property between the segments.
  void improve();
  /// For each triangle whether an odd number of closed loops of segments surround it.
  [[nodiscard]] std::vector<bool> inside() const;

  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

 private:
  struct Corner {
    std::uint32_t cell = kNone;
    std::uint32_t index = 0;
  };
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  /// An edge of a cavity, counter-clockwise, and what lies beyond.
  struct RimEdge {
    std::uint32_t from = kNone, to = kNone, neighbour = kNone;
    bool fixed = false, odd = false;
  };
  /// The cells that a segment runs through, and the vertices on either side of it, in its sense.
  struct Cavity {
    std::vector<std::uint32_t> cells, left, right;
    std::vector<RimEdge> rim;
    std::uint32_t end = kNone;

    void add(std::uint32_t number, const Cell& cell, std::uint32_t entered,
             std::uint32_t left_through);
  };

  [[nodiscard]] int side(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] bool in_circle(const Cell& cell, std::uint32_t point) const;
  std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void join(std::uint32_t s, std::uint32_t t, std::uint32_t from, std::uint32_t to);
  void set_hull(std::uint32_t cell, std::uint32_t index);
  void sweep();
  std::uint32_t start_fan();
  void insert(std::uint32_t point);
  void attach(std::uint32_t cell, std::uint32_t index, std::uint32_t neighbour, bool fixed,
              bool odd);
  void flip(std::uint32_t cell, std::uint32_t index);
  void legalise();
  [[nodiscard]] std::uint32_t index_of(const Cell& cell, std::uint32_t vertex) const;
  template <class Visit>
  void visit_star(std::uint32_t vertex, Visit&& visit) const;
  [[nodiscard]] Corner find_edge(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool collect(std::uint32_t a, std::uint32_t b, Corner start, Cavity& cavity) const;
  void fill(std::uint32_t p, std::uint32_t q, std::span<const std::uint32_t> chain,
            std::vector<std::array<std::uint32_t, 3>>& triangles) const;
  void replace(Cavity& cavity, std::span<const std::array<std::uint32_t, 3>> triangles);
  [[nodiscard]] bool open_way(std::uint32_t a, Cavity& cavity);
  void fix(std::uint32_t a, std::uint32_t b);

  std::vector<Point2> points_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> cell_of_;  ///< some triangle at each vertex
  std::vector<std::uint32_t> hull_next_, hull_previous_;
  std::vector<std::uint32_t> hull_cell_;  ///< the triangle at the hull edge that starts there
  std::vector<Corner> doubtful_;          ///< edges that may not be Delaunay
};

}  // namespace strake::geometry::polygon
