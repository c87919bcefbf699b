// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/label_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "drawing/layout/view_plane.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

// Costs of a place are millimetres of leader: how much longer it may be to avoid this.
constexpr double kForeignViewMm = 40;  ///< a text within the box of another view
constexpr double kLaterAnchorMm = 3;   ///< an anchor that is not the first, each
constexpr double kLineStepMm = 0.1;    ///< half a square of lines under the leader

constexpr double kLatticeMm = 1.5;       ///< between two places
constexpr double kShortestLeaderMm = 5;  ///< so that the arrow leaves some of it

/// Units of work: whether a text covers something of the ground.
constexpr std::uint64_t kPlaceWork = 12;

/// Returns whether a leader may run so: rising enough for its landing to clear the object, and
/// neither upright, as lines of objects often are, nor nearly flat.
bool suits_leader(const PaperPoint& by) {
  const double x = std::abs(by.x), y = std::abs(by.y);
  return y >= 2 * kLatticeMm && y >= 0.2 * x && x >= 0.25 * y;
}

}  // namespace

LabelCandidates::LabelCandidates(std::span<const LabelRequest> requests, const LabelGround& ground,
                                 WorkLimit& work)
    : requests_(requests),
      ground_(ground),
      work_(work),
      object_offsets_(lattice(0, false)),
      leader_offsets_(lattice(kShortestLeaderMm, true)),
      on_object_(requests.size()),
      by_leader_(requests.size()) {}

/// Returns the points of a lattice about the origin, the nearest first; of equally near ones the
/// upper and right ones.
std::vector<LabelCandidates::Offset> LabelCandidates::lattice(double min_mm, bool for_leader) {
  std::vector<Offset> all;
  const int limit = static_cast<int>(kLabelReachMm / kLatticeMm);
  for (int row = -limit; row <= limit; ++row)
    for (int column = -limit; column <= limit; ++column) {
      const PaperPoint by{column * kLatticeMm, row * kLatticeMm};
      const double length = std::sqrt(by.x * by.x + by.y * by.y);
      if (length >= min_mm && length <= kLabelReachMm && (!for_leader || suits_leader(by)))
        all.push_back({by, length});
    }
  std::ranges::sort(all, {}, [](const Offset& o) { return std::tuple(o.length, o.by.y, -o.by.x); });
  return all;
}

bool LabelCandidates::extend_search(Label label, bool leader, double wanted) {
  const LabelRequest& request = requests_[label];
  if (!leader && !request.on_object) return false;
  Found& found = (leader ? by_leader_ : on_object_)[label];
  const std::size_t end =
      leader ? leader_offsets_.size() * request.anchors.size() : object_offsets_.size();
  while (found.next < end && !work_.used_up()) {
    if (offset_of(label, leader, found.next).length >= wanted) return false;
    const std::size_t number = found.next++;
    work_.spend(kPlaceWork);
    const LabelPlace place = place_of(label, leader, number);
    if (!covers_nothing(request, place)) continue;
    work_.spend(kCandidateWork);
    const std::size_t anchor = leader ? number % request.anchors.size() : 0;
    const double more =
        kLaterAnchorMm * static_cast<double>(anchor) + cost_of_view(request, place.box);
    found.all.push_back({static_cast<std::uint32_t>(number), {}, !leader, more});
    return true;
  }
  return false;
}

LabelPlace LabelCandidates::place_of(Label label, bool leader, std::size_t number) const {
  const LabelRequest& request = requests_[label];
  const Offset& offset = offset_of(label, leader, number);
  if (!leader) return on_object(request, offset);
  if (request.balloon)
    return balloon(request, request.anchors[number % request.anchors.size()], offset);
  return by_leader(request, request.anchors[number % request.anchors.size()], offset);
}

/// Returns the place without a leader that lies so from the middle of the object.
LabelPlace LabelCandidates::on_object(const LabelRequest& request, const Offset& offset) const {
  const PaperBox& object = request.object;
  const PaperPoint middle{(object.left + object.right) / 2 + offset.by.x,
                          (object.top + object.bottom) / 2 + offset.by.y};
  LabelPlace place;
  place.at = {rounded_paper(middle.x), rounded_paper(middle.y + request.height_mm / 2)};
  place.box = box_of(place.at, Align::middle, request.width_mm, request.height_mm);
  return place;
}

/// Returns the place whose leader runs so from its tip.
LabelPlace LabelCandidates::by_leader(const LabelRequest& request, const PaperPoint& tip,
                                      const Offset& offset) const {
  const bool right = offset.by.x > 0;
  const PaperPoint elbow{rounded_paper(tip.x + offset.by.x), rounded_paper(tip.y + offset.by.y)};
  LabelPlace place;
  place.at = {elbow.x, rounded_paper(elbow.y - kClearanceMm)};
  place.align = right ? Align::start : Align::end;
  place.box = box_of(place.at, place.align, request.width_mm, request.height_mm);
  place.box.bottom = std::max(place.box.bottom, elbow.y);
  place.has_leader = true;
  place.leader = {tip, elbow};
  place.end = {rounded_paper(elbow.x + (right ? request.width_mm : -request.width_mm)), elbow.y};
  return place;
}

/// Returns the place of a balloon whose centre lies so from the tip of its leader, which ends at
/// the rim.
LabelPlace LabelCandidates::balloon(const LabelRequest& request, const PaperPoint& tip,
                                    const Offset& offset) const {
  const double radius = request.height_mm / 2, rim = radius / offset.length;
  LabelPlace place;
  place.at = {rounded_paper(tip.x + offset.by.x), rounded_paper(tip.y + offset.by.y)};
  place.box = {place.at.x - radius, place.at.y - radius, place.at.x + radius, place.at.y + radius};
  place.has_leader = true;
  place.leader = {tip,
                  {rounded_paper(place.at.x - offset.by.x * rim),
                   rounded_paper(place.at.y - offset.by.y * rim)}};
  place.end = place.leader.b;
  return place;
}

bool LabelCandidates::covers_nothing(const LabelRequest& request, const LabelPlace& place) const {
  if (!place.has_leader) {
    const double y = place.at.y - request.height_mm / 2;
    if (!request.object.holds({place.at.x, y, place.at.x, y})) return false;
  }
  if (request.within && !request.within->holds(place.box)) return false;
  if (request.balloon) {
    const double x = place.leader.b.x - place.leader.a.x, y = place.leader.b.y - place.leader.a.y;
    if (x * x + y * y < kShortestLeaderMm * kShortestLeaderMm) return false;
  }
  return ground_.room.takes(widened(place.box, kClearanceMm)) &&
         ground_.occupied.is_free(place.box);
}

double LabelCandidates::cost_of_view(const LabelRequest& request, const PaperBox& box) const {
  for (std::size_t v = 0; v < ground_.views.size(); ++v)
    if (v != request.view && ground_.views[v].overlaps(box)) return kForeignViewMm;
  return 0;
}

/// Adds what the lines under its leader cost to a candidate, or closes it.
void LabelCandidates::walk(const LabelPlace& place, Candidate& candidate) {
  const OccupancyGrid::LeaderPath path =
      ground_.occupied.leader_path(place.leader.a, place.leader.b);
  work_.spend(path.steps);
  candidate.walked = true;
  candidate.more = path.open ? candidate.more + kLineStepMm * static_cast<double>(path.lines)
                             : std::numeric_limits<double>::infinity();
}

}  // namespace strake::sheets
