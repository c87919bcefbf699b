// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"
#include "strake/geometry/vec.hpp"

/// Rules of a clash test, worked out per object, so that applying one to a pair costs the same for
/// any model. docs/rules.md says what they mean to a user.
namespace strake::clash {

/// Two objects that carry the same label are no pair: a unit, an assembly, a file.
struct SameLabel {
  std::vector<std::uint32_t> label;  ///< one entry per object; kNoLabel: it has none
  /// What stays the same of each label from run to run, by label, no two equal; empty: each is
  /// named by its first object.
  std::vector<Hash128> names = {};
};

/// Two objects are no pair where one refers to what the other answers to: they are connected. What
/// they share is numbered.
struct Linked {
  /// The numbers of object o are numbers[first[o]] up to numbers[first[o + 1]], ascending.
  struct Lists {
    std::vector<std::uint32_t> first, numbers;
  };
  Lists answers_to, refers_to;
  /// As SameLabel::names, by number; two numbers may be called alike where the same objects answer
  /// to both and the same refer to both. Empty: each is named by all these objects.
  std::vector<Hash128> names = {};
};

/// An object of a and an object of b are no pair.
struct Between {
  std::vector<bool> a, b;  ///< one entry per object
};

struct Exemption {
  std::string rule;  ///< what reports call it
  std::variant<SameLabel, Linked, Between> test;
};

/// Each pair of disciplines has tolerances of its own, or is not checked.
struct Matrix {
  static constexpr std::uint32_t kDefault = 0xfffffffeU;     ///< it has the tolerances of the test
  static constexpr std::uint32_t kNotChecked = 0xffffffffU;  ///< the two are no pair
  std::string rule = "matrix";  ///< what reports call pairs of cells that are not checked
  std::vector<std::string> disciplines;
  std::vector<std::uint32_t> discipline;  ///< one entry per object; kNoLabel: in no discipline
  std::vector<std::uint32_t> cells;  ///< row by row, symmetric; an index into Policy::tolerances
};

/// What parts count as, and which of them are not compared with each other.
struct Levels {
  std::vector<Level> object;               ///< the level of an object's physical bodies
  Level obstruction_bodies = Level::soft;  ///< the level of bodies of Category::obstruction
  std::string no_obstruction_rule = "no obstruction";
  /// For each two levels, the rule that leaves such pairs of parts out; empty if they are checked.
  /// The table is symmetric; Level::none is never checked.
  std::array<std::array<std::string, 3>, 3> left_out = {};
};

/// One side of a plane.
struct HalfSpace {
  geometry::Vec3d point_mm;
  geometry::Vec3d normal;  ///< points to the side that is meant; of any length but 0
};

/// Results between a and b that are meant: no deeper than max_depth, with the contact region within
/// the region, of one of the relations, with no more than max_volume in common.
struct Allowed {
  std::string rule;
  std::vector<bool> a, b;  ///< one entry per object
  std::optional<geometry::Box3d> region_mm;
  std::vector<HalfSpace> cavity;  ///< the contact region lies in all of them
  /// The certain depth (Pair::d_lower_mm) is at most this, to within half a grid step; a depth of
  /// just this is allowed, and flagged kBorderline. If absent, the result must be no HIT.
  std::optional<double> max_depth_mm;
  /// How one of a stands to one of b; empty: in any way. A result flagged kUncertain is not
  /// allowed, as what the two turn out to be may stand otherwise.
  RelationSet relations = {};
  /// The volume that the two objects have in common is certainly at most this. Where it may be
  /// either, or is not known, the result is not allowed, and flagged kUncertain.
  std::optional<double> max_volume_mm3 = {};
};

/// The rules of one test. Where several exempt a pair, it counts for the first of them: the matrix,
/// then `exemptions` in their order, then the levels.
struct Policy {
  std::vector<Tolerances> tolerances;  ///< what cells of the matrix refer to
  std::optional<Matrix> matrix;
  std::vector<Exemption> exemptions;
  std::optional<Levels> levels;
  std::vector<Allowed> allowed;
  bool list_exempted = false;  ///< whether Report::exempted_pairs is filled
};

/// Finds clashes as detect() does, under rules.
///
/// 1. A pair that no rule concerns gives bit for bit what it gives without rules; a pair of a cell
///    with tolerances of its own gives what it gives in a test with these.
/// 2. An exempted pair is counted, and listed where requested, if parts of the two are within reach
///    of each other; where a level leaves out some pairs of their parts, the others are checked.
/// 3. An allowed result keeps its class and d. The rules are applied to each pair of parts by
///    itself (a volume is that of the two objects): one that no rule allows decides the pair, and
///    what is allowed besides is counted (Pair::allowed_regions). Its place is that of the worst:
///    where the boxes of the two parts meet beyond region and cavity too, the result is flagged
///    kUncertain.
/// 4. A hard part decides before a soft one, and a soft one before insulation, where the class is
///    equal.
///
/// Errors: those of detect(); usage for lists of the wrong size, for limits of a rule that are not
/// numbers, and for rules by relation or volume where the narrow phase is not the exact one.
[[nodiscard]] Result<Report> detect(const model::Scene& scene, const Sets& sets,
                                    const Options& options, const Policy& policy,
                                    const parallel::Context& context);

}  // namespace strake::clash
