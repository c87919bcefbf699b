// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "generate/plan.hpp"

namespace strake::generate {
namespace {

using geometry::Vec3d;

constexpr double kFlange = 30;  ///< longer than the clearance, as everywhere in the ship

/// The two foundation girders and the rubber mounts; returns the mounts.
std::vector<Handle> build_genset_foundation(const Room& room) {
  const Site& site = room.site;
  const std::array<Vec3d, 12> profile{{{-60, 0, 0},
                                       {60, 0, 0},
                                       {60, 20, 0},
                                       {10, 20, 0},
                                       {10, 230, 0},
                                       {60, 230, 0},
                                       {60, 250, 0},
                                       {-60, 250, 0},
                                       {-60, 230, 0},
                                       {-10, 230, 0},
                                       {-10, 20, 0},
                                       {-60, 20, 0}}};
  const std::array<Vec3d, 5> rubber{
      {{50, 0, 0}, {50, 15, 0}, {35, 40, 0}, {50, 65, 0}, {50, 80, 0}}};
  std::vector<Handle> mounts;
  for (const double b : {960.0, 2240.0}) {
    const Handle girder =
        site.extruded(Kind::foundation, profile, 2600, facing(Axis::along, {100, b, 0}));
    site.yard->weld(girder, room.deck);
    for (const double a : {300.0, 1000.0, 1700.0, 2400.0}) {
      const Handle mount = site.turned(Kind::mount, rubber, at({a, b, 250}));
      site.yard->rest(mount, girder);
      mounts.push_back(mount);
    }
  }
  return mounts;
}

void build_exhaust(const Room& room, std::span<const Handle> heads, Handle bedplate) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const Handle manifold =
      site.bar(Kind::manifold, 90, 1360, facing(Axis::along, {340, 1150, 1350}));
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const double a = 400 + 220.0 * static_cast<double>(i);
    const Handle branch = site.box(Kind::manifold, {a, 1240, 1320}, {a + 60, 1350, 1380});
    yard.bolt(branch, heads[i]);
    yard.bolt(branch, manifold);
  }
  const std::array<Vec3d, 6> turbo{
      {{100, 0, 0}, {140, 40, 0}, {140, 120, 0}, {80, 150, 0}, {120, 180, 0}, {120, 260, 0}}};
  const Handle charger =
      site.turned(Kind::turbocharger, turbo, facing(Axis::along, {1740, 1150, 1350}));
  const Handle neck = site.bar(Kind::manifold, 90, 40, facing(Axis::along, {1700, 1150, 1350}));
  yard.bolt(neck, manifold);
  yard.bolt(neck, charger);
  const Handle pedestal = site.box(Kind::machine_part, {1785, 1100, 450}, {1855, 1200, 1210});
  yard.bolt(pedestal, charger);
  yard.bolt(pedestal, bedplate);
}

/// Crankcase, heads and what stands on them; returns the crankcase.
Handle build_engine(const Room& room, Handle bedplate) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const std::array<Vec3d, 6> profile{{{1150, 450, 0},
                                      {2050, 450, 0},
                                      {2050, 800, 0},
                                      {1900, 1150, 0},
                                      {1300, 1150, 0},
                                      {1150, 800, 0}}};
  const Handle crankcase =
      site.extruded(Kind::engine, profile, 1400, facing(Axis::along, {300, 0, 0}));
  yard.bolt(crankcase, bedplate);
  std::vector<Handle> heads;
  for (int i = 0; i < 6; ++i) {
    const double a = 340 + 220.0 * i;
    const Handle head = site.box(Kind::cylinder_head, {a, 1350, 1150}, {a + 180, 1850, 1420});
    yard.bolt(head, crankcase);
    heads.push_back(head);
    const Handle cover = site.box(Kind::valve_cover, {a + 30, 1450, 1420}, {a + 150, 1750, 1500});
    yard.bolt(cover, head);
    const Handle door =
        site.bar(Kind::machine_part, 70, 30, facing(Axis::beside, {a + 90, 2050, 620}));
    yard.bolt(door, crankcase);
  }
  build_exhaust(room, heads, bedplate);
  return crankcase;
}

void build_alternator(const Room& room, Handle bedplate, Handle crankcase) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const std::array<Vec3d, 8> profile{{{180, 0, 0},
                                      {180, 50, 0},
                                      {330, 50, 0},
                                      {380, 100, 0},
                                      {380, 550, 0},
                                      {330, 600, 0},
                                      {200, 600, 0},
                                      {200, 650, 0}}};
  const Handle machine =
      site.turned(Kind::alternator, profile, facing(Axis::along, {1900, 1600, 830}), 48);
  yard.bolt(machine, bedplate);
  const Handle coupling =
      site.bar(Kind::coupling, 150, 200, facing(Axis::along, {1700, 1600, 830}));
  yard.bolt(coupling, crankcase);
  yard.bolt(coupling, machine);
  const Handle box = site.box(Kind::machine_part, {2100, 1450, 1210}, {2400, 1750, 1400});
  yard.bolt(box, machine);
}

void build_pump(const Room& room, double b) {
  const Site site = room.site.moved({0, b, 0});
  Yard& yard = *site.yard;
  const Handle base = site.box(Kind::foundation, {420, -260, 0}, {1880, 260, 180});
  yard.weld(base, room.deck);
  const Handle plate = site.box(Kind::bedplate, {450, -230, 180}, {1850, 230, 220});
  yard.bolt(plate, base);
  const std::array<Vec3d, 6> casing{
      {{110, 0, 0}, {110, 60, 0}, {170, 120, 0}, {170, 260, 0}, {110, 310, 0}, {110, 350, 0}}};
  const Handle pump = site.turned(Kind::pump, casing, facing(Axis::along, {500, 0, 390}));
  yard.bolt(pump, plate);
  const Handle coupling = site.bar(Kind::coupling, 60, 250, facing(Axis::along, {850, 0, 390}));
  yard.bolt(coupling, pump);
  const std::array<Vec3d, 6> frame{
      {{90, 0, 0}, {170, 40, 0}, {170, 440, 0}, {150, 460, 0}, {150, 580, 0}, {130, 600, 0}}};
  const Handle motor = site.turned(Kind::motor, frame, facing(Axis::along, {1100, 0, 390}));
  yard.bolt(motor, plate);
  yard.bolt(coupling, motor);
  const Handle terminals = site.box(Kind::machine_part, {1250, -70, 560}, {1430, 70, 660});
  yard.bolt(terminals, motor);

  const PipeSize size{57, 95};
  const Handle outlet = site.bar(Kind::flange, size.flange, kFlange, at({690, 0, 560}));
  yard.bolt(outlet, pump);
  const Handle valve =
      build_valve(site, size, 260, {{0, 0, -1, 0, 1, 0, 1, 0, 0}, grid({690, 0, 590})});
  yard.bolt(valve, outlet);
  const Handle upper = site.bar(Kind::flange, size.flange, kFlange, at({690, 0, 850}));
  yard.bolt(upper, valve);
  const std::array<Vec3d, 3> up{{{690, 0, 880}, {690, 0, 1700}, {1900, 0, 1700}}};
  const Handle discharge = site.swept(Kind::spool, up, size.r, 171);
  yard.weld(discharge, upper);
  site.centre_line(up);
  const Handle inlet =
      site.bar(Kind::flange, size.flange, kFlange, facing(Axis::along, {470, 0, 390}));
  yard.bolt(inlet, pump);
  const std::array<Vec3d, 3> down{{{470, 0, 390}, {180, 0, 390}, {180, 0, 0}}};
  const Handle suction = site.swept(Kind::spool, down, size.r, 171);
  yard.weld(suction, inlet);
  yard.weld(suction, room.deck);
  site.centre_line(down);
}

}  // namespace

void build_genset(Room& room) {
  const Site& site = room.site;
  const std::vector<Handle> mounts = build_genset_foundation(room);
  const Handle bedplate = site.box(Kind::bedplate, {200, 850, 330}, {2600, 2350, 450});
  for (const Handle mount : mounts) site.yard->bolt(mount, bedplate);
  const Handle crankcase = build_engine(room, bedplate);
  build_alternator(room, bedplate, crankcase);
  const Handle panel = site.box(Kind::cabinet, {200, 2850, 0}, {800, 3200, 1700});
  site.yard->rest(panel, room.deck);
  const std::array<Vec3d, 6> bottle{
      {{120, 0, 0}, {120, 900, 0}, {105, 980, 0}, {60, 1040, 0}, {40, 1060, 0}, {40, 1120, 0}}};
  for (int i = 0; i < 3; ++i) {
    const Handle flask = site.turned(Kind::tank, bottle, at({300 + 320.0 * i, 350, 0}));
    site.yard->rest(flask, room.deck);
    if (room.random.chance(25)) site.yard->turn_inside_out(flask);
  }
}

void build_pumps(Room& room) {
  for (const double b : {400.0, 1400.0, 2400.0}) build_pump(room, b);
}

void build_tank(Room& room) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  // Dished heads: heights of a 2:1 ellipse at 15° steps of its parameter.
  std::vector<Vec3d> profile;
  for (int step = 0; step < 6; ++step) {
    const Vec3d c = unit_15deg(step);
    profile.push_back({700 * c.y, 350 - 350 * c.x, 0});
  }
  for (int step = 6; step >= 0; --step) {
    const Vec3d c = unit_15deg(step);
    profile.push_back({700 * c.y, 1950 + 350 * c.x, 0});
  }
  profile.insert(profile.begin() + 6, Vec3d{700, 350, 0});
  const Handle tank = site.turned(Kind::tank, profile, facing(Axis::along, {200, 1650, 900}), 48);
  for (const double a : {650.0, 1850.0}) {
    const Handle saddle = site.box(Kind::saddle, {a, 1150, 0}, {a + 200, 2150, 200});
    yard.weld(saddle, room.deck);
    yard.rest(tank, saddle);
  }
  const std::array<Vec3d, 4> neck{{{80, 0, 0}, {80, 120, 0}, {130, 120, 0}, {130, 150, 0}}};
  for (const double a : {700.0, 1300.0, 1900.0}) {
    const Handle nozzle = site.turned(Kind::nozzle, neck, at({a, 1650, 1600}));
    yard.weld(nozzle, tank);
  }
  if (room.random.chance(75)) {
    // Solid through and through: the part reaches the axis, so the depth is the tank's radius.
    const std::array<Vec3d, 5> stirrer{
        {{40, 0, 0}, {90, 60, 0}, {90, 180, 0}, {40, 240, 0}, {40, 300, 0}}};
    const Handle inner =
        site.turned(Kind::tank_internal, stirrer, facing(Axis::along, {1300, 1650, 900}));
    yard.declare({inner, tank, clash::Class::hit, Why::buried, -700});
  }
  if (room.random.chance(30)) yard.turn_inside_out(tank);
  const std::array<Vec3d, 4> filter{{{140, 0, 0}, {140, 700, 0}, {80, 780, 0}, {80, 900, 0}}};
  for (int i = 0; i < 3; ++i) {
    const Handle unit = site.turned(Kind::machine_part, filter, at({400 + 500.0 * i, 400, 0}));
    yard.rest(unit, room.deck);
  }
}

void build_pipe_chest(Room& room) {
  const Site& site = room.site;
  Yard& yard = *site.yard;
  const Handle header = site.bar(Kind::pipe, 84, 2500, facing(Axis::along, {150, 700, 500}));
  for (const double a : {330.0, 1210.0, 2380.0}) {
    const Handle stool = site.box(Kind::support, {a, 640, 0}, {a + 60, 760, 416});
    yard.weld(stool, room.deck);
    yard.rest(header, stool);
  }
  const PipeSize size{45, 80};
  const std::array<Vec3d, 3> weldolet{{{60, 0, 0}, {45, 40, 0}, {45, 116, 0}}};
  for (int i = 0; i < 5; ++i) {
    const double a = 500 + 430.0 * i;
    const double far = 1500 + 90.0 * (i % 3);
    const Handle stub = site.turned(Kind::spool, weldolet, at({a, 700, 584}));
    yard.weld(stub, header);
    const Handle low = site.bar(Kind::flange, size.flange, kFlange, at({a, 700, 700}));
    yard.weld(low, stub);
    const Handle valve = build_valve(site, size, 280, facing(Axis::beside, {a, 700, 730}));
    yard.bolt(valve, low);
    const Handle high = site.bar(Kind::flange, size.flange, kFlange, at({a, 700, 1010}));
    yard.bolt(high, valve);
    const std::array<Vec3d, 4> path{{{a, 700, 1040}, {a, 700, 1800}, {a, far, 1800}, {a, far, 0}}};
    const Handle riser = site.swept(Kind::spool, path, size.r, 135);
    yard.weld(riser, high);
    yard.weld(riser, room.deck);
    site.centre_line(path);
  }
}

}  // namespace strake::generate
