// SPDX-License-Identifier: Apache-2.0
// The engine: every edge gathers what hides it, front to back, and stops when nothing of it is
// left to be seen. No edge writes to another, so there are no locks and no order to wait for.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "hlr/job.hpp"
#include "hlr/occlusion.hpp"
#include "hlr/stretches.hpp"
#include "hlr/world.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;
using geometry::Vec3l;

constexpr std::uint32_t kFewBodies = 16;
constexpr std::uint32_t kNoBody = 0xffffffffU;
// Beyond 2^52 a double holds view coordinates only roughly: the line test of a query is left out.
constexpr std::int64_t kExactInDouble = std::int64_t{1} << 52;
// What covered tiles say of an edge is cut at multiples of this share.
constexpr std::int64_t kFine = std::int64_t{1} << 30;

struct Work {
  std::uint64_t edges = 0, covered = 0, tests = 0, wide_tests = 0;
};

class Gatherer {
 public:
  explicit Gatherer(const World& world) : world_(world), job_(world.job) {}

  /// What a body's own faces hide of some of its edges.
  void run_on_itself(const Item& item, OwnHits& out, Work& work) {
    body_ = item.body;
    own_ = &world_.placed[body_];
    for (std::uint32_t i = item.first; i < item.last; ++i) {
      out.first.push_back(static_cast<std::uint32_t>(out.hits.size()));
      take(own_->view->edges[i]);
      hits_.clear();
      open_ = OpenRange();
      if (kind_ != EdgeKind::polyline && !projecting_) test_own_body();
      out.hits.insert(out.hits.end(), hits_.begin(), hits_.end());
    }
    work = std::exchange(work_, {});
  }

  void run(const Item& item, std::vector<Piece>& out, Work& work) {
    body_ = item.body;
    own_ = &world_.placed[body_];
    const auto lines = job_.lines.of(own_->object);
    for (std::uint32_t i = item.first; i < item.last; ++i) {
      if (item.lines)
        take(lines[i]);
      else
        take(own_->view->edges[i]);
      draw(item.number + (i - item.first), out);
    }
    work = std::exchange(work_, {});
  }

 private:
  void take(const EdgeView& e) {
    edge_ = &e;
    other_ = own_;
    kind_ = e.edge.kind;
    projecting_ = e.edge.projecting;
    cut_away_ = e.edge.cut_away;
    contact_ = own_->contact;
    a_ = e.edge.a.as<std::int64_t>() + own_->offset;
    b_ = e.edge.b.as<std::int64_t>() + own_->offset;
    va_ = e.a + own_->at;
    vb_ = e.b + own_->at;
  }

  void take(const Line& line) {
    edge_ = nullptr;
    body_ = line.body_a;
    own_ = &world_.placed[line.body_a];
    other_ = &world_.placed[line.body_b];
    kind_ = line.kind;
    cut_away_ = line.cut_away;
    contact_ = std::max({own_->contact, other_->contact, job_.lines.contact});
    a_ = line.a - job_.origin;
    b_ = line.b - job_.origin;
    projecting_ = geometry::cross(b_ - a_, job_.direction()) == Vec3l{};
    va_ = world_.frame(a_);
    vb_ = world_.frame(b_);
  }

  void draw(std::uint32_t number, std::vector<Piece>& out) {
    ++work_.edges;
    stretches_.clear();
    Param lo = Param::zero(), hi = Param::one();
    const bool kept = !cut_away_ && (!(own_->cut || other_->cut) || clip(lo, hi));
    if (!kept)
      stretches_.push_back({Param::zero(), Param::one(), State::clipped});
    else if (projecting_)
      stretches_.push_back({Param::zero(), Param::one(), State::projecting});
    else
      decide(lo, hi);
    for (const Stretch& s : stretches_)
      out.push_back({model::ObjectId{own_->object}, number, kind_, s.state,
                     model::ObjectId{other_->object}, at(s.lo), at(s.hi)});
  }

  [[nodiscard]] Vec3l at(const Param& t) const {
    if (t.num == 0) return a_ + job_.origin;
    if (t.num == t.den) return b_ + job_.origin;
    Vec3l p = a_ + job_.origin;
    for (int k = 0; k < 3; ++k)
      if (a_[k] != b_[k]) p[k] += rounded_share(b_[k] - a_[k], t);
    return p;
  }

  // The part of the edge within the limits; false when there is none of any length.
  bool clip(Param& lo, Param& hi) const {
    for (int k = 0; k < 3; ++k)
      for (const int sign : {1, -1}) {
        const std::int64_t limit = sign > 0 ? job_.limits->lo[k] : job_.limits->hi[k];
        const std::int64_t at_a = sign * (a_[k] - limit), at_b = sign * (b_[k] - limit);
        if (at_a >= 0 && at_b >= 0) continue;
        if (at_a <= 0 && at_b <= 0) return false;
        if (at_a < at_b) {
          const Param root = Param::of(-at_a, at_b - at_a);
          if (less(lo, root)) lo = root;
        } else {
          const Param root = Param::of(at_a, at_a - at_b);
          if (less(root, hi)) hi = root;
        }
        if (!less(lo, hi)) return false;
      }
    return true;
  }

  void decide(const Param& lo, const Param& hi) {
    hits_.clear();
    if (job_.options.stage != Stage::none) {
      open_ = OpenRange(lo, hi);
      if (kind_ != EdgeKind::polyline) gather_own_objects();
      if (!open_.empty() && job_.options.stage == Stage::global) gather_others();
    }
    if (lo.num > 0) stretches_.push_back({Param::zero(), lo, State::clipped});
    if (hits_.empty())
      stretches_.push_back({lo, hi, State::visible});
    else
      maker_.run(hits_, lo, hi, stretches_);
    if (hi.num < hi.den) stretches_.push_back({hi, Param::one(), State::clipped});
  }

  // Hidden-by-self takes precedence, so the own object comes first and, unless it hides the
  // edge wholly, completely.
  void gather_own_objects() {
    if (edge_ != nullptr && own_->opaque) gather_own_body();
    gather_object(own_->object);
    if (other_->object != own_->object) gather_object(other_->object);
  }

  // Its bodies, but for the one that has been gathered already.
  void gather_object(std::uint32_t object) {
    const std::uint32_t known = edge_ != nullptr ? body_ : kNoBody;
    const auto& first_body = job_.scene->first_body;
    const std::uint32_t first = first_body[object], last = first_body[object + 1];
    if ((known != kNoBody && last - first == 1) || (job_.options.culling && open_.empty())) return;
    const auto consider = [&](std::uint32_t b) {
      if (b == known || world_.placed[b].object != object) return true;
      return gather_body(b, true);
    };
    if (last - first <= kFewBodies || !job_.options.culling) {
      for (std::uint32_t b = first; b < last; ++b)
        if (!consider(b)) return;
    } else {
      refresh_segment();
      world_.tree.walk(segment_, consider);
    }
  }

  /// What other objects hide of either end, by what covers whole tiles. A wire may be seen through
  /// the solids of its own object, which cover them too.
  void take_covered_ends() {
    if (world_.coverage.empty() || kind_ == EdgeKind::polyline) return;
    const double lo = open_.lo().value, hi = open_.hi().value;
    const CoveredEnds ends = world_.coverage.covered_ends(va_, vb_, lo, hi);
    if (ends.from >= ends.to) {
      ++work_.covered;
      add(Hit{open_.lo(), open_.hi(), kBothSides, false});
      return;
    }
    const Param from = Param::of(static_cast<std::int64_t>(ends.from * kFine) - 1, kFine);
    const Param to = Param::of(static_cast<std::int64_t>(ends.to * kFine) + 2, kFine);
    if (less(open_.lo(), from)) add(Hit{open_.lo(), from, kBothSides, false});
    if (less(to, open_.hi())) add(Hit{to, open_.hi(), kBothSides, false});
  }

  void gather_others() {
    take_covered_ends();
    if (open_.empty()) return;
    const auto consider = [&](std::uint32_t b) {
      const std::uint32_t object = world_.placed[b].object;
      return object == own_->object || object == other_->object || gather_body(b, false);
    };
    if (job_.options.culling) {
      refresh_segment();
      world_.tree.walk(segment_, consider);
    } else {
      for (std::uint32_t b = 0; b < world_.placed.size(); ++b) consider(b);
    }
  }

  void gather_own_body() {
    if (!own_->shares_own_hits) return test_own_body();
    const OwnHits& known = world_.own_hits[job_.seen.of[body_]];
    for (const Hit& hit : known.of(static_cast<std::uint32_t>(edge_ - own_->view->edges.data())))
      if (!add(hit)) return;
  }

  void test_own_body() {
    // Limits may cut away what hides: then the convex part's short cut does not hold.
    const bool judged = !own_->cut && (edge_->surely_behind_part || edge_->surely_clear_of_part);
    if (judged && edge_->surely_behind_part) {
      add(Hit{Param::zero(), Param::one(), kBothSides, true});
      if (job_.options.culling) return;
    }
    const LocalEdge local = localized(*own_);
    for (const PartView& part : own_->view->parts) {
      const bool same = own_->view->polygons[part.first].part == edge_->edge.part;
      if (same && judged) continue;
      if (!test_part(local, *own_->view, part, same ? own_->within : own_->contact, true)) return;
    }
  }

  // False when nothing of the edge is left.
  bool gather_body(std::uint32_t b, bool self) {
    const Placed& other = world_.placed[b];
    if (!other.opaque) return true;
    const LocalEdge local = localized(other);
    const std::int64_t contact = std::max(contact_, other.contact);
    for (const PartView& part : other.view->parts)
      if (!test_part(local, *other.view, part, contact, self)) return false;
    return true;
  }

  bool test_part(const LocalEdge& local, const ShapeView& view, const PartView& part,
                 std::int64_t contact, bool self) {
    if (!may_hide(local, part.box)) return true;
    if (is_deep_under(local, part, contact)) {
      ++work_.tests;
      work_.wide_tests += local.narrow ? 0 : 1;
      return add(outlined_stretch(local, view, part.outline), self);
    }
    if (part.tree.empty()) {
      for (std::uint32_t i = part.first; i < part.last; ++i)
        if (!test_polygon(local, view, view.polygons[i], contact, self)) return false;
      return true;
    }
    bool more = true;
    part.tree.walk(loose(local.va, local.vb), [&](std::uint32_t i) {
      return more = test_polygon(local, view, view.polygons[part.first + i], contact, self);
    });
    return more;
  }

  bool test_polygon(const LocalEdge& local, const ShapeView& view, const Polygon& p,
                    std::int64_t contact, bool self) {
    if (!may_hide(local, p.box)) return true;
    ++work_.tests;
    work_.wide_tests += local.narrow ? 0 : 1;
    return add(hidden_stretch(local, view, p, contact), self);
  }

  [[nodiscard]] bool is_deep_under(const LocalEdge& local, const PartView& part,
                                   std::int64_t contact) const {
    if (!part.has_outline || !job_.options.culling || local.limits != nullptr) return false;
    const std::int64_t depth = part.box.lo.w - std::max(local.va.w, local.vb.w);
    if (contact == 0) return depth > 0;
    const double least = static_cast<double>(contact) * part.deep_per_contact + 1;
    return static_cast<double>(depth) > least * (1 + 1e-9);
  }

  bool add(std::optional<Hit> hit, bool self) {
    if (!hit) return true;
    hit->self = self;
    return add(*hit);
  }

  bool add(const Hit& hit) {
    hits_.push_back(hit);
    if (!job_.options.culling) return true;
    if (!open_.shrink_all(hits_)) return true;
    if (open_.empty()) return false;
    refresh_segment();
    return true;
  }

  [[nodiscard]] LocalEdge localized(const Placed& other) {
    LocalEdge local{a_ - other.offset, b_ - other.offset, va_ - other.at, vb_ - other.at};
    const std::int64_t reach =
        std::max({std::abs(local.va.u), std::abs(local.va.v), std::abs(local.vb.u),
                  std::abs(local.vb.v), other.view->reach});
    local.narrow = fits_narrow(reach);
    if (other.cut) {
      limits_ = {job_.limits->lo - other.offset, job_.limits->hi - other.offset};
      local.limits = &limits_;
    }
    return local;
  }

  // The part of the edge that is still open, for a query.
  [[nodiscard]] LooseSegment loose(const ViewPoint& a, const ViewPoint& b) const {
    LooseSegment s;
    const bool exact =
        std::max({std::abs(a.u), std::abs(a.v), std::abs(b.u), std::abs(b.v)}) < kExactInDouble;
    const double du = static_cast<double>(b.u) - static_cast<double>(a.u);
    const double dv = static_cast<double>(b.v) - static_cast<double>(a.v);
    const double dw = static_cast<double>(b.w) - static_cast<double>(a.w);
    s.au = static_cast<double>(a.u);
    s.av = static_cast<double>(a.v);
    s.du = exact ? du : 0;
    s.dv = exact ? dv : 0;
    const auto range = [&](double from, double step, double& least, double& most) {
      const double p = from + step * open_.lo().value, q = from + step * open_.hi().value;
      const double slack = 1e-12 * (std::abs(from) + std::abs(step));
      least = std::min(p, q) - slack;
      most = std::max(p, q) + slack;
    };
    double w1 = 0;
    range(s.au, du, s.u0, s.u1);
    range(s.av, dv, s.v0, s.v1);
    range(static_cast<double>(a.w), dw, s.w0, w1);
    return s;
  }
  void refresh_segment() { segment_ = loose(va_, vb_); }

  const World& world_;
  const Job& job_;
  Work work_;
  // The edge in hand.
  std::uint32_t body_ = 0;
  const Placed* own_ = nullptr;
  const Placed* other_ = nullptr;   ///< of an intersection the second body, otherwise own_
  const EdgeView* edge_ = nullptr;  ///< null: a line that is no edge
  EdgeKind kind_ = EdgeKind::sharp;
  bool projecting_ = false;
  bool cut_away_ = false;
  std::int64_t contact_ = 0;
  Vec3l a_, b_;
  ViewPoint va_, vb_;
  OpenRange open_;
  LooseSegment segment_;
  Box3l limits_;  ///< in the coordinates of the body that is asked
  // Scratch that keeps its memory from edge to edge.
  std::vector<Hit> hits_;
  std::vector<Stretch> stretches_;
  StretchMaker maker_;
};

void add(Counters& counters, const Work& work) {
  counters.feature_edges += work.edges;
  counters.covered_edges += work.covered;
  counters.face_tests += work.tests;
  counters.exact_fallbacks += work.wide_tests;
}

/// Works out once what the faces of shared shapes hide of their own edges.
Status share_own_hits(World& world, const parallel::Context& context, Counters& counters) {
  const std::vector<Item> items = own_items(world);
  struct Part {
    OwnHits hits;
    Work work;
  };
  std::vector<Part> parts(items.size());
  const Status done = parallel::for_each_with(
      context, {.name = "hidden lines: shapes on themselves", .n = items.size()},
      [&] { return Gatherer(world); },
      [&](Gatherer& gatherer, std::size_t i) {
        gatherer.run_on_itself(items[i], parts[i].hits, parts[i].work);
      });
  if (!done) return done;
  world.own_hits.resize(world.views.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    OwnHits& all = world.own_hits[world.job.seen.of[items[i].body]];
    if (!all.first.empty()) all.first.pop_back();
    const auto base = static_cast<std::uint32_t>(all.hits.size());
    for (const std::uint32_t first : parts[i].hits.first) all.first.push_back(base + first);
    all.hits.insert(all.hits.end(), parts[i].hits.hits.begin(), parts[i].hits.hits.end());
    all.first.push_back(static_cast<std::uint32_t>(all.hits.size()));
    add(counters, parts[i].work);
  }
  return {};
}

}  // namespace

Status solve_gather(const Job& job, const parallel::Context& context, Drawing& drawing) {
  Result<World> made = make_world(job, context);
  if (!made) return made.error();
  if (const Status status = share_own_hits(*made, context, drawing.counters); !status)
    return status;
  const World& world = *made;
  std::vector<Work> work(world.items.size());
  Result<std::vector<Piece>> pieces = parallel::collect_with<Piece>(
      context, {.name = "hidden lines: edges", .n = world.items.size()},
      [&] { return Gatherer(world); },
      [&](Gatherer& gatherer, std::size_t i, std::vector<Piece>& out) {
        gatherer.run(world.items[i], out, work[i]);
      });
  if (!pieces) return pieces.error();
  drawing.pieces = std::move(pieces).value();
  for (const Work& w : work) add(drawing.counters, w);
  return {};
}

}  // namespace strake::hlr
