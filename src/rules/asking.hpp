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

/// A model that rules are asked about; keeps what turned out to match nothing, and whether the run
/// was cancelled: what is answered after that is thrown away.
class Asking {
 public:
  /// Asks all selections about all objects, in one pass. They must outlive this.
  Asking(const model::Scene& scene, const std::vector<const Chooser*>& choosers,
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
  /// Says that a rule matches nothing.
  void nothing(const std::string& where, const std::string& what);

 private:
  const model::Scene& scene_;
  std::map<const Chooser*, std::vector<bool>> picked_;
  Diagnostics diagnostics_;
  std::optional<Error> error_;
};

/// The values of the attributes of this name, without blanks and quotes round them; those that say
/// that there is none ("", "Nulref", "unset", "none", "=0/0") are left out.
[[nodiscard]] std::vector<std::string_view> values_of(const model::Attributes& attributes,
                                                      std::string_view attribute);
/// The same of an object, inherited ones too.
[[nodiscard]] std::vector<std::string_view> values_of(const model::Model& model,
                                                      const model::Object& object,
                                                      std::string_view attribute);

}  // namespace strake::rules
