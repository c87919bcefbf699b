// SPDX-License-Identifier: Apache-2.0
#include "geometry/obb/sweep_and_prune.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/rotated_part.hpp"

namespace strake::geometry {
namespace {

/// The vertices of a part in some axes.
struct Along {
  std::vector<Vec3d> at;
  Box3d box;

  Along(const PairLocalPart& view, const Axes* axes) {
    const auto count = static_cast<std::uint32_t>(view.part().vertices.size());
    at.reserve(count);
    for (std::uint32_t v = 0; v < count; ++v) {
      const Vec3d p = view.vertex(v).as<double>();
      at.push_back(axes == nullptr ? p : turned(*axes, p));
    }
    box = box_of(at);
  }
};

}  // namespace

SweepAndPrune::SweepAndPrune(const PairLocalPart& a, const PairLocalPart& b, const Axes* axes) {
  const Along along_a(a, axes), along_b(b, axes);
  const double margin = axes == nullptr ? 0 : kFrameRounding;
  const Box3d within = along_a.box.common(along_b.box).inflated(margin);
  Vec3d lengths;
  const auto gather = [&](const PairLocalPart& view, const Along& along,
                          std::vector<Swept>& swept) {
    const auto count = static_cast<std::uint32_t>(view.part().triangles.size());
    swept.reserve(count);
    for (std::uint32_t id = 0; id < count; ++id) {
      const Triangle& t = view.part().triangles[id];
      const Box3d box =
          box_of(std::array{along.at[t[0]], along.at[t[1]], along.at[t[2]]}).inflated(margin);
      if (!box.meets(within)) continue;
      swept.push_back({box.lo, box.hi, id});
      for (int k = 0; k < 3; ++k)
        lengths[k] += std::min(box.hi[k], within.hi[k]) - std::max(box.lo[k], within.lo[k]);
    }
  };
  gather(a, along_a, a_);
  gather(b, along_b, b_);
  const int first = sweep_axis(lengths, within);
  for (std::vector<Swept>* swept : {&a_, &b_}) {
    for (Swept& s : *swept) {
      std::swap(s.lo[0], s.lo[first]);
      std::swap(s.hi[0], s.hi[first]);
    }
    std::ranges::sort(*swept, {}, [](const Swept& s) { return std::pair(s.lo[0], s.id); });
  }
}

}  // namespace strake::geometry
