// SPDX-License-Identifier: Apache-2.0
#include "hlr/crossings.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hlr/by_size.hpp"
#include "strake/geometry/bvh.hpp"
#include "strake/geometry/crossing_lines.hpp"
#include "strake/geometry/part_tree.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::IndexPair;
using geometry::Segment;
using geometry::Vec3l;
using parallel::Region;

constexpr std::size_t kGrain = 1024;

/// A part that has faces, where it stands.
struct PlacedSkin {
  geometry::PlacedPart placed;
  std::uint32_t unique = 0;  ///< its number among the parts of all shapes
  std::uint32_t body = 0;
  std::int64_t contact = 0;
};

struct Skins {
  std::vector<const geometry::Part*> unique;
  std::vector<PlacedSkin> placed;  ///< by body
};

Skins list_skins(const model::Scene& scene, const std::vector<bool>& drawn,
                 const std::vector<std::int64_t>& contact) {
  Skins skins;
  std::vector<std::uint32_t> first;
  for (const model::GridShape& shape : scene.shapes) {
    first.push_back(static_cast<std::uint32_t>(skins.unique.size()));
    for (const geometry::Part& part : shape.parts) skins.unique.push_back(&part);
  }
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const model::GridBody& body = scene.bodies[b];
    if (!drawn[model::index(body.object)]) continue;
    std::uint32_t number = first[body.grid_shape];
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts) {
      if (!part.triangles.empty())
        skins.placed.push_back({{&part, body.origin}, number, b, contact[b]});
      ++number;
    }
  }
  return skins;
}

class Finder {
 public:
  Finder(const model::Scene& scene, const Skins& skins, const parallel::Context& context)
      : scene_(scene), skins_(skins), context_(context) {}

  Result<std::vector<Crossing>> run(Intersections intersections) {
    if (const Status s = pair_up(intersections); !s) return s.error();
    const auto kinds = parallel::distinct(
        context_, "intersections: equal pairs", pairs_.size(),
        [&](std::size_t i) { return hash(i); },
        [&](std::size_t i, std::size_t j) { return same(i, j); });
    if (!kinds) return kinds.error();
    if (const Status s = plant(kinds->first); !s) return s.error();
    const auto order = parallel::longest_first(kinds->first.size(), [&](std::size_t k) {
      return a(kinds->first[k]).placed.part->triangles.size() +
             b(kinds->first[k]).placed.part->triangles.size();
    });
    const auto lines = parallel::transform(
        context_, {.name = "intersections: lines", .n = kinds->first.size(), .order = order},
        [&](std::size_t k) {
          const std::size_t i = kinds->first[k];
          geometry::PairWork work;
          return crossing_lines(treed(a(i)), treed(b(i)), contact(i), work);
        });
    if (!lines) return lines.error();
    return place(*kinds, *lines);
  }

 private:
  [[nodiscard]] const PlacedSkin& a(std::size_t i) const { return skins_.placed[pairs_[i].first]; }
  [[nodiscard]] const PlacedSkin& b(std::size_t i) const { return skins_.placed[pairs_[i].second]; }
  [[nodiscard]] Vec3l offset(std::size_t i) const {
    return b(i).placed.origin - a(i).placed.origin;
  }
  [[nodiscard]] std::int64_t contact(std::size_t i) const {
    return std::max(a(i).contact, b(i).contact);
  }
  [[nodiscard]] std::uint64_t hash(std::size_t i) const {
    std::uint64_t h = parallel::mixed(0, (std::uint64_t{a(i).unique} << 32U) | b(i).unique);
    const Vec3l at = offset(i);
    for (int k = 0; k < 3; ++k) h = parallel::mixed(h, static_cast<std::uint64_t>(at[k]));
    return parallel::mixed(h, static_cast<std::uint64_t>(contact(i)));
  }
  [[nodiscard]] bool same(std::size_t i, std::size_t j) const {
    return a(i).unique == a(j).unique && b(i).unique == b(j).unique && offset(i) == offset(j) &&
           contact(i) == contact(j);
  }
  [[nodiscard]] geometry::TreedPart treed(const PlacedSkin& skin) const {
    return {skin.placed, &trees_[skin.unique]};
  }

  Status pair_up(Intersections intersections) {
    const auto items = parallel::transform(
        context_, {.name = "intersections: boxes", .n = skins_.placed.size(), .grain = kGrain},
        [&](std::size_t i) {
          const PlacedSkin& skin = skins_.placed[i];
          const geometry::Box3l box = skin.placed.part->box.as<std::int64_t>();
          return geometry::BoxItem{.box = box.moved(skin.placed.origin),
                                   .owner = intersections == Intersections::parts
                                                ? static_cast<std::uint32_t>(i)
                                                : model::index(scene_.bodies[skin.body].object)};
        });
    if (!items) return items.error();
    const auto tree = geometry::BoxTree::build(*items, context_);
    if (!tree) return tree.error();
    auto pairs = geometry::meeting_pairs(*tree, context_);
    if (!pairs) return pairs.error();
    pairs_ = std::move(*pairs);
    std::erase_if(pairs_, [&](const IndexPair& pair) {
      return only_touch((*items)[pair.first].box, (*items)[pair.second].box);
    });
    return {};
  }

  /// Whether a plane along two axes has one of the boxes on its one side and the other on the
  /// other: then what is in them cannot pass through each other. Most of what meets in a ship is
  /// so.
  static bool only_touch(const geometry::Box3l& a, const geometry::Box3l& b) {
    for (int k = 0; k < 3; ++k)
      if (a.hi[k] <= b.lo[k] || b.hi[k] <= a.lo[k]) return true;
    return false;
  }

  Status plant(const std::vector<std::uint32_t>& some) {
    std::vector<bool> wanted(skins_.unique.size());
    for (const std::uint32_t i : some) wanted[a(i).unique] = wanted[b(i).unique] = true;
    trees_.resize(wanted.size());
    return parallel::for_each_by_weight(
        context_, {.name = "intersections: trees", .n = wanted.size()}, kBigShape,
        [&](std::size_t u) { return wanted[u] ? skins_.unique[u]->triangles.size() : 0; },
        [&](std::size_t u) {
          if (wanted[u]) trees_[u] = geometry::PartTree(*skins_.unique[u], context_);
        });
  }

  /// By pair, which is by object of the first part.
  Result<std::vector<Crossing>> place(const parallel::Distinct& kinds,
                                      const std::vector<std::vector<Segment>>& lines) const {
    auto placed = parallel::count_fill<Crossing>(
        context_, {.name = "intersections: places", .n = pairs_.size(), .grain = kGrain},
        [&](std::size_t i) { return lines[kinds.of[i]].size(); },
        [&](std::size_t i, std::span<Crossing> out) {
          const std::vector<Segment>& own = lines[kinds.of[i]];
          for (std::size_t k = 0; k < own.size(); ++k)
            out[k] = {own[k][0] + a(i).placed.origin, own[k][1] + a(i).placed.origin, a(i).body,
                      b(i).body};
        });
    if (!placed) return placed.error();
    return std::move(placed->values);
  }

  const model::Scene& scene_;
  const Skins& skins_;
  const parallel::Context& context_;
  std::vector<IndexPair> pairs_;
  std::vector<geometry::PartTree> trees_;  ///< by unique part, where wanted
};

}  // namespace

Result<std::vector<Crossing>> find_crossings(const model::Scene& scene,
                                             const std::vector<bool>& drawn,
                                             const std::vector<std::int64_t>& contact,
                                             Intersections intersections,
                                             const parallel::Context& context) {
  if (intersections == Intersections::off) return std::vector<Crossing>{};
  const Skins skins = list_skins(scene, drawn, contact);
  return Finder(scene, skins, context).run(intersections);
}

}  // namespace strake::hlr
