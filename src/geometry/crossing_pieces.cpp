// SPDX-License-Identifier: Apache-2.0
#include "geometry/crossing_pieces.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "geometry/axis_rays.hpp"
#include "geometry/dual_walk.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/sectors.hpp"
#include "geometry/sided_sets.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

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
  Finder(const TreedPart& a, const TreedPart& b, std::size_t most, PairWork& work,
         const std::function<bool(const CrossingPiece&)>& enough)
      : a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        most_(most),
        work_(work),
        enough_(enough) {}

  CrossingPieces run() {
    walk();
    areas_.cross(found_.all);
    return std::move(found_);
  }

 private:
  void walk() {
    if (!a_.planted() || !b_.planted()) return;
    walk_both(
        a_.tree(), b_.tree(),
        [&](const PartTree::Node& x, const PartTree::Node& y) {
          ++work_.node_pairs;
          return a_.box(x.box).meets(b_.box(y.box));
        },
        [&](const PartTree::Node& x, const PartTree::Node& y) { return leaves(x, y); });
  }

  bool leaves(const PartTree::Node& x, const PartTree::Node& y) {
    for (std::uint32_t i = x.first; i < x.first + x.count; ++i) {
      const std::uint32_t ta = a_.tree().order()[i];
      const ExactTriangle s = a_.triangle(ta);
      for (std::uint32_t j = y.first; j < y.first + y.count; ++j) {
        const std::uint32_t tb = b_.tree().order()[j];
        ++work_.triangle_pairs;
        judge(ta, tb, contact(s, b_.triangle(tb)));
        if (found_.truncated) return false;
      }
    }
    return true;
  }

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

  PartView a_, b_;
  std::size_t most_;
  PairWork& work_;
  const std::function<bool(const CrossingPiece&)>& enough_;
  CrossingPieces found_;
  CommonAreas areas_;
  Sectors sectors_;
  std::vector<Flush> flush_;
};

}  // namespace

CrossingPieces crossing_pieces(const TreedPart& a, const TreedPart& b, std::size_t most,
                               PairWork& work,
                               const std::function<bool(const CrossingPiece&)>& enough) {
  return Finder(a, b, most, work, enough).run();
}

}  // namespace strake::geometry
