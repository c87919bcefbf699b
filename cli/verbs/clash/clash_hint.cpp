// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_hint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "core/text_encoding.hpp"
#include "model/object_assemblies.hpp"

namespace strake::cli {

namespace {

/// So few hits are looked at one by one.
constexpr std::uint64_t kMinHits = 20;

/// What an object is a part of: its assembly, or its file where it has none.
struct AssemblyOrFile {
  model::GroupId assembly = model::GroupId::none;
  std::uint32_t file = 0;

  [[nodiscard]] bool is_file() const { return assembly == model::GroupId::none; }
  friend auto operator<=>(const AssemblyOrFile&, const AssemblyOrFile&) = default;
};

/// The hits of a run by what they are between.
struct HitsByWhole {
  std::uint64_t all = 0, within = 0;  ///< `within` one
  std::map<std::pair<AssemblyOrFile, AssemblyOrFile>, std::uint64_t> by_pair;
};

HitsByWhole hits_of(const clash::Findings& findings, const model::Model& model,
                    const model::ObjectAssemblies& assemblies,
                    const report::DecidedResults* decided) {
  const auto whole_of = [&](model::ObjectId id) {
    return AssemblyOrFile{assemblies.of(id), model.object(id).file};
  };
  HitsByWhole hits;
  for (std::size_t t = 0; t < findings.tests.size(); ++t)
    for (const clash::Pair& pair : findings.tests[t].pairs) {
      if (pair.cls != clash::Class::hit || pair.allowed >= 0) continue;
      if (decided != nullptr && decided->is_settled(t, pair)) continue;
      ++hits.all;
      const AssemblyOrFile a = whole_of(pair.a), b = whole_of(pair.b);
      // Between two files, or within one, all hits lie: that is no news.
      if (a.is_file() && b.is_file() && model.files.size() < 3) continue;
      if (a == b) ++hits.within;
      ++hits.by_pair[{std::min(a, b), std::max(a, b)}];
    }
  return hits;
}

/// Returns the hint about hits between parts of one assembly, if they are half of all.
std::string hint_of_parts(const HitsByWhole& hits, bool typed) {
  constexpr std::uint64_t kMinPart = 2;
  if (hits.within * kMinPart < hits.all) return {};
  return fmt::format(
      "{} of {} hits lie between parts of one assembly: --group-by assembly has a line for each; "
      "{}[[same_assembly]] of a rules file leaves them out",
      hits.within, hits.all, typed ? "--profile plant or " : "");
}

/// Returns the hint about the pair of assemblies with most hits, if it has a quarter of all.
std::string hint_of_pair(const HitsByWhole& hits, const model::Model& model) {
  constexpr std::uint64_t kMinPart = 4;
  const auto largest =
      std::ranges::max_element(hits.by_pair, {}, [](const auto& entry) { return entry.second; });
  if (largest == hits.by_pair.end() || largest->second * kMinPart < hits.all) return {};
  const auto name = [&](const AssemblyOrFile& whole) {
    return printable(whole.is_file() ? model.files[whole.file].label
                                     : model.groups[index(whole.assembly)].name);
  };
  const auto& [a, b] = largest->first;
  return fmt::format("{} of {} hits lie {}: --group-by assembly makes them one line",
                     largest->second, hits.all,
                     a == b ? "within " + name(a) : "between " + name(a) + " and " + name(b));
}

}  // namespace

std::string concentration_hint(const clash::Findings& findings, const model::Model& model,
                               const report::DecidedResults* decided) {
  std::uint64_t count = 0;
  for (const clash::Report& test : findings.tests) count += test.count_hit;
  if (count < kMinHits) return {};
  const model::ObjectAssemblies assemblies(model);
  const HitsByWhole hits = hits_of(findings, model, assemblies, decided);
  if (hits.all < kMinHits) return {};
  const std::string within = hint_of_parts(hits, assemblies.typed());
  return within.empty() ? hint_of_pair(hits, model) : within;
}

}  // namespace strake::cli
