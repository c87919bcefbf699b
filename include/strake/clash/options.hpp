// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "strake/clash/reporting.hpp"

namespace strake::clash {

enum class BroadPhase : std::uint8_t { tree, all_pairs };
enum class NarrowPhase : std::uint8_t { exact, sphere_subdivision };
enum class ThicknessCap : std::uint8_t { on, off };
enum class Volumes : std::uint8_t { off, on };
enum class Curves : std::uint8_t { off, on };
enum class Contacts : std::uint8_t { list, count };

/// What each object adds to the clearance of its pairs, as the thickness of its insulation.
struct ObjectClearances {
  std::string attribute;   ///< what states it: results name it
  std::vector<double> mm;  ///< one entry per object
};

/// What the classes of a pair depend on.
struct Tolerances {
  double clearance_mm = 0;      ///< c: pairs nearer than this and farther than touch_gap violate it
  double touch_gap_mm = 1;      ///< t_g: up to this far apart is a contact
  double touch_overlap_mm = 1;  ///< t_o: up to this deep is a contact
  /// When on, t_o is at most a quarter of the smaller thickness of the two parts.
  ThicknessCap thickness_cap = ThicknessCap::on;
  /// What the two objects of a pair add to its clearance, both; null: nothing.
  std::shared_ptr<const ObjectClearances> object_clearances = {};

  /// Returns what two objects add to c.
  [[nodiscard]] double added_clearance_mm(std::uint32_t a, std::uint32_t b) const {
    return object_clearances ? object_clearances->mm[a] + object_clearances->mm[b] : 0;
  }
  friend bool operator==(const Tolerances&, const Tolerances&) = default;
};

/// How the engine works and what it keeps, whatever a test asks: the same for all tests of a run.
struct EngineOptions {
  BroadPhase broad_phase = BroadPhase::tree;
  /// `sphere_subdivision` is the baseline that benchmarks compare with, see docs/clash.md.
  NarrowPhase narrow_phase = NarrowPhase::exact;
  /// How many spheres sphere_subdivision may test for one pair of parts before it gives up,
  /// flagged.
  std::uint64_t max_spheres = 1'000'000;
  /// Whether to measure the volume of the part common to two solids that hit.
  Volumes volumes = Volumes::off;
  /// Whether lines and polylines are checked, as bodies without thickness; with the exact narrow
  /// phase only.
  Curves curves = Curves::off;
  /// Whether contacts stand in Report::pairs or are only counted (Report::unlisted): most contacts
  /// are meant, and a ship of a million objects has 1.5 million. Counts and the hash of the result
  /// are the same. Contacts that may be something else are listed all the same.
  Contacts contacts = Contacts::list;
  /// How many of the separate regions of a pair are listed; 0: they are not looked for.
  std::uint64_t max_regions = 8;
  /// Whether Report::log is filled.
  bool log_pairs = false;
  /// Whether Report::kept is filled, from which detect_changes() follows a later change.
  bool keep_for_changes = false;
  /// The most pairs of parts within reach of each other, some 300 bytes each; more are an error.
  std::uint64_t max_pairs = std::uint64_t{1} << 25U;

  /// Returns how many of so many regions are listed.
  [[nodiscard]] std::uint32_t regions_listed_of(std::uint32_t places) const {
    return places < max_regions ? places : static_cast<std::uint32_t>(max_regions);
  }
};

/// What one test asks, and how it is worked out.
struct Options {
  Tolerances tolerances = {};  ///< of all pairs that a matrix has no others for
  /// Contact distance δ for the relation, mm; negative: derived from the sources' precision.
  double contact_distance_mm = -1;
  EngineOptions engine = {};
  Reporting reporting = {};
};

}  // namespace strake::clash
