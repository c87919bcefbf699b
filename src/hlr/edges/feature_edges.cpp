// SPDX-License-Identifier: Apache-2.0
#include "hlr/edges/feature_edges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "hlr/edges/element_loop.hpp"
#include "hlr/edges/slivers.hpp"
#include "hlr/edges/tangent_edges.hpp"
#include "strake/geometry/part.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::hlr {
namespace {

using geometry::has_directed_edge;
using geometry::Part;
using geometry::Triangle;
using geometry::Vec3i;
using geometry::Vec3l;

ExactNormal negated(const ExactNormal& n) { return {-n[0], -n[1], -n[2]}; }

geometry::Vec3d rounded(const ExactNormal& n) {
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

// A fixed expression of doubles: the normals are rounded once each, so the decision depends on
// the shape alone and survives translation and reordering. Facets that turn by just the sharp angle
// are not sharp, however rounding left them: all edges of a prism are drawn or none, as long as its
// facets are wider than slivers.
template <class Allowance>
bool is_sharp(const ExactNormal& m, const ExactNormal& n, double cos_sharp,
              const Allowance& by_rounding) {
  const geometry::Vec3d p = rounded(m), q = rounded(n);
  const double along = dot(p, q), lengths = std::sqrt(dot(p, p)) * std::sqrt(dot(q, q));
  if (!(along < cos_sharp * lengths)) return false;
  // The cosine of the sharp angle and a small one more.
  const double more = by_rounding(),
               sin_sharp = std::sqrt(std::max(0.0, 1 - cos_sharp * cos_sharp));
  return along < (cos_sharp * (1 - more * more / 2) - sin_sharp * more) * lengths;
}

/// The plane that decides to which side a face looks.
struct FacePlane {
  ExactNormal normal{};
  Vec3i on{};
  double turn = 0;  ///< the turn that rounding may account for, radians
};

FacePlane plane_of(const Part& part, std::uint32_t t) {
  const Triangle& i = part.triangles[t];
  return {triangle_normal(part, t),
          std::min({part.vertices[i[0]], part.vertices[i[1]], part.vertices[i[2]]}),
          part.primitive ? 0 : turn_by_rounding(part, t)};
}

// Returns for each triangle the area vector and the lexicographically least corner of its whole
// source face, and the turn that rounding may give the face's steadiest triangle. They depend on
// the outline of the face alone, so neither the triangulation nor the way that snapping bends a
// polygon decides whether it faces the viewer.
Result<std::vector<FacePlane>> face_planes(const Part& part, const parallel::Context& context) {
  const std::size_t count = part.triangles.size();
  std::vector<FacePlane> result(count);
  const Status status = parallel::for_each(
      context, over_elements("hidden lines: faces", count),
      [&](std::size_t t) { result[t] = plane_of(part, static_cast<std::uint32_t>(t)); });
  if (!status) return status.error();
  if (part.faces.empty()) return result;

  std::vector<std::uint32_t> order;
  order.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t)
    if (part.faces[t] != geometry::kNoIndex) order.push_back(t);
  const auto by_face = [&](std::uint32_t s, std::uint32_t t) {
    return part.faces[s] < part.faces[t];
  };
  if (!std::is_sorted(order.begin(), order.end(), by_face))
    std::sort(order.begin(), order.end(), by_face);
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    FacePlane sum{{}, result[order[i]].on, result[order[i]].turn};
    for (; end < order.size() && part.faces[order[end]] == part.faces[order[i]]; ++end) {
      const FacePlane& own = result[order[end]];
      for (std::size_t k = 0; k < 3; ++k) sum.normal[k] += own.normal[k];
      sum.on = std::min(sum.on, own.on);
      sum.turn = std::min(sum.turn, own.turn);
    }
    if (!is_zero(sum.normal))
      for (std::size_t j = i; j < end; ++j) result[order[j]] = sum;
    i = end;
  }
  return result;
}

// The data by which a part's edges are classified, per triangle.
struct Faces {
  std::vector<FacePlane> planes;
  /// Whether a triangle belongs to a curved side, whose quads and triangles differ from the flat
  /// ends by their few triangles: between two of them there is no edge however coarse the
  /// tessellation of a thin pipe is. Empty where the part has no curved side.
  std::vector<bool> facet;
  PlaneOwners owners;
};

Result<Faces> faces_of(const Part& part, const parallel::Context& context) {
  auto planes = face_planes(part, context);
  if (!planes) return planes.error();
  Faces result{std::move(*planes), {}, plane_owners(part)};
  for (std::size_t t = 0; t < result.owners.of.size(); ++t) {
    if (result.owners.of[t] == t) continue;
    result.planes[t] = result.planes[result.owners.of[t]];
    if (result.owners.turned[t] != 0) result.planes[t].normal = negated(result.planes[t].normal);
  }
  if (!part.primitive || !geometry::is_round(*part.primitive) || part.faces.empty()) return result;
  std::vector<std::uint32_t> sorted = part.faces.to_vector();
  std::sort(sorted.begin(), sorted.end());
  result.facet.reserve(part.faces.size());
  for (const std::uint32_t face : part.faces) {
    const auto range = std::equal_range(sorted.begin(), sorted.end(), face);
    result.facet.push_back(face == geometry::kNoIndex || range.second - range.first <= 2);
  }
  return result;
}

struct ClassifiedEdge {
  EdgeKind kind = EdgeKind::sharp;
  bool away = false;
};

std::optional<ClassifiedEdge> classify_edge(const Part& part, std::uint32_t edge,
                                            const Faces& faces, const FeatureOptions& options) {
  const geometry::PartEdge& e = part.edges[edge];
  const std::span<const std::uint32_t> round = geometry::incident_triangles(part, edge);
  if (round.empty()) return std::nullopt;
  if (round.size() == 1) return ClassifiedEdge{EdgeKind::boundary};
  const auto face = [&](std::uint32_t t) {
    return part.faces.empty() ? geometry::kNoIndex : part.faces[t];
  };
  const std::uint32_t first = face(round[0]);
  const bool one_face = first != geometry::kNoIndex &&
                        std::ranges::all_of(round, [&](auto t) { return face(t) == first; });
  if (one_face) return std::nullopt;
  if (round.size() > 2) return ClassifiedEdge{EdgeKind::non_manifold};

  const std::uint32_t s = round[0], t = round[1];
  const bool consistent = has_directed_edge(part.triangles[s], e.v0, e.v1) !=
                          has_directed_edge(part.triangles[t], e.v0, e.v1);
  const FacePlane &one = faces.planes[s], &other = faces.planes[t];
  const ExactNormal &m = one.normal, n = consistent ? other.normal : negated(other.normal);
  const bool smooth = !faces.facet.empty() && faces.facet[s] && faces.facet[t];
  const auto by_rounding = [&] { return one.turn + other.turn; };
  // A face seen edge-on counts as turned away: between a front face, an edge-on strip and a back
  // face exactly one line is the contour.
  const bool front_m = options.viewer.is_towards(m, one.on.as<std::int64_t>());
  const bool front_n = options.viewer.is_towards(n, other.on.as<std::int64_t>());
  // The winding of a sheet has no meaning.
  const bool away = part.kind == geometry::PartKind::solid && !front_m && !front_n;
  if (!smooth && is_sharp(m, n, options.cos_sharp, by_rounding))
    return ClassifiedEdge{EdgeKind::sharp, away};
  if (front_m != front_n) return ClassifiedEdge{EdgeKind::contour, false};
  // Between two facets of a curved side there is no edge at all.
  if (options.smooth != Smooth::off && !smooth &&
      (bends(part, faces.owners, e, s, t) || bends(part, faces.owners, e, t, s)))
    return ClassifiedEdge{EdgeKind::smooth, away};
  return std::nullopt;
}

// Adds nothing where the edge has no length.
void add_edge(std::vector<FeatureEdge>& edges, const Part& part, FeatureEdge e, std::uint32_t v0,
              std::uint32_t v1, const Viewer& viewer) {
  e.a = std::min(part.vertices[v0], part.vertices[v1]);
  e.b = std::max(part.vertices[v0], part.vertices[v1]);
  if (e.a == e.b) return;
  e.projecting = viewer.projects_to_point(e.a.as<std::int64_t>(), e.b.as<std::int64_t>());
  edges.push_back(e);
}

void add_chains(std::vector<FeatureEdge>& edges, const Part& part, std::uint32_t part_index,
                EdgeKind kind, const Viewer& viewer) {
  for (std::size_t c = 0; c + 1 < part.chain_first.size(); ++c)
    for (std::uint32_t v = part.chain_first[c]; v + 1 < part.chain_first[c + 1]; ++v)
      add_edge(edges, part, {.part = part_index, .part_edge = kNoPartEdge, .kind = kind}, v, v + 1,
               viewer);
}

void sort_edges(std::vector<FeatureEdge>& edges) {
  const auto before = [](const FeatureEdge& x, const FeatureEdge& y) {
    return std::tie(x.a, x.b, x.part_edge, x.kind) < std::tie(y.a, y.b, y.part_edge, y.kind);
  };
  // Most are in this order already: vertices and edges of a part are sorted.
  if (!std::ranges::is_sorted(edges, before)) std::ranges::sort(edges, before);
}

}  // namespace

double cosine_of_degrees(double degrees) {
  const bool obtuse = degrees > 90;
  const double x = (obtuse ? 180 - degrees : degrees) * 0.017453292519943295;
  const double q = x * x;
  double sum = 1;
  // Horner form of the Taylor series; at a quarter turn the first term left out is 1e-18.
  for (int k = 22; k >= 2; k -= 2) sum = 1 - q / (k * (k - 1.0)) * sum;
  return obtuse ? -sum : sum;
}

Result<std::vector<FeatureEdge>> view_independent_edges(const Part& part, double cos_sharp) {
  std::vector<FeatureEdge> edges;
  if (part.edges.empty()) return edges;
  const Result<Faces> faces = faces_of(part, {});
  if (!faces) return faces.error();
  const FeatureOptions options{.viewer = {}, .cos_sharp = cos_sharp};
  for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e)
    if (const auto is = classify_edge(part, e, *faces, options);
        is && is->kind != EdgeKind::contour)
      add_edge(edges, part, {.part_edge = e, .kind = is->kind}, part.edges[e].v0, part.edges[e].v1,
               options.viewer);
  return edges;
}

Result<std::vector<FeatureEdge>> feature_edges(const model::GridShape& shape,
                                               const FeatureOptions& options,
                                               const parallel::Context& context) {
  std::vector<FeatureEdge> edges;
  for (std::uint32_t p = 0; p < shape.parts.size(); ++p) {
    const Part& part = shape.parts[p];
    if (part.kind == geometry::PartKind::wire) {
      std::vector<FeatureEdge> chains;
      add_chains(chains, part, p, shape.single_line ? EdgeKind::single_line : EdgeKind::polyline,
                 options.viewer);
      sort_edges(chains);
      edges.insert(edges.end(), chains.begin(), chains.end());
      continue;
    }
    if (part.edges.empty()) continue;
    const Result<Faces> faces = faces_of(part, context);
    if (!faces) return faces.error();
    auto own = parallel::collect<FeatureEdge>(
        context, over_elements("hidden lines: feature edges", part.edges.size() - 1),
        [&](std::size_t i, std::vector<FeatureEdge>& out) {
          const auto e = static_cast<std::uint32_t>(i);
          if (const auto is = classify_edge(part, e, *faces, options))
            add_edge(out, part, {.part = p, .part_edge = e, .kind = is->kind, .away = is->away},
                     part.edges[e].v0, part.edges[e].v1, options.viewer);
        });
    if (!own) return own.error();
    if (options.smooth == Smooth::tangent) keep_tangent_edges(part, faces->owners, *own);
    sort_edges(*own);
    if (edges.empty())
      edges = std::move(*own);
    else
      edges.insert(edges.end(), own->begin(), own->end());
  }
  return edges;
}

}  // namespace strake::hlr
