// SPDX-License-Identifier: Apache-2.0
#include "clash/enclosed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "strake/geometry/face_holes.hpp"
#include "strake/geometry/winding_number.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::clash {
namespace {

using geometry::PartKind;
using geometry::Vec3d;
using geometry::WindingNumber;

/// Whether some of a part may lie within another; all of it need not, as it may reach out through
/// the gap.
bool may_enclose(const PartRef& around, const PartRef& within) {
  const geometry::Part &a = *around.placed.part, &b = *within.placed.part;
  return a.kind == PartKind::sheet && b.kind != PartKind::wire &&
         !a.box.as<std::int64_t>()
              .moved(around.placed.origin)
              .common(b.box.as<std::int64_t>().moved(within.placed.origin))
              .empty();
}

/// Some eight corners of a part, of those in the box of the other, in its coordinates. Every second
/// corner of a box, in the order of coordinates, may stand on the floor.
std::vector<Vec3d> corners_in_box(const PartRef& around, const PartRef& within) {
  constexpr std::size_t kAsked = 8;
  const geometry::Vec3l shift = within.placed.origin - around.placed.origin;
  const geometry::Box3l box = around.placed.part->box.as<std::int64_t>();
  std::vector<Vec3d> corners;
  for (const geometry::Vec3i& v : within.placed.part->vertices) {
    const geometry::Vec3l at = v.as<std::int64_t>() + shift;
    if (box.contains({at, at})) corners.push_back(at.as<double>());
  }
  const std::size_t step = (corners.size() / kAsked) | 1U;
  std::vector<Vec3d> asked;
  for (std::size_t v = 0; v < corners.size(); v += step) asked.push_back(corners[v]);
  return asked;
}

/// Whether a corner of a part lies within, and not on the skin: then a little to this side of it
/// and a little to that is within, too.
bool lies_within(const WindingNumber& winding, const PartRef& around, const PartRef& within) {
  constexpr double kLittle = 16;
  const geometry::Box3d box = within.placed.part->box.as<double>().moved(
      (within.placed.origin - around.placed.origin).as<double>());
  const Vec3d middle = (box.lo + box.hi) * 0.5;
  return std::ranges::any_of(corners_in_box(around, within), [&](const Vec3d& corner) {
    const Vec3d way = middle - corner;
    const double length = std::sqrt(dot(way, way));
    const Vec3d off = length > 0 ? way * (kLittle / length) : Vec3d{};
    return winding.surrounds(corner + off) && winding.surrounds(corner - off);
  });
}

/// A surface, how open it is, and may be.
struct Around {
  WindingNumber winding;
  double openness = 1, most = 0;
};

/// Of the directions within a surface, those that may lead out on average, if it is to be meant as
/// a body: where skins are apart, there where it lacks pieces of flat faces alone, and where they
/// touch, which is told already, but not as what it may be.
constexpr double kMostOut = 0.05, kMostOutOfFaces = 0.25, kMostOutOfContact = 0.01;

bool may_be_hit(const Candidate& c) {
  const Judgement& j = c.look.answer.judgement;
  return !c.too_large &&
         (j.cls < Class::contact || (j.cls == Class::contact && j.severest < Class::hit));
}

}  // namespace

Status mark_enclosed(const Stage& stage, std::vector<Candidate>& candidates) {
  const CaseWork& work = stage.work;
  const auto asked = work.that("pairs within open surfaces", [&](std::size_t i) {
    return may_be_hit(candidates[i]) &&
           (may_enclose(work.a(i), work.b(i)) || may_enclose(work.b(i), work.a(i)));
  });
  if (!asked) return asked.error();
  if (asked->empty()) return {};
  std::vector<const geometry::Part*> parts(work.parts_of({}).size(), nullptr);
  for (const std::size_t i : *asked) {
    const PartRef &a = work.a(i), &b = work.b(i);
    if (may_enclose(a, b)) parts[a.unique] = a.placed.part;
    if (may_enclose(b, a)) parts[b.unique] = b.placed.part;
  }
  std::vector<std::optional<Around>> around(parts.size());
  const Status made = parallel::for_each(
      work.context(), {.name = "winding numbers", .n = parts.size(), .grain = 1},
      [&](std::size_t p) {
        if (parts[p] == nullptr) return;
        WindingNumber winding(*parts[p]);
        const double most = geometry::lacks_pieces_of_faces(*parts[p]) ? kMostOutOfFaces : kMostOut;
        const double openness = winding.openness(most);
        if (openness <= most) around[p] = {std::move(winding), openness, most};
      });
  if (!made) return made.error();
  return work.over(*asked, "pairs within open surfaces", CaseWork::kGrain,
                   [&](std::size_t i, const PartRef& a, const PartRef& b) {
                     Judgement& judgement = candidates[i].look.answer.judgement;
                     const bool touch = judgement.cls == Class::contact;
                     const auto within = [&](const PartRef& skin, const PartRef& part) {
                       const auto& of = around[skin.unique];
                       return of && of->openness <= (touch ? kMostOutOfContact : of->most) &&
                              may_enclose(skin, part) && lies_within(of->winding, skin, part);
                     };
                     if (!within(a, b) && !within(b, a)) return;
                     if (touch) {
                       judgement.severest = Class::hit;
                       judgement.flags |= kUncertain;
                     } else {
                       candidates[i].in_open = true;
                     }
                   });
}

}  // namespace strake::clash
