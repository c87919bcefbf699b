// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rules/rule_file.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::rules {

// The codes of warnings about rules that do nothing.
inline constexpr std::string_view kMatchesNothing = "rule-matches-nothing",
                                  kShadowed = "rule-shadowed";

/// A model that rules are asked about; keeps what turned out to match nothing, and whether the run
/// was cancelled: what is answered after that is thrown away.
class RuleContext {
 public:
  /// Asks all selections about all objects, in one pass. They must outlive this.
  RuleContext(const model::Scene& scene, const std::vector<const Chooser*>& choosers,
              const parallel::Context& context);

  [[nodiscard]] const model::Scene& scene() const { return scene_; }
  [[nodiscard]] const model::Model& model() const { return *scene_.model; }
  [[nodiscard]] std::size_t objects() const { return model().objects.size(); }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  /// The objects that one of the selections picks; a warning where there are none.
  std::vector<bool> pick(const Chooser& chooser);
  /// The same, and all objects where there is no selection.
  std::vector<bool> pick(const std::optional<Chooser>& chooser);
  /// The same without a warning.
  [[nodiscard]] const std::vector<bool>& peek(const Chooser& chooser) const {
    return picked_.at(&chooser);
  }
  /// Says that a rule matches nothing.
  void warn_no_match(const std::string& where, const std::string& what);
  /// How many rules were said to match nothing.
  [[nodiscard]] std::uint64_t idle() const { return diagnostics_.count(kMatchesNothing); }
  /// Says `what` of a selection that picks objects, but none that earlier ones leave to it:
  /// left(o).
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
  std::map<const Chooser*, std::vector<bool>> picked_;
  Diagnostics diagnostics_;
  std::optional<Error> error_;
};

}  // namespace strake::rules
