// SPDX-License-Identifier: Apache-2.0
#include "hlr/sections/sectioned_shapes.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "strake/geometry/part.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;
using geometry::CutPlane;
using geometry::Segment;
using geometry::Vec3i;
using geometry::Vec3l;

/// The section planes as they concern one body.
struct BodySections {
  std::uint32_t shape = 0;
  bool away = false;
  std::vector<std::uint32_t> numbers;
  std::vector<CutPlane> planes;

  friend bool operator==(const BodySections&, const BodySections&) = default;
};

BodySections body_sections_of(const model::Scene& scene, const model::GridBody& body,
                              std::span<const SectionPlane> planes) {
  BodySections body_sections{.shape = body.grid_shape, .numbers = {}, .planes = {}};
  const model::GridShape& shape = scene.shapes[body.grid_shape];
  if (shape.box.empty()) return body_sections;
  const Box3l box = body.box(shape);
  for (std::uint32_t i = 0; i < planes.size(); ++i) {
    if (planes[i].least(box) >= 0) return {body.grid_shape, true, {}, {}};
    if (planes[i].greatest(box) < 0) continue;
    body_sections.numbers.push_back(i);
    body_sections.planes.push_back(planes[i].at(body.origin));
  }
  return body_sections;
}

std::uint64_t hash_of(const BodySections& body_sections) {
  std::uint64_t h = parallel::mixed(body_sections.away ? 1 : 0, body_sections.shape);
  for (std::size_t i = 0; i < body_sections.planes.size(); ++i) {
    h = parallel::mixed(h, body_sections.numbers[i]);
    h = parallel::mixed(h, static_cast<std::uint64_t>(body_sections.planes[i].offset));
  }
  return h;
}

/// Returns an empty part that stands in the place of one.
geometry::Part nothing_of(const geometry::Part& part) {
  geometry::Part nothing;
  nothing.kind = part.kind;
  return nothing;
}

SectionedShape cut_shape(const model::Scene& scene, const BodySections& body_sections) {
  const model::GridShape& source = scene.shapes[body_sections.shape];
  SectionedShape sectioned{
      &source, body_sections.numbers, body_sections.planes, body_sections.away, nullptr, 0};
  if (!body_sections.away && body_sections.planes.empty()) return sectioned;
  sectioned.cut = std::make_unique<ShapeCut>();
  ShapeCut& cut = *sectioned.cut;
  cut.rims.resize(body_sections.planes.size());
  for (const geometry::Part& part : source.parts) {
    if (body_sections.away) {
      cut.shape.parts.push_back(nothing_of(part));
      continue;
    }
    geometry::PartSection one = geometry::cut(part, body_sections.planes);
    cut.lines.insert(cut.lines.end(), one.lines.begin(), one.lines.end());
    for (std::uint32_t p = 0; p < body_sections.planes.size(); ++p) {
      const auto rim = geometry::cap_boundary(one, p);
      cut.rims[p].insert(cut.rims[p].end(), rim.begin(), rim.end());
    }
    cut.open_ends += one.open_ends;
    cut.not_filled += one.not_filled;
    sectioned.within = std::max<std::int64_t>(sectioned.within, one.rounded);
    cut.shape.parts.push_back(std::move(one.part));
  }
  cut.shape.shape = source.shape;
  cut.shape.base = source.base;
  // The box is the source's: edges may be left where rounding leaves no face.
  cut.shape.box = source.box;
  return sectioned;
}

/// Looks up an edge of a cut part by its ends: part-edge numbers are those of the source.
std::uint32_t edge_in(const geometry::Part& part, const Vec3i& a, const Vec3i& b) {
  const auto vertex = [&](const Vec3i& p) {
    const auto found = std::ranges::lower_bound(part.vertices, p);
    return found != part.vertices.end() && *found == p
               ? static_cast<std::uint32_t>(found - part.vertices.begin())
               : geometry::kNoIndex;
  };
  const std::uint32_t u = vertex(a), v = vertex(b);
  if (u == geometry::kNoIndex || v == geometry::kNoIndex || part.edges.empty()) return kNoPartEdge;
  const std::uint32_t edge = geometry::edge_between(part, u, v);
  return edge == geometry::kNoIndex ? kNoPartEdge : edge;
}

class EdgeCutter {
 public:
  EdgeCutter(const SectionedShape& sectioned, const FeatureOptions& options)
      : sectioned_(sectioned), options_(options) {}

  std::vector<FeatureEdge> run(std::span<const FeatureEdge> edges) {
    for (const FeatureEdge& e : edges) add(e);
    std::ranges::sort(edges_, [](const FeatureEdge& x, const FeatureEdge& y) {
      return std::tie(x.part, x.a, x.b, x.cut_away, x.kind, x.part_edge) <
             std::tie(y.part, y.a, y.b, y.cut_away, y.kind, y.part_edge);
    });
    return std::move(edges_);
  }

 private:
  void add(const FeatureEdge& e) {
    const Segment whole{e.a.as<std::int64_t>(), e.b.as<std::int64_t>()};
    const auto left =
        sectioned_.away ? std::nullopt : geometry::left_of(whole, std::span(sectioned_.planes));
    if (!left) return push(e, whole, true);
    const Segment before{whole[0], (*left)[0]}, after{(*left)[1], whole[1]};
    push(e, before, true);
    push(e, *left, false);
    push(e, after, true);
  }

  void push(FeatureEdge e, const Segment& at, bool cut_away) {
    if (at[0] == at[1]) return;
    e.a = std::min(at[0], at[1]).as<std::int32_t>();
    e.b = std::max(at[0], at[1]).as<std::int32_t>();
    e.cut_away = cut_away;
    // An edge that rounding laid along the direction, or turned a little off it, is a point on
    // paper.
    e.projecting = e.projecting || options_.viewer.projects_to_point(at[0], at[1]);
    if (e.part_edge != kNoPartEdge && sectioned_.cut)
      e.part_edge = cut_away ? kNoPartEdge : edge_in(sectioned_.shape().parts[e.part], e.a, e.b);
    edges_.push_back(e);
  }

  const SectionedShape& sectioned_;
  const FeatureOptions& options_;
  std::vector<FeatureEdge> edges_;
};

}  // namespace

Result<SectionedShapes> make_sectioned_shapes(const model::Scene& scene,
                                              const std::vector<bool>& drawn,
                                              const std::vector<bool>& uncut,
                                              std::span<const SectionPlane> planes,
                                              const parallel::Context& context) {
  SectionedShapes sectioned;
  const auto is_cut = [&](std::size_t b) {
    const std::uint32_t object = model::index(scene.bodies[b].object);
    return drawn[object] && (uncut.empty() || !uncut[object]);
  };
  if (planes.empty()) {
    auto all = parallel::transform(
        context, {.name = "sections: whole shapes", .n = scene.shapes.size(), .grain = 4096},
        [&](std::size_t s) { return SectionedShape{&scene.shapes[s], {}, {}, false, nullptr, 0}; });
    if (!all) return all.error();
    sectioned.all = std::move(*all);
    auto of = parallel::transform(
        context, {.name = "sections: none", .n = scene.bodies.size(), .grain = 4096},
        [&](std::size_t b) { return scene.bodies[b].grid_shape; });
    if (!of) return of.error();
    sectioned.of = std::move(*of);
    return sectioned;
  }
  auto cuts_of_bodies = parallel::transform(
      context, {.name = "sections: planes", .n = scene.bodies.size(), .grain = 1024},
      [&](std::size_t b) {
        return is_cut(b)
                   ? body_sections_of(scene, scene.bodies[b], planes)
                   : BodySections{.shape = scene.bodies[b].grid_shape, .numbers = {}, .planes = {}};
      });
  if (!cuts_of_bodies) return cuts_of_bodies.error();
  auto kinds = parallel::distinct(
      context, "sections: equal cuts", cuts_of_bodies->size(),
      [&](std::size_t b) { return hash_of((*cuts_of_bodies)[b]); },
      [&](std::size_t a, std::size_t b) { return (*cuts_of_bodies)[a] == (*cuts_of_bodies)[b]; });
  if (!kinds) return kinds.error();
  const auto order = parallel::longest_first(kinds->first.size(), [&](std::size_t k) {
    const BodySections& body_sections = (*cuts_of_bodies)[kinds->first[k]];
    std::size_t triangles = 0;
    for (const geometry::Part& part : scene.shapes[body_sections.shape].parts)
      triangles += part.triangles.size();
    return triangles * body_sections.planes.size();
  });
  auto all = parallel::transform(
      context, {.name = "sections: shapes", .n = kinds->first.size(), .order = order},
      [&](std::size_t k) { return cut_shape(scene, (*cuts_of_bodies)[kinds->first[k]]); });
  if (!all) return all.error();
  sectioned.all = std::move(*all);
  sectioned.of = std::move(kinds->of);
  parallel::clear(*cuts_of_bodies, context);
  return sectioned;
}

Result<std::vector<FeatureEdge>> sectioned_edges(const SectionedShape& sectioned,
                                                 const FeatureOptions& options,
                                                 const parallel::Context& context) {
  auto edges = feature_edges(*sectioned.source, options, context);
  if (!edges || (!sectioned.away && sectioned.planes.empty())) return edges;
  return EdgeCutter(sectioned, options).run(*edges);
}

}  // namespace strake::hlr
