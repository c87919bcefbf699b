// SPDX-License-Identifier: Apache-2.0
#include "cli/output/stats.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <new>
#include <nlohmann/json.hpp>

#include "cli/output/shown_text.hpp"
#include "core/text_encoding.hpp"

namespace strake::cli {

Stats::Timer::Timer(Stats& stats, std::string_view phase)
    : stats_(stats), phase_(phase), start_cpu_s_(parallel::process_cpu_s()) {}

Stats::Timer::~Timer() {
  const double wall = watch_.seconds();
  try {
    stats_.phases_.push_back({phase_, wall, parallel::process_cpu_s() - start_cpu_s_});
  } catch (const std::bad_alloc&) {  // the phase is not reported; its work may be unwinding
  }
}

void Stats::count(std::string_view name, std::uint64_t value) {
  counters_.emplace_back(name, value);
}

void Stats::note(std::string_view name, std::string_view words) {
  words_.emplace_back(name, words);
}

void Stats::costly(std::string_view a, std::string_view b, std::string_view where,
                   std::uint64_t cost) {
  costly_.push_back({std::string(a), std::string(b), std::string(where), cost});
}

std::string Stats::text(const parallel::RunReport& report) const {
  std::string out = fmt::format("{:<28}{:>10}{:>10}\n", "phase", "wall s", "cpu s");
  for (const Phase& phase : phases_)
    out += fmt::format("{:<28}{:>10.3f}{:>10.3f}\n", shown_line(phase.name), phase.wall_s,
                       phase.cpu_s);
  for (const parallel::StageReport& stage : report.stages())
    out += fmt::format("  {:<26}{:>10.3f}{:>10.3f}\n", stage.name, stage.wall_s, stage.cpu_s);
  const std::vector<parallel::RegionReport> regions = report.regions();
  if (!regions.empty())
    out += fmt::format("{:<28}{:>10}{:>10}{:>12}{:>9}{:>7}{:>11}\n", "parallel region", "wall s",
                       "busy s", "items", "balance", "bound", "longest s");
  for (const parallel::RegionReport& region : regions) {
    const bool shared = region.runs > 0;
    if (shared)
      out += fmt::format("{:<28}{:>10.3f}{:>10.3f}{:>12}{:>9.2f}{:>7.2f}{:>11.4f}\n", region.name,
                         region.wall_s, region.total_busy_s(), region.items, region.load_balance(),
                         region.bound(), region.longest_s);
    // It gets a line of its own, or one where it is visible beside the shared runs of the name.
    if (!shared || region.nested_cpu_s >= 0.0005)
      out += fmt::format(
          "{:<28}{:>10}{:>10.3f}{:>12}   by one worker, {}\n", shared ? "" : region.name, "",
          region.nested_cpu_s, shared ? "" : std::to_string(region.items),
          region.nested_runs == 1 ? "once" : fmt::format("{} times", region.nested_runs));
  }
  for (const auto& [name, words] : words_)
    out += fmt::format("{:<28}  {}\n", shown_line(name), shown_line(words));
  for (const auto& [name, value] : counters_)
    out += fmt::format("{:<28}{:>10}\n", shown_line(name), value);
  for (const Costly& pair : costly_)
    out += fmt::format("{:<28}{:>10}   {} and {}{}\n", "costly pair", pair.cost, shown_cell(pair.a),
                       shown_cell(pair.b), shown_line(pair.where));
  out += fmt::format("{:<28}{:>10.1f} MiB", "peak memory",
                     static_cast<double>(peak_memory_bytes()) / (1024.0 * 1024.0));
  return out;
}

std::string Stats::json(const parallel::RunReport& report) const {
  using Json = nlohmann::ordered_json;
  Json phases = Json::array(), stages = Json::array(), parts = Json::array(),
       words = Json::object(), counters = Json::object(), costly = Json::array();
  for (const Phase& phase : phases_)
    phases.push_back(
        {{"name", valid_utf8(phase.name)}, {"wall_s", phase.wall_s}, {"cpu_s", phase.cpu_s}});
  for (const parallel::StageReport& stage : report.stages())
    stages.push_back({{"name", stage.name}, {"wall_s", stage.wall_s}, {"cpu_s", stage.cpu_s}});
  for (const parallel::RegionReport& region : report.regions())
    parts.push_back({{"name", region.name},
                     {"runs", region.runs},
                     {"nested_runs", region.nested_runs},
                     {"items", region.items},
                     {"wall_s", region.wall_s},
                     {"busy_s", region.busy_s},
                     {"nested_cpu_s", region.nested_cpu_s},
                     {"longest_s", region.longest_s},
                     {"load_balance", region.load_balance()},
                     {"bound", region.bound()}});
  for (const auto& [name, text] : words_) words[valid_utf8(name)] = valid_utf8(text);
  for (const auto& [name, value] : counters_) counters[valid_utf8(name)] = value;
  for (const Costly& pair : costly_)
    costly.push_back({{"a", valid_utf8(pair.a)},
                      {"b", valid_utf8(pair.b)},
                      {"where", valid_utf8(pair.where)},
                      {"cost", pair.cost}});
  return Json{{"phases", std::move(phases)},
              {"stages", std::move(stages)},
              {"regions", std::move(parts)},
              {"words", std::move(words)},
              {"counters", std::move(counters)},
              {"costly_pairs", std::move(costly)},
              {"peak_memory_bytes", peak_memory_bytes()}}
      .dump();
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
}

}  // namespace strake::cli
