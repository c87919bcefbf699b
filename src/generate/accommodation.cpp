// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "generate/plan.hpp"

namespace strake::generate {
namespace {

using geometry::Vec3d;

struct Walls {
  Handle low_side, high_side, outer, inner;
};

/// A wall across the room in (b, h) with an opening, 50 mm thick along a.
Handle wall_with_opening(const Site& site, double a, const Outline& opening) {
  const std::uint32_t shape = site.yard->shape(
      {3001, opening[0].u, opening[0].v, opening[1].u, opening[2].v,
       static_cast<std::int64_t>(opening.size())},
      [&] {
        const Outline plate{{um(50), 0}, {um(3250), 0}, {um(3250), um(2000)}, {um(50), um(2000)}};
        const std::array<Outline, 1> holes{opening};
        return extrude(plate, holes, um(50));
      });
  return site.yard->add(Kind::wall, site.cell, shape, site.frame * facing(Axis::along, {a, 0, 0}));
}

Walls build_walls(const Room& room) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
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
  walls.low_side = site.box(Kind::wall, {0, 0, 0}, {2070, 50, 2000});
  walls.high_side = site.box(Kind::wall, {0, 3250, 0}, {2070, 3300, 2000});
  walls.outer = wall_with_opening(site, 0, outline(light));
  walls.inner = wall_with_opening(site, 2020, outline(way));
  for (const Handle wall : {walls.low_side, walls.high_side, walls.outer, walls.inner})
    yard.rest(wall, room.deck);
  for (const Handle across : {walls.outer, walls.inner}) {
    yard.fit(across, walls.low_side);
    yard.fit(across, walls.high_side);
  }
  const Handle pane = site.box(Kind::window, {50, 1160, 860}, {60, 2240, 1640});
  yard.fit(pane, walls.outer);
  const Handle leaf = site.box(Kind::door, {1980, 2270, 30}, {2020, 3030, 1960});
  yard.fit(leaf, walls.inner);
  return walls;
}

GridMesh chair_mesh() {
  GridMesh mesh = make_box(grid({400, 400, 40}));
  for (geometry::Vec3l& v : mesh.vertices) v.z += um(440);
  for (const double a : {10.0, 350.0})
    for (const double b : {10.0, 350.0})
      append(mesh, make_box(grid({40, 40, 440})), grid({a, b, 0}));
  append(mesh, make_box(grid({360, 30, 450})), grid({20, 10, 480}));
  return mesh;
}

void build_chair(const Room& room, double a, double b) {
  const Site& site = room.site;
  const std::uint32_t shape = site.yard->shape({3002}, chair_mesh);
  const Handle chair =
      site.yard->add(Kind::furniture, site.cell, shape, site.frame * at({a, b, 0}));
  site.yard->rest(chair, room.deck);
}

void build_bed(const Room& room) {
  const Site& site = room.site;
  const Handle base = site.box(Kind::furniture, {80, 80, 0}, {1960, 930, 350});
  const Handle mattress = site.box(Kind::bedding, {100, 100, 350}, {1940, 910, 520});
  const Handle pillow = site.box(Kind::bedding, {130, 220, 520}, {480, 790, 620});
  site.yard->rest(base, room.deck);
  site.yard->rest(mattress, base);
  site.yard->rest(pillow, mattress);
}

void build_desk(const Room& room, const Walls& walls) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const Handle top = site.box(Kind::furniture, {100, 2650, 720}, {900, 3250, 750});
  yard.fit(top, walls.high_side);
  for (const double a : {100.0, 870.0}) {
    const Handle side = site.box(Kind::furniture, {a, 2680, 0}, {a + 30, 3220, 720});
    yard.rest(side, room.deck);
    yard.fit(side, top);
  }
  const std::array<Vec3d, 6> lamp{
      {{70, 0, 0}, {70, 20, 0}, {15, 20, 0}, {15, 250, 0}, {90, 270, 0}, {50, 400, 0}}};
  const Handle light = site.turned(Kind::lamp, lamp, at({250, 3050, 750}));
  yard.rest(light, top);
  const Handle book = site.box(Kind::furniture, {480, 2800, 750}, {780, 3000, 790});
  yard.rest(book, top);
}

void build_washroom(const Room& room, const Walls& walls) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const std::array<Vec3d, 5> basin{
      {{90, 0, 0}, {70, 600, 0}, {190, 700, 0}, {200, 820, 0}, {200, 850, 0}}};
  const std::array<Vec3d, 4> bowl{{{110, 0, 0}, {110, 120, 0}, {190, 330, 0}, {190, 400, 0}}};
  yard.rest(site.turned(Kind::sanitary, basin, at({1750, 1300, 0})), room.deck);
  yard.rest(site.turned(Kind::sanitary, bowl, at({1750, 1850, 0})), room.deck);
  yard.fit(site.box(Kind::window, {2008, 1100, 1200}, {2020, 1500, 1800}), walls.inner);
}

void build_rack(Room& room, double b, double a_end) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const double a0 = 50;
  std::array<Handle, 4> posts{};
  for (std::size_t p = 0; p < 4; ++p) {
    const double a = p % 2 == 0 ? a0 : a_end - 60, v = p / 2 == 0 ? b : b + 740;
    posts[p] = site.box(Kind::rack_post, {a, v, 0}, {a + 60, v + 60, 1950});
    yard.rest(posts[p], room.deck);
  }
  for (int s = 0; s < 3; ++s) {
    const double h = 250 + 560.0 * s;
    const Handle shelf = site.box(Kind::rack_shelf, {a0 + 60, b, h}, {a_end - 60, b + 800, h + 30});
    for (const Handle post : posts) yard.bolt(shelf, post);
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
        thing = site.turned(Kind::drum, profile, at({a + r, b + 400, h + 30}));
      } else {
        thing = site.box(Kind::crate, {a, b + 50, h + 30},
                         {a + width, b + 50.0 + depth, h + 30 + height});
      }
      yard.rest(thing, shelf);
      if (room.random.chance(2)) yard.turn_inside_out(thing);
      a += width + room.random.between(3, 9) * 10;
    }
  }
}

}  // namespace

void build_cabin(Room& room) {
  const Walls walls = build_walls(room);
  const Site& site = room.site;
  build_bed(room);
  build_desk(room, walls);
  build_chair(room, 350, 2100);
  const Handle wardrobe = site.box(Kind::furniture, {1000, 2690, 0}, {1600, 3250, 1900});
  site.yard->rest(wardrobe, room.deck);
  site.yard->fit(wardrobe, walls.high_side);
  build_washroom(room, walls);
  site.yard->rest(site.box(Kind::furniture, {900, 1200, 0}, {1450, 2400, 10}), room.deck);
}

void build_store(Room& room) {
  build_rack(room, 0, 2750);
  build_rack(room, 1200, 2750);
  build_rack(room, 2450, 2050);
}

void build_control_room(Room& room) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const Handle plinth = site.box(Kind::foundation, {100, 0, 0}, {2350, 600, 100});
  yard.weld(plinth, room.deck);
  Handle before = kNothing;
  for (int i = 0; i < 5; ++i) {
    const Handle board =
        site.box(Kind::cabinet, {100 + 450.0 * i, 0, 100}, {550 + 450.0 * i, 600, 1900});
    yard.rest(board, plinth);
    yard.bolt(board, before);
    before = board;
  }
  const std::array<Vec3d, 6> desk{{{1400, 0, 0},
                                   {2000, 0, 0},
                                   {2000, 720, 0},
                                   {1700, 800, 0},
                                   {1650, 1050, 0},
                                   {1400, 1050, 0}}};
  const Handle console = site.extruded(Kind::console, desk, 1700, facing(Axis::along, {200, 0, 0}));
  yard.rest(console, room.deck);
  for (int i = 0; i < 3; ++i) {
    const double a = 270 + 540.0 * i;
    const Handle stand = site.box(Kind::console, {a + 160, 1450, 1050}, {a + 280, 1550, 1090});
    const Handle screen = site.box(Kind::screen, {a, 1480, 1090}, {a + 440, 1520, 1380});
    yard.bolt(stand, console);
    yard.bolt(screen, stand);
  }
  for (const double a : {400.0, 1200.0}) build_chair(room, a, 2200);
  before = kNothing;
  for (int i = 0; i < 4; ++i) {
    const Handle board =
        site.box(Kind::cabinet, {50 + 480.0 * i, 2850, 0}, {530 + 480.0 * i, 3250, 1600});
    yard.rest(board, room.deck);
    yard.bolt(board, before);
    before = board;
  }
}

void build_fan_room(Room& room) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const Handle base = site.box(Kind::foundation, {100, 200, 0}, {1900, 1100, 100});
  yard.weld(base, room.deck);
  Handle before = kNothing;
  for (int i = 0; i < 3; ++i) {
    const double a = 100 + 600.0 * i;
    const Handle section = site.box(Kind::fan, {a, 200, 100}, {a + 600, 1100, 1200});
    yard.rest(section, base);
    yard.bolt(section, before);
    before = section;
    const Handle riser = site.tube(Kind::duct, {400, 500, 700}, 4, at({a + 100, 400, 1200}));
    yard.bolt(riser, section);
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
    const Handle foot = site.box(Kind::foundation, {a - 150, 1500, 0}, {a + 150, 1890, 200});
    yard.weld(foot, room.deck);
    const Handle fan = site.turned(Kind::fan, wheel, facing(Axis::beside, {a, 1500, 500}));
    yard.rest(fan, foot);
    const Handle outlet = site.bar(Kind::duct, 180, 400, at({a, 1545, 900}));
    const Handle flange = site.bar(Kind::duct_flange, 230, 100, at({a, 1545, 800}));
    yard.bolt(flange, fan);
    yard.bolt(outlet, flange);
  }
}

void build_stairs(Room& room) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const Handle platform = site.box(Kind::platform, {950, 100, 1170}, {2050, 2500, 1200});
  for (const double a : {960.0, 1960.0})
    for (const double b : {110.0, 2410.0}) {
      const Handle leg = site.box(Kind::platform_leg, {a, b, 0}, {a + 80, b + 80, 1170});
      yard.weld(leg, room.deck);
      yard.weld(leg, platform);
    }
  const Handle rail = site.box(Kind::railing, {2010, 110, 1960}, {2050, 2490, 2000});
  const Handle knee = site.box(Kind::railing, {2000, 110, 1560}, {2010, 2490, 1610});
  for (int i = 0; i < 5; ++i) {
    const double b = 110 + 585.0 * i;
    const Handle post = site.box(Kind::railing, {2010, b, 1200}, {2050, b + 40, 1960});
    yard.weld(post, platform);
    yard.weld(post, rail);
    yard.weld(post, knee);
  }
  // Stringers of slope 3:2; treads fill the space between them.
  const std::array<Vec3d, 4> stringer{{{100, 0, 0}, {300, 0, 0}, {920, 930, 0}, {920, 1230, 0}}};
  std::array<Handle, 2> sides{};
  for (std::size_t s = 0; s < 2; ++s) {
    Frame frame;
    frame.m = {1, 0, 0, 0, 0, -1, 0, 1, 0};  // profile (a, h), thickness back along b
    frame.t = grid({0, s == 0 ? 540.0 : 1200.0, 0});
    sides[s] = site.extruded(Kind::stair, stringer, 40, frame);
    yard.weld(sides[s], room.deck);
  }
  for (int i = 1; i <= 4; ++i) {
    const double h = 220.0 * i, a = 130 + h * 2 / 3;
    const Handle tread = site.box(Kind::stair, {a, 540, h}, {a + 180, 1160, h + 30});
    for (const Handle side : sides) yard.weld(tread, side);
  }
  const std::array<Vec3d, 4> barrel{{{250, 0, 0}, {280, 300, 0}, {280, 500, 0}, {250, 800, 0}}};
  yard.rest(site.turned(Kind::drum, barrel, at({1450, 1500, 0})), room.deck);
  yard.rest(site.turned(Kind::drum, barrel, at({1450, 600, 0})), room.deck);
}

}  // namespace strake::generate
