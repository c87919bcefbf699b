// SPDX-License-Identifier: Apache-2.0
#include "hlr/hatch_patterns.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "strake/geometry/bvh.hpp"

namespace strake::hlr {
namespace {

using geometry::BoxItem;

constexpr std::array<double, 6> kAngles{45, 135, 30, 120, 60, 150};
/// In usual spacings.
constexpr std::array<double, 4> kSpacings{1, 1.5, 0.75, 2};
constexpr std::uint32_t kNotCut = 0xffffffffU;

/// The stretches of outlines that are hatched, as boxes that know their object.
std::vector<BoxItem> outlines(const model::Scene& scene, const SeenShapes& seen,
                              const std::vector<std::int64_t>& contact) {
  std::vector<BoxItem> items;
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const ShapeCut* cut = seen.all[seen.of[b]].cut.get();
    if (cut == nullptr) continue;
    const model::GridBody& body = scene.bodies[b];
    for (const auto& rim : cut->rims)
      for (const auto& [p, q] : rim) {
        geometry::Box3l box = geometry::empty_box<std::int64_t>();
        box.include(p + body.origin);
        box.include(q + body.origin);
        items.push_back({.box = box.inflated(contact[b]), .owner = model::index(body.object)});
      }
  }
  return items;
}

/// By object: its colour's number among the colours that are cut.
std::vector<std::uint32_t> colours(const model::Scene& scene, const SeenShapes& seen) {
  std::vector<std::uint32_t> of(scene.model->objects.size(), kNotCut);
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    std::uint32_t& colour = of[model::index(scene.bodies[b].object)];
    if (colour != kNotCut || seen.all[seen.of[b]].planes.empty()) continue;
    const model::Color& c = scene.model->bodies[scene.bodies[b].body].color;
    colour = (std::uint32_t{c.red} << 16U) | (std::uint32_t{c.green} << 8U) | c.blue;
  }
  std::vector<std::uint32_t> known = of;
  std::ranges::sort(known);
  const auto repeated = std::ranges::unique(known);
  known.erase(repeated.begin(), repeated.end());
  for (std::uint32_t& colour : of)
    if (colour != kNotCut)
      colour = static_cast<std::uint32_t>(std::ranges::lower_bound(known, colour) - known.begin());
  return of;
}

/// Of the usual angles the first that the fewest neighbours have.
double rarest_angle(const std::vector<std::uint32_t>& neighbours,
                    const std::vector<Hatch>& hatches) {
  std::array<std::size_t, kAngles.size()> had{};
  for (const std::uint32_t n : neighbours)
    for (std::size_t i = 0; i < kAngles.size(); ++i)
      if (hatches[n].angle_deg == kAngles[i]) ++had[i];
  return kAngles[static_cast<std::size_t>(std::ranges::min_element(had) - had.begin())];
}

}  // namespace

Result<std::vector<Hatch>> choose_hatches(const model::Scene& scene, const SeenShapes& seen,
                                          const std::vector<std::int64_t>& contact,
                                          const std::vector<Hatch>& given, double usual_mm,
                                          const parallel::Context& context) {
  std::vector<Hatch> hatches = given;
  hatches.resize(scene.model->objects.size());
  const std::vector<BoxItem> items = outlines(scene, seen, contact);
  const auto tree = geometry::BoxTree::build(items, context);
  if (!tree) return tree.error();
  const auto pairs = geometry::meeting_pairs(*tree, context);
  if (!pairs) return pairs.error();
  std::vector<std::vector<std::uint32_t>> neighbours(hatches.size());
  for (const auto& [first, second] : *pairs) {
    neighbours[items[first].owner].push_back(items[second].owner);
    neighbours[items[second].owner].push_back(items[first].owner);
  }
  const std::vector<std::uint32_t> colour = colours(scene, seen);
  for (std::uint32_t o = 0; o < hatches.size(); ++o) {
    if (colour[o] == kNotCut) continue;
    std::ranges::sort(neighbours[o]);
    const auto repeated = std::ranges::unique(neighbours[o]);
    neighbours[o].erase(repeated.begin(), repeated.end());
    if (hatches[o].angle_deg < 0) hatches[o].angle_deg = rarest_angle(neighbours[o], hatches);
    if (hatches[o].spacing_mm < 0)
      hatches[o].spacing_mm = usual_mm * kSpacings[colour[o] % kSpacings.size()];
  }
  return hatches;
}

}  // namespace strake::hlr
