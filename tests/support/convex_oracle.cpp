// SPDX-License-Identifier: Apache-2.0
#include "support/convex_oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace strake::test {
namespace {

using namespace geometry;

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

/// The angle between two at which a function with one valley there is least.
template <class F>
double min_between(double lo, double hi, const F& f) {
  constexpr int kSteps = 50;
  constexpr double kGolden = 0.6180339887498949;
  double x = hi - kGolden * (hi - lo), y = lo + kGolden * (hi - lo), at_x = f(x), at_y = f(y);
  for (int i = 0; i < kSteps; ++i) {
    if (at_x < at_y) {
      hi = std::exchange(y, x);
      at_y = at_x;
      x = hi - kGolden * (hi - lo);
      at_x = f(x);
    } else {
      lo = std::exchange(x, y);
      at_x = at_y;
      y = lo + kGolden * (hi - lo);
      at_y = f(y);
    }
  }
  return (lo + hi) / 2;
}

/// The angle at which a function of a turn is least: the best of the valleys between samples.
template <class F>
double min_angle(const F& f) {
  constexpr std::size_t kSamples = 48;
  constexpr double kStep = 2 * kPi / kSamples;
  std::array<double, kSamples> value{};
  for (std::size_t i = 0; i < kSamples; ++i) value[i] = f(kStep * static_cast<double>(i));
  double best = 0, least = kInfinity;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double before = value[(i + kSamples - 1) % kSamples], after = value[(i + 1) % kSamples];
    if (before < value[i] || after < value[i]) continue;
    const double at = kStep * static_cast<double>(i);
    const double angle = min_between(at - kStep, at + kStep, f);
    if (f(angle) < least) {
      least = f(angle);
      best = angle;
    }
  }
  return best;
}

Vec3d unit(const Vec3d& v, const Vec3d& otherwise) {
  const double size = norm(v);
  return size > 0 ? v * (1 / size) : otherwise;
}

/// The farthest of a few points along a direction.
template <std::size_t n>
Vec3d farthest(const std::array<Vec3d, n>& points, const Vec3d& along) {
  return *std::ranges::max_element(points, {}, [&](const Vec3d& p) { return dot(p, along); });
}

std::array<Vec3d, 8> corners(const PyramidPrimitive& p) {
  std::array<Vec3d, 8> all;
  for (int i = 0; i < 8; ++i) {
    const bool top = (i & 4) != 0;
    const double side = top ? 0.5 : -0.5, x = (top ? p.top_x : p.bottom_x) / 2,
                 y = (top ? p.top_y : p.bottom_y) / 2;
    all[static_cast<std::size_t>(i)] = {side * p.offset_x + ((i & 1) != 0 ? x : -x),
                                        side * p.offset_y + ((i & 2) != 0 ? y : -y),
                                        side * p.height};
  }
  return all;
}

/// Where a snout's generator at an angle meets its end at `side` = -1/2 or 1/2 of the height.
Vec3d rim(const SnoutPrimitive& s, double side, double angle) {
  const double c = std::cos(angle), n = std::sin(angle);
  const double radius = side < 0 ? s.bottom_radius : s.top_radius;
  const double x = std::tan(side < 0 ? s.bottom_shear_x : s.top_shear_x);
  const double y = std::tan(side < 0 ? s.bottom_shear_y : s.top_shear_y);
  // The generator through its point on the circle, t heights on.
  const double widening = s.top_radius - s.bottom_radius;
  const Vec3d step{s.offset_x + widening * c, s.offset_y + widening * n, s.height};
  const double t = radius * (x * c + y * n) / (s.height - x * step.x - y * step.y);
  return Vec3d{side * s.offset_x + radius * c, side * s.offset_y + radius * n, side * s.height} +
         step * t;
}

double cap_radius(const SphericalDishPrimitive& d) {
  return (d.radius * d.radius + d.height * d.height) / (2 * d.height);
}

/// Of half an ellipsoid or a ball's cap: `rise` is what its middle stands over the base.
Vec3d cap_support(double across, double along, double rise, double rim_radius, const Vec3d& n) {
  const Vec3d out = unit({n.x, n.y, 0}, {1, 0, 0});
  const double flat = across * std::hypot(n.x, n.y), up = along * n.z, size = std::hypot(flat, up);
  const double z = rise + (size > 0 ? along * up / size : along);
  if (z < 0) return out * rim_radius;
  return out * (size > 0 ? across * flat / size : 0) + Vec3d{0, 0, z};
}

struct Support {
  Vec3d n;

  Vec3d operator()(const BoxPrimitive& b) const {
    return {std::copysign(b.length_x / 2, n.x), std::copysign(b.length_y / 2, n.y),
            std::copysign(b.length_z / 2, n.z)};
  }
  Vec3d operator()(const PyramidPrimitive& p) const { return farthest(corners(p), n); }
  Vec3d operator()(const CylinderPrimitive& c) const {
    const Vec3d out = unit({n.x, n.y, 0}, {1, 0, 0});
    return out * c.radius + Vec3d{0, 0, std::copysign(c.height / 2, n.z)};
  }
  Vec3d operator()(const SnoutPrimitive& s) const {
    std::array<Vec3d, 2> ends;
    for (const bool top : {false, true}) {
      const double side = top ? 0.5 : -0.5;
      const double angle = min_angle([&](double t) { return -dot(n, rim(s, side, t)); });
      ends[top ? 1 : 0] = rim(s, side, angle);
    }
    return farthest(ends, n);
  }
  Vec3d operator()(const SpherePrimitive& s) const { return unit(n, {1, 0, 0}) * (s.diameter / 2); }
  Vec3d operator()(const EllipticalDishPrimitive& d) const {
    return cap_support(d.radius, d.height, 0, d.radius, n);
  }
  Vec3d operator()(const SphericalDishPrimitive& d) const {
    const double big = cap_radius(d);
    return cap_support(big, big, d.height - big, d.radius, n);
  }
  template <class Other>
  Vec3d operator()(const Other&) const {
    return {};
  }
};

/// The half-space round a body that a point lies least deep in, and how deep; negative: outside.
struct Under {
  double depth = kInfinity;
  Vec3d normal;

  void offer(double other, const Vec3d& way) {
    if (other < depth) *this = {other, way};
  }
};

/// A body of revolution about z whose tangent planes are those of an ellipse.
void offer_ellipse(const Vec3d& p, double across, double along, Under& least) {
  const Vec3d out = unit({p.x, p.y, 0}, {1, 0, 0});
  const double far = std::hypot(p.x, p.y);
  const auto depth = [&](double t) {
    const double c = std::cos(t), n = std::sin(t);
    return std::hypot(across * c, along * n) - c * far - n * p.z;
  };
  const double t = min_angle(depth);
  least.offer(depth(t), out * std::cos(t) + Vec3d{0, 0, std::sin(t)});
}

struct Depth {
  Vec3d p;

  Under operator()(const BoxPrimitive& b) const {
    Under least;
    for (const double side : {-1.0, 1.0}) {
      least.offer(b.length_x / 2 - side * p.x, {side, 0, 0});
      least.offer(b.length_y / 2 - side * p.y, {0, side, 0});
      least.offer(b.length_z / 2 - side * p.z, {0, 0, side});
    }
    return least;
  }
  Under operator()(const PyramidPrimitive& s) const {
    Under least;
    const auto all = corners(s);
    const auto face = [&](const Vec3d& n) {
      const Vec3d way = unit(n, {0, 0, 1});
      least.offer(dot(way, farthest(all, way) - p), way);
    };
    face({0, 0, 1});
    face({0, 0, -1});
    for (const double side : {-1.0, 1.0}) {
      face({side, 0, -(side * s.offset_x + (s.top_x - s.bottom_x) / 2) / s.height});
      face({0, side, -(side * s.offset_y + (s.top_y - s.bottom_y) / 2) / s.height});
    }
    return least;
  }
  Under operator()(const CylinderPrimitive& c) const {
    Under least;
    least.offer(c.radius - std::hypot(p.x, p.y), unit({p.x, p.y, 0}, {1, 0, 0}));
    least.offer(c.height / 2 - p.z, {0, 0, 1});
    least.offer(c.height / 2 + p.z, {0, 0, -1});
    return least;
  }
  Under operator()(const SnoutPrimitive& s) const {
    Under least;
    const auto plane = [&](const Vec3d& n, const Vec3d& through) {
      const double size = norm(n);
      least.offer(dot(n, through - p) / size, n * (1 / size));
    };
    plane({std::tan(s.bottom_shear_x), std::tan(s.bottom_shear_y), -1}, rim(s, -0.5, 0));
    plane({-std::tan(s.top_shear_x), -std::tan(s.top_shear_y), 1}, rim(s, 0.5, 0));
    const double narrowing = (s.bottom_radius - s.top_radius) / s.height;
    const auto tangent = [&](double t) {
      const double c = std::cos(t), n = std::sin(t);
      return Vec3d{c, n, narrowing - (c * s.offset_x + n * s.offset_y) / s.height};
    };
    const auto depth = [&](double t) {
      const Vec3d n = tangent(t);
      const double middle = (s.bottom_radius + s.top_radius) / 2;
      return (middle - dot(n, p)) / norm(n);
    };
    const double t = min_angle(depth);
    least.offer(depth(t), unit(tangent(t), {0, 0, 1}));
    return least;
  }
  Under operator()(const SpherePrimitive& s) const {
    return {s.diameter / 2 - norm(p), unit(p, {1, 0, 0})};
  }
  Under operator()(const EllipticalDishPrimitive& d) const {
    Under least{p.z, {0, 0, -1}};
    offer_ellipse(p, d.radius, d.height, least);
    return least;
  }
  Under operator()(const SphericalDishPrimitive& d) const {
    const double big = cap_radius(d);
    const Vec3d from_middle = p - Vec3d{0, 0, d.height - big};
    Under least{p.z, {0, 0, -1}};
    least.offer(big - norm(from_middle), unit(from_middle, {0, 0, 1}));
    return least;
  }
  template <class Other>
  Under operator()(const Other&) const {
    return {};
  }
};

Vec3d back(const Mat3d& m, const Vec3d& v) {
  return m.row[0] * v.x + m.row[1] * v.y + m.row[2] * v.z;
}

/// About a's place, so that lengths are those of the bodies.
struct Placed {
  const Primitive* primitive;
  Mat3d linear;
  Vec3d shift;

  [[nodiscard]] Vec3d support(const Vec3d& n) const {
    return linear * std::visit(Support{back(linear, n)}, *primitive) + shift;
  }
  [[nodiscard]] Under depth(const Vec3d& p) const {
    Under local = std::visit(Depth{back(linear, p - shift)}, *primitive);
    local.normal = linear * local.normal;
    return local;
  }
  [[nodiscard]] double reach() const {
    double most = 0;
    for (const Vec3d& n : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
      for (const double side : {-1.0, 1.0})
        most = std::max(most, std::fabs(dot(n, support(n * side))));
    return 2 * most;
  }
};

/// What a convex program says at a point: the value where it is allowed, else by how much a
/// constraint is broken; the gradient of either.
struct Sample {
  bool allowed = true;
  double value = 0;
  Vec3d gradient;
};

/// lower <= least value <= upper; `upper` infinite where no allowed point was found.
struct Least {
  double lower = -kInfinity, upper = kInfinity;
};

/// Cuts an ellipsoid that holds the least point, as deep as is known, until it is too small. The
/// ellipsoid is the image of the unit ball under `map`: so it stays one whatever is rounded.
template <class Evaluate>
Least min_value(double radius, int steps, double narrow, const Evaluate& evaluate) {
  Vec3d x;
  Mat3d map;
  for (Vec3d& row : map.row) row = row * radius;
  Least least;
  for (int step = 0; step < steps; ++step) {
    const Sample sample = evaluate(x);
    const Vec3d along = back(map, sample.gradient);
    const double width = norm(along);
    if (sample.allowed) {
      least.upper = std::min(least.upper, sample.value);
      least.lower = std::max(least.lower, sample.value - width);
    }
    if (least.upper - least.lower <= narrow || !(width > 0)) break;
    const double over = sample.allowed ? sample.value - least.upper : sample.value;
    const double deep = over / width;
    if (!(deep < 1)) break;
    const Vec3d way = along * (1 / width);
    x = x - map * way * ((1 + 3 * deep) / 4);
    const double grown = std::sqrt(9 * (1 - deep * deep) / 8);
    const double kept = std::sqrt(1 - (1 + 3 * deep) / (2 * (1 + deep)));
    for (Vec3d& row : map.row) row = (row - way * (dot(row, way) * (1 - kept))) * grown;
  }
  return least;
}

constexpr int kSteps = 900;
/// Brackets this narrow are narrow enough, mm: a ten thousandth of a grid unit.
constexpr double kNarrow = 1e-7;

struct Parting {
  Least gap;  ///< minus the distance: the least overlap over all directions, of any size
  double overlap = kInfinity;  ///< the least along a direction of length one that was tried
};

Parting parting(const Placed& a, const Placed& b) {
  Parting found;
  found.gap = min_value(1, kSteps, kNarrow, [&](const Vec3d& n) -> Sample {
    const double size = norm(n);
    if (size > 1) return {false, size - 1, n * (1 / size)};
    const Vec3d gradient = b.support(n) - a.support(-n);
    const double overlap = dot(n, gradient);
    if (size > 0) found.overlap = std::min(found.overlap, overlap / size);
    return {true, overlap, gradient};
  });
  return found;
}

/// Minus the depth of the deepest point of `other` in `body`.
Least depth_in(const Placed& body, const Placed& other, double reach) {
  return min_value(reach, kSteps, kNarrow, [&](const Vec3d& x) -> Sample {
    if (const Under out = other.depth(x); out.depth < 0) return {false, -out.depth, out.normal};
    const Under in = body.depth(x);
    return {true, -in.depth, in.normal};
  });
}

}  // namespace

std::optional<OracleSeparation> oracle_separation(const OracleBody& a, const OracleBody& b) {
  for (const Primitive* p : {a.primitive, b.primitive})
    if (std::holds_alternative<CircularTorusPrimitive>(*p) ||
        std::holds_alternative<RectangularTorusPrimitive>(*p) ||
        std::holds_alternative<LinePrimitive>(*p))
      return std::nullopt;
  const Placed x{a.primitive, a.at.linear, {}};
  const Placed y{b.primitive, b.at.linear, b.at.translation - a.at.translation};
  const Parting parted = parting(x, y);
  if (parted.gap.upper < 0) return OracleSeparation{-parted.gap.upper, -parted.gap.lower};
  const double reach = std::max(x.reach(), y.reach());
  const Least in_x = depth_in(x, y, reach), in_y = depth_in(y, x, reach);
  // No point lies deeper than a move that parts the two is long.
  return OracleSeparation{std::max(-parted.overlap, std::min(in_x.lower, in_y.lower)),
                          std::min({-parted.gap.lower, in_x.upper, in_y.upper})};
}

}  // namespace strake::test
