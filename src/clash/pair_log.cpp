// SPDX-License-Identifier: Apache-2.0
#include "clash/pair_log.hpp"

#include <utility>

namespace strake::clash {

void PairLog::add(const geometry::IndexPair& pair, const NarrowWork& work, bool repeated) {
  const model::ObjectId a{list_.parts[pair.first].object}, b{list_.parts[pair.second].object};
  if (pairs_.empty() || pairs_.back().a != a || pairs_.back().b != b) {
    pairs_.emplace_back();
    pairs_.back().a = a;
    pairs_.back().b = b;
  }
  LoggedPair& logged = pairs_.back();
  ++logged.part_pairs;
  if (repeated) ++logged.repeated_part_pairs;
  logged.node_pairs += work.pair.node_pairs;
  logged.triangle_pairs += work.pair.triangle_pairs;
  logged.exact_fallbacks += work.pair.exact_fallbacks;
  logged.depth_cells += work.depth_cells;
}

void PairLog::close(Report& report) {
  std::size_t at = 0;
  for (const Pair& pair : report.pairs) {
    while (at < pairs_.size() && (pairs_[at].a != pair.a || pairs_[at].b != pair.b)) ++at;
    if (at < pairs_.size()) pairs_[at].cls = pair.cls;
  }
  report.log = std::move(pairs_);
}

}  // namespace strake::clash
