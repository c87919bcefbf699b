// SPDX-License-Identifier: Apache-2.0
#include "rules/levels.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/attributes.hpp"

namespace strake::rules {
namespace {

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

/// A selection that gives objects a level, and the key that it stands at.
struct LevelChoice {
  const Chooser* chooser;
  Level level;
  std::string_view key;
};

class LevelBuilder {
 public:
  LevelBuilder(const RuleFile& rules, RuleContext& rule_context)
      : rules_(rules), rule_context_(rule_context) {
    levels_.object.assign(rule_context_.objects(), Level::hard);
    levels_.no_obstruction_rule = std::string(kNoObstructionRule);
    levels_.obstruction_bodies = Level::hard;
  }

  clash::Levels run() {
    if (rules_.obstruction) read_obstruction(*rules_.obstruction);
    if (rules_.insulation) read_insulation(*rules_.insulation);
    apply_choices();
    return std::move(levels_);
  }

 private:
  void leave_out(Level a, Level b, std::string_view rule) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    levels_.left_out[i][j] = levels_.left_out[j][i] = rule;
  }

  /// Takes the levels that attributes state.
  void read_obstruction(const ObstructionRule& rule) {
    levels_.obstruction_bodies = rule.bodies;
    if (!rule.soft_against_soft) leave_out(Level::soft, Level::soft, kSoftRule);
    bool some = rule.soft || rule.none || rule.hard || rule_context_.has_obstructions();
    for (std::size_t o = 0; o < levels_.object.size(); ++o) {
      const auto stated = stated_level(rule_context_.model().objects[o], rule.attributes);
      some = some || stated;
      if (stated) levels_.object[o] = *stated;
    }
    if (!some)
      rule_context_.warn_no_match(rules_.file + ": [obstruction]",
                                  "no object has the attribute " + alternatives(rule.attributes) +
                                      " and there are no obstruction volumes");
  }

  void read_insulation(const InsulationRule& rule) {
    if (!rule.select && !rule_context_.has_insulation())
      rule_context_.warn_no_match(rules_.file + ": [insulation]", "no object has insulation");
    if (!rule.against_insulation) leave_out(Level::insulation, Level::insulation, kInsulationRule);
    if (!rule.against_soft) leave_out(Level::insulation, Level::soft, kInsulationSoftRule);
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

  /// Returns the selections of the file, those first that go before the others.
  [[nodiscard]] std::vector<LevelChoice> choices() const {
    std::vector<LevelChoice> all;
    const auto add = [&](const std::optional<Chooser>& chooser, Level level, std::string_view key) {
      if (chooser) all.push_back({&*chooser, level, key});
    };
    if (rules_.insulation) add(rules_.insulation->select, Level::insulation, "[insulation] select");
    if (!rules_.obstruction) return all;
    add(rules_.obstruction->hard, Level::hard, "hard");
    add(rules_.obstruction->none, Level::none, "none");
    add(rules_.obstruction->soft, Level::soft, "soft");
    return all;
  }

  /// Gives objects the level of the first selection that picks them.
  void apply_choices() {
    std::vector<bool> taken(levels_.object.size());
    std::string earlier;
    for (const LevelChoice& choice : choices()) {
      const std::vector<bool> picked = rule_context_.pick(*choice.chooser);
      rule_context_.check_shadow(
          picked, [&](std::size_t o) { return !taken[o]; }, choice.chooser->where,
          "every object that it picks is one of " + earlier);
      for (std::size_t o = 0; o < picked.size(); ++o) {
        if (picked[o] && !taken[o]) levels_.object[o] = choice.level;
        taken[o] = taken[o] || picked[o];
      }
      earlier += (earlier.empty() ? "'" : " or '") + std::string(choice.key) + "'";
    }
  }

  const RuleFile& rules_;
  RuleContext& rule_context_;
  clash::Levels levels_;
};

}  // namespace

std::optional<clash::Levels> levels_of(const RuleFile& rules, RuleContext& rule_context) {
  if (!rules.obstruction && !rules.insulation) return std::nullopt;
  return LevelBuilder(rules, rule_context).run();
}

}  // namespace strake::rules
