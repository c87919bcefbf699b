// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/pair_view.hpp"
#include "geometry/triangle_distance.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {
namespace {

/// Factor by which a double squared distance is enlarged before it may cut anything off: far above
/// the roundings of a box distance.
constexpr double kOutward = 1 + 0x1p-48;

struct Entry {
  NodePair pair;
  double squared = 0;  ///< distance of the nodes' boxes
};

/// A pair of triangles that may be the nearest.
struct Candidate {
  DistanceBounds squared;
  std::uint32_t a = 0, b = 0;
};

double squared_gap(const Box3d& x, const Box3d& y) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max(std::max(x.lo[k] - y.hi[k], y.lo[k] - x.hi[k]), 0.0);
    sum += gap * gap;
  }
  return sum;
}

/// The triangles of a leaf, prepared; kept until another leaf is loaded.
struct LoadedLeaf {
  std::uint32_t node = 0xffffffffU;
  std::uint32_t count = 0;
  std::array<std::uint32_t, PartTree::kLeafSize> id{};
  std::array<DoubleTriangle, PartTree::kLeafSize> triangle;

  void load(const PartView& view, std::uint32_t index) {
    if (node == index) return;
    node = index;
    const PartTree::Node& leaf = view.tree().nodes()[index];
    count = leaf.count;
    for (std::uint32_t i = 0; i < count; ++i) {
      id[i] = view.tree().order()[leaf.first + i];
      triangle[i] = DoubleTriangle(view.corners(id[i]));
    }
  }
};

/// A node's box in the pair's coordinates; exact.
Box3d box_of(const PartView& view, std::uint32_t node) {
  const Box3i& box = view.tree().nodes()[node].box;
  const Vec3d shift = view.shift().as<double>();
  return {box.lo.as<double>() + shift, box.hi.as<double>() + shift};
}

class ClosestSearch {
 public:
  ClosestSearch(const TreedPart& a, const TreedPart& b, double limit, PairWork& work)
      : a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        limit_(limit),
        reach_(limit * limit * kOutward),
        work_(work) {}

  std::optional<Closest> run();
  /// Ends at the first pair of triangles that is certainly not farther apart than the limit.
  std::optional<Closest> run_until_near();

 private:
  void walk();
  void open(const Entry& entry);
  void push(std::uint32_t a, std::uint32_t b);
  void leaves(const NodePair& pair);
  std::optional<Closest> decide();

  PartView a_, b_;
  double limit_;
  double reach_;        ///< squared distances strictly above this are of no interest
  double enough_ = -1;  ///< a squared distance that is near enough to look no further
  bool near_ = false;   ///< one was found
  PairWork& work_;
  std::array<Entry, 2 * kMaxTreeDepth + 2> stack_;
  std::size_t size_ = 0;
  LoadedLeaf leaf_a_, leaf_b_;
  std::vector<Candidate> candidates_;
};

void ClosestSearch::push(std::uint32_t a, std::uint32_t b) {
  const double squared = squared_gap(box_of(a_, a), box_of(b_, b));
  if (squared <= reach_) stack_[size_++] = {{a, b}, squared};
}

/// Depth first, the nearer child first.
void ClosestSearch::open(const Entry& entry) {
  const PartTree::Node& na = a_.tree().nodes()[entry.pair.a];
  const PartTree::Node& nb = b_.tree().nodes()[entry.pair.b];
  const std::size_t before = size_;
  if (open_first(na, nb)) {
    push(na.first + 1, entry.pair.b);
    push(na.first, entry.pair.b);
  } else {
    push(entry.pair.a, nb.first + 1);
    push(entry.pair.a, nb.first);
  }
  if (size_ == before + 2 && stack_[size_ - 1].squared > stack_[size_ - 2].squared)
    std::swap(stack_[size_ - 1], stack_[size_ - 2]);
}

void ClosestSearch::leaves(const NodePair& pair) {
  leaf_a_.load(a_, pair.a);
  leaf_b_.load(b_, pair.b);
  const Box3d box_a = box_of(a_, pair.a);
  for (std::uint32_t j = 0; j < leaf_b_.count; ++j) {
    const DoubleTriangle& b = leaf_b_.triangle[j];
    if (squared_gap(box_a, b.box) > reach_) continue;
    for (std::uint32_t i = 0; i < leaf_a_.count; ++i) {
      const DoubleTriangle& a = leaf_a_.triangle[i];
      if (squared_gap(a.box, b.box) > reach_) continue;
      ++work_.triangle_pairs;
      const DistanceBounds bounds = distance_bounds(a, b, reach_);
      if (bounds.lower > reach_) continue;
      const Candidate candidate{bounds, leaf_a_.id[i], leaf_b_.id[j]};
      if (bounds.upper <= enough_) {
        candidates_.assign(1, candidate);
        size_ = 0;
        near_ = true;
        return;
      }
      candidates_.push_back(candidate);
      reach_ = std::min(reach_, bounds.upper * kOutward);
    }
  }
}

void ClosestSearch::walk() {
  push(0, 0);
  while (size_ > 0) {
    const Entry entry = stack_[--size_];
    if (entry.squared > reach_) continue;
    ++work_.node_pairs;
    const PartTree::Node& na = a_.tree().nodes()[entry.pair.a];
    const PartTree::Node& nb = b_.tree().nodes()[entry.pair.b];
    if (na.count != 0 && nb.count != 0)
      leaves(entry.pair);
    else
      open(entry);
  }
}

/// The exact least among the candidates whose certified bounds overlap.
std::optional<Closest> ClosestSearch::decide() {
  std::erase_if(candidates_, [this](const Candidate& c) { return c.squared.lower > reach_; });
  std::ranges::sort(candidates_, [](const Candidate& x, const Candidate& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  std::optional<Closest> best;
  NearestPoints nearest;
  for (const Candidate& c : candidates_) {
    if (best && c.squared.lower > best->squared * kOutward) continue;
    const TriangleCorners a = a_.corners(c.a), b = b_.corners(c.b);
    if (best && not_nearer(a, b, nearest)) continue;
    ++work_.exact_fallbacks;
    const NearestPoints p = exact_distance(a, b, c.squared.upper);
    if (best && p.squared >= nearest.squared) continue;
    nearest = p;
    best.emplace();
    best->squared = ratio_to_double(p.squared.numerator, p.squared.denominator);
    best->triangle_a = c.a;
    best->triangle_b = c.b;
    if (best->squared == 0) break;
  }
  if (!best) return std::nullopt;
  best->distance = sqrt_ratio_to_double(nearest.squared.numerator, nearest.squared.denominator);
  best->on_a = nearest.on_a;
  best->on_b = nearest.on_b;
  if (!(best->distance < limit_)) return std::nullopt;
  return best;
}

std::optional<Closest> ClosestSearch::run() {
  if (a_.tree().nodes().empty() || b_.tree().nodes().empty()) return std::nullopt;
  walk();
  return decide();
}

std::optional<Closest> ClosestSearch::run_until_near() {
  enough_ = limit_ * limit_;
  if (a_.tree().nodes().empty() || b_.tree().nodes().empty()) return std::nullopt;
  walk();
  return near_ ? decide() : std::nullopt;
}

/// Squared distance of a point to a triangle, in doubles.
double squared_distance(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  double least = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &from = t[i], e = t[(i + 1) % 3] - from, d = p - from;
    inside = inside && dot(cross(e, d), n) >= 0;
    const double along = std::clamp(dot(e, d) / dot(e, e), 0.0, 1.0);
    const Vec3d off = d - e * along;
    least = std::min(least, dot(off, off));
  }
  if (!inside) return least;
  const double height = dot(n, p - t[0]);
  return std::min(least, height * height / dot(n, n));
}

double squared_gap(const Vec3d& p, const Box3i& box) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max({box.lo[k] - p[k], p[k] - box.hi[k], 0.0});
    sum += gap * gap;
  }
  return sum;
}

}  // namespace

std::optional<Closest> closest(const TreedPart& a, const TreedPart& b, double limit,
                               PairWork& work) {
  return ClosestSearch(a, b, limit, work).run();
}

std::optional<Closest> any_within(const TreedPart& a, const TreedPart& b, double distance,
                                  PairWork& work) {
  return ClosestSearch(a, b, distance, work).run_until_near();
}

double distance_to_surface(const TreedPart& part, const Vec3d& point, double limit) {
  const auto& nodes = part.tree->nodes();
  double best = limit * limit;
  std::array<std::pair<std::uint32_t, double>, kMaxTreeDepth + 2> stack;
  std::size_t size = 0;
  if (!nodes.empty()) stack[size++] = {0, squared_gap(point, nodes.front().box)};
  while (size > 0) {
    const auto [index, gap] = stack[--size];
    if (gap > best) continue;
    const PartTree::Node& node = nodes[index];
    if (node.count == 0) {
      std::pair<std::uint32_t, double> near{node.first, squared_gap(point, nodes[node.first].box)};
      std::pair<std::uint32_t, double> far{node.first + 1,
                                           squared_gap(point, nodes[node.first + 1].box)};
      if (far.second < near.second) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const Triangle& t = part.placed.part->triangles[part.tree->order()[node.first + i]];
      const auto corner = [&](std::size_t k) {
        return part.placed.part->vertices[t[k]].as<double>();
      };
      best = std::min(best, squared_distance(point, {corner(0), corner(1), corner(2)}));
    }
  }
  return std::sqrt(best);
}

}  // namespace strake::geometry
