// SPDX-License-Identifier: Apache-2.0
#include "sheets/place_notes.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "drawing/layout/view_plane.hpp"
#include "sheets/annotation/sheet_notes.hpp"
#include "sheets/spec/paper_segments.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

constexpr double kApartMm = 3;  ///< between notes

class NotePlanner {
 public:
  NotePlanner(const SheetSpec& what, SheetArea& room, Diagnostics& diagnostics)
      : what_(what), room_(room), diagnostics_(diagnostics), right_top_(room.area.top) {
    // The built-in title block comes first in what is kept free.
    if (what.frame && !what.artwork && !room.keep_free.empty()) block_ = room.keep_free.front();
  }

  void parts_list(const PartsListSpec& spec, PartsList list) {
    NoteTable& table = list.table;
    const double bottom = block_ ? block_->top : room_.area.bottom;
    const double top = spec.position ? spec.position->y : right_top_;
    table.fit(std::max(0.0, (spec.position ? what_.height_mm : bottom - kApartMm) - top));
    if (table.left_out > 0)
      diagnostics_.add(Severity::warning, "parts-list-no-room",
                       std::to_string(table.left_out) +
                           " rows are left out: there is no room for them (a larger sheet, or "
                           "fewer objects)",
                       spec.where);
    list.objects.resize(table.rows.size());
    notes_.listed.push_back(std::move(list.objects));
    const PaperBox size = sheets::extent_of(table);
    const PaperPoint at =
        spec.position.value_or(PaperPoint{room_.area.right - size.right, right_top_});
    if (!spec.position) right_top_ += size.bottom + kApartMm;
    place(std::move(table), at);
  }

  void revisions() {
    NoteTable table = revision_table(what_.revisions);
    const PaperBox size = sheets::extent_of(table);
    const double right = block_ ? block_->right : room_.area.right;
    const double bottom = block_ ? block_->top : room_.area.bottom;
    place(std::move(table), {right - size.right, bottom - size.bottom});
  }

  void north(const NorthSpec& spec) {
    notes_.north = spec.position.value_or(
        PaperPoint{room_.area.right - kNorthReachMm, right_top_ + kNorthReachMm});
    const auto [x, y] = *notes_.north;
    keep_free({x - kNorthReachMm, y - kNorthReachMm, x + kNorthReachMm, y + kNorthReachMm});
  }

  void scale_bar(const ScaleBarSpec& spec) {
    PaperPoint at =
        spec.position.value_or(PaperPoint{room_.area.left, room_.area.bottom - kScaleBarHeightMm});
    const auto box = [&] {
      return PaperBox{at.x, at.y, at.x + kScaleBarWidthMm, at.y + kScaleBarHeightMm};
    };
    // The title block of a narrow sheet is as wide as it is; what else is kept free is in the way
    // for all that the user knows.
    if (!spec.position && block_ && block_->overlaps(box()))
      at.y = block_->top - kScaleBarHeightMm - kApartMm;
    notes_.scale_bar = at;
    keep_free(box());
  }

  Notes take() { return std::move(notes_); }

 private:
  /// Keeps views off a note, and a little farther: lines that touch it would look like its own.
  void keep_free(const PaperBox& box) { room_.keep_free.push_back(widened(box, kApartMm)); }

  void place(NoteTable table, const PaperPoint& at) {
    const PaperPoint rounded{rounded_paper(at.x), rounded_paper(at.y)};
    keep_free(sheets::extent_of(table).moved(rounded.x, rounded.y));
    notes_.tables.emplace_back(std::move(table), rounded);
  }

  const SheetSpec& what_;
  SheetArea& room_;
  Diagnostics& diagnostics_;
  double right_top_;  ///< where the next note at the upper right begins
  std::optional<PaperBox> block_;
  Notes notes_;
};

/// Returns the view that north is shown of; null: none shows it.
const ViewSpec* view_of_north(const SheetSpec& what, const NorthSpec& north) {
  for (const ViewSpec& view : what.views)
    if ((north.view.empty() || north.view == view.name) &&
        shows_direction(view.view, north.direction))
      return &view;
  return nullptr;
}

}  // namespace

Notes plan_notes(const SheetSpec& what, const model::Model& model,
                 std::span<const std::vector<bool>> picks, SheetArea& room,
                 Diagnostics& diagnostics) {
  NotePlanner planner(what, room, diagnostics);
  for (std::size_t l = 0; l < what.parts_lists.size(); ++l)
    planner.parts_list(what.parts_lists[l], parts_list(what.parts_lists[l], picks[l], model));
  if (!what.revisions.empty()) planner.revisions();
  if (what.north) planner.north(*what.north);
  if (what.scale_bar) planner.scale_bar(*what.scale_bar);
  return planner.take();
}

void draw_notes(const Notes& notes, const SheetSpec& what, std::optional<double> scale,
                Sheet& sheet) {
  for (const auto& [table, at] : notes.tables) draw_table(table, at, sheet.notes);
  const auto warn = [&](std::string code, std::string message, const std::string& where) {
    sheet.diagnostics.add({Severity::warning, std::move(code), std::move(message), where});
  };
  if (notes.scale_bar && scale)
    draw_scale_bar(*notes.scale_bar, *scale, sheet.notes);
  else if (notes.scale_bar)
    warn("scale-bar-without-scale", "a sheet of views in perspective has no scale bar",
         what.scale_bar->where);
  if (!notes.north) return;
  if (const ViewSpec* const view = view_of_north(what, *what.north))
    draw_north(*notes.north, view->view, what.north->direction, sheet.notes);
  else
    warn("north-not-shown", "no view looks across the direction of north", what.north->where);
}

}  // namespace strake::sheets
