// SPDX-License-Identifier: Apache-2.0
#include "clash/results/object_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "strake/geometry/grid.hpp"
#include "strake/parallel/count_fill.hpp"

namespace strake::clash {
namespace {

using geometry::Vec3d;

/// Converts a point relative to a part's origin to mm.
Vec3d place_mm(const ScenePart& part, const Vec3d& p) {
  return geometry::to_mm(part.placed.origin.as<double>() + p);
}

/// The result of two parts or of one region of theirs, about their objects.
struct Answer {
  Pair pair;
  const PartPairResult* of_parts = nullptr;
};

/// The rank of a result: a different rank makes it worse or less bad whatever its d.
auto standing(const Pair& p) {
  return std::tuple(p.allowed < 0, p.cls, std::max(p.level_a, p.level_b),
                    std::min(p.level_a, p.level_b));
}

/// Returns how much a relation says, the same for either order of the two: of parts that are
/// equally deep, one inside the other says less than one passing through.
int weight(Relation relation) {
  switch (relation) {
    case Relation::separate:
      return 0;
    case Relation::abut_outside:
      return 1;
    case Relation::abut_inside:
      return 2;
    case Relation::a_in_b:
    case Relation::b_in_a:
      return 3;
    case Relation::cross:
      return 4;
    case Relation::interfere:
      return 5;
    case Relation::duplicate:
      return 6;
  }
  return 0;
}

/// Returns an upper bound of the least d, without sag: relations too are of the tessellated parts.
double min_d(const std::vector<Answer>& peers) {
  double least = std::numeric_limits<double>::infinity();
  for (const Answer& peer : peers) least = std::min(least, peer.of_parts->separation.upper);
  return least;
}

/// Returns one result of those that rank as the worst one does. Where brackets leave open which of
/// them is the deepest, as between equal depths that were rounded differently, d does not choose
/// among them: the weightiest relation counts, and the witness is of it wherever that is as deep to
/// a grid unit.
Pair decisive(const Pair& worst, const std::vector<Answer>& peers) {
  const double least = min_d(peers);
  Pair pair = worst;
  Relation relation = worst.relation;
  bool a_in_b = false, b_in_a = false;
  for (const Answer& peer : peers) {
    if (peer.of_parts->separation.lower > least) continue;
    const Pair& p = peer.pair;
    a_in_b = a_in_b || p.relation == Relation::a_in_b;
    b_in_a = b_in_a || p.relation == Relation::b_in_a;
    if (weight(p.relation) > weight(relation)) relation = p.relation;
    const int gain = weight(p.relation) - weight(pair.relation);
    if (p.d_mm <= worst.d_mm + geometry::kMmPerGrid &&
        (gain > 0 || (gain == 0 && is_more_severe(p, pair))))
      pair = p;
  }
  // Neither object lies in the other where each has a part that does.
  const bool nested = weight(relation) == weight(Relation::a_in_b);
  pair.relation = nested && a_in_b && b_in_a ? Relation::interfere : relation;
  return pair;
}

/// Whether no work limit left a bracket, down to that of a result, wider than the grid accounts
/// for.
bool is_complete(const SignedSeparation& s, double upper) {
  return s.depth_complete || upper - s.lower <= kBorderlineWidth;
}

/// Widens the bracket: the d of two objects is the least of their parts', and so is either end of
/// its bracket.
void widen_bracket(Pair& pair, const std::vector<Answer>& peers) {
  for (const Answer& peer : peers) {
    pair.d_lower_mm = std::min(pair.d_lower_mm, peer.pair.d_lower_mm);
    pair.d_upper_mm = std::min(pair.d_upper_mm, peer.pair.d_upper_mm);
  }
  pair.depth_complete = std::ranges::all_of(peers, [least = min_d(peers)](const Answer& peer) {
    return is_complete(peer.of_parts->separation, least);
  });
  pair.d_upper_mm = std::max(pair.d_mm, pair.d_upper_mm);
}

/// Returns the severest class that the brackets permit where no rule allows it, Pair::severest of
/// all results.
Class severest_open(const std::vector<Answer>& answers) {
  Class severest = Class::no_hit;
  for (const Answer& answer : answers) severest = std::max(severest, answer.pair.severest);
  return severest;
}

/// Whether the results of a pair of objects begin at `i` and it is not NO_HIT: any result that is
/// not NO_HIT is worse than those that are.
bool begins(const PartResults& results, std::size_t i) {
  if (i > 0 && results.same_objects(i - 1, i)) return false;
  const std::size_t first = i;
  for (; i < results.found.size() && results.same_objects(first, i); ++i)
    if (results.found[i].answer->classification.cls != Class::no_hit) return true;
  return false;
}

/// Returns the pair of objects whose results begin at `first`; of the regions of two parts one
/// decides.
Pair join(const PartResults& results, std::size_t first) {
  std::vector<Answer> answers;
  for (std::size_t i = first; i < results.found.size() && results.same_objects(first, i); ++i)
    if (results.found[i].decides) answers.push_back({results.pair(i), results.found[i].answer});
  const Class severest = severest_open(answers);
  Pair pair = std::ranges::min_element(answers, is_more_severe, &Answer::pair)->pair;
  if (answers.size() > 1) {
    std::erase_if(answers, [at = standing(pair)](const Answer& answer) {
      return standing(answer.pair) != at;
    });
    pair = decisive(pair, answers);
    widen_bracket(pair, answers);
  }
  // Other parts of the two may turn out worse than the deciding ones.
  const Class known = pair.allowed < 0 ? pair.cls : Class::no_hit;
  if (severest > known) pair.flags |= kUncertain;
  pair.severest = severest;
  pair.first_region = static_cast<std::uint32_t>(first);
  return pair;
}

}  // namespace

/// What a rule allows never hides what none allows, and a soft part never hides a hard one.
bool is_more_severe(const Pair& x, const Pair& y) {
  const auto open = [](const Pair& p) { return p.allowed < 0 && p.cls != Class::no_hit; };
  if (open(x) != open(y)) return open(x);
  if (x.cls != y.cls) return x.cls > y.cls;
  const auto rest = [](const Pair& p) {
    return std::tuple(std::max(p.level_a, p.level_b), std::min(p.level_a, p.level_b), p.d_mm,
                      p.point_mm, p.part_a, p.part_b);
  };
  return rest(x) < rest(y);
}

std::optional<geometry::Box3d> PartResults::extent_mm(std::size_t i) const {
  if (found[i].extent == nullptr) return std::nullopt;
  return geometry::Box3d{place_mm(a(i), found[i].extent->lo), place_mm(a(i), found[i].extent->hi)};
}

Pair PartResults::pair(std::size_t i) const {
  const ScenePart &x = a(i), &y = b(i);
  const PartPairResult& answer = *found[i].answer;
  const SignedSeparation& s = answer.separation;
  const Witness& w = answer.witness;
  Pair pair;
  pair.a = model::ObjectId{x.object};
  pair.b = model::ObjectId{y.object};
  pair.cls = answer.classification.cls;
  pair.severest = answer.classification.severest;
  pair.relation = answer.relation;
  pair.flags = answer.classification.flags;
  pair.d_mm = s.d / geometry::kGridPerMm;
  pair.d_lower_mm = (s.lower - s.sag - s.moved) / geometry::kGridPerMm;
  pair.d_upper_mm = (s.upper + s.sag + s.moved) / geometry::kGridPerMm;
  pair.point_mm = place_mm(x, w.point());
  pair.on_a_mm = place_mm(x, w.on_a);
  pair.on_b_mm = place_mm(x, w.on_b);
  pair.away = w.away;
  pair.deep_in_a = w.deep_in_a;
  pair.depth_complete = is_complete(s, s.upper);
  pair.part_a = x.number;
  pair.part_b = y.number;
  pair.level_a = rules.level(x);
  pair.level_b = rules.level(y);
  rules.allow(x, y, {extent_mm(i), found[i].common}, pair);
  return pair;
}

Result<std::vector<Pair>> aggregate_by_object(const PartResults& results,
                                              const parallel::Context& context) {
  // Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 4096;
  auto pairs = parallel::count_fill<Pair>(
      context, {.name = "join by objects", .n = results.found.size(), .grain = kGrain},
      [&](std::size_t i) { return std::size_t{begins(results, i) ? 1U : 0U}; },
      [&](std::size_t i, std::span<Pair> out) {
        if (!out.empty()) out.front() = join(results, i);
      });
  if (!pairs) return pairs.error();
  return std::move(pairs->values);
}

}  // namespace strake::clash
