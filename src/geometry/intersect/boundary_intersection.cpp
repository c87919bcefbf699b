// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersect/boundary_intersection.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/bvh/parallel_traversal.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/distance/distance_traversal.hpp"
#include "geometry/distance/slab_partition.hpp"
#include "geometry/intersect/coplanar_faces.hpp"
#include "geometry/intersect/radial_sort.hpp"
#include "geometry/intersect/separating_plane.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// Number of planes of triangles in contact, and of triangles apart, that are tried for separating
/// the parts. Clash detection of 3,000 objects takes 0.1 % fewer instructions with 2 of the former,
/// and 0.3 % more with 8.
constexpr int kSeparationTries = 4;
constexpr int kPartingTries = 16;

/// Adds what follows from a triangle's corners off the other's plane, where the triangles meet
/// along a segment through the other's interior: there the other part is a half-space, or itself.
void classify_corners(const CornerSides& sides, bool crosser_solid, bool face_solid,
                      bool& interiors, bool& crosser_leaves, bool& face_leaves) {
  const bool below = sides[0] < 0 || sides[1] < 0 || sides[2] < 0;
  const bool above = sides[0] > 0 || sides[1] > 0 || sides[2] > 0;
  if (face_solid) {
    interiors |= below;
    crosser_leaves |= above;
    face_leaves |= below && crosser_solid;
  } else {
    // The face is of a sheet: the crossing triangle leaves it on either side.
    crosser_leaves = true;
  }
}

}  // namespace

bool ContactClassifier::classify_pair(std::uint32_t ta, std::uint32_t tb) {
  return classify_pair(ta, tb, a_.triangle(ta), b_.triangle(tb));
}

bool ContactClassifier::classify_pair(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                                      const ExactTriangle& b) {
  const TriangleContact c = contact(a, b);
  return c.touch == Touch::none ? !parted(a, b, c) : touching(ta, tb, a, b, c);
}

/// Two triangles apart often lie on a flat side of one part with all of the other beyond it.
bool ContactClassifier::parted(const ExactTriangle& a, const ExactTriangle& b,
                               const TriangleContact& c) {
  const auto positive = [](const CornerSides& s) { return s[0] > 0 && s[1] > 0 && s[2] > 0; };
  if (!whole_ || found_.boundaries_meet || parting_tries_ >= kPartingTries) return false;
  const bool a_beyond_b = positive(c.side_a), b_beyond_a = positive(c.side_b);
  if (!a_beyond_b && !b_beyond_a) return false;
  ++parting_tries_;
  found_.separated = a_beyond_b ? is_strictly_separating_plane(b, b_, a_)
                                : is_strictly_separating_plane(a, a_, b_);
  return found_.separated;
}

bool ContactClassifier::touching(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                                 const ExactTriangle& b, const TriangleContact& c) {
  ++touches_;
  if (!found_.boundaries_meet) record_contact_at(ta, tb, common_point(a, b, c));
  if (whole_ && !found_.overlap.interiors && separation_tries_ < kSeparationTries &&
      separated(a, b)) {
    found_.separated = true;
    return false;
  }
  const bool had_interiors = found_.overlap.interiors;
  classify(ta, tb, c);
  // The point of a crossing is preferred to that of an earlier touch.
  if (found_.overlap.interiors && !had_interiors) record_contact_at(ta, tb, common_point(a, b, c));
  return !found_.overlap.complete();
}

void ContactClassifier::record_contact_at(std::uint32_t ta, std::uint32_t tb, const Vec3d& point) {
  found_.boundaries_meet = true;
  found_.triangle_a = ta;
  found_.triangle_b = tb;
  found_.point = point;
}

void ContactClassifier::insert_linear(std::uint32_t ta, std::uint32_t tb) {
  found_.linear_a.insert(shell_of(a_.part(), ta));
  found_.linear_b.insert(shell_of(b_.part(), tb));
}

bool ContactClassifier::separated(const ExactTriangle& a, const ExactTriangle& b) {
  ++separation_tries_;
  // A solid lies below the planes of its own flat sides; a sheet may lie on either.
  if (is_separating_plane(a, a_, b_) || is_separating_plane(b, b_, a_)) return true;
  return (!a_.solid() && is_separating_plane(a, b_, a_)) ||
         (!b_.solid() && is_separating_plane(b, a_, b_));
}

void ContactClassifier::classify(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  if (c.touch == Touch::point) return;
  insert_linear(ta, tb);
  if (c.coplanar)
    classify_coplanar(ta, tb, c);
  else
    classify_crossing(ta, tb, c);
}

void ContactClassifier::classify_crossing(std::uint32_t ta, std::uint32_t tb,
                                          const TriangleContact& c) {
  if (c.edge_b < 0)
    classify_corners(c.side_a, a_.solid(), b_.solid(), found_.overlap.interiors,
                     found_.overlap.a_leaves_b, found_.overlap.b_leaves_a);
  if (c.edge_a < 0)
    classify_corners(c.side_b, b_.solid(), a_.solid(), found_.overlap.interiors,
                     found_.overlap.b_leaves_a, found_.overlap.a_leaves_b);
  if (c.edge_a < 0 && c.edge_b < 0) {
    found_.overlap.interiors = true;
  } else if (c.edge_b < 0) {
    edge_in_face_of_b(ta, c.edge_a, tb);
  } else if (c.edge_a < 0) {
    edge_in_face_of_a(ta, tb, c.edge_b);
  } else {
    edge_on_edge(ta, c.edge_a, tb, c.edge_b);
  }
}

void ContactClassifier::classify_coplanar(std::uint32_t ta, std::uint32_t tb,
                                          const TriangleContact& c) {
  found_.flush |= c.touch == Touch::area;
  if (c.touch == Touch::area && a_.solid() && b_.solid()) {
    found_.overlap.interiors |= c.same_normal;
    found_.overlap.a_leaves_b |= !c.same_normal;
    found_.overlap.b_leaves_a |= !c.same_normal;
  }
  for (int i = 0; i < 3; ++i) {
    if ((c.edges_of_a_inside_b >> i) & 1U) edge_in_face_of_b(ta, i, tb);
    if ((c.edges_of_b_inside_a >> i) & 1U) edge_in_face_of_a(ta, tb, i);
    for (int j = 0; j < 3; ++j)
      if ((c.shared_edges >> (3 * i + j)) & 1U) edge_on_edge(ta, i, tb, j);
  }
}

void ContactClassifier::edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb) {
  set_axis(sectors_, a_, ta, edge);
  add_edge_star(sectors_, a_, ta, edge, false);
  add_face(sectors_, b_, tb, true);
  sectors_.classify(a_.solid(), b_.solid(), found_.overlap);
}

void ContactClassifier::edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge) {
  set_axis(sectors_, b_, tb, edge);
  add_face(sectors_, a_, ta, false);
  add_edge_star(sectors_, b_, tb, edge, true);
  sectors_.classify(a_.solid(), b_.solid(), found_.overlap);
}

void ContactClassifier::edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b) {
  set_axis(sectors_, a_, ta, edge_a);
  add_edge_star(sectors_, a_, ta, edge_a, false);
  add_edge_star(sectors_, b_, tb, edge_b, true);
  sectors_.classify(a_.solid(), b_.solid(), found_.overlap);
}

/// Classifies an edge whose neighbourhood in either part is given by half-planes round it.
template <class AddRays>
void ContactClassifier::classify_boundary_edge(std::uint32_t ta, std::uint32_t tb,
                                               const Vec3d& point, const AddRays& add_rays) {
  if (!found_.boundaries_meet) record_contact_at(ta, tb, point);
  insert_linear(ta, tb);
  const bool had_interiors = found_.overlap.interiors;
  add_rays();
  sectors_.classify(a_.solid(), b_.solid(), found_.overlap);
  if (found_.overlap.interiors && !had_interiors) record_contact_at(ta, tb, point);
}

void ContactClassifier::add_boundary_edge_in_face_of_b(const TriangleEdge& side, std::uint32_t tb,
                                                       const Vec3d& point) {
  classify_boundary_edge(side.triangle, tb, point, [&] {
    set_axis(sectors_, a_, side.triangle, side.number);
    add_edge_star(sectors_, a_, side.triangle, side.number, false);
    add_coordinate_face(sectors_, b_, tb, true);
  });
}

void ContactClassifier::add_boundary_edge_in_face_of_a(const TriangleEdge& side, std::uint32_t ta,
                                                       const Vec3d& point) {
  classify_boundary_edge(ta, side.triangle, point, [&] {
    set_axis(sectors_, b_, side.triangle, side.number);
    add_coordinate_face(sectors_, a_, ta, false);
    add_edge_star(sectors_, b_, side.triangle, side.number, true);
  });
}

void ContactClassifier::take(const BoundaryIntersection& more) {
  const bool adds_contact =
      more.boundaries_meet &&
      (!found_.boundaries_meet || (more.overlap.interiors && !found_.overlap.interiors));
  if (adds_contact) {
    found_.boundaries_meet = true;
    found_.triangle_a = more.triangle_a;
    found_.triangle_b = more.triangle_b;
    found_.point = more.point;
  }
  found_.overlap.interiors |= more.overlap.interiors;
  found_.overlap.a_leaves_b |= more.overlap.a_leaves_b;
  found_.overlap.b_leaves_a |= more.overlap.b_leaves_a;
  found_.flush |= more.flush;
  found_.separated |= more.separated;
  found_.linear_a.insert(more.linear_a);
  found_.linear_b.insert(more.linear_b);
}

namespace {

/// One touching pair among so many pairs of triangles counts as often.
constexpr std::uint64_t kOften = 8;

/// Some triangles of a part, or none.
SlabPiece piece_of(const PairLocalPart& view, std::span<const std::uint32_t> triangles) {
  return {&view.part(), triangles.empty() ? TriangleBvh() : TriangleBvh(view.part(), triangles)};
}

class BoundaryTraversal {
 public:
  /// `whole`: the views hold all of the parts, so that separating planes may be sought.
  BoundaryTraversal(const PairLocalPart& a, const PairLocalPart& b, bool whole)
      : a_(a), b_(b), whole_(whole), classifier_(a, b, whole) {}

  /// Traverses everything, with the team where it is heavy.
  BoundaryIntersection run(QueryContext& work);

 private:
  /// The triangles of a leaf of a, prepared as they are needed; kept until another leaf is loaded.
  struct LoadedLeaf {
    const TriangleBvh::Node* node = nullptr;
    std::array<Box3l, TriangleBvh::kLeafSize> box;
    std::array<std::optional<ExactTriangle>, TriangleBvh::kLeafSize> triangle;
  };

  bool traverse_by_heights(QueryContext& work);
  bool traverse_coplanar_faces(QueryContext& work);
  void traverse_some(const SlabPiece& of_a, const SlabPiece& of_b, QueryContext& work);
  void traverse_piece(const PairLocalPart& a, const PairLocalPart& b, QueryContext& work);
  void classify_boundary_edges(const CoplanarFaces& plane, const TriangleBvh& tree_a,
                               const TriangleBvh& tree_b);
  TraversalEnd go_on(DualTraversal& traversal, std::uint64_t limit);
  void finish(DualTraversal& traversal, std::uint64_t node_pairs_visited, QueryContext& work);
  bool traverse_along_slivers(QueryContext& work);
  void share(DualTraversal& traversal, const QueryContext& work);
  template <class Entry, class Run>
  void share_out(const std::vector<Entry>& pieces, const QueryContext& work, const Run& run);
  void take(const BoundaryTraversal& piece);
  bool near(const TriangleBvh::Node& na, const TriangleBvh::Node& nb);
  bool leaves(const TriangleBvh::Node& na, const TriangleBvh::Node& nb);  ///< whether to go on
  void load(const TriangleBvh::Node& leaf);

  PairLocalPart a_, b_;
  bool whole_;
  ContactClassifier classifier_;
  QueryStats cost_;
  LoadedLeaf leaf_;
};

BoundaryIntersection BoundaryTraversal::run(QueryContext& work) {
  DualTraversal traversal(a_.tree(), b_.tree());
  traversal.start();
  const std::uint64_t before_flat = std::min(node_pairs_before_slabs(a_, b_), kSequentialNodePairs);
  if (go_on(traversal, before_flat) == TraversalEnd::left_off && !traverse_coplanar_faces(work) &&
      !traverse_by_heights(work))
    finish(traversal, before_flat, work);
  work += cost_;
  return classifier_.found();
}

/// Finishes a traversal after so many node pairs.
void BoundaryTraversal::finish(DualTraversal& traversal, std::uint64_t node_pairs_visited,
                               QueryContext& work) {
  // Rotating the parts costs as much as a traversal of some node pairs per triangle.
  const std::uint64_t before_rotation =
      std::min(8 * node_pairs_before_slabs(a_, b_), kSequentialNodePairs);
  if (go_on(traversal, before_rotation - node_pairs_visited) != TraversalEnd::left_off) return;
  // Where every few pairs of triangles touch, other boxes would overlap nearly as often.
  if ((kOften * classifier_.touches() > cost_.triangle_pairs || !traverse_along_slivers(work)) &&
      go_on(traversal, kSequentialNodePairs - before_rotation) == TraversalEnd::left_off)
    share(traversal, work);
}

/// Traverses everything again in a frame along the parts' slivers, if there are such; what has been
/// found so far is kept.
bool BoundaryTraversal::traverse_along_slivers(QueryContext& work) {
  const auto aligned = rotate_along_slivers(a_, b_, work.context());
  if (!aligned) return false;
  const auto run = [&](BoundaryTraversal& piece, DistanceTraversal& traversal,
                       std::uint64_t limit) {
    return traversal.run(
        0.0,
        [&](const NearTrianglePair& pair) {
          return piece.classifier_.classify_pair(pair.a, pair.b);
        },
        limit);
  };
  // Overlapping boxes suffice to classify a pair: bounds on its distance take longer.
  constexpr double kAny = std::numeric_limits<double>::infinity();
  QueryContext own;
  DistanceTraversal traversal(a_, b_, own, kAny, &*aligned);
  traversal.start(0);
  const TraversalEnd end = run(*this, traversal, kSequentialNodePairs);
  cost_ += own;
  if (end != TraversalEnd::left_off) return true;
  share_out(traversal.rest(0, kTraversalPieces), work,
            [&](BoundaryTraversal& piece, const DistanceTraversal::Entry& entry) {
              QueryContext of_piece;
              DistanceTraversal below(a_, b_, of_piece, kAny, &*aligned);
              below.start(entry);
              run(piece, below, DualTraversal::kNoLimit);
              piece.cost_ += of_piece;
            });
  return true;
}

/// Whether the heights of flat faces separate most of two surfaces that have not met so far; pairs
/// that they leave open are traversed.
bool BoundaryTraversal::traverse_by_heights(QueryContext& work) {
  if (classifier_.found().boundaries_meet) return false;
  const auto pieces = partition_by_height(a_, b_, {.apart = std::numeric_limits<double>::min()});
  if (!pieces) return false;
  for (const SlabPartition::Pair& pair : pieces->open) {
    if (classifier_.found().decided()) break;
    traverse_piece(pair.a->view(a_.shift()), pair.b->view(b_.shift()), work);
  }
  return true;
}

/// Traverses some triangles of either part.
void BoundaryTraversal::traverse_piece(const PairLocalPart& a, const PairLocalPart& b,
                                       QueryContext& work) {
  BoundaryTraversal piece(a, b, false);
  DualTraversal traversal(a.tree(), b.tree());
  traversal.start();
  piece.finish(traversal, 0, work);
  take(piece);
}

/// Handles coplanar faces of two solids in a coordinate plane. If their triangles fan out from a
/// corner of each, all pairs of them touch. The boundaries of the faces already give the result:
/// round any other edge of their triangles either part is just a half-space.
bool BoundaryTraversal::traverse_coplanar_faces(QueryContext& work) {
  if (!a_.solid() || !b_.solid()) return false;
  const std::vector<CoplanarFaces> planes = find_coplanar_faces(a_, b_);
  if (planes.empty()) return false;
  std::vector<bool> done_a(a_.part().triangles.size()), done_b(b_.part().triangles.size());
  for (const CoplanarFaces& plane : planes) {
    if (classifier_.found().decided()) return true;
    const SlabPiece in_a = piece_of(a_, plane.a), in_b = piece_of(b_, plane.b);
    classify_boundary_edges(plane, in_a.tree, in_b.tree);
    traverse_some(in_a, piece_of(b_, plane.through_b), work);
    traverse_some(piece_of(a_, plane.through_a), in_b, work);
    for (const std::uint32_t t : plane.a) done_a[t] = true;
    for (const std::uint32_t t : plane.b) done_b[t] = true;
  }
  const auto rest = [](const std::vector<bool>& done) {
    std::vector<std::uint32_t> left;
    for (std::uint32_t t = 0; t < done.size(); ++t)
      if (!done[t]) left.push_back(t);
    return left;
  };
  traverse_some(piece_of(a_, rest(done_a)), piece_of(b_, rest(done_b)), work);
  // Contacts in single points have not been visited; where there are no others, one is a touch.
  return classifier_.found().boundaries_meet;
}

void BoundaryTraversal::traverse_some(const SlabPiece& of_a, const SlabPiece& of_b,
                                      QueryContext& work) {
  if (classifier_.found().decided() || of_a.tree.nodes().empty() || of_b.tree.nodes().empty())
    return;
  traverse_piece(of_a.view(a_.shift()), of_b.view(b_.shift()), work);
}

void BoundaryTraversal::classify_boundary_edges(const CoplanarFaces& plane,
                                                const TriangleBvh& tree_a,
                                                const TriangleBvh& tree_b) {
  const FaceBoundary rim_a(a_, plane.a, plane.axis), rim_b(b_, plane.b, plane.axis);
  // Near the other boundary its triangles are tested; elsewhere an edge lies in one face as a
  // whole, or in none.
  const auto classify = [&](const FaceBoundary& rim, const FaceBoundary& other,
                            const PairLocalPart& view, const TriangleBvh& tree,
                            const auto& classify_triangles, const auto& classify_in_face) {
    for (const TriangleEdge& side : rim.sides()) {
      if (classifier_.found().overlap.complete()) return;
      const std::array<Vec3l, 2> ends = rim.ends(side);
      const Box3l box = box_of(ends);
      if (other.meets(ends)) {
        (void)traverse_bvh(
            tree, [&](const TriangleBvh::Node& node) { return view.box(node.box).meets(box); },
            [&](std::uint32_t t) {
              ++cost_.triangle_pairs;
              return classify_triangles(side.triangle, t);
            });
      } else if (const auto face = other.face_containing(ends[0])) {
        classify_in_face(side, *face, (ends[0] + ends[1]).as<double>() * 0.5);
      }
    }
  };
  classify(
      rim_a, rim_b, b_, tree_b,
      [&](std::uint32_t ta, std::uint32_t tb) { return classifier_.classify_pair(ta, tb); },
      [&](const TriangleEdge& side, std::uint32_t tb, const Vec3d& point) {
        classifier_.add_boundary_edge_in_face_of_b(side, tb, point);
      });
  classify(
      rim_b, rim_a, a_, tree_a,
      [&](std::uint32_t tb, std::uint32_t ta) { return classifier_.classify_pair(ta, tb); },
      [&](const TriangleEdge& side, std::uint32_t ta, const Vec3d& point) {
        classifier_.add_boundary_edge_in_face_of_a(side, ta, point);
      });
}

TraversalEnd BoundaryTraversal::go_on(DualTraversal& traversal, std::uint64_t limit) {
  return traversal.run(
      [&](const TriangleBvh::Node& na, const TriangleBvh::Node& nb) { return near(na, nb); },
      [&](const TriangleBvh::Node& na, const TriangleBvh::Node& nb) { return leaves(na, nb); },
      limit);
}

/// Shares the rest: subtasks are classified independently and merged in the order of a sequential
/// traversal.
void BoundaryTraversal::share(DualTraversal& traversal, const QueryContext& work) {
  const std::vector<NodePair> pieces = traversal.rest(
      [&](const TriangleBvh::Node& na, const TriangleBvh::Node& nb) { return near(na, nb); },
      kTraversalPieces);
  share_out(pieces, work, [&](BoundaryTraversal& piece, const NodePair& pair) {
    DualTraversal below(a_.tree(), b_.tree());
    below.start(pair);
    piece.go_on(below, DualTraversal::kNoLimit);
  });
}

template <class Entry, class Run>
void BoundaryTraversal::share_out(const std::vector<Entry>& pieces, const QueryContext& work,
                                  const Run& run) {
  (void)run_in_doubling_rounds(
      work.context(), pieces,
      [&](std::size_t i) {
        // A separating plane is tested on a whole part, so only one subtask of a round may.
        return BoundaryTraversal(a_, b_, whole_ && i == 0);
      },
      run,
      [&](const BoundaryTraversal& piece) {
        take(piece);
        return !classifier_.found().decided();
      });
}

void BoundaryTraversal::take(const BoundaryTraversal& piece) {
  cost_ += piece.cost_;
  classifier_.take(piece.classifier_.found());
}

bool BoundaryTraversal::near(const TriangleBvh::Node& na, const TriangleBvh::Node& nb) {
  ++cost_.node_pairs;
  return boxes_meet(a_, na.box, b_, nb.box);
}

void BoundaryTraversal::load(const TriangleBvh::Node& leaf) {
  if (leaf_.node == &leaf) return;
  leaf_.node = &leaf;
  for (std::uint32_t i = 0; i < leaf.count; ++i) {
    leaf_.box[i] = box_of(a_.corners(a_.tree().order()[leaf.first + i]));
    leaf_.triangle[i].reset();
  }
}

bool BoundaryTraversal::leaves(const TriangleBvh::Node& na, const TriangleBvh::Node& nb) {
  const Box3l box_a = a_.box(na.box);
  for (std::uint32_t j = 0; j < nb.count; ++j) {
    const std::uint32_t tb = b_.tree().order()[nb.first + j];
    const std::array<Vec3l, 3> corners = b_.corners(tb);
    const Box3l box_b = box_of(corners);
    if (!box_b.meets(box_a)) continue;
    load(na);
    std::optional<ExactTriangle> b;
    for (std::uint32_t i = 0; i < na.count; ++i) {
      if (!leaf_.box[i].meets(box_b)) continue;
      ++cost_.triangle_pairs;
      const std::uint32_t ta = a_.tree().order()[na.first + i];
      if (!leaf_.triangle[i]) leaf_.triangle[i].emplace(a_.corners(ta));
      if (!b) b.emplace(corners);
      if (!classifier_.classify_pair(ta, tb, *leaf_.triangle[i], *b)) return false;
    }
  }
  return true;
}

}  // namespace

BoundaryIntersection intersect_boundaries(const PairLocalPart& a, const PairLocalPart& b,
                                          QueryContext& work) {
  return BoundaryTraversal(a, b, true).run(work);
}

}  // namespace strake::geometry
