// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_judge.hpp"

#include "geometry/axis_rays.hpp"
#include "geometry/plane_sides.hpp"

namespace strake::geometry {
namespace {

/// Planes of triangles in contact, and of triangles apart, that are tried for separating the parts.
constexpr int kSeparationTries = 4;
constexpr int kPartingTries = 16;

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

}  // namespace

bool ContactJudge::judge_pair(std::uint32_t ta, std::uint32_t tb) {
  return judge_pair(ta, tb, a_.triangle(ta), b_.triangle(tb));
}

bool ContactJudge::judge_pair(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                              const ExactTriangle& b) {
  const TriangleContact c = contact(a, b);
  return c.touch == Touch::none ? !parted(a, b, c) : touching(ta, tb, a, b, c);
}

/// Two triangles apart often lie on a flat side of one part with all of the other beyond it.
bool ContactJudge::parted(const ExactTriangle& a, const ExactTriangle& b,
                          const TriangleContact& c) {
  const auto positive = [](const CornerSides& s) { return s[0] > 0 && s[1] > 0 && s[2] > 0; };
  if (!whole_ || found_.boundaries_meet || parting_tries_ >= kPartingTries) return false;
  const bool a_beyond_b = positive(c.side_a), b_beyond_a = positive(c.side_b);
  if (!a_beyond_b && !b_beyond_a) return false;
  ++parting_tries_;
  found_.separated = a_beyond_b ? parts_strictly(b, b_, a_) : parts_strictly(a, a_, b_);
  return found_.separated;
}

bool ContactJudge::touching(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                            const ExactTriangle& b, const TriangleContact& c) {
  ++touches_;
  if (!found_.boundaries_meet) stand_at(ta, tb, common_point(a, b, c));
  if (whole_ && !found_.overlap.interiors && separation_tries_ < kSeparationTries &&
      separated(a, b)) {
    found_.separated = true;
    return false;
  }
  const bool had_interiors = found_.overlap.interiors;
  judge(ta, tb, c);
  // The point of a crossing says more than the point of a touch found before it.
  if (found_.overlap.interiors && !had_interiors) stand_at(ta, tb, common_point(a, b, c));
  return !found_.overlap.complete();
}

void ContactJudge::stand_at(std::uint32_t ta, std::uint32_t tb, const Vec3d& point) {
  found_.boundaries_meet = true;
  found_.triangle_a = ta;
  found_.triangle_b = tb;
  found_.point = point;
}

void ContactJudge::insert_linear(std::uint32_t ta, std::uint32_t tb) {
  found_.linear_a.insert(shell_of(a_.part(), ta));
  found_.linear_b.insert(shell_of(b_.part(), tb));
}

bool ContactJudge::separated(const ExactTriangle& a, const ExactTriangle& b) {
  ++separation_tries_;
  // A solid lies below the planes of its own flat sides; a sheet may lie on either.
  if (separates(a, a_, b_) || separates(b, b_, a_)) return true;
  return (!a_.solid() && separates(a, b_, a_)) || (!b_.solid() && separates(b, a_, b_));
}

void ContactJudge::judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  if (c.touch == Touch::point) return;
  insert_linear(ta, tb);
  if (c.coplanar)
    judge_coplanar(ta, tb, c);
  else
    judge_crossing(ta, tb, c);
}

void ContactJudge::judge_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  if (c.edge_b < 0)
    judge_corners(c.side_a, a_.solid(), b_.solid(), found_.overlap.interiors,
                  found_.overlap.a_leaves_b, found_.overlap.b_leaves_a);
  if (c.edge_a < 0)
    judge_corners(c.side_b, b_.solid(), a_.solid(), found_.overlap.interiors,
                  found_.overlap.b_leaves_a, found_.overlap.a_leaves_b);
  if (c.edge_a < 0 && c.edge_b < 0) {
    found_.overlap.interiors = true;
  } else if (c.edge_b < 0) {
    edge_in_face_of_b(ta, c.edge_a, tb);
  } else if (c.edge_a < 0) {
    edge_in_face_of_a(ta, tb, c.edge_b);
  } else {
    edge_on_edge(ta, c.edge_a, tb, c.edge_b);
  }
}

void ContactJudge::judge_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  found_.flush |= c.touch == Touch::area;
  if (c.touch == Touch::area && a_.solid() && b_.solid()) {
    found_.overlap.interiors |= c.same_normal;
    found_.overlap.a_leaves_b |= !c.same_normal;
    found_.overlap.b_leaves_a |= !c.same_normal;
  }
  for (int i = 0; i < 3; ++i) {
    if ((c.edges_of_a_inside_b >> i) & 1U) edge_in_face_of_b(ta, i, tb);
    if ((c.edges_of_b_inside_a >> i) & 1U) edge_in_face_of_a(ta, tb, i);
    for (int j = 0; j < 3; ++j)
      if ((c.shared_edges >> (3 * i + j)) & 1U) edge_on_edge(ta, i, tb, j);
  }
}

void ContactJudge::edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb) {
  start_axis(sectors_, a_, ta, edge);
  add_star(sectors_, a_, ta, edge, false);
  add_face(sectors_, b_, tb, true);
  sectors_.judge(a_.solid(), b_.solid(), found_.overlap);
}

void ContactJudge::edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge) {
  start_axis(sectors_, b_, tb, edge);
  add_face(sectors_, a_, ta, false);
  add_star(sectors_, b_, tb, edge, true);
  sectors_.judge(a_.solid(), b_.solid(), found_.overlap);
}

void ContactJudge::edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b) {
  start_axis(sectors_, a_, ta, edge_a);
  add_star(sectors_, a_, ta, edge_a, false);
  add_star(sectors_, b_, tb, edge_b, true);
  sectors_.judge(a_.solid(), b_.solid(), found_.overlap);
}

/// A side whose neighbourhood in either part is given by half-planes round it.
template <class AddRays>
void ContactJudge::judge_rim(std::uint32_t ta, std::uint32_t tb, const Vec3d& point,
                             const AddRays& add_rays) {
  if (!found_.boundaries_meet) stand_at(ta, tb, point);
  insert_linear(ta, tb);
  const bool had_interiors = found_.overlap.interiors;
  add_rays();
  sectors_.judge(a_.solid(), b_.solid(), found_.overlap);
  if (found_.overlap.interiors && !had_interiors) stand_at(ta, tb, point);
}

void ContactJudge::rim_in_face_of_b(const TriangleSide& side, std::uint32_t tb,
                                    const Vec3d& point) {
  judge_rim(side.triangle, tb, point, [&] {
    start_axis(sectors_, a_, side.triangle, side.number);
    add_star(sectors_, a_, side.triangle, side.number, false);
    add_coordinate_face(sectors_, b_, tb, true);
  });
}

void ContactJudge::rim_in_face_of_a(const TriangleSide& side, std::uint32_t ta,
                                    const Vec3d& point) {
  judge_rim(ta, side.triangle, point, [&] {
    start_axis(sectors_, b_, side.triangle, side.number);
    add_coordinate_face(sectors_, a_, ta, false);
    add_star(sectors_, b_, side.triangle, side.number, true);
  });
}

void ContactJudge::take(const Contacts& more) {
  const bool says_more =
      more.boundaries_meet &&
      (!found_.boundaries_meet || (more.overlap.interiors && !found_.overlap.interiors));
  if (says_more) {
    found_.boundaries_meet = true;
    found_.triangle_a = more.triangle_a;
    found_.triangle_b = more.triangle_b;
    found_.point = more.point;
  }
  found_.overlap.interiors |= more.overlap.interiors;
  found_.overlap.a_leaves_b |= more.overlap.a_leaves_b;
  found_.overlap.b_leaves_a |= more.overlap.b_leaves_a;
  found_.flush |= more.flush;
  found_.separated |= more.separated;
  found_.linear_a.insert(more.linear_a);
  found_.linear_b.insert(more.linear_b);
}

}  // namespace strake::geometry
