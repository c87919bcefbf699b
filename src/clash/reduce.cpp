// SPDX-License-Identifier: Apache-2.0
#include "clash/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "strake/geometry/grid.hpp"

namespace strake::clash {
namespace {

using geometry::Vec3d;

Pair pair_of(const PartAnswer& answer, const PartRef& a, const PartRef& b, const PairRules& rules) {
  const Separation& s = answer.separation;
  const Witness& w = answer.witness;
  const auto place = [&](const Vec3d& p) {
    const Vec3d at = a.placed.origin.as<double>() + p;
    return Vec3d{at.x / geometry::kGridPerMm, at.y / geometry::kGridPerMm,
                 at.z / geometry::kGridPerMm};
  };
  Pair pair;
  pair.a = model::ObjectId{a.object};
  pair.b = model::ObjectId{b.object};
  pair.cls = answer.judgement.cls;
  pair.relation = answer.relation;
  pair.flags = answer.judgement.flags;
  pair.d_mm = s.d / geometry::kGridPerMm;
  pair.d_lower_mm = (s.lower - s.sag) / geometry::kGridPerMm;
  pair.d_upper_mm = (s.upper + s.sag) / geometry::kGridPerMm;
  pair.point_mm = place(w.point());
  pair.on_a_mm = place(w.on_a);
  pair.on_b_mm = place(w.on_b);
  pair.away = w.away;
  pair.deep_in_a = w.deep_in_a;
  pair.part_a = a.number;
  pair.part_b = b.number;
  pair.level_a = rules.level(a);
  pair.level_b = rules.level(b);
  pair.allowed = rules.allows(pair);
  return pair;
}

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

}  // namespace

std::vector<Pair> join_by_objects(const std::vector<Found>& found,
                                  const std::vector<geometry::IndexPair>& candidates,
                                  const PartList& list, const PairRules& rules) {
  std::vector<Pair> pairs;
  Class severest = Class::no_hit;  // that the brackets of what no rule allows permit
  for (const Found& f : found) {
    const geometry::IndexPair& c = candidates[f.candidate];
    const Pair pair = pair_of(*f.answer, list.parts[c.first], list.parts[c.second], rules);
    if (pairs.empty() || pairs.back().a != pair.a || pairs.back().b != pair.b) {
      pairs.push_back(pair);
      severest = Class::no_hit;
    } else if (more_severe(pair, pairs.back())) {
      pairs.back() = pair;
    }
    if (pair.allowed < 0) severest = std::max(severest, f.answer->judgement.severest);
    // Other parts of the two may turn out worse than the deciding ones.
    const Class known = pairs.back().allowed < 0 ? pairs.back().cls : Class::no_hit;
    if (severest > known) pairs.back().flags |= kUncertain;
  }
  std::erase_if(pairs, [](const Pair& p) { return p.cls == Class::no_hit; });
  return pairs;
}

}  // namespace strake::clash
