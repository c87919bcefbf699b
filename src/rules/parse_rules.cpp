// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rules/file_settings.hpp"
#include "rules/rule_file.hpp"
#include "rules/test_options.hpp"
#include "settings/named_sets.hpp"
#include "settings/table_reader.hpp"

namespace strake::rules {
namespace {

using clash::Level;
using settings::KeyValue;
using settings::NamedSets;
using settings::ParseContext;
using settings::SourcePosition;
using settings::Table;
using settings::TableReader;
using settings::Value;

constexpr std::string_view kChecked = "checked", kNotChecked = "not checked";
/// The most disciplines and the longest name. Results have a cell for each two disciplines, and
/// every pair carries the names of its rules: a small file must not take gigabytes.
constexpr std::size_t kMaxDisciplines = 300, kLongestName = 200;
/// The farthest that ends of a joint may be apart: what is farther is no joint, and the search
/// takes the longer the farther it looks.
constexpr double kFarthestEndsMm = 1000;

/// Reads the tables of a file one by one. The ParseContext keeps a fault, and what is read after it
/// is thrown away with the rest.
class RulesParser {
 public:
  RulesParser(ParseContext& reading, const Value& document)
      : reading_(reading), top_(reading, document, "the file"), sets_(reading, top_.table("sets")) {
    rules_.file = reading.file();
  }

  RuleFile run() {
    rules_.sets = sets_.all();
    defaults();
    rules_.files = read_file_settings(reading_, top_);
    disciplines();
    matrix();
    units();
    for (const Value* table : top_.tables("same_assembly")) assembly(*table);
    for (const Value* table : top_.tables("connected")) connected(*table);
    for (const Value* table : top_.tables("same_attribute")) same_attribute(*table);
    for (const Value* table : top_.tables("exempt")) exempt(*table);
    obstruction();
    insulation();
    for (const Value* table : top_.tables("allowed")) allowed(*table);
    for (const Value* table : top_.tables("test")) test(*table);
    if (rules_.tests.empty()) rules_.tests.push_back(plain_test(""));
    if (std::none_of(rules_.tests.begin(), rules_.tests.end(),
                     [](const TestRule& t) { return t.enabled; }))
      reading_.fault({1, 1}, "every test is disabled", "enable one");
    return std::move(rules_);
  }

 private:
  [[nodiscard]] std::string place(SourcePosition at) const {
    return reading_.file() + ", line " + std::to_string(at.line);
  }

  /// Returns a name by which reports and `without` identify a rule.
  std::string new_name(TableReader& table, std::vector<std::string>& taken) {
    std::string name = table.required_text("name");
    claim(name, table.at(), taken);
    table.call(name);
    return name;
  }

  void claim(const std::string& name, SourcePosition at, std::vector<std::string>& taken) {
    if (name.size() > kLongestName)
      reading_.fault(at,
                     "the name '" + name.substr(0, 20) + "...' has " + std::to_string(name.size()) +
                         " bytes, more than " + std::to_string(kLongestName),
                     "give it a short one: every result repeats it");
    if (std::find(taken.begin(), taken.end(), name) != taken.end())
      reading_.fault(at, "the name '" + name + "' is given twice", "give each its own");
    taken.push_back(name);
  }

  bool tolerances(TableReader& table, ToleranceRule& rule) {
    return read_tolerances(reading_, table, rule);
  }

  [[nodiscard]] TestRule plain_test(std::string name) const {
    TestRule test;
    test.name = std::move(name);
    test.tolerances = defaults_;
    test.contact_distance_mm = contact_distance_mm_;
    test.reporting = reporting_;
    return test;
  }

  void defaults() {
    const Value* const value = top_.table("defaults");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[defaults]");
    tolerances(table, defaults_);
    contact_distance_mm_ = table.tolerance_mm("contact_distance").value_or(-1);
    read_reporting(reading_, table, reporting_);
    if (!table.flag("within_file").value_or(true)) {
      rules_.exempting.push_back({"within one file", place(value->at), {}, FileRule{}});
      rule_names_.emplace_back("within one file");
    }
  }

  void disciplines() {
    std::vector<std::string> names;
    for (const Value* value : top_.tables("discipline")) {
      if (names.size() == kMaxDisciplines) {
        reading_.fault(value->at,
                       "there are more than " + std::to_string(kMaxDisciplines) + " disciplines",
                       "join some: a matrix has a cell for each two of them");
        return;
      }
      TableReader table(reading_, *value, "[[discipline]]");
      std::string name = new_name(table, names);
      if (auto select = sets_.required(table, "select"))
        rules_.disciplines.push_back({std::move(name), std::move(*select)});
    }
  }

  [[nodiscard]] std::optional<std::uint32_t> discipline(const KeyValue& entry) {
    std::string known;
    for (std::uint32_t d = 0; d < rules_.disciplines.size(); ++d) {
      if (rules_.disciplines[d].name == entry.key) return d;
      known += (known.empty() ? "" : ", ") + rules_.disciplines[d].name;
    }
    reading_.fault(
        entry.at, "no discipline is called '" + entry.key + "'",
        known.empty() ? "write [[discipline]] with its name" : "the disciplines are " + known);
    return std::nullopt;
  }

  void matrix() {
    const Value* const value = top_.table("matrix");
    if (value == nullptr) {
      if (!rules_.disciplines.empty() && reading_.good())
        reading_.fault(top_.value("discipline")->at, "disciplines without a matrix do nothing",
                       "add [matrix], which may be empty");
      return;
    }
    TableReader table(reading_, *value, "[matrix]");
    if (rules_.disciplines.empty())
      reading_.fault(value->at, "a matrix without disciplines", "write [[discipline]] tables");
    TestRule test = plain_test(table.text("name").value_or("matrix"));
    claim(test.name, value->at, test_names_);
    common(table, test);
    test.matrix = true;
    MatrixRule& matrix = rules_.matrix.emplace();
    constexpr std::array kWords{kChecked, kNotChecked};
    matrix.missing_checked =
        table.word("missing", kWords).value_or(std::string(kChecked)) == kChecked;
    const Value* const rows = table.table("cells");
    if (rows != nullptr) {
      TableReader reader(reading_, *rows, "[matrix.cells]");
      for (const KeyValue* row : reader.others()) matrix_row(*row, test.tolerances);
    }
    rules_.tests.push_back(std::move(test));
    rule_names_.emplace_back(kMatrixRule);
  }

  void matrix_row(const KeyValue& row, const ToleranceRule& base) {
    const auto a = discipline(row);
    if (!a) return;
    TableReader reader(reading_, row.value, "[matrix.cells." + row.key + "]");
    for (const KeyValue* column : reader.others()) {
      const auto b = discipline(*column);
      if (!b) return;
      if (!cells_.emplace(std::minmax(*a, *b)).second)
        reading_.fault(column->at,
                       "the cell of '" + row.key + "' and '" + column->key + "' is given twice",
                       "leave one out: the matrix is symmetric");
      rules_.matrix->cells.push_back(cell(*a, *b, *column, base));
    }
  }

  CellRule cell(std::uint32_t a, std::uint32_t b, const KeyValue& entry,
                const ToleranceRule& base) {
    CellRule rule{a, b, true, {}};
    const std::string what = "the cell '" + entry.key + "'";
    const auto* const word = std::get_if<std::string>(&entry.value.held);
    if (word != nullptr && (*word == kChecked || *word == kNotChecked)) {
      rule.checked = *word == kChecked;
    } else if (std::holds_alternative<Table>(entry.value.held)) {
      TableReader table(reading_, entry.value, what);
      ToleranceRule own = base;
      if (tolerances(table, own)) rule.tolerances = own;
    } else {
      reading_.fault(entry.value.at, what + " is no rule for a pair of disciplines",
                     "write \"checked\", \"not checked\" or { clearance = \"25mm\" }");
    }
    return rule;
  }

  /// Reads what [matrix] and [[test]] have in common.
  void common(TableReader& table, TestRule& test) {
    test.enabled = table.flag("enabled").value_or(true);
    tolerances(table, test.tolerances);
    if (const auto distance = table.tolerance_mm("contact_distance"))
      test.contact_distance_mm = *distance;
    read_reporting(reading_, table, test.reporting);
    test.without = table.texts("without");
    without_at_.emplace_back(test.without, table.at());
  }

  void test(const Value& value) {
    TableReader table(reading_, value, "[[test]]");
    TestRule test = plain_test(new_name(table, test_names_));
    common(table, test);
    test.a = sets_.chooser(table, "a");
    test.b = sets_.chooser(table, "b");
    rules_.tests.push_back(std::move(test));
  }

  /// Reads the name and the `among` of a rule that exempts; `rule` is filled in by the caller.
  ExemptingRule& exempting(TableReader& table) {
    ExemptingRule& rule = rules_.exempting.emplace_back();
    rule.name = new_name(table, rule_names_);
    rule.where = place(table.at()) + ": " + table.what();
    rule.among = sets_.chooser(table, "among");
    return rule;
  }

  void units() {
    const Value* const value = top_.table("unit_groups");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[unit_groups]");
    ExemptingRule& rule = rules_.exempting.emplace_back();
    rule.name = table.text("name").value_or("unit groups");
    claim(rule.name, value->at, rule_names_);
    rule.where = place(value->at) + ": [unit_groups]";
    UnitRule units;
    units.attribute = table.text("attribute").value_or("");
    for (const Value* group : table.tables("group")) {
      TableReader inner(reading_, *group, "[[unit_groups.group]]");
      const auto number = inner.whole("number");
      if (!number)
        reading_.fault(group->at, inner.what() + " has no 'number'",
                       "write number = 7; a negative one is no unit");
      inner.call(std::to_string(number.value_or(-1)));
      if (auto select = sets_.required(inner, "select"))
        units.groups.push_back({number.value_or(-1), std::move(*select)});
    }
    if (units.attribute.empty() && units.groups.empty())
      reading_.fault(value->at, "[unit_groups] says no unit of anything",
                     "write attribute = \"NAME\", or [[unit_groups.group]] tables");
    rule.rule = std::move(units);
  }

  void assembly(const Value& value) {
    TableReader table(reading_, value, "[[same_assembly]]");
    ExemptingRule& rule = exempting(table);
    AssemblyRule assembly;
    const auto group = table.text("group");
    assembly.group = group.value_or("");
    const Value* const level = table.value("level");
    if (level != nullptr) {
      const auto* const number = std::get_if<std::int64_t>(&level->held);
      const auto* const word = std::get_if<std::string>(&level->held);
      assembly.parent = word != nullptr && *word == "parent";
      assembly.by_type = word != nullptr && *word == "assembly";
      const bool deep =
          number != nullptr && *number >= 1 && *number <= std::numeric_limits<std::int32_t>::max();
      if (deep) assembly.level = static_cast<std::uint32_t>(*number);
      if (!deep && !assembly.parent && !assembly.by_type)
        reading_.fault(level->at, "'level' of [[same_assembly]] is no level of the hierarchy",
                       "write level = 1 for the outermost group, 2 for the next, \"parent\", or "
                       "\"assembly\" for the equipment, structure or branch");
    }
    if ((level == nullptr) == assembly.group.empty())
      reading_.fault(value.at, "[[same_assembly]] takes either 'level' or 'group'",
                     "write level = 3, level = \"parent\" or group = \"EQUIP*\"");
    assembly.across_files = table.flag("across_files").value_or(false);
    rule.rule = std::move(assembly);
  }

  void connected(const Value& value) {
    TableReader table(reading_, value, "[[connected]]");
    ExemptingRule& rule = exempting(table);
    if (const auto within = ends_within(table)) {
      rule.rule = EndsRule{*within};
      return;
    }
    ConnectedRule connected;
    struct ReferenceKey {
      std::string_view name;
      ReferenceEnd end;
    };
    bool of_an_end = false;
    for (const ReferenceKey& key :
         {ReferenceKey{"attributes", ReferenceEnd::either},
          ReferenceKey{"head", ReferenceEnd::head}, ReferenceKey{"tail", ReferenceEnd::tail}})
      for (std::string& attribute : table.texts(key.name)) {
        of_an_end = of_an_end || key.end != ReferenceEnd::either;
        connected.references.push_back({std::move(attribute), key.end});
      }
    if (connected.references.empty())
      reading_.fault(value.at, "[[connected]] names no attributes",
                     "write head = \"HREF\" and tail = \"TREF\", or attributes = [\"CREF\"], or "
                     "ends_within = \"5mm\"");
    constexpr std::array<std::string_view, 2> kWords{"partner", "node"};
    connected.node = table.word("by", kWords).value_or("partner") == "node";
    constexpr std::array<std::string_view, 3> kHeirs{"none", "ends", "all"};
    const std::string heirs = table.word("inherited", kHeirs).value_or("ends");
    connected.heirs = heirs == "none" ? Heirs::none : heirs == "all" ? Heirs::all : Heirs::ends;
    if (of_an_end && connected.heirs != Heirs::ends)
      reading_.fault(value.at, "'head' and 'tail' of [[connected]] are about the ends of a branch",
                     "leave 'inherited' out, or write attributes = [\"HREF\", \"TREF\"]");
    connected.groups = table.flag("groups").value_or(false);
    connected.separator = table.text("separator").value_or("");
    rule.rule = std::move(connected);
  }

  /// Reads how near ends have to be to each other, if the rule goes by ends.
  std::optional<double> ends_within(TableReader& table) {
    const Value* const value = table.value("ends_within");
    if (value == nullptr) return std::nullopt;
    const double within = table.length_mm(*value, "ends_within").value_or(0);
    if (within < 0 || within > kFarthestEndsMm)
      reading_.fault(value->at,
                     "'ends_within' of " + table.what() + " is " +
                         (within < 0 ? "negative" : "more than a metre"),
                     "write how far apart the ends of a joint are at most, from 0 to 1m, as "
                     "\"5mm\"");
    for (const std::string_view key :
         {"attributes", "head", "tail", "by", "inherited", "groups", "separator"})
      if (table.value(key) != nullptr)
        reading_.fault(value->at,
                       "'ends_within' and '" + std::string(key) + "' in one [[connected]]",
                       "write two tables, each with a name: the one goes by ends, the other by "
                       "attributes");
    return within;
  }

  void same_attribute(const Value& value) {
    TableReader table(reading_, value, "[[same_attribute]]");
    ExemptingRule& rule = exempting(table);
    rule.rule = AttributeRule{table.required_text("attribute")};
  }

  void exempt(const Value& value) {
    TableReader table(reading_, value, "[[exempt]]");
    const std::string name = new_name(table, rule_names_);
    auto a = sets_.required(table, "a"), b = sets_.required(table, "b");
    if (a && b)
      rules_.exempting.push_back({name,
                                  place(value.at) + ": " + table.what(),
                                  {},
                                  ExemptRule{std::move(*a), std::move(*b)}});
  }

  void obstruction() {
    const Value* const value = top_.table("obstruction");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[obstruction]");
    ObstructionRule& rule = rules_.obstruction.emplace();
    if (auto attributes = table.texts("attribute"); !attributes.empty())
      rule.attributes = std::move(attributes);
    constexpr std::array<std::string_view, 3> kWords{"soft", "hard", "none"};
    const std::string bodies = table.word("volumes", kWords).value_or("soft");
    rule.bodies = bodies == "hard" ? Level::hard : bodies == "none" ? Level::none : Level::soft;
    rule.soft_against_soft = table.flag("soft_against_soft").value_or(true);
    rule.soft = sets_.chooser(table, "soft");
    rule.none = sets_.chooser(table, "none");
    rule.hard = sets_.chooser(table, "hard");
    for (const std::string_view name : {kNoObstructionRule, kSoftRule})
      claim(std::string(name), value->at, rule_names_);
  }

  void insulation() {
    const Value* const value = top_.table("insulation");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[insulation]");
    InsulationRule& rule = rules_.insulation.emplace();
    rule.against_insulation = table.flag("against_insulation").value_or(true);
    rule.against_soft = table.flag("against_soft").value_or(true);
    rule.select = sets_.chooser(table, "select");
    for (const std::string_view name : {kInsulationRule, kInsulationSoftRule})
      claim(std::string(name), value->at, rule_names_);
  }

  void allowed(const Value& value) {
    TableReader table(reading_, value, "[[allowed]]");
    const std::string name = new_name(table, rule_names_);
    auto a = sets_.required(table, "a"), b = sets_.required(table, "b");
    std::optional<double> depth;
    const Value* const deepest = table.value("max_depth");
    const auto* const any = deepest != nullptr ? std::get_if<std::string>(&deepest->held) : nullptr;
    if (any != nullptr && *any == "any")
      depth = std::numeric_limits<double>::infinity();
    else if (deepest != nullptr)
      depth = table.tolerance_mm("max_depth");
    const clash::RelationSet relations = read_relations(reading_, table, "relation");
    const std::optional<double> volume = table.volume_mm3("max_volume");
    // A relation or a volume says what is meant of a hit, however deep it is.
    if (deepest == nullptr && (!relations.empty() || volume))
      depth = std::numeric_limits<double>::infinity();
    auto box = region(table);
    auto planes = cavity(table);
    if (a && b)
      rules_.allowed.push_back({name, place(value.at) + ": " + table.what(), std::move(*a),
                                std::move(*b), box, std::move(planes), depth, relations, volume});
  }

  std::optional<geometry::Box3d> region(TableReader& outer) {
    const Value* const value = outer.table("region");
    if (value == nullptr) return std::nullopt;
    TableReader table(reading_, *value, "'region' of [[allowed]]");
    const auto lo = table.point_mm("min"), hi = table.point_mm("max");
    if (!lo || !hi) {
      reading_.fault(value->at, "'region' wants both corners of its box",
                     "write region = { min = [\"0m\", \"0m\", \"0m\"], max = [...] }");
      return std::nullopt;
    }
    const geometry::Box3d box{*lo, *hi};
    if (!(lo->x <= hi->x && lo->y <= hi->y && lo->z <= hi->z))
      reading_.fault(value->at, "'region' ends before it begins", "put the smaller numbers in min");
    return box;
  }

  std::vector<clash::HalfSpace> cavity(TableReader& outer) {
    std::vector<clash::HalfSpace> planes;
    for (const Value* value : outer.tables("cavity")) {
      TableReader table(reading_, *value, "'cavity' of [[allowed]]");
      const auto point = table.point_mm("point");
      const auto normal = table.direction("normal");
      if (point && normal)
        planes.push_back({*point, *normal});
      else
        reading_.fault(value->at, "a plane of a cavity wants a point and a normal",
                       "write { point = [\"0m\", \"0m\", \"3m\"], normal = [0, 0, 1] }");
    }
    return planes;
  }

 public:
  /// Checks, once all rules are read, that what tests leave out exists.
  void check_without() {
    for (const auto& [names, at] : without_at_)
      for (const std::string& name : names)
        if (name == kMatrixRule ||
            std::find(rule_names_.begin(), rule_names_.end(), name) == rule_names_.end()) {
          std::string known;
          for (const std::string& rule : rule_names_)
            if (rule != kMatrixRule) known += (known.empty() ? "" : ", ") + rule;
          reading_.fault(at, "'without' names a rule '" + name + "' that is not there",
                         known.empty() ? "there are no rules" : "the rules are " + known);
        }
  }

 private:
  ParseContext& reading_;
  TableReader top_;
  NamedSets sets_;
  RuleFile rules_;
  ToleranceRule defaults_;
  double contact_distance_mm_ = -1;
  clash::Reporting reporting_;
  std::vector<std::string> rule_names_, test_names_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> cells_;  ///< cells of the matrix that are given
  std::vector<std::pair<std::vector<std::string>, SourcePosition>> without_at_;
};

}  // namespace

Result<RuleFile> parse_rules(std::string_view text, std::string_view file) {
  const Result<Value> document = settings::parse_toml(text, file);
  if (!document) return document.error();
  ParseContext reading{std::string(file)};
  RuleFile rules;
  {
    RulesParser parser(reading, *document);
    rules = parser.run();
    parser.check_without();
  }  // the parser, as it ends, refuses keys that were not read
  if (!reading.good()) return reading.error();
  return rules;
}

}  // namespace strake::rules
