// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/clash/clash.hpp"

/// Clash results are grouped so that one decision settles many of them.
///
///     const auto grouping = clash::group_results(findings, model, {.by =
///     clash::GroupBy::element});
namespace strake::clash {

enum class GroupBy : std::uint8_t {
  /// The object with most results takes them all (one beam with forty pipes through it), then the
  /// one with most of what is left, and so on; of equals the first in the durable order.
  element,
  /// Results whose points lie within a distance of each other form a group, and those near these,
  /// and so on.
  proximity,
  test,
  files,  ///< the pair of files of the two objects
  /// The pair of what the two are parts of: of each the nearest group with a name of its own (an
  /// equipment, a branch, a structure), or its file where there is none.
  assembly,
};

enum class SortBy : std::uint8_t {
  depth,   ///< the severest class first, then the least d
  volume,  ///< the largest common volume first, then as by depth
  size,    ///< the most results first, then as by depth
};

/// The least distance of groups.
inline constexpr double kMinGroupDistanceMm = 1;

/// The former name of kMinGroupDistanceMm.
[[deprecated("it is called kMinGroupDistanceMm")]] inline constexpr double kLeastGroupDistanceMm =
    kMinGroupDistanceMm;

struct GroupRules {
  GroupBy by = GroupBy::element;
  double distance_mm = 3000;  ///< for GroupBy::proximity and `apart`; at least the least one
  SortBy sort = SortBy::depth;
  /// Contacts are mostly meant, and so many that they join everything to everything: they belong to
  /// no group unless requested.
  bool contacts = false;
  /// Results of a group are split by proximity as well: a group is about one element, say, at one
  /// place.
  bool apart = false;
};

/// A result of findings, which is findings.tests[test].pairs[pair].
struct ResultRef {
  std::uint32_t test = 0, pair = 0;
  friend bool operator==(const ResultRef&, const ResultRef&) = default;
};

struct Group {
  /// A hash, as a clash key is, of what the group is about: the object, the test, the files or the
  /// assemblies; by proximity and of groups split by it the lowest key of its results, so that it
  /// stays while that result does.
  std::string id;
  std::string name;
  std::vector<ResultRef> results;  ///< in the order of the findings
  Class worst = Class::no_hit;
  double d_mm = 0;  ///< the least d of the worst class
  std::uint64_t count_hit = 0, count_contact = 0, count_clearance = 0;
  std::optional<double> volume_mm3;  ///< the sum of those that are known
  geometry::Box3d box_mm;            ///< the box of the results' points
};

struct Grouping {
  GroupRules rules;
  std::vector<Group> groups;  ///< as rules.sort has them
};

/// Tells whether a result belongs to no group, as one that is approved.
using LeavesOut = std::function<bool(const ResultRef&)>;

/// Puts every result that no rule allows, that is no contact unless requested and that is not left
/// out, in exactly one group. The grouping is the same for any order of files and objects. Errors:
/// usage for a distance below 1 mm or not a number.
[[nodiscard]] Result<Grouping> group_results(const Findings& findings, const model::Model& model,
                                             const GroupRules& rules,
                                             const LeavesOut& leaves_out = {});

/// Returns "element", "proximity", "test", "files" or "assembly".
[[nodiscard]] std::string_view name(GroupBy by);

}  // namespace strake::clash
