// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitives/tessellate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "geometry/primitives/mesh_builder.hpp"

namespace strake::geometry::tessellation {

Tessellation fault(std::string_view why) {
  Tessellation t;
  t.fault = why;
  return t;
}

Vec3d column(const Mat3d& m, int axis) { return {m.row[0][axis], m.row[1][axis], m.row[2][axis]}; }

SinCos canonical_phase(const Vec3d& image_x, const Vec3d& image_y) {
  const Vec3d normal = cross(image_x, image_y);
  const double square = dot(normal, normal);
  if (!(square > 0)) return {0, 1};
  // No usual direction of a pipe lies 26 degrees off the vertical, so rounding errors never decide.
  const bool steep = normal.z * normal.z > 0.81 * square;
  const Vec3d reference = steep ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
  const Vec3d u = reference - normal * (dot(reference, normal) / square);
  const double xx = dot(image_x, image_x), yy = dot(image_y, image_y), xy = dot(image_x, image_y);
  const double ux = dot(u, image_x), uy = dot(u, image_y);
  const double x = ux * yy - uy * xy, y = uy * xx - ux * xy;
  const double length = std::sqrt(x * x + y * y);
  if (!(length > 0)) return {0, 1};
  return {y / length, x / length};
}

std::optional<Vec3d> local_direction(const Mat3d& linear, const Vec3d& placed) {
  const Vec3d x = column(linear, 0), y = column(linear, 1), z = column(linear, 2);
  const Vec3d local{dot(cross(y, z), placed), dot(cross(z, x), placed), dot(cross(x, y), placed)};
  const double square = dot(local, local);
  if (!(square > 0) || !std::isfinite(square)) return std::nullopt;
  return local * (1 / std::sqrt(square));
}

namespace {

/// Returns the point that a map takes to the given one; none where the map flattens it.
std::optional<Vec3d> local_point(const Mat3d& linear, const Vec3d& placed) {
  const Vec3d x = column(linear, 0), y = column(linear, 1), z = column(linear, 2);
  const double determinant = dot(cross(x, y), z);
  const Vec3d local =
      Vec3d{dot(cross(y, z), placed), dot(cross(z, x), placed), dot(cross(x, y), placed)} *
      (1 / determinant);
  if (!std::isfinite(dot(local, local))) return std::nullopt;
  return local;
}

/// In radii: from a section farther than this the far side's chords are less than 1.25 times as
/// long as those of an even circle.
constexpr double kFar = 3;

}  // namespace

std::optional<EyeContour> EyeContour::of(double x, double y, double radius) {
  const double distance = std::sqrt(x * x + y * y);
  if (!(distance > kNearestEye * radius)) return std::nullopt;
  const double middle = arc_tan2(y, x), half = arc_cos(radius / distance);
  return EyeContour{middle - half, middle + half};
}

bool is_far(double x, double y, double radius) {
  return x * x + y * y > kFar * kFar * radius * radius;
}

SinCos point_between(const EyeContour& contour, int segments, int k) {
  const int half = segments / 2;
  return sin_cos(k < half ? contour.first + (contour.second - contour.first) * k / half
                          : contour.second + contour.far_side() * (k - half) / half);
}

std::optional<std::vector<SinCos>> rim_from_eye(const TessellationTarget& target, double radius) {
  if (!target.eye) return std::nullopt;
  const Vec3d& eye = *target.eye;
  const auto contour = EyeContour::of(eye.x, eye.y, radius);
  if (!contour) return std::nullopt;
  double sag = kRimShare * target.sag;
  if (!is_far(eye.x, eye.y, radius)) {
    const double wider = contour->far_side() / kPi;
    sag /= wider * wider;
  }
  const int segments = circle_segments(radius, sag);
  std::vector<SinCos> points;
  for (int k = 0; k < segments; ++k) points.push_back(point_between(*contour, segments, k));
  return points;
}

std::optional<SinCos> contour_phase(double x, double y, double along) {
  const double across = x * x + y * y;
  // The square of a milliradian: below it rounding could tell a pipe from the elbow at its end.
  if (!(across > 1e-6 * (across + along * along))) return std::nullopt;
  const double length = std::sqrt(across);
  return SinCos{x / length, -y / length};
}

SinCos rim_phase(const TessellationTarget& target) {
  if (const auto& d = target.towards)
    if (const auto phase = contour_phase(d->x, d->y, d->z)) return *phase;
  return canonical_phase(column(target.linear, 0), column(target.linear, 1));
}

std::vector<SinCos> rim(int segments, const SinCos& phase) {
  std::vector<SinCos> points = unit_circle(segments);
  for (SinCos& p : points)
    p = {p.sin * phase.cos + p.cos * phase.sin, p.cos * phase.cos - p.sin * phase.sin};
  return points;
}

std::vector<SinCos> rim_of(const TessellationTarget& target, double radius, int segments) {
  if (auto contoured = rim_from_eye(target, radius)) return std::move(*contoured);
  return rim(segments, rim_phase(target));
}

std::vector<SinCos> rim_with(const std::vector<SinCos>& regular,
                             const std::array<SinCos, 2>& contours) {
  const auto count = static_cast<double>(regular.size());
  const SinCos& phase = regular.front();
  // In even steps from the first point, of [0, count).
  const auto steps_to = [&](const SinCos& c) {
    const double angle =
        arc_tan2(c.sin * phase.cos - c.cos * phase.sin, c.cos * phase.cos + c.sin * phase.sin);
    const double steps = angle / (2 * kPi) * count;
    return steps >= 0 ? steps : steps + count < count ? steps + count : 0;
  };
  const std::array<double, 2> at{steps_to(contours[0]), steps_to(contours[1])};
  constexpr double kNear = 0.25, kSame = 1e-6;  // in even steps
  const auto near = [&](double a, double b, double within) {
    const double apart = std::fabs(a - b);
    return std::min(apart, count - apart) < within;
  };
  if (near(at[0], at[1], kNear)) return regular;
  // A point that lies there already stands for itself alone, however near its neighbours are.
  const auto reach_of = [&](double place) {
    const bool is_there = std::ranges::any_of(
        regular, [&](const SinCos& point) { return near(steps_to(point), place, kSame); });
    return is_there ? kSame : kNear;
  };
  const std::array<double, 2> reach{reach_of(at[0]), reach_of(at[1])};
  std::vector<std::pair<double, SinCos>> points{{at[0], contours[0]}, {at[1], contours[1]}};
  for (const SinCos& point : regular) {
    const double k = steps_to(point);
    if (!near(k, at[0], reach[0]) && !near(k, at[1], reach[1])) points.emplace_back(k, point);
  }
  std::ranges::sort(points, {}, [](const auto& point) { return point.first; });
  std::vector<SinCos> result;
  for (const auto& point : points) result.push_back(point.second);
  return result;
}

double widest_step(std::span<const SinCos> rim) {
  double widest = 0;
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const SinCos &a = rim[k], &b = rim[k + 1 == rim.size() ? 0 : k + 1];
    const double step = arc_tan2(b.sin * a.cos - b.cos * a.sin, b.cos * a.cos + b.sin * a.sin);
    widest = std::max(widest, step < 0 ? step + 2 * kPi : step);
  }
  return widest;
}

std::uint32_t MeshBuilder::vertex(const Vec3d& v) {
  mesh_.vertices.push_back(v);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a == b || b == c || c == a) return;
  mesh_.triangles.push_back({a, b, c});
  mesh_.faces.push_back(face);
}

void MeshBuilder::polygon(std::span<const std::uint32_t> ring, bool reversed) {
  const std::uint32_t f = face();
  // A zigzag between the two ends: no vertex gathers all the triangles.
  std::size_t low = 0, high = ring.size() - 1;
  bool take_low = true;
  while (high - low >= 2) {
    const std::uint32_t a = ring[low], c = ring[high];
    const std::uint32_t b = take_low ? ring[++low] : ring[--high];
    if (reversed)
      triangle(f, a, c, b);
    else
      triangle(f, a, b, c);
    take_low = !take_low;
  }
}

void MeshBuilder::quad_of(std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                          std::uint32_t d) {
  if (other_diagonal(a, b, c, d)) {
    triangle(face, a, b, d);
    triangle(face, b, c, d);
    return;
  }
  triangle(face, a, b, c);
  triangle(face, a, c, d);
}

bool MeshBuilder::other_diagonal(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                 std::uint32_t d) const {
  if ((!towards_ && !eye_) || a == b || b == c || c == d || d == a) return false;
  const auto& v = mesh_.vertices;
  const auto viewer_from = [&](const Vec3d& p) { return eye_ ? *eye_ - p : *towards_; };
  const auto facing = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return dot(cross(v[j] - v[i], v[k] - v[i]), viewer_from(v[i]));
  };
  const double whole =
      dot(cross(v[c] - v[a], v[d] - v[b]), viewer_from((v[a] + v[b] + v[c] + v[d]) * 0.25));
  const double sign = whole < 0 ? -1 : 1;
  const double usual = std::min(sign * facing(a, b, c), sign * facing(a, c, d));
  const double other = std::min(sign * facing(a, b, d), sign * facing(b, c, d));
  // What rounding made of a planar quad turns no diagonal.
  return other > usual + 1e-9 * std::fabs(whole);
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  quad_of(face(), a, b, c, d);
}

Tessellation MeshBuilder::take(double sag) && {
  Tessellation t;
  t.mesh = std::move(mesh_);
  t.mesh.sag_mm = sag;
  return t;
}

bool are_lengths(std::initializer_list<double> lengths) {
  for (const double length : lengths)
    if (!(length >= 0) || !std::isfinite(length)) return false;
  return true;
}

}  // namespace strake::geometry::tessellation

namespace strake::geometry {
namespace {

/// What int32 can span on the grid, with room for the bound's own slack.
constexpr double kWidestMm = 4e6;

/// False when a length of the primitive is so large that tessellating it is a waste.
bool fits(const Tessellation& t) {
  for (const Vec3d& v : t.mesh.vertices)
    if (!(std::fabs(v.x) < kWidestMm) || !(std::fabs(v.y) < kWidestMm) ||
        !(std::fabs(v.z) < kWidestMm))
      return false;
  return true;
}

}  // namespace

namespace {

Tessellation tessellate_for(const tessellation::TessellationTarget& target, double scale,
                            const Primitive& primitive) {
  Tessellation t =
      std::visit([&](const auto& p) { return tessellation::make(p, target); }, primitive);
  t.mesh.sag_mm *= scale;
  for (Vec3d& v : t.mesh.vertices) v = target.linear * v;
  for (Vec3d& v : t.lines.points) v = target.linear * v;
  if (!fits(t)) return tessellation::fault("larger than 4 km");
  if (target.linear.determinant() < 0)
    for (Triangle& triangle : t.mesh.triangles) std::swap(triangle[1], triangle[2]);
  return t;
}

constexpr std::string_view kFlat = "the placement is not finite or flattens everything";

}  // namespace

Tessellation tessellate(const Primitive& primitive, const Mat3d& linear, double sag_mm,
                        const std::optional<Vec3d>& towards) {
  const double scale = largest_scale(linear);
  if (!(scale > 0) || !std::isfinite(scale)) return tessellation::fault(kFlat);
  tessellation::TessellationTarget target{linear, sag_mm / scale, {}, {}};
  if (towards) target.towards = tessellation::local_direction(linear, *towards);
  return tessellate_for(target, scale, primitive);
}

Tessellation tessellate_from(const Vec3d& eye, const Primitive& primitive, const Mat3d& linear,
                             double sag_mm) {
  const double scale = largest_scale(linear);
  if (!(scale > 0) || !std::isfinite(scale)) return tessellation::fault(kFlat);
  const tessellation::TessellationTarget target{
      linear, sag_mm / scale, {}, tessellation::local_point(linear, eye)};
  return tessellate_for(target, scale, primitive);
}

}  // namespace strake::geometry
