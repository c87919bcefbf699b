// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/pages/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "cli/evaluate/pages/peer_table.hpp"
#include "cli/evaluate/statistics.hpp"

namespace strake::cli {

namespace {

constexpr double kMebibyte = 1024.0 * 1024.0;

std::string number(double value, int digits = 2) { return fmt::format("{:.{}f}", value, digits); }
std::string percent(double part) { return fmt::format("{:.1f} %", 100 * part); }

/// Calls `visit` with each case that has the stage, and the stage.
void for_each_stage(const EvaluationRecord& record, const std::string& name,
                    const std::function<void(const CaseRecord&, const StageRecord&)>& visit) {
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages)
      if (stage.name == name) visit(one, stage);
}

std::string title_of(const std::string& stage) {
  if (stage == "local") return "Local hidden-line removal";
  if (stage == "global") return "Global hidden-line removal";
  return "Clash detection";
}

TableSection summary(const EvaluationRecord& record) {
  const unsigned threads = max_threads(record);
  TableSection section;
  section.id = "summary";
  section.table = {
      "Speed-ups beside the thesis's",
      fmt::format("Sequential time over time on {} threads. The thesis measured on four cores with "
                  "eight hardware threads.",
                  threads),
      {"Stage", "Mean", "Deviation", "Least", "Greatest", "Cases", "Thesis: mean", "Deviation",
       "Least", "Greatest", "Cases"},
      {}};
  for (const ThesisFigures& thesis : thesis_figures()) {
    const Spread ours = spread_of(record, thesis.stage, threads);
    if (ours.count == 0) continue;
    const Spread& theirs = thesis.speedup;
    section.table.rows.push_back(
        {title_of(thesis.stage), number(ours.mean, 3), number(ours.deviation, 3),
         number(ours.least, 3), number(ours.greatest, 3), std::to_string(ours.count),
         number(theirs.mean, 3), number(theirs.deviation, 3), number(theirs.least, 3),
         number(theirs.greatest, 3), std::to_string(theirs.count)});
  }
  return section;
}

/// Returns the seconds of a way of the thesis, or why there are none, and how many times ours.
std::pair<std::string, std::string> thesis_way(const StageRecord& stage, double ours_s) {
  std::string seconds, times;
  for (const ContenderRecord& one : stage.contenders) {
    if (!one.name.starts_with("thesis: ")) continue;
    if (!seconds.empty()) seconds += "; ", times += "; ";
    const double median_s = median(one.seconds);
    seconds += fmt::format("{} x{}: {}", one.name.substr(8), one.threads,
                           one.seconds.empty() ? one.unfinished : number(median_s, 3));
    times += one.seconds.empty() ? "-" : number(median_s / ours_s, 1);
  }
  return {seconds, times};
}

TableSection speedups(const EvaluationRecord& record, const std::string& stage) {
  const unsigned threads = max_threads(record);
  TableSection section;
  section.id = "speed-up-" + stage;
  section.table = {
      title_of(stage),
      "Sequential and parallel: median seconds. Balance: mean over maximum of the workers' busy "
      "time, of all regions together and of the worst above 50 ms. Serial: the part of the "
      "sequential time that no team shares, with the speed-up that it allows (Amdahl), and what "
      "the longest item of each region allows besides. Alone: CPU time of the calling thread while "
      "no team works, and the speed-up that it allows (By CPU), which holds on a busy machine, "
      "too. "
      "Machine: the speed-up of work that is shared perfectly, in the same rounds. Noise: how far "
      "two sequential contenders are apart.",
      {"Case", "Objects", "Sequential s", fmt::format("{} threads s", threads), "Speed-up",
       "Machine", "Balance", "Worst balance", "Serial", "Amdahl", "Bound", "Alone ms", "By CPU",
       "Noise", "Equal"},
      {}};
  BarChart chart{
      title_of(stage) + ": speed-up", "x", {}, {{fmt::format("{} threads", threads), {}}}};
  for_each_stage(record, stage, [&](const CaseRecord& one, const StageRecord& measured) {
    const std::optional<Speedup> s = speedup_of(measured, threads);
    if (!s) return;
    section.table.rows.push_back(
        {one.title, std::to_string(one.objects), number(s->sequential_s, 3),
         number(s->parallel_s, 3), number(s->speedup),
         s->machine > 0 ? number(s->machine) : std::string("-"), number(s->load_balance),
         s->worst_region.empty() ? "-"
                                 : fmt::format("{:.2f} {}", s->worst_balance, s->worst_region),
         s->serial_region.empty()
             ? percent(s->serial_share)
             : fmt::format("{} {}", percent(s->serial_share), s->serial_region),
         number(s->amdahl), number(s->bound), number(1000 * s->alone_s, 1), number(s->by_cpu),
         percent(timing_noise(measured)), measured.differences.empty() ? "yes" : "NO"});
    chart.names.push_back(one.name);
    chart.series.front().values.push_back(s->speedup);
  });
  for (const ThesisFigures& thesis : thesis_figures())
    if (stage == thesis.stage)
      chart.levels.push_back(
          {fmt::format("mean of the thesis, {:.3f}", thesis.speedup.mean), thesis.speedup.mean});
  if (!chart.names.empty()) section.charts.push_back(std::move(chart));
  return section;
}

TableSection thesis_ways(const EvaluationRecord& record) {
  TableSection section;
  section.id = "thesis";
  section.table = {"The thesis's own way on the same input",
                   "Seconds of one run, and how many times as long as ours on as many threads as "
                   "there are.",
                   {"Case", "Stage", "Ours s", "Thesis's way s", "Times ours"},
                   {}};
  const unsigned threads = max_threads(record);
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages) {
      const ContenderRecord* const ours =
          find_contender(stage, threads == 1 ? kSequential : kOurs, threads);
      if (ours == nullptr) continue;
      const double ours_s = median(ours->seconds);
      const auto [seconds, times] = thesis_way(stage, ours_s);
      if (!seconds.empty())
        section.table.rows.push_back({one.title, stage.name, number(ours_s, 3), seconds, times});
    }
  return section;
}

TableSection by_threads(const EvaluationRecord& record) {
  TableSection section;
  section.id = "threads";
  section.table = {
      "Speed-up by number of threads", "Mean, and the least of all cases.", {"Stage"}, {}};
  BarChart chart{"Mean speed-up by number of threads", "x", {}, {}};
  for (const unsigned threads : record.settings.threads) {
    if (threads == 1) continue;
    section.table.columns.push_back(fmt::format("{} threads", threads));
    chart.series.push_back({fmt::format("{} threads", threads), {}});
  }
  if (chart.series.size() < 2) return section;
  for (const ThesisFigures& thesis : thesis_figures()) {
    std::vector<std::string> row{title_of(thesis.stage)};
    std::size_t s = 0;
    bool any = false;
    for (const unsigned threads : record.settings.threads) {
      if (threads == 1) continue;
      const Spread spread = spread_of(record, thesis.stage, threads);
      any = any || spread.count > 0;
      row.push_back(fmt::format("{:.2f}, least {:.2f}", spread.mean, spread.least));
      chart.series[s++].values.push_back(spread.mean);
    }
    chart.names.push_back(title_of(thesis.stage));
    if (any) section.table.rows.push_back(std::move(row));
  }
  if (!section.table.rows.empty()) section.charts.push_back(std::move(chart));
  return section;
}

/// Shows what each worker did in the case that takes longest of each stage.
TableSection distribution(const EvaluationRecord& record) {
  const unsigned threads = max_threads(record);
  TableSection section;
  section.id = "workers";
  section.table = {"Distribution over the workers",
                   "Busy seconds of each worker in all regions, least and greatest.",
                   {"Case", "Stage", "Least s", "Greatest s"},
                   {}};
  for (const ThesisFigures& thesis : thesis_figures()) {
    BarChart chart;
    double longest_s = 0;
    for_each_stage(record, thesis.stage, [&](const CaseRecord& one, const StageRecord& stage) {
      const ContenderRecord* const run = find_contender(stage, kOurs, threads);
      if (run == nullptr) return;
      const std::vector<double> busy = busy_seconds(*run);
      const auto [least, largest] = std::ranges::minmax(busy);
      section.table.rows.push_back({one.title, stage.name, number(least, 3), number(largest, 3)});
      if (largest <= longest_s) return;
      longest_s = largest;
      chart = {fmt::format("{}, {}: busy time of each worker", one.title, stage.name),
               "s",
               {},
               {{"busy", busy}}};
      for (unsigned w = 0; w < threads; ++w) chart.names.push_back(fmt::format("worker {}", w + 1));
    });
    if (!chart.names.empty()) section.charts.push_back(std::move(chart));
  }
  return section;
}

TableSection memory(const EvaluationRecord& record) {
  TableSection section;
  section.id = "memory";
  section.table = {"Peak memory by number of threads",
                   "Mebibytes of the process while the contender ran; model and scene are among "
                   "them.",
                   {"Case", "Stage", "Sequential"},
                   {}};
  for (const unsigned threads : record.settings.threads)
    if (threads > 1) section.table.columns.push_back(fmt::format("{} threads", threads));
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages) {
      const ContenderRecord* const alone = find_contender(stage, kSequential, 1);
      if (alone == nullptr || alone->peak_bytes == 0) continue;
      const auto text = [](const ContenderRecord& run) {
        return number(static_cast<double>(run.peak_bytes) / kMebibyte, 1);
      };
      std::vector<std::string> row{one.title, stage.name, text(*alone)};
      for (const unsigned threads : record.settings.threads) {
        if (threads == 1) continue;
        const ContenderRecord* const run = find_contender(stage, kOurs, threads);
        row.push_back(run == nullptr ? "-" : text(*run));
      }
      section.table.rows.push_back(std::move(row));
    }
  return section;
}

TableSection work(const EvaluationRecord& record) {
  TableSection section;
  section.id = "work";
  section.table = {
      "Work",
      "Counters of the sequential run and of the thesis's way. They do not depend on the "
      "machine, but for those of push on several threads, which depend on the schedule.",
      {"Case", "Stage", "Contender", "Counters"},
      {}};
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages) {
      std::set<std::string> listed{kAgain, kOurs};
      for (const ContenderRecord& run : stage.contenders) {
        if (run.counters.empty() || !listed.insert(run.name).second) continue;
        std::string counters;
        for (const auto& [name, value] : run.counters)
          counters += fmt::format("{}{} {}", counters.empty() ? "" : ", ", name, value);
        section.table.rows.push_back({one.title, stage.name, run.name, std::move(counters)});
      }
    }
  return section;
}

TableSection machine(const EvaluationRecord& record) {
  const Machine& m = record.machine;
  std::string threads;
  for (const unsigned n : record.settings.threads)
    threads += fmt::format("{}{}", threads.empty() ? "" : ", ", n);
  TableSection section;
  section.id = "machine";
  section.table = {
      "Machine and settings",
      {},
      {"What", "Value"},
      {{"Processor", m.processor},
       {"Hardware threads for this process", std::to_string(m.hardware_threads)},
       {"Memory", number(static_cast<double>(m.memory_bytes) / kMebibyte / 1024, 1) + " GiB"},
       {"System", m.system},
       {"Compiler", m.compiler},
       {"Strake", m.version},
       {"Scale", fmt::format("{:g}", record.settings.scale)},
       {"Threads", threads},
       {"Rounds at least", std::to_string(record.settings.repeat)},
       {"Limit of the thesis's way", fmt::format("{:g} s", record.settings.limit_s)}}};
  return section;
}

}  // namespace

std::vector<TableSection> sections_of(const EvaluationRecord& record) {
  std::vector<TableSection> sections{summary(record)};
  for (const ThesisFigures& thesis : thesis_figures())
    sections.push_back(speedups(record, thesis.stage));
  sections.push_back(thesis_ways(record));
  sections.push_back(by_threads(record));
  sections.push_back(distribution(record));
  for (const StudyRecord& study : record.studies)
    sections.push_back(
        {study.name, {study.title, study.question, study.columns, study.rows}, study.charts});
  sections.push_back(peer_section(record));
  sections.push_back(memory(record));
  sections.push_back(work(record));
  sections.push_back(machine(record));
  std::erase_if(sections, [](const TableSection& section) { return section.table.rows.empty(); });
  return sections;
}

std::vector<std::string> differences_of(const EvaluationRecord& record) {
  std::vector<std::string> lines;
  for (const CaseRecord& one : record.cases)
    for (const StageRecord& stage : one.stages)
      for (const std::string& difference : stage.differences)
        lines.push_back(fmt::format("{}, {}: {}", one.name, stage.name, difference));
  for (const StudyRecord& study : record.studies)
    for (const std::string& difference : study.differences)
      lines.push_back(fmt::format("{}: {}", study.name, difference));
  for (const PeerRecord& peer : record.peers)
    for (const PeerRow& row : peer.rows)
      if (row.outcome == kDisagrees)
        lines.push_back(fmt::format("{}, {}: {}: {}", peer.name, row.scene, row.who, row.result));
  return lines;
}

}  // namespace strake::cli
