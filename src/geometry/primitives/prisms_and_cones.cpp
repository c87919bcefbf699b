// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>

#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/primitives/mesh_builder.hpp"

namespace strake::geometry::tessellation {
namespace {

constexpr std::string_view kBadLength = "a length is negative or not finite";

/// Eight corners, x fastest, then y, then z; edges and corners may coincide.
Tessellation hexahedron(const std::array<Vec3d, 8>& corners) {
  static constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  MeshBuilder builder;
  for (const Vec3d& c : corners) builder.vertex(c);
  for (const auto& q : kQuads) builder.quad(q[0], q[1], q[2], q[3]);
  return std::move(builder).take(0);
}

double pick(std::size_t corner, std::size_t bit, double length) {
  return (corner & bit) != 0 ? length / 2 : -length / 2;
}

}  // namespace

Tessellation make(const BoxPrimitive& p, const TessellationTarget&) {
  if (!are_lengths({p.length_x, p.length_y, p.length_z})) return fault(kBadLength);
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {pick(i, 1, p.length_x), pick(i, 2, p.length_y), pick(i, 4, p.length_z)};
  return hexahedron(corners);
}

Tessellation make(const PyramidPrimitive& p, const TessellationTarget&) {
  if (!are_lengths({p.bottom_x, p.bottom_y, p.top_x, p.top_y, p.height}) ||
      !std::isfinite(p.offset_x) || !std::isfinite(p.offset_y))
    return fault(kBadLength);
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const bool top = (i & 4U) != 0;
    corners[i] = {pick(i, 4, p.offset_x) + pick(i, 1, top ? p.top_x : p.bottom_x),
                  pick(i, 4, p.offset_y) + pick(i, 2, top ? p.top_y : p.bottom_y),
                  pick(i, 4, p.height)};
  }
  return hexahedron(corners);
}

Tessellation make(const LinePrimitive& p, const TessellationTarget&) {
  if (!are_lengths({p.length}) || p.length == 0) return fault("a line of no length");
  Tessellation t;
  t.lines.points = {{0, 0, -p.length / 2}, {0, 0, p.length / 2}};
  t.lines.first = {0, 2};
  return t;
}

namespace {

constexpr int kMaxSegments = 4096;

using Ring = std::vector<std::uint32_t>;

/// Two rings, the lower first, both counter-clockwise seen from the upper, with caps.
Tessellation frustum(const std::vector<Vec3d>& lower, const std::vector<Vec3d>& upper, double sag) {
  MeshBuilder builder;
  Ring low, high;
  for (const Vec3d& v : lower) low.push_back(builder.vertex(v));
  for (const Vec3d& v : upper) high.push_back(builder.vertex(v));
  builder.polygon(low, true);
  builder.polygon(high);
  for (std::size_t k = 0; k < low.size(); ++k) {
    const std::size_t next = k + 1 == low.size() ? 0 : k + 1;
    builder.quad(low[k], low[next], high[next], high[k]);
  }
  return std::move(builder).take(sag);
}

/// z = slope_x·dx + slope_y·dy above the centre of an end circle.
struct EndPlane {
  double slope_x = 0, slope_y = 0;

  [[nodiscard]] double steepness() const {
    return std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
  }
};

EndPlane end_plane(double shear_x, double shear_y) {
  const SinCos x = sin_cos(shear_x), y = sin_cos(shear_y);
  return {x.sin / x.cos, y.sin / y.cos};
}

/// A cone between two circles, each generator cut by the end planes.
struct Snout {
  SnoutPrimitive p;
  EndPlane bottom, top;

  /// How fast a generator, from the bottom circle to the top circle, rises over an end plane.
  [[nodiscard]] double rise(const EndPlane& end, const SinCos& a) const {
    const double grow = p.top_radius - p.bottom_radius;
    return p.height - end.slope_x * (p.offset_x + grow * a.cos) -
           end.slope_y * (p.offset_y + grow * a.sin);
  }
  /// Part of the generator, from the bottom circle (0) to the top circle (1), at which the bottom
  /// plane cuts it: the true outline is where cone and plane meet.
  [[nodiscard]] double bottom_cut(const SinCos& a) const { return cut(bottom, p.bottom_radius, a); }
  [[nodiscard]] double top_cut(const SinCos& a) const { return 1 + cut(top, p.top_radius, a); }
  [[nodiscard]] double cut(const EndPlane& end, double circle, const SinCos& a) const {
    const double wanted = circle * (end.slope_x * a.cos + end.slope_y * a.sin);
    if (wanted == 0) return 0;
    const double rises = rise(end, a);
    return rises > 0 ? wanted / rises : kUnboundedSag;
  }
  [[nodiscard]] double radius(double cut) const {
    return p.bottom_radius + cut * (p.top_radius - p.bottom_radius);
  }
  [[nodiscard]] Vec3d point(const SinCos& a, double cut) const {
    const double r = radius(cut);
    return {p.offset_x * (cut - 0.5) + r * a.cos, p.offset_y * (cut - 0.5) + r * a.sin,
            p.height * (cut - 0.5)};
  }
  /// Returns the two generators along which the surface turns away from a viewer. The normal is the
  /// same all along a generator: (h cos a, h sin a, -(offset_x cos a + offset_y sin a + growth)).
  [[nodiscard]] std::optional<std::array<SinCos, 2>> contours(const Vec3d& towards) const {
    return generators_facing(towards, 0);
  }
  [[nodiscard]] std::optional<std::array<SinCos, 2>> contours_from(const Vec3d& eye) const {
    // From the centre of the bottom circle, whose points lie a radius nearer along their normals.
    const Vec3d from{eye.x + p.offset_x / 2, eye.y + p.offset_y / 2, eye.z + p.height / 2};
    return generators_facing(from, p.height * p.bottom_radius);
  }
  /// Returns the two generators whose normal has the product `least` with a vector.
  [[nodiscard]] std::optional<std::array<SinCos, 2>> generators_facing(const Vec3d& v,
                                                                       double least) const {
    const double x = p.height * v.x - v.z * p.offset_x;
    const double y = p.height * v.y - v.z * p.offset_y;
    const double against = v.z * (p.top_radius - p.bottom_radius) + least;
    const double square = x * x + y * y, rest = square - against * against;
    if (!(rest > 0)) return std::nullopt;
    const double half = std::sqrt(rest);
    return std::array<SinCos, 2>{
        {{(against * y + half * x) / square, (against * x - half * y) / square},
         {(against * y - half * x) / square, (against * x + half * y) / square}}};
  }
  static constexpr double kUnboundedSag = 1e300;

  /// Returns the greatest distance of the true surface from the facet between two generators;
  /// infinite where an end plane runs too much along the surface. A section of the facet across the
  /// axis is a chord of the surface's circle; beyond those the outline of an end is what is
  /// farthest.
  [[nodiscard]] double sag_between(const SinCos& a, const SinCos& b) const {
    const double cosine = a.cos * b.cos + a.sin * b.sin;
    // In it the tangents of a unit circle meet.
    const SinCos t{(a.sin + b.sin) / (1 + cosine), (a.cos + b.cos) / (1 + cosine)};
    const double half = std::sqrt((1 + cosine) / 2);
    double sag = 0;
    for (const bool at_top : {false, true}) {
      const EndPlane& end = at_top ? top : bottom;
      if ((at_top ? p.top_radius : p.bottom_radius) == 0) continue;  // the apex
      const auto cut_at = [&](const SinCos& g) { return at_top ? top_cut(g) : bottom_cut(g); };
      const double weight = rise(end, t);
      if (!(weight > 0)) return kUnboundedSag;
      const double widest = std::max({radius(cut_at(a)), radius(cut_at(b)), radius(cut_at(t))});
      const Vec3d from = point(a, cut_at(a)), to = point(b, cut_at(b)), pole = point(t, cut_at(t));
      // The outline is a conic. As a rational Bezier curve (Farin, Curves and Surfaces for CAGD)
      // it has the weight w in the middle. Between its ends and the points w / (1 + w) of the way
      // from them to the pole it lies in a quadrilateral.
      const double w = half * weight / std::sqrt(rise(end, a) * rise(end, b));
      sag = std::max(sag, widest * (1 - half));
      for (const Vec3d& v : {from, to}) {
        const Vec3d corner = v + (pole - v) * (w / (1 + w));
        sag = std::max(sag, length(corner - nearest_on_segment(corner, from, to)));
      }
    }
    return sag;
  }
};

/// Of all facets of a ring of generators.
double sag_of(const Snout& snout, const std::vector<SinCos>& angles) {
  double sag = 0;
  for (std::size_t k = 0; k < angles.size(); ++k)
    sag = std::max(sag, snout.sag_between(angles[k], angles[k + 1 == angles.size() ? 0 : k + 1]));
  return sag;
}

/// How many even generators the sag wants, `least` at least: an outline may bend more than the
/// circle that it is the image of.
int segments_for(const Snout& snout, double sag, int least, const SinCos& phase) {
  int n = least;
  for (;;) {
    const double reached = sag_of(snout, rim(n, phase));
    if (reached <= sag || n >= kMaxSegments) return n;
    const double more = std::clamp(std::sqrt(reached / sag), 1.1, 4.0);
    n = std::min(static_cast<int>(n * more / 4 + 1) * 4, kMaxSegments);
  }
}

/// The largest radius on the cuts; negative when a plane misses a generator, passes the apex, or
/// the planes cross inside.
double widest(const Snout& snout, const std::vector<SinCos>& angles) {
  double largest = 0;
  for (const SinCos& a : angles) {
    const double from = snout.bottom_cut(a), to = snout.top_cut(a);
    const double low = snout.radius(from), high = snout.radius(to);
    const double slack = -1e-9 * std::max(snout.p.bottom_radius, snout.p.top_radius);
    if (!(from <= to) || !(std::fabs(from) < 1e6) || !(std::fabs(to) < 1e6)) return -1;
    if (!(low >= slack) || !(high >= slack)) return -1;
    largest = std::max({largest, low, high});
  }
  return largest;
}

}  // namespace

Tessellation make(const CylinderPrimitive& p, const TessellationTarget& target) {
  if (!are_lengths({p.radius, p.height})) return fault("a length is negative or not finite");
  if (p.radius == 0) return fault("a cylinder of no radius");
  const auto from_eye = rim_from_eye(target, p.radius);
  const int n = circle_segments(p.radius, kRimShare * target.sag);
  const auto angles = from_eye ? *from_eye : rim(n, rim_phase(target));
  std::vector<Vec3d> lower, upper;
  for (const SinCos& a : angles) {
    lower.push_back({p.radius * a.cos, p.radius * a.sin, -p.height / 2});
    upper.push_back({p.radius * a.cos, p.radius * a.sin, p.height / 2});
  }
  return frustum(lower, upper, sagitta(p.radius, from_eye ? widest_step(angles) : 2 * kPi / n));
}

Tessellation make(const SnoutPrimitive& p, const TessellationTarget& target) {
  if (!are_lengths({p.bottom_radius, p.top_radius, p.height}) || !std::isfinite(p.offset_x) ||
      !std::isfinite(p.offset_y))
    return fault("a length is negative or not finite");
  if (p.bottom_radius == 0 && p.top_radius == 0) return fault("a snout of no radius");
  const Snout snout{p, end_plane(p.bottom_shear_x, p.bottom_shear_y),
                    end_plane(p.top_shear_x, p.top_shear_y)};
  const double steepness = std::max(snout.bottom.steepness(), snout.top.steepness());
  if (!(steepness < 100)) return fault("an end plane of a snout is too steep");
  const SinCos phase = rim_phase(target);
  const auto contours = target.towards ? snout.contours(*target.towards)
                        : target.eye   ? snout.contours_from(*target.eye)
                                       : std::nullopt;
  constexpr std::string_view kCross = "the end planes of a snout cross or pass its apex";
  // The cuts decide the widest radius, which decides the number of segments: look first.
  double radius = widest(snout, rim(256, phase));
  if (radius < 0) return fault(kCross);
  radius = std::max({radius, p.bottom_radius, p.top_radius});
  int n = circle_segments(radius, kRimShare * target.sag / steepness, kMaxSegments);
  if (steepness > 1) n = segments_for(snout, target.sag, n, phase);
  const auto angles = contours ? rim_with(rim(n, phase), *contours) : rim(n, phase);
  const double sag = steepness == 1 ? sagitta(radius, contours ? widest_step(angles) : 2 * kPi / n)
                                    : sag_of(snout, angles);
  if (widest(snout, angles) < 0) return fault(kCross);
  if (sag == Snout::kUnboundedSag) return fault("an end plane of a snout runs along its skin");
  std::vector<Vec3d> lower, upper;
  for (const SinCos& a : angles) {
    lower.push_back(snout.point(a, snout.bottom_cut(a)));
    upper.push_back(snout.point(a, snout.top_cut(a)));
  }
  return frustum(lower, upper, sag);
}

}  // namespace strake::geometry::tessellation
