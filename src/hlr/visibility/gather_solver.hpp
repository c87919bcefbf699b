// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/view/view_bvh.hpp"
#include "hlr/visibility/specks.hpp"
#include "hlr/visibility/visibility_intervals.hpp"
#include "hlr/visibility/visibility_scene.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

struct SolverWork {
  std::uint64_t edges = 0, covered = 0, tests = 0, wide_tests = 0, left_out = 0, specks = 0;
};

void add(Counters& counters, const SolverWork& work);

/// Gathers what hides one edge after another: front to back, until nothing is left to be seen.
/// For one worker; it keeps its memory from edge to edge.
class OccluderGatherer {
 public:
  explicit OccluderGatherer(const VisibilityScene& visibility)
      : visibility_(visibility), job_(visibility.job) {}

  /// The edges that are asked about next are those of an item, which outlives that.
  void start(const EdgeRange& item) {
    item_ = &item;
    neighbours_ = Neighbours::not_searched;
  }

  /// What hides an edge between two parameters, as far as the job's stage asks: hits in no
  /// particular order. The own object's come first and, unless it hides the edge wholly,
  /// completely.
  [[nodiscard]] std::span<const OcclusionInterval> intervals(const EdgeQuery& edge,
                                                             const RationalParam& lo,
                                                             const RationalParam& hi);

  /// Of this what the edge's own object hides, or another body: one of another object.
  [[nodiscard]] std::span<const OcclusionInterval> self_occlusion(const EdgeQuery& edge,
                                                                  const RationalParam& lo,
                                                                  const RationalParam& hi);
  [[nodiscard]] std::span<const OcclusionInterval> intervals_of_body(const EdgeQuery& edge,
                                                                     std::uint32_t body,
                                                                     const RationalParam& lo,
                                                                     const RationalParam& hi);

  /// Where the edge that was asked about last lies on paper.
  [[nodiscard]] ViewBox box() const;

  /// What a body's own faces hide of an edge of it.
  [[nodiscard]] std::span<const OcclusionInterval> intervals_of_own_body(const EdgeQuery& edge);

  /// The work so far.
  SolverWork work;

 private:
  /// How the faces of a part hide an edge.
  struct Rule {
    std::int64_t contact = 0;
    std::int64_t lying = 0;  ///< edges no deeper than this at both ends lie in a face's plane
    bool self = false;       ///< a part of the edge's own object
    bool edge_on = true;     ///< also faces that may be edge-on but for rounding
  };

  void begin(const EdgeQuery& edge, const RationalParam& lo, const RationalParam& hi);
  void gather_own_objects();
  void gather_object(std::uint32_t object);
  void gather_others();
  bool find_neighbours();
  void apply_occlusion_buffer();
  void gather_own_body();
  void test_own_body();

  // These say false when nothing of the edge is left.
  bool gather_body(std::uint32_t body, bool self);
  bool test_part(const LocalEdge& local, const ProjectedShape& view, const OccluderPart& part,
                 const Rule& rule);
  bool test_polygon(const LocalEdge& local, const ProjectedShape& view,
                    const OccluderPolygon& polygon, const Rule& rule);
  bool add(std::optional<OcclusionInterval> interval, bool self);
  bool add(const OcclusionInterval& interval);

  [[nodiscard]] bool is_deep_under(const LocalEdge& local, const OccluderPart& part,
                                   std::int64_t contact) const;
  [[nodiscard]] LocalEdge localized(const BodyInstance& other);
  void project_range(double from, double to);
  [[nodiscard]] SegmentQuery make_query(const ViewPoint& a, const ViewPoint& b,
                                        const PaperRotation& turn = {}) const;
  [[nodiscard]] SegmentQuery make_perspective_query() const;
  void refresh_segment() { segment_ = make_query(edge_.va, edge_.vb); }

  const VisibilityScene& visibility_;
  const ViewJob& job_;
  EdgeQuery edge_;
  OpenRange open_;
  SegmentQuery segment_;
  // In perspective; nothing where the edge may be anywhere in the picture.
  std::optional<PerspectiveSegment> perspective_segment_;
  ViewBox perspective_box_;
  geometry::Box3l limits_;  ///< in the coordinates of the body that is asked
  std::vector<OcclusionInterval> intervals_;
  BucketMarks marks_;

  /// A body of another object that may hide an edge of the item.
  struct Neighbour {
    LooseBox box;
    std::uint32_t body = 0;
  };
  enum class Neighbours : std::uint8_t { not_searched, found, too_many };
  const EdgeRange* item_ = nullptr;
  Neighbours neighbours_ = Neighbours::too_many;
  std::vector<Neighbour> near_;  ///< the nearest to the viewer first
};

/// Makes the pieces of one edge after another from what hides them. For one worker; it keeps its
/// memory from edge to edge.
class PieceMaker {
 public:
  PieceMaker(const VisibilityScene& visibility, const SpeckRule& rule)
      : visibility_(visibility), rule_(rule) {}

  /// Takes an edge in hand. True when what hides it between lo() and hi() is to be told; else all
  /// of it is clipped, or a point on paper.
  [[nodiscard]] bool begin(const EdgeQuery& edge);
  [[nodiscard]] const RationalParam& lo() const { return lo_; }
  [[nodiscard]] const RationalParam& hi() const { return hi_; }

  /// What finish() did not append.
  struct Absent {
    bool left_out = false;   ///< hidden pieces
    std::size_t specks = 0;  ///< that other pieces took over
  };
  /// Appends the pieces of the edge in hand, which has this number within its object.
  Absent finish(std::uint32_t number, std::span<const OcclusionInterval> intervals,
                std::vector<EdgePiece>& out);

 private:
  const VisibilityScene& visibility_;
  EdgeQuery edge_;
  RationalParam lo_ = RationalParam::zero(), hi_ = RationalParam::one();
  State whole_ = State::visible;  ///< or what all of the edge is
  std::vector<VisibilityInterval> intervals_;
  IntervalSweep maker_;
  const SpeckRule& rule_;
};

}  // namespace strake::hlr
