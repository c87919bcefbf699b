// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/part_loop.hpp"
#include "geometry/point_placer.hpp"
#include "geometry/z_order.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/parallel/find.hpp"

namespace strake::geometry {
namespace {

/// Vertices that tell what one costs, and nodes of the tree that all of the others may look at each
/// before a frame for them is worth its while.
constexpr std::size_t kSamples = 32, kManyNodes = 256;
/// Fewer vertices are not worth a frame.
constexpr std::size_t kWorthAFrame = 1024;

/// What some vertices say, up to the first that is outside.
struct Vertices {
  PartCover cover{.within = true, .on_surface = true};
  PairCost cost;

  /// Whether to look at the next one.
  bool add(PointPlace place) {
    cover.on_surface = cover.on_surface && place == PointPlace::near_skin;
    cover.within = place != PointPlace::outside;
    return cover.within;
  }
};

class CoverSearch {
 public:
  CoverSearch(const TreedPart& a, const TreedPart& b, double band)
      : vertices_(a.placed.part->vertices),
        b_(b),
        shift_(a.placed.origin - b.placed.origin),
        band_(band) {}

  PartCover run(PairWork& work) {
    if (vertices_.size() >= kWorthAFrame) {
      const Vertices some = look_at_samples();
      work += some.cost;
      if (!some.cover.within) return some.cover;
      if (some.cost.node_pairs > kSamples * kManyNodes) prepare(work.context());
    }
    if (vertices_.size() < kWorthATeam) {
      const Vertices all = look_at(0, vertices_.size());
      work += all.cost;
      return all.cover;
    }
    return look_at_blocks(work);
  }

 private:
  [[nodiscard]] std::size_t blocks() const {
    return (vertices_.size() + kTeamGrain - 1) / kTeamGrain;
  }
  [[nodiscard]] Vec3l at(std::size_t vertex) const {
    return vertices_[vertex].as<std::int64_t>() + shift_;
  }

  /// For points that cost too much one by one.
  void prepare(const parallel::Context& context) {
    frame_ = frame_along_faces(b_, context);
    if (!frame_) return;
    order_ = z_order(vertices_.size(),
                     [&](std::size_t v) { return turned(frame_->axes, at(v).as<double>()); });
  }

  PartCover look_at_blocks(PairWork& work) const {
    // Up to the first that lies outside: so the cost is the same for any team.
    const auto looks = parallel::transform_until(
        work.context(), {.name = "vertices in a band", .n = blocks()},
        [&](std::size_t block) {
          return look_at(block * kTeamGrain, std::min(vertices_.size(), (block + 1) * kTeamGrain));
        },
        [](const Vertices& looked) { return !looked.cover.within; });
    PartCover cover{.within = true, .on_surface = true};
    if (!looks) return {};
    for (const Vertices& looked : *looks) {
      work += looked.cost;
      cover.within = looked.cover.within;
      cover.on_surface = cover.on_surface && looked.cover.on_surface;
    }
    return cover;
  }

  [[nodiscard]] Vertices look_at_samples() const {
    Vertices looked;
    PairWork work;
    PointPlacer placer(b_, band_, nullptr);
    for (std::size_t i = 0; i < kSamples; ++i)
      if (!looked.add(placer.place(at(i * vertices_.size() / kSamples), work))) break;
    looked.cost = work;
    return looked;
  }

  [[nodiscard]] Vertices look_at(std::size_t first, std::size_t end) const {
    Vertices looked;
    PairWork work;
    PointPlacer placer(b_, band_, frame_ ? &*frame_ : nullptr);
    for (std::size_t i = first; i < end; ++i)
      if (!looked.add(placer.place(at(order_.empty() ? i : order_[i]), work))) break;
    looked.cost = work;
    return looked;
  }

  const std::vector<Vec3i>& vertices_;
  const TreedPart& b_;
  Vec3l shift_;
  double band_;
  std::optional<TurnedFrame> frame_;
  std::vector<std::uint32_t>
      order_;  ///< of the vertices, near ones after each other; empty: theirs
};

}  // namespace

PartCover cover_by(const TreedPart& a, const TreedPart& b, double band, PairWork& work) {
  return CoverSearch(a, b, band).run(work);
}

}  // namespace strake::geometry
