// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/clash/policy.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

/// A rules file describes several clash tests of one run, with what is exempted and what is meant.
///
///     const auto rules = rules::Rules::read("rules.toml");
///     const auto scene = model::make_scene(model, rules->scene_options(), context);
///     const auto plan = rules->plan(*scene, context);
///     for (const rules::PlannedTest& test : plan->tests)
///       clash::detect(*scene, test.sets, test.options, test.policy, context);
///
/// docs/rules.md defines the language.
namespace strake::rules {

struct RuleFile;
struct ObjectFacts;

/// What a rules file says of files of the model, as `--unit` and `--up-axis` do.
struct FileSettings {
  std::string name;  ///< a pattern of names; one with '/' is of names with as many of their folders
  std::optional<double> unit_mm;
  std::optional<char> up_axis;  ///< 'x', 'y' or 'z'
  std::string where;            ///< what messages call its line

  /// Whether it is about a file, by its path from the root.
  [[nodiscard]] bool is_of(const std::filesystem::path& file) const;
};

/// A test, worked out for a scene.
struct PlannedTest {
  std::string name;
  clash::Options options;
  clash::Sets sets;
  clash::Policy policy;
};

/// A rule and what messages call the line it stands in: "steel.toml, line 7: [[exempt]] 'hull'".
struct WatchedRule {
  std::string name, where;
};

struct Plan {
  std::vector<PlannedTest> tests;  ///< the enabled tests, in the order of the file
  /// The codes are "rule-matches-nothing" (a rule or a set, by name), "rule-shadowed" (it picks
  /// objects, but earlier ones leave it none), "in-several-disciplines", "in-no-discipline",
  /// "unit-not-a-number", "obstruction-not-known", "clearance-not-a-length",
  /// "clearance-attribute-missing".
  Diagnostics diagnostics;
  /// The rules that exempt or allow, and match objects; idle_rules() tells which of them do
  /// nothing.
  std::vector<WatchedRule> watched = {};
};

/// Reports, once its tests have run, the rules of a plan that did nothing in any of them:
/// "rule-matches-nothing" where they concern no pair of objects within reach of each other,
/// "rule-shadowed" where an earlier rule took or allowed whatever they would.
[[nodiscard]] Diagnostics idle_rules(const Plan& plan, std::span<const clash::Report> tests);

/// A rules file, parsed but not yet applied to a model. It is immutable and cheap to copy.
class Rules {
 public:
  /// Parses a rules file; `file` is what errors and diagnostics call it.
  ///
  /// Errors: input, with line and column, what is wrong there and how to mend it. Keys that are not
  /// known, wrong types, names given twice and sets that need themselves are errors.
  [[nodiscard]] static Result<Rules> parse(std::string_view text, std::string_view file);
  [[nodiscard]] static Result<Rules> read(const std::filesystem::path& file);

  /// What parse() was told to call the file, and the hash of its bytes: results name the rules by
  /// both.
  [[nodiscard]] const std::string& file() const;
  [[nodiscard]] Hash128 hash() const;

  /// Returns what is said of files, which is to be applied before they are read. Where several
  /// tables are about a file, the first that says a unit or an axis counts for it.
  [[nodiscard]] std::span<const FileSettings> files() const;

  /// Returns what the scene must hold for all tests: the finest tessellation that one of them
  /// needs, and the categories of bodies that a rule speaks of.
  [[nodiscard]] model::SceneOptions scene_options() const;

  /// Evaluates every selection for every object of the scene, once. Errors: cancelled.
  [[nodiscard]] Result<Plan> plan(const model::Scene& scene,
                                  const parallel::Context& context) const;

  /// Returns what plan() looks up in geometry, of each object by itself: of a model too large to be
  /// held it can be gathered piece by piece. Errors: cancelled.
  [[nodiscard]] Result<ObjectFacts> facts(const model::Scene& scene,
                                          const parallel::Context& context) const;
  /// Plans by facts of all objects; the scene needs no bodies. Errors: cancelled.
  [[nodiscard]] Result<Plan> plan(const model::Scene& scene, ObjectFacts facts,
                                  const parallel::Context& context) const;

 private:
  explicit Rules(std::shared_ptr<const RuleFile> file) : file_(std::move(file)) {}
  std::shared_ptr<const RuleFile> file_;
};

}  // namespace strake::rules
