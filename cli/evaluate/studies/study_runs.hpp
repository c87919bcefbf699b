// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "cli/evaluate/contender.hpp"
#include "cli/evaluate/studies/studies.hpp"
#include "strake/generate/ship.hpp"
#include "strake/model/scene.hpp"

/// What studies are made of.
namespace strake::cli {

/// A model on the grid with all that its scene refers to.
struct StudyScene {
  std::unique_ptr<const model::Model> model;
  model::Scene scene;
  geometry::Box3l box = geometry::empty_box<std::int64_t>();
};

[[nodiscard]] Result<StudyScene> place_model(const StudyInput& input, model::Model model,
                                             const model::SceneOptions& options);
[[nodiscard]] Result<StudyScene> place_ship(const StudyInput& input,
                                            const generate::ShipOptions& options);

/// Timed runs of one contender.
struct StudyRun {
  double seconds = 0;  ///< the median
  Computed computed;
  std::string unfinished;  ///< why it has no result; empty: it has

  /// Returns the seconds as text, or why there are none.
  [[nodiscard]] std::string text() const;
  /// Returns a counter as text; "-" where there is none.
  [[nodiscard]] std::string counter(const std::string& name) const;
};

/// Runs a contender `settings.repeat` times, or until the limit of the evaluation ends it.
[[nodiscard]] Result<StudyRun> run_for_study(const StudyInput& input, const Contender& contender);

// The studies.
[[nodiscard]] Status study_bucketing(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_push_and_gather(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_gap(const StudyInput& input, StudyRecord& study);
[[nodiscard]] Status study_imported(const StudyInput& input, StudyRecord& study);

}  // namespace strake::cli
