// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using geometry::Vec3d;

/// Long side, end and roof lines of a corrugated box, extruded upwards.
OutlinePolygon corrugated(double length, double width) {
  OutlinePolygon result;
  const auto side = [&](double u0, double v0, double du, double dv, int waves, double span) {
    const double step = span / (4 * waves);
    for (int i = 0; i < waves; ++i) {
      const double s = 4 * i * step;
      const std::array<std::array<double, 2>, 4> marks{
          {{s + step * 0.5, 0}, {s + step * 1.5, 30}, {s + step * 2.5, 30}, {s + step * 3.5, 0}}};
      for (const auto& [along, in] : marks)
        result.push_back({um(u0 + du * along - dv * in), um(v0 + dv * along + du * in)});
    }
  };
  const auto corner = [&](double u, double v) { result.push_back({um(u), um(v)}); };
  corner(0, 0);
  side(40, 0, 1, 0, 9, length - 80);
  corner(length, 0);
  side(length, 40, 0, 1, 7, width - 80);
  corner(length, width);
  side(length - 40, width, -1, 0, 9, length - 80);
  corner(0, width);
  side(0, width - 40, 0, -1, 7, width - 80);
  // Marks on the outer line stand in line with the corners: drop what is straight.
  OutlinePolygon clean;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const ProfilePoint& a = result[(i + result.size() - 1) % result.size()];
    const ProfilePoint &b = result[i], &c = result[(i + 1) % result.size()];
    if ((b.u - a.u) * (c.v - b.v) != (b.v - a.v) * (c.u - b.u)) clean.push_back(b);
  }
  return clean;
}

void build_containers(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const std::uint32_t shape =
      builder.shape({4001}, [] { return extrude(corrugated(2600, 1400), {}, um(1500)); });
  for (int row = 0; row < 2; ++row) {
    Handle below = room.deck;
    const int tiers = room.random.between(1, 3);
    for (int tier = 0; tier < tiers; ++tier) {
      const ObjectKind kind =
          room.random.chance(50) ? ObjectKind::container : ObjectKind::container_red;
      const Handle box = builder.add(kind, site.cell, shape,
                                     site.frame * at({100, 100 + 1650.0 * row, 1500.0 * tier}));
      builder.rest(box, below);
      below = box;
    }
  }
}

void build_mooring(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle bed = site.box(ObjectKind::foundation, {300, 400, 0}, {1900, 2500, 120});
  builder.weld(bed, room.deck);
  const std::array<Vec3d, 12> drum{{{300, 0, 0},
                                    {420, 20, 0},
                                    {420, 60, 0},
                                    {220, 90, 0},
                                    {220, 700, 0},
                                    {420, 730, 0},
                                    {420, 790, 0},
                                    {220, 820, 0},
                                    {220, 1300, 0},
                                    {420, 1330, 0},
                                    {420, 1370, 0},
                                    {300, 1390, 0}}};
  const Handle winch =
      site.turned(ObjectKind::winch, drum, facing(FacingAxis::beside, {1100, 700, 540}));
  builder.rest(winch, bed);
  const Handle gear = site.box(ObjectKind::machine_part, {800, 2090, 120}, {1400, 2450, 900});
  builder.bolt(gear, winch);
  builder.bolt(gear, bed);
  const std::array<Vec3d, 6> post{
      {{150, 0, 0}, {150, 450, 0}, {190, 490, 0}, {190, 560, 0}, {150, 600, 0}, {60, 610, 0}}};
  for (const double b : {600.0, 1300.0}) {
    const Handle sole = site.box(ObjectKind::foundation, {2250, b - 220, 0}, {2750, b + 220, 30});
    builder.weld(sole, room.deck);
    const Handle bollard = site.turned(ObjectKind::bollard, post, at({2500, b, 30}));
    builder.weld(bollard, sole);
  }
}

void build_vents(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const std::array<Vec3d, 8> mushroom{{{160, 0, 0},
                                       {160, 700, 0},
                                       {330, 620, 0},
                                       {350, 640, 0},
                                       {350, 760, 0},
                                       {280, 880, 0},
                                       {140, 950, 0},
                                       {0, 970, 0}}};
  const std::array<Vec3d, 6> goose{
      {{60, 0, 0}, {60, 500, 0}, {110, 520, 0}, {110, 720, 0}, {80, 760, 0}, {0, 780, 0}}};
  for (int i = 0; i < 4; ++i) {
    const int column = i % 2, row = i / 2;
    builder.weld(site.turned(ObjectKind::vent_head, mushroom,
                             at({500 + 1200.0 * column, 600 + 1100.0 * row, 0})),
                 room.deck);
  }
  for (int i = 0; i < 5; ++i)
    builder.weld(site.turned(ObjectKind::vent_head, goose, at({250 + 350.0 * i, 2800, 0})),
                 room.deck);
  builder.weld(site.tube(ObjectKind::foundation, {700, 700, 350}, 12, at({2000, 2300, 0})),
               room.deck);
}

void build_boat(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  std::vector<Vec3d> hull;
  for (int step = 1; step <= 6; ++step) {
    const Vec3d c = unit_15deg(step);
    hull.push_back({560 * c.y, 700 - 700 * c.x, 0});
  }
  for (int step = 6; step >= 1; --step) {
    const Vec3d c = unit_15deg(step);
    hull.push_back({560 * c.y, 1900 + 700 * c.x, 0});
  }
  const Handle boat =
      site.turned(ObjectKind::boat, hull, facing(FacingAxis::along, {100, 1200, 1500}));
  for (const double a : {950.0, 1750.0}) {
    const std::array<Vec3d, 6> davit{{{1000, 0, 0},
                                      {2300, 0, 0},
                                      {2300, 2500, 0},
                                      {2100, 2500, 0},
                                      {1950, 940, 0},
                                      {1000, 940, 0}}};
    const Handle arm =
        site.extruded(ObjectKind::davit, davit, 120, facing(FacingAxis::along, {a, 0, 0}));
    builder.weld(arm, room.deck);
    builder.rest(boat, arm);
  }
}

void build_funnel(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const std::array<Vec3d, 8> casing{{{500, 600, 0},
                                     {2300, 600, 0},
                                     {2700, 1000, 0},
                                     {2700, 2300, 0},
                                     {2300, 2700, 0},
                                     {500, 2700, 0},
                                     {100, 2300, 0},
                                     {100, 1000, 0}}};
  Handle below = room.deck;
  for (int tier = 0; tier < 3; ++tier) {
    const ObjectKind kind = tier == 1 ? ObjectKind::mast : ObjectKind::funnel;
    const Handle ring = site.extruded(kind, casing, tier == 1 ? 500 : 1500,
                                      at({0, 0,
                                          tier == 0   ? 0.0
                                          : tier == 1 ? 1500.0
                                                      : 2000.0}));
    builder.weld(ring, below);
    below = ring;
  }
  const std::array<Vec3d, 4> uptake{{{180, 0, 0}, {180, 900, 0}, {210, 910, 0}, {210, 1000, 0}}};
  for (int i = 0; i < 3; ++i)
    builder.weld(site.turned(ObjectKind::mast, uptake,
                             at({800 + 600.0 * i, i == 1 ? 2000.0 : 1350.0, 3500})),
                 below);
}

void build_mast(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle house = site.box(ObjectKind::wall, {300, 500, 0}, {2500, 2800, 1700});
  builder.weld(house, room.deck);
  const std::array<Vec3d, 5> pole{
      {{260, 0, 0}, {240, 60, 0}, {160, 3200, 0}, {160, 3500, 0}, {90, 5200, 0}}};
  const Handle mast = site.turned(ObjectKind::mast, pole, at({1400, 1650, 1700}));
  builder.weld(mast, house);
  for (const double side : {-1.0, 1.0}) {
    const double b = side < 0 ? 1650 - 160 - 1400 : 1650 + 160;
    const Handle yardarm = site.box(ObjectKind::mast, {1380, b, 5000}, {1420, b + 1400, 5060});
    builder.weld(yardarm, mast);
    for (int i = 0; i < 3; ++i) {
      const double at_b = b + 200 + 450.0 * i;
      builder.weld(site.bar(ObjectKind::lamp, 40, 260, at({1400, at_b, 5060})), yardarm);
    }
  }
  const Handle radar = site.box(ObjectKind::mast, {1330, 650, 6900}, {1470, 2650, 7080});
  builder.weld(radar, mast);
  for (int i = 0; i < 4; ++i) {
    const double b = 620 + 540.0 * i;
    builder.fit(site.box(ObjectKind::window, {2500, b, 900}, {2512, b + 440, 1500}), house);
  }
}

/// Builds posts, rails and knee rails along a line of `length` in the site's x; y points outward.
Handle build_railing(const Site& site, Handle deck, double length, Handle before) {
  ShipBuilder& builder = *site.builder;
  const Handle rail = site.box(ObjectKind::railing, {0, 0, 1000}, {length, 12, 1050});
  builder.weld(rail, before);
  std::array<Handle, 2> knees{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double h = 350 + 320.0 * static_cast<double>(k);
    knees[k] = site.box(ObjectKind::railing, {100, 12, h}, {length - 100, 22, h + 40});
  }
  for (double u = 400; u < length; u += 800) {
    const Handle post = site.box(ObjectKind::railing, {u - 30, 0, 0}, {u + 30, 12, 1000});
    builder.weld(post, deck);
    builder.weld(post, rail);
    for (const Handle knee : knees) builder.weld(post, knee);
  }
  return rail;
}

/// Builds rails where a deck ends, and along the open side of the weather deck.
void build_railings(const ShipPlan& plan, const Steel& steel, ShipBuilder& builder) {
  for (int k = 0; k <= plan.levels; ++k) {
    const int bay = plan.deck_bays(k) - 1;
    for (int lane = 0; lane < plan.lanes; ++lane) {
      const Site site = plan.site(builder, bay, lane, k);
      AxisFrame across = at({kBay - 12, lane == 0 ? 230.0 : 30.0, 0});
      across.m = {0, 1, 0, 1, 0, 0, 0, 0, 1};  // x runs across the ship, y forward: mirrored
      build_railing(site.in(across), steel.deck(k, bay, lane),
                    lane == 0                ? 3740
                    : lane + 1 == plan.lanes ? 3740
                                             : 3940,
                    kNothing);
    }
  }
  Handle before = kNothing;
  for (int bay = 0; bay < plan.deck_bays(plan.levels); ++bay) {
    const bool last = bay + 1 == plan.deck_bays(plan.levels);
    const Site site = plan.site(builder, bay, 0, plan.levels).moved({0, 150, 0});
    before = build_railing(site, steel.deck(plan.levels, bay, 0), last ? kBay - 100 : kBay, before);
  }
}

}  // namespace

void build_weather_deck(const ShipPlan& plan, const Steel& steel, ShipBuilder& builder) {
  using GearBuilder = void (*)(ShipRoom&);
  constexpr std::array<GearBuilder, 5> kGear{build_containers, build_mooring, build_vents,
                                             build_containers, build_boat};
  const int level = plan.levels, bays = plan.deck_bays(level), middle = plan.lanes / 2;
  const auto is_funnel = [&](int bay, int lane) { return bay % 24 == 0 && lane == middle; };
  const auto is_mast = [&](int bay, int lane) {
    return bay + 1 == bays && bays > 1 && lane == middle;
  };
  std::uint64_t free = 0, place = 0;
  for (int bay = 0; bay < bays; ++bay)
    for (int lane = 0; lane < plan.lanes; ++lane)
      free += is_funnel(bay, lane) || is_mast(bay, lane) ? 0U : 1U;
  const std::uint64_t imported = std::min(plan.imported, free);
  for (int bay = 0; bay < bays; ++bay)
    for (int lane = 0; lane < plan.lanes; ++lane) {
      Random random = plan.random(41, bay, lane, level);
      ShipRoom room{plan.site(builder, bay, lane, level).moved({260, 350, 0}),
                    steel.deck(level, bay, lane), random.at(1)};
      if (is_funnel(bay, lane)) {
        build_funnel(room);
        continue;
      }
      if (is_mast(bay, lane)) {
        build_mast(room);
        continue;
      }
      // Bresenham: evenly over the deck.
      const bool heavy = (place + 1) * imported / free != place * imported / free;
      ++place;
      if (heavy)
        build_imported(room, plan.imported_triangles);
      else
        kGear[random.below(kGear.size())](room);
    }
  build_railings(plan, steel, builder);
}

}  // namespace strake::generate
