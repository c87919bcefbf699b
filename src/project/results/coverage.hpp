// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "project/results/life_cycle.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"
#include "strake/model/model.hpp"

namespace strake::project {

/// One of the two objects of a clash that a run did not find.
struct SoughtObject {
  std::string_view name;
  std::optional<model::ObjectId> id;      ///< absent: it is not in the model
  std::optional<model::ObjectId> before;  ///< its number in the earlier run
};

/// Tells why a run that did not find a clash cannot tell whether it is there. What it is made from
/// must outlive it.
class Coverage {
 public:
  Coverage(const model::Model& model, const clash::Sets& sets, const clash::Policy& policy,
           const clash::Report& report);

  /// Returns the reason; empty where the two were compared. `earlier` is the report of the run that
  /// found the clash, null if it is not known; `was` is what it measured then.
  [[nodiscard]] std::string reason(const SoughtObject& a, const SoughtObject& b, const Measure& was,
                                   const clash::Report* earlier) const;

 private:
  [[nodiscard]] std::string of_sets(const SoughtObject& a, const SoughtObject& b) const;
  [[nodiscard]] std::string of_object(const SoughtObject& object,
                                      const clash::Report* earlier) const;
  [[nodiscard]] std::string of_exemptions(model::ObjectId a, model::ObjectId b) const;
  [[nodiscard]] std::string of_report(const Measure& was) const;
  [[nodiscard]] std::string of_settings(model::ObjectId a, model::ObjectId b, const Measure& was,
                                        const clash::Report& earlier) const;

  const model::Model& model_;
  const clash::Sets& sets_;
  const clash::Policy& policy_;
  const clash::Report& report_;
  std::map<std::pair<model::ObjectId, std::optional<model::ObjectId>>, std::string_view> lacks_;
};

}  // namespace strake::project
