// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/visible_objects.hpp"

#include <algorithm>

#include "drawing/layout/view_plane.hpp"

namespace strake::sheets {

std::vector<VisibleObject> visible_objects(const drawing::Ink& ink,
                                           const std::vector<bool>& picked) {
  std::vector<VisibleObject> all;
  double longest = 0;
  for (const drawing::Line& line : ink.lines) {
    if (line.state != drawing::LineState::visible || !picked[model::index(line.object)]) continue;
    const PaperSegment segment{line.a_paper, line.b_paper};
    const double length = length_of(segment);
    if (!(length > 0)) continue;
    if (all.empty() || all.back().object != line.object) {
      all.push_back(
          {line.object, {}, {line.a_paper.x, line.a_paper.y, line.a_paper.x, line.a_paper.y}, 0});
      longest = 0;
    }
    VisibleObject& shown_object = all.back();
    shown_object.length += length;
    if (length > longest) {
      longest = length;
      shown_object.longest = segment;
    }
    for (const PaperPoint& p : {line.a_paper, line.b_paper}) {
      shown_object.box.left = std::min(shown_object.box.left, p.x);
      shown_object.box.right = std::max(shown_object.box.right, p.x);
      shown_object.box.top = std::min(shown_object.box.top, p.y);
      shown_object.box.bottom = std::max(shown_object.box.bottom, p.y);
    }
  }
  return all;
}

std::vector<PaperPoint> anchors_of(const PaperSegment& longest) {
  constexpr double kLongMm = 12;
  const double dx = longest.b.x - longest.a.x, dy = longest.b.y - longest.a.y;
  const auto at = [&](double t) {
    return PaperPoint{drawing::rounded_paper(longest.a.x + dx * t),
                      drawing::rounded_paper(longest.a.y + dy * t)};
  };
  if (dx * dx + dy * dy < kLongMm * kLongMm) return {at(0.5)};
  return {at(0.5), at(0.25), at(0.75)};
}

}  // namespace strake::sheets
