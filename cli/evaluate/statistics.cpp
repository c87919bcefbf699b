// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "core/parting.hpp"

namespace strake::cli {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const std::size_t half = values.size() / 2;
  const double middle = nth_value(std::span(values), half);
  if (values.size() % 2 == 1) return middle;
  return (middle + *std::ranges::max_element(std::span(values).first(half))) / 2;
}

const ContenderRecord* find_contender(const StageRecord& stage, const std::string& name,
                                      unsigned threads) {
  for (const ContenderRecord& one : stage.contenders)
    if (one.name == name && one.threads == threads && !one.seconds.empty()) return &one;
  return nullptr;
}

double timing_noise(const StageRecord& stage) {
  const ContenderRecord* const first = find_contender(stage, kSequential, 1);
  const ContenderRecord* const again = find_contender(stage, kAgain, 1);
  if (first == nullptr || again == nullptr) return 0;
  const double a = median(first->seconds), b = median(again->seconds);
  return a > 0 && b > 0 ? std::fabs(a - b) / std::min(a, b) : 0;
}

std::vector<double> busy_seconds(const ContenderRecord& run) {
  std::vector<double> busy(run.threads);
  for (const parallel::RegionReport& region : run.regions)
    for (std::size_t w = 0; w < std::min(busy.size(), region.busy_s.size()); ++w)
      if (region.runs > 0) busy[w] += region.busy_s[w];
  return busy;
}

namespace {

/// Returns the median over both sequential contenders.
double sequential_seconds(const StageRecord& stage) {
  std::vector<double> all;
  for (const char* const name : {kSequential, kAgain})
    if (const ContenderRecord* const one = find_contender(stage, name, 1))
      all.insert(all.end(), one->seconds.begin(), one->seconds.end());
  return median(std::move(all));
}

void add_balance(const ContenderRecord& run, Speedup& result) {
  constexpr double kLongSeconds = 0.05;
  for (const parallel::RegionReport& region : run.regions) {
    if (region.runs == 0 || region.wall_s < kLongSeconds ||
        region.load_balance() >= result.worst_balance)
      continue;
    result.worst_balance = region.load_balance();
    result.worst_region = region.name;
  }
  const std::vector<double> busy = busy_seconds(run);
  const double largest = *std::ranges::max_element(busy);
  const double total = std::accumulate(busy.begin(), busy.end(), 0.0);
  if (largest > 0) result.load_balance = total / (static_cast<double>(busy.size()) * largest);
}

void add_bounds(const ContenderRecord& run, Speedup& result) {
  // The regions are those of the last round.
  const double serial_s = std::max(0.0, run.seconds.back() - run.shared_wall_s);
  if (result.sequential_s <= 0) return;
  result.serial_share = std::min(1.0, serial_s / result.sequential_s);
  const auto threads = static_cast<double>(run.threads);
  result.amdahl = 1 / (result.serial_share + (1 - result.serial_share) / threads);
  double least_s = 0, longest_serial_s = 0;
  for (const parallel::RegionReport& region : run.regions) {
    least_s += region.least_s;
    // What takes longer than all that is serial ran within another region, on several workers.
    if (region.runs > 0 || region.nested_cpu_s <= longest_serial_s ||
        region.nested_cpu_s > serial_s)
      continue;
    longest_serial_s = region.nested_cpu_s;
    result.serial_region = region.name;
  }
  if (serial_s + least_s > 0) result.bound = result.sequential_s / (serial_s + least_s);
}

void add_by_cpu(const ContenderRecord& run, Speedup& result) {
  result.alone_s = run.alone_s;
  const double shared_s = std::max(0.0, run.cpu_s - run.alone_s);
  const double least_s = run.alone_s + shared_s / static_cast<double>(run.threads);
  if (least_s > 0) result.by_cpu = (run.alone_s + shared_s) / least_s;
  const double kernel_s = median(run.kernel_s);
  if (kernel_s > 0) result.machine = median(run.kernel_alone_s) / kernel_s;
}

}  // namespace

std::optional<Speedup> speedup_of(const StageRecord& stage, unsigned threads) {
  const ContenderRecord* const run = find_contender(stage, kOurs, threads);
  const double sequential_s = sequential_seconds(stage);
  if (run == nullptr || sequential_s <= 0) return std::nullopt;
  Speedup result;
  result.sequential_s = sequential_s;
  result.parallel_s = median(run->seconds);
  result.speedup = result.sequential_s / result.parallel_s;
  add_balance(*run, result);
  add_bounds(*run, result);
  add_by_cpu(*run, result);
  return result;
}

std::string outcome_line(const CaseRecord& one, const EvaluationSettings& settings) {
  const unsigned threads = settings.threads.back();
  std::vector<std::string> stages;
  for (const StageRecord& stage : one.stages) {
    std::string text = stage.name;
    if (const std::optional<Speedup> speedup = speedup_of(stage, threads))
      text += fmt::format(" {:.3f} s, {:.2f} x on {} threads", speedup->sequential_s,
                          speedup->speedup, threads);
    if (!stage.differences.empty()) text += ", DIFFERENT";
    stages.push_back(std::move(text));
  }
  return fmt::format("{}: {}", one.name, fmt::join(stages, "; "));
}

Spread spread_of(std::span<const double> values) {
  Spread spread;
  spread.count = values.size();
  if (values.empty()) return spread;
  const auto n = static_cast<double>(values.size());
  spread.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  // Of the sample, as the thesis's charts have it.
  spread.deviation = values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0;
  spread.least = *std::ranges::min_element(values);
  spread.greatest = *std::ranges::max_element(values);
  return spread;
}

Spread spread_of(const EvaluationRecord& record, const std::string& stage, unsigned threads) {
  std::vector<double> speedups;
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& measured : one.stages)
      if (measured.name == stage)
        if (const std::optional<Speedup> speedup = speedup_of(measured, threads))
          speedups.push_back(speedup->speedup);
  return spread_of(speedups);
}

std::span<const ThesisFigures> thesis_figures() {
  static constexpr std::array<ThesisFigures, 3> kFigures{
      {{"local", {13, 2.226, 1.035, 0.836, 3.891}, "13 views of a cruise ship"},
       {"global", {13, 2.859, 0.784, 1.774, 4.568}, "13 views of a cruise ship"},
       {"clash", {4, 2.911, 0.727, 2.179, 3.63}, "4 cruise ships of over a million objects"}}};
  return kFigures;
}

unsigned max_threads(const EvaluationRecord& record) {
  return record.settings.threads.empty() ? 1 : record.settings.threads.back();
}

}  // namespace strake::cli
