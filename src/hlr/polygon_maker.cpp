// SPDX-License-Identifier: Apache-2.0
#include "hlr/polygon_maker.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "hlr/edge_on.hpp"
#include "hlr/feature_edges.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {

using geometry::Triangle;

namespace {

/// The first big part of a shape gets its memory from the team; more of them grow it by shares, so
/// that many do not copy all of it for each.
template <class T>
Status extend(std::vector<T>& values, std::size_t size, const parallel::Context& context) {
  if (!values.empty()) {
    values.resize(size);
    return {};
  }
  auto all = parallel::slots<T>(size, context);
  if (!all) return all.error();
  values = std::move(*all);
  return {};
}

}  // namespace

void PolygonMaker::add_group(std::span<const std::uint32_t> triangles, Polygons& out) {
  if (loops_.find_outline(triangles)) {
    add_found(triangles[0], out);
    return;
  }
  for (const std::uint32_t t : triangles) {
    loops_.take_triangle(t);
    add_found(t, out);
  }
}

void PolygonMaker::add_wide(std::uint32_t t, Polygons& out) {
  NormalVector n = triangle_normal(seen_.part, t);
  Triangle i = seen_.part.triangles[t];
  const Int128 facing = seen_.viewer.facing(n, seen_.part.vertices[i[0]].as<std::int64_t>());
  if (facing == 0) return;
  if (facing < 0) {
    for (Int128& x : n) x = -x;
    std::swap(i[1], i[2]);
  }
  Polygon& p = start(i[0], out);
  p.wide = static_cast<std::int32_t>(out.wide_normals.size());
  p.edge_on = seen_.find_edge_on && may_be_edge_on(seen_.part, t, seen_.viewer.direction);
  out.wide_normals.push_back(n);
  add_corners(p, i, out);
}

bool PolygonMaker::make_outline(Polygon& outline, Polygons& out) {
  if (!loops_.find_contour()) return false;
  outline.part = part_index_;
  add_corners(outline, loops_.found(), out);
  return true;
}

Polygon& PolygonMaker::start(std::uint32_t vertex, Polygons& out) const {
  Polygon& p = out.polygons.emplace_back();
  p.at = seen_.part.vertices[vertex];
  p.part = part_index_;
  return p;
}

void PolygonMaker::add_found(std::uint32_t t, Polygons& out) {
  Polygon& p = start(loops_.found()[0], out);
  p.normal = seen_.towards_viewer(t);
  p.edge_on = seen_.planes[t].edge_on;
  add_corners(p, loops_.found(), out);
}

void PolygonMaker::add_corners(Polygon& p, std::span<const std::uint32_t> vertices,
                               Polygons& out) const {
  p.corners = static_cast<std::uint32_t>(vertices.size());
  if (seen_.viewer.eye) {
    p.first_corner = static_cast<std::uint32_t>(out.rays.size());
    for (const std::uint32_t v : vertices) out.rays.push_back(seen_.rays[v]);
    p.box = picture_->box_of(std::span(out.rays).last(vertices.size()));
    return;
  }
  p.first_corner = static_cast<std::uint32_t>(out.corners.size());
  for (const std::uint32_t v : vertices) {
    p.box.include(seen_.points[v]);
    out.corners.push_back({seen_.points[v].u, seen_.points[v].v});
  }
}

Status append(Polygons& all, std::span<const Polygons> runs, const parallel::Context& context) {
  struct Start {
    std::size_t polygon = 0, corner = 0, ray = 0;
  };
  std::vector<Start> starts;
  Start next{all.polygons.size(), all.corners.size(), all.rays.size()};
  for (const Polygons& run : runs) {
    starts.push_back(next);
    next.polygon += run.polygons.size();
    next.corner += run.corners.size();
    next.ray += run.rays.size();
  }
  if (const Status s = extend(all.polygons, next.polygon, context); !s) return s;
  if (const Status s = extend(all.corners, next.corner, context); !s) return s;
  if (const Status s = extend(all.rays, next.ray, context); !s) return s;
  return parallel::for_each(
      context, {.name = "hidden lines: polygons put together", .n = runs.size()},
      [&](std::size_t r) {
        const auto at = [](auto& values, std::size_t i) {
          return values.begin() + static_cast<std::ptrdiff_t>(i);
        };
        const std::size_t corner = runs[r].rays.empty() ? starts[r].corner : starts[r].ray;
        auto to = at(all.polygons, starts[r].polygon);
        for (Polygon p : runs[r].polygons) {
          p.first_corner += static_cast<std::uint32_t>(corner);
          *to++ = p;
        }
        std::ranges::copy(runs[r].corners, at(all.corners, starts[r].corner));
        std::ranges::copy(runs[r].rays, at(all.rays, starts[r].ray));
      });
}

}  // namespace strake::hlr
