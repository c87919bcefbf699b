// SPDX-License-Identifier: Apache-2.0
#include "pictures/scenery/clash_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "strake/geometry/grid.hpp"

namespace strake::pictures {
namespace {

using clash::Pair;
using clash::ResultRef;
using model::ObjectId;

/// Returns the object that all results have; index kNoObject where there is none.
ObjectId common_object(const report::ClashContents& contents, const Subject& subject) {
  const Pair& first = pair_of(contents, subject.results.front());
  const auto has = [&](ObjectId id) {
    return std::ranges::all_of(subject.results, [&](const ResultRef& ref) {
      const Pair& pair = pair_of(contents, ref);
      return pair.a == id || pair.b == id;
    });
  };
  if (subject.results.size() < 2) return first.a;
  return has(first.a) ? first.a : has(first.b) ? first.b : first.a;
}

/// Returns the middle one of the sides of the thinnest part of an object near a point, mm: the
/// diameter of a pipe, the lesser side of a plate.
double size_near(const model::Scene& scene, ObjectId id, const geometry::Vec3d& at, double within) {
  double least = std::numeric_limits<double>::max();
  for (const model::GridBody& body : scene.bodies_of(id))
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts) {
      if (part.box.empty()) continue;
      const geometry::Box3l box = part.box.as<std::int64_t>().moved(body.origin);
      const geometry::Box3d mm{geometry::to_mm(box.lo), geometry::to_mm(box.hi)};
      if (!mm.inflated(within).meets({at, at})) continue;
      std::array<double, 3> sides{mm.hi.x - mm.lo.x, mm.hi.y - mm.lo.y, mm.hi.z - mm.lo.z};
      std::ranges::sort(sides);
      least = std::min(least, sides[1]);
    }
  return least;
}

}  // namespace

Status check_subject(const report::ClashContents& contents, const Subject& subject) {
  const std::vector<clash::Report>& tests = contents.findings.tests;
  const bool known =
      !subject.results.empty() && std::ranges::all_of(subject.results, [&](const ResultRef& r) {
        return r.test < tests.size() && r.pair < tests[r.test].pairs.size();
      });
  if (known) return {};
  return Error{ErrorCode::usage, "there is no such result to take a picture of", "picture",
               "name results of the same findings"};
}

Roles::Roles(const report::ClashContents& contents, const Subject& subject) {
  const Pair& first = pair_of(contents, subject.results.front());
  a_ = common_object(contents, subject);
  b_ = first.a == a_ ? first.b : first.a;
  std::vector<std::pair<ObjectId, std::size_t>> claims;  // the order of claims decides
  std::vector<Role> wanted;
  const auto claim = [&](ObjectId id, Role role) {
    claims.emplace_back(id, wanted.size());
    wanted.push_back(role);
  };
  claim(a_, Role::a);
  claim(b_, Role::b);
  for (const ResultRef& ref : subject.results) {
    const Pair& pair = pair_of(contents, ref);
    const bool turned = pair.b == a_ || pair.a == b_;
    claim(pair.a, turned ? Role::b : Role::a);
    claim(pair.b, turned ? Role::a : Role::b);
  }
  std::ranges::sort(claims);
  for (const auto& [id, number] : claims)
    if (roles_.empty() || roles_.back().first != id) roles_.emplace_back(id, wanted[number]);
}

Role Roles::of(ObjectId id) const {
  const auto at = std::ranges::lower_bound(roles_, id, {}, &std::pair<ObjectId, Role>::first);
  return at != roles_.end() && at->first == id ? at->second : Role::other;
}

double reach_of(const Scenery& scenery, const Roles& roles, const Pair& pair) {
  constexpr double kMinMm = 120, kMaxMm = 3000, kThicknesses = 2.2, kSlackMm = 5;
  const double apart = std::fabs(pair.d_mm);
  const auto size = [&](Role role) {
    return size_near(scenery.scene(), roles.first(role), pair.point_mm, apart + kSlackMm);
  };
  const double thin = std::min(size(Role::a), size(Role::b));
  const double reach = thin == std::numeric_limits<double>::max() ? kMaxMm : thin * kThicknesses;
  return std::clamp(std::max(reach, 1.5 * apart), kMinMm, kMaxMm);
}

}  // namespace strake::pictures
