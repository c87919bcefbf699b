// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using geometry::Vec3d;

/// All of the steel that other steel is welded to.
struct HullParts {
  HullParts(const ShipPlan& p, ShipBuilder& y)
      : plan(p),
        builder(y),
        steel(p),
        bottom(1, p.bays, p.lanes),
        bilge(1, 2, p.bays),
        strake(2, p.levels + 1, p.bays),
        girder(1, p.bays, p.lanes),
        longitudinal(p.levels + 1, p.bays, p.lanes * kLongitudinals),
        bulkhead(p.levels, p.bays, p.lanes) {}

  const ShipPlan& plan;
  ShipBuilder& builder;
  Steel steel;
  Handles bottom, bilge, strake, girder, longitudinal, bulkhead;

  [[nodiscard]] int edge_lane(int side) const { return side == 0 ? 0 : plan.lanes - 1; }
  /// Returns a site whose y runs inward from the shell of a side: mirrored to port.
  [[nodiscard]] Site shell_site(int side, int bay, int level, double z) const {
    AxisFrame frame = at({plan.x(bay), side == 0 ? plan.y(0) : plan.y(plan.lanes), z});
    if (side == 1) frame.m[4] = -1;
    return {&builder, ShipPlan::cell(bay, edge_lane(side), level), frame};
  }
  void weld_strakes(int side, int level, int bay, Handle handle) const {
    builder.weld(handle, strake(side, level, bay));
    builder.weld(handle, strake(side, level + 1, bay));
  }
};

/// Welds plates of a grid to the eight around them, along an edge or at a corner.
void weld_neighbours(ShipBuilder& builder, const Handles& plates, int layer, int rows,
                     int columns) {
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Handle plate = plates(layer, i, j);
      builder.weld(plate, plates(layer, i, j + 1));
      for (int dj = -1; dj <= 1; ++dj) builder.weld(plate, plates(layer, i + 1, j + dj));
    }
}

void build_decks(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  for (int k = 0; k <= plan.levels; ++k)
    for (int i = 0; i < plan.deck_bays(k); ++i)
      for (int j = 0; j < plan.lanes; ++j)
        hull.steel.deck.set(k, i, j,
                            plan.site(hull.builder, i, j, k)
                                .box(k == 0 ? ObjectKind::tank_top : ObjectKind::deck_plate,
                                     {0, 0, -kDeckPlate}, {kBay, kLane, 0}));
  for (int k = 0; k <= plan.levels; ++k)
    weld_neighbours(hull.builder, hull.steel.deck, k, plan.bays, plan.lanes);
}

void build_bottom(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  for (int i = 0; i < plan.bays; ++i)
    for (int j = 0; j < plan.lanes; ++j) {
      const Site site{&hull.builder, ShipPlan::cell(i, j, 0), at({plan.x(i), plan.y(j), 0})};
      const double from = j == 0 ? kBilge : 0;
      const double to = j == plan.lanes - 1 ? kLane - kBilge : kLane;
      hull.bottom.set(0, i, j,
                      site.box(ObjectKind::bottom_plate, {0, from, -kShellPlate}, {kBay, to, 0}));
    }
  weld_neighbours(hull.builder, hull.bottom, 0, plan.bays, plan.lanes);
}

/// Returns points of the bilge's inner or outer face, from the bottom up, (distance from shell,
/// height).
std::vector<Vec3d> bilge_arc(double radius) {
  std::vector<Vec3d> points;
  for (int step = 0; step <= 6; ++step) {
    const Vec3d c = unit_15deg(step);
    points.push_back({kBilge - radius * c.y, kBilge - radius * c.x, 0});
  }
  return points;
}

void build_shell(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  std::vector<Vec3d> profile = bilge_arc(kBilge);
  const std::vector<Vec3d> outer = bilge_arc(kBilge + kShellPlate);
  profile.insert(profile.end(), outer.rbegin(), outer.rend());
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < plan.bays; ++i)
      hull.bilge.set(
          0, side, i,
          hull.shell_site(side, i, 0, 0)
              .extruded(ObjectKind::bilge_strake, profile, kBay, facing(FacingAxis::along, {})));
    for (int s = 0; s <= plan.levels; ++s)
      for (int i = 0; i < plan.strake_bays(side, s); ++i) {
        const Site site = hull.shell_site(side, i, s + 1, kBilge + s * kLevel);
        const double height = s == plan.levels ? 1300 : kLevel;
        hull.strake.set(side, s, i,
                        site.box(ObjectKind::side_strake, {0, -kShellPlate, 0}, {kBay, 0, height}));
      }
    weld_neighbours(hull.builder, hull.strake, side, plan.levels + 1, plan.bays);
  }
}

void weld_shell(const HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < plan.bays; ++i) {
      const Handle bilge = hull.bilge(0, side, i);
      hull.builder.weld(bilge, hull.bilge(0, side, i + 1));
      for (int di = -1; di <= 1; ++di) {
        hull.builder.weld(bilge, hull.bottom(0, i + di, hull.edge_lane(side)));
        hull.builder.weld(bilge, hull.strake(side, 0, i + di));
        for (int k = 0; k <= plan.levels; ++k)
          hull.builder.weld(hull.strake(side, k, i),
                            hull.steel.deck(k, i + di, hull.edge_lane(side)));
      }
    }
}

constexpr double kGirderAt = 100;  ///< from the lane's start, so that plate seams stay clear of it
constexpr double kFloorPlate = 12;
constexpr double kDepth = kTankTop - kDeckPlate;  ///< depth of the double bottom, inside

OutlinePolygon hole_at(double u, double v, double radius, int sides) {
  OutlinePolygon hole = ring(sides, um(radius));
  for (ProfilePoint& p : hole) p = {p.u + um(u), p.v + um(v)};
  return hole;
}

void build_girders(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  const std::uint32_t shape = hull.builder.shape({1001}, [] {
    const OutlinePolygon outer{{0, 0}, {0, um(kDepth)}, {um(-kBay), um(kDepth)}, {um(-kBay), 0}};
    std::vector<OutlinePolygon> holes;
    for (int m = 1; m < kFrames; ++m) holes.push_back(hole_at(-800.0 * m, 885, 260, 24));
    return extrude(outer, holes, um(kDeckPlate));
  });
  for (int i = 0; i < plan.bays; ++i)
    for (int j = 1; j < plan.lanes; ++j) {
      const ShipCell cell = ShipPlan::cell(i, j, 0);
      AxisFrame frame = at({plan.x(i), plan.y(j) + kGirderAt, 0});
      frame.m = {-1, 0, 0, 0, 0, 1, 0, 1, 0};  // profile (-x, z), thickness along y
      const Handle girder = hull.builder.add(ObjectKind::girder, cell, shape, frame);
      hull.girder.set(0, i, j, girder);
      hull.builder.weld(girder, hull.girder(0, i - 1, j));
      for (int di = -1; di <= 1; ++di) {
        hull.builder.weld(girder, hull.bottom(0, i + di, j));
        hull.builder.weld(girder, hull.steel.deck(0, i + di, j));
      }
    }
}

/// Returns the floor of an outer lane, from the shell inward to `width`; for an inner one a
/// rectangle.
std::uint32_t floor_shape(ShipBuilder& builder, bool outer, double width) {
  return builder.shape({1002, outer ? 1 : 0, um(width)}, [&] {
    std::vector<Vec3d> profile;
    if (outer) {
      profile = bilge_arc(kBilge);
      profile.push_back({0, kDepth, 0});
      profile.push_back({width, kDepth, 0});
      profile.push_back({width, 0, 0});
      profile = {profile.rbegin(), profile.rend()};
    } else {
      profile = {{0, 0, 0}, {width, 0, 0}, {width, kDepth, 0}, {0, kDepth, 0}};
    }
    std::vector<OutlinePolygon> holes;
    const double shift = outer ? 0 : kGirderAt + kDeckPlate;
    for (const double v : {900.0, 2100.0, 3300.0})
      holes.push_back(hole_at(v - shift, 885, 320, 24));
    return extrude(outline(profile), holes, um(kFloorPlate));
  });
}

void build_floors(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  const double inner_from = kGirderAt + kDeckPlate;
  for (int i = 0; i < plan.bays; ++i)
    for (int j = 0; j < plan.lanes; ++j)
      for (int m = 0; m < kFrames; ++m) {
        const bool first = j == 0, last = j == plan.lanes - 1;
        const double x = 400.0 + 800.0 * m - kFloorPlate / 2;
        Site site{&hull.builder, ShipPlan::cell(i, j, 0), at({plan.x(i), plan.y(j), 0})};
        AxisFrame where = facing(FacingAxis::along, {x, first ? 0 : inner_from, 0});
        if (last) {
          site = hull.shell_site(1, i, 0, 0);
          where = facing(FacingAxis::along, {x, 0, 0});
        }
        const double width = first  ? kLane + kGirderAt
                             : last ? kLane - inner_from
                                    : kLane - kDeckPlate;
        const std::uint32_t shape = floor_shape(hull.builder, first || last, width);
        const Handle floor =
            hull.builder.add(ObjectKind::floor, site.cell, shape, site.frame * where);
        for (int dj = 0; dj <= 1; ++dj) {
          hull.builder.weld(floor, hull.bottom(0, i, j + dj));
          hull.builder.weld(floor, hull.steel.deck(0, i, j + dj));
          hull.builder.weld(floor, hull.girder(0, i, j + dj));
        }
        for (int side = 0; side < 2; ++side)
          if (j == hull.edge_lane(side)) {
            hull.builder.weld(floor, hull.bilge(0, side, i));
            hull.builder.weld(floor, hull.strake(side, 0, i));
          }
      }
}

void build_longitudinals(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  const std::array<Vec3d, 6> profile{
      {{0, 0, 0}, {90, 0, 0}, {90, 10, 0}, {10, 10, 0}, {10, 150, 0}, {0, 150, 0}}};
  for (int k = 1; k <= plan.levels; ++k)
    for (int i = 0; i < plan.deck_bays(k); ++i) {
      const bool last = i + 1 == plan.deck_bays(k);
      const bool starts_at_bulkhead = plan.bulkhead_at(k - 1, i);
      const bool ends_at_bulkhead = !last && plan.bulkhead_at(k - 1, i + 1);
      // Sniped 30 mm short of the bulkhead ahead, so that it never comes near the steel beyond.
      const double from = i == 0 ? 0 : kBulkheadAt + (starts_at_bulkhead ? kBulkheadPlate / 2 : 0);
      const double to =
          last ? kBay : kBay + kBulkheadAt - (ends_at_bulkhead ? kBulkheadPlate / 2 + 30 : 0);
      for (int j = 0; j < plan.lanes; ++j)
        for (int m = 0; m < kLongitudinals; ++m) {
          const Site site = plan.site(hull.builder, i, j, k - 1);
          const Handle bar =
              site.extruded(ObjectKind::longitudinal, profile, to - from,
                            facing(FacingAxis::along, {from, 400.0 + 800.0 * m, kHeadroom - 150}));
          const int place = j * kLongitudinals + m;
          hull.longitudinal.set(k, i, place, bar);
          hull.builder.weld(bar, hull.steel.deck(k, i, j));
          hull.builder.weld(bar, hull.steel.deck(k, i + 1, j));
          if (starts_at_bulkhead)
            hull.builder.weld(bar, hull.bulkhead(k - 1, i, j));
          else
            hull.builder.weld(bar, hull.longitudinal(k, i - 1, place));
        }
    }
}

/// Makes a web with a slot for each longitudinal, coplanar with its web on one side; flange below.
MicrometreMesh beam_mesh() {
  const double low = kBeamFlangeUnder + 15;
  std::vector<Vec3d> web{{0, low, 0}, {kLane, low, 0}, {kLane, kHeadroom, 0}};
  for (int m = kLongitudinals - 1; m >= 0; --m) {
    const double v = 400.0 + 800.0 * m, up = kHeadroom - 190;
    web.push_back({v + 130, kHeadroom, 0});
    web.push_back({v + 130, up, 0});
    web.push_back({v, up, 0});
    web.push_back({v, kHeadroom, 0});
  }
  web.push_back({0, kHeadroom, 0});
  MicrometreMesh mesh = cycled(extrude(outline(web), {}, um(10)), 1, {um(-5), 0, 0});
  append(mesh, make_box({um(150), um(kLane), um(15)}), {um(-75), 0, um(kBeamFlangeUnder)});
  return mesh;
}

void build_beams(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  const std::uint32_t shape = hull.builder.shape({1003}, beam_mesh);
  for (int k = 0; k < plan.levels; ++k)
    for (int i = 0; i < plan.deck_bays(k + 1); ++i)
      for (int j = 0; j < plan.lanes; ++j) {
        const Site site = plan.site(hull.builder, i, j, k);
        const Handle beam = hull.builder.add(ObjectKind::deck_beam, site.cell, shape,
                                             site.frame * at({kBeamAt, 0, 0}));
        hull.steel.beam.set(k, i, j, beam);
        hull.builder.weld(beam, hull.steel.beam(k, i, j - 1));
        for (int dj = -1; dj <= 1; ++dj) hull.builder.weld(beam, hull.steel.deck(k + 1, i, j + dj));
        for (int m = 0; m < kLongitudinals; ++m)
          hull.builder.weld(beam, hull.longitudinal(k + 1, i, j * kLongitudinals + m));
        for (int side = 0; side < 2; ++side)
          if (j == hull.edge_lane(side)) hull.weld_strakes(side, k, i, beam);
      }
}

void build_brackets(const HullParts& hull, const Site& site, int side, const ShipCell& place,
                    Handle frame, double x) {
  const std::array<Vec3d, 4> low{{{0, 0, 0}, {300, 0, 0}, {40, 350, 0}, {0, 350, 0}}};
  const std::array<Vec3d, 4> high{
      {{0, kHeadroom - 370, 0}, {40, kHeadroom - 370, 0}, {250, kHeadroom, 0}, {0, kHeadroom, 0}}};
  const int level = place.level, bay = place.bay, lane = place.lane;
  const Handle knee =
      site.extruded(ObjectKind::bracket, low, 12, facing(FacingAxis::along, {x - 12, 0, 0}));
  hull.builder.weld(knee, frame);
  hull.builder.weld(knee, hull.steel.deck(level, bay, lane));
  hull.builder.weld(knee, hull.strake(side, level, bay));
  const Handle above = hull.steel.deck(level + 1, bay, lane);
  if (above == kNothing) return;
  const Handle beam_knee =
      site.extruded(ObjectKind::bracket, high, 12, facing(FacingAxis::along, {x - 12, 0, 0}));
  hull.builder.weld(beam_knee, frame);
  hull.builder.weld(beam_knee, above);
  hull.weld_strakes(side, level, bay, beam_knee);
}

void build_side_frames(const HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  const std::array<Vec3d, 6> profile{
      {{0, 0, 0}, {10, 0, 0}, {10, 170, 0}, {80, 170, 0}, {80, 180, 0}, {0, 180, 0}}};
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < plan.levels; ++k)
      for (int i = 0; i < plan.deck_bays(k); ++i)
        for (int m = 0; m < kFrames; ++m) {
          const Site site = hull.shell_site(side, i, k + 1, plan.z(k));
          const double x = 400.0 + 800.0 * m;
          const Handle frame =
              site.extruded(ObjectKind::side_frame, profile, kHeadroom, at({x, 0, 0}));
          const int lane = hull.edge_lane(side);
          hull.builder.weld(frame, hull.steel.deck(k, i, lane));
          hull.builder.weld(frame, hull.steel.deck(k + 1, i, lane));
          hull.weld_strakes(side, k, i, frame);
          build_brackets(hull, site, side, ShipPlan::cell(i, lane, k), frame, x);
        }
}

/// Returns a bulkhead plate of a lane in (y, z): a door's opening below, the passage of the runs
/// above.
std::uint32_t bulkhead_shape(ShipBuilder& builder, bool door) {
  return builder.shape({1004, door ? 1 : 0}, [&] {
    const std::array<Vec3d, 4> plate{
        {{0, 0, 0}, {kLane, 0, 0}, {kLane, kHeadroom, 0}, {0, kHeadroom, 0}}};
    const std::array<Vec3d, 4> passage{
        {{260, 2060, 0}, {3740, 2060, 0}, {3740, 2400, 0}, {260, 2400, 0}}};
    const std::array<Vec3d, 8> way{{{1780, 200, 0},
                                    {2260, 200, 0},
                                    {2320, 260, 0},
                                    {2320, 1940, 0},
                                    {2260, 2000, 0},
                                    {1780, 2000, 0},
                                    {1720, 1940, 0},
                                    {1720, 260, 0}}};
    std::vector<OutlinePolygon> holes{outline(passage)};
    if (door) holes.push_back(outline(way));
    return extrude(outline(plate), holes, um(kBulkheadPlate));
  });
}

void build_bulkhead_fittings(const HullParts& hull, const Site& site, Handle plate, Handle deck,
                             bool door) {
  const double front = kBulkheadAt + kBulkheadPlate / 2, back = kBulkheadAt - kBulkheadPlate / 2;
  const std::array<Vec3d, 6> profile{
      {{0, 0, 0}, {120, 0, 0}, {120, 60, 0}, {110, 60, 0}, {110, 10, 0}, {0, 10, 0}}};
  for (int m = 1; m <= 4; ++m) {
    const Handle stiffener =
        site.extruded(ObjectKind::bulkhead_stiffener, profile, 2000, at({front, 800.0 * m, 0}));
    hull.builder.weld(stiffener, plate);
    hull.builder.weld(stiffener, deck);
  }
  if (!door) return;
  const Handle leaf =
      site.box(ObjectKind::bulkhead_door, {back - 40, 1680, 160}, {back, 2360, 2040});
  hull.builder.fit(leaf, plate);
}

void build_bulkheads(HullParts& hull) {
  const ShipPlan& plan = hull.plan;
  for (int k = 0; k < plan.levels; ++k)
    for (int i = 0; i < plan.deck_bays(k); ++i) {
      if (!plan.bulkhead_at(k, i)) continue;
      for (int j = 0; j < plan.lanes; ++j) {
        const bool door = plan.random(11, i, j, k).chance(50);
        const Site site = plan.site(hull.builder, i, j, k);
        const Handle plate = hull.builder.add(
            ObjectKind::bulkhead, site.cell, bulkhead_shape(hull.builder, door),
            site.frame * facing(FacingAxis::along, {kBulkheadAt - kBulkheadPlate / 2, 0, 0}));
        hull.bulkhead.set(k, i, j, plate);
        hull.builder.weld(plate, hull.bulkhead(k, i, j - 1));
        for (int dj = -1; dj <= 1; ++dj) {
          hull.builder.weld(plate, hull.steel.deck(k, i, j + dj));
          hull.builder.weld(plate, hull.steel.deck(k + 1, i, j + dj));
        }
        for (int side = 0; side < 2; ++side)
          if (j == hull.edge_lane(side)) hull.weld_strakes(side, k, i, plate);
        build_bulkhead_fittings(hull, site, plate, hull.steel.deck(k, i, j), door);
      }
    }
}

}  // namespace

Steel build_steel(const ShipPlan& plan, ShipBuilder& builder) {
  HullParts hull(plan, builder);
  build_decks(hull);
  build_bottom(hull);
  build_shell(hull);
  weld_shell(hull);
  build_girders(hull);
  build_floors(hull);
  build_bulkheads(hull);
  build_longitudinals(hull);
  build_beams(hull);
  build_side_frames(hull);
  return std::move(hull.steel);
}

}  // namespace strake::generate
