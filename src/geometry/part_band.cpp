// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "geometry/heavy_loop.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::geometry {
namespace {

/// What some vertices say, up to the first that is outside.
struct Vertices {
  PartCover cover{.within = true, .on_surface = true};
  PairCost cost;
};

class CoverSearch {
 public:
  CoverSearch(const TreedPart& a, const TreedPart& b, double band)
      : vertices_(a.placed.part->vertices),
        b_(b),
        shift_(a.placed.origin - b.placed.origin),
        band_(band) {}

  PartCover run(PairWork& work) const {
    if (vertices_.size() < kWorthATeam) {
      const Vertices all = look_at(0, vertices_.size());
      work += all.cost;
      return all.cover;
    }
    // Blocks behind one that lies outside are left out; those before it are all looked at, so that
    // the cost is the same for any team.
    std::atomic<std::size_t> last{blocks()};
    const auto looks = parallel::transform(
        work.context(), {.name = "vertices in a band", .n = blocks()}, [&](std::size_t block) {
          if (block > last.load(std::memory_order_relaxed)) return Vertices();
          const Vertices looked =
              look_at(block * kTeamGrain, std::min(vertices_.size(), (block + 1) * kTeamGrain));
          if (!looked.cover.within) lower(last, block);
          return looked;
        });
    PartCover cover{.within = true, .on_surface = true};
    if (!looks) return {};
    for (const Vertices& looked : *looks) {
      work += looked.cost;
      cover.within = looked.cover.within;
      cover.on_surface = cover.on_surface && looked.cover.on_surface;
      if (!cover.within) break;
    }
    return cover;
  }

 private:
  [[nodiscard]] std::size_t blocks() const {
    return (vertices_.size() + kTeamGrain - 1) / kTeamGrain;
  }

  static void lower(std::atomic<std::size_t>& last, std::size_t block) {
    std::size_t now = last.load(std::memory_order_relaxed);
    while (block < now && !last.compare_exchange_weak(now, block, std::memory_order_relaxed)) {
    }
  }

  [[nodiscard]] Vertices look_at(std::size_t first, std::size_t end) const {
    Vertices looked;
    PairWork work;
    for (std::size_t i = first; i < end && looked.cover.within; ++i) {
      const Vec3l at = vertices_[i].as<std::int64_t>() + shift_;
      if (distance_to_surface(b_, at.as<double>(), band_ + 1) <= band_) continue;
      looked.cover.on_surface = false;
      looked.cover.within = side_of(b_, at, 1, work) != PointSide::outside;
    }
    looked.cost = work;
    return looked;
  }

  const std::vector<Vec3i>& vertices_;
  const TreedPart& b_;
  Vec3l shift_;
  double band_;
};

}  // namespace

PartCover cover_by(const TreedPart& a, const TreedPart& b, double band, PairWork& work) {
  return CoverSearch(a, b, band).run(work);
}

}  // namespace strake::geometry
