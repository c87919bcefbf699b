// SPDX-License-Identifier: Apache-2.0
#include "clash/tiles/join_tiles.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/results/result_counts.hpp"
#include "clash/results/result_hash.hpp"
#include "clash/rules/rule_matcher.hpp"

namespace strake::clash {
namespace {

/// A rule that did nothing in a cell names there the first that did its work; so does one that did
/// nothing in any, of all cells.
void add_shadow(std::int32_t of_tile, std::int32_t& of_all) {
  if (of_tile >= 0 && (of_all < 0 || of_tile < of_all)) of_all = of_tile;
}

void add_to(NotReported::Counts& all, const NotReported::Counts& more) {
  all.hit += more.hit;
  all.contact += more.contact;
  all.clearance_violation += more.clearance_violation;
  all.allowed += more.allowed;
}

}  // namespace

TileJoin::TileJoin(const WholeTest& test) : test_(test), unknown_sag_(test.model.files.size(), 0) {
  all_.set_a = test.sets.name_a;
  all_.set_b = test.sets.name_b;
  all_.options = test.options;
  all_.in_a = test.sets.in_a;
  all_.in_b = test.sets.in_b;
  all_.within_files = test.sets.group.empty();
  all_.sheets.assign(test.model.objects.size(), 0);
  all_.weld_mm = test.weld_mm;
  RuleMatcher(test.policy, test.options, test.model).begin_report(test.sets, all_);
}

void TileJoin::make_room(std::size_t pairs, std::size_t regions) {
  all_.pairs.reserve(pairs);
  all_.regions.reserve(regions);
}

bool TileJoin::fits(const TileReport& tile) const {
  return tile.unknown_sag.size() == unknown_sag_.size() &&
         tile.report.allowed.size() == all_.allowed.size() &&
         tile.report.exempted.size() == all_.exempted.size() &&
         tile.report.cells.size() == all_.cells.size();
}

void TileJoin::add(TileReport tile, std::span<const std::uint32_t> objects) {
  Report& report = tile.report;
  const auto number = [&](model::ObjectId& id) { id = model::ObjectId{objects[index(id)]}; };
  for (ExemptedPair& pair : report.exempted_pairs) {
    number(pair.a);
    number(pair.b);
    all_.exempted_pairs.push_back(pair);
  }
  for (NotCompared& what : report.not_compared) {
    if (!what.b) continue;
    number(what.a);
    number(*what.b);
    not_compared_.push_back(what);
  }
  for (std::size_t o = 0; o < report.sheets.size(); ++o) all_.sheets[objects[o]] = report.sheets[o];
  for (std::size_t f = 0; f < unknown_sag_.size(); ++f) unknown_sag_[f] |= tile.unknown_sag[f];
  all_.contact_distance_mm = std::max(all_.contact_distance_mm, report.contact_distance_mm);
  add_counts(report);
  add_rules(report);
  hash_sum_ = sum(hash_sum_, tile.hash_sum);
  hashed_ += tile.hashed;
  box_pairs_ += tile.box_pairs;
  parts_ += tile.parts;
}

void TileJoin::add_counts(const Report& tile) {
  all_.unlisted.contacts += tile.unlisted.contacts;
  all_.unlisted.allowed += tile.unlisted.allowed;
  add_to(all_.not_reported.by_relation, tile.not_reported.by_relation);
  add_to(all_.not_reported.by_volume, tile.not_reported.by_volume);
  all_.count_hit += tile.count_hit;
  all_.count_contact += tile.count_contact;
  all_.count_clearance += tile.count_clearance;
  all_.count_allowed += tile.count_allowed;
  all_.count_allowed_regions += tile.count_allowed_regions;
}

void TileJoin::add_rules(const Report& tile) {
  for (std::size_t r = 0; r < all_.exempted.size(); ++r) {
    all_.exempted[r].pairs += tile.exempted[r].pairs;
    add_shadow(tile.exempted[r].shadowed_by, all_.exempted[r].shadowed_by);
  }
  for (std::size_t r = 0; r < all_.allowed.size(); ++r) {
    AllowedCount& rule = all_.allowed[r];
    rule.candidates += tile.allowed[r].candidates;
    rule.pairs += tile.allowed[r].pairs;
    rule.regions += tile.allowed[r].regions;
    add_shadow(tile.allowed[r].shadowed_by, rule.shadowed_by);
  }
  for (std::size_t c = 0; c < all_.cells.size(); ++c) {
    CellReport& cell = all_.cells[c];
    cell.hit += tile.cells[c].hit;
    cell.contact += tile.cells[c].contact;
    cell.clearance_violation += tile.cells[c].clearance_violation;
    cell.allowed += tile.cells[c].allowed;
  }
}

void TileJoin::append(Pair pair, std::span<const Region> regions) {
  if (!regions.empty()) pair.first_region = static_cast<std::uint32_t>(all_.regions.size());
  all_.pairs.push_back(std::move(pair));
  all_.regions.insert(all_.regions.end(), regions.begin(), regions.end());
}

Status TileJoin::check_boxes() const {
  if (box_pairs_ <= max_unframed_pairs(parts_, {.engine = {.max_pairs = ~std::uint64_t{0}}}))
    return {};
  return Error{ErrorCode::input,
               "so many members lie askew in each other's boxes that the search for pairs has to "
               "look at all of them at once",
               "clash", "find these clashes on one machine"};
}

Result<Report> TileJoin::finish(const parallel::Context& context) && {
  if (const Status s = check_boxes(); !s) return s.error();
  if (context.stop.stop_requested()) return Error{ErrorCode::cancelled, "was cancelled", {}, {}};
  std::ranges::sort(all_.exempted_pairs, [](const ExemptedPair& x, const ExemptedPair& y) {
    return std::tie(x.a, x.b, x.rule) < std::tie(y.a, y.b, y.rule);
  });
  for (Exempted& rule : all_.exempted)
    if (rule.pairs > 0) rule.shadowed_by = -1;
  for (AllowedCount& rule : all_.allowed)
    if (rule.pairs + rule.regions > 0) rule.shadowed_by = -1;
  all_.hash = result_hash(hash_sum_, hashed_);
  for (const model::IncompleteObject& lacking : test_.lacking)
    if (all_.in_a[index(lacking.object)] || all_.in_b[index(lacking.object)])
      all_.not_compared.push_back({lacking.object, {}, lacking.code});
  std::ranges::sort(not_compared_, [](const NotCompared& x, const NotCompared& y) {
    return std::tie(x.a, *x.b) < std::tie(y.a, *y.b);
  });
  all_.not_compared.insert(all_.not_compared.end(), not_compared_.begin(), not_compared_.end());
  report_not_compared(test_.model, all_);
  describe_sets(all_);
  report_unknown_sag(unknown_sag_, test_.model, all_.diagnostics);
  return std::move(all_);
}

}  // namespace strake::clash
