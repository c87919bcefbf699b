// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "model/assemblies.hpp"

namespace strake::cli {

namespace {

/// So few hits are looked at one by one.
constexpr std::uint64_t kLeastHits = 20;

using Assembly = model::GroupId;

/// The hits of a run by what they are between.
struct HitsByAssembly {
  std::uint64_t all = 0, within = 0;
  std::map<std::pair<Assembly, Assembly>, std::uint64_t> between;
};

HitsByAssembly hits_of(const clash::Findings& findings, const std::vector<Assembly>& assemblies) {
  HitsByAssembly hits;
  for (const clash::Report& test : findings.tests)
    for (const clash::Pair& pair : test.pairs) {
      if (pair.cls != clash::Class::hit || pair.allowed >= 0) continue;
      ++hits.all;
      const Assembly a = assemblies[index(pair.a)], b = assemblies[index(pair.b)];
      if (a == Assembly::none || b == Assembly::none) continue;
      if (a == b)
        ++hits.within;
      else
        ++hits.between[std::minmax(a, b)];
    }
  return hits;
}

bool is_most(std::uint64_t some, std::uint64_t all) { return 2 * some > all; }

}  // namespace

std::vector<std::string> clash_hints(const clash::Findings& findings, const model::Model& model) {
  std::uint64_t count = 0;
  for (const clash::Report& test : findings.tests) count += test.count_hit;
  if (count < kLeastHits) return {};
  const HitsByAssembly hits = hits_of(findings, model::assemblies_of(model));
  std::vector<std::string> hints;
  if (is_most(hits.within, hits.all))
    hints.push_back(
        fmt::format("hint: {} of {} hits are between parts of one equipment, structure or branch "
                    "(--profile plant leaves these out)",
                    hits.within, hits.all));
  const auto most =
      std::ranges::max_element(hits.between, {}, [](const auto& entry) { return entry.second; });
  if (most != hits.between.end() && is_most(most->second, hits.all))
    hints.push_back(
        fmt::format("hint: {} of {} hits are between {} and {} (--group-by assembly "
                    "puts them into one row)",
                    most->second, hits.all, model.groups[index(most->first.first)].name,
                    model.groups[index(most->first.second)].name));
  return hints;
}

}  // namespace strake::cli
