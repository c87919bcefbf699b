// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/intersect/boundary_intersection.hpp"
#include "geometry/intersect/intersection_segments.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "strake/geometry/part_pair.hpp"

// How the relation of two parts is decided. Write int, ext for the open interior and exterior of a
// body, bd for its boundary. If int A meets int B then bd A has a point in int B, or bd B one in
// int A, or the bodies share a component and so two coplanar triangles with equal normals overlap.
// A piece of bd A between contacts with bd B lies in int B or in ext B as a whole. Either its
// border holds a segment of contact, and then the half-planes round that segment show on which side
// it lies (RadialSort); or it is a whole shell, connected through edges, and one probe off bd B
// decides. Contacts in single points need nothing else. `a leaves b` is the same question with int
// B and ext B exchanged, so one traversal of the contacts answers all three. A crossing answers all
// at once.

namespace strake::geometry {
namespace {

/// Number of triangles probed on a shell that already has contact along a segment: only meshes that
/// overlap themselves can change the result there.
constexpr int kExtraProbes = 3;

class Meeter {
 public:
  Meeter(const PartWithBvh& a, const PartWithBvh& b, QueryContext& work)
      : treed_a_(a),
        treed_b_(b),
        a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        work_(work) {}

  MeetingResult run();

 private:
  void probe_shells(bool of_b);
  bool probe(bool of_b, const Vec3l& numerator, std::int64_t denominator);
  bool probe_triangle(bool of_b, std::uint32_t triangle, bool thorough);
  [[nodiscard]] Meeting meeting() const;

  PartWithBvh treed_a_, treed_b_;
  PairLocalPart a_, b_;
  QueryContext& work_;
  BoundaryIntersection contacts_;
};

/// Probes a rational point of one part's surface against the other part; false when it lies on the
/// other's surface and so decides nothing.
bool Meeter::probe(bool of_b, const Vec3l& numerator, std::int64_t denominator) {
  const PartWithBvh& other = of_b ? treed_a_ : treed_b_;
  const Vec3l shift = of_b ? a_.shift() : b_.shift();
  const PointSide side = side_of(other, numerator - shift * denominator, denominator, work_);
  if (side == PointSide::on_boundary) return false;
  bool& leaves = of_b ? contacts_.overlap.b_leaves_a : contacts_.overlap.a_leaves_b;
  bool& other_leaves = of_b ? contacts_.overlap.a_leaves_b : contacts_.overlap.b_leaves_a;
  if (side == PointSide::outside) {
    leaves = true;
    return true;
  }
  if (!contacts_.overlap.interiors && !contacts_.boundaries_meet)
    contacts_.point = numerator.as<double>() * (1.0 / static_cast<double>(denominator));
  contacts_.overlap.interiors = true;
  if ((of_b ? b_ : a_).solid()) other_leaves = true;
  return true;
}

/// Tries points of a triangle until one is off the other surface: vertices and the centroid, then,
/// if thorough, the edge midpoints and interior points with ever larger denominators.
bool Meeter::probe_triangle(bool of_b, std::uint32_t triangle, bool thorough) {
  const std::array<Vec3l, 3> t = (of_b ? b_ : a_).corners(triangle);
  for (const Vec3l& p : t)
    if (probe(of_b, p, 1)) return true;
  if (probe(of_b, t[0] + t[1] + t[2], 3)) return true;
  if (!thorough) return false;
  for (int i = 0; i < 3; ++i)
    if (probe(of_b, t[at(i)] + t[at(next_corner(i))], 2)) return true;
  for (const std::int64_t d : {7, 31, 127, 509, 2039})
    for (std::int64_t i = 1; i <= 3 && i + 1 < d; ++i)
      if (probe(of_b, t[0] * i + t[1] + t[2] * (d - i - 1), d)) return true;
  return false;
}

/// Probes every shell without contact along a segment, and a few triangles of the others.
void Meeter::probe_shells(bool of_b) {
  const PairLocalPart& view = of_b ? b_ : a_;
  const PairLocalPart& other = of_b ? a_ : b_;
  const ShellSet& linear = of_b ? contacts_.linear_b : contacts_.linear_a;
  if (!other.solid()) {
    // A surface holds no volume, and no other surface that it meets in single points at most.
    bool& leaves = of_b ? contacts_.overlap.b_leaves_a : contacts_.overlap.a_leaves_b;
    for (std::uint32_t s = 0; s < std::max(view.part().shell_count, 1U); ++s)
      leaves |= view.solid() || !linear.contains(s);
    return;
  }
  const Part& part = view.part();
  std::uint32_t left = std::max(part.shell_count, 1U);
  ShellSet done;
  int extra = kExtraProbes;
  for (std::uint32_t i = 0; i < part.triangles.size() && left > 0; ++i) {
    const std::uint32_t shell = shell_of(part, i);
    if (done.contains(shell)) continue;
    const bool must = !linear.contains(shell);
    if (must ? probe_triangle(of_b, i, true) : (extra > 0 && probe_triangle(of_b, i, false))) {
      done.insert(shell);
      --left;
    } else if (!must && --extra <= 0) {
      done.insert(shell);
      --left;
      extra = kExtraProbes;
    }
    if (contacts_.overlap.complete()) return;
  }
}

Meeting Meeter::meeting() const {
  if (!contacts_.overlap.interiors)
    return contacts_.boundaries_meet ? Meeting::touching : Meeting::apart;
  if (contacts_.boundaries_meet) return Meeting::crossing;
  if (!contacts_.overlap.a_leaves_b) return Meeting::a_inside_b;
  return contacts_.overlap.b_leaves_a ? Meeting::crossing : Meeting::b_inside_a;
}

MeetingResult Meeter::run() {
  if (a_.tree().nodes().empty() || b_.tree().nodes().empty()) return {};
  const bool near =
      boxes_meet(a_, a_.tree().nodes().front().box, b_, b_.tree().nodes().front().box);
  if (!near) return {};
  contacts_ = intersect_boundaries(a_, b_, work_);
  Overlap& overlap = contacts_.overlap;
  if (!contacts_.decided()) {
    // Where they overlap in a common area, one may continue to the other side elsewhere.
    if (contacts_.flush && !overlap.interiors && !a_.solid() && !b_.solid())
      overlap.interiors = !find_intersection_segments(treed_a_, treed_b_, 1, work_).all.empty();
    if (!overlap.complete()) probe_shells(false);
    if (!overlap.complete()) probe_shells(true);
  }
  MeetingResult result;
  result.meeting = meeting();
  result.boundaries_meet = contacts_.boundaries_meet;
  result.point = contacts_.point;
  result.triangle_a = contacts_.triangle_a;
  result.triangle_b = contacts_.triangle_b;
  if (contacts_.separated || result.meeting == Meeting::apart) return result;
  result.a_within_b = !overlap.a_leaves_b;
  result.b_within_a = !overlap.b_leaves_a;
  return result;
}

}  // namespace

MeetingResult meet(const PartWithBvh& a, const PartWithBvh& b, QueryContext& work) {
  return Meeter(a, b, work).run();
}

bool fits_pair(const PlacedPart& a, const PlacedPart& b) {
  constexpr std::int64_t kLargest = std::int64_t{1} << 31;
  for (int k = 0; k < 3; ++k) {
    // Differences first: origins may lie 2^50 units out.
    const std::int64_t shift = b.origin[k] - a.origin[k];
    const std::int64_t low = std::min<std::int64_t>(a.part->box.lo[k], b.part->box.lo[k] + shift);
    const std::int64_t high = std::max<std::int64_t>(a.part->box.hi[k], b.part->box.hi[k] + shift);
    if (high - low > kLargest) return false;
  }
  return true;
}

}  // namespace strake::geometry
