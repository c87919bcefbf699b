// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using geometry::Vec3d;

constexpr double kFlange = 30;  ///< longer than the clearance, as everywhere in the ship

/// The two foundation girders and the rubber mounts; returns the mounts.
std::vector<Handle> build_genset_foundation(const ShipRoom& room) {
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
    const Handle girder = site.extruded(ObjectKind::foundation, profile, 2600,
                                        facing(FacingAxis::along, {100, b, 0}));
    site.builder->weld(girder, room.deck);
    for (const double a : {300.0, 1000.0, 1700.0, 2400.0}) {
      const Handle mount = site.turned(ObjectKind::mount, rubber, at({a, b, 250}));
      site.builder->rest(mount, girder);
      mounts.push_back(mount);
    }
  }
  return mounts;
}

void build_exhaust(const ShipRoom& room, std::span<const Handle> heads, Handle bedplate) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle manifold =
      site.bar(ObjectKind::manifold, 90, 1360, facing(FacingAxis::along, {340, 1150, 1350}));
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const double a = 400 + 220.0 * static_cast<double>(i);
    const Handle branch = site.box(ObjectKind::manifold, {a, 1240, 1320}, {a + 60, 1350, 1380});
    builder.bolt(branch, heads[i]);
    builder.bolt(branch, manifold);
  }
  const std::array<Vec3d, 6> turbo{
      {{100, 0, 0}, {140, 40, 0}, {140, 120, 0}, {80, 150, 0}, {120, 180, 0}, {120, 260, 0}}};
  const Handle charger =
      site.turned(ObjectKind::turbocharger, turbo, facing(FacingAxis::along, {1740, 1150, 1350}));
  const Handle neck =
      site.bar(ObjectKind::manifold, 90, 40, facing(FacingAxis::along, {1700, 1150, 1350}));
  builder.bolt(neck, manifold);
  builder.bolt(neck, charger);
  const Handle pedestal = site.box(ObjectKind::machine_part, {1785, 1100, 450}, {1855, 1200, 1210});
  builder.bolt(pedestal, charger);
  builder.bolt(pedestal, bedplate);
}

/// Crankcase, heads and what stands on them; returns the crankcase.
Handle build_engine(const ShipRoom& room, Handle bedplate) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const std::array<Vec3d, 6> profile{{{1150, 450, 0},
                                      {2050, 450, 0},
                                      {2050, 800, 0},
                                      {1900, 1150, 0},
                                      {1300, 1150, 0},
                                      {1150, 800, 0}}};
  const Handle crankcase =
      site.extruded(ObjectKind::engine, profile, 1400, facing(FacingAxis::along, {300, 0, 0}));
  builder.bolt(crankcase, bedplate);
  std::vector<Handle> heads;
  for (int i = 0; i < 6; ++i) {
    const double a = 340 + 220.0 * i;
    const Handle head = site.box(ObjectKind::cylinder_head, {a, 1350, 1150}, {a + 180, 1850, 1420});
    builder.bolt(head, crankcase);
    heads.push_back(head);
    const Handle cover =
        site.box(ObjectKind::valve_cover, {a + 30, 1450, 1420}, {a + 150, 1750, 1500});
    builder.bolt(cover, head);
    const Handle door =
        site.bar(ObjectKind::machine_part, 70, 30, facing(FacingAxis::beside, {a + 90, 2050, 620}));
    builder.bolt(door, crankcase);
  }
  build_exhaust(room, heads, bedplate);
  return crankcase;
}

void build_alternator(const ShipRoom& room, Handle bedplate, Handle crankcase) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const std::array<Vec3d, 8> profile{{{180, 0, 0},
                                      {180, 50, 0},
                                      {330, 50, 0},
                                      {380, 100, 0},
                                      {380, 550, 0},
                                      {330, 600, 0},
                                      {200, 600, 0},
                                      {200, 650, 0}}};
  const Handle machine = site.turned(ObjectKind::alternator, profile,
                                     facing(FacingAxis::along, {1900, 1600, 830}), 48);
  builder.bolt(machine, bedplate);
  const Handle coupling =
      site.bar(ObjectKind::coupling, 150, 200, facing(FacingAxis::along, {1700, 1600, 830}));
  builder.bolt(coupling, crankcase);
  builder.bolt(coupling, machine);
  const Handle box = site.box(ObjectKind::machine_part, {2100, 1450, 1210}, {2400, 1750, 1400});
  builder.bolt(box, machine);
}

void build_pump(const ShipRoom& room, double b) {
  const Site site = room.site.moved({0, b, 0});
  ShipBuilder& builder = *site.builder;
  const Handle base = site.box(ObjectKind::foundation, {420, -260, 0}, {1880, 260, 180});
  builder.weld(base, room.deck);
  const Handle plate = site.box(ObjectKind::bedplate, {450, -230, 180}, {1850, 230, 220});
  builder.bolt(plate, base);
  const std::array<Vec3d, 6> casing{
      {{110, 0, 0}, {110, 60, 0}, {170, 120, 0}, {170, 260, 0}, {110, 310, 0}, {110, 350, 0}}};
  const Handle pump =
      site.turned(ObjectKind::pump, casing, facing(FacingAxis::along, {500, 0, 390}));
  builder.bolt(pump, plate);
  const Handle coupling =
      site.bar(ObjectKind::coupling, 60, 250, facing(FacingAxis::along, {850, 0, 390}));
  builder.bolt(coupling, pump);
  const std::array<Vec3d, 6> frame{
      {{90, 0, 0}, {170, 40, 0}, {170, 440, 0}, {150, 460, 0}, {150, 580, 0}, {130, 600, 0}}};
  const Handle motor =
      site.turned(ObjectKind::motor, frame, facing(FacingAxis::along, {1100, 0, 390}));
  builder.bolt(motor, plate);
  builder.bolt(coupling, motor);
  const Handle terminals = site.box(ObjectKind::machine_part, {1250, -70, 560}, {1430, 70, 660});
  builder.bolt(terminals, motor);

  const PipeSize size{57, 95};
  const Handle outlet = site.bar(ObjectKind::flange, size.flange, kFlange, at({690, 0, 560}));
  builder.bolt(outlet, pump);
  const Handle valve =
      build_valve(site, size, 260, {{0, 0, -1, 0, 1, 0, 1, 0, 0}, grid({690, 0, 590})});
  builder.bolt(valve, outlet);
  const Handle upper = site.bar(ObjectKind::flange, size.flange, kFlange, at({690, 0, 850}));
  builder.bolt(upper, valve);
  const std::array<Vec3d, 3> up{{{690, 0, 880}, {690, 0, 1700}, {1900, 0, 1700}}};
  const Handle discharge = site.swept(ObjectKind::spool, up, size.r, 171);
  builder.weld(discharge, upper);
  site.centre_line(up);
  const Handle inlet =
      site.bar(ObjectKind::flange, size.flange, kFlange, facing(FacingAxis::along, {470, 0, 390}));
  builder.bolt(inlet, pump);
  const std::array<Vec3d, 3> down{{{470, 0, 390}, {180, 0, 390}, {180, 0, 0}}};
  const Handle suction = site.swept(ObjectKind::spool, down, size.r, 171);
  builder.weld(suction, inlet);
  builder.weld(suction, room.deck);
  site.centre_line(down);
}

}  // namespace

void build_genset(ShipRoom& room) {
  const Site& site = room.site;
  const std::vector<Handle> mounts = build_genset_foundation(room);
  const Handle bedplate = site.box(ObjectKind::bedplate, {200, 850, 330}, {2600, 2350, 450});
  for (const Handle mount : mounts) site.builder->bolt(mount, bedplate);
  const Handle crankcase = build_engine(room, bedplate);
  build_alternator(room, bedplate, crankcase);
  const Handle panel = site.box(ObjectKind::cabinet, {200, 2850, 0}, {800, 3200, 1700});
  site.builder->rest(panel, room.deck);
  const std::array<Vec3d, 6> bottle{
      {{120, 0, 0}, {120, 900, 0}, {105, 980, 0}, {60, 1040, 0}, {40, 1060, 0}, {40, 1120, 0}}};
  for (int i = 0; i < 3; ++i) {
    const Handle flask = site.turned(ObjectKind::tank, bottle, at({300 + 320.0 * i, 350, 0}));
    site.builder->rest(flask, room.deck);
    if (room.random.chance(25)) site.builder->turn_inside_out(flask);
  }
}

void build_pumps(ShipRoom& room) {
  for (const double b : {400.0, 1400.0, 2400.0}) build_pump(room, b);
}

void build_tank(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
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
  const Handle tank =
      site.turned(ObjectKind::tank, profile, facing(FacingAxis::along, {200, 1650, 900}), 48);
  for (const double a : {650.0, 1850.0}) {
    const Handle saddle = site.box(ObjectKind::saddle, {a, 1150, 0}, {a + 200, 2150, 200});
    builder.weld(saddle, room.deck);
    builder.rest(tank, saddle);
  }
  const std::array<Vec3d, 4> neck{{{80, 0, 0}, {80, 120, 0}, {130, 120, 0}, {130, 150, 0}}};
  for (const double a : {700.0, 1300.0, 1900.0}) {
    const Handle nozzle = site.turned(ObjectKind::nozzle, neck, at({a, 1650, 1600}));
    builder.weld(nozzle, tank);
  }
  if (room.random.chance(75)) {
    // Solid through and through: the part reaches the axis, so the depth is the tank's radius.
    const std::array<Vec3d, 5> stirrer{
        {{40, 0, 0}, {90, 60, 0}, {90, 180, 0}, {40, 240, 0}, {40, 300, 0}}};
    const Handle inner = site.turned(ObjectKind::tank_internal, stirrer,
                                     facing(FacingAxis::along, {1300, 1650, 900}));
    builder.declare({inner, tank, clash::Class::hit, PairReason::buried, -700});
  }
  if (room.random.chance(30)) builder.turn_inside_out(tank);
  const std::array<Vec3d, 4> filter{{{140, 0, 0}, {140, 700, 0}, {80, 780, 0}, {80, 900, 0}}};
  for (int i = 0; i < 3; ++i) {
    const Handle unit =
        site.turned(ObjectKind::machine_part, filter, at({400 + 500.0 * i, 400, 0}));
    builder.rest(unit, room.deck);
  }
}

void build_pipe_chest(ShipRoom& room) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle header =
      site.bar(ObjectKind::pipe, 84, 2500, facing(FacingAxis::along, {150, 700, 500}));
  for (const double a : {330.0, 1210.0, 2380.0}) {
    const Handle stool = site.box(ObjectKind::support, {a, 640, 0}, {a + 60, 760, 416});
    builder.weld(stool, room.deck);
    builder.rest(header, stool);
  }
  const PipeSize size{45, 80};
  const std::array<Vec3d, 3> weldolet{{{60, 0, 0}, {45, 40, 0}, {45, 116, 0}}};
  for (int i = 0; i < 5; ++i) {
    const double a = 500 + 430.0 * i;
    const double far = 1500 + 90.0 * (i % 3);
    const Handle stub = site.turned(ObjectKind::spool, weldolet, at({a, 700, 584}));
    builder.weld(stub, header);
    const Handle low = site.bar(ObjectKind::flange, size.flange, kFlange, at({a, 700, 700}));
    builder.weld(low, stub);
    const Handle valve = build_valve(site, size, 280, facing(FacingAxis::beside, {a, 700, 730}));
    builder.bolt(valve, low);
    const Handle high = site.bar(ObjectKind::flange, size.flange, kFlange, at({a, 700, 1010}));
    builder.bolt(high, valve);
    const std::array<Vec3d, 4> path{{{a, 700, 1040}, {a, 700, 1800}, {a, far, 1800}, {a, far, 0}}};
    const Handle riser = site.swept(ObjectKind::spool, path, size.r, 135);
    builder.weld(riser, high);
    builder.weld(riser, room.deck);
    site.centre_line(path);
  }
}

}  // namespace strake::generate
