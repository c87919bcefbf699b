// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "cli/evaluate/machine.hpp"
#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/time_limit.hpp"
#include "core/stopwatch.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

namespace {

constexpr double kMinShownSeconds = 0.001;

/// Notes of the regions of a run what is worth keeping. `caller_s`: all CPU time of the calling
/// thread, which is the first worker.
void keep_regions(const parallel::RunReport& report, double caller_s, ContenderRecord& record) {
  record.regions.clear();
  record.shared_wall_s = 0;
  record.alone_s = caller_s;
  for (parallel::RegionReport& region : report.regions()) {
    if (region.runs > 0) record.shared_wall_s += region.wall_s;
    if (region.runs > 0 && !region.busy_s.empty()) record.alone_s -= region.busy_s.front();
    if (region.wall_s + region.nested_cpu_s >= kMinShownSeconds)
      record.regions.push_back(std::move(region));
  }
  record.alone_s = std::max(0.0, record.alone_s);
}

/// Measures one stage.
class StageMeter {
 public:
  StageMeter(const std::vector<Contender>& contenders, const EvaluationSettings& settings,
             const std::stop_token& stop)
      : contenders_(contenders), settings_(settings), stop_(stop) {
    for (const Contender& contender : contenders) {
      ContenderRecord record;
      record.name = contender.name;
      record.threads = contender.threads;
      stage_.contenders.push_back(std::move(record));
    }
  }

  Status round(bool first, const std::function<void(const std::string&)>& narrate) {
    references_.push_back(reference_seconds());
    for (std::size_t i = 0; i < contenders_.size(); ++i) {
      if (contenders_[i].limited && !first) continue;
      narrate(fmt::format("{}, {} {}", contenders_[i].name, contenders_[i].threads,
                          contenders_[i].threads == 1 ? "thread" : "threads"));
      if (const Status status = run(i, first); !status) return status;
    }
    return {};
  }

  /// Returns how far the two runs of the same are apart, as part of their time.
  [[nodiscard]] double noise() const { return timing_noise(stage_); }

  StageRecord take(std::string name) {
    stage_.name = std::move(name);
    stage_.reference_s = median(references_);
    return std::move(stage_);
  }

 private:
  Status run(std::size_t i, bool publish) {
    const Contender& contender = contenders_[i];
    ContenderRecord& record = stage_.contenders[i];
    std::optional<TimeLimit> limit;
    if (contender.limited) limit.emplace(stop_, settings_.limit_s);
    std::optional<parallel::Team> team;
    if (contender.threads > 1) team.emplace(contender.threads);
    parallel::RunReport report;
    const parallel::Context context{.team = team ? &*team : nullptr,
                                    .stop = limit ? limit->token() : stop_,
                                    .progress = nullptr,
                                    .report = &report};
    note_kernel(context, record);
    // It gives memory back, which the run then has to take again.
    const bool has_peak = publish && reset_peak_memory();
    const double cpu = parallel::process_cpu_s(), caller = parallel::thread_cpu_s();
    const Stopwatch watch;
    const Result<Computed> computed = contender.compute(context);
    const double took = watch.seconds();
    if (!computed) return without_result(contender, record, computed.error());
    record.seconds.push_back(took);
    record.cpu_s = parallel::process_cpu_s() - cpu;
    if (has_peak) record.peak_bytes = peak_memory_since_reset();
    keep_regions(report, parallel::thread_cpu_s() - caller, record);
    note_kernel(context, record);
    record.counters = computed->counters;
    parallel::Context publishing = context;
    publishing.report = nullptr;
    publishing.stop = stop_;
    return compare(contender, record, *computed, publish ? &publishing : nullptr);
  }

  /// Notes what the machine has to give now.
  static void note_kernel(const parallel::Context& context, ContenderRecord& record) {
    if (record.name != kOurs || context.team == nullptr) return;
    record.kernel_alone_s.push_back(kernel_seconds({}));
    record.kernel_s.push_back(kernel_seconds({.team = context.team}));
  }

  /// Takes it that a contender with a limit has no result.
  Status without_result(const Contender& contender, ContenderRecord& record, const Error& error) {
    const bool expected = error.code == ErrorCode::cancelled || error.code == ErrorCode::memory ||
                          error.code == ErrorCode::input;
    if (!contender.limited || !expected || stop_.stop_requested()) return error;
    record.unfinished = error.code == ErrorCode::cancelled
                            ? fmt::format("stopped after {:g} s", settings_.limit_s)
                            : error.message;
    return {};
  }

  Status compare(const Contender& contender, ContenderRecord& record, const Computed& computed,
                 const parallel::Context* publishing) {
    const ContenderRecord& first = stage_.contenders.front();
    record.hash = computed.hash();
    if (contender.must_equal != MustEqual::bytes) return {};
    std::string what_differs = "the published document";
    if (publishing != nullptr) {
      Result<Published> published = computed.publish(*publishing);
      if (!published) return published.error();
      record.published_hash = published->hash;
      // Equal bytes are equal pixels; of others it is said how much of it anybody could see.
      if (&record == &first)
        first_pixels_ = std::move(published->pixels);
      else if (published->pixels && first_pixels_ && record.published_hash != first.published_hash)
        what_differs += fmt::format(" ({})", published->pixels->difference_text(*first_pixels_));
    }
    const auto differs = [&](const std::string& what) {
      std::string line = fmt::format("{} of '{}' on {} threads is not that of the {} run", what,
                                     contender.name, contender.threads, first.name);
      if (std::ranges::find(stage_.differences, line) == stage_.differences.end())
        stage_.differences.push_back(std::move(line));
    };
    if (record.hash != first.hash) differs("the result");
    if (publishing != nullptr && record.published_hash != first.published_hash)
      differs(what_differs);
    return {};
  }

  const std::vector<Contender>& contenders_;
  const EvaluationSettings& settings_;
  std::stop_token stop_;
  StageRecord stage_;
  std::vector<double> references_;
  std::optional<SheetPixels> first_pixels_;  ///< of the first contender's sheet
};

}  // namespace

Result<StageRecord> measure_stage(std::string name, const std::vector<Contender>& contenders,
                                  const EvaluationSettings& settings, const std::stop_token& stop,
                                  const std::function<void(const std::string&)>& narrate) {
  constexpr double kQuiet = 0.02;
  constexpr std::uint64_t kMaxRounds = 3;
  StageMeter meter(contenders, settings, stop);
  for (std::uint64_t round = 0; round < kMaxRounds * settings.repeat; ++round) {
    if (round >= settings.repeat && meter.noise() <= kQuiet) break;
    if (const Status status = meter.round(round == 0, narrate); !status) return status.error();
  }
  return meter.take(std::move(name));
}

}  // namespace strake::cli
