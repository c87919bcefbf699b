// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/level_frame.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/aligned_parts.hpp"

namespace strake::geometry {
namespace {

constexpr double kFiner = 16;
/// Half-spaces of a body that are looked at: more of a round one cost more than they cut off.
constexpr std::size_t kMostPlanes = 64;
/// A little way in, grid units.
constexpr double kIn = 1.0 / 16;

}  // namespace

LevelFrame::Turned::Turned(TurnedPart&& from, const Part& original)
    : turned(std::move(from)), part{{&turned.part, {}}, &turned.tree}, field(part, {}) {
  turned.part.edges = original.edges;
  turned.part.edge_triangles = original.edge_triangles;
  turned.part.box = turned.tree.nodes().front().box;
  field.prepare();
}

LevelFrame::LevelFrame(const DepthField& a, const DepthField& b, bool as_they_are) : a_(a), b_(b) {
  if (!as_they_are) turn();
  hull_a_ = hull_of(a);
  hull_b_ = hull_of(b);
}

void LevelFrame::turn() {
  const auto axes = needle_axes(a_.view(), b_.view());
  if (!axes) return;
  for (std::size_t k = 0; k < 3; ++k) axes_[k] = (*axes)[k] * kFiner;
  auto of_a = turned_part(a_.view(), axes_, {});
  if (!of_a) return;
  auto of_b = turned_part(b_.view(), axes_, {});
  if (!of_b) return;
  turned_a_.emplace(std::move(*of_a), a_.part());
  turned_b_.emplace(std::move(*of_b), b_.part());
}

std::vector<HalfSpace> LevelFrame::hull_of(const DepthField& original) const {
  std::vector<HalfSpace> hull;
  if (original.planes() == nullptr) return hull;
  const Vec3d shift = original.local({});
  const std::vector<SupportPlanes::Plane>& planes = original.planes()->planes;
  // They stand by their normals: any share looks to all sides.
  const std::size_t step =
      std::max<std::size_t>(1, (planes.size() + kMostPlanes - 1) / kMostPlanes);
  for (std::size_t i = 0; i < planes.size(); i += step) {
    const SupportPlanes::Plane& p = planes[i];
    const double offset = p.support - dot(p.normal, shift);
    if (turned_a_)
      hull.push_back({turned(axes_, p.normal) * (1 / kFiner), offset * kFiner + kTurnRounding});
    else
      hull.push_back({p.normal, offset});
  }
  return hull;
}

double LevelFrame::scale() const { return turned_a_ ? kFiner : 1; }

/// A point of a solid that is farther from its skin than corners move stays in it, and another is
/// within twice that way of the moved skin; its distance to the other skin changes by the way once
/// more.
double LevelFrame::error() const { return turned_a_ ? 3 * kTurnRounding / kFiner : 0; }

Vec3d LevelFrame::back(const Vec3d& in_frame, PairWork& work) const {
  if (!turned_a_) return in_frame;
  Vec3d p;
  for (int k = 0; k < 3; ++k)
    p = p + axes_[static_cast<std::size_t>(k)] * (in_frame[k] / (kFiner * kFiner));
  for (const DepthField* f : {&a_, &b_}) {
    if (f->contains(on_field_grid(p), work)) continue;
    const NearestTriangle skin = f->nearest(p);
    const Vec3d way = nearest_on_triangle(f->local(p), f->corners(skin.triangle)) - f->local(p);
    if (skin.distance > 0) p = p + way * (1 + kIn / skin.distance);
  }
  return p;
}

}  // namespace strake::geometry
