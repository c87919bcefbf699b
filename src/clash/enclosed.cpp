// SPDX-License-Identifier: Apache-2.0
#include "clash/enclosed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "strake/geometry/winding_number.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::clash {
namespace {

using geometry::PartKind;
using geometry::Vec3d;
using geometry::WindingNumber;

bool may_enclose(const PartRef& around, const PartRef& within) {
  const geometry::Part &a = *around.placed.part, &b = *within.placed.part;
  return a.kind == PartKind::sheet && b.kind != PartKind::wire &&
         a.box.as<std::int64_t>()
             .moved(around.placed.origin)
             .contains(b.box.as<std::int64_t>().moved(within.placed.origin));
}

/// Whether a corner of a part lies within; a few are asked, as it may reach out through the gap.
bool lies_within(const WindingNumber& winding, const PartRef& around, const PartRef& within) {
  constexpr std::size_t kAsked = 4;
  constexpr double kHalf = 0.5;
  const auto& vertices = within.placed.part->vertices;
  const Vec3d shift = (within.placed.origin - around.placed.origin).as<double>();
  const std::size_t step = std::max<std::size_t>(vertices.size() / kAsked, 1);
  for (std::size_t v = 0; v < vertices.size(); v += step)
    if (std::fabs(winding.at(vertices[v].as<double>() + shift)) > kHalf) return true;
  return false;
}

}  // namespace

Status mark_enclosed(const Stage& stage, std::vector<Candidate>& candidates) {
  const CaseWork& work = stage.work;
  const auto asked = work.that("pairs within open surfaces", [&](std::size_t i) {
    const Candidate& c = candidates[i];
    return !c.too_large && c.look.answer.judgement.cls < Class::contact &&
           (may_enclose(work.a(i), work.b(i)) || may_enclose(work.b(i), work.a(i)));
  });
  if (!asked) return asked.error();
  if (asked->empty()) return {};
  const std::size_t unique = work.parts_of({}).size();
  std::vector<std::optional<WindingNumber>> windings(unique);
  std::vector<const geometry::Part*> parts(unique, nullptr);
  for (const std::size_t i : *asked) {
    const PartRef &a = work.a(i), &b = work.b(i);
    if (may_enclose(a, b)) parts[a.unique] = a.placed.part;
    if (may_enclose(b, a)) parts[b.unique] = b.placed.part;
  }
  const Status made =
      parallel::for_each(work.context(), {.name = "winding numbers", .n = parts.size(), .grain = 1},
                         [&](std::size_t p) {
                           if (parts[p] == nullptr) return;
                           WindingNumber winding(*parts[p]);
                           if (winding.nearly_encloses()) windings[p] = std::move(winding);
                         });
  if (!made) return made.error();
  return work.over(*asked, "pairs within open surfaces", CaseWork::kGrain,
                   [&](std::size_t i, const PartRef& a, const PartRef& b) {
                     const auto within = [&](const PartRef& around, const PartRef& part) {
                       return may_enclose(around, part) && windings[around.unique] &&
                              lies_within(*windings[around.unique], around, part);
                     };
                     candidates[i].in_open = within(a, b) || within(b, a);
                   });
}

}  // namespace strake::clash
