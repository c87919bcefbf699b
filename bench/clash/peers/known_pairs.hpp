// SPDX-License-Identifier: Apache-2.0
// What peers must find, and what they found.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/clash/clash.hpp"

namespace strake::bench {

/// What is known of the pairs: Strake's report, once the truth has confirmed it.
struct KnownPairs {
  std::set<geometry::IndexPair> crossing;  ///< surfaces cross, deeper than rounding could hide
  std::set<geometry::IndexPair> touching;  ///< at about 0
  std::set<geometry::IndexPair> nested;    ///< one wholly inside the other
  std::set<geometry::IndexPair> near;      ///< apart by less than the reach, but for rounding
};
[[nodiscard]] KnownPairs known_from(const clash::Report& report, double reach_mm);

/// What is requested of a peer, and what can be promised for it.
struct PairQuestion {
  std::string text;
  bool distances = false;      ///< near pairs, too
  double extra_percent = 0.5;  ///< of what it finds may be none of what was requested of it
};

/// How what a peer found compares with what is known.
class FoundPairs {
 public:
  FoundPairs(const std::vector<geometry::IndexPair>& found, const KnownPairs& known,
             const PairQuestion& question);

  /// Every crossing pair, and every near one where that is requested; no more others than stated.
  [[nodiscard]] bool right() const;
  /// Returns "all 51 crossing pairs found, 0 others that are apart; ...".
  [[nodiscard]] std::string text() const;
  /// Returns "51 of 51 crossing pairs, 3 of 3 near ones": where it is wrong.
  [[nodiscard]] std::string fault() const;
  /// Returns what is no error: touches, nested pairs and pairs apart.
  [[nodiscard]] std::string beside() const;

 private:
  const KnownPairs& known_;
  const PairQuestion& question_;
  std::size_t all_ = 0, crossing_ = 0, touching_ = 0, nested_ = 0, near_ = 0, extra_ = 0;
};

}  // namespace strake::bench
