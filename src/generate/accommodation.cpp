// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using geometry::Vec3d;

struct Walls {
  Handle low_side, high_side, outer, inner;
};

/// A wall across the room in (b, h) with an opening, 50 mm thick along a.
Handle wall_with_opening(const Site& site, double a, const OutlinePolygon& opening) {
  const std::uint32_t shape = site.builder->shape(
      {3001, opening[0].u, opening[0].v, opening[1].u, opening[2].v,
       static_cast<std::int64_t>(opening.size())},
      [&] {
        const OutlinePolygon plate{
            {um(50), 0}, {um(3250), 0}, {um(3250), um(2000)}, {um(50), um(2000)}};
        const std::array<OutlinePolygon, 1> holes{opening};
        return extrude(plate, holes, um(50));
      });
  return site.builder->add(ObjectKind::wall, site.cell, shape,
                           site.frame * facing(FacingAxis::along, {a, 0, 0}));
}

Walls build_walls(const ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const std::array<Vec3d, 8> light{{{1300, 900, 0},
                                    {2100, 900, 0},
                                    {2200, 1000, 0},
                                    {2200, 1500, 0},
                                    {2100, 1600, 0},
                                    {1300, 1600, 0},
                                    {1200, 1500, 0},
                                    {1200, 1000, 0}}};
  const std::array<Vec3d, 4> way{{{2300, 60, 0}, {3000, 60, 0}, {3000, 1930, 0}, {2300, 1930, 0}}};
  Walls walls{};
  walls.low_side = site.box(ObjectKind::wall, {0, 0, 0}, {2070, 50, 2000});
  walls.high_side = site.box(ObjectKind::wall, {0, 3250, 0}, {2070, 3300, 2000});
  walls.outer = wall_with_opening(site, 0, outline(light));
  walls.inner = wall_with_opening(site, 2020, outline(way));
  for (const Handle wall : {walls.low_side, walls.high_side, walls.outer, walls.inner})
    builder.rest(wall, room.deck);
  for (const Handle across : {walls.outer, walls.inner}) {
    builder.fit(across, walls.low_side);
    builder.fit(across, walls.high_side);
  }
  const Handle pane = site.box(ObjectKind::window, {50, 1160, 860}, {60, 2240, 1640});
  builder.fit(pane, walls.outer);
  const Handle leaf = site.box(ObjectKind::door, {1980, 2270, 30}, {2020, 3030, 1960});
  builder.fit(leaf, walls.inner);
  return walls;
}

MicrometreMesh chair_mesh() {
  MicrometreMesh mesh = make_box(grid({400, 400, 40}));
  for (geometry::Vec3l& v : mesh.vertices) v.z += um(440);
  for (const double a : {10.0, 350.0})
    for (const double b : {10.0, 350.0})
      append(mesh, make_box(grid({40, 40, 440})), grid({a, b, 0}));
  append(mesh, make_box(grid({360, 30, 450})), grid({20, 10, 480}));
  return mesh;
}

void build_chair(const ShipRoom& room, double a, double b) {
  const Site& site = room.site;
  const std::uint32_t shape = site.builder->shape({3002}, chair_mesh);
  const Handle chair =
      site.builder->add(ObjectKind::furniture, site.cell, shape, site.frame * at({a, b, 0}));
  site.builder->rest(chair, room.deck);
}

void build_bed(const ShipRoom& room) {
  const Site& site = room.site;
  const Handle base = site.box(ObjectKind::furniture, {80, 80, 0}, {1960, 930, 350});
  const Handle mattress = site.box(ObjectKind::bedding, {100, 100, 350}, {1940, 910, 520});
  const Handle pillow = site.box(ObjectKind::bedding, {130, 220, 520}, {480, 790, 620});
  site.builder->rest(base, room.deck);
  site.builder->rest(mattress, base);
  site.builder->rest(pillow, mattress);
}

void build_desk(const ShipRoom& room, const Walls& walls) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle top = site.box(ObjectKind::furniture, {100, 2650, 720}, {900, 3250, 750});
  builder.fit(top, walls.high_side);
  for (const double a : {100.0, 870.0}) {
    const Handle side = site.box(ObjectKind::furniture, {a, 2680, 0}, {a + 30, 3220, 720});
    builder.rest(side, room.deck);
    builder.fit(side, top);
  }
  const std::array<Vec3d, 6> lamp{
      {{70, 0, 0}, {70, 20, 0}, {15, 20, 0}, {15, 250, 0}, {90, 270, 0}, {50, 400, 0}}};
  const Handle light = site.turned(ObjectKind::lamp, lamp, at({250, 3050, 750}));
  builder.rest(light, top);
  const Handle book = site.box(ObjectKind::furniture, {480, 2800, 750}, {780, 3000, 790});
  builder.rest(book, top);
}

void build_washroom(const ShipRoom& room, const Walls& walls) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const std::array<Vec3d, 5> basin{
      {{90, 0, 0}, {70, 600, 0}, {190, 700, 0}, {200, 820, 0}, {200, 850, 0}}};
  const std::array<Vec3d, 4> bowl{{{110, 0, 0}, {110, 120, 0}, {190, 330, 0}, {190, 400, 0}}};
  builder.rest(site.turned(ObjectKind::sanitary, basin, at({1750, 1300, 0})), room.deck);
  builder.rest(site.turned(ObjectKind::sanitary, bowl, at({1750, 1850, 0})), room.deck);
  builder.fit(site.box(ObjectKind::window, {2008, 1100, 1200}, {2020, 1500, 1800}), walls.inner);
}

void build_rack(ShipRoom& room, double b, double a_end) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const double a0 = 50;
  std::array<Handle, 4> posts{};
  for (std::size_t p = 0; p < 4; ++p) {
    const double a = p % 2 == 0 ? a0 : a_end - 60, v = p / 2 == 0 ? b : b + 740;
    posts[p] = site.box(ObjectKind::rack_post, {a, v, 0}, {a + 60, v + 60, 1950});
    builder.rest(posts[p], room.deck);
  }
  for (int s = 0; s < 3; ++s) {
    const double h = 250 + 560.0 * s;
    const Handle shelf =
        site.box(ObjectKind::rack_shelf, {a0 + 60, b, h}, {a_end - 60, b + 800, h + 30});
    for (const Handle post : posts) builder.bolt(shelf, post);
    double a = a0 + 100;
    while (true) {
      const int width = room.random.between(4, 8) * 60;
      if (a + width > a_end - 100) break;
      const bool round = width < 420 && room.random.chance(25);
      const int depth = room.random.between(8, 14) * 50, height = room.random.between(2, 6) * 75;
      Handle thing = kNothing;
      if (round) {
        const double r = width / 2.0;
        const std::array<Vec3d, 8> profile{{{r - 6, 0, 0},
                                            {r, 10, 0},
                                            {r, 130, 0},
                                            {r - 8, 150, 0},
                                            {r, 170, 0},
                                            {r, 330, 0},
                                            {r - 6, 340, 0},
                                            {r - 30, 340, 0}}};
        thing = site.turned(ObjectKind::drum, profile, at({a + r, b + 400, h + 30}));
      } else {
        thing = site.box(ObjectKind::crate, {a, b + 50, h + 30},
                         {a + width, b + 50.0 + depth, h + 30 + height});
      }
      builder.rest(thing, shelf);
      if (room.random.chance(2)) builder.turn_inside_out(thing);
      a += width + room.random.between(3, 9) * 10;
    }
  }
}

}  // namespace

void build_cabin(ShipRoom& room) {
  const Walls walls = build_walls(room);
  const Site& site = room.site;
  build_bed(room);
  build_desk(room, walls);
  build_chair(room, 350, 2100);
  const Handle wardrobe = site.box(ObjectKind::furniture, {1000, 2690, 0}, {1600, 3250, 1900});
  site.builder->rest(wardrobe, room.deck);
  site.builder->fit(wardrobe, walls.high_side);
  build_washroom(room, walls);
  site.builder->rest(site.box(ObjectKind::furniture, {900, 1200, 0}, {1450, 2400, 10}), room.deck);
}

void build_store(ShipRoom& room) {
  build_rack(room, 0, 2750);
  build_rack(room, 1200, 2750);
  build_rack(room, 2450, 2050);
}

void build_control_room(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle plinth = site.box(ObjectKind::foundation, {100, 0, 0}, {2350, 600, 100});
  builder.weld(plinth, room.deck);
  Handle before = kNothing;
  for (int i = 0; i < 5; ++i) {
    const Handle board =
        site.box(ObjectKind::cabinet, {100 + 450.0 * i, 0, 100}, {550 + 450.0 * i, 600, 1900});
    builder.rest(board, plinth);
    builder.bolt(board, before);
    before = board;
  }
  const std::array<Vec3d, 6> desk{{{1400, 0, 0},
                                   {2000, 0, 0},
                                   {2000, 720, 0},
                                   {1700, 800, 0},
                                   {1650, 1050, 0},
                                   {1400, 1050, 0}}};
  const Handle console =
      site.extruded(ObjectKind::console, desk, 1700, facing(FacingAxis::along, {200, 0, 0}));
  builder.rest(console, room.deck);
  for (int i = 0; i < 3; ++i) {
    const double a = 270 + 540.0 * i;
    const Handle stand =
        site.box(ObjectKind::console, {a + 160, 1450, 1050}, {a + 280, 1550, 1090});
    const Handle screen = site.box(ObjectKind::screen, {a, 1480, 1090}, {a + 440, 1520, 1380});
    builder.bolt(stand, console);
    builder.bolt(screen, stand);
  }
  for (const double a : {400.0, 1200.0}) build_chair(room, a, 2200);
  before = kNothing;
  for (int i = 0; i < 4; ++i) {
    const Handle board =
        site.box(ObjectKind::cabinet, {50 + 480.0 * i, 2850, 0}, {530 + 480.0 * i, 3250, 1600});
    builder.rest(board, room.deck);
    builder.bolt(board, before);
    before = board;
  }
}

void build_fan_room(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle base = site.box(ObjectKind::foundation, {100, 200, 0}, {1900, 1100, 100});
  builder.weld(base, room.deck);
  Handle before = kNothing;
  for (int i = 0; i < 3; ++i) {
    const double a = 100 + 600.0 * i;
    const Handle section = site.box(ObjectKind::fan, {a, 200, 100}, {a + 600, 1100, 1200});
    builder.rest(section, base);
    builder.bolt(section, before);
    before = section;
    const Handle riser = site.tube(ObjectKind::duct, {400, 500, 700}, 4, at({a + 100, 400, 1200}));
    builder.bolt(riser, section);
  }
  const std::array<Vec3d, 8> wheel{{{120, 0, 0},
                                    {300, 0, 0},
                                    {300, 60, 0},
                                    {260, 90, 0},
                                    {260, 300, 0},
                                    {300, 330, 0},
                                    {300, 390, 0},
                                    {120, 390, 0}}};
  for (int i = 0; i < 3; ++i) {
    const double a = 450 + 700.0 * i;
    const Handle foot = site.box(ObjectKind::foundation, {a - 150, 1500, 0}, {a + 150, 1890, 200});
    builder.weld(foot, room.deck);
    const Handle fan =
        site.turned(ObjectKind::fan, wheel, facing(FacingAxis::beside, {a, 1500, 500}));
    builder.rest(fan, foot);
    const Handle outlet = site.bar(ObjectKind::duct, 180, 400, at({a, 1545, 900}));
    const Handle flange = site.bar(ObjectKind::duct_flange, 230, 100, at({a, 1545, 800}));
    builder.bolt(flange, fan);
    builder.bolt(outlet, flange);
  }
}

void build_stairs(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle platform = site.box(ObjectKind::platform, {950, 100, 1170}, {2050, 2500, 1200});
  for (const double a : {960.0, 1960.0})
    for (const double b : {110.0, 2410.0}) {
      const Handle leg = site.box(ObjectKind::platform_leg, {a, b, 0}, {a + 80, b + 80, 1170});
      builder.weld(leg, room.deck);
      builder.weld(leg, platform);
    }
  const Handle rail = site.box(ObjectKind::railing, {2010, 110, 1960}, {2050, 2490, 2000});
  const Handle knee = site.box(ObjectKind::railing, {2000, 110, 1560}, {2010, 2490, 1610});
  for (int i = 0; i < 5; ++i) {
    const double b = 110 + 585.0 * i;
    const Handle post = site.box(ObjectKind::railing, {2010, b, 1200}, {2050, b + 40, 1960});
    builder.weld(post, platform);
    builder.weld(post, rail);
    builder.weld(post, knee);
  }
  // Stringers of slope 3:2; treads fill the space between them.
  const std::array<Vec3d, 4> stringer{{{100, 0, 0}, {300, 0, 0}, {920, 930, 0}, {920, 1230, 0}}};
  std::array<Handle, 2> sides{};
  for (std::size_t s = 0; s < 2; ++s) {
    AxisFrame frame;
    frame.m = {1, 0, 0, 0, 0, -1, 0, 1, 0};  // profile (a, h), thickness back along b
    frame.t = grid({0, s == 0 ? 540.0 : 1200.0, 0});
    sides[s] = site.extruded(ObjectKind::stair, stringer, 40, frame);
    builder.weld(sides[s], room.deck);
  }
  for (int i = 1; i <= 4; ++i) {
    const double h = 220.0 * i, a = 130 + h * 2 / 3;
    const Handle tread = site.box(ObjectKind::stair, {a, 540, h}, {a + 180, 1160, h + 30});
    for (const Handle side : sides) builder.weld(tread, side);
  }
  const std::array<Vec3d, 4> barrel{{{250, 0, 0}, {280, 300, 0}, {280, 500, 0}, {250, 800, 0}}};
  builder.rest(site.turned(ObjectKind::drum, barrel, at({1450, 1500, 0})), room.deck);
  builder.rest(site.turned(ObjectKind::drum, barrel, at({1450, 600, 0})), room.deck);
}

}  // namespace strake::generate
