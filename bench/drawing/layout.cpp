// SPDX-License-Identifier: Apache-2.0
// Whole files on paper: seconds of the layout, and in it of finding what lies on what. Lines are
// drawn as they are, or with hidden ones found first (--stage global). Of a sample of the lines,
// what they lie on is found again among all lines; a difference ends with an error.
//
//     bench_layout [--threads N] [--direction x,y,z] [--stage none|local|global] [--repeat N]
//                  [--sample N] FILE...
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "clocks.hpp"
#include "drawing/layout/duplicates.hpp"
#include "drawing/layout/view_plane.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;

struct Arguments {
  std::vector<std::filesystem::path> files;
  hlr::View view{.direction = {1, -1, 1}, .limits = {}};
  hlr::Options options{.stage = hlr::Stage::none};
  unsigned threads = 1;
  std::size_t sample = 200;
  int repeat = 3;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : "0"; };
    if (key == "--threads")
      a.threads = static_cast<unsigned>(std::atoi(value()));
    else if (key == "--repeat")
      a.repeat = std::atoi(value());
    else if (key == "--sample")
      a.sample = std::strtoull(value(), nullptr, 10);
    else if (key == "--stage") {
      const std::string stage = value();
      a.options.stage = stage == "global"  ? hlr::Stage::global
                        : stage == "local" ? hlr::Stage::local
                                           : hlr::Stage::none;
    } else if (key == "--direction")
      std::sscanf(value(), "%ld,%ld,%ld", &a.view.direction.x, &a.view.direction.y,
                  &a.view.direction.z);
    else
      a.files.emplace_back(key);
  }
  a.view.up = drawing::default_up(a.view.direction);
  return a;
}

double peak_mib() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  return static_cast<double>(u.ru_maxrss) / 1024;
}

bool same(const drawing::LineInterval& a, const drawing::LineInterval& b) {
  return a.line == b.line && a.covered == b.covered && a.from == b.from && a.to == b.to;
}

/// How many of a sample of lines are cut otherwise when every other line is asked.
std::size_t wrong(std::span<const drawing::PlaneSegment> lines, const drawing::OverlapRule& rule,
                  const drawing::LineOverlaps& found, std::size_t sample) {
  std::size_t wrong = 0;
  for (std::size_t n = 0; n < sample && !lines.empty(); ++n) {
    const auto i = static_cast<std::uint32_t>(lines.size() * n / sample);
    if (!drawing::can_be_covered(lines[i], rule)) continue;
    std::vector<drawing::ParamInterval> covers;
    for (std::uint32_t j = 0; j < lines.size(); ++j)
      if (j != i && lines[j].rank != drawing::OverlapRank::none &&
          drawing::has_precedence(lines, j, i))
        if (const auto interval = drawing::covered(lines[i], lines[j], rule))
          covers.push_back(*interval);
    drawing::LineIntervals expected;
    if (!covers.empty())
      drawing::append_intervals(expected, i, covers, rule.shortest / lines[i].length());
    const drawing::LineIntervals& cut_intervals = found.cut_intervals;
    const auto first =
        std::partition_point(cut_intervals.begin(), cut_intervals.end(),
                             [&](const drawing::LineInterval& s) { return s.line < i; });
    const auto last = std::partition_point(
        first, cut_intervals.end(), [&](const drawing::LineInterval& s) { return s.line == i; });
    drawing::LineIntervals got(first, last);
    if (found.fully_covered.is_set(i)) got.push_back({i, true, 0, 1});
    if (!std::equal(got.begin(), got.end(), expected.begin(), expected.end(), same)) ++wrong;
  }
  return wrong;
}

int run(const Arguments& a) {
  parallel::Team team(a.threads);
  const parallel::Context context{.team = a.threads > 1 ? &team : nullptr};
  const auto model = io::read_models(a.files, {}, context);
  if (!model) return fmt::print(stderr, "{}\n", model.error().text()), 3;
  const auto scene = model::make_scene(*model, {}, context);
  if (!scene) return fmt::print(stderr, "{}\n", scene.error().text()), 3;
  bench::Clock clock;
  const auto lines = hlr::draw(*scene, {}, a.view, a.options, context);
  if (!lines) return fmt::print(stderr, "{}\n", lines.error().text()), 3;
  fmt::print("draw    {}: {} objects, {} pieces, {:.0f} MiB at most\n", clock.text(),
             model->objects.size(), lines->pieces.size(), peak_mib());
  const auto axes = drawing::paper_axes(a.view);
  if (!axes) return fmt::print(stderr, "no such view\n"), 2;
  const double distance = std::max(lines->contact_distance_mm, 3 * geometry::kMmPerGrid);
  for (int i = 0; i < a.repeat; ++i) {
    clock = {};
    const auto flat = drawing::flatten(*lines, *axes, distance, context);
    if (!flat) return 3;
    const drawing::OverlapRule rule = drawing::duplicate_rule(distance);
    const auto cut = drawing::cut_overlaps(*flat, rule, context);
    if (!cut) return 3;
    fmt::print("overlap {}: {} lines wholly, {} stretches\n", clock.text(),
               cut->fully_covered.count(), cut->cut_intervals.size());
    if (i + 1 < a.repeat) continue;
    const std::size_t faults = wrong(*flat, rule, *cut, a.sample);
    fmt::print("  {} lines against all: {} wrong\n", a.sample, faults);
    if (faults > 0) return 5;
  }
  for (int i = 0; i < a.repeat; ++i) {
    clock = {};
    const auto sheet = drawing::lay_out(*lines, *model, {}, context);
    if (!sheet) return fmt::print(stderr, "{}\n", sheet.error().text()), 3;
    fmt::print("layout  {}: {} lines, {} of them duplicates, {:.0f} MiB at most\n", clock.text(),
               sheet->lines.size(),
               sheet->count[static_cast<std::size_t>(drawing::LineState::duplicate)], peak_mib());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return run(parse(argc, argv)); }
