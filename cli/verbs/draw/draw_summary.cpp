// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_summary.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>

#include "cli/run/load.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::cli {

namespace {

std::string words(hlr::Fate fate) {
  return fate == hlr::Fate::left_out ? "left out" : std::string(drawing::fate_name(fate));
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

void count_objects(Stats& stats, const hlr::Account& account, std::string_view prefix) {
  stats.count(fmt::format("{}objects", prefix), account.objects());
  for (std::size_t f = static_cast<std::size_t>(hlr::Fate::drawn); f < hlr::kFates; ++f) {
    const auto fate = static_cast<hlr::Fate>(f);
    stats.count(fmt::format("{}objects {}", prefix, words(fate)), account.of(fate));
  }
  stats.count(fmt::format("{}objects in part", prefix), account.in_part);
}

}  // namespace strake::cli
