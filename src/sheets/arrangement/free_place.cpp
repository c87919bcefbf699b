// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement/free_place.hpp"

#include <algorithm>

namespace strake::sheets {

namespace {

/// The room that a box has along one direction of paper.
struct FreeSpan {
  double from, to;
  [[nodiscard]] double size() const { return to - from; }
  [[nodiscard]] double middle() const { return from / 2 + to / 2; }
};

class FreePlace {
 public:
  FreePlace(std::span<const PaperBox> others, const SheetArea& room, double gap)
      : area_(room.area), taken_(room.keep_free) {
    for (const PaperBox& other : others)
      taken_.push_back({other.left - gap, other.top - gap, other.right + gap, other.bottom + gap});
  }

  /// Tries the corners between all that is taken; of equally good places the first one counts.
  [[nodiscard]] std::optional<PaperBox> find(double width, double height) const {
    std::vector<double> lefts{area_.left, area_.right - width};
    std::vector<double> tops{area_.top, area_.bottom - height};
    for (const PaperBox& taken : taken_) {
      lefts.insert(lefts.end(), {taken.right, taken.left - width});
      tops.insert(tops.end(), {taken.bottom, taken.top - height});
    }
    std::optional<PaperBox> best;
    double largest = -1;
    for (const double top : tops)
      for (const double left : lefts) {
        PaperBox box{left, top, left + width, top + height};
        if (!is_free(box)) continue;
        const double spare = centre(box);
        if (spare <= largest) continue;
        largest = spare;
        best = box;
      }
    return best;
  }

 private:
  [[nodiscard]] bool is_free(const PaperBox& box) const {
    return area_.holds(box) &&
           std::ranges::none_of(taken_, [&](const PaperBox& t) { return t.overlaps(box); });
  }

  /// Moves a free box to the middle of the room that it has across, then up and down; returns the
  /// lesser of the two rooms that are left.
  [[nodiscard]] double centre(PaperBox& box) const {
    const FreeSpan across = room_across(box);
    const double width = box.width(), height = box.height();
    box = box.moved(across.middle() - (box.left / 2 + box.right / 2), 0);
    const FreeSpan upright = room_upright(box);
    box = box.moved(0, upright.middle() - (box.top / 2 + box.bottom / 2));
    return std::min(across.size() - width, upright.size() - height);
  }

  [[nodiscard]] FreeSpan room_across(const PaperBox& box) const {
    FreeSpan span{area_.left, area_.right};
    for (const PaperBox& t : taken_) {
      if (t.bottom <= box.top || box.bottom <= t.top) continue;
      if (t.right <= box.left)
        span.from = std::max(span.from, t.right);
      else
        span.to = std::min(span.to, t.left);
    }
    return span;
  }

  [[nodiscard]] FreeSpan room_upright(const PaperBox& box) const {
    FreeSpan span{area_.top, area_.bottom};
    for (const PaperBox& t : taken_) {
      if (t.right <= box.left || box.right <= t.left) continue;
      if (t.bottom <= box.top)
        span.from = std::max(span.from, t.bottom);
      else
        span.to = std::min(span.to, t.top);
    }
    return span;
  }

  PaperBox area_;
  std::vector<PaperBox> taken_;  ///< with the gap round views
};

}  // namespace

bool SheetArea::takes(const PaperBox& box) const {
  return area.holds(box) &&
         std::ranges::none_of(keep_free, [&](const PaperBox& k) { return k.overlaps(box); });
}

std::optional<PaperBox> free_place(double width_mm, double height_mm,
                                   std::span<const PaperBox> others, const SheetArea& room,
                                   double gap_mm) {
  return FreePlace(others, room, gap_mm).find(width_mm, height_mm);
}

}  // namespace strake::sheets
