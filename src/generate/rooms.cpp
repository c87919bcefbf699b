// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using RoomBuilder = void (*)(ShipRoom&);

/// The clear space of a room within its lane and bay.
constexpr double kClearU = 360, kClearV = 350, kClearLength = 2800, kClearWidth = 3300;

RoomBuilder choose_contents(int level, const ShipPlan& plan, Random& random) {
  constexpr std::array<RoomBuilder, 6> kEngineRoom{build_genset,     build_pumps,  build_tank,
                                                   build_pipe_chest, build_genset, build_pumps};
  constexpr std::array<RoomBuilder, 7> kBetween{build_store,  build_fan_room,     build_pipe_chest,
                                                build_stairs, build_control_room, build_tank,
                                                build_store};
  constexpr std::array<RoomBuilder, 5> kUpper{build_cabin, build_cabin, build_cabin,
                                              build_control_room, build_store};
  constexpr std::array<RoomBuilder, 9> kOnlyLevel{build_genset, build_cabin,        build_pumps,
                                                  build_store,  build_pipe_chest,   build_tank,
                                                  build_cabin,  build_control_room, build_genset};
  if (plan.kind == ShipKind::dense) return kEngineRoom[random.below(kEngineRoom.size())];
  if (plan.kind == ShipKind::repeated) return build_cabin;
  if (plan.levels == 1) return kOnlyLevel[random.below(kOnlyLevel.size())];
  if (level == 0) return kEngineRoom[random.below(kEngineRoom.size())];
  if (level + 1 == plan.levels && plan.levels > 1) return kUpper[random.below(kUpper.size())];
  return level % 2 == 1 ? kBetween[random.below(kBetween.size())]
                        : kUpper[random.below(kUpper.size())];
}

/// Chooses one of the four ways in which the contents can face.
AxisFrame choose_facing(Random& random) {
  AxisFrame frame = at({kClearU, kClearV, 0});
  if (random.chance(50)) {
    frame.m[0] = -1;
    frame.t.x = um(kClearU + kClearLength);
  }
  if (random.chance(50)) {
    frame.m[4] = -1;
    frame.t.y = um(kClearV + kClearWidth);
  }
  return frame;
}

/// Seeds a pipe whose axis pierces the beam's web between two slots: the depth is the pipe's
/// radius.
void plant_stray_pipe(const Site& site, Handle beam, Random& random, double v) {
  const double r = random.chance(50) ? 45 : 57;
  const Handle pipe =
      site.bar(ObjectKind::pipe, r, 400, facing(FacingAxis::along, {1400, v, 2540}));
  site.builder->declare({pipe, beam, clash::Class::hit, PairReason::through_plate, -r});
}

/// Seeds a junction box beside the beam's web, clear of its flange: too near, near enough or
/// touching.
void plant_junction_box(const Site& site, Handle beam, Random& random, double v) {
  constexpr std::array<double, 6> kGaps{0, 2.5, 8, 14.5, 22, 31};
  const double gap = kGaps[random.below(kGaps.size())], u = kBeamAt + 5 + gap;
  const Handle box = site.box(ObjectKind::cabinet, {u, v - 80, 2480}, {u + 150, v + 80, 2590});
  if (gap == 0)
    site.builder->fit(box, beam);
  else if (gap < 25)
    site.builder->declare(
        {box, beam, clash::Class::clearance_violation, PairReason::gap_clear, gap});
}

void plant_in_steel(const ShipPlan& plan, const Steel& steel, const Site& site) {
  const int bay = site.cell.bay, lane = site.cell.lane, level = site.cell.level - 1;
  Random random = plan.random(32, bay, lane, level);
  const Handle beam = steel.beam(level, bay, lane);
  if (beam == kNothing) return;
  const int first = random.between(1, 4);
  const int second = 1 + (first + random.between(0, 2)) % 4;
  if (random.chance(25)) plant_stray_pipe(site, beam, random, 800.0 * first);
  if (random.chance(60)) plant_junction_box(site, beam, random, 800.0 * second);
}

}  // namespace

void build_rooms(const ShipPlan& plan, const Steel& steel, ShipBuilder& builder) {
  for (int level = 0; level < plan.levels; ++level)
    for (int bay = 0; bay < plan.deck_bays(level); ++bay)
      for (int lane = 0; lane < plan.lanes; ++lane) {
        const Site cell = plan.site(builder, bay, lane, level);
        Random random = plan.random(31, bay, lane, level);
        const RoomBuilder build = choose_contents(level, plan, random);
        const Site site = cell.in(choose_facing(random));
        ShipRoom room{site, steel.deck(level, bay, lane), random.at(1)};
        build(room);
        ShipRoom corner{site.moved({2130, 2630, 0}), room.deck, random.at(2)};
        plant(corner);
        plant_in_steel(plan, steel, cell);
      }
}

}  // namespace strake::generate
