// SPDX-License-Identifier: Apache-2.0
#include "sheets/placing.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

#include "drawing/paper.hpp"
#include "sheets/grid.hpp"
#include "sheets/lettering.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;
using geometry::Vec3l;

class Placer {
 public:
  Placer(const Description& what, const Room& room)
      : what_(what), room_(room), places_(what.views.size()) {}

  /// Takes what finished views measure.
  Status measure(std::span<const hlr::Drawing> drawings, const parallel::Context& context) {
    // One for all that say none, so that they are aligned.
    Vec3l common;
    const auto some = std::find_if(drawings.begin(), drawings.end(), [](const hlr::Drawing& d) {
      return !d.pieces.empty() && !d.view.perspective;
    });
    if (some != drawings.end()) common = some->origin;
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const ViewWish& view = what_.views[v];
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

  /// To be done first, view by view.
  void take(std::size_t v, const drawing::PlaneBox& extent) {
    wanted_.push_back(to_place(v));
    wanted_.back().extent = extent;
  }

  Result<std::vector<ViewPlace>> run() {
    std::vector<std::size_t> arranged, own;
    for (std::size_t v = 0; v < what_.views.size(); ++v) {
      const bool free = what_.views[v].slot == Slot::none && what_.views[v].position.has_value();
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
  [[nodiscard]] ToPlace to_place(std::size_t v) const {
    const ViewWish& view = what_.views[v];
    ToPlace place;
    place.slot = view.slot;
    const GridRim rim = grid_rim(what_.grid, view);
    place.left_mm = std::max(rim.left_mm, rim.other_mm);
    place.top_mm = std::max(rim.top_mm, rim.other_mm);
    place.right_mm = place.bottom_mm = rim.other_mm;
    if (view.title.empty()) return place;
    const Lettering letters = lettering_of(what_);
    const bool scaled = view.scale && !view.view.perspective;
    place.bottom_mm +=
        letters.gap_mm + letters.title_mm + 2.5 + (scaled ? letters.scale_mm + 2 : 0);
    place.least_width_mm = text_width(view.title) * letters.title_mm + 4;
    return place;
  }

  Result<double> arrangement(const std::vector<std::size_t>& views) {
    std::vector<ToPlace> wanted;
    for (const std::size_t v : views) wanted.push_back(wanted_[v]);
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

  /// Where the anchor of a view falls that says where it lies.
  [[nodiscard]] PaperPoint at(std::size_t v, double scale) const {
    const ViewWish& view = what_.views[v];
    const drawing::PlaneBox& box = wanted_[v].extent;
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
    ToPlace lines = wanted_[v];
    place.whole = lines.at(at, scale);
    lines.left_mm = lines.right_mm = lines.top_mm = lines.bottom_mm = lines.least_width_mm = 0;
    place.lines = lines.at(at, scale);
  }

  /// The largest usual scale at which views that say where they lie cover nothing that is taken; or
  /// else at which none is larger than the room.
  [[nodiscard]] double scale_for(const std::vector<std::size_t>& views) const {
    double largest = drawing::usual_scales().back();
    for (auto scale = drawing::usual_scales().rbegin(); scale != drawing::usual_scales().rend();
         ++scale) {
      if (!sizes_fit(views, *scale)) break;
      largest = *scale;
    }
    for (const double scale : drawing::usual_scales())
      if (all_clear(views, scale)) return scale;
    return largest;
  }

  [[nodiscard]] bool sizes_fit(const std::vector<std::size_t>& views, double scale) const {
    return std::all_of(views.begin(), views.end(), [&](std::size_t v) {
      const PaperBox box = wanted_[v].at({0, 0}, scale);
      return box.width() <= room_.area.width() && box.height() <= room_.area.height();
    });
  }

  [[nodiscard]] bool all_clear(const std::vector<std::size_t>& views, double scale) const {
    std::vector<PaperBox> taken;
    for (const std::size_t v : views) {
      const double own = what_.views[v].scale.value_or(scale);
      const PaperBox box = wanted_[v].at(at(v, own), own);
      if (!room_.takes(box)) return false;
      for (const PaperBox& other : taken)
        if (other.overlaps(box)) return false;
      taken.push_back(box);
    }
    return true;
  }

  const Description& what_;
  const Room& room_;
  std::vector<ViewPlace> places_;
  std::vector<ToPlace> wanted_;
};

}  // namespace

Lettering lettering_of(const Description& what) {
  if (std::max(what.width_mm, what.height_mm) > 420) return {};
  return {3.5, 2.5, 3};
}

Result<std::vector<ViewPlace>> place_views(const Description& what,
                                           std::span<const hlr::Drawing> drawings, const Room& room,
                                           const parallel::Context& context) {
  Placer placer(what, room);
  if (const Status status = placer.measure(drawings, context); !status) return status.error();
  return placer.run();
}

std::vector<double> expected_scales(const Description& what,
                                    std::span<const drawing::PlaneBox> extents, const Room& room) {
  Placer placer(what, room);
  for (std::size_t v = 0; v < extents.size(); ++v) placer.take(v, extents[v]);
  const auto places = placer.run();
  std::vector<double> scales;
  if (places)
    for (const ViewPlace& place : *places) scales.push_back(place.scale);
  return scales;
}

double main_scale(const Description& what, std::span<const ViewPlace> places) {
  std::map<double, std::size_t> views;
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (what.views[v].slot != Slot::none) return places[v].scale;
    if (!what.views[v].view.perspective) ++views[places[v].scale];
  }
  double most = places.front().scale;
  for (const ViewPlace& place : places)
    if (views[place.scale] > views[most]) most = place.scale;
  return most;
}

}  // namespace strake::sheets
