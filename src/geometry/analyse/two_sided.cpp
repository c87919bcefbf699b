// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/two_sided.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "geometry/analyse/nest.hpp"

namespace strake::geometry {
namespace {

bool same_corners(const Triangle& a, const Triangle& b) {
  return a[0] == b[0] && ((a[1] == b[1] && a[2] == b[2]) || (a[1] == b[2] && a[2] == b[1]));
}

/// What runs back along a shell.
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

FarSides find_far_sides(const GridMesh& welded, const ShellLabels& labels,
                        std::span<const ClosedShell> shells, std::span<const Part> parts,
                        std::span<const std::uint32_t> parents) {
  FarSides far{std::vector<bool>(shells.size()), {}};
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
