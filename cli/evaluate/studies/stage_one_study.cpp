// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/studies/object_boxes.hpp"
#include "cli/evaluate/studies/region_times.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "strake/generate/ship.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/shape2.hpp"

namespace strake::cli {

namespace {

using geometry::Box3l;
using geometry::IndexPair;
using Pairs = std::vector<IndexPair>;

constexpr std::string_view kRegion = "stage one";

/// Two sets of boxes, each of which is tested with each of the other.
struct TwoSets {
  std::string name;
  std::span<const Box3l> a, b;
};

/// Returns the pairs by a loop over the rows, the columns within; `pair(row, column)` says which
/// pair these are.
template <class Pair>
Result<Pairs> by_rows(std::span<const Box3l> rows, std::span<const Box3l> columns, const Pair& pair,
                      const parallel::Context& context) {
  return parallel::collect<IndexPair>(context, {.name = kRegion, .n = rows.size()},
                                      [&](std::size_t r, Pairs& out) {
                                        for (std::size_t c = 0; c < columns.size(); ++c)
                                          if (meet(rows[r], columns[c])) out.push_back(pair(r, c));
                                      });
}

IndexPair pair_of(std::size_t a, std::size_t b) {
  return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)};
}

Result<Pairs> by_rows_of_a(const TwoSets& sets, const parallel::Context& context) {
  return by_rows(sets.a, sets.b, pair_of, context);
}

Result<Pairs> by_the_larger(const TwoSets& sets, const parallel::Context& context) {
  if (sets.a.size() >= sets.b.size()) return by_rows_of_a(sets, context);
  return by_rows(
      sets.b, sets.a, [](std::size_t b, std::size_t a) { return pair_of(a, b); }, context);
}

/// Returns the pairs by one loop over all of A x B.
Result<Pairs> flattened(const TwoSets& sets, const parallel::Context& context) {
  constexpr std::size_t kGrain = 1U << 16U;  // some 100 us
  const parallel::Shape2 shape{static_cast<std::uint32_t>(sets.a.size()),
                               static_cast<std::uint32_t>(sets.b.size())};
  return parallel::collect<IndexPair>(context,
                                      {.name = kRegion, .n = shape.size(), .grain = kGrain},
                                      [&](std::size_t flat, Pairs& out) {
                                        const parallel::Shape2::Index at = shape.index(flat);
                                        if (meet(sets.a[at.row], sets.b[at.column]))
                                          out.push_back({at.row, at.column});
                                      });
}

/// A form of the loop, and how it is shared out.
struct Form {
  std::string_view name;
  Result<Pairs> (*pairs)(const TwoSets&, const parallel::Context&);
  parallel::Distribution distribution = parallel::Distribution::planned;
};
constexpr std::array<Form, 4> kForms{{
    {"flattened, equal ranges", flattened, parallel::Distribution::equal_ranges},
    {"flattened, competitive", flattened},
    {"rows of A, competitive", by_rows_of_a},
    {"rows of the larger, competitive", by_the_larger},
}};

Contender contender_of(const TwoSets& sets, const Form& form) {
  Contender contender;
  contender.name = form.name;
  contender.threads = kWorkersOfExample;
  contender.compute = [&sets,
                       pairs = form.pairs](const parallel::Context& context) -> Result<Computed> {
    Result<Pairs> found = pairs(sets, context);
    if (!found) return found.error();
    return computed_of(std::move(*found));
  };
  return contender;
}

Status add_sets(const StudyInput& input, const TwoSets& sets, StudyRecord& study) {
  StudyRun first;
  for (const Form& form : kForms) {
    input.narrate(fmt::format("stage-one, {}: {}", sets.name, form.name));
    Result<StudyRun> run = run_for_study(input, contender_of(sets, form),
                                         {.distribution = form.distribution, .with_regions = true});
    if (!run) return run.error();
    const bool is_first = &form == kForms.data();
    std::string same =
        is_first ? "-" : equal(*run, first, fmt::format("{}, {}", sets.name, form.name), study);
    const parallel::RegionReport region = region_named(run->regions, kRegion);
    std::vector<std::string> row{
        sets.name, std::string(form.name), std::to_string(sets.a.size() * sets.b.size()),
        run->counter("pairs"),
        run->unfinished.empty() ? fmt::format("{:.3f}", region.wall_s) : run->text()};
    for (std::string& cell : cells_of(region)) row.push_back(std::move(cell));
    row.push_back(std::move(same));
    study.rows.push_back(std::move(row));
    if (is_first) first = std::move(*run);
  }
  return {};
}

}  // namespace

Status study_stage_one(const StudyInput& input, StudyRecord& study) {
  constexpr std::size_t kFew = 10;
  constexpr double kMany = 20'000;
  study.columns = {"Sets", "Loop", "Box tests", "Pairs", "Wall s"};
  for (std::string& name : region_columns()) study.columns.push_back(std::move(name));
  study.columns.emplace_back("Equal");
  input.narrate("generating a ship");
  const ShipCase& dense = *std::ranges::find(ship_cases(), "dense", &ShipCase::name);
  const auto ship = place_ship(clashing_ship(dense, input.settings.scale), {}, input.stop);
  if (!ship) return ship.error();
  const std::vector<Box3l> boxes = object_boxes(*ship, generate::Truth::kClearanceMm);
  const std::span<const Box3l> all(boxes), few = all.first(std::min(kFew, all.size()));
  const auto side = static_cast<std::size_t>(kMany * std::sqrt(input.settings.scale));
  const std::span<const Box3l> many = all.first(std::min(side, all.size()));
  for (const TwoSets& sets : {TwoSets{fmt::format("{} x {}", few.size(), all.size()), few, all},
                              TwoSets{fmt::format("{} x {}", all.size(), few.size()), all, few},
                              TwoSets{fmt::format("{0} x {0}", many.size()), many, many}})
    if (const Status status = add_sets(input, sets, study); !status) return status;
  return {};
}

}  // namespace strake::cli
