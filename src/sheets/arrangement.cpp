// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace strake::sheets {

namespace {

using geometry::Vec3l;

/// Columns and rows of the sheet, the front view in the middle of them.
struct Cell {
  int column = 0, row = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};
constexpr int kLeast = -1, kMost = 2, kTracks = kMost - kLeast + 1;

/// Of all but the pictorial view.
Cell cell_of(Slot slot, Projection projection) {
  // In the first angle each view stands across from where one looks, in the third where one does.
  const int side = projection == Projection::first_angle ? 1 : -1;
  switch (slot) {
    case Slot::top:
      return {0, side};
    case Slot::bottom:
      return {0, -side};
    case Slot::left:
      return {side, 0};
    case Slot::right:
      return {-side, 0};
    case Slot::back:
      return {2, 0};
    case Slot::front:
    case Slot::iso:
    case Slot::none:
      break;
  }
  return {0, 0};
}

/// Extents along one direction of paper, of a column or a row.
struct Track {
  bool used = false, shared = false;
  double before = 0, after = 0;  ///< of the point that its views share, which may lie beside them
  double least = 0;              ///< for a view in its middle
  [[nodiscard]] double size() const { return std::max(before + after, least); }
};

class Grid {
 public:
  Grid(std::span<const ToPlace> views, Projection projection, Cell pictorial, double scale)
      : views_(views), scale_(scale) {
    for (const ToPlace& view : views) {
      const bool free = view.slot == Slot::iso;
      cells_.push_back(free ? pictorial : cell_of(view.slot, projection));
      const PaperBox box = view.at({0, 0}, scale);
      add(track(columns_, cells_.back().column), free, -box.left, box.right);
      add(track(rows_, cells_.back().row), free, -box.top, box.bottom);
    }
  }

  /// Where the common points fall if the tracks stand in `box`, with the room that is left spread
  /// between and beside them, or as near to the upper left corner as they can.
  [[nodiscard]] std::vector<PaperPoint> spread(const PaperBox& box, double gap, bool packed) const {
    const auto x = starts(columns_, box.left, box.width(), gap, packed);
    const auto y = starts(rows_, box.top, box.height(), gap, packed);
    std::vector<PaperPoint> at;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const Track& column = track(columns_, cells_[v].column);
      const Track& row = track(rows_, cells_[v].row);
      PaperPoint p{x[position(cells_[v].column)], y[position(cells_[v].row)]};
      if (views_[v].slot == Slot::iso) {
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

  [[nodiscard]] bool fits(const PaperBox& box, double gap) const {
    return needed(columns_, gap) <= box.width() && needed(rows_, gap) <= box.height();
  }

 private:
  using Tracks = std::array<Track, kTracks>;

  static std::size_t position(int cell) { return static_cast<std::size_t>(cell - kLeast); }
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

  static std::array<double, kTracks> starts(const Tracks& tracks, double from, double room,
                                            double gap, bool packed) {
    double count = 1;
    for (const Track& track : tracks) count += track.used ? 1 : 0;
    const double more = packed ? 0 : (room - needed(tracks, gap)) / count;
    std::array<double, kTracks> at{};
    double next = from + more;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      at[t] = next;
      if (tracks[t].used) next += tracks[t].size() + gap + more;
    }
    return at;
  }

  std::span<const ToPlace> views_;
  double scale_;
  std::vector<Cell> cells_;
  Tracks columns_{}, rows_{};
};

class Arranger {
 public:
  Arranger(std::span<const ToPlace> views, Projection projection, const Room& room, double gap)
      : views_(views), projection_(projection), room_(room), gap_(gap) {
    const bool pictorial = std::any_of(views.begin(), views.end(),
                                       [](const ToPlace& v) { return v.slot == Slot::iso; });
    cells_ = pictorial ? free_cells() : std::vector<Cell>{{0, 0}};
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

  [[nodiscard]] std::optional<Arranged> at_scale(double scale) const {
    for (const Cell& cell : cells_) {
      const Grid grid(views_, projection_, cell, scale);
      for (const bool packed : {false, true})
        for (const PaperBox& box : boxes_) {
          if (!grid.fits(box, gap_)) continue;
          Arranged found{scale, true, grid.spread(box, gap_, packed)};
          if (free_of(found)) return found;
        }
    }
    return std::nullopt;
  }

  /// For a scale at which they do not fit.
  [[nodiscard]] Arranged anyhow(double scale) const {
    return {scale, false,
            Grid(views_, projection_, cells_.front(), scale).spread(room_.area, gap_, false)};
  }

 private:
  /// Where the pictorial view may go, in the order in which draughtsmen would take them.
  [[nodiscard]] std::vector<Cell> free_cells() const {
    std::vector<Cell> cells;
    for (const Cell& cell :
         {Cell{1, 1}, Cell{1, -1}, Cell{-1, -1}, Cell{-1, 1}, Cell{1, 0}, Cell{0, 1}, Cell{0, -1},
          Cell{-1, 0}, Cell{2, 1}, Cell{2, -1}, Cell{2, 0}})
      if (std::none_of(views_.begin(), views_.end(), [&](const ToPlace& v) {
            return v.slot != Slot::iso && cell_of(v.slot, projection_) == cell;
          }))
        cells.push_back(cell);
    return cells;
  }

  [[nodiscard]] bool free_of(const Arranged& arranged) const {
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (!room_.takes(views_[v].at(arranged.at[v], arranged.scale))) return false;
    return true;
  }

  std::span<const ToPlace> views_;
  Projection projection_;
  const Room& room_;
  double gap_;
  std::vector<Cell> cells_;
  std::vector<PaperBox> boxes_;
};

}  // namespace

hlr::View view_in_slot(Slot slot, const hlr::View& front) {
  const Vec3l d = front.direction, u = front.up, r = cross(u, d);
  hlr::View view = front;
  switch (slot) {
    case Slot::top:
      view.direction = u;
      view.up = -d;
      break;
    case Slot::bottom:
      view.direction = -u;
      view.up = d;
      break;
    case Slot::left:
      view.direction = -r;
      break;
    case Slot::right:
      view.direction = r;
      break;
    case Slot::back:
      view.direction = -d;
      break;
    case Slot::iso:
      view.direction = r + d + u;
      break;
    case Slot::front:
    case Slot::none:
      break;
  }
  return view;
}

PaperBox ToPlace::at(const PaperPoint& at, double scale) const {
  PaperBox box{at.x + extent.left / scale, at.y - extent.top / scale, at.x + extent.right / scale,
               at.y - extent.bottom / scale};
  const double wider = std::max(0.0, least_width_mm - box.width()) / 2;
  box.left -= std::max(left_mm, wider);
  box.right += std::max(right_mm, wider);
  box.top -= top_mm;
  box.bottom += bottom_mm;
  return box;
}

bool Room::takes(const PaperBox& box) const {
  return area.holds(box) && std::none_of(keep_free.begin(), keep_free.end(),
                                         [&](const PaperBox& k) { return k.overlaps(box); });
}

Result<Arranged> arrange(std::span<const ToPlace> views, Projection projection, const Room& room,
                         double gap_mm, double scale) {
  const Arranger arranger(views, projection, room, gap_mm);
  if (scale > 0) {
    const auto found = arranger.at_scale(scale);
    return found ? *found : arranger.anyhow(scale);
  }
  for (const double usual : drawing::usual_scales())
    if (const auto found = arranger.at_scale(usual)) return *found;
  return Error{ErrorCode::input, "the views have no room on the sheet at any scale", "",
               "take a larger sheet, a smaller gap, shorter titles or fewer views"};
}

}  // namespace strake::sheets
