// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_summary.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "cli/run/load.hpp"
#include "core/number.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::cli {

namespace {

std::string words(hlr::Fate fate) {
  return fate == hlr::Fate::left_out ? "left out" : std::string(drawing::fate_name(fate));
}

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

std::string counted(std::uint64_t number, std::string_view one) {
  return fmt::format("{} {}{}", grouped(number), one, number == 1 ? "" : "s");
}

}  // namespace

std::string object_summary_line(const hlr::Account& account, const model::Model& model) {
  std::string line =
      fmt::format("{} objects: {} drawn", account.objects(), account.of(hlr::Fate::drawn));
  for (std::size_t f = static_cast<std::size_t>(hlr::Fate::drawn) + 1; f < hlr::kFates; ++f) {
    const auto fate = static_cast<hlr::Fate>(f);
    if (account.of(fate) > 0) line += fmt::format(", {} {}", account.of(fate), words(fate));
  }
  if (account.in_part > 0)
    line += fmt::format("; {} without some of their geometry", account.in_part);
  if (const std::string rest = unread_rest(model); !rest.empty())
    line += fmt::format("; not drawn: {}", rest);
  return line;
}

std::string scale_words(const drawing::NeutralDrawing& drawing) {
  return drawing.sheet.scale_text + (drawing.view.perspective ? " in the plane of the target" : "");
}

std::vector<std::string> left_alone_lines(const drawing::NeutralDrawing& drawing) {
  const auto counted = [](std::uint64_t n, const char* one, const char* many) {
    return n == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", n, many);
  };
  const hlr::Counters& work = drawing.counters;
  std::vector<std::string> lines;
  if (drawing.uncut)
    lines.push_back(counted(work.uncut_objects, "object is", "objects are") +
                    " left whole by the sections");
  if (!drawing.flush_seams)
    lines.push_back("flush seams of " + counted(work.seams, "edge", "edges") + " are left out");
  return lines;
}

std::string thinned_line(const drawing::ThinnedLines& thinned) {
  return fmt::format("{} of {} too near to each other on paper are left out or shortened ({} mm)",
                     counted(thinned.lines, "line"), counted(thinned.objects, "object"),
                     shortest(thinned.spacing_mm));
}

std::string_view words(ViewRun run) {
  switch (run) {
    case ViewRun::made:
      return "new view";
    case ViewRun::unchanged:
      return "existing view, unchanged";
    case ViewRun::followed:
      return "existing view with changes";
    case ViewRun::in_full:
      break;
  }
  return "view in full";
}

std::string did_line(const std::string& view, const ViewWork& work) {
  const std::string begin = fmt::format("view '{}': {}: ", view, words(work.run));
  switch (work.run) {
    case ViewRun::made:
    case ViewRun::in_full:
      break;
    case ViewRun::unchanged:
      return begin + fmt::format("none of {} changed, nothing solved again, {} kept",
                                 counted(work.objects, "object"), counted(work.edges, "edge"));
    case ViewRun::followed:
      return begin + fmt::format("{} of {} changed, {} solved again in {:.2f} s, {} kept",
                                 grouped(work.objects_changed), counted(work.objects, "object"),
                                 counted(work.edges_solved, "edge"), work.solve_s,
                                 grouped(work.edges - std::min(work.edges, work.edges_solved)));
  }
  return begin + fmt::format("{}: {} of {} solved in {:.2f} s", work.why,
                             counted(work.edges, "edge"), counted(work.objects, "object"),
                             work.solve_s);
}

std::string cost_line(const std::string& view, const ViewWork& work) {
  std::string line = fmt::format("view '{}': ", view);
  if (work.run == ViewRun::unchanged)
    line += "no local and no global step";
  else
    line += fmt::format(
        "{:.3f} s of preparation, {:.3f} s of the local step for {}, of which {} share results, "
        "{:.3f} s of the global step for {}",
        work.preparation_s, work.local_s, counted(work.solved_locally(), "object"),
        counted(work.shared_bodies, "instance"), work.global_s,
        counted(work.solved_globally(), "object"));
  return line + fmt::format("; {:.3f} s to find what changed, {:.3f} s to read what was stored",
                            work.match_s, work.read_s);
}

void count_view_work(Stats& stats, const ViewWork& work) {
  stats.note("view", words(work.run));
  stats.count("objects changed", work.objects_changed);
  stats.count("objects solved locally", work.solved_locally());
  stats.count("objects solved globally", work.solved_globally());
  stats.count("edges solved", work.edges_solved);
  stats.count("instances that share results", work.shared_bodies);
  stats.count("shapes solved for instances", work.shared_shapes);
}

void count_objects(Stats& stats, const hlr::Account& account, std::string_view prefix) {
  stats.count(fmt::format("{}objects", prefix), account.objects());
  for (std::size_t f = static_cast<std::size_t>(hlr::Fate::drawn); f < hlr::kFates; ++f) {
    const auto fate = static_cast<hlr::Fate>(f);
    stats.count(fmt::format("{}objects {}", prefix, words(fate)), account.of(fate));
  }
  stats.count(fmt::format("{}objects in part", prefix), account.in_part);
}

}  // namespace strake::cli
