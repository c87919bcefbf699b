// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/relation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace strake::clash {
namespace {

using geometry::Box3i;
using geometry::DepthOperand;
using geometry::Meeting;
using geometry::MeetingResult;
using geometry::PartKind;
using geometry::PartWithBvh;
using geometry::Vec3l;

/// The number of vertices beyond which a body is not checked vertex by vertex for the sake of a
/// relation.
constexpr std::size_t kMaxVertices = std::size_t{1} << 21U;

bool box_within(const PartWithBvh& a, const PartWithBvh& b, double band) {
  const Vec3l shift = a.placed.origin - b.placed.origin;
  const auto margin = static_cast<std::int64_t>(std::ceil(band));
  const Box3i &x = a.placed.part->box, &y = b.placed.part->box;
  for (int k = 0; k < 3; ++k)
    if (x.lo[k] + shift[k] < y.lo[k] - margin || x.hi[k] + shift[k] > y.hi[k] + margin)
      return false;
  return true;
}

/// Whether every vertex of a lies in b, within the band.
geometry::ToleranceContainment within_band(const PartWithBvh& a, const PartWithBvh& b, double band,
                                           geometry::QueryContext& work) {
  if (!box_within(a, b, band) || a.placed.part->vertices.size() > kMaxVertices) return {};
  return geometry::containment_within(a, b, band, work);
}

bool on_surface(const PartWithBvh& a, const PartWithBvh& b, double band,
                geometry::QueryContext& work) {
  const geometry::ToleranceContainment cover = within_band(a, b, band, work);
  return cover.within && cover.on_surface;
}

/// Whether a bridges a gap of b: the surface of b runs deep inside a, though the corners of a lie
/// in b or on it. Only what is certain counts, and b's corners suffice where b is convex.
bool bridges_gap(const DepthOperand& a, const DepthOperand& b, double band,
                 geometry::QueryContext& work) {
  if (b.planes->nearly_convex) return false;
  const geometry::DepthOptions goal{.threshold = band + 1,
                                    .cells_undecided = 256,
                                    .cells_decided = 0,
                                    .negligible_depth = band + 1};
  return geometry::sheet_in_solid_depth(b, a, goal, work).lower > goal.threshold;
}

/// Whether a is thicker than the two are deep: what fills a channel has all its corners on the
/// channel's surface, but is not in it. Half the thickness, volume by area, is no more than the
/// radius of the largest ball in a convex body, and where that is in b, its centre is as deep.
bool sticks_out(const DepthOperand& a, const geometry::Depth& depth, double band) {
  return a.planes->nearly_convex && depth.upper < a.treed.placed.part->thickness() / 2 - 2 * band;
}

bool surfaces_meet(const PartWithBvh& a, const PartWithBvh& b, double band,
                   geometry::QueryContext& work) {
  const auto near = geometry::find_closest_pair(a, b, band + 1, work);
  return near && near->distance <= band;
}

/// Returns the thickness of the one of the two that is a solid.
double solid_thickness(const PartWithBvh& a, const PartWithBvh& b) {
  return (a.placed.part->kind == PartKind::solid ? a : b).placed.part->thickness();
}

/// Whether two sheets are the same one: exactly, or each within the band of the other.
bool one_sheet(const PartWithBvh& a, const PartWithBvh& b, const MeetingResult& meeting,
               double band, geometry::QueryContext& work) {
  if (!may_be_one_sheet(a, b, band)) return false;
  if (meeting.a_within_b && meeting.b_within_a) return true;
  return on_surface(a, b, band, work) && on_surface(b, a, band, work);
}

}  // namespace

bool may_be_one_sheet(const PartWithBvh& a, const PartWithBvh& b, double band) {
  return a.placed.part->kind == PartKind::sheet && b.placed.part->kind == PartKind::sheet &&
         box_within(a, b, band) && box_within(b, a, band);
}

Relation relation_of_contact(const PartWithBvh& a, const PartWithBvh& b,
                             const MeetingResult& meeting, double band,
                             geometry::QueryContext& work) {
  return one_sheet(a, b, meeting, band, work) ? Relation::duplicate : Relation::abut_outside;
}

Relation relation_of(const DepthOperand& deep_a, const DepthOperand& deep_b,
                     const geometry::MeetingResult& meeting, const geometry::Depth& depth,
                     double band, geometry::QueryContext& work) {
  const PartWithBvh &a = deep_a.treed, &b = deep_b.treed;
  if (a.placed.part->kind == PartKind::sheet || b.placed.part->kind == PartKind::sheet) {
    if (meeting.meeting == Meeting::a_inside_b) return Relation::a_in_b;
    if (meeting.meeting == Meeting::b_inside_a) return Relation::b_in_a;
    // It lies on the surface of a solid, but for what the snap made of it; slivers as thin have no
    // inside.
    if (depth.upper <= band && a.placed.part->kind != b.placed.part->kind &&
        solid_thickness(a, b) >= 4 * band)
      return Relation::abut_outside;
    return one_sheet(a, b, meeting, band, work) ? Relation::duplicate : Relation::cross;
  }
  if (meeting.meeting == Meeting::a_inside_b)
    return surfaces_meet(a, b, band, work) ? Relation::abut_inside : Relation::a_in_b;
  if (meeting.meeting == Meeting::b_inside_a)
    return surfaces_meet(a, b, band, work) ? Relation::abut_inside : Relation::b_in_a;
  if (meeting.a_within_b && meeting.b_within_a) return Relation::duplicate;
  // Only slivers as thin as the band may be one and the same, or one in the other, and no deeper.
  if (depth.upper <= band &&
      std::min(a.placed.part->thickness(), b.placed.part->thickness()) >= 4 * band)
    return Relation::abut_outside;
  // One is in the other for certain, and they are not the same: no vertices need to be checked.
  if ((meeting.a_within_b || meeting.b_within_a) &&
      !(box_within(a, b, band) && box_within(b, a, band)))
    return depth.upper <= band ? Relation::abut_outside : Relation::abut_inside;
  const geometry::ToleranceContainment a_cover = within_band(a, b, band, work);
  const bool a_in = a_cover.within && !sticks_out(deep_a, depth, band) &&
                    !bridges_gap(deep_a, deep_b, band, work);
  const geometry::ToleranceContainment b_cover = within_band(b, a, band, work);
  const bool b_in = b_cover.within && !sticks_out(deep_b, depth, band) &&
                    !bridges_gap(deep_b, deep_a, band, work);
  if (a_in && b_in && a_cover.on_surface && b_cover.on_surface) return Relation::duplicate;
  if (depth.upper <= band) return Relation::abut_outside;
  if (a_in || b_in || meeting.a_within_b || meeting.b_within_a) return Relation::abut_inside;
  return Relation::interfere;
}

}  // namespace strake::clash
