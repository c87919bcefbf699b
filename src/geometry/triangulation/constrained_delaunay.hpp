// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0005 says why faces with holes are not cut into ears.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/triangulation/triangulation_mesh.hpp"

namespace strake::geometry::triangulation {

/// A constrained Delaunay triangulation of the convex hull of points: chosen segments are edges.
class ConstrainedDelaunay {
 public:
  /// Triangulates points, which must be distinct and ascending; no triangles when all are
  /// collinear.
  explicit ConstrainedDelaunay(std::vector<Point2> points);

  /// Makes the segment between two points an edge; false when it crosses an earlier one.
  [[nodiscard]] bool insert_constraint(std::uint32_t a, std::uint32_t b);
  /// Restores the Delaunay property between the segments.
  void restore_delaunay();
  /// Returns, for each triangle, whether an odd number of closed loops of segments surround it.
  [[nodiscard]] std::vector<bool> inside() const;

  [[nodiscard]] const std::vector<TriangulationFace>& cells() const { return cells_.all(); }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  /// An edge of a cavity, counter-clockwise, and what lies beyond.
  struct CavityEdge {
    std::uint32_t from = kNone, to = kNone, neighbour = kNone;
    bool constrained = false, odd = false;
  };
  /// The triangles that a segment runs through, and the vertices on either side of it, along it.
  struct Cavity {
    std::vector<std::uint32_t> cells, left, right;
    std::vector<CavityEdge> rim;
    std::uint32_t end = kNone;

    void add(std::uint32_t number, const TriangulationFace& cell, std::uint32_t entered,
             std::uint32_t left_through);
  };

  [[nodiscard]] FaceCorner find_edge(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool collect(std::uint32_t a, std::uint32_t b, FaceCorner start,
                             Cavity& cavity) const;
  void fill(std::uint32_t p, std::uint32_t q, std::span<const std::uint32_t> chain,
            std::vector<std::array<std::uint32_t, 3>>& triangles) const;
  void replace(Cavity& cavity, std::span<const std::array<std::uint32_t, 3>> triangles);
  [[nodiscard]] bool open_way(std::uint32_t a, Cavity& cavity);
  void mark_constrained(std::uint32_t a, std::uint32_t b);

  TriangulationMesh cells_;
};

}  // namespace strake::geometry::triangulation
