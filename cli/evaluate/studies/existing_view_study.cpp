// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/studies/edited_ships.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "core/stopwatch.hpp"
#include "project/views/drawing_codec.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

namespace {

/// Seconds of one way to a drawing: of the whole, and of the two steps.
struct Seconds {
  double all = 0, local = 0, global = 0;
};

/// Those of several rounds.
class RoundTimes {
 public:
  void add(double all, const parallel::RunReport& report) {
    all_.push_back(all);
    local_.push_back(step(report, hlr::kLocalStep));
    global_.push_back(step(report, hlr::kGlobalStep));
  }
  [[nodiscard]] Seconds medians() const { return {median(all_), median(local_), median(global_)}; }

 private:
  static double step(const parallel::RunReport& report, std::string_view name) {
    const auto stages = report.stages();
    const auto found = std::ranges::find(stages, name, &parallel::StageReport::name);
    return found == stages.end() ? 0 : found->wall_s;
  }

  std::vector<double> all_, local_, global_;
};

/// A view that exists: its drawing, and what it was made from.
struct ExistingView {
  hlr::Drawing drawing;
  hlr::Signatures signatures;
  Seconds seconds;
};

/// A drawing that was made from an existing view.
struct FollowedView {
  hlr::Redrawn redrawn;
  std::size_t changed = 0;  ///< objects
  Seconds seconds;
};

/// Draws views of the states of one ship.
class ViewRuns {
 public:
  ViewRuns(const StudyInput& input, const EditedShips& ships, StudyRecord& study)
      : input_(input), ships_(ships), study_(study) {
    if (input.settings.threads.back() > 1) team_.emplace(input.settings.threads.back());
  }

  Status run(const ViewCase& view) {
    title_ = view.title;
    view_ = view_of(view, ships_.before.box);
    input_.narrate(fmt::format("existing-view, {}: new", view.name));
    auto made = make_view();
    if (!made) return made.error();
    const hlr::Counters& work = made->drawing.counters;
    add_row("new view", made->seconds, made->seconds.all,
            {"-", std::to_string(made->drawing.account.objects()),
             std::to_string(work.feature_edges), "-",
             fmt::format("{} instances share local results; shapes that they place: {}",
                         work.shared_bodies, work.shared_shapes)});
    charted_ = {made->seconds.all, made->seconds.global};
    // Moved objects keep their local results; where objects are added the thesis does all again.
    if (const Status s = follow(*made, "unchanged", ships_.before, made->seconds.global); !s)
      return s;
    for (std::size_t i = 0; i < kShipEdits.size(); ++i) {
      const bool adds = kShipEdits[i].edit == ShipEdit::some_added;
      if (const Status s = follow(*made, kShipEdits[i].title, ships_.after[i],
                                  adds ? made->seconds.all : made->seconds.global);
          !s)
        return s;
    }
    return {};
  }

  /// The seconds of the view that was run last, as they are charted.
  [[nodiscard]] const std::vector<double>& charted() const { return charted_; }

 private:
  [[nodiscard]] parallel::Context context(parallel::RunReport* report = nullptr) {
    return {.team = team_ ? &*team_ : nullptr, .stop = input_.stop, .report = report};
  }

  Result<ExistingView> make_view() {
    ExistingView made;
    RoundTimes rounds;
    for (std::uint64_t round = 0; round < input_.settings.repeat; ++round) {
      parallel::RunReport report;
      const Stopwatch watch;
      auto drawing = hlr::draw(ships_.before.scene, {}, view_, {}, context(&report));
      if (!drawing) return drawing.error();
      rounds.add(watch.seconds(), report);
      made.drawing = std::move(*drawing);
    }
    made.seconds = rounds.medians();
    auto signatures = hlr::signatures(ships_.before.scene, {}, view_, {}, context());
    if (!signatures) return signatures.error();
    made.signatures = std::move(*signatures);
    return made;
  }

  /// Draws an existing view again, and holds the drawing against one that is made anew.
  Status follow(const ExistingView& existing, std::string_view state, const PlacedModel& now,
                double thesis_s) {
    input_.narrate(fmt::format("existing-view, {}: {}", title_, state));
    const auto followed = follow_rounds(existing, now.scene);
    if (!followed) return followed.error();
    const auto same = is_that_made_anew(existing, followed->redrawn, now);
    if (!same) return same.error();
    if (!*same)
      study_.differences.push_back(fmt::format("the drawings differ: {}, {}", title_, state));
    const hlr::Redrawn& redrawn = followed->redrawn;
    add_row(std::string(state), followed->seconds, thesis_s,
            {std::to_string(followed->changed), std::to_string(redrawn.objects_solved),
             std::to_string(redrawn.edges_solved), *same ? "yes" : "NO",
             redrawn.in_full ? "in full: " + std::string(redrawn.why) : std::string()});
    charted_.push_back(followed->seconds.all);
    return {};
  }

  /// What a run takes that has the earlier drawing in memory: signatures, their comparison, lines.
  Result<FollowedView> follow_rounds(const ExistingView& existing, const model::Scene& scene) {
    FollowedView followed;
    RoundTimes rounds;
    for (std::uint64_t round = 0; round < input_.settings.repeat; ++round) {
      hlr::Drawing drawing = existing.drawing;
      drawing.pieces.reserve(drawing.pieces.size() + drawing.pieces.size() / 16);
      parallel::RunReport report;
      const Stopwatch watch;
      const auto signatures = hlr::signatures(scene, {}, view_, {}, context(&report));
      if (!signatures) return signatures.error();
      const std::vector<std::uint32_t> numbers =
          unchanged(existing.signatures.objects, signatures->objects);
      auto redrawn = hlr::draw_changes(scene, {}, view_, {},
                                       {std::move(drawing), numbers, existing.signatures.boxes},
                                       context(&report));
      if (!redrawn) return redrawn.error();
      rounds.add(watch.seconds(), report);
      followed.redrawn = std::move(*redrawn);
      const auto kept =
          numbers.size() - static_cast<std::size_t>(std::ranges::count(numbers, model::kNoObject));
      followed.changed = signatures->objects.size() - kept;
    }
    followed.seconds = rounds.medians();
    return followed;
  }

  /// Returns for each object whether it is as it was. All that stays has kept its number.
  static std::vector<std::uint32_t> unchanged(const std::vector<Hash128>& before,
                                              const std::vector<Hash128>& now) {
    std::vector<std::uint32_t> numbers(before.size(), model::kNoObject);
    for (std::uint32_t o = 0; o < before.size(); ++o)
      if (before[o] == now[o]) numbers[o] = o;
    return numbers;
  }

  Result<bool> is_that_made_anew(const ExistingView& existing, const hlr::Redrawn& redrawn,
                                 const PlacedModel& now) {
    if (&now == &ships_.before) return project::are_equal(existing.drawing, redrawn.drawing);
    const auto full = hlr::draw(now.scene, {}, view_, {}, context());
    if (!full) return full.error();
    return project::are_equal(*full, redrawn.drawing);
  }

  void add_row(std::string state, const Seconds& ours, double thesis_s,
               std::vector<std::string> more) {
    std::vector<std::string> row{std::string(title_), std::move(state)};
    for (const double seconds : {ours.all, ours.local, ours.global, thesis_s})
      row.push_back(fmt::format("{:.4f}", seconds));
    row.insert(row.end(), more.begin(), more.end());
    study_.rows.push_back(std::move(row));
  }

  const StudyInput& input_;
  const EditedShips& ships_;
  StudyRecord& study_;
  std::optional<parallel::Team> team_;
  std::string_view title_;
  hlr::View view_;
  std::vector<double> charted_;
};

}  // namespace

Status study_existing_view(const StudyInput& input, StudyRecord& study) {
  study.columns = {"View",         "State",          "s",       "Local s",
                   "Global s",     "Thesis's way s", "Changed", "Solved",
                   "Edges solved", "Equal",          "Note"};
  BarChart chart{.title = "Seconds to a drawing", .unit = "s", .names = {}, .series = {}};
  for (const std::string_view name : {"new view", "existing, the thesis's way", "unchanged",
                                      "one object moved", "one in a thousand moved", "1 % added"})
    chart.series.push_back({std::string(name), {}});
  for (const ViewedShip ship : {ViewedShip::whole, ViewedShip::crowd}) {
    input.narrate("existing-view: generating a ship and changing it");
    const auto ships = edit_ship(input, viewed_ship(ship, input.settings.scale));
    if (!ships) return ships.error();
    ViewRuns runs(input, *ships, study);
    for (const ViewCase& view : view_cases()) {
      if (view.ship != ship) continue;
      if (const Status status = runs.run(view); !status) return status;
      chart.names.emplace_back(view.name);
      for (std::size_t s = 0; s < chart.series.size(); ++s)
        chart.series[s].values.push_back(runs.charted()[s]);
    }
  }
  study.charts.push_back(std::move(chart));
  return {};
}

}  // namespace strake::cli
