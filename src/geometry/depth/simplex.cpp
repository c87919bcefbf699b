// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/simplex.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/depth/radius_lp.hpp"

namespace strake::geometry {
namespace {

/// Triangles near a simplex beyond which its skin is not looked at for cuts: too large a simplex.
constexpr std::size_t kMostNear = 48;
/// How often the triangle nearest to where the bound is attained is taken in.
constexpr int kRefinements = 3;

/// The cosine of normals that count as one.
constexpr double kSameNormal = 1 - 1e-9;
/// How far, in grid units, the snap may lift a coplanar neighbour out of a triangle's plane.
constexpr double kSnapLift = 8;

using Values = std::array<double, 4>;  ///< of a function at the corners

/// n·x <= offset.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

Vec3d corner(const Simplex& s, std::size_t i) { return s.corner[i].at; }

/// The outward planes of a simplex's faces; none for a face without area.
std::vector<HalfSpace> faces_of(const Simplex& s) {
  std::vector<HalfSpace> faces;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d p = corner(s, (i + 1) % 4), q = corner(s, (i + 2) % 4), r = corner(s, (i + 3) % 4);
    Vec3d n = cross(q - p, r - p);
    const double size = length(n);
    if (!(size > 0)) continue;
    n = n * ((dot(n, corner(s, i) - p) > 0 ? -1 : 1) / size);
    faces.push_back({n, dot(n, p)});
  }
  return faces;
}

/// The plane of a triangle, outward; none for one without area.
std::optional<HalfSpace> plane_of(const DepthField& field, std::uint32_t triangle) {
  const Corners c = corners_of(field.part(), triangle);
  const Vec3d n = normal_of(c);
  const double size = length(n);
  if (!(size > 0)) return std::nullopt;
  const Vec3d unit = n * (1 / size);
  return HalfSpace{unit, dot(unit, field.common(c[0]))};
}

Corners placed(const DepthField& field, std::uint32_t triangle) {
  const Corners c = corners_of(field.part(), triangle);
  return {field.common(c[0]), field.common(c[1]), field.common(c[2])};
}

/// All points lie on one side of a plane, farther than `by` from it.
bool on_one_side(std::span<const Vec3d> points, const HalfSpace& plane, double by) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vec3d& p : points) {
    const double height = dot(plane.normal, p) - plane.offset;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return lowest > by || highest < -by;
}

/// Whether a triangle misses a simplex's shadow and what is just above it: it lies beyond one of
/// the shadow's sides, seen along the normal, or has the shadow on one side of it.
bool beside(const DepthField& field, std::uint32_t t, const std::array<Vec3d, 4>& shadow,
            const Vec3d& normal, double slack) {
  const Corners triangle = placed(field, t);
  const auto plane = plane_of(field, t);
  if (plane && on_one_side(shadow, *plane, kSnapLift + 4 * slack)) return true;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      Vec3d out = cross(shadow[j] - shadow[i], normal);
      const double size = length(out);
      if (!(size > 0)) continue;
      out = out * (1 / size);
      const auto height = [&](const Vec3d& p) { return dot(out, p - shadow[i]); };
      double lowest = 0, highest = 0;
      for (const Vec3d& p : shadow) {
        lowest = std::min(lowest, height(p));
        highest = std::max(highest, height(p));
      }
      const auto all_above = [&](double h) {
        return std::all_of(triangle.begin(), triangle.end(),
                           [&](const Vec3d& p) { return height(p) > h; });
      };
      const auto all_below = [&](double h) {
        return std::all_of(triangle.begin(), triangle.end(),
                           [&](const Vec3d& p) { return height(p) < h; });
      };
      if (all_above(highest + 2 * slack) || all_below(lowest - 2 * slack)) return true;
    }
  return false;
}

/// The triangles in a box, unless there are too many to look at.
std::optional<std::vector<std::uint32_t>> triangles_in(const DepthField& field, const Box3d& box) {
  std::vector<std::uint32_t> found, stack;
  const Box3d local{field.local(box.lo), field.local(box.hi)};
  const auto& nodes = field.tree().nodes();
  if (!nodes.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const PartTree::Node& node = nodes[stack.back()];
    stack.pop_back();
    if (!node.box.as<double>().meets(local)) continue;
    if (node.count == 0) {
      stack.push_back(node.first);
      stack.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t t = field.tree().order()[i];
      if (!box_of(placed(field, t)).meets(box)) continue;
      if (found.size() == kMostNear) return std::nullopt;
      found.push_back(t);
    }
  }
  return found;
}

/// The plane just above a triangle, if the shadow that a simplex casts on it along the normal lies
/// outside the part as a whole: so far above a point of the simplex that is in the part, the skin
/// is at the latest.
std::optional<HalfSpace> lid(const DepthField& field, const Simplex& s, std::uint32_t triangle,
                             double slack, PairWork& work) {
  const auto own = plane_of(field, triangle);
  if (!own) return std::nullopt;
  std::array<Vec3d, 4> shadow;
  for (std::size_t i = 0; i < 4; ++i)
    shadow[i] = corner(s, i) + own->normal * (own->offset - dot(own->normal, corner(s, i)));
  const auto near = triangles_in(field, box_of(shadow).inflated(kSnapLift + 2 * slack));
  if (!near) return std::nullopt;
  double top = own->offset;
  for (const std::uint32_t t : *near) {
    const Corners c = placed(field, t);
    const double highest =
        std::max({dot(own->normal, c[0]), dot(own->normal, c[1]), dot(own->normal, c[2])});
    if (highest <= own->offset + kSnapLift)
      top = std::max(top, highest);
    else if (!beside(field, t, shadow, own->normal, slack))
      return std::nullopt;
  }
  top += slack;
  Vec3d middle;
  for (const Vec3d& p : shadow) middle = middle + p * 0.25;
  const Vec3d witness = on_field_grid(middle + own->normal * (top - own->offset + slack));
  // Nothing crosses the shadow at the height of the witness, so that one point speaks for all.
  if (field.contains(witness, work)) return std::nullopt;
  return HalfSpace{own->normal, top + 2 * slack};
}

/// What one part's skin looks like within one simplex.
class Skin {
 public:
  Skin(const DepthField& field, const Simplex& s, double slack)
      : field_(field), slack_(slack), faces_(faces_of(s)) {
    Box3d box = empty_box<double>();
    for (const SimplexCorner& c : s.corner) box.include(c.at);
    const auto in_box = triangles_in(field, box.inflated(2 * slack));
    complete_ = in_box.has_value();
    if (!complete_) return;
    for (const std::uint32_t t : *in_box)
      if (!apart(s, t)) near_.push_back(t);
  }

  /// No skin comes near the simplex.
  [[nodiscard]] bool absent() const { return complete_ && near_.empty(); }

  /// Planes above which all of the simplex is outside the part. `outside`: which of its corners
  /// are known to be, as the points where that was found.
  [[nodiscard]] std::vector<HalfSpace> cuts(std::span<const Vec3d> outside) const {
    std::vector<HalfSpace> planes;
    if (!complete_) return planes;
    for (const std::uint32_t t : near_) {
      const auto plane = cut(t, outside);
      const auto same = [&](const HalfSpace& h) {
        return dot(h.normal, plane->normal) > kSameNormal;
      };
      if (plane && std::none_of(planes.begin(), planes.end(), same)) planes.push_back(*plane);
    }
    return planes;
  }

 private:
  /// Above the plane of a triangle the simplex is convex: without skin there, all of it is where
  /// one point of it is.
  [[nodiscard]] std::optional<HalfSpace> cut(std::uint32_t triangle,
                                             std::span<const Vec3d> outside) const {
    const auto own = plane_of(field_, triangle);
    if (!own) return std::nullopt;
    const auto some_above = [&](double offset) {
      return std::any_of(outside.begin(), outside.end(),
                         [&](const Vec3d& p) { return dot(own->normal, p) > offset; });
    };
    if (!some_above(own->offset)) return std::nullopt;
    double top = own->offset;
    for (const std::uint32_t t : near_) {
      for (const Vec3d& p : placed(field_, t)) top = std::max(top, dot(own->normal, p));
      if (top > own->offset + kSnapLift) return std::nullopt;
    }
    top += slack_;
    return some_above(top) ? std::optional(HalfSpace{own->normal, top}) : std::nullopt;
  }

  /// A face of the simplex has all of the triangle beyond it, or the other way round.
  [[nodiscard]] bool apart(const Simplex& s, std::uint32_t t) const {
    const Corners c = placed(field_, t);
    const bool beyond = std::any_of(faces_.begin(), faces_.end(), [&](const HalfSpace& f) {
      return std::all_of(c.begin(), c.end(),
                         [&](const Vec3d& p) { return dot(f.normal, p) > f.offset + 2 * slack_; });
    });
    if (beyond) return true;
    const auto plane = plane_of(field_, t);
    const std::array<Vec3d, 4> corners{corner(s, 0), corner(s, 1), corner(s, 2), corner(s, 3)};
    return plane && on_one_side(corners, *plane, 2 * slack_);
  }

  const DepthField& field_;
  double slack_;
  std::vector<HalfSpace> faces_;
  std::vector<std::uint32_t> near_;
  bool complete_ = false;
};

/// Maximise t over the simplex under t <= the linear functions given by their corner values, and
/// under half-spaces, in barycentric coordinates about the corner where the first is greatest.
class Program {
 public:
  Program(const Simplex& s, const Values& first) : simplex_(s) {
    for (std::size_t i = 1; i < 4; ++i)
      if (first[i] > first[base_]) base_ = i;
    for (const double v : first) scale_ = std::max(scale_, std::fabs(v));
    for (int k = 0; k < 3; ++k) {
      Vec3d n;
      n[k] = -1;
      rows_.push_back({n, 0, 0});
    }
    below(first);
    rows_.push_back({{1, 1, 1}, 0, 1});
  }

  void below(const Values& f) {
    Vec3d n;
    for (int k = 0; k < 3; ++k) n[k] = (f[base_] - f[index(k)]) / scale_;
    rows_.push_back({n, 1, f[base_] / scale_});
  }

  void within(const HalfSpace& h) {
    Vec3d n;
    const Vec3d base = corner(simplex_, base_);
    double size = 0;
    for (int k = 0; k < 3; ++k) {
      n[k] = dot(h.normal, corner(simplex_, index(k)) - base);
      size = std::max(size, std::fabs(n[k]));
    }
    if (!(size > 0)) return;
    rows_.push_back({n * (1 / size), 0, (h.offset - dot(h.normal, base)) / size});
  }

  [[nodiscard]] SimplexBound solve() const {
    const RadiusSolution r = maximise_radius({rows_, 1});
    SimplexBound bound{r.upper * scale_, corner(simplex_, base_)};
    for (int k = 0; k < 3; ++k)
      bound.point = bound.point + (corner(simplex_, index(k)) - corner(simplex_, base_)) *
                                      std::clamp(r.x[k], 0.0, 1.0);
    return bound;
  }

 private:
  /// The corner that barycentric coordinate k belongs to.
  [[nodiscard]] std::size_t index(int k) const {
    return (base_ + static_cast<std::size_t>(k) + 1) % 4;
  }

  const Simplex& simplex_;
  std::size_t base_ = 0;
  double scale_ = 1;
  std::vector<RadiusConstraint> rows_;
};

using SampleOf = FieldSample SimplexCorner::*;
using Planes = std::vector<HalfSpace>;

/// The simplex lies within a ball round an outside point that no skin enters.
bool misses(const Simplex& s, const SimplexCorner& c, double distance, double slack) {
  return std::all_of(s.corner.begin(), s.corner.end(), [&](const SimplexCorner& v) {
    return length(v.at - c.sampled) + slack < distance;
  });
}

bool all_above(const Simplex& s, const HalfSpace& plane) {
  return std::all_of(s.corner.begin(), s.corner.end(), [&](const SimplexCorner& v) {
    return dot(plane.normal, v.at) > plane.offset;
  });
}

/// Planes that cut off what lies outside a part; nothing when that is all.
std::optional<Planes> cuts_of(const DepthField& field, SampleOf sample, const Simplex& s,
                              double slack) {
  std::vector<Vec3d> outside;
  for (const SimplexCorner& c : s.corner)
    if (!(c.*sample).inside) outside.push_back(c.sampled);
  if (outside.empty()) return Planes{};
  const Skin skin(field, s, slack);
  if (skin.absent()) return std::nullopt;
  Planes planes = skin.cuts(outside);
  for (const HalfSpace& plane : planes)
    if (all_above(s, plane)) return std::nullopt;
  return planes;
}

bool certainly_outside(SampleOf sample, const Simplex& s, double slack) {
  return std::any_of(s.corner.begin(), s.corner.end(), [&](const SimplexCorner& c) {
    return !(c.*sample).inside && misses(s, c, (c.*sample).distance, slack);
  });
}

/// Depth in one part, bounded better and better as it is asked to.
class Bounder {
 public:
  Bounder(const DepthField& field, SampleOf sample, const Simplex& s, double slack, PairWork& work)
      : field_(field), sample_(sample), simplex_(s), slack_(slack), work_(work) {
    for (const SimplexCorner& c : s.corner) add_unique(near_, (c.*sample).triangle);
    program_.emplace(s, to_triangle(near_[0]));
    for (std::size_t i = 1; i < near_.size(); ++i) program_->below(to_triangle(near_[i]));
    for (const SimplexCorner& c : s.corner)
      if (!(c.*sample).inside) program_->below(from_outside(c));
    best_ = program_->solve();
  }

  [[nodiscard]] const SimplexBound& best() const { return best_; }

  void cut(const Planes& own, const Planes& others) {
    for (const HalfSpace& plane : own) program_->within(plane);
    for (const HalfSpace& plane : others) program_->within(plane);
    solve();
  }

  void add_lids(const Planes& cuts) {
    for (const std::uint32_t t : near_) add_lid(t, cuts);
    solve();
    for (int i = 0; i < kRefinements; ++i) {
      const NearestTriangle nearest = field_.nearest(best_.point, near_[0]);
      if (!(nearest.distance < best_.upper) || !add_unique(near_, nearest.triangle)) return;
      program_->below(to_triangle(nearest.triangle));
      add_lid(nearest.triangle, cuts);
      solve();
    }
  }

 private:
  void solve() {
    const SimplexBound next = program_->solve();
    best_ = {std::min(best_.upper, next.upper), next.point};
  }

  static bool add_unique(std::vector<std::uint32_t>& all, std::uint32_t t) {
    if (std::find(all.begin(), all.end(), t) != all.end()) return false;
    all.push_back(t);
    return true;
  }

  [[nodiscard]] Values to_triangle(std::uint32_t t) const {
    const Corners c = corners_of(field_.part(), t);
    Values f{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3d p = field_.local(corner(simplex_, i));
      f[i] = length(p - nearest_on_triangle(p, c)) + slack_;
    }
    return f;
  }

  void add_lid(std::uint32_t triangle, const Planes& cuts) {
    const auto above = lid(field_, simplex_, triangle, slack_, work_);
    if (!above) return;
    const auto height = [&](const HalfSpace& h, std::size_t i) {
      return h.offset - dot(h.normal, corner(simplex_, i));
    };
    Values f{};
    for (std::size_t i = 0; i < 4; ++i) f[i] = std::fabs(height(*above, i));
    // Where a cut says that all of the part lies below the lid, heights above it do not count.
    const auto cut = std::find_if(cuts.begin(), cuts.end(), [&](const HalfSpace& h) {
      return dot(h.normal, above->normal) > kSameNormal;
    });
    if (cut != cuts.end()) {
      double between = 0;
      for (std::size_t i = 0; i < 4; ++i)
        between = std::max(between, std::fabs(height(*cut, i) - height(*above, i)));
      for (std::size_t i = 0; i < 4; ++i) f[i] = height(*cut, i) + between;
    }
    program_->below(f);
  }

  /// The way from a point outside to one inside crosses the skin: what lies beyond it is depth.
  [[nodiscard]] Values from_outside(const SimplexCorner& c) const {
    Values f{};
    for (std::size_t i = 0; i < 4; ++i)
      f[i] = length(corner(simplex_, i) - c.sampled) - (c.*sample_).distance + slack_;
    return f;
  }

  const DepthField& field_;
  SampleOf sample_;
  const Simplex& simplex_;
  double slack_;
  PairWork& work_;
  std::vector<std::uint32_t> near_;
  std::optional<Program> program_;
  SimplexBound best_;
};

}  // namespace

std::optional<std::array<SimplexBound, 2>> bound_depth(const DepthField& a, const DepthField& b,
                                                       const Simplex& s, double slack,
                                                       double enough, PairWork& work) {
  constexpr SampleOf kA = &SimplexCorner::a, kB = &SimplexCorner::b;
  if (certainly_outside(kA, s, slack) || certainly_outside(kB, s, slack)) return std::nullopt;
  Bounder in_a(a, kA, s, slack, work), in_b(b, kB, s, slack, work);
  const auto undecided = [&] { return in_a.best().upper > enough || in_b.best().upper > enough; };
  if (undecided()) {
    const auto cuts_a = cuts_of(a, kA, s, slack), cuts_b = cuts_of(b, kB, s, slack);
    if (!cuts_a || !cuts_b) return std::nullopt;
    if (in_a.best().upper > enough) in_a.cut(*cuts_a, *cuts_b);
    if (in_b.best().upper > enough) in_b.cut(*cuts_b, *cuts_a);
    if (in_a.best().upper > enough) in_a.add_lids(*cuts_a);
    if (in_b.best().upper > enough) in_b.add_lids(*cuts_b);
  }
  return std::array{in_a.best(), in_b.best()};
}

}  // namespace strake::geometry
