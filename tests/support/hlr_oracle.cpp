// SPDX-License-Identifier: Apache-2.0
#include "support/hlr_oracle.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

namespace strake::test {
namespace {

using hlr::EdgeKind;
using hlr::EdgePiece;
using hlr::State;

using Vec = std::array<mpq_class, 3>;

mpq_class number(std::int64_t v) { return mpq_class(mpz_class(static_cast<long>(v))); }
template <class V>
Vec vec(const V& v) {
  return {number(v.x), number(v.y), number(v.z)};
}
Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(const mpq_class& s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
mpq_class dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Line {
  Vec a, b;
  EdgeKind kind{};
  bool wire = false;
  std::size_t number = 0;
  std::uint32_t other = 0;  ///< of an intersection the second object

  [[nodiscard]] bool crosses() const { return kind == EdgeKind::intersection; }
};

struct Tile {
  std::array<Vec, 3> v;
  Vec n;
  std::uint32_t object = 0, body = 0, part = 0;
};

/// From where all is seen: along a direction, or from a point.
struct Viewpoint {
  Vec direction;
  std::optional<Vec> eye;

  /// From p to the viewer.
  [[nodiscard]] Vec from(const Vec& p) const { return eye ? *eye - p : direction; }
};

// Lines of one part, decided from the vertex coordinates of its triangles alone.
class PartLines {
 public:
  PartLines(const geometry::Part& part, const geometry::Vec3l& origin, const Viewpoint& sight,
            double angle)
      : part_(part), origin_(origin), sight_(sight), angle_(angle) {}

  std::vector<Line> lines() {
    std::vector<Line> result;
    if (part_.kind == geometry::PartKind::wire) {
      for (std::size_t c = 0; c + 1 < part_.chain_first.size(); ++c)
        for (std::uint32_t v = part_.chain_first[c]; v + 1 < part_.chain_first[c + 1]; ++v)
          push(result, v, v + 1, EdgeKind::polyline);
    } else {
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
      for (std::uint32_t t = 0; t < part_.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t p = part_.triangles[t][k], q = part_.triangles[t][(k + 1) % 3];
          edges[{std::min(p, q), std::max(p, q)}].push_back(t);
        }
      for (const auto& [ends, triangles] : edges)
        if (const auto kind = classify(ends.first, ends.second, triangles))
          push(result, ends.first, ends.second, *kind);
    }
    std::sort(result.begin(), result.end(), [](const Line& x, const Line& y) {
      return std::tie(x.a, x.b, x.number) < std::tie(y.a, y.b, y.number);
    });
    return result;
  }

  Vec corner(std::uint32_t v) const { return vec(part_.vertices[v].as<std::int64_t>() + origin_); }

  Vec triangle_area(std::uint32_t t) const {
    const auto& i = part_.triangles[t];
    return cross(corner(i[1]) - corner(i[0]), corner(i[2]) - corner(i[0]));
  }

 private:
  void push(std::vector<Line>& result, std::uint32_t v, std::uint32_t w, EdgeKind kind) const {
    Vec a = corner(v), b = corner(w);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    result.push_back({a, b, kind, kind == EdgeKind::polyline, result.size()});
  }

  Vec face_area(std::uint32_t t) const {
    if (part_.faces.empty()) return triangle_area(t);
    Vec sum{0, 0, 0};
    for (std::uint32_t s = 0; s < part_.triangles.size(); ++s)
      if (part_.faces[s] == part_.faces[t]) sum = sum + triangle_area(s);
    return dot(sum, sum) == 0 ? triangle_area(t) : sum;
  }

  /// What moves of its corners within a grid cell may turn a triangle by about its longest side,
  /// radians; no more than a quarter of a degree.
  double triangle_turn(std::uint32_t t) const {
    constexpr double kMax = 0.0044;
    const auto& i = part_.triangles[t];
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec side = corner(i[(k + 1) % 3]) - corner(i[k]);
      longest = std::max(longest, std::sqrt(dot(side, side).get_d()));
    }
    const Vec area = triangle_area(t);
    const double height = std::sqrt(dot(area, area).get_d()) / longest;
    return std::min(kMax, 2 * (std::sqrt(0.75) + part_.weld) / height);
  }

  /// That of the face that decides: of its steadiest triangle.
  double face_turn(std::uint32_t t) const {
    if (part_.primitive) return 0;
    double least = triangle_turn(t);
    if (part_.faces.empty()) return least;
    for (std::uint32_t s = 0; s < part_.triangles.size(); ++s)
      if (part_.faces[s] == part_.faces[t]) least = std::min(least, triangle_turn(s));
    return least;
  }

  bool has_directed(std::uint32_t t, std::uint32_t v, std::uint32_t w) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (part_.triangles[t][k] == v && part_.triangles[t][(k + 1) % 3] == w) return true;
    return false;
  }

  std::optional<EdgeKind> classify(std::uint32_t v, std::uint32_t w,
                                   const std::vector<std::uint32_t>& triangles) const {
    if (triangles.size() == 1) return EdgeKind::boundary;
    if (!part_.faces.empty()) {
      std::set<std::uint32_t> faces;
      for (const std::uint32_t t : triangles) faces.insert(part_.faces[t]);
      if (faces.size() == 1) return std::nullopt;
    }
    if (triangles.size() > 2) return EdgeKind::non_manifold;
    const Vec m = face_area(triangles[0]);
    Vec n = face_area(triangles[1]);
    if (has_directed(triangles[0], v, w) == has_directed(triangles[1], v, w)) n = mpq_class(-1) * n;
    const double lengths = std::sqrt(dot(m, m).get_d()) * std::sqrt(dot(n, n).get_d());
    const double turn = std::acos(std::clamp(dot(m, n).get_d() / lengths, -1.0, 1.0));
    const double by_rounding = face_turn(triangles[0]) + face_turn(triangles[1]);
    if (turn > angle_ * std::acos(-1.0) / 180 + by_rounding) return EdgeKind::sharp;
    const bool front_m = dot(m, sight_.from(smallest_corner(triangles[0]))) > 0;
    const bool front_n = dot(n, sight_.from(smallest_corner(triangles[1]))) > 0;
    if (front_m != front_n) return EdgeKind::contour;
    return std::nullopt;
  }

  // Of the face whose area decides.
  Vec smallest_corner(std::uint32_t t) const {
    const bool alone = part_.faces.empty() || face_area(t) == triangle_area(t);
    std::optional<Vec> least;
    for (std::uint32_t s = 0; s < part_.triangles.size(); ++s) {
      if (alone ? s != t : part_.faces[s] != part_.faces[t]) continue;
      for (const std::uint32_t v : part_.triangles[s])
        if (!least || corner(v) < *least) least = corner(v);
    }
    return *least;
  }

  const geometry::Part& part_;
  geometry::Vec3l origin_;
  const Viewpoint& sight_;
  double angle_;
};

// A value at a point that was moved sideways by an infinitesimal: value first, slope second.
struct Moved {
  mpq_class value, slope;
  [[nodiscard]] bool positive() const { return value > 0 || (value == 0 && slope > 0); }
};

class Oracle {
 public:
  Oracle(const model::Scene& scene, const hlr::View& view, const hlr::Options& options,
         const std::vector<EdgePiece>& lines)
      : scene_(scene),
        view_(view),
        options_(options),
        given_(lines),
        sight_{vec(view.direction), std::nullopt},
        window_(hlr::window(view)) {
    if (view.perspective) sight_.eye = vec(view.perspective->eye);
    contact_ = options.contact_distance_mm < 0
                   ? mpq_class(3)
                   : number(std::llround(options.contact_distance_mm * 1000));
    if (view.limits) {
      low_ = vec(view.limits->lo);
      high_ = vec(view.limits->hi);
    }
    collect_tiles();
  }

  std::vector<EdgePiece> pieces() {
    for (std::uint32_t o = 0; o < scene_.model->objects.size(); ++o) {
      edge_number_ = 0;
      for (std::uint32_t b = scene_.first_body[o]; b < scene_.first_body[o + 1]; ++b) {
        const model::GridBody& body = scene_.bodies[b];
        const auto& parts = scene_.shapes[body.grid_shape].parts;
        for (std::uint32_t p = 0; p < parts.size(); ++p)
          for (const Line& line :
               PartLines(parts[p], body.origin, sight_, options_.sharp_angle_deg).lines())
            draw_line(line, o, b, p);
      }
      for (const EdgePiece& p : given_)
        if (model::index(p.object) == o)
          draw_line({vec(p.a), vec(p.b), p.kind, false, 0, model::index(p.other)}, o, 0, 0);
    }
    return std::move(out_);
  }

 private:
  void collect_tiles() {
    for (std::uint32_t b = 0; b < scene_.bodies.size(); ++b) {
      const model::GridBody& body = scene_.bodies[b];
      if (scene_.model->bodies[body.body].color.alpha != 255) continue;
      const auto& parts = scene_.shapes[body.grid_shape].parts;
      for (std::uint32_t p = 0; p < parts.size(); ++p) {
        const PartLines corners(parts[p], body.origin, sight_, 0);
        for (const auto& t : parts[p].triangles) {
          Tile tile{{corners.corner(t[0]), corners.corner(t[1]), corners.corner(t[2])},
                    {},
                    model::index(body.object),
                    b,
                    p};
          tile.n = cross(tile.v[1] - tile.v[0], tile.v[2] - tile.v[0]);
          if (dot(tile.n, sight_.from(tile.v[0])) != 0) tiles_.push_back(tile);
        }
      }
    }
  }

  bool inside_limits(const Vec& p) const {
    if (!view_.limits) return true;
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < low_[k] || p[k] > high_[k]) return false;
    return true;
  }

  bool inside_window(const Vec& p) const {
    return std::ranges::all_of(window_, [&](const hlr::HalfSpace& h) {
      return dot(vec(h.normal), p - *sight_.eye) >= number(h.least);
    });
  }

  // The share of the way to the eye, or along the direction, at which the tile's plane lies above
  // p; nothing where the way does not meet it, or only beyond the eye.
  std::optional<mpq_class> height(const Tile& tile, const Vec& p) const {
    const mpq_class rise = dot(tile.n, sight_.from(p));
    if (rise == 0) return std::nullopt;
    const mpq_class h = dot(tile.n, tile.v[0] - p) / rise;
    return sight_.eye && h >= 1 ? std::nullopt : std::optional(h);
  }

  // An intersection is off the faces that it lies on by what its ends were rounded.
  mpq_class min_distance(const Tile& tile, const Line& e, std::uint32_t body,
                         std::uint32_t part) const {
    if (!e.crosses() && tile.body == body && tile.part == part) return 0;
    mpq_class size = 0;
    for (const mpq_class& x : tile.n) size += abs(x);
    return size * (e.crosses() && contact_ < 1 ? mpq_class(1) : contact_);
  }

  // Barycentric weights of the point of the tile's plane between p, moved by an infinitesimal along
  // `sideways`, and the viewer.
  bool covers(const Tile& tile, const Vec& p, const Vec& sideways) const {
    const Vec d = sight_.from(p);
    const mpq_class whole = dot(tile.n, d);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec &q = tile.v[(k + 1) % 3], &r = tile.v[(k + 2) % 3];
      // det(r - q, p - q, d) = -(p - q) . ((r - q) x d), over the whole: the weight of corner k.
      // From the eye d is e - p, and moves too.
      const Vec line = cross(r - q, d);
      mpq_class slope = -dot(sideways, line);
      if (sight_.eye) slope += dot(p - q, cross(r - q, sideways));
      if (!Moved{-dot(p - q, line) / whole, slope / whole}.positive()) return false;
    }
    return true;
  }

  // Parameters where the edge crosses the plane {x : normal . (x - on) = 0}.
  static void cut(std::set<mpq_class>& events, const Line& e, const Vec& normal, const Vec& on,
                  const mpq_class& excess = 0) {
    const mpq_class at_a = dot(normal, e.a - on) - excess, slope = dot(normal, e.b - e.a);
    if (slope == 0) return;
    const mpq_class t = -at_a / slope;
    if (t > 0 && t < 1) events.insert(t);
  }

  std::set<mpq_class> events(const Line& e, std::uint32_t body, std::uint32_t part) const {
    std::set<mpq_class> result{0, 1};
    if (view_.limits)
      for (std::size_t k = 0; k < 3; ++k) {
        Vec axis{0, 0, 0};
        axis[k] = 1;
        cut(result, e, axis, low_);
        cut(result, e, axis, high_);
      }
    for (const hlr::HalfSpace& h : window_)
      cut(result, e, vec(h.normal), *sight_.eye, number(h.least));
    for (const Tile& tile : tiles_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec &q = tile.v[k], &r = tile.v[(k + 1) % 3];
        cut(result, e, cross(r - q, sight_.from(q)), q);
      }
      const mpq_class up = dot(tile.n, sight_.from(tile.v[0]));
      const mpq_class excess = min_distance(tile, e, body, part);
      cut(result, e, tile.n, tile.v[0], up > 0 ? mpq_class(-excess) : excess);
      if (view_.limits)
        for (std::size_t k = 0; k < 3; ++k)
          for (const Vec* limit : {&low_, &high_}) cut_at_limit(result, e, tile, k, (*limit)[k]);
    }
    return result;
  }

  // Where the point of the tile's plane between an edge and the viewer passes a limit.
  void cut_at_limit(std::set<mpq_class>& events, const Line& e, const Tile& tile, std::size_t k,
                    const mpq_class& limit) const {
    if (sight_.eye) {
      // The plane through the eye and the line that the limit cuts out of the tile's plane.
      Vec axis{0, 0, 0};
      axis[k] = 1;
      const Vec along = cross(tile.n, axis);
      if (dot(along, along) == 0) return;
      Vec on = tile.v[0];
      // In the tile's plane, square to `along`, as far as the limit.
      const Vec across = cross(along, tile.n);
      on = on + ((limit - on[k]) / across[k]) * across;
      cut(events, e, cross(along, *sight_.eye - on), on);
      return;
    }
    // x_k of the hiding point is p_k + height * d_k: a plane in p.
    const mpq_class up = dot(tile.n, sight_.direction);
    Vec normal = (-sight_.direction[k] / up) * tile.n;
    normal[k] += 1;
    const mpq_class base = dot(tile.n, tile.v[0]) / up * sight_.direction[k];
    cut(events, e, normal, {0, 0, 0}, limit - base);
  }

  State state_at(const Line& e, const mpq_class& t, std::uint32_t object, std::uint32_t body,
                 std::uint32_t part) const {
    const Vec p = e.a + t * (e.b - e.a);
    if (!inside_limits(p) || !inside_window(p)) return State::clipped;
    if (options_.stage == hlr::Stage::none) return State::visible;
    const Vec left = cross(sight_.from(p), e.b - e.a), right = mpq_class(-1) * left;
    bool self[2] = {false, false}, any[2] = {false, false};
    for (const Tile& tile : tiles_) {
      const bool own = tile.object == object || (e.crosses() && tile.object == e.other);
      if (own && e.wire && options_.own_polylines == hlr::OwnPolylines::visible) continue;
      if (!own && options_.stage == hlr::Stage::local) continue;
      if (any[0] && any[1] && (!own || (self[0] && self[1]))) continue;
      const std::optional<mpq_class> h = height(tile, p);
      if (!h || *h <= 0) continue;
      if (abs(dot(tile.n, tile.v[0] - p)) <= min_distance(tile, e, body, part)) continue;
      if (!inside_limits(p + *h * sight_.from(p))) continue;
      for (int side = 0; side < 2; ++side)
        if (covers(tile, p, side == 0 ? left : right)) {
          any[side] = true;
          self[side] = self[side] || own;
        }
    }
    if (self[0] && self[1]) return State::hidden_by_self;
    return any[0] && any[1] ? State::hidden_by_other : State::visible;
  }

  static std::int64_t rounded(const mpq_class& x) {
    mpz_class q;
    const mpq_class half = x + mpq_class(1, 2);
    mpz_fdiv_q(q.get_mpz_t(), half.get_num_mpz_t(), half.get_den_mpz_t());
    return q.get_si();
  }

  void draw_line(const Line& e, std::uint32_t object, std::uint32_t body, std::uint32_t part) {
    const std::uint32_t number = edge_number_++;
    const auto point = [&](const mpq_class& t) {
      const Vec p = e.a + t * (e.b - e.a);
      return geometry::Vec3l{rounded(p[0]), rounded(p[1]), rounded(p[2])};
    };
    const Vec turned = cross(sight_.from(e.a), e.b - e.a);
    const bool projecting = dot(turned, turned) == 0;
    const std::set<mpq_class> cuts = events(e, body, part);
    std::vector<std::tuple<mpq_class, mpq_class, State>> runs;
    bool within = false;
    for (auto i = cuts.begin(), j = std::next(i); j != cuts.end(); ++i, ++j) {
      const mpq_class middle = (*i + *j) / 2;
      const Vec at = e.a + middle * (e.b - e.a);
      const State state = !projecting ? state_at(e, middle, object, body, part)
                          : inside_limits(at) && inside_window(at) ? State::projecting
                                                                   : State::clipped;
      within = within || state != State::clipped;
      if (!runs.empty() && std::get<2>(runs.back()) == state)
        std::get<1>(runs.back()) = *j;
      else
        runs.emplace_back(*i, *j, state);
    }
    if (projecting) runs = {{0, 1, within ? State::projecting : State::clipped}};
    for (const auto& [lo, hi, state] : runs)
      out_.push_back({.object = model::ObjectId{object},
                      .edge = number,
                      .kind = e.kind,
                      .state = state,
                      .other = model::ObjectId{e.crosses() ? e.other : object},
                      .a = point(lo),
                      .b = point(hi)});
  }

  const model::Scene& scene_;
  const hlr::View& view_;
  const hlr::Options& options_;
  const std::vector<EdgePiece>& given_;
  Viewpoint sight_;
  std::vector<hlr::HalfSpace> window_;
  Vec low_, high_;
  mpq_class contact_;
  std::vector<Tile> tiles_;
  std::vector<EdgePiece> out_;
  std::uint32_t edge_number_ = 0;
};

std::string text_of(const EdgePiece& p) {
  std::ostringstream s;
  s << "object " << model::index(p.object) << " edge " << p.edge << " kind "
    << static_cast<int>(p.kind) << " state " << static_cast<int>(p.state) << " (" << p.a.x << ' '
    << p.a.y << ' ' << p.a.z << ") (" << p.b.x << ' ' << p.b.y << ' ' << p.b.z << ")";
  return s.str();
}

}  // namespace

std::vector<EdgePiece> oracle_pieces(const model::Scene& scene, const hlr::View& view,
                                     const hlr::Options& options,
                                     const std::vector<EdgePiece>& lines) {
  return Oracle(scene, view, options, lines).pieces();
}

std::string text(const std::vector<EdgePiece>& pieces) {
  std::string all;
  for (const EdgePiece& p : pieces) all += text_of(p) + '\n';
  return all;
}

bool same_piece(const EdgePiece& x, const EdgePiece& y) {
  return x.object == y.object && x.edge == y.edge && x.kind == y.kind && x.state == y.state &&
         x.a == y.a && x.b == y.b;
}

std::string difference(const std::vector<EdgePiece>& expected, const std::vector<EdgePiece>& got) {
  for (std::size_t i = 0; i < std::max(expected.size(), got.size()); ++i) {
    if (i < expected.size() && i < got.size() && same_piece(expected[i], got[i])) continue;
    return "piece " + std::to_string(i) + "\n expected " +
           (i < expected.size() ? text_of(expected[i]) : "none") + "\n got      " +
           (i < got.size() ? text_of(got[i]) : "none");
  }
  return {};
}

}  // namespace strake::test
