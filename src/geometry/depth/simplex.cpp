// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/simplex.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/depth/cell_skin.hpp"
#include "geometry/depth/radius_lp.hpp"
#include "geometry/depth/roof.hpp"

namespace strake::geometry {
namespace {

/// How often the triangle nearest to where the bound is attained is taken in.
constexpr int kRefinements = 3;

using Values = std::array<double, 4>;  ///< of a function at the corners

Vec3d corner(const Simplex& s, std::size_t i) { return s.corner[i].at; }

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

  /// Where the linear function is 0 or more.
  void where(const Values& f) {
    double size = 0;
    for (const double v : f) size = std::max(size, std::fabs(v));
    if (!(size > 0)) return;
    Vec3d n;
    for (int k = 0; k < 3; ++k) n[k] = (f[base_] - f[index(k)]) / size;
    rows_.push_back({n, 0, f[base_] / size});
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

  /// Planes that cut off what lies outside the part; nothing when that is all.
  std::optional<Planes> cuts() {
    skin_.emplace(field_, simplex_, slack_);
    for (const SimplexCorner& c : simplex_.corner)
      if (!(c.*sample_).inside) outside_.push_back(c.sampled);
    if (outside_.empty()) return Planes{};
    if (skin_->absent()) return std::nullopt;
    Planes planes = skin_->cuts(outside_);
    for (const HalfSpace& plane : planes)
      if (all_above(simplex_, plane)) return std::nullopt;
    return planes;
  }

  void cut(const Planes& own, const Planes& others) {
    for (const HalfSpace& plane : own) program_->within(plane);
    for (const HalfSpace& plane : others) program_->within(plane);
    solve();
  }

  /// After cuts().
  void add_roofs() {
    if (std::exchange(has_roofs_, true)) return;
    for (const std::uint32_t t : near_) add_roof(t);
    solve();
  }
  /// Linear functions that are 0 or more wherever the part is, as far as is known. After cuts().
  [[nodiscard]] const std::vector<Values>& rooms() {
    add_roofs();
    return rooms_;
  }

  void stay_in(const std::vector<Values>& rooms) {
    for (const Values& f : rooms) program_->where(f);
    solve();
  }

  void refine() {
    for (int i = 0; i < kRefinements; ++i) {
      const NearestTriangle nearest = field_.nearest(best_.point, near_[0]);
      if (!(nearest.distance < best_.upper) || !add_unique(near_, nearest.triangle)) return;
      program_->below(to_triangle(nearest.triangle));
      add_roof(nearest.triangle);
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
    const Corners c = field_.corners(t);
    Values f{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3d p = field_.local(corner(simplex_, i));
      f[i] = length(p - nearest_on_triangle(p, c)) + slack_;
    }
    return f;
  }

  void add_roof(std::uint32_t triangle) {
    if (std::find(roofed_.begin(), roofed_.end(), triangle) != roofed_.end()) return;
    const auto roof = roof_over(field_, simplex_, *skin_, triangle, outside_, slack_, work_);
    if (!roof) return;
    roofed_.insert(roofed_.end(), roof->triangles.begin(), roof->triangles.end());
    program_->below(roof->depth);
    if (roof->holds_all) rooms_.push_back(roof->depth);
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
  std::vector<std::uint32_t> near_, roofed_;
  bool has_roofs_ = false;
  std::vector<Values> rooms_;  ///< no less than 0 in the part
  std::vector<Vec3d> outside_;
  std::optional<Skin> skin_;
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
    const auto cuts_a = in_a.cuts(), cuts_b = in_b.cuts();
    if (!cuts_a || !cuts_b) return std::nullopt;
    if (in_a.best().upper > enough) in_a.cut(*cuts_a, *cuts_b);
    if (in_b.best().upper > enough) in_b.cut(*cuts_b, *cuts_a);
    if (in_a.best().upper > enough) in_a.add_roofs();
    if (in_b.best().upper > enough) in_b.add_roofs();
    if (in_a.best().upper > enough) in_a.stay_in(in_b.rooms());
    if (in_b.best().upper > enough) in_b.stay_in(in_a.rooms());
    if (in_a.best().upper > enough) in_a.refine();
    if (in_b.best().upper > enough) in_b.refine();
  }
  return std::array{in_a.best(), in_b.best()};
}

}  // namespace strake::geometry
