// SPDX-License-Identifier: Apache-2.0
#include "geometry/crossing_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/axis_rays.hpp"
#include "geometry/box.hpp"
#include "geometry/dual_walk.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/sectors.hpp"
#include "geometry/sided_sets.hpp"
#include "geometry/triangle_sweep.hpp"
#include "strake/geometry/crossing_lines.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// Pairs of triangles that lie on each other, joined to areas over the lines where one goes on into
/// the next. Each pair says by b's triangle which side is the outer one; along a join the two may
/// call the same side differently.
class CommonAreas {
 public:
  using Key = std::uint64_t;
  static Key key(const Flush& f) { return (Key{f.a} << 32U) | f.b; }

  void join(const Flush& x, const Flush& y) {
    joins_.push_back({key(x), key(y), x.step == y.step});
  }

  void leave(const Flush& f, const CrossingPiece& piece) {
    if (f.outer || f.inner) leaves_.push_back({key(f), f.outer, f.inner, piece});
  }

  /// Adds where one sheet leaves the other along areas that it leaves on both sides.
  void cross(std::vector<CrossingPiece>& pieces) {
    if (leaves_.empty()) return;
    number();
    SidedSets sets(keys_.size());
    for (const Join& j : joins_) sets.join(index(j.x), index(j.y), j.swapped);
    std::vector<std::array<bool, 2>> sides(keys_.size(), {false, false});
    for (const Leave& l : leaves_) {
      const SidedSets::Root r = sets.find(index(l.key));
      sides[r.root][r.swapped ? 1 : 0] |= l.outer;
      sides[r.root][r.swapped ? 0 : 1] |= l.inner;
    }
    for (const Leave& l : leaves_) {
      const auto& side = sides[sets.find(index(l.key)).root];
      if (side[0] && side[1]) pieces.push_back(l.piece);
    }
  }

 private:
  struct Join {
    Key x = 0, y = 0;
    bool swapped = false;
  };
  struct Leave {
    Key key = 0;
    bool outer = false, inner = false;
    CrossingPiece piece;
  };
  void number() {
    for (const Join& j : joins_) keys_.insert(keys_.end(), {j.x, j.y});
    for (const Leave& l : leaves_) keys_.push_back(l.key);
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }
  [[nodiscard]] std::uint32_t index(Key key) const {
    return static_cast<std::uint32_t>(std::lower_bound(keys_.begin(), keys_.end(), key) -
                                      keys_.begin());
  }

  std::vector<Join> joins_;
  std::vector<Leave> leaves_;
  std::vector<Key> keys_;
};

class Finder {
 public:
  Finder(const PartView& a, const PartView& b, std::size_t most = kAll,
         std::function<bool(const CrossingPiece&)> enough = {})
      : a_(a), b_(b), most_(most), enough_(std::move(enough)) {}

  /// Looks at a pair of triangles; each pair that has more than a point in common must come once.
  /// Whether to go on.
  bool look(std::uint32_t ta, const ExactTriangle& s, std::uint32_t tb, const ExactTriangle& t) {
    ++triangle_pairs_;
    judge(ta, tb, contact(s, t));
    return !found_.truncated;
  }

  CrossingPieces result(PairWork& work) {
    work.triangle_pairs += triangle_pairs_;
    areas_.cross(found_.all);
    return std::move(found_);
  }

 private:
  void judge(std::uint32_t ta, std::uint32_t tb, const TriangleContact& c) {
    if (c.touch == Touch::none || c.touch == Touch::point) return;
    if (!c.coplanar) {
      if (c.edge_a < 0 && c.edge_b < 0)
        add({.a = ta, .b = tb});
      else if (c.edge_b < 0)
        edge_in_face(a_, ta, c.edge_a, b_, tb, false);
      else if (c.edge_a < 0)
        edge_in_face(b_, tb, c.edge_b, a_, ta, true);
      else
        edge_on_edge(ta, c.edge_a, tb, c.edge_b);
      return;
    }
    for (int i = 0; i < 3; ++i) {
      if ((c.edges_of_a_inside_b >> i) & 1U) edge_in_face(a_, ta, i, b_, tb, false);
      if ((c.edges_of_b_inside_a >> i) & 1U) edge_in_face(b_, tb, i, a_, ta, true);
      for (int j = 0; j < 3; ++j)
        if ((c.shared_edges >> (3 * i + j)) & 1U) edge_on_edge(ta, i, tb, j);
    }
  }

  /// Every triangle round an edge meets what the edge meets: one of them is enough.
  static bool speaks_for(const PartView& view, std::uint32_t triangle, int edge) {
    return star(view.part(), triangle, edge).front() == triangle;
  }

  void edge_in_face(const PartView& x, std::uint32_t tx, int edge, const PartView& y,
                    std::uint32_t ty, bool edge_of_b) {
    if (!speaks_for(x, tx, edge)) return;
    start_axis(sectors_, x, tx, edge);
    add_star(sectors_, x, tx, edge, edge_of_b);
    add_face(sectors_, y, ty, !edge_of_b);
    judge_axis(edge_of_b ? CrossingPiece{.a = ty, .b = tx, .edge_b = edge}
                         : CrossingPiece{.a = tx, .b = ty, .edge_a = edge});
  }

  void edge_on_edge(std::uint32_t ta, int edge_a, std::uint32_t tb, int edge_b) {
    if (!speaks_for(a_, ta, edge_a) || !speaks_for(b_, tb, edge_b)) return;
    start_axis(sectors_, a_, ta, edge_a);
    add_star(sectors_, a_, ta, edge_a, false);
    add_star(sectors_, b_, tb, edge_b, true);
    judge_axis({.a = ta, .b = tb, .edge_a = edge_a, .edge_b = edge_b});
  }

  void judge_axis(const CrossingPiece& piece) {
    Overlap overlap;
    sectors_.judge(false, false, overlap);
    if (overlap.interiors) {
      add(piece);
      return;
    }
    // Over two directions the common area goes on; where there are more it forks.
    const bool goes_on = sectors_.find_flush(flush_) == 2;
    for (std::size_t i = 0; i < flush_.size(); ++i) {
      areas_.leave(flush_[i], piece);
      for (std::size_t j = 0; goes_on && j < i; ++j)
        if (flush_[i].direction != flush_[j].direction) areas_.join(flush_[i], flush_[j]);
    }
  }

  void add(const CrossingPiece& piece) {
    found_.truncated = found_.truncated || found_.all.size() == most_;
    if (found_.truncated) return;
    found_.all.push_back(piece);
    found_.truncated = enough_ && enough_(piece);
  }

  const PartView &a_, &b_;
  std::size_t most_;
  std::function<bool(const CrossingPiece&)> enough_;
  std::uint64_t triangle_pairs_ = 0;
  CrossingPieces found_;
  CommonAreas areas_;
  Sectors sectors_;
  std::vector<Flush> flush_;
};

/// The triangles of a leaf, prepared as they are needed; kept until another leaf is loaded.
class LoadedLeaf {
 public:
  explicit LoadedLeaf(const PartView& view) : view_(view) {}

  void load(const PartTree::Node& leaf) {
    if (node_ == &leaf) return;
    node_ = &leaf;
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      box_[i] = box_of(view_.corners(id(i)));
      triangle_[i].reset();
    }
  }
  [[nodiscard]] std::uint32_t count() const { return node_->count; }
  [[nodiscard]] std::uint32_t id(std::uint32_t i) const {
    return view_.tree().order()[node_->first + i];
  }
  [[nodiscard]] const Box3l& box(std::uint32_t i) const { return box_[i]; }
  [[nodiscard]] const ExactTriangle& triangle(std::uint32_t i) {
    if (!triangle_[i]) triangle_[i] = view_.triangle(id(i));
    return *triangle_[i];
  }

 private:
  const PartView& view_;
  const PartTree::Node* node_ = nullptr;
  std::array<Box3l, PartTree::kLeafSize> box_;
  std::array<std::optional<ExactTriangle>, PartTree::kLeafSize> triangle_;
};

/// Shows a finder what the trees of two parts do not keep apart, until it has enough.
void walk_trees(const PartView& a, const PartView& b, Finder& finder, PairWork& work) {
  if (!a.planted() || !b.planted()) return;
  LoadedLeaf leaf_a(a), leaf_b(b);
  walk_both(
      a.tree(), b.tree(),
      [&](const PartTree::Node& x, const PartTree::Node& y) {
        ++work.node_pairs;
        return a.box(x.box).meets(b.box(y.box));
      },
      [&](const PartTree::Node& x, const PartTree::Node& y) {
        leaf_a.load(x);
        leaf_b.load(y);
        for (std::uint32_t i = 0; i < x.count; ++i)
          for (std::uint32_t j = 0; j < y.count; ++j)
            if (leaf_a.box(i).meets(leaf_b.box(j)) &&
                !finder.look(leaf_a.id(i), leaf_a.triangle(i), leaf_b.id(j), leaf_b.triangle(j)))
              return false;
        return true;
      });
}

/// Whether axes are those of the coordinates in some order, but for rounding.
bool along_coordinates(const Axes& axes) {
  return std::ranges::all_of(axes, [](const Vec3d& axis) {
    return std::max({std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)}) > 1 - 1e-12;
  });
}

/// Along the coordinate axes, or those along the faces of the part of more triangles, or of the
/// other, where that makes many pairs fewer.
TriangleSweep sweep_of(const PartView& a, const PartFrame& frame_a, const PartView& b,
                       const PartFrame& frame_b) {
  const std::size_t most = a.part().triangles.size() + b.part().triangles.size();
  TriangleSweep sweep(a, b, nullptr);
  std::size_t pairs = 0;
  if (sweep.run([&](std::uint32_t, std::uint32_t) { return ++pairs <= most; })) return sweep;
  const bool a_first = a.part().triangles.size() >= b.part().triangles.size();
  for (const PartFrame* frame : {a_first ? &frame_a : &frame_b, a_first ? &frame_b : &frame_a}) {
    const Axes axes = square_axes(*frame);
    if (!along_coordinates(axes)) return {a, b, &axes};
  }
  return sweep;
}

}  // namespace

CrossingPieces crossing_pieces(const TreedPart& a, const TreedPart& b, std::size_t most,
                               PairWork& work,
                               const std::function<bool(const CrossingPiece&)>& enough) {
  const PartView x(a, {}), y(b, b.placed.origin - a.placed.origin);
  Finder finder(x, y, most, enough);
  walk_trees(x, y, finder, work);
  return finder.result(work);
}

CrossingPieces crossing_pieces(const FramedPart& a, const FramedPart& b, std::size_t most,
                               PairWork& work) {
  const PartView x({a.placed, a.tree}, {});
  const PartView y({b.placed, b.tree}, b.placed.origin - a.placed.origin);
  Finder finder(x, y, most);
  if (want_trees(x.part(), y.part())) {
    walk_trees(x, y, finder, work);
  } else {
    sweep_of(x, *a.frame, y, *b.frame).run([&](std::uint32_t ta, std::uint32_t tb) {
      return finder.look(ta, x.triangle(ta), tb, y.triangle(tb));
    });
  }
  return finder.result(work);
}

std::vector<CrossingPiece> crossing_pieces_all(const PlacedPart& a, const PlacedPart& b,
                                               PairWork& work) {
  const PartView x({a, nullptr}, {}), y({b, nullptr}, b.origin - a.origin);
  Finder finder(x, y);
  for (std::uint32_t ta = 0; ta < a.part->triangles.size(); ++ta)
    for (std::uint32_t tb = 0; tb < b.part->triangles.size(); ++tb)
      finder.look(ta, x.triangle(ta), tb, y.triangle(tb));
  return finder.result(work).all;
}

}  // namespace strake::geometry
