// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "strake/clash/clash.hpp"
#include "strake/generate/ship.hpp"

namespace strake::bench {

using Key = std::pair<std::uint32_t, std::uint32_t>;

template <class PairOfObjects>
Key key_of(const PairOfObjects& p) {
  return {model::index(p.a), model::index(p.b)};
}

/// Pairs whose class is not that of the ship's own truth: missed, made up or another.
inline std::size_t wrong_pairs(const clash::Report& report, const generate::Truth& truth) {
  std::map<Key, clash::Class> open;
  for (const generate::TruthPair& p : truth.pairs) open[key_of(p)] = p.cls;
  std::size_t wrong = 0;
  for (const clash::Pair& p : report.pairs) {
    const auto at = open.find(key_of(p));
    if (at == open.end() || at->second != p.cls) ++wrong;
    if (at != open.end()) open.erase(at);
  }
  return wrong + open.size();
}

}  // namespace strake::bench
