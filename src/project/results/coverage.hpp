// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "project/results/life_cycle.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/kept.hpp"
#include "strake/clash/policy.hpp"
#include "strake/model/model.hpp"

namespace strake::project {

/// One of the two objects of a clash that a run did not find.
struct SoughtObject {
  std::string_view name;
  std::optional<model::ObjectId> id;  ///< absent: it is not in the model
  /// How many of its parts had no inside when the clash was seen last; absent: it is not known.
  std::optional<std::int64_t> open;
};

/// What is known of a clash from the runs before.
struct LastFound {
  Measure was;  ///< what it measured when it was found last
  /// Why the run before could not tell whether it is there; empty where it found it.
  std::string_view unknown;
  const clash::Report* report = nullptr;  ///< of the run before; null: it is not known
};

/// Tells why a run that did not find a clash cannot tell whether it is there. What it is made from
/// must outlive it.
class Coverage {
 public:
  Coverage(const model::Model& model, const clash::Sets& sets, const clash::Policy& policy,
           const clash::Report& report);

  /// Returns the contact that two objects are where the run only counts it; null where they are
  /// none, or the run does not say.
  [[nodiscard]] const clash::UnlistedContact* counted(model::ObjectId a, model::ObjectId b) const;
  /// Returns how many parts of an object have no inside in this run.
  [[nodiscard]] std::int64_t open_parts(model::ObjectId id) const;
  /// Returns the reason; empty where the two were compared.
  [[nodiscard]] std::string reason(const SoughtObject& a, const SoughtObject& b,
                                   const LastFound& last) const;

 private:
  [[nodiscard]] std::string of_sets(const SoughtObject& a, const SoughtObject& b) const;
  [[nodiscard]] std::string of_object(const SoughtObject& object) const;
  [[nodiscard]] std::string of_exemptions(model::ObjectId a, model::ObjectId b) const;
  [[nodiscard]] std::string of_report(model::ObjectId a, model::ObjectId b) const;
  [[nodiscard]] std::string of_settings(model::ObjectId a, model::ObjectId b,
                                        const LastFound& last) const;

  const model::Model& model_;
  const clash::Sets& sets_;
  const clash::Policy& policy_;
  const clash::Report& report_;
  std::map<std::pair<model::ObjectId, std::optional<model::ObjectId>>, std::string_view> lacks_;
};

}  // namespace strake::project
