// SPDX-License-Identifier: Apache-2.0
// Generates equipment as other programs export it: one closed mesh, of far more triangles than a
// ship needs.
#include <cmath>
#include <cstdint>
#include <vector>

#include "generate/ship_plan.hpp"

namespace strake::generate {
namespace {

using geometry::kNoIndex;
using geometry::Triangle;
using geometry::Vec3d;

constexpr std::uint32_t kBaseFace = 0, kTopFace = 1;

/// Returns unit vectors at equal angles, counter-clockwise from +u: those of 15 degrees, halved
/// `halvings` times by sums and square roots, so that every machine finds the same.
std::vector<Vec3d> directions(int halvings) {
  std::vector<Vec3d> all;
  for (int step = 0; step < 24; ++step) all.push_back(unit_15deg(step));
  for (; halvings > 0; --halvings) {
    std::vector<Vec3d> finer;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vec3d between = all[i] + all[(i + 1) % all.size()];
      finer.push_back(all[i]);
      finer.push_back(between * (1 / std::sqrt(dot(between, between))));
    }
    all = std::move(finer);
  }
  return all;
}

/// A waisted casing with cooling fins round it and ribs along it, as rings of points about z, its
/// surface as rough as a casting's. Seen from the axis it is a graph, so it cannot pass through
/// itself.
class Casing {
 public:
  Casing(std::uint64_t triangles, const Random& random) : random_(random) {
    int halvings = 0;
    // There are about as many steps round as up, or up to twice as many.
    const double around = std::sqrt(static_cast<double>(triangles) / 2);
    while (24.0 * std::exp2(halvings) < around) ++halvings;
    directions_ = directions(halvings);
    rings_ =
        std::max<std::int64_t>(4, static_cast<std::int64_t>(triangles / (2 * directions_.size())));
  }

  MicrometreMesh make() {
    const auto sides = static_cast<std::uint32_t>(directions_.size());
    for (std::int64_t ring = 0; ring < rings_; ++ring) add_ring(ring);
    const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back({0, 0, 0});
    mesh_.vertices.push_back({0, 0, kHeight});
    const auto top = static_cast<std::uint32_t>(rings_ - 1) * sides;
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t next = (k + 1) % sides;
      add({base, next, k}, kBaseFace);
      for (std::uint32_t low = 0; low < top; low += sides) {
        add({low + k, low + next, low + sides + next}, kNoIndex);
        add({low + k, low + sides + next, low + sides + k}, kNoIndex);
      }
      add({base + 1, top + k, top + next}, kTopFace);
    }
    return std::move(mesh_);
  }

 private:
  static constexpr std::int64_t kHeight = 1'800'000;
  static constexpr std::int64_t kWide = 880'000, kWaist = 120'000, kFin = 30'000, kRib = 12'000;
  static constexpr int kRough = 120;  ///< micrometres, to either side

  void add(const Triangle& t, std::uint32_t face) {
    mesh_.triangles.push_back(t);
    mesh_.faces.push_back(face);
  }

  void add_ring(std::int64_t ring) {
    const std::int64_t last = rings_ - 1, z = kHeight * ring / last;
    const bool fin = ring % 4 >= 2;
    const double up = static_cast<double>(ring) / static_cast<double>(last);
    const auto waist = static_cast<std::int64_t>(4 * up * (1 - up) * static_cast<double>(kWaist));
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      const bool rib = k * 48 / directions_.size() % 2 == 1;
      const std::int64_t r =
          kWide - waist - (fin ? 0 : kFin) - (rib ? 0 : kRib) + random_.between(-kRough, kRough);
      mesh_.vertices.push_back({std::llround(directions_[k].x * static_cast<double>(r)),
                                std::llround(directions_[k].y * static_cast<double>(r)), z});
    }
  }

  Random random_;
  std::vector<Vec3d> directions_;
  std::int64_t rings_ = 0;
  MicrometreMesh mesh_;
};

}  // namespace

void build_imported(ShipRoom& room, std::uint64_t triangles) {
  const Site& site = room.site;
  ShipBuilder& builder = *site.builder;
  const Handle bed = site.box(ObjectKind::foundation, {400, 650, 0}, {2400, 2650, 200});
  builder.weld(bed, room.deck);
  const Random random = room.random.at(5);
  const std::uint32_t shape =
      builder.late_shape([triangles, random] { return Casing(triangles, random).make(); });
  const Handle machine =
      builder.add(ObjectKind::imported, site.cell, shape, site.frame * at({1400, 1650, 200}));
  builder.rest(machine, bed);
  builder.keep(bed);
  builder.keep(machine);
}

}  // namespace strake::generate
