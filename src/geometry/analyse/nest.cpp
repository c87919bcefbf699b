// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/nest.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "strake/geometry/bvh.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/part_tree.hpp"

namespace strake::geometry {
namespace {

bool box_within(const Box3i& inner, const Box3i& outer) {
  for (int k = 0; k < 3; ++k)
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  return true;
}

/// (inner, outer) for every shell whose box lies in another's, with the smaller volume inside;
/// by inner shell, then by the volume of the outer.
std::vector<IndexPair> candidates(std::span<const Part> shells) {
  std::vector<BoxItem> items;
  items.reserve(shells.size());
  for (std::uint32_t i = 0; i < shells.size(); ++i)
    items.push_back(
        {{shells[i].box.lo.as<std::int64_t>(), shells[i].box.hi.as<std::int64_t>()}, i});
  // Without a stop token neither call can fail.
  const Result<BoxTree> tree = BoxTree::build(items, {});
  const Result<std::vector<IndexPair>> meeting =
      tree ? meeting_pairs(*tree, {}) : Result<std::vector<IndexPair>>(tree.error());
  std::vector<IndexPair> pairs;
  if (!meeting) return pairs;
  for (IndexPair p : *meeting) {
    if (shells[p.first].volume > shells[p.second].volume) std::swap(p.first, p.second);
    if (box_within(shells[p.first].box, shells[p.second].box)) pairs.push_back(p);
  }
  std::sort(pairs.begin(), pairs.end(), [&](const IndexPair& a, const IndexPair& b) {
    if (a.first != b.first) return a.first < b.first;
    const double va = shells[a.second].volume, vb = shells[b.second].volume;
    return va != vb ? va < vb : a.second < b.second;
  });
  return pairs;
}

/// Trees over the shells, made when first asked for.
class Trees {
 public:
  explicit Trees(std::span<const Part> shells) : shells_(shells), trees_(shells.size()) {}
  [[nodiscard]] TreedPart treed(std::uint32_t shell) {
    std::optional<PartTree>& tree = trees_[shell];
    if (!tree) tree.emplace(shells_[shell]);
    return {{&shells_[shell], {}}, &*tree};
  }

 private:
  std::span<const Part> shells_;
  std::vector<std::optional<PartTree>> trees_;
};

}  // namespace

std::vector<std::uint32_t> find_parents(std::span<const Part> shells) {
  std::vector<std::uint32_t> parents(shells.size(), kNoShell);
  Trees trees(shells);
  PairWork work;
  for (const IndexPair& pair : candidates(shells)) {
    if (parents[pair.first] != kNoShell) continue;
    const TreedPart inner = trees.treed(pair.first), outer = trees.treed(pair.second);
    if (!fits_pair(inner.placed, outer.placed)) continue;
    if (meet(inner, outer, work).a_within_b) parents[pair.first] = pair.second;
  }
  return parents;
}

}  // namespace strake::geometry
