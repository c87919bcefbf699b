// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using clash::Class;
using geometry::Box3d;
using geometry::Vec3d;

/// Returns D of two boxes that overlap: the largest distance to either boundary over the common
/// box. The distance to a box's own boundary is a minimum over the axes, so each axis gives its own
/// maximum.
double depth_of_boxes(const Box3d& a, const Box3d& b) {
  const auto deepest = [&](const Box3d& body) {
    double depth = 1e300;
    for (int k = 0; k < 3; ++k) {
      const double lo = std::max(a.lo[k], b.lo[k]), hi = std::min(a.hi[k], b.hi[k]);
      const double x = std::clamp((body.lo[k] + body.hi[k]) / 2, lo, hi);
      depth = std::min(depth, std::min(x - body.lo[k], body.hi[k] - x));
    }
    return depth;
  };
  return std::max(deepest(a), deepest(b));
}

/// A gap that is either well inside the clearance or well outside of it.
struct Gap {
  double mm = 0;
  bool near = false;
};

Gap choose_gap(Random& random) {
  if (random.chance(40)) return {random.between(52, 66) * 0.5, false};
  return {random.between(4, 48) * 0.5, true};
}

void declare_gap(const ShipRoom& room, Handle a, Handle b, const Gap& gap, PairReason why) {
  if (gap.near) room.site.builder->declare({a, b, Class::clearance_violation, why, gap.mm});
}

Handle standing(const ShipRoom& room, ObjectKind kind, const Box3d& box) {
  const Handle handle = room.site.box(kind, box.lo, box.hi);
  room.site.builder->rest(handle, room.deck);
  return handle;
}

void two_boxes(ShipRoom& room, ObjectKind kind, const Box3d& a, const Box3d& b, PairReason why) {
  const Handle first = standing(room, kind, a), second = standing(room, kind, b);
  room.site.builder->declare({first, second, Class::hit, why, -depth_of_boxes(a, b)});
}

void cabinet_in_pipe(ShipRoom& room) {
  // The pipe's flat faces the cabinet: the deepest common point lies on that flat while the
  // cabinet stops short of the axis, and on the cabinet's face beyond.
  const double depth = room.random.between(6, 90);
  const Handle pipe = room.site.bar(ObjectKind::pipe, 57, 1900, at({450, 320, 0}));
  room.site.builder->weld(pipe, room.deck);
  const Handle cabinet =
      standing(room, ObjectKind::cabinet, {{20, 60, 0}, {450 - 57 + depth, 580, 1700}});
  room.site.builder->declare({pipe, cabinet, Class::hit, PairReason::overlap, -depth});
}

void overlapping_cabinets(ShipRoom& room) {
  const double in = room.random.between(5, 60);
  two_boxes(room, ObjectKind::cabinet, {{30, 60, 0}, {330, 400, 900}},
            {{330 - in, 120, 0}, {600, 580, 700}}, PairReason::overlap);
}

void crossing_plates(ShipRoom& room) {
  two_boxes(room, ObjectKind::support, {{40, 300, 0}, {600, 312, 800}},
            {{300, 60, 0}, {310, 580, 700}}, PairReason::overlap);
}

void crossing_thin_plates(ShipRoom& room) {
  two_boxes(room, ObjectKind::cabinet, {{40, 300, 0}, {600, 303, 800}},
            {{300, 60, 0}, {303, 580, 700}}, PairReason::thin_plates);
}

void slight_touch(ShipRoom& room) {
  const bool pressed = room.random.chance(50);
  const double gap = pressed ? -0.4 : 0.4;
  const Handle a = standing(room, ObjectKind::cabinet, {{40, 60, 0}, {300, 580, 1200}});
  const Handle b = standing(room, ObjectKind::cabinet, {{300 + gap, 100, 0}, {600, 540, 1000}});
  room.site.builder->declare(
      {a, b, Class::contact, pressed ? PairReason::press : PairReason::gap_small, gap});
}

void side_by_side(ShipRoom& room) {
  const Gap gap = choose_gap(room.random);
  const Handle a = standing(room, ObjectKind::cabinet, {{30, 60, 0}, {300, 580, 1200}});
  const Handle b = standing(room, ObjectKind::cabinet, {{300 + gap.mm, 100, 0}, {610, 540, 1000}});
  declare_gap(room, a, b, gap, PairReason::gap_clear);
}

void pipes_side_by_side(ShipRoom& room) {
  const Gap gap = choose_gap(room.random);
  const Handle a = room.site.bar(ObjectKind::pipe, 84, 1800, at({150, 300, 0}));
  const Handle b = room.site.bar(ObjectKind::pipe, 57, 1800, at({150 + 84 + gap.mm + 57, 300, 0}));
  room.site.builder->weld(a, room.deck);
  room.site.builder->weld(b, room.deck);
  declare_gap(room, a, b, gap, PairReason::gap_clear);
}

void buried_box(ShipRoom& room) {
  const Box3d outer{{40, 40, 0}, {600, 600, 900}};
  const double at = room.random.between(60, 300);
  const Box3d inner{{at, at, 100}, {at + 200, at + 180, 400}};
  const Handle a = standing(room, ObjectKind::tank, outer);
  const Handle b = room.site.box(ObjectKind::tank_internal, inner.lo, inner.hi);
  room.site.builder->declare({a, b, Class::hit, PairReason::buried, -depth_of_boxes(outer, inner)});
  if (room.random.chance(50)) room.site.builder->turn_inside_out(a);
}

void modelled_twice(ShipRoom& room) {
  const Box3d box{{60, 100, 0}, {560, 420, 850}};
  two_boxes(room, ObjectKind::cabinet, box, box, PairReason::copy);
}

void crossing_pipes(ShipRoom& room) {
  // The axes meet, so the thicker one's axis runs through the common part.
  const Handle upright = room.site.bar(ObjectKind::pipe, 57, 1500, at({320, 320, 0}));
  room.site.builder->weld(upright, room.deck);
  const double r = room.random.chance(50) ? 45 : 84;
  const Handle level =
      room.site.bar(ObjectKind::pipe, r, 580, facing(FacingAxis::along, {30, 320, 900}));
  room.site.builder->declare(
      {upright, level, Class::hit, PairReason::wrong_run, -std::max(57.0, r)});
}

void in_cavity(ShipRoom& room) {
  const Gap gap = choose_gap(room.random);
  const Handle tank = room.site.shell_box(ObjectKind::tank, {40, 40, 0}, {600, 600, 900}, 20);
  room.site.builder->rest(tank, room.deck);
  const Handle inner =
      room.site.box(ObjectKind::tank_internal, {60 + gap.mm, 150, 100}, {400, 450, 500});
  declare_gap(room, tank, inner, gap, PairReason::gap_inside);
  if (room.random.chance(50)) room.site.builder->turn_inside_out(tank);
}

/// Builds an upright channel section that opens to +x, welded to the deck.
Handle open_channel(ShipRoom& room) {
  const std::array<Vec3d, 8> profile{{{40, 60, 0},
                                      {480, 60, 0},
                                      {480, 80, 0},
                                      {60, 80, 0},
                                      {60, 400, 0},
                                      {480, 400, 0},
                                      {480, 420, 0},
                                      {40, 420, 0}}};
  const Handle channel = room.site.extruded(ObjectKind::support, profile, 1200, at({0, 0, 0}));
  room.site.builder->weld(channel, room.deck);
  return channel;
}

void in_channel(ShipRoom& room) {
  const Gap gap = choose_gap(room.random);
  const Handle channel = open_channel(room);
  const Handle post =
      standing(room, ObjectKind::support, {{60 + gap.mm, 120, 0}, {400, 350, 1000}});
  declare_gap(room, channel, post, gap, PairReason::gap_inside);
}

void corner_to_corner(ShipRoom& room) {
  constexpr std::array<std::array<double, 4>, 6> kGaps{{{3, 4, 12, 13},
                                                        {8, 9, 12, 17},
                                                        {2, 3, 6, 7},
                                                        {6, 10, 15, 19},
                                                        {10, 15, 20, 0},
                                                        {12, 16, 18, 0}}};
  const auto& g = kGaps[room.random.below(kGaps.size())];
  const Handle a = standing(room, ObjectKind::cabinet, {{40, 60, 0}, {300, 300, 600}});
  const Handle b =
      room.site.box(ObjectKind::cabinet, {300 + g[0], 300 + g[1], 600 + g[2]}, {600, 580, 1100});
  if (g[3] > 0)
    room.site.builder->declare({a, b, Class::clearance_violation, PairReason::gap_corner, g[3]});
}

void slanted_blocks(ShipRoom& room) {
  // Slants of slope 3:4, moved apart along their common normal (3/5, 4/5).
  const Gap gap = choose_gap(room.random);
  const double du = 0.6 * gap.mm, dv = 0.8 * gap.mm;
  const std::array<Vec3d, 3> low{{{60, 60, 0}, {460, 60, 0}, {60, 360, 0}}};
  const std::array<Vec3d, 3> high{
      {{460 + du, 60 + dv, 0}, {460 + du, 360 + dv, 0}, {60 + du, 360 + dv, 0}}};
  const Handle a = room.site.extruded(ObjectKind::support, low, 900, at({0, 0, 0}));
  const Handle b = room.site.extruded(ObjectKind::support, high, 900, at({0, 0, 0}));
  room.site.builder->weld(a, room.deck);
  room.site.builder->weld(b, room.deck);
  declare_gap(room, a, b, gap, PairReason::gap_slanted);
}

/// Seeds a block that fills the bay of a channel: three faces touch, no plane separates the two.
void fitted_block(ShipRoom& room) {
  const Handle channel = open_channel(room);
  const Handle block = standing(room, ObjectKind::support, {{60, 80, 0}, {400, 400, 1000}});
  room.site.builder->fit(channel, block);
}

}  // namespace

void plant(ShipRoom& room) {
  switch (room.random.below(16)) {
    case 0:
      return cabinet_in_pipe(room);
    case 1:
      return overlapping_cabinets(room);
    case 2:
      return crossing_plates(room);
    case 3:
      return crossing_thin_plates(room);
    case 4:
      return slight_touch(room);
    case 5:
      return side_by_side(room);
    case 6:
      return pipes_side_by_side(room);
    case 7:
      return buried_box(room);
    case 8:
      return modelled_twice(room);
    case 9:
      return crossing_pipes(room);
    case 10:
      return in_cavity(room);
    case 11:
      return in_channel(room);
    case 12:
      return corner_to_corner(room);
    case 13:
      return slanted_blocks(room);
    case 14:
      return fitted_block(room);
    default:
      return;
  }
}

}  // namespace strake::generate
