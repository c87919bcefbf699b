// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/vec.hpp"

// Half-planes sorted round an edge, and what their order shows of two parts.

namespace strake::geometry {

/// A half-plane bounded by the axis, given by a point off the axis. Going counter-clockwise round
/// the axis (seen against its direction), the winding number of the part changes by `step`.
struct HalfPlane {
  Vec3l point;
  int step = 0;
  bool of_b = false;
  std::uint32_t triangle = 0;  ///< whose half-plane it is
};

/// Two triangles of two sheets whose half-planes beside the axis coincide.
struct CoincidentTriangles {
  std::uint32_t a = 0, b = 0;
  int direction = 0;  ///< number of the direction that they share
  int step = 0;       ///< that of b's half-plane
  /// The sheets separate at the axis, and a continues on the outer side of b's triangle, or on the
  /// inner one.
  bool outer = false, inner = false;
};

/// How two parts' point sets overlap, gathered where their surfaces meet. For a sheet the
/// "interior" is the sheet itself.
struct Overlap {
  bool interiors = false;   ///< int a meets int b (sheets: crosses it properly)
  bool a_leaves_b = false;  ///< a has a point outside b
  bool b_leaves_a = false;

  [[nodiscard]] constexpr bool complete() const { return interiors && a_leaves_b && b_leaves_a; }
};

/// Sorts the half-planes of two parts round a common line, and derives how the sets overlap near
/// it.
class RadialSort {
 public:
  void start(const Vec3l& axis_from, const Vec3l& axis_to) {
    from_ = axis_from;
    to_ = axis_to;
    half_planes_.clear();
  }
  [[nodiscard]] const Vec3l& from() const { return from_; }
  [[nodiscard]] const Vec3l& to() const { return to_; }
  void add(const HalfPlane& ray) { half_planes_.push_back(ray); }

  /// Adds to `overlap` what holds in the open angles between the half-planes. Exact: half-planes
  /// are compared by orientation signs only.
  void classify(bool a_solid, bool b_solid, Overlap& overlap);

  /// After classify() of two sheets, fills `flush` with the triangles whose half-planes coincide,
  /// by direction. Returns the number of such directions.
  int find_coincident(std::vector<CoincidentTriangles>& flush) const;

 private:
  struct Sorted {
    HalfPlane ray;
    int half =
        0;  ///< 0 first half-plane's direction, 1 less than half a turn on, 2 opposite, 3 beyond
    bool opens = false;  ///< it is the first of its direction
  };
  struct Direction {
    bool has_a = false, has_b = false;
    int after_a = 0, after_b = 0;    ///< winding numbers just past it
    std::size_t first = 0, end = 0;  ///< of sorted_
  };

  void sort();
  void gather();
  void classify_sheets(Overlap& overlap) const;
  [[nodiscard]] int other_leaves(std::size_t from, std::size_t step, bool b_leaves) const;

  Vec3l from_, to_;
  std::vector<HalfPlane> half_planes_;
  std::vector<Sorted> sorted_;
  std::vector<Direction> directions_;
};

/// Returns the triangles that share an edge (0..2) of a triangle, ascending.
[[nodiscard]] std::span<const std::uint32_t> edge_star(const Part& part, std::uint32_t triangle,
                                                       int edge);

/// Makes an edge of a triangle the axis.
void set_axis(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle, int edge);

/// Adds the half-planes of the triangles at an edge that lies on the axis.
void add_edge_star(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle, int edge,
                   bool of_b);

/// Adds the two half-planes of a triangle through whose interior the axis runs.
void add_face(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle, bool of_b);

/// Adds the two half-planes of a face in a coordinate plane, through whose interior the axis runs;
/// one of its triangles is given.
void add_coordinate_face(RadialSort& sectors, const PairLocalPart& view, std::uint32_t triangle,
                         bool of_b);

}  // namespace strake::geometry
