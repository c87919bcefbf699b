// SPDX-License-Identifier: Apache-2.0
#include "geometry/section/outline.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace strake::geometry::section {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

Directed ascending(const Directed& ends) {
  return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

/// What meets at a vertex: the stretches that end and begin there, where they are one each.
struct Meeting {
  std::uint32_t in = kNone, out = kNone;
  std::uint32_t count = 0;
};

}  // namespace

Outline outline_of(std::vector<Stretch> stretches, std::span<const Vec3l> vertices,
                   const std::function<bool(std::uint32_t, std::uint32_t)>& coplanar) {
  std::map<std::uint32_t, Meeting> meetings;
  std::map<Directed, std::uint32_t> lying;  // how many lie on each other
  for (const Stretch& s : stretches) ++lying[ascending(s.ends)];
  for (std::uint32_t i = 0; i < stretches.size(); ++i) {
    Meeting &from = meetings[stretches[i].ends[0]], &to = meetings[stretches[i].ends[1]];
    from.out = i;
    to.in = i;
    ++from.count;
    ++to.count;
  }
  Outline result;
  std::vector<std::uint32_t> next(stretches.size(), kNone), last(stretches.size(), kNone);
  for (const auto& [vertex, m] : meetings) {
    if (m.count % 2 != 0) ++result.open_ends;
    if (m.count != 2 || m.in == kNone || m.out == kNone || m.in == m.out) continue;
    const Stretch &in = stretches[m.in], &out = stretches[m.out];
    if (lying[ascending(in.ends)] > 1 || lying[ascending(out.ends)] > 1) continue;
    if (!coplanar(in.triangle, out.triangle)) continue;
    next[m.in] = m.out;
    last[m.out] = m.in;
  }
  std::set<Directed> drawn;
  for (std::uint32_t i = 0; i < stretches.size(); ++i) {
    if (last[i] != kNone) continue;
    std::uint32_t end = i;
    while (next[end] != kNone) end = next[end];
    const Directed ends = ascending({stretches[i].ends[0], stretches[end].ends[1]});
    if (!drawn.insert(ends).second) continue;
    const Vec3l &p = vertices[ends[0]], &q = vertices[ends[1]];
    if (p != q) result.lines.push_back({std::min(p, q), std::max(p, q)});
  }
  return result;
}

}  // namespace strake::geometry::section
