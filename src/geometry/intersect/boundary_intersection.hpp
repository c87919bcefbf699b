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

namespace strake::geometry {

/// A set of shell numbers; parts with more than 64 shells are rare.
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

/// What the contacts of two surfaces say of how the parts meet.
struct BoundaryIntersection {
  Overlap overlap;
  bool boundaries_meet = false;
  std::uint32_t triangle_a = kNoIndex, triangle_b = kNoIndex;  ///< where, and at which point
  Vec3d point;
  bool flush = false;           ///< some triangles lie on each other
  bool separated = false;       ///< a plane decided: neither part has a point inside the other
  ShellSet linear_a, linear_b;  ///< shells with contact along a segment or an area

  /// Nothing that is still to come can change the answer.
  [[nodiscard]] bool decided() const { return separated || overlap.complete(); }
};

/// Boxes of two nodes or parts that have a point in common, in the pair's coordinates.
[[nodiscard]] inline bool boxes_meet(const PairLocalPart& a, const Box3i& box_a,
                                     const PairLocalPart& b, const Box3i& box_b) {
  return a.box(box_a).meets(b.box(box_b));
}

/// Walks over the contacts of two planted parts until they have decided or there are no more. What
/// is heavy is shared with the team of `work`.
[[nodiscard]] BoundaryIntersection intersect_boundaries(const PairLocalPart& a,
                                                        const PairLocalPart& b, QueryContext& work);

/// Says of pairs of triangles of two parts, one after the other, what their contacts mean for the
/// parts: what each touch adds, and whether a plane parts them all.
class ContactClassifier {
 public:
  /// `whole`: to try whether a plane parts all of a from all of b, of which there is nothing but
  /// what the views show.
  ContactClassifier(const PairLocalPart& a, const PairLocalPart& b, bool whole)
      : a_(a), b_(b), whole_(whole) {}

  [[nodiscard]] const BoundaryIntersection& found() const { return found_; }
  /// How many of the pairs of triangles had a point in common.
  [[nodiscard]] std::uint64_t touches() const { return touches_; }

  /// A triangle of each part, ready or not. Tells whether to go on: nothing has decided so far.
  bool classify_pair(std::uint32_t ta, std::uint32_t tb);
  bool classify_pair(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                     const ExactTriangle& b);

  /// A side at the rim of a's faces in a coordinate plane, or of b's, that runs inside a face of
  /// the other part in that plane, of which a triangle is given. `point`: some point of the side.
  void rim_in_face_of_b(const TriangleEdge& side, std::uint32_t tb, const Vec3d& point);
  void rim_in_face_of_a(const TriangleEdge& side, std::uint32_t ta, const Vec3d& point);

  /// Adds what other pairs of triangles of the same parts have said.
  void take(const BoundaryIntersection& more);

 private:
  bool touching(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a, const ExactTriangle& b,
                const TriangleContact& c);
  void stand_at(std::uint32_t ta, std::uint32_t tb, const Vec3d& point);
  void insert_linear(std::uint32_t ta, std::uint32_t tb);

  bool separated(const ExactTriangle& a, const ExactTriangle& b);
  bool parted(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c);
  void judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb);
  void edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge);
  void edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b);
  template <class AddRays>
  void judge_rim(std::uint32_t ta, std::uint32_t tb, const Vec3d& point, const AddRays& add_rays);

  PairLocalPart a_, b_;
  bool whole_;
  BoundaryIntersection found_;
  std::uint64_t touches_ = 0;
  int separation_tries_ = 0, parting_tries_ = 0;
  RadialSort sectors_;
};

}  // namespace strake::geometry
