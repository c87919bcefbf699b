// SPDX-License-Identifier: Apache-2.0
#include "clash/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"

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
  rules.allow(a, b, pair);
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

/// Answers about pairs of objects, joined by object.
class Join {
 public:
  Join(const std::vector<Found>& found, const std::vector<geometry::IndexPair>& candidates,
       const PartList& list, const PairRules& rules)
      : found_(found), candidates_(candidates), list_(list), rules_(rules) {}

  [[nodiscard]] bool same_objects(std::size_t i, std::size_t j) const {
    return a(i).object == a(j).object && b(i).object == b(j).object;
  }

  /// Appends the pair of objects whose answers begin at `i`, if it is not NO_HIT.
  void append(std::size_t i, std::vector<Pair>& out) const {
    Pair worst = pair(i);
    Class severest = Class::no_hit;  // that the brackets of what no rule allows permit
    const std::size_t first = i;
    for (; i < found_.size() && same_objects(first, i); ++i) {
      const Pair next = pair(i);
      if (more_severe(next, worst)) worst = next;
      if (next.allowed < 0) severest = std::max(severest, found_[i].answer->judgement.severest);
    }
    // Other parts of the two may turn out worse than the deciding ones.
    const Class known = worst.allowed < 0 ? worst.cls : Class::no_hit;
    if (severest > known) worst.flags |= kUncertain;
    if (worst.cls != Class::no_hit) out.push_back(worst);
  }

 private:
  [[nodiscard]] const PartRef& a(std::size_t i) const {
    return list_.parts[candidates_[found_[i].candidate].first];
  }
  [[nodiscard]] const PartRef& b(std::size_t i) const {
    return list_.parts[candidates_[found_[i].candidate].second];
  }
  [[nodiscard]] Pair pair(std::size_t i) const {
    return pair_of(*found_[i].answer, a(i), b(i), rules_);
  }

  const std::vector<Found>& found_;
  const std::vector<geometry::IndexPair>& candidates_;
  const PartList& list_;
  const PairRules& rules_;
};

}  // namespace

Result<std::vector<Pair>> join_by_objects(const std::vector<Found>& found,
                                          const std::vector<geometry::IndexPair>& candidates,
                                          const PartList& list, const PairRules& rules,
                                          const parallel::Context& context) {
  constexpr std::size_t kGrain = 4096;
  const Join join(found, candidates, list, rules);
  return parallel::collect<Pair>(context,
                                 {.name = "join by objects", .n = found.size(), .grain = kGrain},
                                 [&](std::size_t i, std::vector<Pair>& out) {
                                   if (i == 0 || !join.same_objects(i - 1, i)) join.append(i, out);
                                 });
}

}  // namespace strake::clash
