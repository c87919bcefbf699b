// SPDX-License-Identifier: Apache-2.0
#include "clash/policy.hpp"

#include <algorithm>
#include <variant>

#include "strake/geometry/grid.hpp"

namespace strake::clash {
namespace {

/// Whether two ascending lists share a number.
bool share(const Linked::Lists& x, std::uint32_t a, const Linked::Lists& y, std::uint32_t b) {
  std::uint32_t i = x.first[a], j = y.first[b];
  while (i < x.first[a + 1] && j < y.first[b + 1]) {
    if (x.numbers[i] == y.numbers[j]) return true;
    ++(x.numbers[i] < y.numbers[j] ? i : j);
  }
  return false;
}

bool within(const HalfSpace& side, const geometry::Vec3d& p) {
  return dot(p - side.point_mm, side.normal) >= 0;
}

}  // namespace

Status check(const Policy& policy, std::size_t objects) {
  const auto fits = [&](const auto&... lists) { return ((lists.size() == objects) && ...); };
  const auto listed = [&](const Linked::Lists& lists) {
    return lists.first.size() == objects + 1 && lists.first.back() <= lists.numbers.size();
  };
  bool good = true;
  for (const Exemption& e : policy.exemptions) {
    if (const auto* const same = std::get_if<SameLabel>(&e.test)) good &= fits(same->label);
    if (const auto* const linked = std::get_if<Linked>(&e.test))
      good &= listed(linked->answers_to) && listed(linked->refers_to);
    if (const auto* const between = std::get_if<Between>(&e.test))
      good &= fits(between->a, between->b);
  }
  if (policy.matrix) {
    const std::size_t n = policy.matrix->disciplines.size();
    good &= fits(policy.matrix->discipline) && policy.matrix->cells.size() == n * n;
    for (const std::uint32_t d : policy.matrix->discipline) good &= d < n || d == kNoLabel;
    for (const std::uint32_t c : policy.matrix->cells)
      good &= c < policy.tolerances.size() || c >= Matrix::kDefault;
  }
  if (policy.levels) good &= fits(policy.levels->object);
  for (const Allowed& a : policy.allowed) good &= fits(a.a, a.b);
  if (good) return {};
  return Error{
      ErrorCode::usage,
      "the rules do not have one entry per object of the scene, or refer to what is not there",
      "rules", "build them from the same scene"};
}

bool exempts(const SameLabel& test, std::uint32_t a, std::uint32_t b) {
  return test.label[a] == test.label[b] && test.label[a] != kNoLabel;
}

bool exempts(const Linked& test, std::uint32_t a, std::uint32_t b) {
  return share(test.refers_to, a, test.answers_to, b) ||
         share(test.refers_to, b, test.answers_to, a);
}

bool allows(const Allowed& rule, const Pair& pair, double moved_mm) {
  // Half a grid step is what a bracket about a depth on the grid may be off; the next depth that
  // coordinates on the grid can state is a whole step away.
  constexpr double kTieMm = geometry::kMmPerGrid / 2;
  if (rule.max_depth_mm ? -pair.d_lower_mm > *rule.max_depth_mm + kTieMm + moved_mm
                        : pair.cls == Class::hit)
    return false;
  const geometry::Vec3d& at = pair.point_mm;
  if (rule.region_mm && !rule.region_mm->contains({at, at})) return false;
  return std::all_of(rule.cavity.begin(), rule.cavity.end(),
                     [&](const HalfSpace& side) { return within(side, at); });
}

bool is_as_deep_as_allowed(const Allowed& rule, const Pair& pair) {
  return rule.max_depth_mm && -pair.d_lower_mm > *rule.max_depth_mm;
}

bool holds_all(const Allowed& rule, const geometry::Box3d& box) {
  if (rule.region_mm && !rule.region_mm->contains(box)) return false;
  return std::all_of(rule.cavity.begin(), rule.cavity.end(), [&](const HalfSpace& side) {
    geometry::Vec3d outermost;
    for (int k = 0; k < 3; ++k) outermost[k] = side.normal[k] > 0 ? box.lo[k] : box.hi[k];
    return within(side, outermost);
  });
}

}  // namespace strake::clash
