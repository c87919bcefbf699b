// SPDX-License-Identifier: Apache-2.0
// Arranging projections in columns and rows, and placing all views of a sheet.
#include "sheets/arrangement/view_arrangement.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "sheets/arrangement/grid_lines.hpp"
#include "sheets/arrangement/view_margins.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using geometry::Vec3l;

/// A cell of the arrangement: its column and row, relative to the front view.
struct TrackCell {
  int column = 0, row = 0;
  friend bool operator==(const TrackCell&, const TrackCell&) = default;
};
constexpr int kMin = -1, kMax = 2, kTracks = kMax - kMin + 1;

/// Returns the cell of any view but the pictorial one.
TrackCell cell_of(ViewSlot slot, Projection projection) {
  // In first angle each view stands opposite to the side from which one looks, in third angle on
  // that side.
  const int side = projection == Projection::first_angle ? 1 : -1;
  switch (slot) {
    case ViewSlot::top:
      return {0, side};
    case ViewSlot::bottom:
      return {0, -side};
    case ViewSlot::left:
      return {side, 0};
    case ViewSlot::right:
      return {-side, 0};
    case ViewSlot::back:
      return {2, 0};
    case ViewSlot::front:
    case ViewSlot::iso:
    case ViewSlot::none:
      break;
  }
  return {0, 0};
}

/// The extents of a column or a row along one direction of paper.
struct Track {
  bool used = false, shared = false;
  double before = 0, after = 0;  ///< from the point that its views share, which may lie beside them
  double least = 0;              ///< the least size, for a view in its middle
  [[nodiscard]] double size() const { return std::max(before + after, least); }
};

/// How much of the remaining space is spread between columns and between rows: all is 1.
struct Spread {
  double columns = 1, rows = 1;
};

/// Returns the spreads to try in their order: from all to none, and evenly both ways first.
std::vector<Spread> spreads() {
  constexpr std::array kShares{1.0, 0.75, 0.5, 0.25, 0.0};
  std::vector<Spread> all;
  for (const double columns : kShares)
    for (const double rows : kShares) all.push_back({columns, rows});
  // Of equal ones that comes first which spreads the columns more.
  std::ranges::sort(all, std::ranges::greater{}, [](const Spread& s) {
    return std::tuple(s.columns + s.rows, std::min(s.columns, s.rows), s.columns);
  });
  return all;
}

class Grid {
 public:
  Grid(std::span<const UnplacedView> views, Projection projection, TrackCell pictorial,
       double scale)
      : views_(views), scale_(scale) {
    for (const UnplacedView& view : views) {
      const bool free = view.slot == ViewSlot::iso;
      cells_.push_back(free ? pictorial : cell_of(view.slot, projection));
      const PaperBox box = view.at({0, 0}, scale);
      add(track(columns_, cells_.back().column), free, -box.left, box.right);
      add(track(rows_, cells_.back().row), free, -box.top, box.bottom);
    }
  }

  /// Returns where the common points fall if the tracks stand in `box`, with so much of the
  /// remaining space spread between and beside them, and the rest at the right and below.
  [[nodiscard]] std::vector<PaperPoint> spread(const PaperBox& box, double gap,
                                               const Spread& spread) const {
    const auto x = starts(columns_, box.left, box.width(), gap, spread.columns);
    const auto y = starts(rows_, box.top, box.height(), gap, spread.rows);
    std::vector<PaperPoint> at;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const Track& column = track(columns_, cells_[v].column);
      const Track& row = track(rows_, cells_[v].row);
      PaperPoint p{x[position(cells_[v].column)], y[position(cells_[v].row)]};
      if (views_[v].slot == ViewSlot::iso) {
        const PaperBox own = views_[v].at({0, 0}, scale_);
        p.x += (column.size() - own.width()) / 2 - own.left;
        p.y += (row.size() - own.height()) / 2 - own.top;
      } else {
        p.x += (column.size() - column.before - column.after) / 2 + column.before;
        p.y += (row.size() - row.before - row.after) / 2 + row.before;
      }
      at.push_back({drawing::rounded_paper(p.x), drawing::rounded_paper(p.y)});
    }
    return at;
  }

  /// Returns how many millimetres spread() adds to each gap between columns and between rows.
  [[nodiscard]] Spread added(const PaperBox& box, double gap, const Spread& spread) const {
    return {more(columns_, box.width(), gap, spread.columns),
            more(rows_, box.height(), gap, spread.rows)};
  }

  [[nodiscard]] bool fits(const PaperBox& box, double gap) const {
    return needed(columns_, gap) <= box.width() && needed(rows_, gap) <= box.height();
  }

 private:
  using Tracks = std::array<Track, kTracks>;

  static std::size_t position(int cell) { return static_cast<std::size_t>(cell - kMin); }
  static Track& track(Tracks& tracks, int cell) { return tracks[position(cell)]; }
  static const Track& track(const Tracks& tracks, int cell) { return tracks[position(cell)]; }

  static void add(Track& track, bool free, double before, double after) {
    if (free) {
      track.least = std::max(track.least, before + after);
    } else {
      track.before = track.shared ? std::max(track.before, before) : before;
      track.after = track.shared ? std::max(track.after, after) : after;
      track.shared = true;
    }
    track.used = true;
  }

  static double needed(const Tracks& tracks, double gap) {
    double sum = -gap;
    for (const Track& track : tracks)
      if (track.used) sum += track.size() + gap;
    return sum;
  }

  static double more(const Tracks& tracks, double room, double gap, double share) {
    double count = 1;
    for (const Track& track : tracks) count += track.used ? 1 : 0;
    return share * (room - needed(tracks, gap)) / count;
  }

  static std::array<double, kTracks> starts(const Tracks& tracks, double from, double room,
                                            double gap, double share) {
    const double added = more(tracks, room, gap, share);
    std::array<double, kTracks> at{};
    double next = from + added;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      at[t] = next;
      if (tracks[t].used) next += tracks[t].size() + gap + added;
    }
    return at;
  }

  std::span<const UnplacedView> views_;
  double scale_;
  std::vector<TrackCell> cells_;
  Tracks columns_{}, rows_{};
};

/// The pictorial view leaves a cell that would leave more of the paper empty on one side.
constexpr double kMaxEmpty = 0.3;

class Arranger {
 public:
  Arranger(std::span<const UnplacedView> views, Projection projection, const SheetArea& room,
           double gap)
      : views_(views), projection_(projection), room_(room), gap_(gap) {
    for (std::size_t v = 0; v < views.size(); ++v)
      if (views[v].slot == ViewSlot::iso)
        pictorial_ = v;
      else
        others_.push_back(views[v]);
    cells_ = pictorial_ ? free_cells() : std::vector<TrackCell>{{0, 0}};
    boxes_.push_back(room.area);
    for (const PaperBox& taken : room.keep_free) {
      PaperBox above = room.area, beside = room.area, below = room.area;
      above.bottom = std::min(above.bottom, taken.top);
      beside.right = std::min(beside.right, taken.left);
      below.top = std::max(below.top, taken.bottom);
      for (const PaperBox& box : {above, beside, below})
        if (box.width() > 0 && box.height() > 0) boxes_.push_back(box);
    }
  }

  /// Returns the places in the first cell of the pictorial view that leaves no side of the paper
  /// empty, or else those that leave least; without any, with that view where it has room.
  [[nodiscard]] std::optional<Arranged> at_scale(double scale) const {
    std::optional<Arranged> best;
    double least = 0;
    for (const TrackCell& cell : cells_) {
      auto found = widest(views_, cell, scale, [&](const Arranged& a) { return a; });
      if (!found) continue;
      const double empty = empty_side(*found);
      if (!best || empty < least) {
        best = std::move(found);
        least = empty;
      }
      if (least <= kMaxEmpty) break;
    }
    if (best || !pictorial_) return best;
    return widest(others_, {}, scale, [&](const Arranged& a) { return with_pictorial(a); });
  }

  /// Places the views at a scale at which they do not fit.
  [[nodiscard]] Arranged anyhow(double scale) const {
    return {scale, false,
            Grid(views_, projection_, cells_.front(), scale).spread(room_.area, gap_, {})};
  }

 private:
  /// Returns what `complete` makes of those places of columns and rows that lie free and have the
  /// widest gaps, the lesser of the two first, and that lies free itself.
  template <class Complete>
  [[nodiscard]] std::optional<Arranged> widest(std::span<const UnplacedView> views,
                                               const TrackCell& pictorial, double scale,
                                               Complete&& complete) const {
    const Grid grid(views, projection_, pictorial, scale);
    std::optional<Arranged> best;
    std::pair maximum{-1.0, 0.0};
    for (const PaperBox& box : boxes_) {
      if (!grid.fits(box, gap_)) continue;
      for (const Spread& spread : spreads_) {
        const Spread added = grid.added(box, gap_, spread);
        const std::pair gaps{std::min(added.columns, added.rows), added.columns + added.rows};
        if (gaps <= maximum) continue;
        const Arranged placed{scale, true, grid.spread(box, gap_, spread)};
        if (!lie_free(views, placed)) continue;
        std::optional<Arranged> whole = complete(placed);
        if (!whole || !lie_free(views_, *whole)) continue;
        maximum = gaps;
        best = std::move(whole);
      }
    }
    return best;
  }

  /// Returns how much wider the right margin is than the left one, or the lower one than the upper
  /// one, as a share of the area.
  [[nodiscard]] double empty_side(const Arranged& arranged) const {
    const PaperBox& area = room_.area;
    PaperBox all = views_.front().at(arranged.at.front(), arranged.scale);
    for (std::size_t v = 1; v < views_.size(); ++v) {
      const PaperBox box = views_[v].at(arranged.at[v], arranged.scale);
      all = {std::min(all.left, box.left), std::min(all.top, box.top),
             std::max(all.right, box.right), std::max(all.bottom, box.bottom)};
    }
    return std::max((area.right - all.right - (all.left - area.left)) / area.width(),
                    (area.bottom - all.bottom - (all.top - area.top)) / area.height());
  }

  /// Returns the other views with the pictorial one where it has room beside them.
  [[nodiscard]] std::optional<Arranged> with_pictorial(const Arranged& others) const {
    std::vector<PaperBox> boxes;
    for (std::size_t v = 0; v < others_.size(); ++v)
      boxes.push_back(others_[v].at(others.at[v], others.scale));
    const PaperBox own = views_[*pictorial_].at({0, 0}, others.scale);
    const auto place = free_place(own.width(), own.height(), boxes, room_, gap_);
    if (!place) return std::nullopt;
    Arranged all = others;
    all.at.insert(all.at.begin() + static_cast<std::ptrdiff_t>(*pictorial_),
                  {drawing::rounded_paper(place->left - own.left),
                   drawing::rounded_paper(place->top - own.top)});
    return all;
  }

  /// Returns the cells for the pictorial view, in the order in which draughtsmen would take them.
  [[nodiscard]] std::vector<TrackCell> free_cells() const {
    std::vector<TrackCell> cells;
    for (const TrackCell& cell :
         {TrackCell{1, 1}, TrackCell{1, -1}, TrackCell{-1, -1}, TrackCell{-1, 1}, TrackCell{1, 0},
          TrackCell{0, 1}, TrackCell{0, -1}, TrackCell{-1, 0}, TrackCell{2, 1}, TrackCell{2, -1},
          TrackCell{2, 0}})
      if (std::none_of(views_.begin(), views_.end(), [&](const UnplacedView& v) {
            return v.slot != ViewSlot::iso && cell_of(v.slot, projection_) == cell;
          }))
        cells.push_back(cell);
    return cells;
  }

  [[nodiscard]] bool lie_free(std::span<const UnplacedView> views, const Arranged& arranged) const {
    for (std::size_t v = 0; v < views.size(); ++v)
      if (!room_.takes(views[v].at(arranged.at[v], arranged.scale))) return false;
    return true;
  }

  std::span<const UnplacedView> views_;
  Projection projection_;
  const SheetArea& room_;
  double gap_;
  std::vector<UnplacedView> others_;      ///< all but the pictorial one
  std::optional<std::size_t> pictorial_;  ///< which view it is
  std::vector<Spread> spreads_ = spreads();
  std::vector<TrackCell> cells_;
  std::vector<PaperBox> boxes_;
};

}  // namespace

hlr::View view_in_slot(ViewSlot slot, const hlr::View& front) {
  const Vec3l d = front.direction, u = front.up, r = cross(u, d);
  hlr::View view = front;
  switch (slot) {
    case ViewSlot::top:
      view.direction = u;
      view.up = -d;
      break;
    case ViewSlot::bottom:
      view.direction = -u;
      view.up = d;
      break;
    case ViewSlot::left:
      view.direction = -r;
      break;
    case ViewSlot::right:
      view.direction = r;
      break;
    case ViewSlot::back:
      view.direction = -d;
      break;
    case ViewSlot::iso:
      view.direction = r + d + u;
      break;
    case ViewSlot::front:
    case ViewSlot::none:
      break;
  }
  return view;
}

PaperBox UnplacedView::at(const PaperPoint& at, double scale) const {
  PaperBox box{at.x + extent.left / scale, at.y - extent.top / scale, at.x + extent.right / scale,
               at.y - extent.bottom / scale};
  const double wider = std::max(0.0, min_width_mm - box.width()) / 2;
  box.left -= std::max(left_mm, wider);
  box.right += std::max(right_mm, wider);
  box.top -= top_mm;
  box.bottom += bottom_mm;
  return box;
}

Result<Arranged> arrange(std::span<const UnplacedView> views, Projection projection,
                         const SheetArea& room, double gap_mm, double scale) {
  const Arranger arranger(views, projection, room, gap_mm);
  if (scale > 0) {
    const auto found = arranger.at_scale(scale);
    return found ? *found : arranger.anyhow(scale);
  }
  for (const double usual : drawing::usual_scales()) {
    const auto found = arranger.at_scale(usual);
    if (!found) continue;
    const auto between = drawing::intermediate_scale(usual);
    const auto larger = between ? arranger.at_scale(*between) : std::nullopt;
    return larger ? *larger : *found;
  }
  return Error{ErrorCode::input, "the views have no room on the sheet at any scale", "",
               "take a larger sheet, a smaller gap, shorter titles or fewer views"};
}

namespace {

using drawing::rounded_paper;

class Placer {
 public:
  Placer(const SheetSpec& what, const SheetArea& room)
      : what_(what), room_(room), places_(what.views.size()) {}

  /// Takes the extents of finished views.
  Status measure(std::span<const hlr::Drawing> drawings, const parallel::Context& context) {
    // One anchor for all views that have none, so that they are aligned.
    Vec3l common;
    const auto some = std::find_if(drawings.begin(), drawings.end(), [](const hlr::Drawing& d) {
      const bool has_lines =
          !d.pieces.empty() || std::ranges::any_of(d.clipped_left_out, std::identity());
      return has_lines && !d.view.perspective;
    });
    if (some != drawings.end()) common = some->origin;
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const ViewSpec& view = what_.views[v];
      const Vec3l own = view.view.perspective ? view.view.perspective->target : common;
      places_[v].anchor = view.anchor.value_or(own);
      drawing::PlaneBox measured;
      if (const auto axes = drawing::paper_axes(what_.views[v].view)) {
        const auto extent = drawing::plane_extent(drawings[v], *axes, places_[v].anchor, context);
        if (!extent) return extent.error();
        measured = *extent;
      }
      take(v, measured);
    }
    return {};
  }

  /// Takes the extent of a view: to be called first, view by view.
  void take(std::size_t v, const drawing::PlaneBox& extent) {
    requested_.push_back(to_place(v));
    requested_.back().extent = extent;
  }

  Result<std::vector<ViewPlace>> run() {
    std::vector<std::size_t> arranged, own;
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const bool free =
          what_.views[v].slot == ViewSlot::none && what_.views[v].position.has_value();
      (free ? own : arranged).push_back(v);
    }
    std::optional<double> common = what_.scale;
    if (!arranged.empty()) {
      const Result<double> scale = arrangement(arranged);
      if (!scale) return scale.error();
      common = *scale;
    }
    const double scale = common ? *common : scale_for(own);
    for (const std::size_t v : own) put(v, what_.views[v].scale.value_or(scale));
    return std::move(places_);
  }

 private:
  [[nodiscard]] UnplacedView to_place(std::size_t v) const {
    const ViewSpec& view = what_.views[v];
    UnplacedView place;
    place.slot = view.slot;
    const ViewMargins rim = margins_of(what_, view);
    place.left_mm = rim.left_mm;
    place.top_mm = rim.top_mm;
    place.right_mm = rim.right_mm;
    place.bottom_mm = rim.bottom_mm;
    if (view.title.empty()) return place;
    const Lettering letters = lettering_of(what_);
    const bool scaled = view.scale && !view.view.perspective;
    place.bottom_mm +=
        letters.gap_mm + letters.title_mm + 2.5 + (scaled ? letters.scale_mm + 2 : 0);
    place.min_width_mm = text_width(view.title) * letters.title_mm + 4;
    return place;
  }

  Result<double> arrangement(const std::vector<std::size_t>& views) {
    std::vector<UnplacedView> wanted;
    for (const std::size_t v : views) wanted.push_back(requested_[v]);
    const double given = what_.views[views.front()].scale.value_or(what_.scale.value_or(0));
    const auto arranged = arrange(wanted, what_.projection, room_, what_.gap_mm, given);
    if (!arranged) {
      Error error = arranged.error();
      error.where = what_.file;
      return error;
    }
    for (std::size_t k = 0; k < views.size(); ++k)
      settle(views[k], arranged->scale, arranged->at[k]);
    return arranged->scale;
  }

  /// Returns where the anchor of a view with a position falls.
  [[nodiscard]] PaperPoint at(std::size_t v, double scale) const {
    const ViewSpec& view = what_.views[v];
    const drawing::PlaneBox& box = requested_[v].extent;
    PaperPoint p = *view.position;
    if (!view.anchor) {
      p.x -= (box.left + box.right) / 2 / scale;
      p.y += (box.bottom + box.top) / 2 / scale;
    }
    return {rounded_paper(p.x), rounded_paper(p.y)};
  }

  void put(std::size_t v, double scale) { settle(v, scale, at(v, scale)); }

  void settle(std::size_t v, double scale, const PaperPoint& at) {
    ViewPlace& place = places_[v];
    place.scale = scale;
    place.at = at;
    UnplacedView lines = requested_[v];
    place.whole = lines.at(at, scale);
    lines.left_mm = lines.right_mm = lines.top_mm = lines.bottom_mm = lines.min_width_mm = 0;
    place.lines = lines.at(at, scale);
  }

  /// Returns the largest usual scale at which views with a position cover nothing that is taken, or
  /// the intermediate one above it; or else the largest at which none is larger than the area.
  [[nodiscard]] double scale_for(const std::vector<std::size_t>& views) const {
    double largest = drawing::usual_scales().back();
    for (auto scale = drawing::usual_scales().rbegin(); scale != drawing::usual_scales().rend();
         ++scale) {
      if (!sizes_fit(views, *scale)) break;
      largest = *scale;
    }
    for (const double scale : drawing::usual_scales()) {
      if (!all_clear(views, scale)) continue;
      const auto between = drawing::intermediate_scale(scale);
      return between && all_clear(views, *between) ? *between : scale;
    }
    return largest;
  }

  [[nodiscard]] bool sizes_fit(const std::vector<std::size_t>& views, double scale) const {
    return std::all_of(views.begin(), views.end(), [&](std::size_t v) {
      const PaperBox box = requested_[v].at({0, 0}, scale);
      return box.width() <= room_.area.width() && box.height() <= room_.area.height();
    });
  }

  [[nodiscard]] bool all_clear(const std::vector<std::size_t>& views, double scale) const {
    std::vector<PaperBox> taken;
    for (const std::size_t v : views) {
      const double own = what_.views[v].scale.value_or(scale);
      const PaperBox box = requested_[v].at(at(v, own), own);
      if (!room_.takes(box)) return false;
      for (const PaperBox& other : taken)
        if (other.overlaps(box)) return false;
      taken.push_back(box);
    }
    return true;
  }

  const SheetSpec& what_;
  const SheetArea& room_;
  std::vector<ViewPlace> places_;
  std::vector<UnplacedView> requested_;
};

}  // namespace

Lettering lettering_of(const SheetSpec& what) {
  if (std::max(what.width_mm, what.height_mm) > 420) return {};
  return {3.5, 2.5, 3};
}

Result<std::vector<ViewPlace>> place_views(const SheetSpec& what,
                                           std::span<const hlr::Drawing> drawings,
                                           const SheetArea& room,
                                           const parallel::Context& context) {
  Placer placer(what, room);
  if (const Status status = placer.measure(drawings, context); !status) return status.error();
  return placer.run();
}

std::vector<double> expected_scales(const SheetSpec& what,
                                    std::span<const drawing::PlaneBox> extents,
                                    const SheetArea& room) {
  Placer placer(what, room);
  for (std::size_t v = 0; v < extents.size(); ++v) placer.take(v, extents[v]);
  const auto places = placer.run();
  std::vector<double> scales;
  if (places)
    for (const ViewPlace& place : *places) scales.push_back(place.scale);
  return scales;
}

std::optional<double> main_scale(const SheetSpec& what, std::span<const ViewPlace> places) {
  std::map<double, std::size_t> views;
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (what.views[v].slot != ViewSlot::none) return places[v].scale;
    if (!what.views[v].view.perspective) ++views[places[v].scale];
  }
  std::optional<double> maximum;
  for (std::size_t v = 0; v < places.size(); ++v)
    if (!what.views[v].view.perspective && (!maximum || views[places[v].scale] > views[*maximum]))
      maximum = places[v].scale;
  return maximum;
}

}  // namespace strake::sheets
