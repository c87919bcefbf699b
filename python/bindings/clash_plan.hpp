// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/bindings/clash.hpp"
#include "rules/object_facts.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"
#include "strake/rules/rules.hpp"

namespace strake::python {

/// What a clash run asks of the geometry of objects, of each by itself.
struct RequestFacts {
  std::vector<std::vector<bool>> a, b;  ///< by selection, an entry per object
  rules::ObjectFacts file, profile;

  /// Appends the facts of objects that come behind.
  void append(const RequestFacts& more);
};

/// A clash run as it is requested, its rules and lengths parsed.
class ClashPlanner {
 public:
  /// The request must outlive this. Errors: usage, input.
  [[nodiscard]] static Result<ClashPlanner> of(const ClashRequest& request);

  [[nodiscard]] model::SceneOptions scene_options() const;
  /// Returns what results name the rules by; nothing where there are none.
  [[nodiscard]] std::optional<report::RulesSource> rules_source() const;
  /// Whether objects are picked by selections, here or in the rules.
  [[nodiscard]] bool selects(const RequestFacts& facts) const;

  [[nodiscard]] Result<RequestFacts> facts(const model::Scene& scene,
                                           const parallel::Context& context) const;
  /// Returns the tests; the scene needs no bodies.
  [[nodiscard]] Result<rules::Plan> plan(const model::Scene& scene, RequestFacts facts,
                                         const parallel::Context& context) const;

 private:
  explicit ClashPlanner(const ClashRequest& request) : request_(&request) {}
  [[nodiscard]] Status read_rules();
  [[nodiscard]] Status read_test();
  [[nodiscard]] Result<rules::Plan> plan_by_rules(const model::Scene& scene, RequestFacts facts,
                                                  const parallel::Context& context) const;
  [[nodiscard]] Result<rules::PlannedTest> planned_test(const model::Scene& scene,
                                                        const RequestFacts& facts,
                                                        Diagnostics& diagnostics) const;

  const ClashRequest* request_;
  std::optional<rules::Rules> file_, profile_;  ///< a profile has no tests
  clash::Options options_;
  std::string clearance_attribute_;  ///< empty: nothing
};

/// Returns the run that found this. Errors: usage, cancelled.
[[nodiscard]] Result<std::shared_ptr<ClashRun>> run_of(const ModelPointer& model,
                                                       const ClashRequest& request,
                                                       const ClashPlanner& planner,
                                                       clash::Findings findings,
                                                       Diagnostics loading);

}  // namespace strake::python
