// SPDX-License-Identifier: Apache-2.0
#include "clash/classify.hpp"

#include <algorithm>

namespace strake::clash {
namespace {

Class class_of(double d, bool interiors_meet, const Thresholds& t) {
  if (d < -t.overlap || (interiors_meet && !(t.overlap > 0))) return Class::hit;
  if (d <= t.gap) return Class::contact;
  if (d < t.clearance) return Class::clearance_violation;
  return Class::no_hit;
}

}  // namespace

Judgement judge(const Separation& s, const Thresholds& t) {
  const Class severe = class_of(s.lower, s.interiors_meet, t);
  const Class mild = class_of(s.upper, s.interiors_meet, t);
  Judgement j;
  if (severe == mild) {
    j.cls = severe;
  } else if (s.upper - s.lower <= 1) {
    j.cls = severe;
    j.flags = kBorderline;
  } else {
    j.cls = class_of(s.d, s.interiors_meet, t);
    j.flags = kUncertain;
  }
  // With sag the true bodies may be apart even where the meshes' interiors meet.
  j.severest = class_of(s.lower - s.sag, s.interiors_meet, t);
  const Class mildest = class_of(s.upper + s.sag, s.interiors_meet && s.sag == 0, t);
  if (s.sag > 0 && (j.severest != j.cls || mildest != j.cls)) {
    if (s.upper - s.lower + 2 * s.sag <= 1) {
      j.cls = j.severest;
      j.flags |= kBorderline;
    } else {
      j.flags |= kUncertain;
    }
  }
  j.severest = std::max(j.severest, j.cls);
  return j;
}

}  // namespace strake::clash
