// SPDX-License-Identifier: Apache-2.0
// lay_out(), and its parts: the hash of a view, the counts of its lines, lines and curves on the
// sheet.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drawing/layout/duplicates.hpp"
#include "drawing/layout/placement.hpp"
#include "drawing/layout/view_plane.hpp"
#include "drawing/layout/view_title.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {
namespace {

/// Returns texts whose order says nothing so that equal ones are written alike.
std::vector<std::string> in_order_once(std::vector<std::string> texts) {
  std::ranges::sort(texts);
  const auto rest = std::ranges::unique(texts);
  texts.erase(rest.begin(), rest.end());
  return texts;
}

void add_vector(Hasher& hasher, const geometry::Vec3l& v) { hasher.add(v.x).add(v.y).add(v.z); }

void add_view(Hasher& hasher, const hlr::View& view) {
  add_vector(hasher, view.direction);
  add_vector(hasher, view.up);
  hasher.add(static_cast<std::uint64_t>(view.limits ? 1 : 0));
  if (view.limits) {
    add_vector(hasher, view.limits->lo);
    add_vector(hasher, view.limits->hi);
  }
  hasher.add(static_cast<std::uint64_t>(view.sections.size()));
  for (const hlr::Section& section : view.sections) {
    add_vector(hasher, section.normal);
    add_vector(hasher, section.point);
  }
  if (const auto& perspective = view.perspective) {
    add_vector(hasher, perspective->eye);
    add_vector(hasher, perspective->target);
    hasher.add(perspective->near_mm).add(perspective->field_of_view_deg);
  }
}

Hash128 hash_of_run(std::span<const hlr::EdgePiece> pieces, const model::Model& model) {
  Hasher hasher;
  const hlr::EdgePiece* last = nullptr;
  for (const hlr::EdgePiece& piece : pieces) {
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

/// Returns the hash of the view and of every piece in the model. It does not depend on the team.
/// Errors: cancelled, out of memory.
Result<Hash128> hash_of(const hlr::Drawing& drawing, const model::Model& model,
                        const parallel::Context& context) {
  // Hashed run by run, in parallel; the length of a run changes the hash.
  constexpr std::size_t kRun = 65536;
  const std::span<const hlr::EdgePiece> pieces = drawing.pieces;
  const auto runs = parallel::transform(
      context, {.name = "hash of pieces", .n = (pieces.size() + kRun - 1) / kRun},
      [&](std::size_t run) {
        const std::size_t begin = run * kRun;
        return hash_of_run(pieces.subspan(begin, std::min(kRun, pieces.size() - begin)), model);
      });
  if (!runs) return runs.error();
  Hasher hasher;
  add_view(hasher, drawing.view);
  hasher.add(static_cast<std::uint64_t>(pieces.size()));
  for (const Hash128& run : *runs) hasher.add(run.high).add(run.low);
  return hasher.value();
}

/// The counts of a run of lines, which are sorted by object.
struct Tally {
  std::array<std::uint64_t, kLineStates> count{};
  std::vector<model::ObjectId> visible_objects;  ///< objects with visible lines, each once in a row
};

/// Counts the lines of a drawing by state, and makes drawn objects without visible lines on paper
/// coincident. Errors: cancelled.
Status count_lines(NeutralDrawing& drawing, const parallel::Context& context) {
  const auto add_visible = [](Tally& tally, model::ObjectId object) {
    if (tally.visible_objects.empty() || tally.visible_objects.back() != object)
      tally.visible_objects.push_back(object);
  };
  const Result<Tally> tally = parallel::reduce(
      context, {.name = "account of lines", .n = drawing.lines.size(), .grain = 65536}, Tally{},
      [&](Tally& partial, std::size_t i) {
        const Line& line = drawing.lines[i];
        ++partial.count[static_cast<std::size_t>(line.state)];
        if (line.state == LineState::visible) add_visible(partial, line.object);
      },
      [&](Tally& into, const Tally& partial) {
        for (std::size_t s = 0; s < kLineStates; ++s) into.count[s] += partial.count[s];
        for (const model::ObjectId object : partial.visible_objects) add_visible(into, object);
      });
  if (!tally) return tally.error();
  for (std::size_t s = 0; s < kLineStates; ++s) drawing.count[s] += tally->count[s];

  hlr::Account& account = drawing.account;
  auto visible_objects = tally->visible_objects.begin();
  for (std::uint32_t object = 0; object < account.fates.size(); ++object) {
    const bool on_paper =
        visible_objects != tally->visible_objects.end() && model::index(*visible_objects) == object;
    if (on_paper) ++visible_objects;
    if (account.fates[object] != hlr::Fate::drawn || on_paper) continue;
    account.fates[object] = hlr::Fate::coincident;
    --account.count[static_cast<std::size_t>(hlr::Fate::drawn)];
    ++account.count[static_cast<std::size_t>(hlr::Fate::coincident)];
  }
  return {};
}

using geometry::Vec3d;
using geometry::Vec3l;

/// Returns the curves on the sheet. Only orthographic views have any.
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

/// Makes a line for each piece, or one for each of its intervals if it has any: covered ones are
/// duplicates.
template <class MakeLine>
Result<std::vector<Line>> make_lines(std::span<const hlr::EdgePiece> pieces,
                                     const LineOverlaps& overlaps, const PaperAxes& axes,
                                     MakeLine&& make_line, const parallel::Context& context) {
  const std::span<const LineInterval> cut_intervals = overlaps.cut_intervals;
  // The first interval of each piece that has any: behind k such pieces there are k lines fewer
  // than pieces and intervals.
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < cut_intervals.size(); ++i)
    if (i == 0 || cut_intervals[i].line != cut_intervals[i - 1].line) firsts.push_back(i);
  Result<std::vector<Line>> lines =
      parallel::slots<Line>(pieces.size() + cut_intervals.size() - firsts.size(), context);
  if (!lines) return lines;
  // Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
  constexpr std::size_t kPieces = 4096;
  const Status status = parallel::for_each(
      context, {.name = "lines on paper", .n = (pieces.size() + kPieces - 1) / kPieces},
      [&](std::size_t block) {
        const std::size_t begin = block * kPieces;
        const auto before = std::partition_point(
            firsts.begin(), firsts.end(),
            [&](std::size_t first) { return cut_intervals[first].line < begin; });
        std::size_t next = before == firsts.end() ? cut_intervals.size() : *before;
        std::size_t at = begin + next - static_cast<std::size_t>(before - firsts.begin());
        for (std::size_t i = begin; i < std::min(pieces.size(), begin + kPieces); ++i) {
          Line line = make_line(pieces[i]);
          if (overlaps.fully_covered.size() > 0 && overlaps.fully_covered.is_set(i))
            line.state = LineState::duplicate;
          if (next == cut_intervals.size() || cut_intervals[next].line != i) (*lines)[at++] = line;
          for (; next < cut_intervals.size() && cut_intervals[next].line == i; ++next) {
            (*lines)[at] = part_of(line, axes, cut_intervals[next].from, cut_intervals[next].to);
            if (cut_intervals[next].covered) (*lines)[at].state = LineState::duplicate;
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

Result<PlaneBox> plane_extent(const hlr::Drawing& drawing, const PaperAxes& axes,
                              const Vec3l& origin, const parallel::Context& context) {
  const ViewPlane plane(axes, origin);
  Result<PlaneBox> box = parallel::reduce(
      context, {.name = "extent on the plane", .n = drawing.pieces.size(), .grain = 65536},
      kNoPlaneBox,
      [&](PlaneBox& part, std::size_t i) {
        const hlr::EdgePiece& piece = drawing.pieces[i];
        if (piece.state == hlr::State::clipped) return;
        for (const Vec3l& end : {piece.a, piece.b}) {
          const PlanePoint p = plane(end);
          part.include({p.x, p.x, p.y, p.y});
        }
      },
      [](PlaneBox& into, const PlaneBox& part) { into.include(part); });
  if (box && box->left > box->right) *box = {};
  return box;
}

Result<NeutralDrawing> lay_out(const hlr::Drawing& drawing, const model::Model& model,
                               const LayoutOptions& options, const parallel::Context& context) {
  const auto axes = paper_axes(drawing.view);
  if (!axes)
    return Error{ErrorCode::usage, "the upward direction is parallel to the view direction", "",
                 "give another --up"};
  if (const Status status = check_scale(options); !status) return status.error();
  Placement placement;
  if (options.placement) {
    placement = *options.placement;
  } else {
    const Result<PlaneBox> box = plane_extent(drawing, *axes, drawing.origin, context);
    if (!box) return box.error();
    Result<Placement> chosen = choose_placement(*box, drawing.origin, options);
    if (!chosen) return chosen.error();
    placement = std::move(*chosen);
  }
  const PaperPlane on_paper(*axes, placement);
  NeutralDrawing out;
  out.sheet = placement.sheet;
  out.view_name = options.view_name;
  out.title = options.title.empty() ? title_of(options.view_name, drawing.view) : options.title;
  out.view = drawing.view;
  out.stage = drawing.options.stage;
  out.hidden_lines = drawing.options.hidden;
  out.sharp_angle_deg = drawing.options.sharp_angle_deg;
  out.smooth = drawing.options.smooth;
  out.intersections = drawing.options.intersections;
  out.own_polylines = drawing.options.own_polylines;
  out.flush_seams = drawing.options.flush_seams;
  out.uncut = !drawing.options.uncut.empty();
  if (out.uncut) out.uncut_selections = in_order_once(options.uncut_selections);
  out.single_line_mm = options.single_line_mm;
  out.contact_distance_mm = drawing.contact_distance_mm;
  out.sag_mm = drawing.sag_mm;
  out.weld_mm = drawing.weld_mm;
  out.counters = drawing.counters;
  out.far_left_out = options.far_left_out;
  const Result<Hash128> hash = hash_of(drawing, model, context);
  if (!hash) return hash.error();
  out.hash = *hash;
  out.curves = curves_on_paper(drawing.curves, *axes, placement);
  // Lines that the sources' precision, or at least the grid's rounding, cannot separate are one.
  const double distance = std::max(drawing.contact_distance_mm, 3 * geometry::kMmPerGrid);
  const auto duplicates = options.remove_duplicates
                              ? find_duplicates(drawing, *axes, distance, context)
                              : Result<LineOverlaps>(LineOverlaps{});
  if (!duplicates) return duplicates.error();
  auto lines = make_lines(
      drawing.pieces, *duplicates, *axes,
      [&](const hlr::EdgePiece& piece) {
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
  out.frame = frame_of(out, placement);
  out.account = drawing.account;
  out.count[static_cast<std::size_t>(LineState::clipped)] = std::accumulate(
      drawing.clipped_left_out.begin(), drawing.clipped_left_out.end(), std::uint64_t{0});
  if (const Status status = count_lines(out, context); !status) return status.error();
  return out;
}

}  // namespace strake::drawing
