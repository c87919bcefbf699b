// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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
  /// As by element, with the equipment, structures and branches of models from AVEVA in place of
  /// their parts (docs/rules.md, `level = "assembly"`); other objects stand for themselves.
  assembly,
  /// Results whose points lie within a distance of each other form a group, and those near these,
  /// and so on.
  proximity,
  test,
  files,  ///< the pair of files of the two objects
};

enum class SortBy : std::uint8_t {
  depth,   ///< the severest class first, then the least d
  volume,  ///< the largest common volume first, then as by depth
  size,    ///< the most results first, then as by depth
};

struct GroupRules {
  GroupBy by = GroupBy::element;
  double distance_mm = 3000;  ///< for GroupBy::proximity; at least 1 mm
  SortBy sort = SortBy::depth;
  /// Contacts are mostly meant, and so many that they join everything to everything: they belong to
  /// no group unless asked for.
  bool contacts = false;
};

/// A result of findings, which is findings.tests[test].pairs[pair].
struct ResultRef {
  std::uint32_t test = 0, pair = 0;
  friend bool operator==(const ResultRef&, const ResultRef&) = default;
};

struct Group {
  /// A hash, as a clash key is, of what the group is about: the object, the test or the files; by
  /// proximity the lowest key of its results, so that it stays while that result does.
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

/// Puts every result that no rule allows, and that is no contact unless asked for, in exactly one
/// group. The grouping is the same for any order of files and objects. Errors: usage for a distance
/// below 1 mm or not a number.
[[nodiscard]] Result<Grouping> group_results(const Findings& findings, const model::Model& model,
                                             const GroupRules& rules);

/// Returns "element", "assembly", "proximity", "test" or "files".
[[nodiscard]] std::string_view name(GroupBy by);

}  // namespace strake::clash
