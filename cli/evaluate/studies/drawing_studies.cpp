// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "cli/evaluate/studies/study_scenes.hpp"

namespace strake::cli {

namespace {

/// Draws in one way on the most workers; `what` is reported.
Result<StudyRun> draw(const StudyInput& input, const StudyView& view, const hlr::Options& options,
                      const std::string& what) {
  input.narrate(what);
  return run_for_study(input, drawing_contender({}, input.settings.threads.back(), view.ship.scene,
                                                view.view, options));
}

/// Draws a ship by the usual options and by others.
Result<std::pair<StudyRun, StudyRun>> draw_both(const StudyInput& input, const ViewCase& view,
                                                const generate::ShipOptions& ship,
                                                const hlr::Options& others,
                                                const std::string& what) {
  const Result<StudyView> scene = place_view(input, view, ship);
  if (!scene) return scene.error();
  Result<StudyRun> usual = draw(input, *scene, {}, what);
  if (!usual) return usual.error();
  Result<StudyRun> other = draw(input, *scene, others, what + ", the other way");
  if (!other) return other.error();
  return std::pair(std::move(*usual), std::move(*other));
}

}  // namespace

Status study_bucketing(const StudyInput& input, StudyRecord& study) {
  constexpr double kPartOfScale = 0.2;
  constexpr std::array<std::int32_t, 6> kSides{
      hlr::Options::kBucketsByData, hlr::Options::kNoBuckets, 4, 16, 64, 256};
  study.columns = {"View", "Buckets a side", "s", "Face tests", "Equal"};
  for (const std::string_view name : {"iso", "plan-upper", "crowd"}) {
    const ViewCase& view = view_named(name);
    const Result<StudyView> scene =
        place_view(input, view, viewed_ship(view.ship, kPartOfScale * input.settings.scale));
    if (!scene) return scene.error();
    StudyRun by_data;
    for (const std::int32_t side : kSides) {
      hlr::Options options;
      options.bucketing = side;
      const std::string text = side == hlr::Options::kBucketsByData ? "auto"
                               : side == hlr::Options::kNoBuckets   ? "off"
                                                                    : std::to_string(side);
      const Result<StudyRun> run =
          draw(input, *scene, options, fmt::format("bucketing, {}: {}", name, text));
      if (!run) return run.error();
      if (side == hlr::Options::kBucketsByData) by_data = *run;
      study.rows.push_back(
          {std::string(view.title), text, run->text(), run->counter("face tests"),
           side == hlr::Options::kBucketsByData
               ? "-"
               : equal(*run, by_data, fmt::format("{}, buckets {}", name, text), study)});
    }
  }
  return {};
}

Status study_push_and_gather(const StudyInput& input, StudyRecord& study) {
  constexpr double kMaxObjects = 16'000;
  study.columns = {"Objects",    "Gather s",           "Push s", "Times",
                   "Face tests", "Face tests of push", "Equal"};
  const ViewCase& view = view_named("iso");
  for (const double part : {0.125, 0.25, 0.5, 1.0}) {
    generate::ShipOptions ship = viewed_ship(ViewedShip::whole, 1);
    // At any scale the sizes differ.
    const double scale = std::clamp(input.settings.scale, 0.0625, 1.0);
    ship.objects = static_cast<std::uint64_t>(kMaxObjects * part * scale);
    hlr::Options by_push;
    by_push.solver = hlr::Solver::push;
    const auto runs =
        draw_both(input, view, ship, by_push, fmt::format("push-gather, {} objects", ship.objects));
    if (!runs) return runs.error();
    const auto& [gather, push] = *runs;
    study.rows.push_back({std::to_string(ship.objects), gather.text(), push.text(),
                          times(push, gather), gather.counter("face tests"),
                          push.counter("face tests"),
                          equal(push, gather, fmt::format("{} objects", ship.objects), study)});
  }
  return {};
}

Status study_imported(const StudyInput& input, StudyRecord& study) {
  study.columns = {"Triangles each", "Buckets auto s", "Off s",
                   "Face tests",     "Face tests off", "Equal"};
  const ViewCase& view = view_named("crowd");
  for (const double triangles : {10'000.0, 40'000.0, 160'000.0}) {
    generate::ShipOptions ship = viewed_ship(ViewedShip::crowd, input.settings.scale);
    // At any scale the sizes differ.
    const double scale = std::clamp(input.settings.scale, 0.1, 1.0);
    ship.imported_triangles = static_cast<std::uint64_t>(triangles * scale);
    hlr::Options without;
    without.bucketing = hlr::Options::kNoBuckets;
    const auto runs =
        draw_both(input, view, ship, without,
                  fmt::format("imported, {} triangles each", ship.imported_triangles));
    if (!runs) return runs.error();
    const auto& [by_data, off] = *runs;
    study.rows.push_back(
        {std::to_string(ship.imported_triangles), by_data.text(), off.text(),
         by_data.counter("face tests"), off.counter("face tests"),
         equal(off, by_data, fmt::format("{} triangles", ship.imported_triangles), study)});
  }
  return {};
}

}  // namespace strake::cli
