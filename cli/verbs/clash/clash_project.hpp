// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/load.hpp"
#include "cli/run/project_input.hpp"
#include "cli/run/session.hpp"
#include "project/results/remember.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/report/decisions.hpp"
#include "strake/rules/rules.hpp"

/// A run of clash tests over the model of a project, which remembers it.
namespace strake::cli {

/// As written.
struct ClashProjectInput {
  ProjectOptions project;
  std::string by;
  bool full = false, verify = false;

  [[nodiscard]] bool is_given() const { return !project.file.empty(); }
};

/// What a run is asked that its tests do not say.
struct RunRequest {
  double deeper_mm = 1;                      ///< as project::RunFacts
  std::optional<report::RulesSource> rules;  ///< the rules file, if there is one
  project::RunGrouping grouping;
  project::RunComments comments = project::RunComments::none;  ///< likewise
};

void add_clash_project_options(CLI::App& command, ClashProjectInput& options);

/// Tests a project, telling what was tested again, and remembers what was found.
///
/// A run is remembered by one transaction, which begins after the tests and ends after their files
/// were written: whoever ends the program before that finds the project as it was, and the next run
/// finds and tells the same. Standard output comes after it, as whoever reads that may take hours,
/// in which nobody else could write to the project.
class ProjectClashes {
 public:
  /// Opens the project that is given. Errors: those of open_project().
  [[nodiscard]] static Result<ProjectClashes> open(Session& session,
                                                   const ClashProjectInput& input);

  [[nodiscard]] Result<LoadedModel> load(Session& session, const model::SceneOptions& options,
                                         std::span<const rules::FileSettings> file_settings);
  /// Runs the tests of a plan; of those that ran before, what changed since.
  [[nodiscard]] Result<clash::Findings> find(Session& session, const LoadedModel& loaded,
                                             rules::Plan plan, bool list_exempted);
  /// Begins the transaction and writes the run into it. The findings are still as find() gave them.
  /// Errors: output where the model is another than load() read; those of project::remember().
  [[nodiscard]] Status remember(Session& session, const LoadedModel& loaded,
                                const clash::Findings& findings, RunRequest request);
  /// Returns what was decided about the findings; only after remember().
  [[nodiscard]] const report::DecidedResults* decided() const { return &run_->decided; }
  /// Returns when the run began, in UTC.
  [[nodiscard]] const std::string& started() const { return started_; }
  [[nodiscard]] Status commit(Session& session);
  /// Whether --verify found the result of a run that follows changes to be another than that of a
  /// full one.
  [[nodiscard]] bool differs() const { return differs_; }

 private:
  /// What is kept of a test until it is remembered.
  struct Tested {
    clash::Sets sets;
    clash::Policy policy;
    std::optional<project::StoredTest> before;
    std::optional<project::Snapshot> made;      ///< absent: it is that of `before`
    std::optional<clash::PairChanges> changes;  ///< of the results of `before`, where known
    project::TestWork work;

    /// Returns what the result was computed from.
    [[nodiscard]] const project::Snapshot& snapshot() const {
      return made ? *made : before->snapshot;
    }
  };

  ProjectClashes(OpenedProject opened, const ClashProjectInput& input);
  [[nodiscard]] Result<clash::Report> test(Session& session, const LoadedModel& loaded,
                                           const rules::PlannedTest& planned, Tested& tested);
  /// Finds out what the test is computed from; that of the run before it where all of it is the
  /// same.
  [[nodiscard]] Status sign(Session& session, const LoadedModel& loaded,
                            const rules::PlannedTest& planned, Tested& tested);
  [[nodiscard]] Result<clash::Report> follow(Session& session, const LoadedModel& loaded,
                                             const rules::PlannedTest& planned, Tested& tested);
  /// Takes the result of the run before, which is that of this one.
  [[nodiscard]] static clash::Report keep(const rules::PlannedTest& planned, Tested& tested);
  [[nodiscard]] Status verify(Session& session, const LoadedModel& loaded,
                              const rules::PlannedTest& planned, clash::Report& report);

  OpenedProject opened_;
  ClashProjectInput input_;
  std::string started_;
  double started_s_ = 0;
  Hash128 model_seal_;                     ///< of the model that was read
  Hash128 scene_;                          ///< of the model, and of how it was put on the grid
  std::vector<std::uint64_t> identities_;  ///< of the objects, where some test needed them
  std::vector<Tested> tests_;
  std::optional<project::Transaction> transaction_;
  std::optional<project::RememberedRun> run_;
  bool differs_ = false;
};

}  // namespace strake::cli
