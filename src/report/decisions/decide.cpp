// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "report/decisions/decision_files.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

/// How far a clash may be from the place that a file states: a spreadsheet rounds numbers.
constexpr double kSamePlaceMm = 0.01;

bool is_same_place(const clash::Pair& pair, const Decision& row) {
  if (!row.point_mm || !row.d_mm) return false;
  const geometry::Vec3d away = pair.point_mm - *row.point_mm;
  const double farthest = std::max(
      {std::fabs(away.x), std::fabs(away.y), std::fabs(away.z), std::fabs(pair.d_mm - *row.d_mm)});
  return farthest <= kSamePlaceMm;
}

Reopened reopened(const clash::Pair& pair, const Decision& row, double deeper_mm) {
  if (row.status == DecisionStatus::resolved) return Reopened::found_again;
  if (row.status != DecisionStatus::approved) return Reopened::no;
  if (row.d_mm && pair.d_mm < *row.d_mm - deeper_mm) return Reopened::deeper;
  return row.regions > 0 && pair.regions > row.regions ? Reopened::more_regions : Reopened::no;
}

/// Finds the decision about a result by the key that it has, or had.
class DecisionLookup {
 public:
  DecisionLookup(const model::Model& model, const DecisionFile& file, const FileMatches& files)
      : model_(model), keys_(files, model, file) {
    for (const Decision& row : file.decisions) rows_.emplace(row.key, &row);
  }

  [[nodiscard]] const Decision* find(const clash::Report& test, const clash::Pair& pair) const {
    const bool is_own = keys_.is_identity() || !keys_.has_label_of_another(pair);
    const Decision* row = is_own ? find(keys_.key(test.name, pair)) : nullptr;
    // A decision goes before a row that a run added before the file was known to be renamed.
    if (!keys_.is_identity() && (row == nullptr || row->status == DecisionStatus::undecided))
      if (const Decision* const former = find(keys_.former_key(test.name, pair))) row = former;
    const bool positional =
        model_.object(pair.a).positional_id || model_.object(pair.b).positional_id;
    return row != nullptr && positional && !is_same_place(pair, *row) ? nullptr : row;
  }

 private:
  [[nodiscard]] const Decision* find(const Hash128& key) const {
    const auto at = rows_.find(key);
    return at == rows_.end() ? nullptr : at->second;
  }

  const model::Model& model_;
  DecidedKeys keys_;
  std::map<Hash128, const Decision*> rows_;
};

auto objects_of(const DecidedResult& r) { return std::tuple(r.a, r.b); }

}  // namespace

std::string_view name(Reopened reopened) {
  switch (reopened) {
    case Reopened::no:
      return "";
    case Reopened::deeper:
      return "deeper";
    case Reopened::more_regions:
      return "more places";
    case Reopened::found_again:
      return "found again";
  }
  return "";
}

const DecidedResult* DecidedResults::of(std::size_t test, const clash::Pair& pair) const {
  const std::vector<DecidedResult>& decided = tests[test];
  const std::tuple sought(pair.a, pair.b);
  const auto at = std::ranges::lower_bound(decided, sought, {}, objects_of);
  return at == decided.end() || objects_of(*at) != sought ? nullptr : &*at;
}

std::uint64_t DecidedResults::count(Reopened reopened) const {
  std::uint64_t count = 0;
  for (const std::vector<DecidedResult>& test : tests)
    for (const DecidedResult& r : test)
      if (!r.allowed && r.reopened == reopened) ++count;
  return count;
}

Result<DecidedResults> decide(const clash::Findings& findings, const model::Model& model,
                              const DecisionFile& file, const DecisionRules& rules) {
  Result<FileMatches> files = match_decided_files(findings, model, file, rules.match_files);
  if (!files) return files.error();
  DecidedResults decided;
  decided.file = &file;
  decided.deeper_mm = rules.deeper_mm;
  decided.files = std::move(*files);
  const DecisionLookup lookup(model, file, decided.files);
  std::vector<const Decision*> found;
  for (const clash::Report& test : findings.tests) {
    std::vector<DecidedResult>& of_test = decided.tests.emplace_back();
    for (const clash::Pair& pair : test.pairs) {
      const Decision* const row = lookup.find(test, pair);
      const bool allowed = pair.allowed >= 0;
      if (!allowed)
        ++decided.counts[static_cast<std::size_t>(row == nullptr ? DecisionStatus::undecided
                                                                 : row->status)];
      if (row == nullptr) continue;
      found.push_back(row);
      of_test.push_back(
          {pair.a, pair.b, pair.cls, allowed, reopened(pair, *row, rules.deeper_mm), row});
    }
    std::ranges::sort(of_test, {}, objects_of);
  }
  std::ranges::sort(found);
  for (const Decision& row : file.decisions)
    if (!std::ranges::binary_search(found, &row)) decided.not_found.push_back(&row);
  return decided;
}

}  // namespace strake::report
