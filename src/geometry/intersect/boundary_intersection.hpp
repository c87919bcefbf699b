// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/intersect/coplanar_faces.hpp"
#include "geometry/intersect/radial_sort.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/triangle_contact.hpp"

// The intersection of two boundaries, and the classification of pairs of triangles.

namespace strake::geometry {

/// A set of shell numbers, fast below 64: parts with more shells are rare.
class ShellSet {
 public:
  void insert(std::uint32_t shell) {
    if (shell < 64) {
      low_ |= std::uint64_t{1} << shell;
      return;
    }
    if (high_.size() <= shell - 64) high_.resize(shell - 63, false);
    high_[shell - 64] = true;
  }
  void insert(const ShellSet& other) {
    low_ |= other.low_;
    high_.resize(std::max(high_.size(), other.high_.size()), false);
    for (std::size_t i = 0; i < other.high_.size(); ++i)
      if (other.high_[i]) high_[i] = true;
  }
  [[nodiscard]] bool contains(std::uint32_t shell) const {
    if (shell < 64) return ((low_ >> shell) & 1) != 0;
    return shell - 64 < high_.size() && high_[shell - 64];
  }

 private:
  std::uint64_t low_ = 0;
  std::vector<bool> high_;
};

[[nodiscard]] inline std::uint32_t shell_of(const Part& part, std::uint32_t triangle) {
  return part.shells.empty() ? 0 : part.shells[triangle];
}

/// The intersection of two parts' boundaries, and what follows from it for the parts.
struct BoundaryIntersection {
  Overlap overlap;
  bool boundaries_meet = false;
  std::uint32_t triangle_a = kNoIndex, triangle_b = kNoIndex;  ///< where they meet, if they do
  Vec3d point;
  bool flush = false;      ///< some triangles are coplanar and overlap
  bool separated = false;  ///< a plane separates the parts: neither has a point inside the other
  ShellSet linear_a, linear_b;  ///< shells that meet the other part along a segment or an area

  /// Whether no further contact can change the result.
  [[nodiscard]] bool decided() const { return separated || overlap.complete(); }
};

/// Whether the boxes of two nodes or parts have a point in common, in the pair's coordinates.
[[nodiscard]] inline bool boxes_meet(const PairLocalPart& a, const Box3i& box_a,
                                     const PairLocalPart& b, const Box3i& box_b) {
  return a.box(box_a).meets(b.box(box_b));
}

/// Visits the contacts of two parts with BVHs until they decide the result or there are no more.
/// The team of `work` shares a heavy traversal.
[[nodiscard]] BoundaryIntersection intersect_boundaries(const PairLocalPart& a,
                                                        const PairLocalPart& b, QueryContext& work);

/// Classifies pairs of triangles of two parts, one after the other: what each contact adds to the
/// result for the parts, and whether a plane separates the parts.
class ContactClassifier {
 public:
  /// `whole`: the views show all of both parts, so that separating planes are tried.
  ContactClassifier(const PairLocalPart& a, const PairLocalPart& b, bool whole)
      : a_(a), b_(b), whole_(whole) {}

  [[nodiscard]] const BoundaryIntersection& found() const { return found_; }
  /// Returns how many of the pairs of triangles had a point in common.
  [[nodiscard]] std::uint64_t touches() const { return touches_; }

  /// Classifies a triangle of each part, prepared or not. Returns whether to go on: the result is
  /// still undecided.
  bool classify_pair(std::uint32_t ta, std::uint32_t tb);
  bool classify_pair(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                     const ExactTriangle& b);

  /// Adds a boundary edge of a's faces in a coordinate plane, or of b's, that runs inside a
  /// coplanar face of the other part, of which a triangle is given. `point`: some point of the
  /// edge.
  void add_boundary_edge_in_face_of_b(const TriangleEdge& side, std::uint32_t tb,
                                      const Vec3d& point);
  void add_boundary_edge_in_face_of_a(const TriangleEdge& side, std::uint32_t ta,
                                      const Vec3d& point);

  /// Adds the result of other pairs of triangles of the same parts.
  void take(const BoundaryIntersection& more);

 private:
  bool touching(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a, const ExactTriangle& b,
                const TriangleContact& c);
  void record_contact_at(std::uint32_t ta, std::uint32_t tb, const Vec3d& point);
  void insert_linear(std::uint32_t ta, std::uint32_t tb);

  bool separated(const ExactTriangle& a, const ExactTriangle& b);
  bool parted(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c);
  void classify(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void classify_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void classify_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb);
  void edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge);
  void edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b);
  template <class AddRays>
  void classify_boundary_edge(std::uint32_t ta, std::uint32_t tb, const Vec3d& point,
                              const AddRays& add_rays);

  PairLocalPart a_, b_;
  bool whole_;
  BoundaryIntersection found_;
  std::uint64_t touches_ = 0;
  int separation_tries_ = 0, parting_tries_ = 0;
  RadialSort sectors_;
};

}  // namespace strake::geometry
