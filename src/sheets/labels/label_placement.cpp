// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/label_placement.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "sheets/labels/label_candidates.hpp"
#include "sheets/labels/placed_labels.hpp"

namespace strake::sheets {

namespace {

using Label = PlacedLabels::Label;
using Conflicts = PlacedLabels::Conflicts;
using Blocker = PlacedLabels::Blocker;

/// What a leader that is crossed costs, in millimetres of leader.
constexpr double kCrossingMm = 40;
/// The work of placing all labels of a sheet: less than a second.
constexpr std::uint64_t kMaxWork = 300'000'000;
constexpr std::uint64_t kCompareWork = 8;  ///< to look at a bin or at a label in it
constexpr std::size_t kMaxEvictions = 8;
constexpr int kMaxRounds = 8;
/// An attempt to untangle takes this part of the work that is left, at most.
constexpr std::size_t kUntangleParts = 16;

PaperBox around(const PaperPoint& a, const PaperPoint& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)};
}

PaperBox joined(const PaperBox& a, const PaperBox& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

/// Returns the box of the paper that a label may take.
PaperBox reach_of(const LabelRequest& request) {
  PaperBox reach = request.object;
  if (!request.on_object) reach = around(request.anchors.front(), request.anchors.front());
  for (const PaperPoint& anchor : request.anchors) reach = joined(reach, around(anchor, anchor));
  return widened(reach, kLabelReachMm + request.width_mm + request.height_mm + kClearanceMm);
}

/// Returns the box of what a label takes.
PaperBox taken_by(const LabelPlace& place) {
  return place.has_leader ? joined(place.box, around(place.leader.a, place.leader.b)) : place.box;
}

class LabelPlacer {
 public:
  LabelPlacer(std::span<const LabelRequest> requests, const LabelGround& ground,
              const std::stop_token& stop)
      : stop_(stop),
        candidates_(requests, ground, work_),
        placed_(ground.width_mm, ground.height_mm, requests.size()),
        places_(requests.size()) {
    for (const LabelRequest& request : requests) reach_.push_back(reach_of(request));
  }

  std::vector<std::optional<LabelPlace>> run() && {
    place_each();
    make_room();
    untangle();
    return std::move(places_);
  }

 private:
  static constexpr double kNoLimit = LabelCandidates::kNoLimit;

  /// Lets what comes next do one of so many equal parts of the work that is left until `end`.
  /// Returns whether there is any.
  bool take_share(std::uint64_t end, std::size_t parts) {
    if (stop_.stop_requested() || work_.done >= end) return false;
    work_.limit = work_.done + (end - work_.done + parts - 1) / parts;
    return true;
  }

  void settle(Label label, const std::optional<LabelPlace>& place) {
    if (places_[label]) placed_.remove(label);
    places_[label] = place;
    if (place) placed_.add(label, *places_[label]);
  }

  void find_conflicts(const LabelPlace& place, const PlacedLabels::QueryLimit& limit,
                      Conflicts& found) {
    placed_.find_conflicts(place, limit, found);
    work_.spend(kCompareWork * found.visited);
  }

  /// A search for the cheapest place beside the labels that have one.
  struct CheapestSearch {
    LabelPlacer& of;
    double least;
    std::optional<LabelPlace> best = {};
    Conflicts conflicts = {};

    [[nodiscard]] double cost(const LabelPlace& place) const {
      return place.cost + kCrossingMm * static_cast<double>(conflicts.crossed.size());
    }
    [[nodiscard]] bool is_blocked(const Blocker& blocker) const { return of.placed_.has(blocker); }
    [[nodiscard]] bool suits(const LabelPlace& place, Blocker& blocker) {
      const double crossings = std::min((least - place.cost) / kCrossingMm, 1e6);
      of.find_conflicts(place, {0, static_cast<std::size_t>(crossings)}, conflicts);
      if (conflicts.blockers.empty()) return cost(place) < least;
      blocker = of.placed_.blocker(conflicts.blockers.front());
      return false;
    }
    double take(const LabelPlace& place) {
      if (cost(place) >= least) return least;
      best = place;
      return least = cost(place);
    }
  };

  /// Returns the cheapest place of a label, if it costs less than `limit`.
  [[nodiscard]] std::optional<LabelPlace> cheapest(Label label, double limit = kNoLimit) {
    CheapestSearch search{*this, limit};
    candidates_.each(label, limit, search);
    return search.best;
  }

  /// Gives each label the cheapest place that those before it leave.
  void place_each() {
    for (Label label = 0; label < places_.size(); ++label)
      if (take_share(kMaxWork / 2, places_.size() - label)) settle(label, cheapest(label));
  }

  /// Gives labels without room the place of one that finds another.
  void make_room() {
    auto left = static_cast<std::size_t>(
        std::ranges::count_if(places_, [](const auto& place) { return !place; }));
    const std::uint64_t end = work_.done + (kMaxWork - work_.done) / 4 * 3;
    for (Label label = 0; label < places_.size(); ++label)
      if (!places_[label] && take_share(end, left--)) drive_out_for(label);
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

  /// A search for the nearest places that one other label alone blocks, one for each of those.
  struct Evictions {
    LabelPlacer& of;
    std::vector<std::pair<LabelPlace, Label>> found = {};
    Conflicts conflicts = {};

    [[nodiscard]] static bool is_blocked(const Blocker&) { return false; }
    [[nodiscard]] bool suits(const LabelPlace& place, Blocker&) {
      of.find_conflicts(place, {1, of.places_.size()}, conflicts);
      return conflicts.blockers.size() == 1 && std::ranges::none_of(found, [&](const auto& f) {
               return f.second == conflicts.blockers.front();
             });
    }
    double take(const LabelPlace& place) {
      found.emplace_back(place, conflicts.blockers.front());
      return found.size() < kMaxEvictions ? kNoLimit : 0;
    }
  };

  [[nodiscard]] std::vector<std::pair<LabelPlace, Label>> evictions(Label label) {
    Evictions search{*this};
    candidates_.each(label, kNoLimit, search);
    return std::move(search.found);
  }

  /// Places labels with crossed leaders anew, each alone and each pair in the other order, as long
  /// as that makes the sheet cheaper.
  void untangle() {
    for (int round = 0; round < kMaxRounds; ++round) {
      bool changed = false;
      for (Label label = 0; label < places_.size(); ++label) {
        if (!take_share(kMaxWork, 1)) return;
        if (!crossed_by(label).empty()) changed = untangle(label) || changed;
      }
      if (!changed) return;
    }
  }

  bool untangle(Label label) {
    bool changed = try_once({label, label}, [&] { return place_again(label); });
    for (const Label other : crossed_by(label))
      changed = try_once({label, other}, [&] { return place_both_again(label, other); }) || changed;
    return changed;
  }

  /// Makes an attempt, but not again until something near it has changed.
  template <class Attempt>
  bool try_once(const std::pair<Label, Label>& who, Attempt&& attempt) {
    const auto [tried, first] = tried_at_.try_emplace(who, 0);
    if (!first && !changed_near(who.first, tried->second) &&
        !changed_near(who.second, tried->second))
      return false;
    if (!take_share(kMaxWork, kUntangleParts)) return false;
    const bool changed = attempt();
    tried->second = changes_.size();
    return changed;
  }

  /// Returns whether a change since the one of that number lies where a label may stand.
  [[nodiscard]] bool changed_near(Label label, std::size_t since) const {
    return std::any_of(changes_.begin() + static_cast<std::ptrdiff_t>(since), changes_.end(),
                       [&](const PaperBox& change) { return reach_[label].overlaps(change); });
  }

  void note_change(Label label, const LabelPlace& before) {
    changes_.push_back(joined(taken_by(before), taken_by(*places_[label])));
  }

  bool place_again(Label label) {
    const LabelPlace before = *places_[label];
    const double cost = cost_of(label);
    settle(label, std::nullopt);
    settle(label, cheapest(label, cost));
    if (places_[label] && cost_of(label) < cost) {
      note_change(label, before);
      return true;
    }
    settle(label, before);
    return false;
  }

  /// Places two labels anew, the second before the first.
  bool place_both_again(Label first, Label second) {
    const LabelPlace one = *places_[first], two = *places_[second];
    const double cost = cost_of(first, second);
    settle(first, std::nullopt);
    settle(second, std::nullopt);
    settle(second, cheapest(second, cost));
    if (places_[second]) settle(first, cheapest(first, cost - places_[second]->cost));
    if (places_[first] && places_[second] && cost_of(first, second) < cost) {
      note_change(first, one);
      note_change(second, two);
      return true;
    }
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
    find_conflicts(*places_[label], {places_.size(), places_.size()}, conflicts);
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

  const std::stop_token& stop_;
  WorkLimit work_;
  LabelCandidates candidates_;
  PlacedLabels placed_;
  std::vector<std::optional<LabelPlace>> places_;
  std::vector<PaperBox> reach_;    ///< of each label
  std::vector<PaperBox> changes_;  ///< where untangling changed something, one after the other
  /// How many changes there had been when an attempt was last made.
  std::map<std::pair<Label, Label>, std::size_t> tried_at_;
};

}  // namespace

std::vector<std::optional<LabelPlace>> place_labels(std::span<const LabelRequest> requests,
                                                    const LabelGround& ground,
                                                    const std::stop_token& stop) {
  if (requests.empty()) return {};
  return LabelPlacer(requests, ground, stop).run();
}

}  // namespace strake::sheets
