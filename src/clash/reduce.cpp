// SPDX-License-Identifier: Apache-2.0
#include "clash/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "strake/geometry/grid.hpp"
#include "strake/parallel/count_fill.hpp"

namespace strake::clash {
namespace {

using geometry::Vec3d;

/// A point relative to a part's origin.
Vec3d place_mm(const PartRef& part, const Vec3d& p) {
  return geometry::to_mm(part.placed.origin.as<double>() + p);
}

/// The d of two objects is the least of their parts': so is either end of its bracket, over the
/// parts that stand as the deciding ones do.
void widen_bracket(Pair& worst, const Pair& other) {
  const auto standing = [](const Pair& p) {
    return std::tuple(p.allowed < 0, p.cls, std::max(p.level_a, p.level_b),
                      std::min(p.level_a, p.level_b));
  };
  if (standing(worst) != standing(other)) return;
  worst.d_lower_mm = std::min(worst.d_lower_mm, other.d_lower_mm);
  worst.d_upper_mm = std::max(worst.d_mm, std::min(worst.d_upper_mm, other.d_upper_mm));
}

/// What the bracket of an answer permits, where no rule allows it.
Class severest_open(const Found& found, const Pair& pair) {
  return pair.allowed < 0 ? found.answer->judgement.severest : Class::no_hit;
}

/// Whether the answers of a pair of objects begin at `i` and it is not NO_HIT: any answer that is
/// not NO_HIT is worse than those that are.
bool begins(const PartFindings& findings, std::size_t i) {
  if (i > 0 && findings.same_objects(i - 1, i)) return false;
  const std::size_t first = i;
  for (; i < findings.found.size() && findings.same_objects(first, i); ++i)
    if (findings.found[i].answer->judgement.cls != Class::no_hit) return true;
  return false;
}

/// The pair of objects whose answers begin at `first`.
Pair join(const PartFindings& findings, std::size_t first) {
  std::size_t last = first;
  std::optional<Pair> worst;
  Class severest = Class::no_hit;
  for (; last < findings.found.size() && findings.same_objects(first, last); ++last) {
    if (!findings.found[last].decides) continue;
    const Pair next = findings.pair(last);
    if (!worst || more_severe(next, *worst)) worst = next;
    severest = std::max(severest, severest_open(findings.found[last], next));
  }
  Pair pair = worst.value_or(Pair{});  // of the places of two parts one decides
  for (std::size_t i = first; i < last && last - first > 1; ++i)
    if (findings.found[i].decides) widen_bracket(pair, findings.pair(i));
  // Other parts of the two may turn out worse than the deciding ones.
  const Class known = pair.allowed < 0 ? pair.cls : Class::no_hit;
  if (severest > known) pair.flags |= kUncertain;
  pair.first_region = static_cast<std::uint32_t>(first);
  return pair;
}

}  // namespace

/// Nothing that a rule allows hides something that none allows, and nothing soft something hard.
bool more_severe(const Pair& x, const Pair& y) {
  const auto open = [](const Pair& p) { return p.allowed < 0 && p.cls != Class::no_hit; };
  if (open(x) != open(y)) return open(x);
  if (x.cls != y.cls) return x.cls > y.cls;
  const auto rest = [](const Pair& p) {
    return std::tuple(std::max(p.level_a, p.level_b), std::min(p.level_a, p.level_b), p.d_mm,
                      p.point_mm, p.part_a, p.part_b);
  };
  return rest(x) < rest(y);
}

std::optional<geometry::Box3d> PartFindings::extent_mm(std::size_t i) const {
  if (found[i].extent == nullptr) return std::nullopt;
  return geometry::Box3d{place_mm(a(i), found[i].extent->lo), place_mm(a(i), found[i].extent->hi)};
}

Pair PartFindings::pair(std::size_t i) const {
  const PartRef &x = a(i), &y = b(i);
  const PartAnswer& answer = *found[i].answer;
  const Separation& s = answer.separation;
  const Witness& w = answer.witness;
  Pair pair;
  pair.a = model::ObjectId{x.object};
  pair.b = model::ObjectId{y.object};
  pair.cls = answer.judgement.cls;
  pair.relation = answer.relation;
  pair.flags = answer.judgement.flags;
  pair.d_mm = s.d / geometry::kGridPerMm;
  pair.d_lower_mm = (s.lower - s.sag) / geometry::kGridPerMm;
  pair.d_upper_mm = (s.upper + s.sag) / geometry::kGridPerMm;
  pair.point_mm = place_mm(x, w.point());
  pair.on_a_mm = place_mm(x, w.on_a);
  pair.on_b_mm = place_mm(x, w.on_b);
  pair.away = w.away;
  pair.deep_in_a = w.deep_in_a;
  pair.part_a = x.number;
  pair.part_b = y.number;
  pair.level_a = rules.level(x);
  pair.level_b = rules.level(y);
  rules.allow(x, y, extent_mm(i), pair);
  return pair;
}

Result<std::vector<Pair>> join_by_objects(const PartFindings& findings,
                                          const parallel::Context& context) {
  constexpr std::size_t kGrain = 4096;
  auto pairs = parallel::count_fill<Pair>(
      context, {.name = "join by objects", .n = findings.found.size(), .grain = kGrain},
      [&](std::size_t i) { return std::size_t{begins(findings, i) ? 1U : 0U}; },
      [&](std::size_t i, std::span<Pair> out) {
        if (!out.empty()) out.front() = join(findings, i);
      });
  if (!pairs) return pairs.error();
  return std::move(pairs->values);
}

}  // namespace strake::clash
