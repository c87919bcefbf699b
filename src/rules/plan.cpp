// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "rules/clearances.hpp"
#include "rules/exemptions.hpp"
#include "rules/levels.hpp"
#include "rules/object_facts.hpp"
#include "rules/rule_context.hpp"
#include "rules/rule_file.hpp"
#include "settings/text_file.hpp"
#include "strake/rules/rules.hpp"

namespace strake::rules {
namespace {

using clash::kNoLabel;
using clash::Level;

/// Works the rules out for a scene once; each test takes those that it follows.
class PlanBuilder {
 public:
  PlanBuilder(const RuleFile& rules, const model::Scene& scene, ObjectFacts facts,
              const parallel::Context& context)
      : rules_(rules), rule_context_(scene, choosers_of(rules), std::move(facts), context) {}

  Result<Plan> run() {
    for (const NamedSet& set : rules_.sets) rule_context_.pick(set.chooser);
    Plan plan;
    for (const ExemptingRule& rule : rules_.exempting)
      watch(plan, rule, [&] { exemptions_.push_back(exemption_of(rule, rule_context_)); });
    levels_ = levels_of(rules_, rule_context_);
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
    planned.options.tolerances = tolerances(test.tolerances);
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

  /// Returns tolerances with what objects add to the clearance, which is read once for each
  /// attribute.
  clash::Tolerances tolerances(const ToleranceRule& rule) {
    clash::Tolerances tolerances = rule.of_all;
    if (rule.clearance_attribute.empty()) return tolerances;
    auto& read = object_clearances_[rule.clearance_attribute];
    if (!read)
      read = object_clearances(rule_context_.model(), rule.clearance_attribute,
                               rule.clearance_where, rule_context_.diagnostics());
    tolerances.object_clearances = read;
    return tolerances;
  }

  void add_matrix(PlannedTest& planned) {
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
        planned.policy.tolerances.push_back(tolerances(*cell.tolerances));
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
  std::map<std::string, std::shared_ptr<const clash::ObjectClearances>> object_clearances_;
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

std::span<const FileSettings> Rules::files() const { return file_->files; }

Result<Rules> Rules::read(const std::filesystem::path& file) {
  const Result<std::string> text =
      settings::read_text_file(file, "rules file", "; models come before --rules");
  if (!text) return text.error();
  return parse(*text, file.filename().string());
}

model::SceneOptions Rules::scene_options() const {
  model::SceneOptions options;
  bool first = true;
  const auto refine = [&](const ToleranceRule& rule) {
    const double sag = clash::scene_options({.tolerances = rule.of_all}).sag_mm;
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
  ObjectFacts facts;
  auto picked = picked_by(choosers_of(*file_), scene, context);
  if (!picked) return picked.error();
  facts.picked = std::move(*picked);
  detect_categories(*scene.model, facts);
  return plan(scene, std::move(facts), context);
}

Result<Plan> Rules::plan(const model::Scene& scene, ObjectFacts facts,
                         const parallel::Context& context) const {
  return PlanBuilder(*file_, scene, std::move(facts), context).run();
}

}  // namespace strake::rules
