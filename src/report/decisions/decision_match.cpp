// SPDX-License-Identifier: Apache-2.0
#include "report/decisions/decision_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/text_encoding.hpp"
#include "report/clash/clash_files.hpp"
#include "report/clash/place_clusters.hpp"

namespace strake::report {
namespace {

/// How far a clash may be from the place that a file states: a spreadsheet rounds numbers.
constexpr double kSamePlaceMm = 0.01;

/// A row, or a result, that is known by its place.
struct PlacedItem : PlacedResult {
  Hash128 key;
  const Decision* row = nullptr;      ///< of a row
  const clash::Pair* pair = nullptr;  ///< of a result
  const Decision** found = nullptr;   ///< of a result: where its row is put
};

using Items = std::span<PlacedItem>;

/// Whether it makes no difference which row is about which result.
bool interchangeable(const Items rows, const Items results) {
  const auto decided = [](const PlacedItem& p) {
    return std::tie(p.row->status, p.row->by, p.row->date, p.row->comment, p.row->regions);
  };
  const auto found = [](const PlacedItem& p) {
    return std::tie(p.pair->cls, p.pair->allowed, p.pair->regions);
  };
  return std::ranges::all_of(rows, [&](const auto& p) { return decided(p) == decided(rows[0]); }) &&
         std::ranges::all_of(results, [&](const auto& p) { return found(p) == found(results[0]); });
}

/// Gives the results of a cluster the rows in it, where it can be known which is whose.
void pair_up(const Items cluster) {
  std::ranges::sort(cluster, {}, [](const PlacedItem& p) { return std::pair(p.is_after, p.key); });
  const auto second = std::ranges::find(cluster, true, &PlacedItem::is_after);
  const Items rows(cluster.begin(), second), results(second, cluster.end());
  if (rows.size() != results.size()) return;
  const bool same_keys = std::ranges::equal(rows, results, {}, &PlacedItem::key, &PlacedItem::key);
  const bool no_matter =
      rows.size() == 1 || (is_one_place(cluster, kSamePlaceMm) && interchangeable(rows, results));
  if (!same_keys && !no_matter) return;
  for (std::size_t i = 0; i < rows.size(); ++i) *results[i].found = rows[i].row;
}

class RowMatcher {
 public:
  RowMatcher(const clash::Findings& findings, const model::Model& model, const DecisionFile& file,
             const DecidedKeys& keys)
      : findings_(findings), model_(model), file_(file), keys_(keys) {
    for (const Decision& row : file.decisions) rows_.emplace(row.key, &row);
    for (const clash::Report& test : findings.tests)
      matched_.tests.emplace_back(test.pairs.size(), nullptr);
  }

  MatchedRows run() && {
    match_lasting();
    if (has_positional_) {
      hash_lasting_ids();
      for (const bool bare : {false, true})
        for (const bool with_d : {true, false}) match_places(bare, with_d);
      match_positional_keys();
    }
    report_replaced();
    return std::move(matched_);
  }

 private:
  /// Calls act(test, pair, its row) for each result.
  template <class Act>
  void for_each(Act&& act) {
    for (std::size_t t = 0; t < findings_.tests.size(); ++t)
      for (std::size_t p = 0; p < findings_.tests[t].pairs.size(); ++p)
        act(findings_.tests[t], findings_.tests[t].pairs[p], matched_.tests[t][p]);
  }

  void match_lasting() {
    for_each([&](const clash::Report& test, const clash::Pair& pair, const Decision*& row) {
      if (is_positional(model_, pair))
        has_positional_ = true;
      else
        take(row, find(test, pair));
    });
  }

  void match_places(bool bare, bool with_d) {
    std::vector<PlacedItem> all;
    for (const Decision& row : file_.decisions)
      if (is_bare(row) == bare && row.d_mm.has_value() == with_d) place(row, all);
    if (all.empty()) return;
    for_each([&](const clash::Report& test, const clash::Pair& pair, const Decision*& row) {
      if (row == nullptr && is_positional(model_, pair)) place(test, pair, row, with_d, all);
    });
    for (const Items cluster : clusters_of(Items(all), kSamePlaceMm)) pair_up(cluster);
    for (const PlacedItem& item : all)
      if (item.found != nullptr && *item.found != nullptr) used_.insert(*item.found);
  }

  void match_positional_keys() {
    for_each([&](const clash::Report& test, const clash::Pair& pair, const Decision*& row) {
      if (row != nullptr || !is_positional(model_, pair)) return;
      const Decision* const known = find(test, pair);
      const bool fits = known != nullptr && !used_.contains(known) &&
                        (is_bare(*known) || is_same_place(pair, *known));
      if (fits) take(row, known);
    });
  }

  /// Finds the rows that a run added before it was known which decision is about their results.
  void report_replaced() {
    if (keys_.is_identity() && !has_positional_) return;
    for_each([&](const clash::Report& test, const clash::Pair& pair, const Decision*& row) {
      if (row == nullptr) return;
      const Decision* const own = find(keys_.key(test.name, pair));
      if (own != nullptr && own != row && is_bare(*own) && !used_.contains(own))
        matched_.replaced.push_back(own);
    });
  }

  void take(const Decision*& row, const Decision* found) {
    row = found;
    if (found != nullptr) used_.insert(found);
  }

  [[nodiscard]] const Decision* find(const clash::Report& test, const clash::Pair& pair) const {
    const bool is_own = keys_.is_identity() || !keys_.has_label_of_another(pair);
    const Decision* row = is_own ? find(keys_.key(test.name, pair)) : nullptr;
    // A decision goes before a row that a run added before the file was known to be renamed.
    if (!keys_.is_identity() && (row == nullptr || row->status == DecisionStatus::undecided))
      if (const Decision* const former = find(keys_.former_key(test.name, pair))) row = former;
    return row;
  }

  [[nodiscard]] const Decision* find(const Hash128& key) const {
    const auto at = rows_.find(key);
    return at == rows_.end() ? nullptr : at->second;
  }

  void hash_lasting_ids() {
    for (const model::Object& object : model_.objects)
      if (!object.positional_id)
        lasting_.insert(clash::element_hash(model_.files[object.file].label, object.id));
  }

  /// Returns an object of a row. An id that the model has not was a position, or no result has it.
  [[nodiscard]] PlacedObject placed(const DecisionObject& object) const {
    const std::string today = keys_.label_today(object);
    const bool positional = !lasting_.contains(clash::element_hash(today, object.id));
    return {positional, keys_.group_then(object.file),
            positional ? without_numbers(object.name) : object.id};
  }

  [[nodiscard]] PlacedObject placed(model::ObjectId id) const {
    const model::Object& object = model_.object(id);
    return {object.positional_id, keys_.group_now(model_.files[object.file].label),
            valid_utf8(object.positional_id ? without_numbers(object.name) : object.id)};
  }

  void place(const Decision& row, std::vector<PlacedItem>& all) const {
    const bool named =
        !row.a.file.empty() && !row.a.id.empty() && !row.b.file.empty() && !row.b.id.empty();
    if (!named || !row.point_mm || used_.contains(&row)) return;
    const geometry::Vec3d& at = *row.point_mm;
    all.push_back({{kind_hash(row.test, 0, {placed(row.a), placed(row.b)}),
                    {at.x, at.y, at.z, row.d_mm.value_or(0)},
                    false},
                   row.key,
                   &row});
  }

  void place(const clash::Report& test, const clash::Pair& pair, const Decision*& row, bool with_d,
             std::vector<PlacedItem>& all) const {
    const geometry::Vec3d& at = pair.point_mm;
    all.push_back({{kind_hash(test.name, 0, {placed(pair.a), placed(pair.b)}),
                    {at.x, at.y, at.z, with_d ? pair.d_mm : 0},
                    true},
                   keys_.key(test.name, pair),
                   nullptr,
                   &pair,
                   &row});
  }

  const clash::Findings& findings_;
  const model::Model& model_;
  const DecisionFile& file_;
  const DecidedKeys& keys_;
  std::map<Hash128, const Decision*> rows_;
  std::unordered_set<const Decision*> used_;
  std::unordered_set<std::uint64_t> lasting_;  ///< objects whose ids are no positions
  bool has_positional_ = false;
  MatchedRows matched_;
};

}  // namespace

bool is_bare(const Decision& row) {
  return row.status == DecisionStatus::undecided && row.by.empty() && row.date.empty() &&
         row.comment.empty();
}

bool is_positional(const model::Model& model, const clash::Pair& pair) {
  return model.object(pair.a).positional_id || model.object(pair.b).positional_id;
}

bool is_same_place(const clash::Pair& pair, const Decision& row) {
  if (!row.point_mm) return false;
  const geometry::Vec3d away = pair.point_mm - *row.point_mm;
  const double deeper_mm = row.d_mm ? pair.d_mm - *row.d_mm : 0;
  const double farthest =
      std::max({std::fabs(away.x), std::fabs(away.y), std::fabs(away.z), std::fabs(deeper_mm)});
  return farthest <= kSamePlaceMm;
}

MatchedRows match_rows(const clash::Findings& findings, const model::Model& model,
                       const DecisionFile& file, const DecidedKeys& keys) {
  return RowMatcher(findings, model, file, keys).run();
}

}  // namespace strake::report
