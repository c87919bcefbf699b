// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/shell_containment.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/triangle_bvh.hpp"

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
  const Result<SceneBvh> tree = SceneBvh::build(items, {});
  const Result<std::vector<IndexPair>> meeting =
      tree ? overlapping_box_pairs(*tree, {}) : Result<std::vector<IndexPair>>(tree.error());
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

/// Trees over the shells, made when first requested.
class Trees {
 public:
  explicit Trees(std::span<const Part> shells) : shells_(shells), trees_(shells.size()) {}
  [[nodiscard]] PartWithBvh treed(std::uint32_t shell) {
    std::optional<TriangleBvh>& tree = trees_[shell];
    if (!tree) tree.emplace(shells_[shell]);
    return {{&shells_[shell], {}}, &*tree};
  }

 private:
  std::span<const Part> shells_;
  std::vector<std::optional<TriangleBvh>> trees_;
};

}  // namespace

std::vector<std::uint32_t> find_containing_shells(std::span<const Part> shells) {
  std::vector<std::uint32_t> parents(shells.size(), kNoShell);
  Trees trees(shells);
  QueryContext work;
  for (const IndexPair& pair : candidates(shells)) {
    if (parents[pair.first] != kNoShell) continue;
    const PartWithBvh inner = trees.treed(pair.first), outer = trees.treed(pair.second);
    if (!fits_pair(inner.placed, outer.placed)) continue;
    if (meet(inner, outer, work).a_within_b) parents[pair.first] = pair.second;
  }
  return parents;
}

namespace {

bool same_corners(const Triangle& a, const Triangle& b) {
  return a[0] == b[0] && ((a[1] == b[1] && a[2] == b[2]) || (a[1] == b[2] && a[2] == b[1]));
}

/// The surfaces of opposite orientation along a shell.
struct Lining {
  bool complete = true;               ///< each of its triangles comes back somewhere
  std::vector<std::uint32_t> shells;  ///< of the other sign, ascending
  std::vector<std::uint32_t> fins;    ///< triangles that come back in the shell itself

  [[nodiscard]] bool whole() const { return complete && !shells.empty(); }
  [[nodiscard]] bool has(std::uint32_t shell) const {
    return std::binary_search(shells.begin(), shells.end(), shell);
  }
};

class Linings {
 public:
  Linings(const GridMesh& welded, const ShellLabels& labels, std::span<const ClosedShell> shells)
      : triangles_(welded.triangles), shells_(shells), linings_(shells.size()) {
    std::vector<std::uint32_t> closed(labels.count, kNoShell);
    for (std::uint32_t i = 0; i < shells.size(); ++i) closed[shells[i].label] = i;
    // Triangles with the same corners are neighbours in the order of weld_triangles().
    for (std::size_t first = 0, end = 0; first < triangles_.size(); first = end) {
      for (end = first + 1;
           end < triangles_.size() && same_corners(triangles_[first], triangles_[end]);)
        ++end;
      for (std::size_t t = first; t < end; ++t)
        if (const std::uint32_t s = closed[labels.shell[t]]; s != kNoShell)
          line(s, t, first, end, labels, closed);
    }
  }

  /// Two shells of opposite signs round the same body, whatever their triangles.
  void pair(std::uint32_t a, std::uint32_t b) {
    for (const auto& [own, other] : {std::pair{a, b}, std::pair{b, a}}) {
      linings_[own].complete = true;
      linings_[own].shells.push_back(other);
    }
  }

  std::vector<Lining> take() && {
    for (Lining& l : linings_) {
      std::sort(l.shells.begin(), l.shells.end());
      l.shells.erase(std::unique(l.shells.begin(), l.shells.end()), l.shells.end());
    }
    return std::move(linings_);
  }

 private:
  void line(std::uint32_t s, std::size_t t, std::size_t first, std::size_t end,
            const ShellLabels& labels, std::span<const std::uint32_t> closed) {
    Lining& lining = linings_[s];
    bool fin = false;
    for (std::size_t u = first; u < end; ++u) {
      if (triangles_[u][1] == triangles_[t][1]) continue;
      const std::uint32_t other = closed[labels.shell[u]];
      if (other == kNoShell) continue;
      fin |= other == s;
      if (shells_[other].sign == shells_[s].sign) continue;
      if (lining.shells.empty() || lining.shells.back() != other) lining.shells.push_back(other);
      return;
    }
    if (!fin)
      lining.complete = false;
    else if (triangles_[t][1] < triangles_[t][2])
      lining.fins.push_back(static_cast<std::uint32_t>(t));
  }

  std::span<const Triangle> triangles_;
  std::span<const ClosedShell> shells_;
  std::vector<Lining> linings_;
};

/// The shells, each after those that it lies in.
std::vector<std::uint32_t> outermost_first(std::span<const std::uint32_t> parents) {
  std::vector<std::uint32_t> depth(parents.size(), 0), order(parents.size());
  for (std::size_t i = 0; i < parents.size(); ++i)
    for (std::uint32_t p = parents[i]; p != kNoShell; p = parents[p]) ++depth[i];
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return depth[a] != depth[b] ? depth[a] < depth[b] : a < b;
  });
  return order;
}

}  // namespace

bool is_hollow(double volume, double area) { return volume <= area; }

BackShells find_back_shells(const GridMesh& welded, const ShellLabels& labels,
                            std::span<const ClosedShell> shells, std::span<const Part> parts,
                            std::span<const std::uint32_t> parents) {
  BackShells far{std::vector<bool>(shells.size()), {}};
  const auto turned = [](const ClosedShell& s) { return s.sign < 0; };
  if (std::all_of(shells.begin(), shells.end(), turned) ||
      std::none_of(shells.begin(), shells.end(), turned))
    return far;
  Linings found(welded, labels, shells);
  for (std::uint32_t i = 0; i < shells.size(); ++i) {
    const std::uint32_t p = parents[i];
    if (p != kNoShell && shells[i].sign != shells[p].sign &&
        is_hollow(parts[p].volume - parts[i].volume, parts[p].area))
      found.pair(i, p);
  }
  const std::vector<Lining> linings = std::move(found).take();
  for (const std::uint32_t i : outermost_first(parents)) {
    const Lining& lining = linings[i];
    if (!lining.whole()) continue;
    int outermost = 1, net = 0;
    for (std::uint32_t p = parents[i]; p != kNoShell; p = parents[p]) {
      if (far.shells[p] || lining.has(p)) continue;
      outermost = shells[p].sign;
      net += shells[p].sign;
    }
    if (shells[i].sign == outermost || net * outermost >= 1) continue;
    far.shells[i] = true;
    far.fins.insert(far.fins.end(), lining.fins.begin(), lining.fins.end());
  }
  return far;
}

}  // namespace strake::geometry
