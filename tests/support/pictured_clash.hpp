// SPDX-License-Identifier: Apache-2.0
// A model with its clashes, as pictures are taken of them, and what rays say of a view.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "pictures/scenery/surroundings.hpp"
#include "pictures/viewpoint.hpp"
#include "pictures/viewpoint/camera.hpp"
#include "support/clash_model.hpp"

namespace strake::test {

/// Findings of a model with all that pictures need of it; it stays where it is.
struct PicturedClash {
  model::Model model;
  model::Scene scene;
  clash::Findings findings;
  std::unique_ptr<report::ClashContents> contents;

  explicit PicturedClash(ClashModel made) : model(std::move(made.model)) {
    const clash::Options options;
    scene = make_scene(model, clash::scene_options(options), {}).value();
    findings.tests.push_back(clash::detect(scene, clash::one_set(scene), options, {}).value());
    contents = std::make_unique<report::ClashContents>(report::ClashContents{findings, model});
    contents->scene = &scene;
  }
  PicturedClash(const PicturedClash&) = delete;
  PicturedClash& operator=(const PicturedClash&) = delete;

  [[nodiscard]] pictures::Scenery scenery() const {
    return pictures::Scenery::of(*contents, {}).value();
  }
  /// The result of two objects, which must clash.
  [[nodiscard]] pictures::Subject subject(const std::string& a, const std::string& b) const {
    const std::vector<clash::Pair>& pairs = findings.tests[0].pairs;
    for (std::uint32_t p = 0; p < pairs.size(); ++p) {
      const std::string& first = model.object(pairs[p].a).id;
      const std::string& second = model.object(pairs[p].b).id;
      if ((first == a && second == b) || (first == b && second == a))
        return pictures::subject_of(clash::ResultRef{0, p});
    }
    return {};
  }
};

/// What a bundle of parallel rays meets first.
struct RayShares {
  double a = 0, b = 0;  ///< shares of all rays
};

/// Sends rays against a direction to the viewer through a disc about the origin, from `from_mm`
/// towards the viewer on, and tests each against every triangle. A ray that comes out of a solid
/// of the clash before it meets another face of the clash has begun within it, and shows its cut.
inline RayShares shares_by_rays(std::span<const pictures::NearTriangle> triangles,
                                const geometry::Vec3d& viewer, double radius_mm, double from_mm) {
  using geometry::Vec3d;
  const pictures::Axes axes = pictures::Axes::towards(viewer);
  constexpr int kRays = 41;
  double rays = 0, a = 0, b = 0;
  for (int i = 0; i < kRays; ++i)
    for (int k = 0; k < kRays; ++k) {
      const double x = (2.0 * i / (kRays - 1) - 1) * radius_mm;
      const double y = (2.0 * k / (kRays - 1) - 1) * radius_mm;
      if (x * x + y * y > radius_mm * radius_mm) continue;
      const Vec3d start = axes.right * x + axes.up * y + axes.toward * from_mm, ray = -axes.toward;
      double nearest = 1e300, nearest_own = 1e300;
      pictures::Role viewpoint = pictures::Role::other, own = pictures::Role::other;
      bool own_back = false;
      for (const pictures::NearTriangle& t : triangles) {
        const Vec3d u = t.at[1] - t.at[0], v = t.at[2] - t.at[0], p = cross(ray, v);
        const double det = dot(u, p);
        if (std::fabs(det) < 1e-9) continue;
        const Vec3d s = start - t.at[0], q = cross(s, u);
        const double along_u = dot(s, p) / det, along_v = dot(ray, q) / det, at = dot(v, q) / det;
        if (along_u < 0 || along_v < 0 || along_u + along_v > 1 || at < 0) continue;
        if (at < nearest - 0.02 || (at < nearest + 0.02 && t.role != pictures::Role::other)) {
          nearest = at;
          viewpoint = t.role;
        }
        if (t.role == pictures::Role::other || at >= nearest_own) continue;
        nearest_own = at;
        own = t.role;
        own_back = dot(cross(u, v), ray) > 0 && t.solid;
      }
      if (own_back) viewpoint = own;
      rays += 1;
      a += viewpoint == pictures::Role::a ? 1 : 0;
      b += viewpoint == pictures::Role::b ? 1 : 0;
    }
  return {a / rays, b / rays};
}

}  // namespace strake::test
