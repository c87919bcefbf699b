// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"

namespace strake::clash {

namespace {

/// Returns the diagnostics of a test, each with the test's name in its place.
Diagnostics named(const Report& test) {
  Diagnostics all;
  for (Diagnostic d : test.diagnostics.kept()) {
    d.where = "test '" + test.name + "'" + (d.where.empty() ? "" : ", ") + d.where;
    all.add(std::move(d));
  }
  // Counts of what was not kept are added too: there are enough of its code already.
  for (const Diagnostics::Count& c : test.diagnostics.counts())
    for (std::uint64_t n = all.count(c.code); n < c.count; ++n) all.add(c.severity, c.code, {}, {});
  return all;
}

}  // namespace

Diagnostics Findings::all_diagnostics() const {
  Diagnostics all = diagnostics;
  for (const Report& test : tests) all.append(test.name.empty() ? test.diagnostics : named(test));
  return all;
}

NotComparedCounts counts_of(std::span<const Report> tests) {
  std::vector<std::pair<model::ObjectId, std::optional<model::ObjectId>>> all;
  for (const Report& test : tests)
    for (const NotCompared& what : test.not_compared) all.emplace_back(what.a, what.b);
  std::ranges::sort(all);
  NotComparedCounts counts;
  for (auto at = all.begin(), end = std::unique(all.begin(), all.end()); at != end; ++at)
    ++(at->second ? counts.pairs : counts.objects);
  return counts;
}

std::string hash_of(const Findings& findings) {
  Hasher hasher;
  for (const Report& test : findings.tests) {
    hasher.add(std::string_view(test.name));
    hasher.add(std::string_view(test.hash));
  }
  return hasher.value().text();
}

}  // namespace strake::clash
