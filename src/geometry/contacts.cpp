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

#include "geometry/box.hpp"
#include "geometry/contact_judge.hpp"
#include "geometry/dual_walk.hpp"
#include "geometry/flat_pieces.hpp"
#include "geometry/flush_planes.hpp"
#include "geometry/heavy_rounds.hpp"
#include "geometry/heavy_walk.hpp"
#include "geometry/plane_rim.hpp"
#include "geometry/tree_walk.hpp"

namespace strake::geometry {
namespace {

/// Of so many pairs of triangles one that touches is often.
constexpr std::uint64_t kOften = 8;

/// Some triangles of a part, or none.
FlatPiece piece_of(const PartView& view, std::span<const std::uint32_t> triangles) {
  return {&view.part(), triangles.empty() ? PartTree() : PartTree(view.part(), triangles)};
}

class ContactWalk {
 public:
  /// `whole`: the views hold all of the parts, and a plane between those may be looked for.
  ContactWalk(const PartView& a, const PartView& b, bool whole)
      : a_(a), b_(b), whole_(whole), judge_(a, b, whole) {}

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
  bool leaves(const PartTree::Node& na, const PartTree::Node& nb);  ///< whether to go on
  void load(const PartTree::Node& leaf);

  PartView a_, b_;
  bool whole_;
  ContactJudge judge_;
  PairCost cost_;
  LoadedLeaf leaf_;
};

Contacts ContactWalk::run(PairWork& work) {
  DualWalk walk(a_.tree(), b_.tree());
  walk.start();
  const std::uint64_t before_flat = std::min(walked_before_flat(a_, b_), kWalkedAlone);
  if (go_on(walk, before_flat) == WalkEnd::left_off && !settle_flush(work) &&
      !settle_by_heights(work))
    finish(walk, before_flat, work);
  work += cost_;
  return judge_.found();
}

/// The rest of a walk of which so many node pairs are behind it.
void ContactWalk::finish(DualWalk& walk, std::uint64_t walked, PairWork& work) {
  // Turning the parts costs as much as a walk of some node pairs a triangle.
  const std::uint64_t before_turned = std::min(8 * walked_before_flat(a_, b_), kWalkedAlone);
  if (go_on(walk, before_turned - walked) != WalkEnd::left_off) return;
  // Where one pair of triangles in a few touches, other boxes would meet nearly as often.
  if ((kOften * judge_.touches() > cost_.triangle_pairs || !walk_aligned(work)) &&
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
        0.0, [&](const NearTriangles& pair) { return piece.judge_.judge_pair(pair.a, pair.b); },
        most);
  };
  // Boxes that meet are reason enough to judge a pair: bounds on its distance take longer.
  constexpr double kAny = std::numeric_limits<double>::infinity();
  PairWork own;
  NearWalk walk(a_, b_, own, kAny, &*aligned);
  walk.start(0);
  const WalkEnd end = run(*this, walk, kWalkedAlone);
  cost_ += own;
  if (end != WalkEnd::left_off) return true;
  share_out(walk.rest(0, kWalkPieces), work, [&](ContactWalk& piece, const NearWalk::Entry& entry) {
    PairWork of_piece;
    NearWalk below(a_, b_, of_piece, kAny, &*aligned);
    below.start(entry);
    run(piece, below, DualWalk::kNoLimit);
    piece.cost_ += of_piece;
  });
  return true;
}

/// Whether the heights of flat faces part what they can of two surfaces that have not met so far;
/// what they leave open is walked.
bool ContactWalk::settle_by_heights(PairWork& work) {
  if (judge_.found().boundaries_meet) return false;
  const auto pieces = parted_by_heights(a_, b_, {.apart = std::numeric_limits<double>::min()});
  if (!pieces) return false;
  for (const FlatPieces::Pair& pair : pieces->open) {
    if (judge_.found().decided()) break;
    walk_piece(pair.a->view(a_.shift()), pair.b->view(b_.shift()), work);
  }
  return true;
}

/// Some triangles of either part.
void ContactWalk::walk_piece(const PartView& a, const PartView& b, PairWork& work) {
  ContactWalk piece(a, b, false);
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
    if (judge_.found().decided()) return true;
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
  return judge_.found().boundaries_meet;
}

void ContactWalk::walk_some(const FlatPiece& of_a, const FlatPiece& of_b, PairWork& work) {
  if (judge_.found().decided() || of_a.tree.nodes().empty() || of_b.tree.nodes().empty()) return;
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
      if (judge_.found().overlap.complete()) return;
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
  judge(
      rim_a, rim_b, b_, tree_b,
      [&](std::uint32_t ta, std::uint32_t tb) { return judge_.judge_pair(ta, tb); },
      [&](const TriangleSide& side, std::uint32_t tb, const Vec3d& point) {
        judge_.rim_in_face_of_b(side, tb, point);
      });
  judge(
      rim_b, rim_a, a_, tree_a,
      [&](std::uint32_t tb, std::uint32_t ta) { return judge_.judge_pair(ta, tb); },
      [&](const TriangleSide& side, std::uint32_t ta, const Vec3d& point) {
        judge_.rim_in_face_of_a(side, ta, point);
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
        // A plane that separates is looked for over a whole part: one piece of a round may.
        return ContactWalk(a_, b_, whole_ && i == 0);
      },
      run,
      [&](const ContactWalk& piece) {
        take(piece);
        return !judge_.found().decided();
      });
}

void ContactWalk::take(const ContactWalk& piece) {
  cost_ += piece.cost_;
  judge_.take(piece.judge_.found());
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
      if (!judge_.judge_pair(ta, tb, *leaf_.triangle[i], *b)) return false;
    }
  }
  return true;
}

}  // namespace

Contacts find_contacts(const PartView& a, const PartView& b, PairWork& work) {
  return ContactWalk(a, b, true).run(work);
}

}  // namespace strake::geometry
