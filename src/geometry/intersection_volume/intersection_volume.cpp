// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersection_volume/intersection_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/intersection_volume/prism_integral.hpp"

namespace strake::geometry {
namespace {

bool empty(const Box3l& box) {
  return box.lo.x >= box.hi.x || box.lo.y >= box.hi.y || box.lo.z >= box.hi.z;
}

/// A point with the axis of integration last, about the corner of the common box.
struct IntegrationFrame {
  Vec3l corner;
  int axis = 2;
  [[nodiscard]] int x() const { return axis == 2 ? 0 : axis + 1; }
  [[nodiscard]] int y() const { return axis == 0 ? 2 : axis - 1; }
  [[nodiscard]] Vec3l operator()(const Vec3l& p) const {
    const Vec3l d = p - corner;
    return {d[x()], d[y()], d[axis]};
  }
};

/// Whether two boxes overlap as seen along the axis, by more than an edge.
bool beside(const Box3l& p, const Box3l& q, const IntegrationFrame& frame) {
  const int x = frame.x(), y = frame.y();
  return p.lo[x] >= q.hi[x] || q.lo[x] >= p.hi[x] || p.lo[y] >= q.hi[y] || q.lo[y] >= p.hi[y];
}

/// A sum of doubles whose rounding stays below an ulp of the result and 2^-100 of the terms.
class CompensatedSum {
 public:
  void add(double term) {
    const double total = high_ + term;
    const double part = total - high_;
    low_ += (high_ - (total - part)) + (term - part);
    high_ = total;
    absolute_ += std::fabs(term);
    ++terms_;
  }
  [[nodiscard]] double value() const { return high_ + low_; }
  [[nodiscard]] double error() const {
    constexpr double kEps = std::numeric_limits<double>::epsilon();
    const double small = kEps * kEps * static_cast<double>(terms_) * absolute_;
    return kEps * std::fabs(value()) + small * static_cast<double>(terms_);
  }

 private:
  double high_ = 0, low_ = 0, absolute_ = 0;
  std::uint64_t terms_ = 0;
};

/// The facets of a leaf, prepared; kept until another leaf is loaded.
struct LoadedFacets {
  const TriangleBvh::Node* node = nullptr;
  std::size_t count = 0;
  std::array<ProjectedTriangle, TriangleBvh::kLeafSize> facet;

  void load(const PairLocalPart& view, const TriangleBvh::Node& leaf,
            const IntegrationFrame& frame) {
    if (node == &leaf) return;
    node = &leaf;
    count = 0;
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      const std::array<Vec3l, 3> c = view.corners(view.tree().order()[leaf.first + i]);
      const ProjectedTriangle made({frame(c[0]), frame(c[1]), frame(c[2])});
      if (made.sign != 0 && made.hi.z > 0) facet[count++] = made;
    }
  }
};

class VolumeSum {
 public:
  VolumeSum(const PairLocalPart& a, const PairLocalPart& b, const Box3l& common,
            std::uint64_t max_work)
      : a_(a), b_(b), common_(common), max_work_(max_work) {
    frame_.corner = common.lo;
  }

  std::optional<IntersectionVolume> run() {
    if (!choose_axis() || !traverse()) return std::nullopt;
    IntersectionVolume result;
    const double error = error_ * (1 + 1e-9) + sum_.error();
    const double largest = box_volume() * (1 + 1e-15);
    result.triangle_pairs = triangle_pairs_;
    result.volume = std::clamp(sum_.value(), 0.0, largest);
    result.lower = std::clamp(sum_.value() - error, 0.0, result.volume);
    result.upper = std::clamp(sum_.value() + error, result.volume, largest);
    return result;
  }

 private:
  /// The axis along which fewest triangles are seen: the ends of a prism, not its sides.
  bool choose_axis() {
    double fewest = std::numeric_limits<double>::infinity();
    int best = 2;
    for (int axis = 0; axis < 3; ++axis) {
      frame_.axis = axis;
      double count = 1;
      for (const PairLocalPart* view : {&a_, &b_}) {
        const auto visible = count_visible_facets(*view);
        if (!visible) return false;
        count *= static_cast<double>(*visible);
      }
      if (count >= fewest) continue;
      fewest = count;
      best = axis;
    }
    frame_.axis = best;
    return true;
  }

  std::optional<std::uint64_t> count_visible_facets(const PairLocalPart& view) {
    std::uint64_t visible = 0;
    bool afforded = true;
    traverse_bvh(
        view.tree(),
        [&](const TriangleBvh::Node& node) {
          afforded = ++work_ <= max_work_;
          return afforded && !out_of_sight(view.box(node.box), common_);
        },
        [&](std::uint32_t triangle) {
          const std::array<Vec3l, 3> c = view.corners(triangle);
          if (orient2d(c[0], c[1], c[2], frame_.axis) != 0) ++visible;
          return true;
        });
    if (!afforded) return std::nullopt;
    return visible;
  }

  [[nodiscard]] bool out_of_sight(const Box3l& box, const Box3l& column) const {
    return beside(box, column, frame_) || box.hi[frame_.axis] <= common_.lo[frame_.axis];
  }

  bool traverse() {
    bool afforded = true;
    traverse_both(
        a_.tree(), b_.tree(),
        [&](const TriangleBvh::Node& na, const TriangleBvh::Node& nb) {
          afforded = ++work_ <= max_work_;
          const Box3l box_a = a_.box(na.box), box_b = b_.box(nb.box);
          return afforded && !out_of_sight(box_a, box_b) && !out_of_sight(box_b, box_a);
        },
        [&](const TriangleBvh::Node& na, const TriangleBvh::Node& nb) {
          leaves(na, nb);
          return true;
        });
    return afforded;
  }

  void leaves(const TriangleBvh::Node& na, const TriangleBvh::Node& nb) {
    leaf_a_.load(a_, na, frame_);
    leaf_b_.load(b_, nb, frame_);
    for (std::size_t i = 0; i < leaf_a_.count; ++i)
      for (std::size_t j = 0; j < leaf_b_.count; ++j) {
        const ProjectedTriangle &a = leaf_a_.facet[i], &b = leaf_b_.facet[j];
        if (a.lo.x >= b.hi.x || b.lo.x >= a.hi.x || a.lo.y >= b.hi.y || b.lo.y >= a.hi.y) continue;
        ++work_;
        ++triangle_pairs_;
        const PrismIntegral column = prism_integral(a, b);
        sum_.add(a.sign * b.sign * column.value);
        error_ += column.error;
      }
  }

  [[nodiscard]] double box_volume() const {
    const Vec3d d = (common_.hi - common_.lo).as<double>();
    return d.x * d.y * d.z;
  }

  const PairLocalPart &a_, &b_;
  Box3l common_;
  std::uint64_t max_work_;
  IntegrationFrame frame_;
  LoadedFacets leaf_a_, leaf_b_;
  CompensatedSum sum_;
  double error_ = 0;
  std::uint64_t work_ = 0, triangle_pairs_ = 0;
};

}  // namespace

std::optional<IntersectionVolume> intersection_volume(const PartWithBvh& a, const PartWithBvh& b,
                                                      std::uint64_t max_work) {
  const PairLocalPart view_a(a, {}), view_b(b, b.placed.origin - a.placed.origin);
  if (!view_a.solid() || !view_b.solid()) return std::nullopt;
  const Box3l common = view_a.box(a.placed.part->box).common(view_b.box(b.placed.part->box));
  if (empty(common)) return IntersectionVolume{};
  return VolumeSum(view_a, view_b, common, max_work).run();
}

}  // namespace strake::geometry
