// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rules/object_facts.hpp"
#include "rules/rule_file.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::rules {

// The codes of warnings about rules that do nothing.
inline constexpr std::string_view kMatchesNothing = "rule-matches-nothing",
                                  kShadowed = "rule-shadowed";

/// Evaluates all selections for all objects, in one pass, in the order of the choosers. Errors:
/// cancelled.
[[nodiscard]] Result<std::vector<std::vector<bool>>> picked_by(
    const std::vector<const Chooser*>& choosers, const model::Scene& scene,
    const parallel::Context& context);

/// The model to which rules are applied. It keeps which rules match nothing, and whether the run
/// was cancelled; results after that are not used.
class RuleContext {
 public:
  /// `facts` has what choosers_of() the rules pick. Scene, rules and context must outlive this.
  RuleContext(const model::Scene& scene, const std::vector<const Chooser*>& choosers,
              ObjectFacts facts, const parallel::Context& context);

  [[nodiscard]] const model::Model& model() const { return *scene_.model; }
  [[nodiscard]] std::size_t objects() const { return model().objects.size(); }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  void fail(Error error) { error_ = std::move(error); }
  [[nodiscard]] const parallel::Context& context() const { return context_; }

  /// Whether a body of the model is an obstruction volume, and whether one is insulation.
  [[nodiscard]] bool has_obstructions() const { return obstructions_; }
  [[nodiscard]] bool has_insulation() const { return insulation_; }
  /// Returns the ends of the objects for which `among` holds, by object and body.
  [[nodiscard]] std::vector<model::ObjectEnd> ends(const std::vector<bool>& among) const;

  /// Returns the objects that one of the selections picks, with a warning where there are none.
  std::vector<bool> pick(const Chooser& chooser);
  /// Picks as the other pick() does, and picks all objects where there is no selection.
  std::vector<bool> pick(const std::optional<Chooser>& chooser);
  /// Picks without a warning.
  [[nodiscard]] const std::vector<bool>& peek(const Chooser& chooser) const {
    return picked_.at(&chooser);
  }
  /// Warns that a rule matches nothing.
  void warn_no_match(const std::string& where, const std::string& what);
  /// Returns how many rules were said to match nothing.
  [[nodiscard]] std::uint64_t idle() const { return diagnostics_.count(kMatchesNothing); }
  /// Warns with `what` of a selection that picks objects, but none for which left(o) holds: earlier
  /// ones leave it none.
  template <class Left>
  void check_shadow(const std::vector<bool>& picked, Left&& left, const std::string& where,
                    const std::string& what) {
    bool some = false;
    for (std::size_t o = 0; o < picked.size(); ++o) {
      if (picked[o] && left(o)) return;
      some = some || picked[o];
    }
    if (some) diagnostics_.add(Severity::warning, kShadowed, what, where);
  }

 private:
  const model::Scene& scene_;
  const parallel::Context& context_;
  std::map<const Chooser*, std::vector<bool>> picked_;
  std::optional<std::vector<model::ObjectEnd>> ends_;
  bool obstructions_ = false, insulation_ = false;
  Diagnostics diagnostics_;
  std::optional<Error> error_;
};

}  // namespace strake::rules
