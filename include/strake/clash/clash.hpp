// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/clash/kept.hpp"
#include "strake/clash/options.hpp"
#include "strake/clash/pair.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

/// Clash detection reports every pair of objects that is not NO_HIT, with its signed separation.
///
///     const auto scene = model::make_scene(model, clash::scene_options(options), context);
///     const auto report = clash::detect(*scene, clash::one_set(*scene), options, context);
///
/// docs/clash.md defines what the results mean.
namespace strake::clash {

struct Counters {
  std::uint64_t candidate_pairs = 0;  ///< object pairs with parts whose inflated boxes overlap
  std::uint64_t allowed_pairs = 0;  ///< candidate pairs that a rule about allowed contacts concerns
  std::uint64_t part_pairs = 0;
  std::uint64_t triangle_pairs = 0;
  std::uint64_t exact_fallbacks = 0;
  std::uint64_t depth_cells = 0;  ///< steps of searches for depth; spheres of sphere_subdivision
  std::uint64_t volume_triangle_pairs = 0;
  std::uint64_t volumes_given_up = 0;  ///< pairs of parts whose common volume takes too long
  std::uint64_t regions_given_up =
      0;  ///< pairs of objects whose regions could not be distinguished
};

/// A pair of objects that went to the narrow phase, whatever came of it.
struct LoggedPair {
  model::ObjectId a{}, b{};
  Class cls = Class::no_hit;
  bool may_be_allowed = false;  ///< a rule about allowed contacts concerns the two
  std::uint64_t part_pairs = 0, node_pairs = 0, triangle_pairs = 0, exact_fallbacks = 0,
                depth_cells = 0;
  /// Pairs of parts equal to an earlier one, which is evaluated once; its work counts for each.
  std::uint64_t repeated_part_pairs = 0;

  /// Returns what the pair takes, in steps of about ten nanoseconds. They are counted, not timed,
  /// so they are the same in every run.
  [[nodiscard]] std::uint64_t cost() const {
    constexpr std::uint64_t kPart = 10, kTriangle = 8, kExact = 200, kCell = 100;
    return kPart * part_pairs + node_pairs + kTriangle * triangle_pairs + kExact * exact_fallbacks +
           kCell * depth_cells;
  }
};

/// The label of an object that has none.
inline constexpr std::uint32_t kNoLabel = 0xffffffffU;

/// A rule that takes pairs out of a test, with the number of pairs that it took.
struct Exempted {
  std::string rule;
  std::uint64_t pairs = 0;  ///< pairs of objects with parts within reach of each other
  /// For an exemption that took none: the first rule that took a pair of its own before it, as an
  /// index into Report::exempted; negative if there is none.
  std::int32_t shadowed_by = -1;
};

/// A rule that allows results, with the numbers of pairs that it concerned and allowed.
struct AllowedCount {
  std::string rule;
  std::uint64_t candidates = 0, pairs = 0;
  std::uint64_t regions = 0;      ///< those that it allows of other pairs (Pair::allowed_regions)
  std::int32_t shadowed_by = -1;  ///< as in Exempted, but into Report::allowed
};

/// A discipline of a matrix, with the number of objects of the sets that are of it.
struct DisciplineCount {
  std::string name;
  std::uint64_t objects = 0;
};

/// A cell of a matrix, a <= b: the tolerances it was checked by and what was found.
struct CellReport {
  std::uint32_t a = 0, b = 0;  ///< indices into Report::disciplines
  bool checked = true;
  Tolerances tolerances;
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;
};

/// What a test could not compare, or not whole: a clash that it does not report may be there.
struct NotCompared {
  model::ObjectId a{};
  std::optional<model::ObjectId> b = {};  ///< absent: a lacks geometry, so any pair of it is meant
  std::string_view code;                  ///< the code of the diagnostic that says why; a literal
};

/// How many objects could not be compared whole, and how many pairs not at all.
struct NotComparedCounts {
  std::uint64_t objects = 0, pairs = 0;
};

/// Contacts of Report::count_contact and of Report::count_allowed that are not listed.
struct UnlistedContacts {
  std::uint64_t contacts = 0, allowed = 0;
};

/// What one test found.
struct Report {
  std::string name;          ///< the name of the test; empty where a run has only one
  std::string set_a, set_b;  ///< how the sets were chosen, as in Sets
  Options options;
  std::vector<Pair> pairs;    ///< by (a, b); NO_HIT pairs are not kept
  UnlistedContacts unlisted;  ///< those not among the pairs, with Contacts::count
  NotReported not_reported;   ///< results that Options::reporting takes out of pairs and counts
  /// The regions of pairs with several or with allowed ones, in the order of the pairs; of each
  /// pair the worst first.
  std::vector<Region> regions;
  std::uint64_t objects_a = 0, objects_b = 0;
  /// The number of pairs of each class, without those that a rule allows or that are not reported.
  std::uint64_t count_hit = 0, count_contact = 0, count_clearance = 0;
  std::uint64_t count_allowed = 0;           ///< pairs of any class that a rule allows
  std::uint64_t count_allowed_regions = 0;   ///< the sum of Pair::allowed_regions
  std::vector<Exempted> exempted;            ///< one entry per rule in force, in its order
  bool lists_exempted = false;               ///< whether exempted pairs are listed as well
  std::vector<ExemptedPair> exempted_pairs;  ///< by (a, b, rule)
  std::vector<AllowedCount> allowed;         ///< one entry per rule in force
  bool levels = false;                       ///< whether levels were distinguished
  std::vector<DisciplineCount> disciplines;  ///< of the matrix, if the test has one
  std::vector<CellReport> cells;             ///< by (a, b)
  std::vector<std::uint32_t> discipline;     ///< an entry per object; kNoLabel: in no discipline
  std::vector<bool> in_a, in_b;              ///< the sets, with an entry per object
  /// How many parts of each object of the sets are surfaces without an inside, 255 for more.
  std::vector<std::uint8_t> sheets;
  bool within_files = true;  ///< whether pairs of objects of one file were checked
  /// Objects of the sets in their order, then pairs by (a, b).
  std::vector<NotCompared> not_compared;
  std::vector<LoggedPair> log;         ///< where requested; by (a, b)
  std::optional<KeptForChanges> kept;  ///< with EngineOptions::keep_for_changes
  Counters counters;
  double contact_distance_mm = 0;  ///< the largest δ that was applied
  double weld_mm = -1;             ///< seams were closed within this; negative: δ of each body
  /// The hash of pairs, relations, classes, d, witnesses, regions and the rules that allow them;
  /// options do not count.
  std::string hash;
  /// The codes are "empty-set", "unknown-sag" (once per file), "pair-too-large" and
  /// "pair-in-open-surface" (both skipped).
  Diagnostics diagnostics;
};

/// What the tests of one run over one model found.
struct Findings {
  std::vector<Report> tests;
  Diagnostics diagnostics;  ///< of the run as a whole; each test has its own besides

  /// Returns those of the run, then those of the tests in order, a named test's with its name.
  [[nodiscard]] Diagnostics all_diagnostics() const;
};

/// The objects of a scene that are compared with each other: each unordered pair once, no
/// self-pair.
struct Sets {
  std::vector<bool> in_a, in_b;  ///< one entry per object
  /// Two objects of one group are no pair (to compare files with each other, say). Empty, or one
  /// entry per object.
  std::vector<std::uint32_t> group = {};
  /// How each set was chosen, for the report: a selection, or "*" for everything.
  std::string name_a = "*", name_b = "*";
  /// What stays the same of each number in `group` from run to run, no two equal; empty: each is
  /// named by its first object.
  std::vector<Hash128> group_names = {};
};

/// Returns sets that compare a scene with itself.
[[nodiscard]] Sets one_set(const model::Scene& scene);

/// Returns how fine a scene must be tessellated for these options: to a quarter of the smaller
/// tolerance, so that a contact of tessellated primitives can be distinguished from its neighbours.
[[nodiscard]] model::SceneOptions scene_options(const Options& options);

/// Returns every pair of objects, one of set A and one of set B, that is not NO_HIT.
///
/// 1. A pair's result is a function of the pair alone: neither the team, nor the broad phase, nor
///    other objects, nor the order of the sets show in it.
/// 2. Parts of one object are no pair; wires (polylines) only with EngineOptions::curves.
///
/// Errors: usage for a tolerance that is negative, infinite or not a number and for sets of the
/// wrong size; input for more pairs than max_pairs; cancelled.
[[nodiscard]] Result<Report> detect(const model::Scene& scene, const Sets& sets,
                                    const Options& options, const parallel::Context& context);

/// Returns what Report::not_compared of all tests says, with each object and each pair counted
/// once.
[[nodiscard]] NotComparedCounts counts_of(std::span<const Report> tests);

/// Returns the hexadecimal hash of the names and hashes of all tests.
[[nodiscard]] std::string hash_of(const Findings& findings);

/// Returns "HIT", "CONTACT", "CLEARANCE_VIOLATION" or "NO_HIT".
[[nodiscard]] std::string_view name(Class cls);
/// Returns "SEPARATE", "ABUT_OUTSIDE", "A_IN_B" …
[[nodiscard]] std::string_view name(Relation relation);
/// Returns "hard", "soft", "insulation" or "none".
[[nodiscard]] std::string_view name(Level level);
/// Returns the names of the bits set, in this order: "BORDERLINE", "UNCERTAIN", "OPEN", "INVERTED".
[[nodiscard]] std::vector<std::string_view> flag_names(std::uint16_t flags);

}  // namespace strake::clash
