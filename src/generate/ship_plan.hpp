// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "generate/ship_builder.hpp"
#include "strake/generate/ship.hpp"

/// The plan of a generated ship, and the functions that build each part of it.
namespace strake::generate {

/// Random numbers that depend on the seed and the place they are used at, not on what was drawn
/// before: a cell's contents stay the same whatever the rest of the ship does.
/// The mixing function is that of SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit constexpr Random(std::uint64_t key) : state_(mix(key)) {}

  /// Returns an independent stream for a place within this one.
  [[nodiscard]] constexpr Random at(std::uint64_t place) const {
    return Random(state_ ^ mix(place + 0x632be59bd9b4e019U));
  }
  constexpr std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    return mix(state_);
  }
  /// Returns a number uniform in [0, count); count > 0 and small, so the bias of the remainder is
  /// without effect.
  constexpr std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((next() >> 32U) % count);
  }
  /// Returns a whole number of [lo, hi].
  constexpr int between(int lo, int hi) {
    return lo + static_cast<int>(below(static_cast<std::uint32_t>(hi - lo + 1)));
  }
  constexpr bool chance(std::uint32_t percent) { return below(100) < percent; }

 private:
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

// Principal dimensions, mm. x runs forward, y to port, z up from the bottom's inner face.
inline constexpr double kBay = 3200;  ///< four frame spaces
inline constexpr double kLane = 4000;
inline constexpr double kLevel = 2800;
inline constexpr double kTankTop = 1800;  ///< upper face of the inner bottom
/// Decks, inner bottom and girders are thicker than the clearance: what is welded to one side
/// never comes near what is welded to the other.
inline constexpr double kDeckPlate = 30;
inline constexpr double kShellPlate = 20;
inline constexpr double kBilge = 1600;  ///< radius of the inner face
inline constexpr double kHeadroom = kLevel - kDeckPlate;
inline constexpr double kBulkheadAt = 200;  ///< middle of a bulkhead from the start of its bay
inline constexpr double kBulkheadPlate = 12;
inline constexpr double kBeamAt = 1600;
inline constexpr double kBeamFlangeUnder = 2405;  ///< underside of a deck beam above its deck
inline constexpr int kFrames = 4;
inline constexpr int kLongitudinals = 5;

/// How many bays, lanes and room levels there are, and how far each deck runs: the higher a deck,
/// the earlier it stops, so that the section opens like stairs towards the bow.
struct ShipPlan {
  int bays = 1, lanes = 2, levels = 1;
  std::uint64_t seed = 1;
  ShipKind kind = ShipKind::usual;
  std::uint64_t imported = 0, imported_triangles = 0;  ///< see ShipOptions

  /// Returns how many bays deck k (0: inner bottom, levels: weather deck) covers, from bay 0; rooms
  /// of level k stand on deck k.
  [[nodiscard]] int deck_bays(int k) const {
    return std::max(1, bays - k * bays * 9 / (20 * levels));
  }
  /// Returns the bays with side plating: all of it to port, a part to starboard, where the viewer
  /// looks in.
  [[nodiscard]] int strake_bays(int side, int s) const {
    if (side == 1) return deck_bays(s);
    return s == 0 ? (bays + 1) / 2 : deck_bays(s) * 3 / 10;
  }
  [[nodiscard]] bool bulkhead_at(int level, int bay) const {
    return bay % 4 == 2 && bay < deck_bays(level);
  }
  [[nodiscard]] double x(int bay) const { return bay * kBay; }
  [[nodiscard]] double y(int lane) const { return lane * kLane - lanes * kLane / 2; }
  [[nodiscard]] double z(int deck) const { return kTankTop + deck * kLevel; }
  /// Returns the site at a lane's corner on a deck.
  [[nodiscard]] Site site(ShipBuilder& builder, int bay, int lane, int deck) const {
    return {&builder, cell(bay, lane, deck + 1), at({x(bay), y(lane), z(deck)})};
  }
  [[nodiscard]] static ShipCell cell(int bay, int lane, int level) {
    return {static_cast<std::uint16_t>(bay), static_cast<std::uint16_t>(lane),
            static_cast<std::uint16_t>(level)};
  }
  /// Returns random numbers for one place; `what` distinguishes uses.
  [[nodiscard]] Random random(std::uint64_t what, int bay, int lane, int level) const {
    return Random(seed)
        .at(what)
        .at(static_cast<std::uint64_t>(bay))
        .at(static_cast<std::uint64_t>(lane))
        .at(static_cast<std::uint64_t>(level));
  }
};

/// A table of handles by three numbers; kNothing outside.
class Handles {
 public:
  Handles(int a, int b, int c)
      : a_(a),
        b_(b),
        c_(c),
        all_(
            static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c),
            kNothing) {}
  [[nodiscard]] Handle operator()(int a, int b, int c) const {
    if (a < 0 || b < 0 || c < 0 || a >= a_ || b >= b_ || c >= c_) return kNothing;
    return all_[index(a, b, c)];
  }
  void set(int a, int b, int c, Handle handle) { all_[index(a, b, c)] = handle; }

 private:
  [[nodiscard]] std::size_t index(int a, int b, int c) const {
    return (static_cast<std::size_t>(a) * static_cast<std::size_t>(b_) +
            static_cast<std::size_t>(b)) *
               static_cast<std::size_t>(c_) +
           static_cast<std::size_t>(c);
  }
  int a_, b_, c_;
  std::vector<Handle> all_;
};

/// The steel that everything else stands on or hangs from.
struct Steel {
  explicit Steel(const ShipPlan& plan)
      : deck(plan.levels + 1, plan.bays, plan.lanes), beam(plan.levels, plan.bays, plan.lanes) {}
  Handles deck;  ///< (deck, bay, lane)
  Handles beam;  ///< (level below the deck, bay, lane)
};

/// A pipe and the flanges that fit it.
struct PipeSize {
  double r = 0, flange = 0;
};
/// Builds a valve with bonnet and hand wheel: flow along the frame's x from its origin, wheel
/// towards z.
Handle build_valve(const Site& site, const PipeSize& size, double length, const AxisFrame& where);

/// A room of 2800 x 3300 x 2000 mm clear of all steel but the deck below.
struct ShipRoom {
  Site site;
  Handle deck = kNothing;
  Random random;
};
void build_genset(ShipRoom& room);
void build_pumps(ShipRoom& room);
void build_tank(ShipRoom& room);
void build_pipe_chest(ShipRoom& room);
void build_control_room(ShipRoom& room);
void build_fan_room(ShipRoom& room);
void build_cabin(ShipRoom& room);
void build_store(ShipRoom& room);
void build_stairs(ShipRoom& room);
/// Builds one closed mesh of about `triangles` triangles on a foundation, like no other in the
/// ship.
void build_imported(ShipRoom& room, std::uint64_t triangles);
/// Seeds a clash (or nearly one), in a free space of 640 x 640 x 2000 mm.
void plant(ShipRoom& corner);

[[nodiscard]] Steel build_steel(const ShipPlan& plan, ShipBuilder& builder);
void build_runs(const ShipPlan& plan, const Steel& steel, ShipBuilder& builder);
void build_ballast(const ShipPlan& plan, ShipBuilder& builder);
void build_rooms(const ShipPlan& plan, const Steel& steel, ShipBuilder& builder);
void build_weather_deck(const ShipPlan& plan, const Steel& steel, ShipBuilder& builder);

}  // namespace strake::generate
