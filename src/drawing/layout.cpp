// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "drawing/account.hpp"
#include "drawing/duplicates.hpp"
#include "drawing/paper.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;

/// Curves as they lie on the sheet: of orthographic views, which alone have any.
PaperCurves curves_on_paper(const hlr::Curves& curves, const PaperAxes& axes,
                            const Placement& placement) {
  const ViewPlane plane(axes, placement.anchor);
  const double scale = placement.sheet.scale;
  const auto along = [&](const Vec3d& v) {
    return PaperPoint{dot(axes.right, v) / scale, -dot(axes.up, v) / scale};
  };
  PaperCurves result{{}, curves.edges};
  result.all.reserve(curves.all.size());
  for (const hlr::Curve& curve : curves.all) {
    const PlanePoint origin = plane(curve.origin);
    const PaperPoint centre = along(curve.at.centre);
    result.all.push_back({{placement.at.x + origin.x / scale + centre.x,
                           placement.at.y - origin.y / scale + centre.y},
                          along(curve.at.u),
                          along(curve.at.v)});
  }
  return result;
}

/// The middle of a box in the middle of the sheet.
Placement in_the_middle(const PlaneBox& box, const Sheet& sheet, const Vec3l& origin) {
  return {sheet,
          origin,
          {sheet.width_mm / 2 - (box.left + box.width() / 2) / sheet.scale,
           (sheet.height_mm - kTitleStrip) / 2 + (box.bottom + box.height() / 2) / sheet.scale}};
}

void add_vector(Hasher& hasher, const Vec3l& v) { hasher.add(v.x).add(v.y).add(v.z); }

Hash128 hash_of(const hlr::Drawing& drawing, const model::Model& model) {
  Hasher hasher;
  add_vector(hasher, drawing.view.direction);
  add_vector(hasher, drawing.view.up);
  if (drawing.view.limits) {
    add_vector(hasher, drawing.view.limits->lo);
    add_vector(hasher, drawing.view.limits->hi);
  }
  for (const hlr::Section& section : drawing.view.sections) {
    add_vector(hasher, section.normal);
    add_vector(hasher, section.point);
  }
  if (const auto& perspective = drawing.view.perspective) {
    add_vector(hasher, perspective->eye);
    add_vector(hasher, perspective->target);
    hasher.add(perspective->near_mm).add(perspective->field_of_view_deg);
  }
  hasher.add(static_cast<std::uint64_t>(drawing.pieces.size()));
  const hlr::Piece* last = nullptr;
  for (const hlr::Piece& piece : drawing.pieces) {
    if (last == nullptr || last->object != piece.object) {
      const model::Object& object = model.object(piece.object);
      hasher.add(std::string_view(model.files[object.file].label)).add(std::string_view(object.id));
    }
    hasher.add(static_cast<std::uint32_t>(piece.kind)).add(static_cast<std::uint32_t>(piece.state));
    if (piece.kind == hlr::EdgeKind::intersection)
      hasher.add(std::string_view(model.object(piece.other).id));
    add_vector(hasher, piece.a);
    add_vector(hasher, piece.b);
    last = &piece;
  }
  return hasher.value();
}

/// A line for each piece, or one for each of its stretches: what is covered is a duplicate.
template <class MakeLine>
Result<std::vector<Line>> make_lines(std::span<const hlr::Piece> pieces,
                                     std::span<const Stretch> stretches, const PaperAxes& axes,
                                     MakeLine&& make_line, const parallel::Context& context) {
  // The first stretch of each piece that has any: k such pieces before make so many lines fewer
  // than their stretches.
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < stretches.size(); ++i)
    if (i == 0 || stretches[i].line != stretches[i - 1].line) firsts.push_back(i);
  Result<std::vector<Line>> lines =
      parallel::detail::slots<Line>(pieces.size() + stretches.size() - firsts.size());
  if (!lines) return lines;
  constexpr std::size_t kPieces = 4096;
  const Status status = parallel::for_each(
      context, {.name = "lines on paper", .n = (pieces.size() + kPieces - 1) / kPieces},
      [&](std::size_t block) {
        const std::size_t begin = block * kPieces;
        const auto before =
            std::partition_point(firsts.begin(), firsts.end(),
                                 [&](std::size_t first) { return stretches[first].line < begin; });
        std::size_t next = before == firsts.end() ? stretches.size() : *before;
        std::size_t at = begin + next - static_cast<std::size_t>(before - firsts.begin());
        for (std::size_t i = begin; i < std::min(pieces.size(), begin + kPieces); ++i) {
          const Line line = make_line(pieces[i]);
          if (next == stretches.size() || stretches[next].line != i) (*lines)[at++] = line;
          for (; next < stretches.size() && stretches[next].line == i; ++next) {
            (*lines)[at] = part_of(line, axes, stretches[next].from, stretches[next].to);
            if (stretches[next].covered) (*lines)[at].state = LineState::duplicate;
            ++at;
          }
        }
      });
  if (!status) return status.error();
  return lines;
}

}  // namespace

std::uint32_t PaperCurves::index_of(const Line& line) const {
  const auto key = [](const auto& l) { return std::pair(model::index(l.object), l.edge); };
  const auto found = std::ranges::lower_bound(edges, key(line), {},
                                              [&](const hlr::CurvedEdge& e) { return key(e); });
  return found != edges.end() && key(*found) == key(line) ? found->curve : kNone;
}

const PaperCurve* PaperCurves::of(const Line& line) const {
  const std::uint32_t index = index_of(line);
  return index == kNone ? nullptr : &all[index];
}

PlaneBox plane_extent(const hlr::Drawing& drawing, const PaperAxes& axes, const Vec3l& origin) {
  constexpr double kBig = std::numeric_limits<double>::max();
  const ViewPlane plane(axes, origin);
  PlaneBox box{kBig, -kBig, kBig, -kBig};
  for (const hlr::Piece& piece : drawing.pieces) {
    if (piece.state == hlr::State::clipped) continue;
    for (const Vec3l& end : {piece.a, piece.b}) {
      const PlanePoint p = plane(end);
      box.left = std::min(box.left, p.x);
      box.right = std::max(box.right, p.x);
      box.bottom = std::min(box.bottom, p.y);
      box.top = std::max(box.top, p.y);
    }
  }
  return box.left <= box.right ? box : PlaneBox{};
}

Result<NeutralDrawing> lay_out(const hlr::Drawing& drawing, const model::Model& model,
                               const LayoutOptions& options, const parallel::Context& context) {
  const auto axes = paper_axes(drawing.view);
  if (!axes)
    return Error{ErrorCode::usage, "the upward direction is parallel to the view direction", "",
                 "give another --up"};
  if (options.scale && !(*options.scale > 0 && std::isfinite(*options.scale)))
    return Error{ErrorCode::usage, "the scale is not a positive number", "", "use 1:50, say"};
  const Placement placement = options.placement ? *options.placement : [&] {
    const PlaneBox box = plane_extent(drawing, *axes, drawing.origin);
    return in_the_middle(box, choose_sheet(box, options), drawing.origin);
  }();
  const ViewPlane plane(*axes, placement.anchor);
  const auto on_paper = [&](const Vec3l& grid) {
    const PlanePoint p = plane(grid);
    return PaperPoint{rounded_paper(placement.at.x + p.x / placement.sheet.scale),
                      rounded_paper(placement.at.y - p.y / placement.sheet.scale)};
  };
  NeutralDrawing out;
  out.sheet = placement.sheet;
  out.view_name = options.view_name;
  out.title = options.title.empty() ? options.view_name : options.title;
  out.view = drawing.view;
  out.stage = drawing.options.stage;
  out.hidden_lines = drawing.options.hidden;
  out.sharp_angle_deg = drawing.options.sharp_angle_deg;
  out.contact_distance_mm = drawing.contact_distance_mm;
  out.counters = drawing.counters;
  out.hash = hash_of(drawing, model);
  out.curves = curves_on_paper(drawing.curves, *axes, placement);
  // What the sources' precision cannot tell apart is one line; the grid's own rounding at least.
  const double distance = std::max(drawing.contact_distance_mm, 3 * geometry::kMmPerGrid);
  const auto stretches = options.remove_duplicates
                             ? find_duplicates(drawing, *axes, distance, context)
                             : Result<Stretches>(Stretches{});
  if (!stretches) return stretches.error();
  auto lines = make_lines(
      drawing.pieces, *stretches, *axes,
      [&](const hlr::Piece& piece) {
        return Line{piece.object,
                    piece.edge,
                    piece.kind,
                    line_state(piece.state),
                    piece.other,
                    geometry::to_mm(piece.a),
                    geometry::to_mm(piece.b),
                    on_paper(piece.a),
                    on_paper(piece.b)};
      },
      context);
  if (!lines) return lines.error();
  out.lines = std::move(*lines);
  out.account = drawing.account;
  if (const Status status = count_lines(out, context); !status) return status.error();
  return out;
}

}  // namespace strake::drawing
