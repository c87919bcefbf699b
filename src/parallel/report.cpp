// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/report.hpp"

#include <time.h>

#include <algorithm>
#include <new>
#include <numeric>

namespace strake::parallel {
namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

}  // namespace

double RegionReport::total_busy_s() const {
  return std::accumulate(busy_s.begin(), busy_s.end(), 0.0);
}

double RegionReport::load_balance() const {
  const double largest = busy_s.empty() ? 0.0 : *std::max_element(busy_s.begin(), busy_s.end());
  return largest > 0 ? total_busy_s() / (static_cast<double>(busy_s.size()) * largest) : 1.0;
}

double RegionReport::bound() const { return least_s > share_s ? share_s / least_s : 1.0; }

void RunReport::add(const RegionReport& run) {
  RegionReport one = run;
  if (!run.busy_s.empty()) {
    one.share_s = run.total_busy_s() / static_cast<double>(run.busy_s.size());
    one.least_s = std::max(one.share_s, run.longest_s);
  }
  merge(one);
}

void RunReport::merge(const RegionReport& run) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(regions_.begin(), regions_.end(),
                                  [&](const RegionReport& r) { return r.name == run.name; });
  if (found == regions_.end()) {
    regions_.push_back(run);
    return;
  }
  found->runs += run.runs;
  found->nested_runs += run.nested_runs;
  found->items += run.items;
  found->wall_s += run.wall_s;
  found->nested_cpu_s += run.nested_cpu_s;
  found->longest_s = std::max(found->longest_s, run.longest_s);
  found->share_s += run.share_s;
  found->least_s += run.least_s;
  found->busy_s.resize(std::max(found->busy_s.size(), run.busy_s.size()));
  for (std::size_t w = 0; w < run.busy_s.size(); ++w) found->busy_s[w] += run.busy_s[w];
}

std::vector<RegionReport> RunReport::regions() const {
  const std::lock_guard lock(mutex_);
  return regions_;
}

void RunReport::add(const StageReport& run) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(stages_, run.name, &StageReport::name);
  if (found == stages_.end()) {
    stages_.push_back(run);
    return;
  }
  found->wall_s += run.wall_s;
  found->cpu_s += run.cpu_s;
}

std::vector<StageReport> RunReport::stages() const {
  const std::lock_guard lock(mutex_);
  return stages_;
}

StageTimer::StageTimer(RunReport* report, std::string_view stage) : report_(report) {
  if (report_ == nullptr) return;
  run_ = {std::string(stage), seconds_of(CLOCK_MONOTONIC), process_cpu_s()};
}

StageTimer::~StageTimer() {
  if (report_ == nullptr) return;
  run_.wall_s = seconds_of(CLOCK_MONOTONIC) - run_.wall_s;
  run_.cpu_s = process_cpu_s() - run_.cpu_s;
  try {
    report_->add(run_);
  } catch (const std::bad_alloc&) {  // the stage is not reported; its work may be unwinding
  }
}

double thread_cpu_s() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

double process_cpu_s() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace strake::parallel
