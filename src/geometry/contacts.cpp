// SPDX-License-Identifier: Apache-2.0
#include "geometry/contacts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/axis_rays.hpp"
#include "geometry/box.hpp"
#include "geometry/dual_walk.hpp"
#include "geometry/flat_pieces.hpp"
#include "geometry/flush_planes.hpp"
#include "geometry/heavy_rounds.hpp"
#include "geometry/heavy_walk.hpp"
#include "geometry/plane_rim.hpp"
#include "geometry/plane_sides.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

/// Planes of triangles in contact, and of triangles apart, that are tried for separating the parts.
constexpr int kSeparationTries = 4;
constexpr int kPartingTries = 16;

/// Some triangles of a part, or none.
FlatPiece piece_of(const PartView& view, std::span<const std::uint32_t> triangles) {
  return {&view.part(), triangles.empty() ? PartTree() : PartTree(view.part(), triangles)};
}

class ContactWalk {
 public:
  ContactWalk(const PartView& a, const PartView& b) : a_(a), b_(b) {}

  /// Everything, with the team's help where it is heavy.
  Contacts run(PairWork& work);

 private:
  /// The triangles of a leaf of a, prepared as they are needed; kept until another leaf is loaded.
  struct LoadedLeaf {
    const PartTree::Node* node = nullptr;
    std::array<Box3l, PartTree::kLeafSize> box;
    std::array<std::optional<ExactTriangle>, PartTree::kLeafSize> triangle;
  };

  bool settle_by_heights(PairWork& work);
  bool settle_flush(PairWork& work);
  void walk_some(const FlatPiece& of_a, const FlatPiece& of_b, PairWork& work);
  void walk_piece(const PartView& a, const PartView& b, PairWork& work);
  void judge_rims(const FlushPlane& plane, const PartTree& tree_a, const PartTree& tree_b);
  WalkEnd go_on(DualWalk& walk, std::uint64_t most);
  void finish(DualWalk& walk, std::uint64_t walked, PairWork& work);
  bool walk_aligned(PairWork& work);
  void share(DualWalk& walk, const PairWork& work);
  template <class Entry, class Run>
  void share_out(const std::vector<Entry>& pieces, const PairWork& work, const Run& run);
  void take(const ContactWalk& piece);
  bool near(const PartTree::Node& na, const PartTree::Node& nb);
  // These tell whether to go on.
  bool leaves(const PartTree::Node& na, const PartTree::Node& nb);
  bool judge_pair(std::uint32_t ta, std::uint32_t tb);
  bool judge_pair(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                  const ExactTriangle& b);
  bool found(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a, const ExactTriangle& b,
             const TriangleContact& c);
  void stand_at(std::uint32_t ta, std::uint32_t tb, const Vec3d& point);
  void insert_linear(std::uint32_t ta, std::uint32_t tb);

  bool separated(const ExactTriangle& a, const ExactTriangle& b);
  bool parted(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c);
  void load(const PartTree::Node& leaf);
  void judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void judge_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c);
  void edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb);
  void edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge);
  void edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b);

  PartView a_, b_;
  PairCost cost_;
  Contacts found_;
  LoadedLeaf leaf_;
  bool whole_ = true;  ///< to try whether a plane parts all triangles; the trees hold them all
  int separation_tries_ = 0, parting_tries_ = 0;
  Sectors sectors_;
};

Contacts ContactWalk::run(PairWork& work) {
  DualWalk walk(a_.tree(), b_.tree());
  walk.start();
  const std::uint64_t before_flat = std::min(walked_before_flat(a_, b_), kWalkedAlone);
  if (go_on(walk, before_flat) == WalkEnd::left_off && !settle_flush(work) &&
      !settle_by_heights(work))
    finish(walk, before_flat, work);
  work += cost_;
  return found_;
}

/// The rest of a walk of which so many node pairs are behind it.
void ContactWalk::finish(DualWalk& walk, std::uint64_t walked, PairWork& work) {
  // Turning the parts costs as much as a walk of some node pairs a triangle.
  const std::uint64_t before_turned = std::min(8 * walked_before_flat(a_, b_), kWalkedAlone);
  if (go_on(walk, before_turned - walked) == WalkEnd::left_off && !walk_aligned(work) &&
      go_on(walk, kWalkedAlone - before_turned) == WalkEnd::left_off)
    share(walk, work);
}

/// Everything once more in a frame along the parts' needles, if there are such: what has been found
/// so far stays found.
bool ContactWalk::walk_aligned(PairWork& work) {
  const auto aligned = aligned_parts(a_, b_, work.context());
  if (!aligned) return false;
  const auto run = [&](ContactWalk& piece, NearWalk& walk, std::uint64_t most) {
    return walk.run(
        0.0, [&](const NearTriangles& pair) { return piece.judge_pair(pair.a, pair.b); }, most);
  };
  PairWork own;
  NearWalk walk(a_, b_, own, -1, &*aligned);
  walk.start(0);
  const WalkEnd end = run(*this, walk, kWalkedAlone);
  cost_ += own;
  if (end != WalkEnd::left_off) return true;
  share_out(walk.rest(0, kWalkPieces), work, [&](ContactWalk& piece, const NearWalk::Entry& entry) {
    PairWork of_piece;
    NearWalk below(a_, b_, of_piece, -1, &*aligned);
    below.start(entry);
    run(piece, below, DualWalk::kNoLimit);
    piece.cost_ += of_piece;
  });
  return true;
}

/// Whether the heights of flat faces part what they can of two surfaces that have not met so far;
/// what they leave open is walked.
bool ContactWalk::settle_by_heights(PairWork& work) {
  if (found_.boundaries_meet) return false;
  const auto pieces = parted_by_heights(a_, b_, {.apart = std::numeric_limits<double>::min()});
  if (!pieces) return false;
  for (const FlatPieces::Pair& pair : pieces->open) {
    if (found_.decided()) break;
    walk_piece(pair.a->view(a_.shift()), pair.b->view(b_.shift()), work);
  }
  return true;
}

/// Some triangles of either part.
void ContactWalk::walk_piece(const PartView& a, const PartView& b, PairWork& work) {
  ContactWalk piece(a, b);
  piece.whole_ = false;
  DualWalk walk(a.tree(), b.tree());
  walk.start();
  piece.finish(walk, 0, work);
  take(piece);
}

/// Faces of two solids in one coordinate plane whose triangles fan out from a corner of each touch
/// in all pairs of them. What these say of the parts is said by the rims of the faces: round any
/// other side of their triangles either part is but a half-space.
bool ContactWalk::settle_flush(PairWork& work) {
  if (!a_.solid() || !b_.solid()) return false;
  const std::vector<FlushPlane> planes = flush_planes(a_, b_);
  if (planes.empty()) return false;
  std::vector<bool> done_a(a_.part().triangles.size()), done_b(b_.part().triangles.size());
  for (const FlushPlane& plane : planes) {
    if (found_.decided()) return true;
    const FlatPiece in_a = piece_of(a_, plane.a), in_b = piece_of(b_, plane.b);
    judge_rims(plane, in_a.tree, in_b.tree);
    walk_some(in_a, piece_of(b_, plane.through_b), work);
    walk_some(piece_of(a_, plane.through_a), in_b, work);
    for (const std::uint32_t t : plane.a) done_a[t] = true;
    for (const std::uint32_t t : plane.b) done_b[t] = true;
  }
  const auto rest = [](const std::vector<bool>& done) {
    std::vector<std::uint32_t> left;
    for (std::uint32_t t = 0; t < done.size(); ++t)
      if (!done[t]) left.push_back(t);
    return left;
  };
  walk_some(piece_of(a_, rest(done_a)), piece_of(b_, rest(done_b)), work);
  // Contacts in single points have not been looked at; where there are no others, one is a touch.
  return found_.boundaries_meet;
}

void ContactWalk::walk_some(const FlatPiece& of_a, const FlatPiece& of_b, PairWork& work) {
  if (found_.decided() || of_a.tree.nodes().empty() || of_b.tree.nodes().empty()) return;
  walk_piece(of_a.view(a_.shift()), of_b.view(b_.shift()), work);
}

void ContactWalk::judge_rims(const FlushPlane& plane, const PartTree& tree_a,
                             const PartTree& tree_b) {
  const PlaneRim rim_a(a_, plane.a, plane.axis), rim_b(b_, plane.b, plane.axis);
  // Near the other rim the triangles there are looked at, elsewhere a side lies in one face as a
  // whole, or in none.
  const auto judge = [&](const PlaneRim& rim, const PlaneRim& other, const PartView& view,
                         const PartTree& tree, const auto& judge_triangles,
                         const auto& judge_in_face) {
    for (const TriangleSide& side : rim.sides()) {
      if (found_.overlap.complete()) return;
      const std::array<Vec3l, 2> ends = rim.ends(side);
      const Box3l box = box_of(ends);
      if (other.meets(ends)) {
        (void)walk_tree(
            tree, [&](const PartTree::Node& node) { return view.box(node.box).meets(box); },
            [&](std::uint32_t t) {
              ++cost_.triangle_pairs;
              return judge_triangles(side.triangle, t);
            });
      } else if (const auto face = other.face_round(ends[0])) {
        judge_in_face(side, *face, (ends[0] + ends[1]).as<double>() * 0.5);
      }
    }
  };
  const auto in_face = [&](std::uint32_t ta, std::uint32_t tb, const Vec3d& point,
                           const auto& add_rays) {
    if (!found_.boundaries_meet) stand_at(ta, tb, point);
    insert_linear(ta, tb);
    const bool had_interiors = found_.overlap.interiors;
    add_rays();
    sectors_.judge(true, true, found_.overlap);
    if (found_.overlap.interiors && !had_interiors) stand_at(ta, tb, point);
  };
  judge(
      rim_a, rim_b, b_, tree_b,
      [&](std::uint32_t ta, std::uint32_t tb) { return judge_pair(ta, tb); },
      [&](const TriangleSide& side, std::uint32_t tb, const Vec3d& point) {
        in_face(side.triangle, tb, point, [&] {
          start_axis(sectors_, a_, side.triangle, side.number);
          add_star(sectors_, a_, side.triangle, side.number, false);
          add_coordinate_face(sectors_, b_, tb, true);
        });
      });
  judge(
      rim_b, rim_a, a_, tree_a,
      [&](std::uint32_t tb, std::uint32_t ta) { return judge_pair(ta, tb); },
      [&](const TriangleSide& side, std::uint32_t ta, const Vec3d& point) {
        in_face(ta, side.triangle, point, [&] {
          start_axis(sectors_, b_, side.triangle, side.number);
          add_coordinate_face(sectors_, a_, ta, false);
          add_star(sectors_, b_, side.triangle, side.number, true);
        });
      });
}

WalkEnd ContactWalk::go_on(DualWalk& walk, std::uint64_t most) {
  return walk.run(
      [&](const PartTree::Node& na, const PartTree::Node& nb) { return near(na, nb); },
      [&](const PartTree::Node& na, const PartTree::Node& nb) { return leaves(na, nb); }, most);
}

/// What is left, in pieces that are judged apart and taken in the order of a single walk.
void ContactWalk::share(DualWalk& walk, const PairWork& work) {
  const std::vector<NodePair> pieces =
      walk.rest([&](const PartTree::Node& na, const PartTree::Node& nb) { return near(na, nb); },
                kWalkPieces);
  share_out(pieces, work, [&](ContactWalk& piece, const NodePair& pair) {
    DualWalk below(a_.tree(), b_.tree());
    below.start(pair);
    piece.go_on(below, DualWalk::kNoLimit);
  });
}

template <class Entry, class Run>
void ContactWalk::share_out(const std::vector<Entry>& pieces, const PairWork& work,
                            const Run& run) {
  (void)run_in_rounds(
      work.context(), pieces,
      [&](std::size_t i) {
        ContactWalk piece(a_, b_);
        // A plane that separates is looked for over a whole part: one piece of a round may.
        piece.whole_ = whole_ && i == 0;
        return piece;
      },
      run,
      [&](const ContactWalk& piece) {
        take(piece);
        return !found_.decided();
      });
}

void ContactWalk::take(const ContactWalk& piece) {
  cost_ += piece.cost_;
  const Contacts& more = piece.found_;
  const bool says_more =
      more.boundaries_meet &&
      (!found_.boundaries_meet || (more.overlap.interiors && !found_.overlap.interiors));
  if (says_more) {
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

bool ContactWalk::near(const PartTree::Node& na, const PartTree::Node& nb) {
  ++cost_.node_pairs;
  return boxes_meet(a_, na.box, b_, nb.box);
}

void ContactWalk::load(const PartTree::Node& leaf) {
  if (leaf_.node == &leaf) return;
  leaf_.node = &leaf;
  for (std::uint32_t i = 0; i < leaf.count; ++i) {
    leaf_.box[i] = box_of(a_.corners(a_.tree().order()[leaf.first + i]));
    leaf_.triangle[i].reset();
  }
}

bool ContactWalk::leaves(const PartTree::Node& na, const PartTree::Node& nb) {
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
      if (!judge_pair(ta, tb, *leaf_.triangle[i], *b)) return false;
    }
  }
  return true;
}

bool ContactWalk::judge_pair(std::uint32_t ta, std::uint32_t tb) {
  return judge_pair(ta, tb, a_.triangle(ta), b_.triangle(tb));
}

bool ContactWalk::judge_pair(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                             const ExactTriangle& b) {
  const TriangleContact c = contact(a, b);
  return c.touch == Touch::none ? !parted(a, b, c) : found(ta, tb, a, b, c);
}

/// Two triangles apart often lie on a flat side of one part with all of the other beyond it.
bool ContactWalk::parted(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c) {
  const auto positive = [](const CornerSides& s) { return s[0] > 0 && s[1] > 0 && s[2] > 0; };
  if (!whole_ || found_.boundaries_meet || parting_tries_ >= kPartingTries) return false;
  const bool a_beyond_b = positive(c.side_a), b_beyond_a = positive(c.side_b);
  if (!a_beyond_b && !b_beyond_a) return false;
  ++parting_tries_;
  found_.separated = a_beyond_b ? parts_strictly(b, b_, a_) : parts_strictly(a, a_, b_);
  return found_.separated;
}

bool ContactWalk::found(std::uint32_t ta, std::uint32_t tb, const ExactTriangle& a,
                        const ExactTriangle& b, const TriangleContact& c) {
  if (!found_.boundaries_meet) stand_at(ta, tb, common_point(a, b, c));
  if (whole_ && !found_.overlap.interiors && separation_tries_ < kSeparationTries &&
      separated(a, b)) {
    found_.separated = true;
    return false;
  }
  const bool had_interiors = found_.overlap.interiors;
  judge(ta, tb, c);
  // The point of a crossing says more than the point of a touch found before it.
  if (found_.overlap.interiors && !had_interiors) stand_at(ta, tb, common_point(a, b, c));
  return !found_.overlap.complete();
}

void ContactWalk::stand_at(std::uint32_t ta, std::uint32_t tb, const Vec3d& point) {
  found_.boundaries_meet = true;
  found_.triangle_a = ta;
  found_.triangle_b = tb;
  found_.point = point;
}

void ContactWalk::insert_linear(std::uint32_t ta, std::uint32_t tb) {
  found_.linear_a.insert(shell_of(a_.part(), ta));
  found_.linear_b.insert(shell_of(b_.part(), tb));
}

bool ContactWalk::separated(const ExactTriangle& a, const ExactTriangle& b) {
  ++separation_tries_;
  // A solid lies below the planes of its own flat sides; a sheet may lie on either.
  if (separates(a, a_, b_) || separates(b, b_, a_)) return true;
  return (!a_.solid() && separates(a, b_, a_)) || (!b_.solid() && separates(b, a_, b_));
}

void ContactWalk::judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  if (c.touch == Touch::point) return;
  insert_linear(ta, tb);
  if (c.coplanar)
    judge_coplanar(ta, tb, c);
  else
    judge_crossing(ta, tb, c);
}

/// Adds what a triangle's corners off the other's plane say, where the triangles meet along a
/// segment through the other's interior: there the other part is a half-space, or itself.
void judge_corners(const CornerSides& sides, bool crosser_solid, bool face_solid, bool& interiors,
                   bool& crosser_leaves, bool& face_leaves) {
  const bool below = sides[0] < 0 || sides[1] < 0 || sides[2] < 0;
  const bool above = sides[0] > 0 || sides[1] > 0 || sides[2] > 0;
  if (face_solid) {
    interiors |= below;
    crosser_leaves |= above;
    face_leaves |= below && crosser_solid;
  } else {
    // A sheet: the crossing triangle leaves it on either side.
    crosser_leaves = true;
  }
}

void ContactWalk::judge_crossing(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
  if (c.edge_b < 0)
    judge_corners(c.side_a, a_.solid(), b_.solid(), found_.overlap.interiors,
                  found_.overlap.a_leaves_b, found_.overlap.b_leaves_a);
  if (c.edge_a < 0)
    judge_corners(c.side_b, b_.solid(), a_.solid(), found_.overlap.interiors,
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

void ContactWalk::judge_coplanar(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
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

void ContactWalk::edge_in_face_of_b(std::uint32_t ta, int edge, std::uint32_t tb) {
  start_axis(sectors_, a_, ta, edge);
  add_star(sectors_, a_, ta, edge, false);
  add_face(sectors_, b_, tb, true);
  sectors_.judge(a_.solid(), b_.solid(), found_.overlap);
}

void ContactWalk::edge_in_face_of_a(std::uint32_t ta, std::uint32_t tb, int edge) {
  start_axis(sectors_, b_, tb, edge);
  add_face(sectors_, a_, ta, false);
  add_star(sectors_, b_, tb, edge, true);
  sectors_.judge(a_.solid(), b_.solid(), found_.overlap);
}

void ContactWalk::edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b) {
  start_axis(sectors_, a_, ta, edge_a);
  add_star(sectors_, a_, ta, edge_a, false);
  add_star(sectors_, b_, tb, edge_b, true);
  sectors_.judge(a_.solid(), b_.solid(), found_.overlap);
}

}  // namespace

Contacts find_contacts(const PartView& a, const PartView& b, PairWork& work) {
  return ContactWalk(a, b).run(work);
}

}  // namespace strake::geometry
