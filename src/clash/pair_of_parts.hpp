// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/closed_form.hpp"
#include "clash/narrow_part.hpp"

namespace strake::clash {

/// Two parts in canonical order, and what is said of them: narrow.hpp.
class PairOfParts {
 public:
  /// All must outlive this.
  PairOfParts(const NarrowPart& a, const NarrowPart& b, const NarrowOptions& options,
              NarrowWork& work);

  [[nodiscard]] PartAnswer analytic(const ClosedForm& form) const;

  /// Of those that touch at a point, relative to a's origin.
  [[nodiscard]] PartAnswer flush(const geometry::Vec3d& point);

  /// Of those that lie face to face across the gap; `asked`: whether none is certain.
  [[nodiscard]] std::optional<PartAnswer> flush_across(const geometry::PartingGap& gap,
                                                       bool& asked);

  [[nodiscard]] FirstLook look(const KnownBefore& known);

  [[nodiscard]] PartAnswer distance(double reach);

  [[nodiscard]] PartAnswer depth(const FirstLook& look, const KnownBefore& known);

 private:
  double apart(double limit, PartAnswer& answer);
  void within(const Separation& meshes, geometry::AnalyticSeparation& form) const;
  [[nodiscard]] bool all_one(double lower, double upper) const;
  bool apart_from_mesh(double reach, PartAnswer& answer);
  [[nodiscard]] bool hulls_part() const;
  [[nodiscard]] bool equal_solids() const;
  [[nodiscard]] geometry::MeetingResult meeting_of_equals() const;
  void touching(const geometry::MeetingResult& meeting, PartAnswer& answer);
  void conclude_touching(PartAnswer& answer) const;
  [[nodiscard]] bool may_be_flush(double gap) const;
  void nearly_touching(const geometry::Closest& near, const geometry::PartingGap& gap,
                       PartAnswer& answer) const;
  [[nodiscard]] bool may_touch(geometry::DepthGoal goal);
  void interpenetrating(const geometry::MeetingResult& meeting, double gap, PartAnswer& answer);
  [[nodiscard]] double sag() const;
  void conclude(PartAnswer& answer) const { conclude(answer, sag()); }
  void conclude(PartAnswer& answer, double sag) const;

  const NarrowPart &part_a_, &part_b_;
  const geometry::TreedPart &a_, &b_;
  const NarrowOptions& options_;
  NarrowWork& work_;
  Thresholds thresholds_;
};

}  // namespace strake::clash
