// SPDX-License-Identifier: Apache-2.0
#include "support/ray_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/lattice_scene.hpp"

namespace strake::test {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

constexpr double kRounding = 3;  // grid units

struct Flat {
  std::array<std::array<double, 2>, 3> p{};  // on paper, counter-clockwise
  Vec3d corner, normal;                      // unit normal towards the viewer
  double facing = 0;                         // normal · d
  double steepness = 0;                      // 1-norm of the unit normal
  std::uint32_t body = 0, part = 0;
};

double length(const Vec3d& v) { return std::sqrt(dot(v, v)); }

class Checker {
 public:
  Checker(const model::Scene& scene, const hlr::Drawing& drawing)
      : scene_(scene), drawing_(drawing) {
    const auto d = drawing.view.direction.as<double>();
    d_ = d * (1 / length(d));
    const Vec3d any = std::fabs(d_.x) < 0.8 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    right_ = cross(any, d_);
    right_ = right_ * (1 / length(right_));
    up_ = cross(d_, right_);
    if (!scene.bodies.empty()) origin_ = scene.bodies[0].origin;
    collect();
    build_grid();
  }

  // Empty when the piece's state is right at the share s of its length.
  [[nodiscard]] bool right(const hlr::Piece& piece, double s) const {
    const Vec3d a = (piece.a - origin_).as<double>(), b = (piece.b - origin_).as<double>();
    const Vec3d p = a + (b - a) * s;
    const double u = dot(p, right_), v = dot(p, up_);
    const bool hidden = piece.state != hlr::State::visible;
    bool maybe = false;
    const std::size_t cell = cell_of(u, v);
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      const Flat& f = flats_[item_[i]];
      const bool own_object = scene_.bodies[f.body].object == piece.object;
      if (own_object && piece.kind == hlr::EdgeKind::polyline) continue;
      const double inside = margin(f, u, v);
      const double depth = dot(f.normal, f.corner - p);
      // Which part of its object a piece comes from is not recorded: within the object either
      // distance may be the right one.
      const double needed = contact(f.body, piece) * f.steepness;
      const bool clearly =
          inside > kRounding && depth > needed + kRounding && !(own_object && depth < kRounding);
      const bool nearly = inside > -kRounding && depth > (own_object ? 0 : needed) - kRounding;
      if (!hidden && clearly) return false;
      maybe = maybe || nearly;
    }
    return !hidden || maybe;
  }

 private:
  void collect() {
    for (std::uint32_t b = 0; b < scene_.bodies.size(); ++b) {
      const model::GridBody& body = scene_.bodies[b];
      if (scene_.model->bodies[body.body].color.alpha != 255) continue;
      const auto& parts = scene_.shapes[body.grid_shape].parts;
      for (std::uint32_t p = 0; p < parts.size(); ++p)
        for (const auto& t : parts[p].triangles) add(parts[p], t, body.origin - origin_, b, p);
    }
  }

  void add(const geometry::Part& part, const geometry::Triangle& t, const Vec3l& at,
           std::uint32_t body, std::uint32_t part_index) {
    std::array<Vec3d, 3> c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = (part.vertices[t[k]].as<std::int64_t>() + at).as<double>();
    Vec3d n = cross(c[1] - c[0], c[2] - c[0]);
    if (length(n) == 0) return;
    n = n * (1 / length(n));
    Flat f;
    f.facing = dot(n, d_);
    if (std::fabs(f.facing) < 1e-9) return;
    if (f.facing < 0) {
      std::swap(c[1], c[2]);
      n = -n;
    }
    for (std::size_t k = 0; k < 3; ++k) f.p[k] = {dot(c[k], right_), dot(c[k], up_)};
    f.corner = c[0];
    f.normal = n;
    f.steepness = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
    f.body = body;
    f.part = part_index;
    flats_.push_back(f);
  }

  [[nodiscard]] std::size_t column(double u, double lo, double step, std::size_t n) const {
    const double c = std::floor((u - lo) / step);
    return c <= 0 ? 0 : std::min(n - 1, static_cast<std::size_t>(c));
  }
  [[nodiscard]] std::size_t cell_of(double u, double v) const {
    return column(v, v0_, dv_, n_) * n_ + column(u, u0_, du_, n_);
  }

  template <class Visit>
  void cells(const Flat& f, Visit&& visit) const {
    const auto [u0, u1] = std::minmax({f.p[0][0], f.p[1][0], f.p[2][0]});
    const auto [v0, v1] = std::minmax({f.p[0][1], f.p[1][1], f.p[2][1]});
    const double slack = 2 * kRounding;
    for (std::size_t j = column(v0 - slack, v0_, dv_, n_); j <= column(v1 + slack, v0_, dv_, n_);
         ++j)
      for (std::size_t i = column(u0 - slack, u0_, du_, n_); i <= column(u1 + slack, u0_, du_, n_);
           ++i)
        visit(j * n_ + i);
  }

  void build_grid() {
    double u1 = -1e300, v1 = -1e300;
    u0_ = v0_ = 1e300;
    for (const Flat& f : flats_)
      for (const auto& p : f.p) {
        u0_ = std::min(u0_, p[0]);
        u1 = std::max(u1, p[0]);
        v0_ = std::min(v0_, p[1]);
        v1 = std::max(v1, p[1]);
      }
    n_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(flats_.size())), 1, 600);
    du_ = std::max((u1 - u0_) / static_cast<double>(n_), 1.0);
    dv_ = std::max((v1 - v0_) / static_cast<double>(n_), 1.0);
    first_.assign(n_ * n_ + 1, 0);
    for (const Flat& f : flats_) cells(f, [&](std::size_t c) { ++first_[c + 1]; });
    for (std::size_t c = 0; c < n_ * n_; ++c) first_[c + 1] += first_[c];
    item_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < flats_.size(); ++i)
      cells(flats_[i], [&](std::size_t c) { item_[next[c]++] = i; });
  }

  // Distance of a point on paper from the outline, positive inside.
  static double margin(const Flat& f, double u, double v) {
    double least = 1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &p = f.p[k], &q = f.p[(k + 1) % 3];
      const double su = q[0] - p[0], sv = q[1] - p[1], size = std::hypot(su, sv);
      if (size == 0) return -1e300;
      least = std::min(least, (su * (v - p[1]) - sv * (u - p[0])) / size);
    }
    return least;
  }

  [[nodiscard]] double contact_of(model::ObjectId object) const {
    if (drawing_.options.contact_distance_mm >= 0)
      return std::round(drawing_.options.contact_distance_mm * 1000);
    const double half = scene_.model->files[scene_.model->object(object).file].precision_mm;
    return std::max(3.0, std::ceil(4 * half * 1000));
  }
  [[nodiscard]] double contact(std::uint32_t body, const hlr::Piece& piece) const {
    return std::max(contact_of(scene_.bodies[body].object), contact_of(piece.object));
  }

  const model::Scene& scene_;
  const hlr::Drawing& drawing_;
  Vec3d d_, right_, up_;
  Vec3l origin_;
  std::vector<Flat> flats_;
  double u0_ = 0, v0_ = 0, du_ = 1, dv_ = 1;
  std::size_t n_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> item_;
};

}  // namespace

RayCheck check_by_rays(const model::Scene& scene, const hlr::Drawing& drawing, std::uint64_t rays,
                       std::uint64_t seed) {
  RayCheck result;
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t i = 0; i < drawing.pieces.size(); ++i) {
    const hlr::State state = drawing.pieces[i].state;
    if (state == hlr::State::visible || state == hlr::State::hidden_by_self ||
        state == hlr::State::hidden_by_other)
      candidates.push_back(i);
  }
  if (candidates.empty()) return result;
  const Checker checker(scene, drawing);
  Random random(seed);
  for (; result.rays < rays; ++result.rays) {
    const hlr::Piece& piece = drawing.pieces[candidates[random.next() % candidates.size()]];
    const double s = static_cast<double>(1 + random.below(9999)) / 10000;
    if (checker.right(piece, s)) continue;
    if (result.wrong++ == 0)
      result.first_wrong =
          "object " + scene.model->object(piece.object).id + " edge " + std::to_string(piece.edge) +
          " state " + std::to_string(static_cast<int>(piece.state)) + " from (" +
          std::to_string(piece.a.x) + " " + std::to_string(piece.a.y) + " " +
          std::to_string(piece.a.z) + ") to (" + std::to_string(piece.b.x) + " " +
          std::to_string(piece.b.y) + " " + std::to_string(piece.b.z) + ") at " + std::to_string(s);
  }
  return result;
}

}  // namespace strake::test
