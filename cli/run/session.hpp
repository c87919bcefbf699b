// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "cli/options/options.hpp"
#include "cli/output/console.hpp"
#include "cli/output/run_files.hpp"
#include "cli/output/stats.hpp"
#include "cli/run/interrupts.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

/// One run of a verb: its workers, its stop token, its progress and its figures.
class Session {
 public:
  Session(const CommonOptions& options, unsigned workers, Console& console, Interrupts& interrupts);

  [[nodiscard]] parallel::Context context();
  /// Returns the report on parallel work; from now on contexts request it, --stats or not.
  [[nodiscard]] const parallel::RunReport& measured();
  [[nodiscard]] Console& console() { return console_; }
  [[nodiscard]] Stats& stats() { return stats_; }
  [[nodiscard]] RunFiles& files() { return files_; }
  /// Begins a step of the run, which is timed for --stats until the value dies, and shown as
  /// progress while nothing more precise is known.
  [[nodiscard]] Stats::Timer step(std::string_view name);
  [[nodiscard]] bool json() const { return options_.json; }
  [[nodiscard]] bool has_stats_option() const { return options_.stats; }

  /// Names a file that the run writes now, so that a cancellation cleans up after it. Errors: usage
  /// where the run reads it.
  [[nodiscard]] Status will_write(const std::filesystem::path& target);
  /// Takes text piece by piece.
  using Sink = parallel::FunctionRef<void(std::string_view)>;
  /// Gives all the text, or the error that prevented it.
  using Producer = parallel::FunctionRef<Status(Sink)>;
  /// Writes a file, whole or not at all, and says so.
  [[nodiscard]] Status write(const std::filesystem::path& target, Producer producer);
  /// Writes data to standard output.
  [[nodiscard]] Status write_stdout(Producer producer);
  [[nodiscard]] Status write_stdout(std::string_view text);
  /// Removes the progress line for good: what waits for people is no work, and a signal ends it.
  void begin_serving() {
    line_.reset();
    interrupts_.expect();
  }
  /// Removes the progress line and prints what --stats requests.
  void finish();

 private:
  CommonOptions options_;
  Console& console_;
  Interrupts& interrupts_;
  std::unique_ptr<parallel::Team> team_;  ///< null for one worker: the sequential twin
  parallel::Progress progress_;
  parallel::RunReport report_;
  bool measures_ = false;
  Stats stats_;
  RunFiles files_;
  std::mutex step_mutex_;
  std::string step_;
  std::optional<ProgressLine> line_;
};

}  // namespace strake::cli
