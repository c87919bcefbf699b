// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "strake/geometry/rational.hpp"
#include "strake/geometry/vec.hpp"
#include "support/part_builder.hpp"
#include "support/rational_oracle.hpp"

/// Membership in simple shapes by barycentric coordinates in big rationals: what the library's
/// integer formulas are held against.
namespace strake::testing {

template <std::size_t N>
[[nodiscard]] mpz_class big(const geometry::WideInt<N>& v) {
  mpz_class r;
  mpz_import(r.get_mpz_t(), N, -1, sizeof(std::uint64_t), 0, 0, v.limbs().data());
  if (v.negative()) r -= mpz_class(1) << (64 * N);
  return r;
}
[[nodiscard]] inline mpz_class big(geometry::Int128 v) { return big(geometry::WideInt<2>(v)); }

template <class N, class D>
[[nodiscard]] mpq_class quotient(const N& num, const D& den) {
  mpq_class q(big(num), big(den));
  q.canonicalize();
  return q;
}
[[nodiscard]] inline mpq_class exact(const geometry::Rational& r) { return quotient(r.num, r.den); }
[[nodiscard]] inline mpq_class exact(const geometry::SquaredDistance& s) {
  return quotient(s.numerator, s.denominator);
}
template <std::size_t N>
[[nodiscard]] RationalPoint exact(const geometry::BasicRationalPoint<N>& p) {
  return {quotient(p.numerator.x, p.denominator), quotient(p.numerator.y, p.denominator),
          quotient(p.numerator.z, p.denominator)};
}
[[nodiscard]] inline RationalPoint exact(const geometry::Vec3l& p) {
  return {mpq_class(static_cast<long>(p.x)), mpq_class(static_cast<long>(p.y)),
          mpq_class(static_cast<long>(p.z))};
}

[[nodiscard]] inline RationalPoint minus(const RationalPoint& p, const RationalPoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
[[nodiscard]] inline RationalPoint plus(const RationalPoint& p, const RationalPoint& d,
                                        const mpq_class& t) {
  return {p[0] + d[0] * t, p[1] + d[1] * t, p[2] + d[2] * t};
}
[[nodiscard]] inline mpq_class inner(const RationalPoint& p, const RationalPoint& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/// The weights of the corners of a simplex (1 to 3 corners, spanning) that make a point; nothing
/// when the point is not in the affine hull. Cramer's rule on the Gram matrix.
[[nodiscard]] inline std::optional<std::vector<mpq_class>> weights(
    const std::vector<RationalPoint>& corners, const RationalPoint& p) {
  const RationalPoint d = minus(p, corners[0]);
  std::vector<mpq_class> w(corners.size());
  if (corners.size() == 2) {
    const RationalPoint e = minus(corners[1], corners[0]);
    w[1] = inner(d, e) / inner(e, e);
  } else if (corners.size() == 3) {
    const RationalPoint e = minus(corners[1], corners[0]), f = minus(corners[2], corners[0]);
    const mpq_class ee = inner(e, e), ff = inner(f, f), ef = inner(e, f), de = inner(d, e),
                    df = inner(d, f), det = ee * ff - ef * ef;
    w[1] = (de * ff - df * ef) / det;
    w[2] = (df * ee - de * ef) / det;
  }
  w[0] = 1;
  RationalPoint sum = corners[0];
  for (std::size_t i = 1; i < corners.size(); ++i) {
    w[0] -= w[i];
    sum = plus(sum, minus(corners[i], corners[0]), w[i]);
  }
  if (sum != p) return std::nullopt;
  return w;
}

/// The place of a point on a simplex as the library spells it, 0 where it is not on it. The
/// simplex must span.
template <class Corners>
[[nodiscard]] unsigned true_place(const Corners& corners, const RationalPoint& p) {
  std::vector<RationalPoint> points;
  for (const geometry::Vec3l& c : corners) points.push_back(exact(c));
  const auto w = weights(points, p);
  if (!w) return 0;
  unsigned place = 0;
  for (std::size_t i = 0; i < w->size(); ++i) {
    if ((*w)[i] < 0) return 0;
    if ((*w)[i] > 0) place |= 1U << i;
  }
  return place;
}

/// Whether a closed tetrahedron holds a point: on the inner side of, or on, each of its faces.
[[nodiscard]] inline bool holds(const Tetrahedron& t, const RationalPoint& p) {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [&](std::size_t k) { return exact(t[(i + k) % 4].as<std::int64_t>()); };
    const RationalPoint u = minus(corner(2), corner(1)), v = minus(corner(3), corner(1));
    const RationalPoint n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0]};
    if (sgn(inner(n, minus(p, corner(1)))) * sgn(inner(n, minus(corner(0), corner(1)))) < 0)
      return false;
  }
  return true;
}

/// Any point, segment or triangle as a mesh of one triangle, for squared_distance().
template <class Corners>
[[nodiscard]] IndexedMesh as_mesh(const Corners& corners) {
  IndexedMesh mesh;
  for (std::size_t i = 0; i < 3; ++i)
    mesh.vertices.push_back(
        corners[std::min<std::size_t>(i, corners.size() - 1)].template as<std::int32_t>());
  mesh.triangles.push_back({0, 1, 2});
  return mesh;
}

/// Grid points on a lattice so small that degenerate cases are common.
class Lattice {
 public:
  explicit Lattice(std::uint64_t seed) : rng_(seed) {}

  [[nodiscard]] std::int64_t below(std::int64_t n) {
    return static_cast<std::int64_t>(rng_() % static_cast<std::uint64_t>(n));
  }
  [[nodiscard]] geometry::Vec3l point(std::int64_t reach = 3) {
    const auto pick = [&] { return below(2 * reach + 1) - reach; };
    const std::int64_t x = pick(), y = pick(), z = pick();
    return {x, y, z};
  }
  [[nodiscard]] std::array<geometry::Vec3l, 2> segment(std::int64_t reach = 3) {
    const geometry::Vec3l p = point(reach);
    return {p, point(reach)};
  }
  [[nodiscard]] std::array<geometry::Vec3l, 3> triangle(std::int64_t reach = 3) {
    const geometry::Vec3l p = point(reach), q = point(reach);
    return {p, q, point(reach)};
  }
  [[nodiscard]] std::mt19937_64& rng() { return rng_; }

 private:
  std::mt19937_64 rng_;
};

/// Whether three points span a plane.
[[nodiscard]] inline bool spans(const std::array<geometry::Vec3l, 3>& t) {
  const geometry::Vec3l n = geometry::cross(t[1] - t[0], t[2] - t[0]);
  return n != geometry::Vec3l{};
}

/// One of the 48 symmetries of the axes.
[[nodiscard]] inline geometry::Vec3l turned(const geometry::Vec3l& p, int index) {
  static constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  const auto& order = kOrders[static_cast<std::size_t>(index / 8)];
  geometry::Vec3l r;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t v = p[order[static_cast<std::size_t>(k)]];
    r[k] = (index >> k & 1) != 0 ? -v : v;
  }
  return r;
}

/// A map of the whole space that keeps every answer: a symmetry of the axes, a scale that takes the
/// small lattice to the edge of the exact range, and a place far out.
struct GridMotion {
  int symmetry = 0;
  std::int64_t scale = 1;
  geometry::Vec3l shift;

  [[nodiscard]] geometry::Vec3l operator()(const geometry::Vec3l& p) const {
    return turned(p, symmetry) * scale + shift;
  }
  template <std::size_t N>
  [[nodiscard]] std::array<geometry::Vec3l, N> operator()(
      const std::array<geometry::Vec3l, N>& shape) const {
    std::array<geometry::Vec3l, N> r;
    for (std::size_t i = 0; i < N; ++i) r[i] = (*this)(shape[i]);
    return r;
  }
};

/// `reach`: of the lattice that the shapes of a call lie in.
[[nodiscard]] inline GridMotion random_motion(Lattice& lattice, std::int64_t reach) {
  GridMotion m;
  m.symmetry = static_cast<int>(lattice.below(48));
  m.scale = lattice.below(2) == 0 ? 1 : (std::int64_t{1} << 31) / (2 * reach);
  const std::int64_t far = (std::int64_t{1} << 50) - (std::int64_t{1} << 31);
  const auto place = [&](std::int64_t kind) { return kind == 0 ? 0 : kind == 1 ? far : -far; };
  const std::int64_t x = lattice.below(3), y = lattice.below(3), z = lattice.below(3);
  m.shift = {place(x), place(y), place(z)};
  return m;
}

}  // namespace strake::testing
