// SPDX-License-Identifier: Apache-2.0
#include "hlr/hatch_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "hlr/view_axes.hpp"
#include "strake/geometry/trig.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::hlr {
namespace {

using geometry::Int128;
using geometry::Segment;
using geometry::Vec3d;
using geometry::Vec3l;

constexpr double kFinest = 1048576;  // 20 bits of direction

Vec3d unit(const Vec3d& v) { return v * (1 / std::sqrt(dot(v, v))); }

/// Where a hatch line meets a rim: (u, v) = num / den, and whether it enters or leaves.
struct Meeting {
  std::int64_t line = 0;
  Int128 u = 0, v = 0, den = 1;
  int turn = 0;
};

std::int64_t floor_quotient(Int128 a, std::int64_t b) {
  return static_cast<std::int64_t>(a / b - (a % b != 0 && a < 0 ? 1 : 0));
}

}  // namespace

HatchGrid::HatchGrid(const Vec3l& normal, const View& view, double angle_deg, double spacing)
    : axes_(normal) {
  const Vec3d n = unit(normal.as<double>());
  const ViewAxes paper = axes_of(view);
  const auto in_plane = [&](const Vec3d& v) { return v - n * dot(v, n); };
  // A plane that an eye sees may yet be square to the paper's horizontal.
  constexpr double kNone = 1e-12;
  const Vec3d right = in_plane(paper.right);
  const Vec3d level = unit(dot(right, right) > kNone ? right : in_plane(paper.up));
  const geometry::SinCos turn = geometry::sin_cos(angle_deg / 180 * geometry::kPi);
  const Vec3d along = level * turn.cos + cross(n, level) * turn.sin;
  // Across the lines, in the plane; the third coordinate is one of the plane's own.
  const Vec3d m = cross(n, along);
  const double u = m[axes_.u] - m[axes_.w] * n[axes_.u] / n[axes_.w];
  const double v = m[axes_.v] - m[axes_.w] * n[axes_.v] / n[axes_.w];
  const double scale = kFinest / std::max(std::abs(u), std::abs(v));
  along_u_ = std::llround(u * scale);
  along_v_ = std::llround(v * scale);
  step_ = std::max<std::int64_t>(1, std::llround(spacing * scale));
}

std::vector<Segment> HatchGrid::within(std::span<const Segment> rim,
                                       const geometry::CutPlane& plane, const Vec3l& origin) const {
  // Line k of the body lies where value = k·step - shift.
  const Int128 at_origin = static_cast<Int128>(along_u_) * origin[axes_.u] +
                           static_cast<Int128>(along_v_) * origin[axes_.v];
  const auto shift = static_cast<std::int64_t>(
      at_origin - static_cast<Int128>(floor_quotient(at_origin, step_)) * step_);
  std::vector<Meeting> meetings;
  for (const auto& [p, q] : rim) {
    const std::int64_t fp = value(p) + shift, fq = value(q) + shift;
    // The lines k with min < k·step <= max: a line through a corner meets one of two sides.
    const std::int64_t first = floor_quotient(std::min(fp, fq), step_) + 1;
    const std::int64_t last = floor_quotient(std::max(fp, fq), step_);
    for (std::int64_t k = first; k <= last; ++k) {
      Meeting m{.line = k, .den = std::abs(fq - fp), .turn = fq > fp ? 1 : -1};
      const Int128 share = fq > fp ? k * step_ - fp : fp - k * step_;
      m.u = p[axes_.u] * m.den + (q[axes_.u] - p[axes_.u]) * share;
      m.v = p[axes_.v] * m.den + (q[axes_.v] - p[axes_.v]) * share;
      meetings.push_back(m);
    }
  }
  const bool by_u = std::abs(along_v_) >= std::abs(along_u_);
  const auto place = [&](const Meeting& m) { return by_u ? m.u : m.v; };
  const auto order = [&](const Meeting& a, const Meeting& b) {
    return geometry::compare_fractions(place(a), a.den, place(b), b.den);
  };
  std::ranges::sort(meetings, [&](const Meeting& a, const Meeting& b) {
    return a.line != b.line ? a.line < b.line : order(a, b) < 0;
  });
  const auto point = [&](const Meeting& m) {
    Vec3l p;
    p[axes_.u] = geometry::round_div(m.u, m.den);
    p[axes_.v] = geometry::round_div(m.v, m.den);
    const std::int64_t n = plane.normal[axes_.w];
    const Int128 rest =
        plane.offset * m.den - plane.normal[axes_.u] * m.u - plane.normal[axes_.v] * m.v;
    p[axes_.w] = geometry::round_div(n < 0 ? -rest : rest, m.den * std::abs(n));
    return p;
  };
  std::vector<Segment> lines;
  const Meeting* entered = nullptr;
  int winding = 0;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    winding += meetings[i].turn;
    // What meets at one place counts together.
    if (i + 1 < meetings.size() && meetings[i + 1].line == meetings[i].line &&
        order(meetings[i], meetings[i + 1]) == 0)
      continue;
    if (winding != 0 && entered == nullptr) entered = &meetings[i];
    if (winding != 0 || entered == nullptr) continue;
    Segment line{point(*entered), point(meetings[i])};
    if (line[1] < line[0]) std::swap(line[0], line[1]);
    if (line[0] != line[1]) lines.push_back(line);
    entered = nullptr;
  }
  std::ranges::sort(lines);
  return lines;
}

}  // namespace strake::hlr
