// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "geometry/pair_view.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

int sign_of(Int128 v) { return (v > 0) - (v < 0); }

/// The rational point numerator / denominator, as integer multiples of it are needed.
struct ScaledPoint {
  Vec3l numerator;
  std::int64_t denominator;

  [[nodiscard]] Vec3l from(const Vec3l& p) const { return numerator - p * denominator; }
};

/// Sign of the 2D orientation of a, b and the point, seen along `axis`.
int turn2d(const Vec3l& a, const Vec3l& b, const ScaledPoint& p, int axis) {
  const Vec3l u = drop_axis(b - a, axis), v = drop_axis(p.from(a), axis);
  return sign_of(static_cast<Int128>(u.x) * v.y - static_cast<Int128>(u.y) * v.x);
}

/// The same for the point moved by (e1, e2), 0 < e2 << e1 << 1: never zero unless the edge runs
/// along `axis`. All triangles round a common edge see the same move, so a ray meets each surface
/// consistently however it hits edges and vertices.
int moved_turn2d(const Vec3l& a, const Vec3l& b, const ScaledPoint& p, int axis) {
  const int turn = turn2d(a, b, p, axis);
  if (turn != 0) return turn;
  const Vec3l u = drop_axis(b - a, axis);
  if (u.y != 0) return u.y > 0 ? -1 : 1;
  return (u.x > 0) - (u.x < 0);
}

class Probe {
 public:
  Probe(const TreedPart& part, const Vec3l& numerator, std::int64_t denominator)
      : view_(part, {}), point_{numerator, denominator} {
    choose_ray();
  }

  PointSide run(PairWork& work);

 private:
  enum class Verdict : std::uint8_t { go_on, on_boundary };

  void choose_ray();
  [[nodiscard]] bool ray_meets(const Box3i& box) const;
  Verdict visit(std::uint32_t triangle);

  PartView view_;
  ScaledPoint point_;
  int axis_ = 0;
  bool upward_ = true;
  int winding_ = 0;
};

/// The axis direction with the shortest way out of the part's box.
void Probe::choose_ray() {
  const Box3i& box = view_.tree().nodes().front().box;
  std::int64_t shortest = INT64_MAX;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t up = box.hi[k] * point_.denominator - point_.numerator[k];
    const std::int64_t down = point_.numerator[k] - box.lo[k] * point_.denominator;
    if (up < shortest) {
      shortest = up;
      axis_ = k;
      upward_ = true;
    }
    if (down < shortest) {
      shortest = down;
      axis_ = k;
      upward_ = false;
    }
  }
}

bool Probe::ray_meets(const Box3i& box) const {
  for (int k = 0; k < 3; ++k) {
    const bool below = point_.numerator[k] < box.lo[k] * point_.denominator;
    const bool above = point_.numerator[k] > box.hi[k] * point_.denominator;
    if (k != axis_ ? (below || above) : (upward_ ? above : below)) return false;
  }
  return true;
}

Probe::Verdict Probe::visit(std::uint32_t triangle) {
  const std::array<Vec3l, 3> t = view_.corners(triangle);
  const Vec3<Int128> normal = cross_exact(t[1] - t[0], t[2] - t[0]);
  const Vec3l offset = point_.from(t[0]);
  const int side = sign_of(dot(normal, offset.as<Int128>()));
  if (side == 0) {
    const int seen = normal.x != 0 ? 0 : normal.y != 0 ? 1 : 2;
    const int facing = sign_of(normal[seen]);
    bool inside = true;
    for (std::size_t i = 0; i < 3 && inside; ++i)
      inside = facing * turn2d(t[i], t[(i + 1) % 3], point_, seen) >= 0;
    // A ray within the plane of a triangle does not cross it.
    return inside ? Verdict::on_boundary : Verdict::go_on;
  }
  const int facing = sign_of(normal[axis_]);
  if (facing == 0 || (side * facing < 0) != upward_) return Verdict::go_on;
  for (std::size_t i = 0; i < 3; ++i)
    if (moved_turn2d(t[i], t[(i + 1) % 3], point_, axis_) != facing) return Verdict::go_on;
  winding_ += upward_ ? facing : -facing;
  return Verdict::go_on;
}

PointSide Probe::run(PairWork& work) {
  const auto& nodes = view_.tree().nodes();
  std::array<std::uint32_t, kMaxTreeDepth + 2> stack{};
  std::size_t size = 1;
  while (size > 0) {
    const PartTree::Node& node = nodes[stack[--size]];
    if (!ray_meets(node.box)) continue;
    ++work.node_pairs;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i)
      if (visit(view_.tree().order()[node.first + i]) == Verdict::on_boundary)
        return PointSide::on_boundary;
  }
  return view_.solid() && winding_ >= 1 ? PointSide::inside : PointSide::outside;
}

}  // namespace

PointSide side_of(const TreedPart& part, const Vec3l& numerator, std::int64_t denominator,
                  PairWork& work) {
  if (part.tree->nodes().empty()) return PointSide::outside;
  const Box3i& box = part.tree->nodes().front().box;
  for (int k = 0; k < 3; ++k)
    if (numerator[k] < box.lo[k] * denominator || numerator[k] > box.hi[k] * denominator)
      return PointSide::outside;
  return Probe(part, numerator, denominator).run(work);
}

}  // namespace strake::geometry
