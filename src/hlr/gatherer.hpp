// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/asked_edge.hpp"
#include "hlr/occlusion.hpp"
#include "hlr/stretches.hpp"
#include "hlr/view_tree.hpp"
#include "hlr/world.hpp"

namespace strake::hlr {

struct Work {
  std::uint64_t edges = 0, covered = 0, tests = 0, wide_tests = 0, left_out = 0, specks = 0;
};

void add(Counters& counters, const Work& work);

/// Gathers what hides one edge after another: front to back, until nothing is left to be seen.
/// For one worker; it keeps its memory from edge to edge.
class Gatherer {
 public:
  explicit Gatherer(const World& world) : world_(world), job_(world.job) {}

  /// The edges that are asked about next are those of an item, which outlives that.
  void start(const Item& item) {
    item_ = &item;
    neighbours_ = Neighbours::not_looked_for;
  }

  /// What hides an edge between two parameters, as far as the job's stage asks: hits in no
  /// particular order. The own object's come first and, unless it hides the edge wholly,
  /// completely.
  [[nodiscard]] std::span<const Hit> hits(const AskedEdge& edge, const Param& lo, const Param& hi);

  /// Of this what the edge's own object hides, or another body: one of another object.
  [[nodiscard]] std::span<const Hit> own_hits(const AskedEdge& edge, const Param& lo,
                                              const Param& hi);
  [[nodiscard]] std::span<const Hit> hits_of_body(const AskedEdge& edge, std::uint32_t body,
                                                  const Param& lo, const Param& hi);

  /// Where the edge that was asked about last lies on paper.
  [[nodiscard]] ViewBox box() const;

  /// What a body's own faces hide of an edge of it.
  [[nodiscard]] std::span<const Hit> hits_of_own_body(const AskedEdge& edge);

  /// The work so far.
  Work work;

 private:
  /// How the faces of a part hide an edge.
  struct Rule {
    std::int64_t contact = 0;
    std::int64_t lying = 0;  ///< edges no deeper than this at both ends lie in a face's plane
    bool self = false;       ///< a part of the edge's own object
    bool edge_on = true;     ///< also faces that may be edge-on but for rounding
  };

  void begin(const AskedEdge& edge, const Param& lo, const Param& hi);
  void gather_own_objects();
  void gather_object(std::uint32_t object);
  void gather_others();
  bool find_neighbours();
  void take_covered_ends();
  void gather_own_body();
  void test_own_body();

  // These say false when nothing of the edge is left.
  bool gather_body(std::uint32_t body, bool self);
  bool test_part(const LocalEdge& local, const ShapeView& view, const PartView& part,
                 const Rule& rule);
  bool test_polygon(const LocalEdge& local, const ShapeView& view, const Polygon& polygon,
                    const Rule& rule);
  bool add(std::optional<Hit> hit, bool self);
  bool add(const Hit& hit);

  [[nodiscard]] bool is_deep_under(const LocalEdge& local, const PartView& part,
                                   std::int64_t contact) const;
  [[nodiscard]] LocalEdge localized(const Placed& other);
  void look_at_picture(double from, double to);
  [[nodiscard]] LooseSegment loose(const ViewPoint& a, const ViewPoint& b,
                                   const Turn& turn = {}) const;
  [[nodiscard]] LooseSegment loose_in_picture() const;
  void refresh_segment() { segment_ = loose(edge_.va, edge_.vb); }

  const World& world_;
  const Job& job_;
  AskedEdge edge_;
  OpenRange open_;
  LooseSegment segment_;
  // In perspective; nothing where the edge may be anywhere in the picture.
  std::optional<PictureSegment> in_picture_;
  ViewBox picture_box_;
  geometry::Box3l limits_;  ///< in the coordinates of the body that is asked
  std::vector<Hit> hits_;
  BucketMarks marks_;

  /// A body of another object that may hide an edge of the item.
  struct Neighbour {
    LooseBox box;
    std::uint32_t body = 0;
  };
  enum class Neighbours : std::uint8_t { not_looked_for, found, too_many };
  const Item* item_ = nullptr;
  Neighbours neighbours_ = Neighbours::too_many;
  std::vector<Neighbour> near_;  ///< the nearest to the viewer first
};

}  // namespace strake::hlr
