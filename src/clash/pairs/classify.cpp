// SPDX-License-Identifier: Apache-2.0
#include "clash/pairs/classify.hpp"

#include <algorithm>
#include <cmath>

namespace strake::clash {
namespace {

/// One end of a bracket: a separation of the bodies on the grid, or with sag of the true ones, and
/// how far the snap may have moved it.
struct BracketEnd {
  double d = 0, off = 0;
  bool interiors_meet = false;
  bool on_grid = true;
};

/// Whether a tolerance is compared with the geometry on the grid itself.
bool is_exact(double tolerance, const Thresholds& t) { return !(tolerance > 0) && !(t.step > 0); }

Class class_of(const BracketEnd& end, const Thresholds& t) {
  const auto beside = [&](double tolerance) {
    return end.on_grid && is_exact(tolerance, t) ? end.d : end.d + end.off;
  };
  if (beside(t.overlap) < -t.overlap || (end.interiors_meet && !(t.overlap > 0))) return Class::hit;
  if (beside(t.gap) <= t.gap) return Class::contact;
  if (beside(t.clearance) < t.clearance) return Class::clearance_violation;
  return Class::no_hit;
}

/// Returns the class of a d whose bracket leaves its class open: numbers in coarse steps do not
/// tell a touch from what is a step off.
Class class_of_nominal(const SignedSeparation& s, const Thresholds& t) {
  if (t.step > 0 && std::fabs(s.d) <= t.step) return Class::contact;
  return class_of({s.d, 0, s.interiors_meet}, t);
}

/// Returns the least class that a result may be which a weld may have moved out of reach.
Class least_certain_class(Class severest, const Thresholds& t) {
  return std::min(severest, t.clearance > t.gap ? Class::clearance_violation : Class::contact);
}

/// Returns the separation with the part of a weld for which the snap may account put to what it
/// moved.
SignedSeparation with_weld(const SignedSeparation& s, double by_snap) {
  SignedSeparation of_snap = s;
  of_snap.sag -= by_snap;
  of_snap.moved += by_snap;
  return of_snap;
}

/// Classifies for a bracket of this width.
Classification classify(const SignedSeparation& s, double width, const Thresholds& t) {
  // Bodies with coarse numbers may be apart where these meet.
  const bool meet = s.interiors_meet && !(t.step > 0);
  const Class severe = class_of({s.lower, -s.moved, s.interiors_meet}, t);
  const Class mild = class_of({s.upper, s.moved, meet}, t);
  Classification j;
  if (severe == mild) {
    j.cls = severe;
  } else if (width <= kBorderlineWidth) {
    j.cls = severe;
    j.flags = kBorderline;
  } else {
    j.cls = class_of_nominal(s, t);
    j.flags = kUncertain;
  }
  // With sag the true bodies may be apart even where the meshes' interiors meet, and are not those
  // on the grid: what the snap moved counts at a tolerance of 0 too.
  const bool no_sag = !(s.sag > 0);
  j.severest = class_of({s.lower - s.sag, -s.moved, s.interiors_meet, no_sag}, t);
  const Class mildest = class_of({s.upper + s.sag, s.moved, meet && no_sag, no_sag}, t);
  if (s.sag > 0 && (j.severest != j.cls || mildest != j.cls)) {
    if (width + 2 * s.sag <= kBorderlineWidth) {
      j.cls = j.severest;
      j.flags |= kBorderline;
    } else {
      j.flags |= kUncertain;
    }
  }
  if (j.cls == Class::no_hit && t.weld > kMaxWeldBySnap) j.cls = least_certain_class(j.severest, t);
  j.severest = std::max(j.severest, j.cls);
  return j;
}

}  // namespace

Classification classify(const SignedSeparation& s, const Thresholds& t) {
  const double by_snap = t.weld <= kMaxWeldBySnap ? std::min(t.weld, s.sag) : 0;
  return classify(with_weld(s, by_snap), s.upper - s.lower + 2 * s.moved, t);
}

}  // namespace strake::clash
