// SPDX-License-Identifier: Apache-2.0
#include "hlr/lines.hpp"

#include <utility>

#include "hlr/hatch.hpp"
#include "hlr/job.hpp"

namespace strake::hlr {
namespace {

using geometry::CutPlane;
using geometry::Segment;
using geometry::Vec3l;

void add_crossing(Lines& lines, const model::Scene& scene, const Crossing& crossing,
                  std::span<const SectionPlane> planes) {
  const auto push = [&](const Vec3l& a, const Vec3l& b, bool cut_away) {
    if (a != b)
      lines.all.push_back(
          {a, b, crossing.body_a, crossing.body_b, EdgeKind::intersection, cut_away});
  };
  if (planes.empty()) return push(crossing.a, crossing.b, false);
  const Vec3l origin = scene.bodies[crossing.body_a].origin;
  std::vector<CutPlane> local;
  for (const SectionPlane& plane : planes) local.push_back(plane.at(origin));
  const auto left = geometry::left_of({crossing.a - origin, crossing.b - origin}, local);
  if (!left) return push(crossing.a, crossing.b, true);
  const Vec3l a = (*left)[0] + origin, b = (*left)[1] + origin;
  push(crossing.a, a, true);
  push(a, b, false);
  push(b, crossing.b, true);
}

void add_section(Lines& lines, const model::Scene& scene, std::uint32_t b, const ShapeCut& cut) {
  const Vec3l origin = scene.bodies[b].origin;
  for (const geometry::SectionLine& line : cut.lines)
    lines.all.push_back({line.at[0] + origin, line.at[1] + origin, b, b, EdgeKind::section, false});
}

/// By object; of one object as they came.
void put_in_order(Lines& lines, const model::Scene& scene) {
  if (lines.all.empty()) return;
  const auto object = [&](const Line& line) {
    return model::index(scene.bodies[line.body_a].object);
  };
  lines.first.resize(scene.model->objects.size() + 1);
  for (const Line& line : lines.all) ++lines.first[object(line) + 1];
  for (std::size_t o = 1; o < lines.first.size(); ++o) lines.first[o] += lines.first[o - 1];
  std::vector<std::size_t> next = lines.first;
  std::vector<Line> ordered(lines.all.size());
  for (const Line& line : lines.all) ordered[next[object(line)]++] = line;
  lines.all = std::move(ordered);
}

}  // namespace

Result<Lines> gather_lines(const Job& job, std::span<const Crossing> crossings,
                           std::span<const SectionPlane> planes, const parallel::Context& context) {
  const model::Scene& scene = *job.scene;
  Lines lines;
  lines.contact = 1 + static_cast<std::int64_t>(planes.size());
  for (const Crossing& crossing : crossings) add_crossing(lines, scene, crossing, planes);
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
    if (const ShapeCut* cut = job.seen_of(b).cut.get()) add_section(lines, scene, b, *cut);
  const auto hatch = hatch_lines(job, planes, context);
  if (!hatch) return hatch.error();
  lines.all.insert(lines.all.end(), hatch->begin(), hatch->end());
  put_in_order(lines, scene);
  return lines;
}

}  // namespace strake::hlr
