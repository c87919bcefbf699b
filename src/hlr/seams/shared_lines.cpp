// SPDX-License-Identifier: Apache-2.0
#include "hlr/seams/shared_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "geometry/bvh/scene_bvh.hpp"
#include "geometry/plane_section/plane_section.hpp"
#include "geometry/predicates/exact_normal.hpp"
#include "hlr/view/taxicab.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;
using geometry::Int128;
using geometry::Segment;
using geometry::Vec3l;

Int128 wide_dot(const Vec3l& a, const Vec3l& b) {
  return geometry::along({Int128{a.x}, Int128{a.y}, Int128{a.z}}, b);
}

Box3l box_of(const Segment& line) {
  Box3l box = geometry::empty_box<std::int64_t>();
  for (const Vec3l& end : line) box.include(end);
  return box;
}

/// Returns whether an edge lies inside a face, or is none. The rim of a sheet does not.
bool is_within_face(const geometry::Part& part, std::span<const std::uint32_t> triangles) {
  if (part.faces.empty() || triangles.size() < 2) return triangles.empty();
  const std::uint32_t face = part.faces[triangles[0]];
  return face != geometry::kNoIndex &&
         std::ranges::all_of(triangles, [&](std::uint32_t t) { return part.faces[t] == face; });
}

}  // namespace

LineMeasure::LineMeasure(const Segment& of)
    : line(of), length(wide_dot(of[1] - of[0], of[1] - of[0])) {}

Int128 LineMeasure::along(const Vec3l& point) const {
  return wide_dot(point - line[0], line[1] - line[0]);
}

Vec3l LineMeasure::at(Int128 place) const {
  Vec3l point = line[0];
  for (int k = 0; k < 3; ++k)
    point[k] += geometry::round_div((line[1][k] - line[0][k]) * place, length);
  return point;
}

Int128 LineMeasure::room(std::int64_t distance) const {
  return Int128{distance} * taxicab(line[1] - line[0]);
}

bool LineMeasure::passes(const Vec3l& point, std::int64_t distance) const {
  const Int128 largest = room(distance);
  return std::ranges::all_of(geometry::wide_cross(line[1] - line[0], point - line[0]),
                             [&](Int128 k) { return magnitude(k) <= largest; });
}

Segment edge_line(const geometry::PlacedPart& placed, std::uint32_t edge) {
  const geometry::PartEdge& e = placed.part->edges[edge];
  const auto& vertices = placed.part->vertices;
  const auto [lo, hi] = std::minmax(vertices[e.v0], vertices[e.v1]);
  return {lo.as<std::int64_t>() + placed.origin, hi.as<std::int64_t>() + placed.origin};
}

std::vector<SeamSurface> seam_surfaces(const ViewJob& job) {
  std::vector<SeamSurface> surfaces;
  for (std::uint32_t b = 0; b < job.scene->bodies.size(); ++b) {
    const model::GridBody& body = job.scene->bodies[b];
    const SectionedShape& sectioned = job.sectioned_shape_of(b);
    if (!job.drawn[model::index(body.object)] || sectioned.away) continue;
    for (std::uint32_t p = 0; p < sectioned.source->parts.size(); ++p)
      if (const geometry::Part& part = sectioned.source->parts[p];
          !part.triangles.empty() && !part.edges.empty())
        surfaces.push_back({{&part, body.origin}, b, p, job.contact[b]});
  }
  return surfaces;
}

namespace {

/// An edge of a part that may be a seam.
struct SharedLineCandidate {
  std::uint32_t edge = 0;
  Segment line;
  Box3l box;
};

/// Finds the lines that two parts share.
class PairLines {
 public:
  PairLines(const ViewJob& job, const std::vector<SeamSurface>& surfaces, std::uint32_t a,
            std::uint32_t b)
      : job_(job),
        surfaces_(surfaces),
        a_(a),
        b_(b),
        contact_(std::max(surfaces[a].contact, surfaces[b].contact)) {}

  void run(std::vector<SharedLine>& out) {
    const Box3l room =
        box_of_part(a_).common(box_of_part(b_).inflated(contact_)).inflated(contact_);
    const std::vector<SharedLineCandidate> of_a = candidates(a_, room), of_b = candidates(b_, room);
    std::size_t first = 0;  // of b, sorted by the least x: none before it reaches any later edge
    std::int64_t widest = 0;
    for (const SharedLineCandidate& f : of_b) widest = std::max(widest, f.box.hi.x - f.box.lo.x);
    for (const SharedLineCandidate& e : of_a) {
      while (first < of_b.size() && of_b[first].box.lo.x + widest + contact_ < e.box.lo.x) ++first;
      for (std::size_t i = first; i < of_b.size(); ++i) {
        if (of_b[i].box.lo.x > e.box.hi.x + contact_) break;
        if (of_b[i].box.inflated(contact_).meets(e.box)) compare(e, of_b[i], out);
      }
    }
  }

 private:
  [[nodiscard]] Box3l box_of_part(std::uint32_t surface) const {
    const geometry::PlacedPart& placed = surfaces_[surface].placed;
    return placed.part->box.as<std::int64_t>().moved(placed.origin);
  }

  /// Returns the edges that meet a box, by their least x.
  [[nodiscard]] std::vector<SharedLineCandidate> candidates(std::uint32_t surface,
                                                            const Box3l& room) const {
    const geometry::PlacedPart& placed = surfaces_[surface].placed;
    std::vector<SharedLineCandidate> found;
    for (std::uint32_t e = 0; e + 1 < placed.part->edges.size(); ++e) {
      const Segment line = edge_line(placed, e);
      const Box3l box = box_of(line);
      if (line[0] == line[1] || !box.meets(room) ||
          is_within_face(*placed.part, geometry::incident_triangles(*placed.part, e)))
        continue;
      found.push_back({e, line, box});
    }
    std::ranges::sort(found, {},
                      [](const SharedLineCandidate& c) { return std::pair(c.box.lo.x, c.edge); });
    return found;
  }

  void compare(const SharedLineCandidate& e, const SharedLineCandidate& f,
               std::vector<SharedLine>& out) const {
    const LineMeasure on_e(e.line), on_f(f.line);
    const bool e_is_longer = on_e.length >= on_f.length;
    const LineMeasure& longer = e_is_longer ? on_e : on_f;
    const Segment& shorter = e_is_longer ? f.line : e.line;
    if (!longer.passes(shorter[0], contact_) || !longer.passes(shorter[1], contact_)) return;
    add(a_, e.edge, on_e, b_, f.edge, f.line, out);
    add(b_, f.edge, on_f, a_, e.edge, e.line, out);
  }

  void add(std::uint32_t surface, std::uint32_t edge, const LineMeasure& on, std::uint32_t other,
           std::uint32_t along, const Segment& line, std::vector<SharedLine>& out) const {
    const auto left = what_is_left(other, line);
    if (!left) return;
    const Int128 room = on.room(contact_);
    Int128 from = on.along((*left)[0]), to = on.along((*left)[1]);
    if (to < from) std::swap(from, to);
    if (from <= room) from = 0;
    if (to >= on.length - room) to = on.length;
    if (to - from > room) out.push_back({surface, edge, from, to, other, along, contact_});
  }

  /// Returns what sections leave of an edge of a part.
  [[nodiscard]] std::optional<Segment> what_is_left(std::uint32_t surface,
                                                    const Segment& line) const {
    const SectionedShape& sectioned = job_.sectioned_shape_of(surfaces_[surface].body);
    if (sectioned.planes.empty()) return line;
    const Vec3l& origin = surfaces_[surface].placed.origin;
    auto left = geometry::left_of({line[0] - origin, line[1] - origin}, sectioned.planes);
    if (left)
      for (Vec3l& end : *left) end = end + origin;
    return left;
  }

  const ViewJob& job_;
  const std::vector<SeamSurface>& surfaces_;
  std::uint32_t a_, b_;
  std::int64_t contact_;
};

bool are_of_one_kind(const ViewJob& job, const SeamSurface& a, const SeamSurface& b) {
  const auto body = [&](const SeamSurface& surface) -> const model::Body& {
    return job.scene->model->bodies[job.scene->bodies[surface.body].body];
  };
  return body(a).color == body(b).color && body(a).category == body(b).category;
}

}  // namespace

Result<std::vector<SharedLine>> find_shared_lines(const ViewJob& job,
                                                  const std::vector<SeamSurface>& surfaces,
                                                  const parallel::Context& context) {
  std::vector<geometry::BoxItem> items(surfaces.size());
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    const geometry::PlacedPart& placed = surfaces[s].placed;
    items[s].box =
        placed.part->box.as<std::int64_t>().moved(placed.origin).inflated(surfaces[s].contact);
    items[s].owner = s;
  }
  const auto tree = geometry::SceneBvh::build(items, context);
  if (!tree) return tree.error();
  const auto pairs = geometry::overlapping_box_pairs(*tree, context);
  if (!pairs) return pairs.error();
  auto lines = parallel::collect<SharedLine>(
      context, {.name = "seams: shared lines", .n = pairs->size(), .grain = 64},
      [&](std::size_t i, std::vector<SharedLine>& out) {
        const auto [a, b] = (*pairs)[i];
        if (are_of_one_kind(job, surfaces[a], surfaces[b])) PairLines(job, surfaces, a, b).run(out);
      });
  if (!lines) return lines.error();
  std::ranges::sort(*lines);
  return std::move(*lines);
}

}  // namespace strake::hlr
