// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "settings/named_sets.hpp"
#include "strake/clash/policy.hpp"
#include "strake/core/hash.hpp"
#include "strake/rules/rules.hpp"

/// The rules of a file, as parsed.
namespace strake::rules {

using settings::Chooser;
using settings::NamedSet;

/// Tolerances as written.
struct ToleranceRule {
  clash::Tolerances of_all;         ///< without what objects add
  std::string clearance_attribute;  ///< what both objects of a pair add; empty: nothing
  std::string clearance_where;      ///< what messages call the place of the attribute
};

struct TestRule {
  std::string name;
  bool enabled = true;
  bool matrix = false;
  std::optional<Chooser> a, b;  ///< absent: all objects
  ToleranceRule tolerances;
  double contact_distance_mm = -1;
  std::vector<std::string> without;  ///< rules that this test does not follow
  clash::Reporting reporting = {};
};

struct CellRule {
  std::uint32_t a = 0, b = 0;  ///< indices of disciplines
  bool checked = true;
  std::optional<ToleranceRule> tolerances;  ///< absent: those of the test
};

struct MatrixRule {
  bool missing_checked = true;
  std::vector<CellRule> cells;
};

/// Objects of one unit are no pair.
struct UnitRule {
  std::string attribute;  ///< empty: by selection only
  struct UnitGroup {
    std::int64_t number = 0;
    Chooser chooser;
  };
  std::vector<UnitGroup> groups;  ///< the first that picks an object decides
};

/// Objects of one assembly are no pair; the rule says in one of four ways which group is one.
struct AssemblyRule {
  std::uint32_t level = 0;  ///< 1: the outermost group of the path; 0: not said
  bool parent = false;
  bool by_type = false;  ///< the equipment, structure or branch (model::Assemblies)
  std::string group;     ///< a pattern of names: the innermost group that matches
  bool across_files = false;
};

/// The objects for which an attribute of a group holds, among those that inherit it.
enum class Heirs : std::uint8_t { none, ends, all };

/// The ends of a group that a reference is about, where its ends inherit it.
enum class ReferenceEnd : std::uint8_t { either, head, tail };

/// Objects whose attributes name each other, or a common node, are no pair.
struct ConnectedRule {
  struct AttributeReference {
    std::string attribute;
    ReferenceEnd end = ReferenceEnd::either;
  };
  std::vector<AttributeReference> references;
  Heirs heirs = Heirs::ends;  ///< ends: the first and the last in the order of the source
  bool node = false;    ///< equal values connect; otherwise a value is the partner's name or id
  bool groups = false;  ///< the names of a partner's groups count as its own
  std::string separator;
};

/// Objects of which ends meet within a length are no pair.
struct EndsRule {
  double within_mm = 0;
};

struct AttributeRule {
  std::string attribute;
};

struct FileRule {};

struct ExemptRule {
  Chooser a, b;
};

struct ExemptingRule {
  std::string name, where;
  std::optional<Chooser> among;  ///< only objects that this picks
  std::variant<UnitRule, AssemblyRule, ConnectedRule, EndsRule, AttributeRule, FileRule, ExemptRule>
      rule;
};

struct ObstructionRule {
  std::vector<std::string> attributes{"OBST"};  ///< the first that an object has counts
  clash::Level bodies = clash::Level::soft;     ///< none: obstruction volumes are not placed
  bool soft_against_soft = true;
  std::optional<Chooser> soft, none, hard;  ///< they go before attributes; hard before all
};

struct InsulationRule {
  bool against_insulation = true, against_soft = true;
  std::optional<Chooser> select;  ///< objects that are insulation as a whole, whatever else is said
};

struct AllowedRule {
  std::string name, where;
  Chooser a, b;
  std::optional<geometry::Box3d> region_mm;
  std::vector<clash::HalfSpace> cavity;
  std::optional<double> max_depth_mm;
  clash::RelationSet relations = {};
  std::optional<double> max_volume_mm3 = {};
};

/// The content of a rules file.
struct RuleFile {
  std::string file;
  Hash128 hash;  ///< the hash of its bytes
  std::vector<FileSettings> files;
  std::vector<NamedSet> sets, disciplines;
  std::optional<MatrixRule> matrix;
  std::vector<TestRule> tests;
  std::vector<ExemptingRule> exempting;
  std::optional<ObstructionRule> obstruction;
  std::optional<InsulationRule> insulation;
  std::vector<AllowedRule> allowed;
};

// These are the names that reports give to rules that have no name in the file.
inline constexpr std::string_view kMatrixRule = "matrix";
inline constexpr std::string_view kNoObstructionRule = "no obstruction";
inline constexpr std::string_view kSoftRule = "soft against soft";
inline constexpr std::string_view kInsulationRule = "insulation against insulation";
inline constexpr std::string_view kInsulationSoftRule = "insulation against soft";

/// Returns every selection that the tests of a file evaluate.
[[nodiscard]] std::vector<const Chooser*> choosers_of(const RuleFile& rules);

[[nodiscard]] Result<RuleFile> parse_rules(std::string_view text, std::string_view file);

}  // namespace strake::rules
