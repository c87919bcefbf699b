// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <utility>

#include "report/decisions/decision_files.hpp"
#include "report/decisions/decision_match.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

Reopened reopened(const clash::Pair& pair, const Decision& row, double deeper_mm) {
  if (row.status == DecisionStatus::resolved) return Reopened::found_again;
  if (row.status != DecisionStatus::approved) return Reopened::no;
  if (row.cls && pair.cls > *row.cls) return Reopened::severer;
  if (row.d_mm && pair.d_mm < *row.d_mm - row.d_rounding_mm - deeper_mm) return Reopened::deeper;
  return row.regions > 0 && pair.regions > row.regions ? Reopened::more_regions : Reopened::no;
}

auto objects_of(const DecidedResult& r) { return std::pair(r.a, r.b); }

}  // namespace

DecisionStatus current_status(const DecidedResult* decided) {
  if (decided == nullptr) return DecisionStatus::undecided;
  const DecisionStatus status = decided->decision->status;
  if (decided->reopened == Reopened::no || status < DecisionStatus::approved) return status;
  return decided->reopened == Reopened::found_again ? DecisionStatus::undecided
                                                    : DecisionStatus::active;
}

std::string_view name(Reopened reopened) {
  switch (reopened) {
    case Reopened::no:
      return "";
    case Reopened::severer:
      return "severer";
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
  const std::pair sought(pair.a, pair.b);
  const auto at = std::ranges::lower_bound(decided, sought, {}, objects_of);
  if (at != decided.end() && objects_of(*at) == sought) return &*at;
  if (test >= others.size() || others[test].result.decision == nullptr || pair.allowed >= 0)
    return nullptr;
  const OtherResults& rest = others[test];
  return std::ranges::binary_search(rest.undecided, sought) ? nullptr : &rest.result;
}

std::uint64_t DecidedResults::count(Reopened reopened) const {
  std::uint64_t count = 0;
  for (const std::vector<DecidedResult>& test : tests)
    for (const DecidedResult& r : test)
      if (!r.allowed && r.reopened == reopened) ++count;
  return count;
}

std::uint64_t DecidedResults::count_regions_unknown() const {
  std::uint64_t count = 0;
  for (const std::vector<DecidedResult>& test : tests)
    for (const DecidedResult& r : test)
      if (r.is_settled() && r.regions_unknown) ++count;
  return count;
}

Result<DecidedResults> decide(const clash::Findings& findings, const model::Model& model,
                              const DecisionFile& file, const DecisionRules& rules) {
  Result<DecidedFiles> files = match_decided_files(findings, model, file, rules.match_files);
  if (!files) return files.error();
  DecidedResults decided;
  decided.file = &file;
  decided.deeper_mm = rules.deeper_mm;
  decided.files = std::move(files->matches);
  decided.renamed_before = std::move(files->in_force);
  MatchedRows rows = match_rows(findings, model, file, DecidedKeys(decided.files, model, file));
  std::vector<const Decision*> found = std::move(rows.replaced);
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    std::vector<DecidedResult>& of_test = decided.tests.emplace_back();
    for (std::size_t p = 0; p < findings.tests[t].pairs.size(); ++p) {
      const clash::Pair& pair = findings.tests[t].pairs[p];
      const Decision* const row = rows.tests[t][p];
      const bool allowed = pair.allowed >= 0;
      if (!allowed)
        ++decided.counts[static_cast<std::size_t>(row == nullptr ? DecisionStatus::undecided
                                                                 : row->status)];
      if (row == nullptr) continue;
      found.push_back(row);
      of_test.push_back({pair.a, pair.b, pair.cls, allowed, reopened(pair, *row, rules.deeper_mm),
                         row->regions > 0 && pair.regions == 0, row});
    }
    std::ranges::sort(of_test, {}, objects_of);
  }
  std::ranges::sort(found);
  for (const Decision& row : file.decisions)
    if (!std::ranges::binary_search(found, &row)) decided.not_found.push_back(&row);
  return decided;
}

}  // namespace strake::report
