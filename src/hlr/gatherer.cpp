// SPDX-License-Identifier: Apache-2.0
#include "hlr/gatherer.hpp"

#include <algorithm>
#include <cstdlib>

namespace strake::hlr {
namespace {

// Up to this many neighbours of an item are looked through for each of its edges: more are found
// faster by the tree.
constexpr std::size_t kFewNeighbours = 64;
constexpr std::uint32_t kNoBody = 0xffffffffU;
// Beyond 2^52 a double holds view coordinates only roughly: the line test of a query is left out.
constexpr std::int64_t kExactInDouble = std::int64_t{1} << 52;
// What covered tiles say of an edge is cut at multiples of this share.
constexpr std::int64_t kFine = std::int64_t{1} << 30;

}  // namespace

void add(Counters& counters, const Work& work) {
  counters.feature_edges += work.edges;
  counters.covered_edges += work.covered;
  counters.face_tests += work.tests;
  counters.exact_fallbacks += work.wide_tests;
  counters.specks += work.specks;
}

std::span<const Hit> Gatherer::hits(const AskedEdge& edge, const Param& lo, const Param& hi) {
  begin(edge, lo, hi);
  // Who hides what is of no interest where hidden pieces are left out: then the cheapest first.
  const bool global = job_.options.stage == Stage::global, any_order = !job_.options.hidden;
  if (global && any_order) take_covered_ends();
  if (!open_.empty()) gather_own_objects();
  if (global && !any_order && !open_.empty()) take_covered_ends();
  if (global && !open_.empty()) gather_others();
  return hits_;
}

std::span<const Hit> Gatherer::own_hits(const AskedEdge& edge, const Param& lo, const Param& hi) {
  begin(edge, lo, hi);
  gather_own_objects();
  return hits_;
}

std::span<const Hit> Gatherer::hits_of_body(const AskedEdge& edge, std::uint32_t body,
                                            const Param& lo, const Param& hi) {
  begin(edge, lo, hi);
  gather_body(body, false);
  return hits_;
}

void Gatherer::begin(const AskedEdge& edge, const Param& lo, const Param& hi) {
  edge_ = edge;
  hits_.clear();
  open_ = OpenRange(lo, hi);
  if (world_.picture) look_at_picture(lo.value, hi.value);
}

ViewBox Gatherer::box() const {
  if (world_.picture) return picture_box_;
  ViewBox box;
  box.include(edge_.va);
  box.include(edge_.vb);
  return box;
}

std::span<const Hit> Gatherer::hits_of_own_body(const AskedEdge& edge) {
  edge_ = edge;
  hits_.clear();
  open_ = OpenRange();
  if (edge_.kind != EdgeKind::polyline && !edge_.projecting) test_own_body();
  return hits_;
}

// Hidden-by-self takes precedence, so the own object comes first and, unless it hides the
// edge wholly, completely.
void Gatherer::gather_own_objects() {
  if (edge_.kind == EdgeKind::polyline || job_.options.stage == Stage::none) return;
  if (edge_.feature != nullptr && edge_.own->opaque) gather_own_body();
  gather_object(edge_.own->object);
  if (edge_.other->object != edge_.own->object) gather_object(edge_.other->object);
}

// Its bodies, but for the one that has been gathered already.
void Gatherer::gather_object(std::uint32_t object) {
  const std::uint32_t known = edge_.feature != nullptr ? edge_.body : kNoBody;
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
void Gatherer::take_covered_ends() {
  if (world_.coverage.empty() || edge_.kind == EdgeKind::polyline) return;
  const double lo = open_.lo().value, hi = open_.hi().value;
  const CoveredEnds ends = world_.coverage.covered_ends(edge_.va, edge_.vb, lo, hi);
  if (ends.from >= ends.to) {
    ++work.covered;
    add(Hit{open_.lo(), open_.hi(), kBothSides, false});
    return;
  }
  const Param from = Param::of(static_cast<std::int64_t>(ends.from * kFine) - 1, kFine);
  const Param to = Param::of(static_cast<std::int64_t>(ends.to * kFine) + 2, kFine);
  if (less(open_.lo(), from)) add(Hit{open_.lo(), from, kBothSides, false});
  if (less(to, open_.hi())) add(Hit{to, open_.hi(), kBothSides, false});
}

void Gatherer::gather_others() {
  const auto consider = [&](std::uint32_t b) {
    const std::uint32_t object = world_.placed[b].object;
    return object == edge_.own->object || object == edge_.other->object || gather_body(b, false);
  };
  if (!job_.options.culling) {
    for (std::uint32_t b = 0; b < world_.placed.size(); ++b) consider(b);
    return;
  }
  refresh_segment();
  if (!find_neighbours()) return world_.tree.walk(segment_, consider);
  for (const Neighbour& other : near_)
    if (other.box.w1 <= segment_.w0 ||
        (segment_.may_hide(other.box) && !gather_body(other.body, false)))
      return;
}

/// The edges of an item are near each other: one walk finds the bodies that may hide any of them.
/// False where they are many.
bool Gatherer::find_neighbours() {
  if (neighbours_ != Neighbours::not_looked_for) return neighbours_ == Neighbours::found;
  neighbours_ = Neighbours::too_many;
  if (item_->lines || world_.picture) return false;
  const Placed& own = world_.placed[item_->body];
  ViewBox box;
  for (std::uint32_t i = item_->first; i < item_->last; ++i) {
    box.include(own.view->edges[i].a);
    box.include(own.view->edges[i].b);
  }
  const LooseBox room = loosened(box.moved(own.at));
  LooseSegment any;
  any.u0 = room.u0;
  any.u1 = room.u1;
  any.v0 = room.v0;
  any.v1 = room.v1;
  const auto deepest = static_cast<double>(box.lo.w + own.at.w);
  any.w0 = deepest - 1e-12 * std::abs(deepest);
  near_.clear();
  bool few = true;
  world_.tree.walk_boxes(any, [&](std::uint32_t body, const LooseBox& its) {
    if (world_.placed[body].object != own.object) near_.push_back({its, body});
    return few = near_.size() <= kFewNeighbours;
  });
  if (!few) return false;
  std::ranges::sort(near_, [](const Neighbour& x, const Neighbour& y) {
    return x.box.w1 != y.box.w1 ? x.box.w1 > y.box.w1 : x.body < y.body;
  });
  neighbours_ = Neighbours::found;
  return true;
}

void Gatherer::gather_own_body() {
  if (!edge_.own->shares_own_hits) return test_own_body();
  const OwnHits& known = world_.own_hits[job_.seen.of[edge_.body]];
  for (const Hit& hit :
       known.of(static_cast<std::uint32_t>(edge_.feature - edge_.own->view->edges.data())))
    if (!add(hit)) return;
}

void Gatherer::test_own_body() {
  // Limits may cut away what hides: then the convex part's short cut does not hold.
  const bool judged =
      !edge_.own->cut && (edge_.feature->surely_behind_part || edge_.feature->surely_clear_of_part);
  if (judged && edge_.feature->surely_behind_part) {
    add(Hit{Param::zero(), Param::one(), kBothSides, true});
    if (job_.options.culling) return;
  }
  const LocalEdge local = localized(*edge_.own);
  for (const PartView& part : edge_.own->view->parts) {
    const bool same = edge_.own->view->polygons[part.first].part == edge_.feature->edge.part;
    if (same && judged) continue;
    const bool forgives = same && edge_.own->forgives_rounding;
    const Rule rule{.contact = same ? edge_.own->within : edge_.own->contact,
                    .lying = forgives && !edge_.feature->edge.away ? kLyingInPlane : 0,
                    .self = true,
                    .edge_on = !forgives};
    if (!test_part(local, *edge_.own->view, part, rule)) return;
  }
}

// False when nothing of the edge is left.
bool Gatherer::gather_body(std::uint32_t b, bool self) {
  const Placed& other = world_.placed[b];
  if (!other.opaque) return true;
  const LocalEdge local = localized(other);
  const std::int64_t contact = std::max(edge_.contact, other.contact);
  for (const PartView& part : other.view->parts)
    if (!test_part(local, *other.view, part, {.contact = contact, .self = self})) return false;
  return true;
}

bool Gatherer::test_part(const LocalEdge& local, const ShapeView& view, const PartView& part,
                         const Rule& rule) {
  if (!may_hide(local, part.box)) return true;
  if (!part.turn.is_none() && !loose(local.va, local.vb, part.turn).may_hide(part.turned))
    return true;
  if (is_deep_under(local, part, std::max(rule.contact, rule.lying))) {
    ++work.tests;
    work.wide_tests += local.narrow ? 0 : 1;
    return add(outlined_stretch(local, view, part.outline), rule.self);
  }
  bool more = true;
  const auto test = [&](std::uint32_t i) {
    return more = test_polygon(local, view, view.polygons[part.first + i], rule);
  };
  if (!part.tree.empty()) {
    part.tree.walk(loose(local.va, local.vb, part.turn), test);
  } else if (!part.buckets.empty()) {
    part.buckets.walk(loose(local.va, local.vb), marks_, test);
  } else {
    // Without an index there are no fans either, unless everything is in one.
    for (std::uint32_t i = 0; part.fans.empty() && more && i < part.last - part.first; ++i) test(i);
  }
  for (const Fan& fan : part.fans)
    if (more) fan.walk(loose(local.va, local.vb), local.va, local.vb, test);
  return more;
}

bool Gatherer::test_polygon(const LocalEdge& local, const ShapeView& view, const Polygon& p,
                            const Rule& rule) {
  if (!may_hide(local, p.box) || (p.edge_on && !rule.edge_on)) return true;
  ++work.tests;
  work.wide_tests += local.narrow ? 0 : 1;
  return add(hidden_stretch(local, view, p, rule.contact, rule.lying), rule.self);
}

bool Gatherer::is_deep_under(const LocalEdge& local, const PartView& part,
                             std::int64_t contact) const {
  if (!part.has_outline || !job_.options.culling || local.limits != nullptr) return false;
  const std::int64_t depth = part.farthest - local.nearest;
  if (contact == 0) return depth > 0;
  const double least = static_cast<double>(contact) * part.deep_per_contact + 1;
  return static_cast<double>(depth) > least * (1 + 1e-9);
}

bool Gatherer::add(std::optional<Hit> hit, bool self) {
  if (!hit) return true;
  hit->self = self;
  return add(*hit);
}

bool Gatherer::add(const Hit& hit) {
  hits_.push_back(hit);
  if (!job_.options.culling) return true;
  if (!open_.shrink_all(hits_)) return true;
  if (open_.empty()) return false;
  refresh_segment();
  return true;
}

LocalEdge Gatherer::localized(const Placed& other) {
  LocalEdge local;
  local.a = edge_.a - other.offset;
  local.b = edge_.b - other.offset;
  if (other.cut) {
    limits_ = {job_.limits->lo - other.offset, job_.limits->hi - other.offset};
    local.limits = &limits_;
  }
  if (world_.picture) {
    local.box = picture_box_;
    local.nearest = std::max(dot(edge_.a, job_.direction()), dot(edge_.b, job_.direction()));
    local.narrow = true;
    return local;
  }
  local.va = edge_.va - other.at;
  local.vb = edge_.vb - other.at;
  local.box.include(local.va);
  local.box.include(local.vb);
  local.nearest = local.box.hi.w;
  const std::int64_t reach =
      std::max({std::abs(local.va.u), std::abs(local.va.v), std::abs(local.vb.u),
                std::abs(local.vb.v), other.view->reach});
  local.narrow = fits_narrow(reach);
  return local;
}

void Gatherer::look_at_picture(double from, double to) {
  in_picture_ = world_.picture->segment(edge_.a, edge_.b, from, to);
  constexpr auto kRim = static_cast<std::int64_t>(Picture::kRim);
  picture_box_ =
      in_picture_ ? in_picture_->box() : ViewBox{{-kRim, -kRim, -kRim}, {kRim, kRim, kRim}};
}

LooseSegment Gatherer::loose_in_picture() const {
  if (in_picture_) return in_picture_->loose(open_.lo().value, open_.hi().value);
  constexpr double kRim = Picture::kRim;
  LooseSegment everywhere;
  everywhere.u0 = everywhere.v0 = everywhere.w0 = -kRim;
  everywhere.u1 = everywhere.v1 = kRim;
  return everywhere;
}

// The part of the edge that is still open, for a query.
LooseSegment Gatherer::loose(const ViewPoint& a, const ViewPoint& b, const Turn& turn) const {
  if (world_.picture) return loose_in_picture();
  LooseSegment s;
  const std::int64_t whole = turn.is_none() ? kExactInDouble : kExactInDouble / (2 * Turn::kMost);
  const bool exact = std::max({std::abs(a.u), std::abs(a.v), std::abs(b.u), std::abs(b.v)}) < whole;
  const auto au = static_cast<double>(a.u), av = static_cast<double>(a.v);
  const double bu = static_cast<double>(b.u) - au, bv = static_cast<double>(b.v) - av;
  const double dw = static_cast<double>(b.w) - static_cast<double>(a.w);
  const auto c = static_cast<double>(turn.c), k = static_cast<double>(turn.s);
  const double du = c * bu + k * bv, dv = c * bv - k * bu;
  s.au = c * au + k * av;
  s.av = c * av - k * au;
  s.du = exact ? du : 0;
  s.dv = exact ? dv : 0;
  // What the sums above may have lost is far below this share of their terms.
  const auto range = [&](double from, double step, double size, double& least, double& most) {
    const double p = from + step * open_.lo().value, q = from + step * open_.hi().value;
    const double slack = 1e-12 * size;
    least = std::min(p, q) - slack;
    most = std::max(p, q) + slack;
  };
  const auto size = [&](double x, double y) { return std::abs(c * x) + std::abs(k * y); };
  double w1 = 0;
  range(s.au, du, size(au, av) + size(bu, bv), s.u0, s.u1);
  range(s.av, dv, size(av, au) + size(bv, bu), s.v0, s.v1);
  range(static_cast<double>(a.w), dw, std::abs(static_cast<double>(a.w)) + std::abs(dw), s.w0, w1);
  return s;
}

}  // namespace strake::hlr
