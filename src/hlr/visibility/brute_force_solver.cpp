// SPDX-License-Identifier: Apache-2.0
// The definition of docs/hlr.md, taken literally and kept plain. The engine is checked against it,
// so it shares with the engine nothing but the lists of edges and lines, and what sections leave.
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "hlr/edges/edge_on.hpp"
#include "hlr/prepare/view_job.hpp"
#include "hlr/visibility/specks.hpp"
#include "hlr/visibility/visibility_intervals.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Vec3l;

// A parameter on an edge: num / den with den > 0, not reduced.
struct Fraction {
  Int128 num = 0, den = 1;
};

Int128 floor_div(Int128 a, Int128 b) {
  return a / b - ((a % b != 0 && (a < 0) != (b < 0)) ? 1 : 0);
}

// Compares by continued fractions, so that no product is ever formed.
int compare(Fraction x, Fraction y) {
  for (int sign = 1;; sign = -sign) {
    const Int128 p = floor_div(x.num, x.den), q = floor_div(y.num, y.den);
    if (p != q) return (p < q) ? -sign : sign;
    const Int128 r = x.num - p * x.den, s = y.num - q * y.den;
    if (r == 0 || s == 0) {
      if (r == s) return 0;
      return (r == 0) ? -sign : sign;
    }
    x = {x.den, r};
    y = {y.den, s};
  }
}

bool less(const Fraction& x, const Fraction& y) { return compare(x, y) < 0; }

// floor(delta * t + 1/2) for t in [0, 1], by long multiplication and division in base 2.
std::int64_t rounded_offset(std::int64_t delta, const Fraction& t) {
  const bool negative = delta < 0;
  const std::uint64_t magnitude =
      negative ? ~static_cast<std::uint64_t>(delta) + 1 : static_cast<std::uint64_t>(delta);
  std::int64_t quotient = 0;
  Int128 rest = 0;
  for (int bit = 63; bit >= 0; --bit) {
    rest = 2 * rest + (((magnitude >> bit) & 1) != 0 ? t.num : 0);
    quotient = 2 * quotient + static_cast<std::int64_t>(rest / t.den);
    rest %= t.den;
  }
  if (!negative) return quotient + ((rest >= t.den - rest) ? 1 : 0);
  return -quotient - ((rest > t.den - rest) ? 1 : 0);
}

struct Interval {
  Fraction lo, hi;
};
using Intervals = std::vector<Interval>;

// The intervals that are hidden of an edge, seen a hair to its left and a hair to its right.
struct Sides {
  Intervals left, right;
};

struct Edge {
  Vec3l a, b;
  EdgeKind kind = EdgeKind::sharp;
  bool projecting = false;
  bool cut_away = false;
  bool away = false;
  std::uint32_t body = 0, other_body = 0;  ///< two at an intersection, otherwise one
  std::uint32_t part = 0;                  ///< kNoPart for a line that is no edge
};
constexpr std::uint32_t kNoPart = 0xffffffffU;

struct Facet {
  Vec3l corner[3];  // counter-clockwise to the viewer
  ExactNormal normal;
  Int128 facing = 0;  // normal . direction, positive
};

// An affine function of t that must be positive. `sideways` decides where it is zero throughout.
struct Condition {
  Int128 at_a = 0, at_b = 0;
  int sideways = -1;
};

void apply(const Condition& c, Interval& range, bool& empty) {
  if (c.at_a == c.at_b) {
    if (c.at_a < 0 || (c.at_a == 0 && c.sideways < 0)) empty = true;
    return;
  }
  const Int128 den = c.at_a - c.at_b;
  const Fraction root = den > 0 ? Fraction{c.at_a, den} : Fraction{-c.at_a, -den};
  if (den < 0 && less(range.lo, root)) range.lo = root;
  if (den > 0 && less(root, range.hi)) range.hi = root;
  if (!less(range.lo, range.hi)) empty = true;
}

Int128 dot(const ExactNormal& n, const Vec3l& v) { return n[0] * v.x + n[1] * v.y + n[2] * v.z; }

Int128 orientation(const Vec3l& p, const Vec3l& q, const Vec3l& r, const Vec3l& d) {
  const Vec3l u = q - p, v = r - p;
  const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t e, std::int64_t f) {
    return static_cast<Int128>(a) * f - static_cast<Int128>(b) * e;
  };
  return minor(u.y, u.z, v.y, v.z) * d.x + minor(u.z, u.x, v.z, v.x) * d.y +
         minor(u.x, u.y, v.x, v.y) * d.z;
}

ExactNormal cross(const Vec3l& u, const Vec3l& v) {
  return {static_cast<Int128>(u.y) * v.z - static_cast<Int128>(u.z) * v.y,
          static_cast<Int128>(u.z) * v.x - static_cast<Int128>(u.x) * v.z,
          static_cast<Int128>(u.x) * v.y - static_cast<Int128>(u.y) * v.x};
}

class Solver {
 public:
  explicit Solver(const ViewJob& job)
      : job_(job), d_(job.direction()), from_eye_(job.viewer.eye.has_value()) {}

  // Returns whether the edge is a point on paper. The eye is the origin.
  bool is_point(const Vec3l& a, const Vec3l& b) const {
    return is_zero(from_eye_ ? cross(a, b) : cross(b - a, d_));
  }

  // Finds the part of the edge within the frustum and the limits; false when there is none.
  bool clip(const Edge& e, Interval& range) const {
    bool empty = false;
    for (const HalfSpace& h : job_.window) {
      const ExactNormal n{h.normal.x, h.normal.y, h.normal.z};
      apply({dot(n, e.a) - h.least, dot(n, e.b) - h.least, 1}, range, empty);
      if (empty) return false;
    }
    if (!job_.limits) return true;
    for (int k = 0; k < 3; ++k) {
      apply({e.a[k] - job_.limits->lo[k], e.b[k] - job_.limits->lo[k], 1}, range, empty);
      apply({job_.limits->hi[k] - e.a[k], job_.limits->hi[k] - e.b[k], 1}, range, empty);
      if (empty) return false;
    }
    return true;
  }

  // Adds the intervals that the facets of one part hide of an edge.
  void hide(const Edge& e, std::uint32_t body_index, std::uint32_t part_index,
            const Interval& range, Sides& sides) const {
    const model::GridBody& body = job_.scene->bodies[body_index];
    const SectionedShape& sectioned = job_.sectioned_shape_of(body_index);
    const geometry::Part& part = sectioned.shape().parts[part_index];
    const bool same_part = e.body == body_index && e.part == part_index;
    std::int64_t contact =
        std::max({job_.contact[e.body], job_.contact[e.other_body], job_.contact[body_index]});
    if (e.part == kNoPart) contact = std::max(contact, job_.lines.contact);
    if (same_part) contact = sectioned.within;
    const bool forgives = same_part && job_.forgives_rounding(body_index);
    const std::int64_t lying = forgives && !e.away ? kLyingInPlane : 0;
    for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
      Facet f;
      if (forgives && may_be_edge_on(part, t, d_)) continue;
      if (!facet(part, t, job_.offset(body), f)) continue;
      if (lies_in_plane(e, f, lying)) continue;
      add(e, f, contact, +1, range, sides.left);
      add(e, f, contact, -1, range, sides.right);
    }
  }

 private:
  bool facet(const geometry::Part& part, std::uint32_t t, const Vec3l& offset, Facet& f) const {
    f.normal = triangle_normal(part, t);
    for (std::size_t k = 0; k < 3; ++k)
      f.corner[k] = part.vertices[part.triangles[t][k]].as<std::int64_t>() + offset;
    f.facing = from_eye_ ? -dot(f.normal, f.corner[0]) : dot(f.normal, d_);
    if (f.facing == 0) return false;
    if (f.facing < 0) {
      std::swap(f.corner[1], f.corner[2]);
      for (Int128& x : f.normal) x = -x;
      f.facing = -f.facing;
    }
    return true;
  }

  static bool lies_in_plane(const Edge& e, const Facet& f, std::int64_t lying) {
    Int128 size = 0;
    for (const Int128& x : f.normal) size += x < 0 ? -x : x;
    return dot(f.normal, f.corner[0] - e.a) <= lying * size &&
           dot(f.normal, f.corner[0] - e.b) <= lying * size;
  }

  // Side +1 is the left of the edge, where the inside of a facet lies along an edge of the facet
  // that runs the same way.
  void add(const Edge& e, const Facet& f, std::int64_t contact, int side, Interval range,
           Intervals& out) const {
    bool empty = false;
    for (std::size_t k = 0; k < 3 && !empty; ++k) {
      const Vec3l &q = f.corner[k], &r = f.corner[(k + 1) % 3];
      apply({side_on_paper(q, r, e.a), side_on_paper(q, r, e.b), side * same_way(e, q, r)}, range,
            empty);
    }
    if (empty) return;
    Int128 size = 0;
    for (const Int128& x : f.normal) size += x < 0 ? -x : x;
    const Int128 depth_a = dot(f.normal, f.corner[0] - e.a),
                 depth_b = dot(f.normal, f.corner[0] - e.b);
    apply({depth_a - contact * size, depth_b - contact * size, -1}, range, empty);
    if (job_.limits)
      for (int k = 0; k < 3 && !empty; ++k) {
        // The hiding point is p + (depth / facing) d; times `facing` all is integer. From the
        // eye, the origin, it is p·facing / (facing + depth), and that sum is positive.
        const auto above = [&](const Vec3l& p, Int128 depth, std::int64_t limit) {
          return (p[k] - limit) * f.facing + depth * (from_eye_ ? -limit : d_[k]);
        };
        const std::int64_t lo = job_.limits->lo[k], hi = job_.limits->hi[k];
        apply({above(e.a, depth_a, lo), above(e.b, depth_b, lo), 1}, range, empty);
        apply({-above(e.a, depth_a, hi), -above(e.b, depth_b, hi), 1}, range, empty);
      }
    if (!empty) out.push_back(range);
  }

  // Returns a value that is positive where x lies to the left of q->r on paper.
  Int128 side_on_paper(const Vec3l& q, const Vec3l& r, const Vec3l& x) const {
    return from_eye_ ? -dot(cross(q, r), x) : orientation(q, r, x, d_);
  }

  // Returns +1 when q->r and a->b, parallel on paper, run the same way there.
  int same_way(const Edge& e, const Vec3l& q, const Vec3l& r) const {
    // Both lie in a plane that holds d, or the eye: these vectors are normals of it.
    const ExactNormal s = from_eye_ ? cross(q, r) : cross(r - q, d_);
    const ExactNormal t = from_eye_ ? cross(e.a, e.b) : cross(e.b - e.a, d_);
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] != 0) return (s[k] > 0) == (t[k] > 0) ? 1 : -1;
    return 0;
  }

  const ViewJob& job_;
  const Vec3l& d_;
  bool from_eye_;  // the eye is then the origin
};

// Returns the union as disjoint intervals; intervals that share an end are one.
Intervals united(Intervals list) {
  std::sort(list.begin(), list.end(),
            [](const Interval& x, const Interval& y) { return less(x.lo, y.lo); });
  Intervals result;
  for (const Interval& i : list) {
    if (result.empty() || less(result.back().hi, i.lo))
      result.push_back(i);
    else if (less(result.back().hi, i.hi))
      result.back().hi = i.hi;
  }
  return result;
}

bool covers(const Intervals& list, const Fraction& lo, const Fraction& hi) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Interval& i) { return !less(lo, i.lo) && !less(i.hi, hi); });
}

struct StateInterval {
  Interval range;
  State state = State::visible;
};

// Returns the states between all neighbouring ends of all intervals; equal neighbours are one
// interval.
std::vector<StateInterval> state_intervals(const Sides& self, const Sides& other,
                                           const Interval* kept) {
  Sides all = self;
  all.left.insert(all.left.end(), other.left.begin(), other.left.end());
  all.right.insert(all.right.end(), other.right.begin(), other.right.end());
  const Intervals self_left = united(self.left), self_right = united(self.right);
  const Intervals all_left = united(all.left), all_right = united(all.right);

  std::vector<Fraction> ends{{0, 1}, {1, 1}};
  if (kept != nullptr) ends.insert(ends.end(), {kept->lo, kept->hi});
  for (const Intervals* list : {&self_left, &self_right, &all_left, &all_right})
    for (const Interval& i : *list) ends.insert(ends.end(), {i.lo, i.hi});
  std::sort(ends.begin(), ends.end(), less);

  std::vector<StateInterval> result;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Fraction &lo = ends[i], &hi = ends[i + 1];
    if (!less(lo, hi)) continue;
    State state = State::visible;
    if (kept == nullptr || !covers({*kept}, lo, hi))
      state = State::clipped;
    else if (covers(self_left, lo, hi) && covers(self_right, lo, hi))
      state = State::hidden_by_self;
    else if (covers(all_left, lo, hi) && covers(all_right, lo, hi))
      state = State::hidden_by_other;
    if (!result.empty() && result.back().state == state)
      result.back().range.hi = hi;
    else
      result.push_back({{lo, hi}, state});
  }
  return result;
}

std::vector<StateInterval> solve(const ViewJob& job, const Solver& solver, const Edge& e,
                                 std::uint64_t& tests) {
  const model::Scene& scene = *job.scene;
  Interval range{{0, 1}, {1, 1}};
  const bool kept = !e.cut_away && solver.clip(e, range);
  Sides self, other;
  if (kept && e.projecting) return {{{{0, 1}, {1, 1}}, State::projecting}};
  if (kept && job.options.stage != Stage::none)
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
      const bool own = scene.bodies[b].object == scene.bodies[e.body].object ||
                       scene.bodies[b].object == scene.bodies[e.other_body].object;
      if (!job.opaque[b] || (own && job.spares_own(e.kind))) continue;
      if (!own && job.options.stage == Stage::local) continue;
      const auto& parts = job.sectioned_shape_of(b).shape().parts;
      for (std::uint32_t p = 0; p < parts.size(); ++p) {
        solver.hide(e, b, p, range, own ? self : other);
        tests += parts[p].triangles.size();
      }
    }
  return state_intervals(self, other, kept ? &range : nullptr);
}

struct SolverInput {
  const ViewJob& job;
  Solver solver;
  const SpeckRule& rule;
};

struct ObjectLines {
  std::vector<EdgePiece> pieces;
  std::uint64_t edges = 0, tests = 0, specks = 0;
  std::uint32_t left_out = 0, clipped = 0;
  bool specked = false;
};

void solve_edge(const SolverInput& input, const Edge& e, ObjectLines& result) {
  const auto& [job, solver, rule] = input;
  const model::Scene& scene = *job.scene;
  const auto at = [&](const Fraction& t) {
    Vec3l p = e.a + job.origin;
    for (int k = 0; k < 3; ++k) p[k] += rounded_offset(e.b[k] - e.a[k], t);
    return p;
  };
  const auto number = static_cast<std::uint32_t>(result.edges++);
  const std::size_t first = result.pieces.size();
  for (const StateInterval& s : solve(job, solver, e, result.tests))
    result.pieces.push_back({scene.bodies[e.body].object, number, e.kind, s.state,
                             scene.bodies[e.other_body].object, at(s.range.lo), at(s.range.hi)});
  result.specks += absorb_specks(rule, first, result.pieces);
  const UnwantedPieces left_out = leave_out_unwanted(job.options, first, result.pieces);
  result.left_out += left_out.hidden ? 1U : 0U;
  result.clipped += left_out.clipped;
  result.specked = result.specked || has_visible_specks(rule, first, result.pieces);
}

Result<ObjectLines> solve_object(const ViewJob& job, const SpeckRule& rule, std::uint32_t object) {
  const model::Scene& scene = *job.scene;
  const SolverInput input{job, Solver(job), rule};
  ObjectLines result;
  for (std::uint32_t b = scene.first_body[object]; b < scene.first_body[object + 1]; ++b) {
    const model::GridBody& body = scene.bodies[b];
    const auto edges = sectioned_edges(job.sectioned_shape_of(b), job.features_of(body), {});
    if (!edges) return edges.error();
    for (const FeatureEdge& f : *edges)
      solve_edge(
          input,
          {f.a.as<std::int64_t>() + job.offset(body), f.b.as<std::int64_t>() + job.offset(body),
           f.kind, f.projecting, f.cut_away, f.away, b, b, f.part},
          result);
  }
  for (const Line& line : job.lines.of(object)) {
    const Vec3l p = line.a - job.origin, q = line.b - job.origin;
    solve_edge(input,
               {p, q, line.kind, input.solver.is_point(p, q), line.cut_away, false, line.body_a,
                line.body_b, kNoPart},
               result);
  }
  return result;
}

std::uint64_t triangles_of(const ViewJob& job, std::uint32_t body) {
  if (!job.opaque[body]) return 0;
  std::uint64_t sum = 0;
  for (const geometry::Part& part : job.sectioned_shape_of(body).shape().parts)
    sum += part.triangles.size();
  return sum;
}

/// What one object has: its edges, and the triangles that hide.
Result<BruteForceWork> content_of(const ViewJob& job, std::uint32_t object) {
  const model::Scene& scene = *job.scene;
  BruteForceWork work;
  for (std::uint32_t b = scene.first_body[object]; b < scene.first_body[object + 1]; ++b) {
    const auto edges =
        sectioned_edges(job.sectioned_shape_of(b), job.features_of(scene.bodies[b]), {});
    if (!edges) return edges.error();
    work.edges += edges->size();
    work.triangles += triangles_of(job, b);
  }
  work.edges += job.lines.of(object).size();
  return work;
}

}  // namespace

Result<BruteForceWork> count_brute_force_work(const ViewJob& job,
                                              const parallel::Context& context) {
  const std::size_t objects = job.scene->model->objects.size();
  const auto contents = parallel::transform(context, {.name = "edges of objects", .n = objects},
                                            [&](std::size_t i) -> Result<BruteForceWork> {
                                              if (!job.drawn[i]) return BruteForceWork{};
                                              return content_of(job, static_cast<std::uint32_t>(i));
                                            });
  if (!contents) return contents.error();
  BruteForceWork work;
  for (const BruteForceWork& one : *contents) {
    work.edges += one.edges;
    work.triangles += one.triangles;
    if (job.options.stage == Stage::local) work.tests += one.edges * one.triangles;
  }
  if (job.options.stage == Stage::global) work.tests = work.edges * work.triangles;
  return work;
}

Result<SpeckedObjects> solve_brute_force(const ViewJob& job, const parallel::Context& context,
                                         Drawing& drawing) {
  const std::size_t objects = job.scene->model->objects.size();
  const Result<SpeckRule> made_rule = SpeckRule::of(job, context);
  if (!made_rule) return made_rule.error();
  const SpeckRule& rule = *made_rule;
  const auto lines =
      parallel::transform(context, {.name = "hidden lines (brute force)", .n = objects},
                          [&](std::size_t i) -> Result<ObjectLines> {
                            if (!job.drawn[i]) return ObjectLines{};
                            return solve_object(job, rule, static_cast<std::uint32_t>(i));
                          });
  if (!lines) return lines.error();
  SpeckedObjects specked(objects);
  for (std::size_t i = 0; i < objects; ++i) {
    const ObjectLines& one = (*lines)[i];
    specked[i] = one.specked ? 1 : 0;
    if (!drawing.left_out.empty()) drawing.left_out[i] = one.left_out;
    if (!drawing.clipped_left_out.empty()) drawing.clipped_left_out[i] = one.clipped;
    drawing.pieces.insert(drawing.pieces.end(), one.pieces.begin(), one.pieces.end());
    drawing.counted[i] = {static_cast<std::uint32_t>(one.edges),
                          static_cast<std::uint32_t>(one.specks)};
    drawing.counters.face_tests += one.tests;
  }
  return specked;
}

}  // namespace strake::hlr
