// SPDX-License-Identifier: Apache-2.0
#include "support/ray_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "model/scene/view_tessellation.hpp"
#include "strake/geometry/wide_int.hpp"
#include "support/lattice_scene.hpp"

namespace strake::test {
namespace {

using geometry::Int128;
using geometry::Vec3d;
using geometry::Vec3l;

// Points are at whole kShares-ths of a grid unit along the longest axis of their edge.
constexpr std::int64_t kShares = 64;
// With coordinates and their differences below this, every value formed stays below 2^126.
constexpr std::int64_t kFarthest = std::int64_t{1} << 29;

struct Wide {
  Int128 x = 0, y = 0, z = 0;
};

Wide cross(const Vec3l& u, const Vec3l& v) {
  const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    return static_cast<Int128>(a) * d - static_cast<Int128>(b) * c;
  };
  return {minor(u.y, u.z, v.y, v.z), minor(u.z, u.x, v.z, v.x), minor(u.x, u.y, v.x, v.y)};
}
Int128 dot(const Wide& n, const Vec3l& v) { return n.x * v.x + n.y * v.y + n.z * v.z; }
Int128 dot(const Wide& n, const Wide& v) { return n.x * v.x + n.y * v.y + n.z * v.z; }
Int128 magnitude(Int128 x) { return x < 0 ? -x : x; }
Int128 one_norm(const Wide& n) { return magnitude(n.x) + magnitude(n.y) + magnitude(n.z); }

/// A triangle that is not seen edge-on.
struct Facet {
  std::array<Vec3l, 3> corner;  ///< counter-clockwise to the viewer
  std::uint32_t object = 0;
  std::uint32_t part = 0;  ///< number of the part within its object
  std::uint32_t body = 0;  ///< of the model
};

/// An edge of a mesh, or a segment of a wire.
struct Segment {
  Vec3l a, b;
  std::uint32_t part = 0;  ///< number of the part within its object
  std::uint32_t body = 0;  ///< of the model
};

/// The point of a segment that is judged: at / scale.
struct Sample {
  Wide at;
  std::int64_t scale = 1;
  Wide left;  ///< direction x edge: to the left of the edge on paper
};

enum Side : unsigned { kNeither = 0, kLeft = 1, kRight = 2, kBoth = 3 };

/// On which sides of its edge the point lies under the inside of the facet; nothing when a facet's
/// edge runs square to it through the very point, so that a shift sideways decides nothing.
std::optional<unsigned> sides_under(const Facet& f, const Vec3l& d, const Sample& p) {
  unsigned sides = kBoth;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3l& corner = f.corner[k];
    const Wide across = cross(d, f.corner[(k + 1) % 3] - corner);  // positive towards the inside
    const Wide offset{p.at.x - static_cast<Int128>(corner.x) * p.scale,
                      p.at.y - static_cast<Int128>(corner.y) * p.scale,
                      p.at.z - static_cast<Int128>(corner.z) * p.scale};
    const Int128 inside = dot(across, offset);
    if (inside < 0) return kNeither;
    if (inside > 0) continue;
    const Int128 turn = dot(across, p.left);
    if (turn == 0) return std::nullopt;
    sides &= turn > 0 ? kLeft : kRight;
  }
  return sides;
}

bool is_deeper(const Facet& f, const Sample& p, std::int64_t distance) {
  const auto& c = f.corner;
  const Wide normal = cross(c[1] - c[0], c[2] - c[0]);
  const Wide offset{static_cast<Int128>(c[0].x) * p.scale - p.at.x,
                    static_cast<Int128>(c[0].y) * p.scale - p.at.y,
                    static_cast<Int128>(c[0].z) * p.scale - p.at.z};
  return dot(normal, offset) > one_norm(normal) * distance * p.scale;
}

/// Squares over the plane of the view, each with the triangles that may be met in it. Doubles, with
/// a margin far above their rounding: the grid only leaves out.
class Squares {
 public:
  Squares(std::span<const Facet> facets, const Vec3l& direction) {
    const Vec3d d = direction.as<double>();
    right_ = geometry::cross(std::fabs(d.x) < std::fabs(d.y) ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}, d);
    right_ = right_ * (1 / std::sqrt(geometry::dot(right_, right_)));
    up_ = geometry::cross(d, right_) * (1 / std::sqrt(geometry::dot(d, d)));
    measure(facets);
    first_.assign(n_ * n_ + 1, 0);
    for (const Facet& f : facets) visit(f, [&](std::size_t s) { ++first_[s + 1]; });
    for (std::size_t s = 0; s < n_ * n_; ++s) first_[s + 1] += first_[s];
    items_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < facets.size(); ++i)
      visit(facets[i], [&](std::size_t s) { items_[next[s]++] = i; });
  }

  [[nodiscard]] std::span<const std::uint32_t> at(const Vec3d& p) const {
    const std::size_t s =
        step(geometry::dot(p, up_) - low_[1]) * n_ + step(geometry::dot(p, right_) - low_[0]);
    return std::span(items_).subspan(first_[s], first_[s + 1] - first_[s]);
  }

 private:
  static constexpr double kMargin = 16;

  [[nodiscard]] std::array<double, 2> flat(const Vec3l& p) const {
    const Vec3d v = p.as<double>();
    return {geometry::dot(v, right_), geometry::dot(v, up_)};
  }
  [[nodiscard]] std::size_t step(double offset) const {
    const double s = std::floor(offset / size_);
    return s <= 0 ? 0 : std::min(n_ - 1, static_cast<std::size_t>(s));
  }
  void measure(std::span<const Facet> facets) {
    std::array<double, 2> high{-1e300, -1e300};
    low_ = {1e300, 1e300};
    for (const Facet& f : facets)
      for (const Vec3l& corner : f.corner)
        for (std::size_t k = 0; k < 2; ++k) {
          low_[k] = std::min(low_[k], flat(corner)[k]);
          high[k] = std::max(high[k], flat(corner)[k]);
        }
    const double root = std::sqrt(static_cast<double>(facets.size()));
    n_ = std::clamp<std::size_t>(static_cast<std::size_t>(root), 1, 1000);
    size_ = std::max({high[0] - low_[0], high[1] - low_[1], 1.0}) / static_cast<double>(n_);
  }
  template <class Visit>
  void visit(const Facet& f, Visit&& visit) const {
    const auto p = flat(f.corner[0]), q = flat(f.corner[1]), r = flat(f.corner[2]);
    const auto [u0, u1] = std::minmax({p[0], q[0], r[0]});
    const auto [v0, v1] = std::minmax({p[1], q[1], r[1]});
    for (std::size_t j = step(v0 - kMargin - low_[1]); j <= step(v1 + kMargin - low_[1]); ++j)
      for (std::size_t i = step(u0 - kMargin - low_[0]); i <= step(u1 + kMargin - low_[0]); ++i)
        visit(j * n_ + i);
  }

  Vec3d right_, up_;
  std::array<double, 2> low_{};
  double size_ = 1;
  std::size_t n_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> items_;
};

/// Calls visit(part, its number within the object, its offset, the body).
template <class Visit>
void for_each_part(const model::Scene& scene, std::uint32_t object, const Vec3l& origin,
                   Visit&& visit) {
  std::uint32_t number = 0;
  for (const model::GridBody& body : scene.bodies_of(model::ObjectId{object}))
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts)
      visit(part, number++, body.origin - origin, body);
}

std::vector<Facet> facets_of(const model::Scene& scene, const Vec3l& d, const Vec3l& origin) {
  std::vector<Facet> facets;
  for (std::uint32_t object = 0; object < scene.model->objects.size(); ++object)
    for_each_part(scene, object, origin, [&](const auto& part, auto number, auto at, auto& body) {
      if (scene.model->bodies[body.body].color.alpha != 255) return;
      for (const geometry::Triangle& t : part.triangles) {
        Facet f{{}, object, number, body.body};
        for (std::size_t k = 0; k < 3; ++k)
          f.corner[k] = part.vertices[t[k]].template as<std::int64_t>() + at;
        const Int128 facing = dot(cross(f.corner[1] - f.corner[0], f.corner[2] - f.corner[0]), d);
        if (facing == 0) continue;
        if (facing < 0) std::swap(f.corner[1], f.corner[2]);
        facets.push_back(f);
      }
    });
  return facets;
}

/// The edges of an object's meshes, or the segments of its wires.
std::vector<Segment> segments_of(const model::Scene& scene, std::uint32_t object,
                                 const Vec3l& origin, bool wires) {
  std::vector<Segment> segments;
  for_each_part(scene, object, origin, [&](const auto& part, auto number, auto at, auto& body) {
    const auto add = [&](std::uint32_t v, std::uint32_t w) {
      const Vec3l p = part.vertices[v].template as<std::int64_t>() + at;
      const Vec3l q = part.vertices[w].template as<std::int64_t>() + at;
      segments.push_back({p, q, number, body.body});
    };
    if (!wires)
      for (const geometry::Triangle& t : part.triangles)
        for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3]);
    if (wires && part.kind == geometry::PartKind::wire)
      for (std::size_t c = 0; c + 1 < part.chain_first.size(); ++c)
        for (std::uint32_t v = part.chain_first[c]; v + 1 < part.chain_first[c + 1]; ++v)
          add(v, v + 1);
  });
  return segments;
}

/// Whether p, rounded to the grid, may come from a point of the segment: within half a unit of it
/// in each coordinate.
bool may_lie_on(const Vec3l& p, const Segment& s) {
  const Vec3l along = s.b - s.a, off = p - s.a;
  for (int k = 0; k < 3; ++k)
    if (p[k] < std::min(s.a[k], s.b[k]) || p[k] > std::max(s.a[k], s.b[k])) return false;
  for (int k = 0; k < 3; ++k) {
    const int m = (k + 1) % 3;
    const Int128 area =
        static_cast<Int128>(along[k]) * off[m] - static_cast<Int128>(along[m]) * off[k];
    if (2 * magnitude(area) > std::abs(along[k]) + std::abs(along[m])) return false;
  }
  return true;
}

int longest_axis(const Vec3l& v) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(v[k]) > std::abs(v[axis])) axis = k;
  return axis;
}

/// What is found at one point: on which sides the own object hides it, and on which all do.
struct Found {
  unsigned own = 0, all = 0;
  bool decided = true;
};

class Checker {
 public:
  Checker(const model::Scene& scene, const hlr::Drawing& drawing)
      : scene_(scene),
        options_(drawing.options),
        d_(drawing.view.direction),
        origin_(scene.bodies.empty() ? Vec3l{} : scene.bodies[0].origin),
        facets_(facets_of(scene, d_, origin_)),
        squares_(facets_, d_),
        segments_(scene.model->objects.size()),
        wires_(scene.model->objects.size()) {}

  [[nodiscard]] bool within_reach() const {
    Vec3l lo{kFarthest, kFarthest, kFarthest}, hi{-kFarthest, -kFarthest, -kFarthest};
    for (const Facet& f : facets_)
      for (const Vec3l& p : f.corner)
        for (int k = 0; k < 3; ++k) {
          lo[k] = std::min(lo[k], p[k]);
          hi[k] = std::max(hi[k], p[k]);
        }
    for (int k = 0; k < 3; ++k)
      if (hi[k] - lo[k] >= kFarthest) return false;
    return true;
  }

  /// Nothing when the piece is too short to hold a point that is surely within it, and for
  /// intersections, which are no edges of the model.
  [[nodiscard]] std::optional<bool> is_right(const hlr::EdgePiece& piece, Random& random) {
    const Vec3l a = piece.a - origin_, b = piece.b - origin_;
    const int axis = longest_axis(b - a);
    const std::int64_t least = std::min(a[axis], b[axis]) + 1,
                       most = std::max(a[axis], b[axis]) - 1;
    if (most <= least || piece.kind == hlr::EdgeKind::intersection) return std::nullopt;
    const std::uint32_t object = model::index(piece.object);
    const bool wire = piece.kind == hlr::EdgeKind::polyline;
    // Where parts of an object share an edge the piece may be either's.
    bool any = false;
    for (int attempt = 0; attempt < 8; ++attempt) {
      const auto width = static_cast<std::uint64_t>(most - least) * kShares;
      const std::int64_t place = least * kShares + static_cast<std::int64_t>(random.next() % width);
      bool decided = true;
      for (const Segment& s : segments(object, wire)) {
        if (!may_lie_on(a, s) || !may_lie_on(b, s)) continue;
        const Found found = classify_point(s, axis, place, object, wire);
        decided = decided && found.decided;
        any = any || (found.decided && state_of(found) == piece.state);
      }
      if (decided || any) break;
    }
    return any;
  }

 private:
  static hlr::State state_of(const Found& found) {
    if (found.own == kBoth) return hlr::State::hidden_by_self;
    return found.all == kBoth ? hlr::State::hidden_by_other : hlr::State::visible;
  }

  const std::vector<Segment>& segments(std::uint32_t object, bool wire) {
    std::vector<Segment>& list = (wire ? wires_ : segments_)[object];
    if (list.empty()) list = segments_of(scene_, object, origin_, wire);
    return list;
  }

  [[nodiscard]] Sample sample(const Segment& s, int axis, std::int64_t place) const {
    const Vec3l along = s.b - s.a;
    const std::int64_t sign = along[axis] < 0 ? -1 : 1;
    const std::int64_t length = sign * along[axis];
    const std::int64_t gone = sign * (place - s.a[axis] * kShares);
    const std::int64_t scale = length * kShares;
    const auto at = [&](std::int64_t from, std::int64_t step) {
      return static_cast<Int128>(from) * scale + static_cast<Int128>(step) * gone;
    };
    return {{at(s.a.x, along.x), at(s.a.y, along.y), at(s.a.z, along.z)}, scale, cross(d_, along)};
  }

  [[nodiscard]] Found classify_point(const Segment& s, int axis, std::int64_t place,
                                     std::uint32_t object, bool wire) const {
    const Sample p = sample(s, axis, place);
    const double one = 1.0 / static_cast<double>(p.scale);
    const Vec3d near{static_cast<double>(p.at.x) * one, static_cast<double>(p.at.y) * one,
                     static_cast<double>(p.at.z) * one};
    Found found;
    for (const std::uint32_t i : squares_.at(near)) {
      const Facet& f = facets_[i];
      const bool same = f.object == object;
      if (same && wire && options_.own_polylines == hlr::OwnPolylines::visible) continue;
      const std::optional<unsigned> sides = sides_under(f, d_, p);
      if (sides == kNeither) continue;
      const std::int64_t contact =
          same && f.part == s.part ? 0 : std::max(contact_of(f.body), contact_of(s.body));
      if (!is_deeper(f, p, contact)) continue;
      found.decided = found.decided && sides.has_value();
      found.all |= sides.value_or(kNeither);
      if (same) found.own |= sides.value_or(kNeither);
    }
    return found;
  }

  // The rule of docs/hlr.md, written once more: 3 units or two spacings of the source's numbers.
  [[nodiscard]] std::int64_t contact_of(std::uint32_t body) const {
    if (options_.contact_distance_mm >= 0) return std::llround(options_.contact_distance_mm * 1000);
    const auto half = static_cast<double>(scene_.model->bodies[body].precision_um);
    return std::max<std::int64_t>(3, std::llround(std::ceil(4 * half)));
  }

  const model::Scene& scene_;
  hlr::Options options_;
  Vec3l d_, origin_;
  std::vector<Facet> facets_;
  Squares squares_;
  std::vector<std::vector<Segment>> segments_, wires_;  ///< per object, made when first requested
};

std::string text_of(const Vec3l& p) {
  return "(" + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + ")";
}

/// Pieces that have a state to judge, and how far along all of them each ends.
struct Candidates {
  std::vector<std::uint32_t> piece;
  std::vector<double> end;

  explicit Candidates(const hlr::Drawing& drawing) {
    double total = 0;
    for (std::uint32_t i = 0; i < drawing.pieces.size(); ++i) {
      const hlr::EdgePiece& p = drawing.pieces[i];
      if (p.state == hlr::State::projecting || p.state == hlr::State::clipped) continue;
      const Vec3d v = (p.b - p.a).as<double>();
      piece.push_back(i);
      end.push_back(total += std::sqrt(geometry::dot(v, v)));
    }
  }
  [[nodiscard]] std::uint32_t choose(Random& random, bool by_length) const {
    if (!by_length) return piece[random.next() % piece.size()];
    const double at = end.back() * static_cast<double>(random.next() >> 11) * 0x1p-53;
    const auto found = std::upper_bound(end.begin(), end.end(), at);
    return piece[static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(found - end.begin(), std::ssize(piece) - 1))];
  }
};

}  // namespace

RayCheck check_by_rays(const model::Scene& scene, const hlr::Drawing& drawing, std::uint64_t rays,
                       std::uint64_t seed) {
  RayCheck result;
  const Candidates candidates(drawing);
  if (candidates.piece.empty()) return result;
  const auto tessellation_options = hlr::tessellation_of(drawing.view, drawing.options);
  if (!tessellation_options) return result;
  const auto tessellated = model::tessellate_for_view(scene, {}, *tessellation_options, {});
  if (!tessellated) return result;
  Checker checker(*tessellated ? **tessellated : scene, drawing);
  if (!checker.within_reach()) {
    result.wrong = 1;
    result.first_wrong = "the scene is too large for this check";
    return result;
  }
  Random random(seed);
  while (result.rays < rays && result.too_short < 4 * rays) {
    const hlr::EdgePiece& piece = drawing.pieces[candidates.choose(random, result.rays % 2 == 1)];
    const std::optional<bool> right = checker.is_right(piece, random);
    if (!right) {
      ++result.too_short;
      continue;
    }
    ++result.rays;
    if (*right || result.wrong++ > 0) continue;
    result.first_wrong = "object " + scene.model->object(piece.object).id + " edge " +
                         std::to_string(piece.edge) + " state " +
                         std::to_string(static_cast<int>(piece.state)) + " from " +
                         text_of(piece.a) + " to " + text_of(piece.b);
  }
  return result;
}

}  // namespace strake::test
