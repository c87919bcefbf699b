// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "model/attributes.hpp"
#include "rules/exemptions.hpp"
#include "rules/rule_context.hpp"
#include "rules/rule_file.hpp"
#include "settings/text_file.hpp"
#include "strake/rules/rules.hpp"

namespace strake::rules {
namespace {

using clash::kNoLabel;
using clash::Level;
using model::is_null_value;
using model::unquoted;

/// Returns the level that an attribute's value states; none where it states something else.
std::optional<Level> level_of(std::string_view value) {
  constexpr std::array<std::pair<std::string_view, Level>, 6> kWords{{{"0", Level::none},
                                                                      {"1", Level::soft},
                                                                      {"2", Level::hard},
                                                                      {"NONE", Level::none},
                                                                      {"SOFT", Level::soft},
                                                                      {"HARD", Level::hard}}};
  std::string upper(value);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  for (const auto& [word, level] : kWords)
    if (upper == word) return level;
  return std::nullopt;
}

/// Returns "'OBST' or 'Obstruction'".
std::string alternatives(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : " or '") + name + "'";
  return text;
}

/// Works the rules out for a scene once; each test takes those that it follows.
class PlanBuilder {
 public:
  PlanBuilder(const RuleFile& rules, const model::Scene& scene, const parallel::Context& context)
      : rules_(rules), rule_context_(scene, choosers_of(rules), context) {}

  Result<Plan> run() {
    for (const NamedSet& set : rules_.sets) rule_context_.pick(set.chooser);
    Plan plan;
    for (const ExemptingRule& rule : rules_.exempting)
      watch(plan, rule, [&] { exemptions_.push_back(exemption_of(rule, rule_context_)); });
    make_levels();
    for (const AllowedRule& rule : rules_.allowed)
      watch(plan, rule, [&] {
        allowed_.push_back({rule.name, rule_context_.pick(rule.a), rule_context_.pick(rule.b),
                            rule.region_mm, rule.cavity, rule.max_depth_mm, rule.relations,
                            rule.max_volume_mm3});
      });
    make_disciplines();
    for (const TestRule& test : rules_.tests)
      if (test.enabled) plan.tests.push_back(planned(test));
    if (rule_context_.error()) return *rule_context_.error();
    plan.diagnostics = std::move(rule_context_.diagnostics());
    return plan;
  }

 private:
  /// Works a rule out. One that matches objects is watched for whether it concerns a pair of them;
  /// the exemption of pairs within a file is a setting rather than a rule.
  template <class Rule, class Work>
  void watch(Plan& plan, const Rule& rule, Work&& work) {
    const std::uint64_t idle = rule_context_.idle();
    work();
    if constexpr (std::is_same_v<Rule, ExemptingRule>)
      if (std::holds_alternative<FileRule>(rule.rule)) return;
    if (rule_context_.idle() == idle) plan.watched.push_back({rule.name, rule.where});
  }

  void make_levels() {
    if (!rules_.obstruction && !rules_.insulation) return;
    clash::Levels& levels = levels_.emplace();
    levels.object.assign(rule_context_.objects(), Level::hard);
    levels.no_obstruction_rule = std::string(kNoObstructionRule);
    const auto leave_out = [&](Level a, Level b, std::string_view rule) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      levels.left_out[i][j] = levels.left_out[j][i] = rule;
    };
    if (rules_.obstruction) {
      levels.obstruction_bodies = rules_.obstruction->bodies;
      read_levels(*rules_.obstruction, levels.object);
      if (!rules_.obstruction->soft_against_soft) leave_out(Level::soft, Level::soft, kSoftRule);
    } else {
      levels.obstruction_bodies = Level::hard;
    }
    if (!rules_.insulation) return;
    if (std::ranges::none_of(rule_context_.model().bodies, [](const model::Body& body) {
          return body.category == model::Category::insulation;
        }))
      rule_context_.warn_no_match(rules_.file + ": [insulation]", "no object has insulation");
    if (!rules_.insulation->against_insulation)
      leave_out(Level::insulation, Level::insulation, kInsulationRule);
    if (!rules_.insulation->against_soft)
      leave_out(Level::insulation, Level::soft, kInsulationSoftRule);
  }

  /// Returns the level that the first of some attributes gives an object, hard with a warning where
  /// that has no meaning; nothing where the object has none of them.
  std::optional<Level> stated_level(const model::Object& object,
                                    const std::vector<std::string>& attributes) {
    for (const std::string& attribute : attributes) {
      const model::Attributes* const stated =
          rule_context_.model().stated(object, attribute).attributes;
      if (stated == nullptr) continue;
      for (const auto& [name, text] : *stated) {
        if (name != attribute) continue;
        // "none" is a level here, where other attributes have no value.
        const auto level = level_of(unquoted(text));
        if (level) return level;
        if (is_null_value(unquoted(text))) continue;
        rule_context_.diagnostics().add(Severity::warning, "obstruction-not-known",
                                        "the attribute '" + name + "' is '" + text +
                                            "', not 0, 1 or 2; the object counts as hard",
                                        object.id);
        return Level::hard;
      }
    }
    return std::nullopt;
  }

  void read_levels(const ObstructionRule& rule, std::vector<Level>& levels) {
    bool some = rule.soft.has_value() || rule.none.has_value();
    for (std::size_t o = 0; o < levels.size(); ++o) {
      const model::Object& object = rule_context_.model().objects[o];
      for (const model::Body& body :
           std::span(rule_context_.model().bodies).subspan(object.first_body, object.body_count))
        some = some || body.category == model::Category::obstruction;
      const auto stated = stated_level(object, rule.attributes);
      some = some || stated;
      if (stated) levels[o] = *stated;
    }
    if (!some)
      rule_context_.warn_no_match(rules_.file + ": [obstruction]",
                                  "no object has the attribute " + alternatives(rule.attributes) +
                                      " and there are no obstruction volumes");
    apply(rule.soft, Level::soft, levels);
    apply(rule.none, Level::none, levels);
    if (!rule.soft || !rule.none) return;
    const std::vector<bool> soft = rule_context_.peek(*rule.soft),
                            none = rule_context_.peek(*rule.none);
    rule_context_.check_shadow(
        soft, [&](std::size_t o) { return !none[o]; }, rule.soft->where,
        "every object that it picks is one of 'none'");
  }

  void apply(const std::optional<Chooser>& chooser, Level level, std::vector<Level>& levels) {
    if (!chooser) return;
    const std::vector<bool> picked = rule_context_.pick(*chooser);
    for (std::size_t o = 0; o < levels.size(); ++o)
      if (picked[o]) levels[o] = level;
  }

  /// Makes the disciplines. An object counts for the first that picks it; how often others pick it
  /// too is reported.
  void make_disciplines() {
    discipline_.assign(rule_context_.objects(), kNoLabel);
    for (std::uint32_t d = 0; d < rules_.disciplines.size(); ++d) {
      const std::vector<bool> picked = rule_context_.pick(rules_.disciplines[d].chooser);
      rule_context_.check_shadow(
          picked, [&](std::size_t o) { return discipline_[o] == kNoLabel; },
          rules_.disciplines[d].chooser.where,
          "every object that it picks counts for an earlier discipline");
      std::map<std::uint32_t, std::uint64_t> taken;  // by earlier disciplines
      for (std::size_t o = 0; o < picked.size(); ++o) {
        if (!picked[o]) continue;
        if (discipline_[o] == kNoLabel)
          discipline_[o] = d;
        else
          ++taken[discipline_[o]];
      }
      for (const auto& [earlier, count] : taken)
        rule_context_.diagnostics().add(
            Severity::note, "in-several-disciplines",
            std::to_string(count) + (count == 1 ? " object counts" : " objects count") + " for '" +
                rules_.disciplines[earlier].name + "', which comes first",
            rules_.disciplines[d].chooser.where);
    }
    const auto none = std::count(discipline_.begin(), discipline_.end(), kNoLabel);
    if (rules_.matrix && none > 0)
      rule_context_.diagnostics().add(Severity::warning, "in-no-discipline",
                                      std::to_string(none) +
                                          (none == 1 ? " object is" : " objects are") +
                                          " of no discipline and not checked by the matrix",
                                      rules_.file + ": [[discipline]]");
  }

  PlannedTest planned(const TestRule& test) {
    PlannedTest planned;
    planned.name = test.name;
    planned.options.tolerances = test.tolerances;
    planned.options.contact_distance_mm = test.contact_distance_mm;
    planned.options.reporting = test.reporting;
    planned.policy = policy(test);
    if (test.matrix) {
      add_matrix(planned);
      return planned;
    }
    planned.sets.in_a = rule_context_.pick(test.a);
    planned.sets.in_b = rule_context_.pick(test.b);
    if (test.a) planned.sets.name_a = test.a->selection.text();
    if (test.b) planned.sets.name_b = test.b->selection.text();
    return planned;
  }

  [[nodiscard]] clash::Policy policy(const TestRule& test) const {
    const auto follows = [&](std::string_view rule) {
      return std::find(test.without.begin(), test.without.end(), rule) == test.without.end();
    };
    clash::Policy policy;
    for (const clash::Exemption& e : exemptions_)
      if (follows(e.rule)) policy.exemptions.push_back(e);
    for (const clash::Allowed& a : allowed_)
      if (follows(a.rule)) policy.allowed.push_back(a);
    policy.levels = levels_;
    if (!policy.levels) return policy;
    for (auto& row : policy.levels->left_out)
      for (std::string& rule : row)
        if (!follows(rule)) rule.clear();
    if (!follows(kNoObstructionRule))
      std::replace(policy.levels->object.begin(), policy.levels->object.end(), Level::none,
                   Level::hard);
    return policy;
  }

  void add_matrix(PlannedTest& planned) const {
    clash::Matrix matrix;
    matrix.rule = std::string(kMatrixRule);
    const std::size_t n = rules_.disciplines.size();
    for (const NamedSet& d : rules_.disciplines) matrix.disciplines.push_back(d.name);
    matrix.discipline = discipline_;
    matrix.cells.assign(n * n, rules_.matrix->missing_checked ? clash::Matrix::kDefault
                                                              : clash::Matrix::kNotChecked);
    for (const CellRule& cell : rules_.matrix->cells) {
      std::uint32_t value = clash::Matrix::kDefault;
      if (!cell.checked) value = clash::Matrix::kNotChecked;
      if (cell.tolerances) {
        value = static_cast<std::uint32_t>(planned.policy.tolerances.size());
        planned.policy.tolerances.push_back(*cell.tolerances);
      }
      matrix.cells[cell.a * n + cell.b] = matrix.cells[cell.b * n + cell.a] = value;
    }
    planned.policy.matrix = std::move(matrix);
    planned.sets.in_a.resize(discipline_.size());
    for (std::size_t o = 0; o < discipline_.size(); ++o)
      planned.sets.in_a[o] = discipline_[o] != kNoLabel;
    planned.sets.in_b = planned.sets.in_a;
    planned.sets.name_a = planned.sets.name_b = "the disciplines";
  }

  const RuleFile& rules_;
  RuleContext rule_context_;
  std::vector<clash::Exemption> exemptions_;
  std::vector<clash::Allowed> allowed_;
  std::optional<clash::Levels> levels_;
  std::vector<std::uint32_t> discipline_;
};

}  // namespace

Result<Rules> Rules::parse(std::string_view text, std::string_view file) {
  Result<RuleFile> parsed = parse_rules(text, file);
  if (!parsed) return parsed.error();
  parsed->hash = hash_bytes(std::as_bytes(std::span(text)));
  return Rules(std::make_shared<const RuleFile>(std::move(*parsed)));
}

const std::string& Rules::file() const { return file_->file; }

Hash128 Rules::hash() const { return file_->hash; }

Result<Rules> Rules::read(const std::filesystem::path& file) {
  const Result<std::string> text =
      settings::read_text_file(file, "rules file", "; models come before --rules");
  if (!text) return text.error();
  return parse(*text, file.filename().string());
}

model::SceneOptions Rules::scene_options() const {
  model::SceneOptions options;
  bool first = true;
  const auto refine = [&](const clash::Tolerances& t) {
    const double sag = clash::scene_options({.tolerances = t}).sag_mm;
    options.sag_mm = first ? sag : std::min(options.sag_mm, sag);
    first = false;
  };
  for (const TestRule& test : file_->tests)
    if (test.enabled) refine(test.tolerances);
  if (file_->matrix)
    for (const CellRule& cell : file_->matrix->cells)
      if (cell.tolerances) refine(*cell.tolerances);
  options.obstruction = file_->obstruction && file_->obstruction->bodies != Level::none;
  options.insulation = file_->insulation.has_value();
  return options;
}

Result<Plan> Rules::plan(const model::Scene& scene, const parallel::Context& context) const {
  return PlanBuilder(*file_, scene, context).run();
}

}  // namespace strake::rules
