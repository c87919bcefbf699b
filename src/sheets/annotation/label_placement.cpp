// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/label_placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;
using Label = PlacedLabels::Label;
using Conflicts = PlacedLabels::Conflicts;

// Costs of a place are millimetres of leader: how much longer it may be to avoid this.
constexpr double kCrossingMm = 40;     ///< a leader that is crossed
constexpr double kForeignViewMm = 40;  ///< a text within the box of another view
constexpr double kLaterAnchorMm = 3;   ///< an anchor that is not the first, each
constexpr double kLineStepMm = 0.1;    ///< half a square of lines under the leader

constexpr double kLatticeMm = 1.5;       ///< between two places
constexpr double kShortestLeaderMm = 5;  ///< so that the arrow leaves some of it
/// Places tried for all labels together at first, and again by each step that mends: a second or
/// so, on sheets that nobody could read.
constexpr std::size_t kMostTried = 20'000'000;
constexpr std::size_t kFewestPlaces = 64;  ///< that each label may try even so
constexpr std::size_t kMostEvictions = 8;
constexpr int kMostRounds = 8;

struct Offset {
  PaperPoint by;
  double length = 0;
};

/// Returns whether a leader may run so: rising enough for its landing to clear the object, and
/// neither upright, as lines of objects often are, nor nearly flat.
bool suits_leader(const PaperPoint& by) {
  const double x = std::abs(by.x), y = std::abs(by.y);
  return y >= 2 * kLatticeMm && y >= 0.2 * x && x >= 0.25 * y;
}

/// Returns the points of a lattice about the origin, the nearest first; of equally near ones the
/// upper and right ones.
std::vector<Offset> lattice(double least_mm, bool for_leader) {
  std::vector<Offset> all;
  const int most = static_cast<int>(kLabelReachMm / kLatticeMm);
  for (int row = -most; row <= most; ++row)
    for (int column = -most; column <= most; ++column) {
      const PaperPoint by{column * kLatticeMm, row * kLatticeMm};
      const double length = std::sqrt(by.x * by.x + by.y * by.y);
      if (length >= least_mm && length <= kLabelReachMm && (!for_leader || suits_leader(by)))
        all.push_back({by, length});
    }
  std::ranges::sort(all, {}, [](const Offset& o) { return std::tuple(o.length, o.by.y, -o.by.x); });
  return all;
}

class LabelPlacer {
 public:
  LabelPlacer(std::span<const LabelRequest> requests, const LabelGround& ground)
      : requests_(requests),
        ground_(ground),
        on_object_(lattice(0, false)),
        by_leader_(lattice(kShortestLeaderMm, true)),
        most_tried_(
            std::max(kFewestPlaces, kMostTried / std::max<std::size_t>(1, requests.size()))),
        placed_(ground.width_mm, ground.height_mm, requests.size()),
        places_(requests.size()) {}

  std::vector<std::optional<LabelPlace>> run() && {
    for (Label label = 0; label < places_.size(); ++label) settle(label, cheapest(label));
    make_room();
    untangle();
    return std::move(places_);
  }

 private:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  void settle(Label label, const std::optional<LabelPlace>& place) {
    if (places_[label]) placed_.remove(label);
    places_[label] = place;
    if (place) placed_.add(label, *place);
  }

  [[nodiscard]] bool covers_nothing(const PaperBox& box) const {
    return ground_.room.takes(widened(box, kClearanceMm)) && ground_.occupied.is_free(box);
  }

  [[nodiscard]] double cost_of_view(const LabelRequest& request, const PaperBox& box) const {
    for (std::size_t v = 0; v < ground_.views.size(); ++v)
      if (v != request.view && ground_.views[v].overlaps(box)) return kForeignViewMm;
    return 0;
  }

  /// Returns the place without a leader that lies so from the middle of the object, if it covers
  /// nothing of the ground.
  [[nodiscard]] std::optional<LabelPlace> on_object(const LabelRequest& request,
                                                    const Offset& offset) const {
    const PaperBox& object = request.object;
    const PaperPoint middle{(object.left + object.right) / 2 + offset.by.x,
                            (object.top + object.bottom) / 2 + offset.by.y};
    if (!object.holds({middle.x, middle.y, middle.x, middle.y})) return std::nullopt;
    LabelPlace place;
    place.at = {rounded_paper(middle.x), rounded_paper(middle.y + request.height_mm / 2)};
    place.box = box_of(place.at, Align::middle, request.width_mm, request.height_mm);
    if (!covers_nothing(place.box)) return std::nullopt;
    place.cost = offset.length + cost_of_view(request, place.box);
    return place;
  }

  /// Returns the place whose leader runs so from an anchor, if it covers nothing of the ground.
  [[nodiscard]] std::optional<LabelPlace> by_leader(const LabelRequest& request, std::size_t anchor,
                                                    const Offset& offset) const {
    const PaperPoint& tip = request.anchors[anchor];
    const bool right = offset.by.x > 0;
    LabelPlace place;
    const PaperPoint elbow{rounded_paper(tip.x + offset.by.x), rounded_paper(tip.y + offset.by.y)};
    place.at = {elbow.x, rounded_paper(elbow.y - kClearanceMm)};
    place.align = right ? Align::start : Align::end;
    place.box = box_of(place.at, place.align, request.width_mm, request.height_mm);
    place.box.bottom = std::max(place.box.bottom, elbow.y);
    if (!covers_nothing(place.box)) return std::nullopt;
    const OccupancyGrid::LeaderPath path = ground_.occupied.leader_path(tip, elbow);
    if (!path.open) return std::nullopt;
    place.has_leader = true;
    place.leader = {tip, elbow};
    place.end = {rounded_paper(elbow.x + (right ? request.width_mm : -request.width_mm)), elbow.y};
    place.cost = offset.length + kLaterAnchorMm * static_cast<double>(anchor) +
                 kLineStepMm * static_cast<double>(path.lines) + cost_of_view(request, place.box);
    return place;
  }

  /// Calls take(place) for the places of a label that cover nothing of the ground, about the
  /// cheapest first, but for those without a leader which come before all others. It returns the
  /// cost from which on no place is wanted.
  template <class Take>
  void each_place(const LabelRequest& request, Take&& take) {
    double wanted = kNoLimit;
    const std::size_t last = tried_ + most_tried_;
    if (request.on_object)
      for (const Offset& offset : on_object_) {
        if (offset.length >= wanted || ++tried_ > last) break;
        if (const auto place = on_object(request, offset)) wanted = take(*place);
      }
    if (wanted < kNoLimit) return;
    for (const Offset& offset : by_leader_)
      for (std::size_t anchor = 0; anchor < request.anchors.size(); ++anchor) {
        if (offset.length >= wanted || ++tried_ > last) return;
        if (const auto place = by_leader(request, anchor, offset)) wanted = take(*place);
      }
  }

  /// Returns the cheapest place beside the labels that have one.
  [[nodiscard]] std::optional<LabelPlace> cheapest(Label label) {
    std::optional<LabelPlace> best;
    double least = kNoLimit;
    Conflicts conflicts;
    each_place(requests_[label], [&](const LabelPlace& place) {
      if (place.cost >= least) return least;
      placed_.find_conflicts(place, 0, conflicts);
      const double cost = place.cost + kCrossingMm * static_cast<double>(conflicts.crossed.size());
      if (!conflicts.blockers.empty() || cost >= least) return least;
      best = place;
      return least = cost;
    });
    return best;
  }

  /// Gives labels without room the place of one that finds another.
  void make_room() {
    tried_ = 0;
    for (Label label = 0; label < places_.size() && tried_ < kMostTried; ++label)
      if (!places_[label]) drive_out_for(label);
  }

  void drive_out_for(Label label) {
    for (const auto& [place, other] : evictions(label)) {
      const LabelPlace before = *places_[other];
      settle(other, std::nullopt);
      settle(label, place);
      settle(other, cheapest(other));
      if (places_[other]) return;
      settle(label, std::nullopt);
      settle(other, before);
    }
  }

  /// Returns the nearest places of a label that one other label alone blocks, one for each of
  /// those.
  [[nodiscard]] std::vector<std::pair<LabelPlace, Label>> evictions(Label label) {
    std::vector<std::pair<LabelPlace, Label>> found;
    Conflicts conflicts;
    each_place(requests_[label], [&](const LabelPlace& place) {
      placed_.find_conflicts(place, 1, conflicts);
      if (conflicts.blockers.size() == 1 && std::ranges::none_of(found, [&](const auto& f) {
            return f.second == conflicts.blockers.front();
          }))
        found.emplace_back(place, conflicts.blockers.front());
      return found.size() < kMostEvictions ? kNoLimit : 0;
    });
    return found;
  }

  /// Places labels with crossed leaders anew, each alone and each pair in the other order, as long
  /// as that makes the sheet cheaper.
  void untangle() {
    tried_ = 0;
    for (int round = 0; round < kMostRounds; ++round) {
      bool changed = false;
      for (Label label = 0; label < places_.size() && tried_ < kMostTried; ++label)
        if (!crossed_by(label).empty()) changed = untangle(label) || changed;
      if (!changed) return;
    }
  }

  bool untangle(Label label) {
    bool changed = place_again(label);
    for (const Label other : crossed_by(label)) changed = place_both_again(label, other) || changed;
    return changed;
  }

  bool place_again(Label label) {
    const LabelPlace before = *places_[label];
    const double cost = cost_of(label);
    settle(label, std::nullopt);
    settle(label, cheapest(label));
    if (places_[label] && cost_of(label) < cost) return true;
    settle(label, before);
    return false;
  }

  /// Places two labels anew, the second before the first.
  bool place_both_again(Label first, Label second) {
    const LabelPlace one = *places_[first], two = *places_[second];
    const double cost = cost_of(first, second);
    settle(first, std::nullopt);
    settle(second, std::nullopt);
    settle(second, cheapest(second));
    settle(first, cheapest(first));
    if (places_[first] && places_[second] && cost_of(first, second) < cost) return true;
    settle(first, std::nullopt);
    settle(second, std::nullopt);
    settle(first, one);
    settle(second, two);
    return false;
  }

  /// Returns the labels whose leaders that of a label crosses.
  [[nodiscard]] std::vector<Label> crossed_by(Label label) {
    if (!places_[label] || !places_[label]->has_leader) return {};
    Conflicts conflicts;
    placed_.find_conflicts(*places_[label], places_.size(), conflicts);
    return std::move(conflicts.crossed);
  }

  [[nodiscard]] double cost_of(Label label) {
    return places_[label]->cost + kCrossingMm * static_cast<double>(crossed_by(label).size());
  }
  /// Returns what two labels cost together: a crossing of the two is one.
  [[nodiscard]] double cost_of(Label one, Label other) {
    const LabelPlace &a = *places_[one], &b = *places_[other];
    const bool each_other = a.has_leader && b.has_leader && segments_cross(a.leader, b.leader);
    return cost_of(one) + cost_of(other) - (each_other ? kCrossingMm : 0);
  }

  std::span<const LabelRequest> requests_;
  const LabelGround& ground_;
  std::vector<Offset> on_object_, by_leader_;
  std::size_t most_tried_;  ///< places that a search for one label tries
  std::size_t tried_ = 0;   ///< places that the step has tried
  PlacedLabels placed_;
  std::vector<std::optional<LabelPlace>> places_;
};

}  // namespace

std::vector<std::optional<LabelPlace>> place_labels(std::span<const LabelRequest> requests,
                                                    const LabelGround& ground) {
  if (requests.empty()) return {};
  return LabelPlacer(requests, ground).run();
}

}  // namespace strake::sheets
