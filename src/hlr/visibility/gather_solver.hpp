// SPDX-License-Identifier: Apache-2.0
// The engine's first step for one edge: gather what hides it. EdgePieceBuilder takes the second.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/view/view_bvh.hpp"
#include "hlr/visibility/solver_work.hpp"
#include "hlr/visibility/visibility_intervals.hpp"
#include "hlr/visibility/visibility_scene.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Gathers the intervals that occluders hide of one edge after another: front to back, until
/// nothing visible is left. For one worker; it keeps its memory from edge to edge.
class OccluderGatherer {
 public:
  explicit OccluderGatherer(const VisibilityScene& visibility)
      : visibility_(visibility), job_(visibility.job) {}

  /// Announces that the next queries are for the edges of an item, which must outlive them.
  /// `times_own`: what tests against its own object take is added to the work.
  void start(const EdgeRange& item, bool times_own = false);

  /// Returns whether the occlusion buffer hides every edge of the item that is no point on paper,
  /// not cut away and not seen through its own object. It decides nothing where it matters who
  /// hides what.
  [[nodiscard]] bool hides_item() const;

  /// Returns whether the intervals that intervals() returned last leave nothing to be seen. False
  /// without culling.
  [[nodiscard]] bool hides_all() const { return hides_all_; }

  /// Returns the intervals that are hidden of an edge between two parameters, as far as the job's
  /// stage asks, unsorted. The own object's come first and, unless it hides the edge wholly,
  /// completely.
  [[nodiscard]] std::span<const OcclusionInterval> intervals(const EdgeQuery& edge,
                                                             const RationalParam& lo,
                                                             const RationalParam& hi);

  /// Return only the intervals that the edge's own object hides, or one body of another object.
  [[nodiscard]] std::span<const OcclusionInterval> self_occlusion(const EdgeQuery& edge,
                                                                  const RationalParam& lo,
                                                                  const RationalParam& hi);
  [[nodiscard]] std::span<const OcclusionInterval> intervals_of_body(const EdgeQuery& edge,
                                                                     std::uint32_t body,
                                                                     const RationalParam& lo,
                                                                     const RationalParam& hi);

  /// Returns the box on paper of the edge that was queried last.
  [[nodiscard]] ViewBox box() const;

  /// Returns the intervals that a body's own faces hide of its edge.
  [[nodiscard]] std::span<const OcclusionInterval> intervals_of_own_body(const EdgeQuery& edge);

  /// The work so far.
  SolverWork work;

 private:
  /// How the faces of a part hide an edge.
  struct Rule {
    std::int64_t contact = 0;
    std::int64_t lying = 0;  ///< edges no deeper than this at both ends lie in a face's plane
    bool self = false;       ///< a part of the edge's own object
    bool edge_on = true;     ///< faces that may be edge-on but for rounding hide, too
  };

  void begin(const EdgeQuery& edge, const RationalParam& lo, const RationalParam& hi);
  void gather_own_objects();
  void gather_own_objects_untimed();
  void gather_object(std::uint32_t object);
  void gather_others();
  bool find_neighbours();
  void find_gaps();
  void gather_own_body();
  void test_own_body();

  // These return false when nothing of the edge is left.
  template <class Accepts>
  bool gather_column(std::uint32_t column, bool self, const Accepts& accepts);
  bool gather_body(std::uint32_t body, bool self);
  bool test_part(const ProjectedShape& shape, const OccluderPart& part, const Rule& rule);
  bool test_polygon(const ProjectedShape& shape, const OccluderPolygon& polygon, const Rule& rule);
  bool add(std::optional<OcclusionInterval> interval, bool self);
  bool add(const OcclusionInterval& interval);

  [[nodiscard]] std::size_t count_above(std::span<const std::uint32_t> column) const;
  [[nodiscard]] bool is_deep_under(const OccluderPart& part, std::int64_t contact) const;
  void localize(const BodyInstance& other);
  void project_range(double from, double to);
  void set_open(const OpenRange& open);
  void find_open_part();
  [[nodiscard]] SegmentQuery make_query() const;
  [[nodiscard]] SegmentQuery make_query(const PaperRotation& rotation) const;
  [[nodiscard]] SegmentQuery make_perspective_query() const;

  const VisibilityScene& visibility_;
  const ViewJob& job_;
  EdgeQuery edge_;
  OpenRange open_;
  bool hides_all_ = false;
  std::vector<ParamRange> gaps_;  ///< what the occlusion buffer leaves open, ascending
  std::vector<SegmentRange> uncovered_;
  ViewBox open_box_;  ///< orthographic: see open_box()
  SegmentQuery segment_;
  // In perspective; nothing where the edge may be anywhere on paper.
  std::optional<PerspectiveSegment> perspective_segment_;
  ViewBox perspective_box_;
  // The edge, the place on paper and the limits in the coordinates of the tested body.
  LocalEdge local_;
  ViewPoint local_at_;
  geometry::Box3l limits_;
  std::vector<OcclusionInterval> intervals_;
  BucketMarks marks_;

  /// A column with a body of another object that may hide an edge of the item.
  struct Neighbour {
    LooseBox box;
    std::uint32_t column = 0;
  };
  enum class Neighbours : std::uint8_t { not_searched, found, too_many };
  const EdgeRange* item_ = nullptr;
  bool times_own_ = false;
  ViewBox item_box_;  ///< of its edges; empty for lines, and in perspective
  Neighbours neighbours_ = Neighbours::too_many;
  std::vector<Neighbour> near_;  ///< the nearest to the viewer first
};

}  // namespace strake::hlr
