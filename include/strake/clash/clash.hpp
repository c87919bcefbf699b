// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::clash {

/// From the least to the most severe; what the classes mean: docs/clash.md.
enum class Class : std::uint8_t { no_hit, clearance_violation, contact, hit };

enum class Relation : std::uint8_t {
  separate,
  abut_outside,
  abut_inside,
  interfere,
  a_in_b,
  b_in_a,
  duplicate,
  cross,
};

enum class BroadPhase { tree, all_pairs };
enum class ThicknessCap { on, off };

struct Options {
  double clearance_mm = 0;      ///< c: pairs nearer than this and farther than touch_gap violate it
  double touch_gap_mm = 1;      ///< t_g: up to this far apart is a contact
  double touch_overlap_mm = 1;  ///< t_o: up to this deep is a contact
  ThicknessCap thickness_cap = ThicknessCap::on;
  BroadPhase broad_phase = BroadPhase::tree;
  /// Contact distance δ for the relation, mm; negative: derived from the sources' precision.
  double contact_distance_mm = -1;
};

/// Bits of Pair::flags.
enum Flag : std::uint16_t {
  kBorderline =
      1U << 0U,  ///< the bracket cannot be told from a threshold: the severer class is given
  kUncertain =
      1U << 1U,          ///< the bracket straddles a threshold: the class of the nominal d is given
  kOpen = 1U << 2U,      ///< one of the two is an open surface
  kInverted = 1U << 3U,  ///< one of the two came inside out
  kUnknownSag = 1U << 4U,  ///< an imported mesh whose distance from its surface is unknown
};

/// One pair of objects that is not NO_HIT; a < b in the durable order.
struct Pair {
  model::ObjectId a{}, b{};
  Class cls = Class::no_hit;
  Relation relation = Relation::separate;
  std::uint16_t flags = 0;
  double d_mm = 0;                        ///< signed separation; negative is depth
  double d_lower_mm = 0, d_upper_mm = 0;  ///< certified bracket round d
  geometry::Vec3d point_mm;               ///< midpoint of the closest pair, or the deepest point
  std::uint32_t part_a = 0, part_b = 0;   ///< deciding parts, numbered within their objects
};

struct Counters {
  std::uint64_t candidate_pairs = 0;  ///< object pairs whose inflated boxes meet
  std::uint64_t part_pairs = 0;
  std::uint64_t triangle_pairs = 0;
  std::uint64_t exact_fallbacks = 0;
  std::uint64_t depth_cells = 0;
};

struct Report {
  Options options;
  std::vector<Pair> pairs;  ///< by (a, b); NO_HIT pairs are not kept
  std::uint64_t objects_a = 0, objects_b = 0;
  std::uint64_t count_hit = 0, count_contact = 0, count_clearance = 0;
  Counters counters;
  std::string hash;  ///< of pairs, classes, d and witnesses; not of options
};

/// Which of a scene's objects stand against which: each unordered pair once, no self-pair.
struct Sets {
  std::vector<bool> in_a, in_b;  ///< one entry per object
};

/// Every pair of objects, one of set A and one of set B, that is not NO_HIT.
/// A tolerance that is negative, infinite or not a number is a usage error.
[[nodiscard]] Result<Report> detect(const model::Scene& scene, const Sets& sets,
                                    const Options& options, const parallel::Context& context);

}  // namespace strake::clash
