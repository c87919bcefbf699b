// SPDX-License-Identifier: Apache-2.0
// The places that the ground of a sheet leaves to each label, whatever stands of the other labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sheets/labels/label_placement.hpp"
#include "sheets/labels/placed_labels.hpp"

namespace strake::sheets {

/// Work, counted instead of timed, so that it ends at the same place on every machine. A unit is
/// about a step of a leader over a square.
struct WorkLimit {
  std::uint64_t done = 0;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();

  void spend(std::uint64_t units) { done += units; }
  [[nodiscard]] bool used_up() const { return done >= limit; }
};

/// The candidates of labels: places on a lattice about their anchors which cover nothing of the
/// ground. Each is looked for once, when a search comes so far, and remembered for the next ones.
class LabelCandidates {
 public:
  using Label = PlacedLabels::Label;
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  /// What it is given must outlive it.
  LabelCandidates(std::span<const LabelRequest> requests, const LabelGround& ground,
                  WorkLimit& work);

  /// Goes through the candidates of a label that cost less than `wanted`, about the cheapest first,
  /// but for those without a leader which come before all others, and asks what is cheap first:
  ///
  /// - search.is_blocked(blocker): whether a label that blocked the candidate before still does
  /// - search.suits(place, blocker): whether the place comes into question, which costs so much at
  ///   least; sets `blocker` to what blocks it, if one label alone is enough
  /// - search.take(place): takes a place, of which all is known now, or does not; returns the cost
  ///   from which on no place is wanted
  ///
  /// Stops where the work is used up.
  template <class Search>
  void each(Label label, double wanted, Search& search) {
    const double at_first = wanted;
    for (const bool leader : {false, true}) {
      each(label, leader, wanted, search);
      if (wanted < at_first) return;
    }
  }

 private:
  static constexpr std::uint64_t kCandidateWork = 12;  ///< units of work: to make a place

  struct Offset {
    PaperPoint by;
    double length = 0;
  };

  /// A place where the text covers nothing of the ground.
  struct Candidate {
    std::uint32_t number;  ///< of the offset and, with a leader, of the anchor: offset first
    PlacedLabels::Blocker blocker;  ///< that last blocked it
    bool walked;                    ///< whether the lines under its leader are known
    double more;  ///< than its length it costs, as far as that is known; infinite: closed
  };

  /// The candidates of a label without a leader, or with one, in the order of their lengths.
  struct Found {
    std::vector<Candidate> all;
    std::size_t next = 0;  ///< the number that has not been looked at
  };

  template <class Search>
  void each(Label label, bool leader, double& wanted, Search& search) {
    Found& found = (leader ? by_leader_ : on_object_)[label];
    for (std::size_t i = 0; i < found.all.size() || extend_search(label, leader, wanted); ++i) {
      Candidate& candidate = found.all[i];
      const double length = offset_of(label, leader, candidate.number).length;
      if (length >= wanted || work_.used_up()) return;
      work_.spend(1);
      if (length + candidate.more >= wanted) continue;
      if (search.is_blocked(candidate.blocker)) continue;
      LabelPlace place = place_of(label, leader, candidate.number);
      place.cost = length + candidate.more;
      work_.spend(kCandidateWork);
      if (!search.suits(place, candidate.blocker)) continue;
      if (!candidate.walked) walk(place, candidate);
      place.cost = length + candidate.more;
      if (place.cost < wanted) wanted = search.take(place);
    }
  }

  [[nodiscard]] const Offset& offset_of(Label label, bool leader, std::size_t number) const {
    return leader ? leader_offsets_[number / requests_[label].anchors.size()]
                  : object_offsets_[number];
  }
  /// Looks for the next candidate; returns whether there is one that is short enough to be wanted.
  bool extend_search(Label label, bool leader, double wanted);
  [[nodiscard]] LabelPlace place_of(Label label, bool leader, std::size_t number) const;
  [[nodiscard]] LabelPlace on_object(const LabelRequest& request, const Offset& offset) const;
  [[nodiscard]] LabelPlace by_leader(const LabelRequest& request, const PaperPoint& tip,
                                     const Offset& offset) const;
  [[nodiscard]] LabelPlace balloon(const LabelRequest& request, const PaperPoint& tip,
                                   const Offset& offset) const;
  [[nodiscard]] bool covers_nothing(const LabelRequest& request, const LabelPlace& place) const;
  [[nodiscard]] double cost_of_view(const LabelRequest& request, const PaperBox& box) const;
  void walk(const LabelPlace& place, Candidate& candidate);

  static std::vector<Offset> lattice(double min_mm, bool for_leader);

  std::span<const LabelRequest> requests_;
  const LabelGround& ground_;
  WorkLimit& work_;
  std::vector<Offset> object_offsets_, leader_offsets_;
  std::vector<Found> on_object_, by_leader_;  ///< of each label
};

}  // namespace strake::sheets
