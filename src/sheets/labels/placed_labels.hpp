// SPDX-License-Identifier: Apache-2.0
// Labels that have a place on the sheet, found by where they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sheets/spec/paper_segments.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// A place for a label: a text and, with a leader, the line from its elbow to the object.
struct LabelPlace {
  PaperPoint at;  ///< on the base line; the centre of a balloon
  Align align = Align::middle;
  PaperBox box;  ///< of the text and, with a leader, of the landing below it
  bool has_leader = false;
  PaperSegment leader;       ///< from the object to the elbow
  PaperPoint end;            ///< of the landing, which begins at the elbow
  double cost = 0;           ///< without what crossed leaders cost
  std::uint32_t number = 0;  ///< of the place, since a label first took it; 0: none has
};

/// Labels by number, in square bins of paper. Each query takes time by the labels in the bins that
/// it reaches.
class PlacedLabels {
 public:
  using Label = std::uint32_t;

  PlacedLabels(double width_mm, double height_mm, std::size_t labels);

  /// Adds a label that has no place yet; numbers a place that no label has taken before.
  void add(Label label, LabelPlace& place);
  /// Takes a label away that has a place.
  void remove(Label label);

  /// What a place would have against the labels that are there.
  struct Conflicts {
    std::vector<Label> blockers;  ///< whose text or leader it covers, or which cover its own
    std::vector<Label> crossed;   ///< whose leaders it only crosses
    std::size_t visited = 0;      ///< bins and labels that the query looked at
  };
  /// A label at one of its places; number 0: none.
  struct Blocker {
    Label label = 0;
    std::uint32_t number = 0;
  };
  /// Returns whether the label still has that place, and so blocks what it blocked.
  [[nodiscard]] bool has(const Blocker& blocker) const {
    return blocker.number != 0 && places_[blocker.label].number == blocker.number;
  }
  /// Returns a label as it stands now.
  [[nodiscard]] Blocker blocker(Label label) const { return {label, places_[label].number}; }

  /// How many of them a query wants to know.
  struct QueryLimit {
    std::size_t blockers, crossed;
  };
  /// Sets `found` to the conflicts of a place, both lists in ascending order. Looks no further once
  /// there are more than `limit` of either; the lists are then not all.
  void find_conflicts(const LabelPlace& place, const QueryLimit& limit, Conflicts& found);

 private:
  template <class Visit>
  bool each_bin(const PaperBox& box, Visit&& visit) const;
  template <class Visit>
  bool each_bin(const PaperSegment& line, Visit&& visit) const;
  template <class Visit>
  bool each_bin(const LabelPlace& place, double rim_mm, Visit&& visit) const;

  void compare(const LabelPlace& place, Label label, Conflicts& found) const;

  std::size_t columns_, rows_;
  std::vector<std::vector<Label>> bins_;
  std::vector<LabelPlace> places_;
  std::vector<std::uint64_t> last_query_;  ///< by label: the last query that met it
  std::uint64_t query_ = 0;
  std::uint32_t numbers_ = 0;  ///< given to places
};

}  // namespace strake::sheets
