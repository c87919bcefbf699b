// SPDX-License-Identifier: Apache-2.0
#include "peers/known_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace strake::bench {

using geometry::IndexPair;

KnownPairs known_from(const clash::Report& report, double reach_mm) {
  constexpr double kRounding_mm = 0.01;
  KnownPairs known;
  for (const clash::Pair& p : report.pairs) {
    const IndexPair pair{model::index(p.a), model::index(p.b)};
    const bool nested =
        p.relation == clash::Relation::a_in_b || p.relation == clash::Relation::b_in_a;
    if (nested)
      known.nested.insert(pair);
    else if (p.relation == clash::Relation::interfere && p.d_mm < -kRounding_mm)
      known.crossing.insert(pair);
    else if (p.d_mm <= kRounding_mm)
      known.touching.insert(pair);
    else if (p.d_mm < reach_mm - kRounding_mm)
      known.near.insert(pair);
  }
  return known;
}

FoundPairs::FoundPairs(const std::vector<IndexPair>& found, const KnownPairs& known,
                       const PairQuestion& question)
    : known_(known), question_(question), all_(found.size()) {
  for (const IndexPair& pair : found) {
    const bool near = known.near.contains(pair);
    if (known.crossing.contains(pair))
      ++crossing_;
    else if (known.touching.contains(pair))
      ++touching_;
    else if (known.nested.contains(pair))
      ++nested_;
    else if (!near || !question.distances)
      ++extra_;
    if (near) ++near_;
  }
}

bool FoundPairs::right() const {
  const double largest = question_.extra_percent / 100 * static_cast<double>(all_);
  return crossing_ == known_.crossing.size() &&
         (!question_.distances || near_ == known_.near.size()) &&
         static_cast<double>(extra_) <= largest;
}

std::string FoundPairs::text() const {
  std::string near;
  if (question_.distances) near = fmt::format(" and {} near", near_);
  return fmt::format("all {} crossing{} pairs found, {}", crossing_, near, beside());
}

std::string FoundPairs::fault() const {
  std::string text = fmt::format("{} of {} crossing pairs, {} of {} near ones", crossing_,
                                 known_.crossing.size(), near_, known_.near.size());
  if (extra_ > 0)
    text += fmt::format(", {} of {} found are none, {} % are known", extra_, all_,
                        question_.extra_percent);
  return text;
}

std::string FoundPairs::beside() const {
  std::string text = fmt::format("{} of {} touches called overlaps, {} of {} nested found",
                                 touching_, known_.touching.size(), nested_, known_.nested.size());
  if (extra_ > 0) text += fmt::format(", and {} pairs that are apart", extra_);
  return text;
}

}  // namespace strake::bench
