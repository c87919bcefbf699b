// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "geometry/axis_rays.hpp"
#include "geometry/box.hpp"
#include "geometry/corner_index.hpp"
#include "geometry/dual_walk.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/plane_sides.hpp"
#include "geometry/sectors.hpp"
#include "geometry/sheet_curve.hpp"
#include "geometry/shell_set.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/triangle_contact.hpp"

// How the meeting is decided. Write int, ext for the open inside and outside of a body, bd for its
// boundary. If int A meets int B then bd A has a point in int B, or bd B one in int A, or the
// bodies share a component and so two coplanar triangles with equal normals overlap. A piece of
// bd A between contacts with bd B lies in int B or in ext B as a whole. Either its rim holds a
// segment of contact, and then the half-planes round that segment show on which side it lies
// (Sectors); or it is a whole shell, connected through edges, and one probe off bd B tells.
// Contacts in single points need nothing else. `a leaves b` is the same question with the inside
// and outside of b exchanged, so one walk over the contacts answers all three. A crossing answers
// all at once.

namespace strake::geometry {
namespace {

/// Planes of triangles in contact, and of triangles apart, that are tried for separating the parts.
constexpr int kSeparationTries = 4;
constexpr int kPartingTries = 16;
/// Corners tried on a shell that already has contact along a segment: only meshes that overlap
/// themselves can still surprise there.
constexpr int kExtraProbes = 3;

std::uint32_t shell_of(const Part& part, std::uint32_t triangle) {
  return part.shells.empty() ? 0 : part.shells[triangle];
}

class Meeter {
 public:
  Meeter(const TreedPart& a, const TreedPart& b, PairWork& work)
      : treed_a_(a),
        treed_b_(b),
        a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        work_(work) {}

  MeetingResult run();

 private:
  enum class State : std::uint8_t { go_on, decided };

  /// The triangles of a leaf of a, prepared as they are needed; kept until another leaf is loaded.
  struct LoadedLeaf {
    const PartTree::Node* node = nullptr;
    std::array<Box3l, PartTree::kLeafSize> box;
    std::array<std::optional<ExactTriangle>, PartTree::kLeafSize> triangle;
  };

  State walk();
  State leaves(const PartTree::Node& na, const PartTree::Node& nb);
  State found(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a, const ExactTriangle& b,
              const TriangleContact& c);
  bool separated(const ExactTriangle& a, const ExactTriangle& b);
  bool parted(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c);
  void load(const PartTree::Node& leaf);
  void judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb);
  void edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge);
  void edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b);

  void probe_shells(bool of_b);
  bool probe(bool of_b, const Vec3l& numerator, std::int64_t denominator);
  bool probe_triangle(bool of_b, std::uint32_t triangle, bool thorough);
  [[nodiscard]] Meeting meeting() const;

  TreedPart treed_a_, treed_b_;
  PartView a_, b_;
  PairWork& work_;
  Overlap overlap_;
  MeetingResult result_;
  LoadedLeaf leaf_;
  int separation_tries_ = 0, parting_tries_ = 0;
  bool flush_ = false;            ///< some triangles lie on each other
  bool separated_ = false;        ///< a plane decided: neither part has a point inside the other
  ShellSet linear_a_, linear_b_;  ///< shells with contact along a segment or an area
  Sectors sectors_;
};

/// A box within reach of the other tree's box, in the pair's coordinates.
bool boxes_meet(const PartView& a, const Box3i& box_a, const PartView& b, const Box3i& box_b) {
  return a.box(box_a).meets(b.box(box_b));
}

Meeter::State Meeter::walk() {
  const bool to_the_end = walk_both(
      a_.tree(), b_.tree(),
      [&](const PartTree::Node& na, const PartTree::Node& nb) {
        ++work_.node_pairs;
        return boxes_meet(a_, na.box, b_, nb.box);
      },
      [&](const PartTree::Node& na, const PartTree::Node& nb) {
        return leaves(na, nb) == State::go_on;
      });
  return to_the_end ? State::go_on : State::decided;
}

void Meeter::load(const PartTree::Node& leaf) {
  if (leaf_.node == &leaf) return;
  leaf_.node = &leaf;
  for (std::uint32_t i = 0; i < leaf.count; ++i) {
    leaf_.box[i] = box_of(a_.corners(a_.tree().order()[leaf.first + i]));
    leaf_.triangle[i].reset();
  }
}

Meeter::State Meeter::leaves(const PartTree::Node& na, const PartTree::Node& nb) {
  const Box3l box_a = a_.box(na.box);
  for (std::uint32_t j = 0; j < nb.count; ++j) {
    const std::uint32_t tb = b_.tree().order()[nb.first + j];
    const std::array<Vec3l, 3> corners = b_.corners(tb);
    const Box3l box_b = box_of(corners);
    if (!box_b.meets(box_a)) continue;
    load(na);
    std::optional<ExactTriangle> b;
    for (std::uint32_t i = 0; i < na.count; ++i) {
      if (!leaf_.box[i].meets(box_b)) continue;
      ++work_.triangle_pairs;
      const std::uint32_t ta = a_.tree().order()[na.first + i];
      if (!leaf_.triangle[i]) leaf_.triangle[i].emplace(a_.corners(ta));
      if (!b) b.emplace(corners);
      const ExactTriangle& a = *leaf_.triangle[i];
      const TriangleContact c = contact(a, *b);
      if (c.touch == Touch::none ? parted(a, *b, c) : found(ta, tb, a, *b, c) == State::decided)
        return State::decided;
    }
  }
  return State::go_on;
}

/// Two triangles apart often lie on a flat side of one part with all of the other beyond it.
bool Meeter::parted(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c) {
  const auto positive = [](const CornerSides& s) { return s[0] > 0 && s[1] > 0 && s[2] > 0; };
  if (result_.boundaries_meet || parting_tries_ >= kPartingTries) return false;
  const bool a_beyond_b = positive(c.side_a), b_beyond_a = positive(c.side_b);
  if (!a_beyond_b && !b_beyond_a) return false;
  ++parting_tries_;
  separated_ = a_beyond_b ? parts_strictly(b, b_, a_) : parts_strictly(a, a_, b_);
  return separated_;
}

Meeter::State Meeter::found(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                            const ExactTriangle& b, const TriangleContact& c) {
  if (!result_.boundaries_meet) {
    result_.boundaries_meet = true;
    result_.triangle_a = ta;
    result_.triangle_b = tb;
    result_.point = common_point(a, b, c);
  }
  if (!overlap_.interiors && separation_tries_ < kSeparationTries && separated(a, b)) {
    separated_ = true;
    return State::decided;
  }
  const bool had_interiors = overlap_.interiors;
  judge(ta, tb, c);
  if (overlap_.interiors && !had_interiors) {
    // The point of a crossing says more than the point of a touch found before it.
    result_.triangle_a = ta;
    result_.triangle_b = tb;
    result_.point = common_point(a, b, c);
  }
  return overlap_.complete() ? State::decided : State::go_on;
}

bool Meeter::separated(const ExactTriangle& a, const ExactTriangle& b) {
  ++separation_tries_;
  // A solid lies below the planes of its own flat sides; a sheet may lie on either.
  if (separates(a, a_, b_) || separates(b, b_, a_)) return true;
  return (!a_.solid() && separates(a, b_, a_)) || (!b_.solid() && separates(b, a_, b_));
}

void Meeter::judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  if (c.touch == Touch::point) return;
  linear_a_.insert(shell_of(a_.part(), ta));
  linear_b_.insert(shell_of(b_.part(), tb));
  if (c.coplanar)
    judge_coplanar(ta, tb, c);
  else
    judge_crossing(ta, tb, c);
}

/// Adds what a triangle's corners off the other's plane say, where the triangles meet along a
/// segment through the other's interior: there the other part is a half-space, or itself.
void judge_corners(const CornerSides& sides, bool crosser_solid, bool face_solid, bool& interiors,
                   bool& crosser_leaves, bool& face_leaves) {
  const bool below = sides[0] < 0 || sides[1] < 0 || sides[2] < 0;
  const bool above = sides[0] > 0 || sides[1] > 0 || sides[2] > 0;
  if (face_solid) {
    interiors |= below;
    crosser_leaves |= above;
    face_leaves |= below && crosser_solid;
  } else {
    // A sheet: the crossing triangle leaves it on either side.
    crosser_leaves = true;
  }
}

void Meeter::judge_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  if (c.edge_b < 0)
    judge_corners(c.side_a, a_.solid(), b_.solid(), overlap_.interiors, overlap_.a_leaves_b,
                  overlap_.b_leaves_a);
  if (c.edge_a < 0)
    judge_corners(c.side_b, b_.solid(), a_.solid(), overlap_.interiors, overlap_.b_leaves_a,
                  overlap_.a_leaves_b);
  if (c.edge_a < 0 && c.edge_b < 0) {
    overlap_.interiors = true;
  } else if (c.edge_b < 0) {
    edge_in_face_of_b(ta, c.edge_a, tb);
  } else if (c.edge_a < 0) {
    edge_in_face_of_a(ta, tb, c.edge_b);
  } else {
    edge_on_edge(ta, c.edge_a, tb, c.edge_b);
  }
}

void Meeter::judge_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  flush_ |= c.touch == Touch::area;
  if (c.touch == Touch::area && a_.solid() && b_.solid()) {
    overlap_.interiors |= c.same_normal;
    overlap_.a_leaves_b |= !c.same_normal;
    overlap_.b_leaves_a |= !c.same_normal;
  }
  for (int i = 0; i < 3; ++i) {
    if ((c.edges_of_a_inside_b >> i) & 1U) edge_in_face_of_b(ta, i, tb);
    if ((c.edges_of_b_inside_a >> i) & 1U) edge_in_face_of_a(ta, tb, i);
    for (int j = 0; j < 3; ++j)
      if ((c.shared_edges >> (3 * i + j)) & 1U) edge_on_edge(ta, i, tb, j);
  }
}

void Meeter::edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb) {
  start_axis(sectors_, a_, ta, edge);
  add_star(sectors_, a_, ta, edge, false);
  add_face(sectors_, b_, tb, true);
  sectors_.judge(a_.solid(), b_.solid(), overlap_);
}

void Meeter::edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge) {
  start_axis(sectors_, b_, tb, edge);
  add_face(sectors_, a_, ta, false);
  add_star(sectors_, b_, tb, edge, true);
  sectors_.judge(a_.solid(), b_.solid(), overlap_);
}

void Meeter::edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b) {
  start_axis(sectors_, a_, ta, edge_a);
  add_star(sectors_, a_, ta, edge_a, false);
  add_star(sectors_, b_, tb, edge_b, true);
  sectors_.judge(a_.solid(), b_.solid(), overlap_);
}

/// Probes a rational point of one part's surface against the other part; false when it lies on the
/// other's surface and so says nothing.
bool Meeter::probe(bool of_b, const Vec3l& numerator, std::int64_t denominator) {
  const TreedPart& other = of_b ? treed_a_ : treed_b_;
  const Vec3l shift = of_b ? a_.shift() : b_.shift();
  const PointSide side = side_of(other, numerator - shift * denominator, denominator, work_);
  if (side == PointSide::on_boundary) return false;
  bool& leaves = of_b ? overlap_.b_leaves_a : overlap_.a_leaves_b;
  bool& other_leaves = of_b ? overlap_.a_leaves_b : overlap_.b_leaves_a;
  if (side == PointSide::outside) {
    leaves = true;
    return true;
  }
  if (!overlap_.interiors && !result_.boundaries_meet)
    result_.point = numerator.as<double>() * (1.0 / static_cast<double>(denominator));
  overlap_.interiors = true;
  if ((of_b ? b_ : a_).solid()) other_leaves = true;
  return true;
}

/// Tries points of a triangle until one is off the other surface: corners, then, where asked, the
/// middles of the edges and points of the inside with ever larger denominators.
bool Meeter::probe_triangle(bool of_b, std::uint32_t triangle, bool thorough) {
  const std::array<Vec3l, 3> t = (of_b ? b_ : a_).corners(triangle);
  for (const Vec3l& p : t)
    if (probe(of_b, p, 1)) return true;
  if (!thorough) return false;
  for (int i = 0; i < 3; ++i)
    if (probe(of_b, t[at(i)] + t[at(next_corner(i))], 2)) return true;
  for (const std::int64_t d : {3, 7, 31, 127, 509, 2039})
    for (std::int64_t i = 1; i <= 3 && i + 1 < d; ++i)
      if (probe(of_b, t[0] * i + t[1] + t[2] * (d - i - 1), d)) return true;
  return false;
}

/// Probes every shell without contact along a segment, and for good measure a few corners of the
/// others.
void Meeter::probe_shells(bool of_b) {
  const PartView& view = of_b ? b_ : a_;
  const PartView& other = of_b ? a_ : b_;
  const ShellSet& linear = of_b ? linear_b_ : linear_a_;
  if (!other.solid()) {
    // A surface holds no volume, and no other surface that it meets in single points at most.
    bool& leaves = of_b ? overlap_.b_leaves_a : overlap_.a_leaves_b;
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
    if (overlap_.complete()) return;
  }
}

Meeting Meeter::meeting() const {
  if (!overlap_.interiors) return result_.boundaries_meet ? Meeting::touching : Meeting::apart;
  if (result_.boundaries_meet) return Meeting::crossing;
  if (!overlap_.a_leaves_b) return Meeting::a_inside_b;
  return overlap_.b_leaves_a ? Meeting::crossing : Meeting::b_inside_a;
}

MeetingResult Meeter::run() {
  if (a_.tree().nodes().empty() || b_.tree().nodes().empty()) return result_;
  const bool near =
      boxes_meet(a_, a_.tree().nodes().front().box, b_, b_.tree().nodes().front().box);
  if (!near) return result_;
  if (walk() == State::go_on) {
    // Where they lie on each other, one may go on to the other side elsewhere.
    if (flush_ && !overlap_.interiors && !a_.solid() && !b_.solid())
      overlap_.interiors = !crossing_curve(treed_a_, treed_b_, 1, work_).segments.empty();
    if (!overlap_.complete()) probe_shells(false);
    if (!overlap_.complete()) probe_shells(true);
  }
  result_.meeting = meeting();
  if (separated_ || result_.meeting == Meeting::apart) return result_;
  result_.a_within_b = !overlap_.a_leaves_b;
  result_.b_within_a = !overlap_.b_leaves_a;
  return result_;
}

}  // namespace

MeetingResult meet(const TreedPart& a, const TreedPart& b, PairWork& work) {
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
