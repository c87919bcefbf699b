// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/clash/options.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

/// Clash detection: every pair of objects that is not NO_HIT, with its signed separation.
///
///     const auto scene = model::make_scene(model, clash::scene_options(options), context);
///     const auto report = clash::detect(*scene, clash::one_set(*scene), options, context);
///
/// What the answers mean is defined in docs/clash.md.
namespace strake::clash {

/// From the least to the most severe.
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

/// What a part counts as, from the most to the least solid; `none` is not checked at all.
enum class Level : std::uint8_t { hard, soft, insulation, none };

/// Bits of Pair::flags.
enum Flag : std::uint16_t {
  kBorderline =
      1U << 0U,  ///< the bracket cannot be told from a threshold: the severer class is given
  kUncertain =
      1U << 1U,          ///< the bracket straddles a threshold: the class of the nominal d is given
  kOpen = 1U << 2U,      ///< one of the two is an open surface
  kInverted = 1U << 3U,  ///< one of the two came inside out
};

/// One of several places where a pair of objects meets or comes too near.
struct Region {
  Class cls = Class::no_hit;
  std::uint16_t flags = 0;
  double d_mm = 0, d_lower_mm = 0, d_upper_mm = 0;  ///< as of the pair, of this place alone
  geometry::Vec3d point_mm;
  geometry::Box3d box_mm;                ///< holds the place
  std::uint32_t part_a = 0, part_b = 0;  ///< deciding parts
  std::int32_t allowed = -1;             ///< the rule that allows it, as Pair::allowed
  bool depth_complete = true;            ///< as of the pair
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
  /// Moving a by on_b - on_a, which is |d| long, brings the two points together. d >= 0: the
  /// closest points. d < 0: one is the deepest point, the other surface_mm().
  geometry::Vec3d on_a_mm, on_b_mm;
  /// Unit: the way along which a moves away from b or out of it. Zero where there is none: parts
  /// that touch, sheets that cross.
  geometry::Vec3d away;
  bool deep_in_a = false;  ///< d < 0: measured to the skin of a
  /// Not where a search for the depth ended at its work limit and left the bracket wider than it
  /// aims for.
  bool depth_complete = true;
  /// A HIT of solids, where asked for: the volume of the common parts of their parts, added up
  /// (what two parts of one object cover twice counts twice); curved primitives as tessellated.
  /// None where it would take too long.
  std::optional<double> volume_mm3 = {};
  std::uint32_t part_a = 0, part_b = 0;  ///< deciding parts, numbered within their objects
  Level level_a = Level::hard, level_b = Level::hard;  ///< of the deciding parts
  /// The rule that allows this result, an index into Report::allowed; negative: none.
  std::int32_t allowed = -1;
  /// The severest class that brackets allow where no rule allows it, its own where no rule allows
  /// that: more than cls only with kUncertain. NO_HIT: whatever the two turn out to be is allowed.
  Class severest = Class::no_hit;
  /// Where asked for: the number of separate places, 0 where there is too much to tell them apart.
  /// Of several, as many as asked for are listed from Report::regions[first_region] on.
  std::uint32_t regions = 0, first_region = 0;
  /// Of a result that no rule allows: its places that one does, which `regions` leaves out. Counted
  /// whether regions are asked for or not; as many as asked for are listed behind the others.
  std::uint32_t allowed_regions = 0;

  [[nodiscard]] std::uint32_t regions_listed(const Options& options) const {
    return regions < 2 ? 0 : options.engine.regions_listed_of(regions);
  }
  [[nodiscard]] std::uint32_t allowed_regions_listed(const Options& options) const {
    return options.engine.regions_listed_of(allowed_regions);
  }
  /// d < 0: the nearest point of the skin that d is measured to.
  [[nodiscard]] const geometry::Vec3d& surface_mm() const { return deep_in_a ? on_a_mm : on_b_mm; }
};

struct Counters {
  std::uint64_t candidate_pairs = 0;  ///< object pairs with parts whose inflated boxes meet
  std::uint64_t allowed_pairs = 0;    ///< those of them that a rule about allowed contacts concerns
  std::uint64_t part_pairs = 0;
  std::uint64_t triangle_pairs = 0;
  std::uint64_t exact_fallbacks = 0;
  std::uint64_t depth_cells = 0;
  std::uint64_t volume_triangle_pairs = 0;
  std::uint64_t volumes_given_up = 0;  ///< pairs of parts whose common volume takes too long
  std::uint64_t regions_given_up = 0;  ///< pairs of objects whose places could not be told apart
};

/// A pair of objects that went to the detailed stage, whatever came of it.
struct LoggedPair {
  model::ObjectId a{}, b{};
  Class cls = Class::no_hit;
  bool may_be_allowed = false;  ///< a rule about allowed contacts concerns the two
  std::uint64_t part_pairs = 0, node_pairs = 0, triangle_pairs = 0, exact_fallbacks = 0,
                depth_cells = 0;
  /// Part pairs that were the same question as an earlier one: copies in equal places are worked on
  /// once. What it took counts for each of them all the same.
  std::uint64_t repeated_part_pairs = 0;

  /// What it takes, in steps of about ten nanoseconds: counted, not timed, so the same in every
  /// run.
  [[nodiscard]] std::uint64_t cost() const {
    constexpr std::uint64_t kPart = 10, kTriangle = 8, kExact = 200, kCell = 100;
    return kPart * part_pairs + node_pairs + kTriangle * triangle_pairs + kExact * exact_fallbacks +
           kCell * depth_cells;
  }
};

/// The label of an object that has none.
inline constexpr std::uint32_t kNoLabel = 0xffffffffU;

/// A rule that takes pairs out of a test, and how many it took.
struct Exempted {
  std::string rule;
  std::uint64_t pairs = 0;  ///< of objects, with parts within reach of each other
  /// Of an exemption that took none: the first rule that took a pair of its own before it, an index
  /// into Report::exempted; negative: it has none.
  std::int32_t shadowed_by = -1;
};

/// One of these pairs; a < b in the durable order.
struct ExemptedPair {
  model::ObjectId a{}, b{};
  std::uint32_t rule = 0;  ///< index into Report::exempted
};

/// A rule that allows results, how many pairs it concerned and how many it allowed.
struct AllowedCount {
  std::string rule;
  std::uint64_t candidates = 0, pairs = 0;
  std::uint64_t places = 0;       ///< that it allows of other pairs, Pair::allowed_regions
  std::int32_t shadowed_by = -1;  ///< the same of one that allowed none, into Report::allowed
};

/// A discipline of a matrix, and how many objects of the sets are of it.
struct DisciplineCount {
  std::string name;
  std::uint64_t objects = 0;
};

/// A cell of a matrix: what it was checked by and what was found, a <= b.
struct CellReport {
  std::uint32_t a = 0, b = 0;  ///< indices into Report::disciplines
  bool checked = true;
  Tolerances tolerances;
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;
};

/// What a test would have compared, but could not or not whole: a clash that it does not report may
/// be there all the same.
struct NotCompared {
  model::ObjectId a{};
  std::optional<model::ObjectId> b = {};  ///< none: a lacks geometry, so any pair of it
  std::string_view code;                  ///< of the diagnostic that tells why; a literal
};

/// How many objects could not be compared whole, and how many pairs not at all.
struct NotComparedCounts {
  std::uint64_t objects = 0, pairs = 0;
};

/// What one test found.
struct Report {
  std::string name;          ///< of the test; empty where a run has only one
  std::string set_a, set_b;  ///< how the sets were chosen, as in Sets
  Options options;
  std::vector<Pair> pairs;  ///< by (a, b); NO_HIT pairs are not kept
  /// Of pairs with several or with allowed ones, in their order; of each the worst first.
  std::vector<Region> regions;
  std::uint64_t objects_a = 0, objects_b = 0;
  /// Pairs of each class, those apart that a rule allows.
  std::uint64_t count_hit = 0, count_contact = 0, count_clearance = 0;
  std::uint64_t count_allowed = 0;           ///< pairs of any class that a rule allows
  std::uint64_t count_allowed_regions = 0;   ///< Pair::allowed_regions of all pairs
  std::vector<Exempted> exempted;            ///< one entry per rule in force, in its order
  bool lists_exempted = false;               ///< whether they are listed as well
  std::vector<ExemptedPair> exempted_pairs;  ///< by (a, b, rule)
  std::vector<AllowedCount> allowed;         ///< one entry per rule in force
  bool levels = false;                       ///< whether levels were told apart
  std::vector<DisciplineCount> disciplines;  ///< of the matrix, if the test has one
  std::vector<CellReport> cells;             ///< by (a, b)
  std::vector<std::uint32_t> discipline;     ///< per object, kNoLabel: in none
  std::vector<bool> in_a, in_b;              ///< the sets, an entry per object
  /// Of each object of the sets: how many of its parts are surfaces without an inside, 255 for
  /// more.
  std::vector<std::uint8_t> sheets;
  bool within_files = true;  ///< whether pairs of objects of one file were looked at
  /// Objects of the sets in their order, then pairs by (a, b).
  std::vector<NotCompared> not_compared;
  std::vector<LoggedPair> log;  ///< where asked for: by (a, b)
  Counters counters;
  double contact_distance_mm = 0;  ///< the largest δ that was applied
  double weld_mm = -1;             ///< that seams were closed within; negative: δ of each body
  /// Of pairs, relations, classes, d, witnesses, regions and the rules that allow them; not of
  /// options.
  std::string hash;
  /// "empty-set", "unknown-sag" (once per file), "pair-too-large", "pair-in-open-surface"
  /// (both skipped).
  Diagnostics diagnostics;
};

/// What the tests of one run over one model found.
struct Findings {
  std::vector<Report> tests;
  Diagnostics diagnostics;  ///< of the run as a whole; each test has its own besides

  /// Those of the run, then those of the tests in order, a named test's with its name.
  [[nodiscard]] Diagnostics all_diagnostics() const;
};

/// Which of a scene's objects stand against which: each unordered pair once, no self-pair.
struct Sets {
  std::vector<bool> in_a, in_b;  ///< one entry per object
  /// Two objects of one group are no pair (files against each other, say). Empty, or one entry per
  /// object.
  std::vector<std::uint32_t> group = {};
  /// How each was chosen, for the report: a selection, or "*" for everything.
  std::string name_a = "*", name_b = "*";
};

/// A scene against itself.
[[nodiscard]] Sets one_set(const model::Scene& scene);

/// How fine a scene must be tessellated for these options: a quarter of the smaller tolerance, so
/// that a contact of tessellated primitives can be told from its neighbours.
[[nodiscard]] model::SceneOptions scene_options(const Options& options);

/// Every pair of objects, one of set A and one of set B, that is not NO_HIT.
///
/// 1. A pair's result is a function of the pair alone: neither the team, nor the broad phase, nor
///    other objects, nor the order of the sets show in it.
/// 2. Parts of one object are no pair; wires (polylines) only with EngineOptions::curves.
///
/// Errors: usage for a tolerance that is negative, infinite or not a number and for sets of the
/// wrong size; input for more pairs than most_pairs; cancelled.
[[nodiscard]] Result<Report> detect(const model::Scene& scene, const Sets& sets,
                                    const Options& options, const parallel::Context& context);

/// What Report::not_compared of all tests says, each object and each pair once.
[[nodiscard]] NotComparedCounts counts_of(std::span<const Report> tests);

/// Hexadecimal hash of the names and hashes of all tests.
[[nodiscard]] std::string hash_of(const Findings& findings);

/// "HIT", "CONTACT", "CLEARANCE_VIOLATION", "NO_HIT".
[[nodiscard]] std::string_view name(Class cls);
/// "SEPARATE", "ABUT_OUTSIDE", "A_IN_B" …
[[nodiscard]] std::string_view name(Relation relation);
/// "hard", "soft", "insulation", "none".
[[nodiscard]] std::string_view name(Level level);
/// "BORDERLINE", "UNCERTAIN", "OPEN", "INVERTED": the names of the bits set, in this order.
[[nodiscard]] std::vector<std::string_view> flag_names(std::uint16_t flags);

}  // namespace strake::clash
