// SPDX-License-Identifier: Apache-2.0
// A row of cubes that clash with their neighbours, and what a rules file makes of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/rules/rules.hpp"
#include "support/clash_model.hpp"

namespace strake::test {

using ResultLines = std::vector<std::string>;
using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

/// What a rules file makes of a model.
struct RulesOutcome {
  std::vector<clash::Report> reports;
  Diagnostics diagnostics;
  std::vector<ResultLines> reported;  ///< per test: "a-b HIT", "a-b HIT by RULE"
};

/// "a-b HIT" for each pair of a report, "a-b HIT by RULE" for one that is allowed.
inline ResultLines lines_of(const model::Model& model, const clash::Report& report) {
  ResultLines all;
  for (const clash::Pair& p : report.pairs) {
    all.push_back(model.object(p.a).id + "-" + model.object(p.b).id + " " +
                  std::string(name(p.cls)));
    if (p.allowed >= 0)
      all.back() += " by " + report.allowed[static_cast<std::size_t>(p.allowed)].rule;
  }
  return all;
}

inline RulesOutcome run_rules(const model::Model& model, std::string_view text,
                              const parallel::Context& context = {}) {
  const auto parsed = rules::Rules::parse(text, "r.toml");
  if (!parsed) {
    ADD_FAILURE() << parsed.error().text();
    return {};
  }
  const auto scene = make_scene(model, parsed.value().scene_options(), context).value();
  const rules::Plan plan = parsed.value().plan(scene, context).value();
  RulesOutcome outcome;
  for (const rules::PlannedTest& test : plan.tests) {
    auto report = clash::detect(scene, test.sets, test.options, test.policy, context).value();
    report.name = test.name;
    outcome.reported.push_back(lines_of(model, report));
    outcome.reports.push_back(std::move(report));
  }
  outcome.diagnostics = plan.diagnostics;
  outcome.diagnostics.append(rules::idle_rules(plan, outcome.reports));
  return outcome;
}

/// Cubes of side 100 in a row, each 10 into the next, in groups of a hierarchy.
class Row {
 public:
  Row() { m_.model.files.push_back({"u.obj", "OBJ", "mm", "z", 1, 0}); }

  Row& cube(const std::string& id, model::Attributes attributes = {},
            model::GroupId parent = model::GroupId::none, std::uint32_t file = 0) {
    const double x = 90.0 * static_cast<double>(m_.model.objects.size());
    m_.box(id, {x, 0, 0}, {x + 100, 100, 100});
    model::Object& object = m_.model.objects.back();
    object.attributes = std::move(attributes);
    object.parent = parent;
    object.file = file;
    return *this;
  }
  Row& category(model::Category category) {
    m_.model.bodies.back().category = category;
    return *this;
  }
  model::GroupId group(const std::string& name, model::GroupId parent = model::GroupId::none) {
    m_.model.groups.push_back({name, parent});
    return model::GroupId{static_cast<std::uint32_t>(m_.model.groups.size() - 1)};
  }
  model::GroupId group(const std::string& name, model::Attributes attributes) {
    const model::GroupId made = group(name);
    m_.model.set_attributes(made, std::move(attributes));
    return made;
  }

  using Outcome = RulesOutcome;
  [[nodiscard]] Outcome run(std::string_view text, const parallel::Context& context = {}) const {
    return run_rules(m_.model, text, context);
  }
  /// What the only test finds.
  [[nodiscard]] ResultLines hits(std::string_view text) const {
    const Outcome outcome = run(text);
    return outcome.reported.size() == 1 ? outcome.reported[0] : ResultLines{"no single test"};
  }

 private:
  ClashModel m_;
};

inline Counts exempted(const clash::Report& report) {
  Counts all;
  for (const clash::Exempted& e : report.exempted) all.emplace_back(e.rule, e.pairs);
  return all;
}
/// The diagnostics of a code, one a line.
inline std::string warned(const Diagnostics& diagnostics, std::string_view code) {
  std::string all;
  for (const Diagnostic& d : diagnostics.kept())
    if (d.code == code) all += d.where + ": " + d.message + "\n";
  return all;
}
/// That what was warned of are these lines and no others.
inline void expect_lines(const std::string& all, std::initializer_list<std::string_view> lines) {
  for (const std::string_view line : lines)
    EXPECT_NE(all.find(line), std::string::npos) << line << "in\n" << all;
  EXPECT_EQ(static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n')), lines.size())
      << all;
}

}  // namespace strake::test
