// SPDX-License-Identifier: Apache-2.0
#include "support/deep_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <sstream>

#include "strake/geometry/triangulate.hpp"

namespace strake::test {
namespace {

using geometry::Triangle;
using geometry::Vec3d;

constexpr double kPi = std::numbers::pi;
using Outline = std::vector<std::array<double, 2>>;
using Place = std::function<Vec3d(const Vec3d&)>;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : rng_(seed) {}
  double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(rng_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(rng_); }
  template <class T, std::size_t N>
  T of(const std::array<T, N>& all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(N)))];
  }

 private:
  std::mt19937_64 rng_;
};

double length(const Vec3d& v) { return std::sqrt(dot(v, v)); }
Vec3d unit(const Vec3d& v) { return v * (1 / length(v)); }

/// A rotation drawn evenly, as the columns that the axes go to.
std::array<Vec3d, 3> draw_turn(Draw& draw) {
  std::array<double, 4> q{};
  double size = 0;
  do {
    size = 0;
    for (double& x : q) {
      x = draw.in(-1, 1);
      size += x * x;
    }
  } while (size > 1 || size < 0.01);
  for (double& x : q) x /= std::sqrt(size);
  const auto [w, x, y, z] = q;
  return {Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Vec3d{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          Vec3d{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

DeepBody placed(DeepBody body, const Place& place) {
  for (Vec3d& p : body.points) p = place(p);
  return body;
}

Place turn_about(const std::array<Vec3d, 3>& m, const Vec3d& to) {
  return [m, to](const Vec3d& p) { return m[0] * p.x + m[1] * p.y + m[2] * p.z + to; };
}

/// Outlines run counter-clockwise, holes too; along z.
DeepBody extruded(const std::vector<Outline>& contours, double z0, double z1) {
  DeepBody body;
  std::vector<Vec3d> flat;
  std::vector<std::uint32_t> first{0};
  for (const Outline& c : contours) {
    for (const auto& p : c) flat.push_back({p[0], p[1], 0});
    first.push_back(static_cast<std::uint32_t>(flat.size()));
  }
  const auto n = static_cast<std::uint32_t>(flat.size());
  for (const double z : {z0, z1})
    for (const Vec3d& p : flat) body.points.push_back({p.x, p.y, z});
  for (const Triangle& t : geometry::triangulate_face(flat, first).triangles) {
    body.triangles.push_back({t[0], t[2], t[1]});
    body.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  for (std::size_t c = 0; c < contours.size(); ++c)
    for (std::uint32_t i = first[c]; i < first[c + 1]; ++i) {
      const std::uint32_t j = i + 1 < first[c + 1] ? i + 1 : first[c];
      const auto [p, q] = c == 0 ? std::array{i, j} : std::array{j, i};
      body.triangles.push_back({p, q, q + n});
      body.triangles.push_back({p, q + n, p + n});
    }
  return body;
}

Outline ring(int sides, double r, double phase) {
  Outline o;
  for (int i = 0; i < sides; ++i) {
    const double t = phase + 2 * kPi * i / sides;
    o.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return o;
}

DeepBody pipe(int sides, int inner_sides, double outer, double inner, double phase, double z0,
              double z1) {
  return extruded({ring(sides, outer, phase), ring(inner_sides, inner, phase)}, z0, z1);
}

/// How far the corners of one regular polygon stand out of another of the same radius, at most.
double out_of_step(int corners, double phase, int sides, double other, double r) {
  double most = 0;
  for (int i = 0; i < corners; ++i) {
    const double t = phase + 2 * kPi * i / corners - other, step = 2 * kPi / sides;
    const double from_middle = t - (std::floor(t / step) + 0.5) * step;
    most = std::max(most, r * std::cos(from_middle) - r * std::cos(kPi / sides));
  }
  return most;
}

DeepPair draw_insulation(Draw& draw, std::ostream& recipe) {
  constexpr std::array kRadii{57.0, 57.15, 84.1, 109.5, 203.2, 323.8, 457.0, 600.0};
  constexpr std::array<std::array<int, 2>, 7> kSides{
      {{24, 24}, {24, 32}, {16, 36}, {32, 36}, {120, 128}, {36, 16}, {12, 64}}};
  const double r = draw.of(kRadii);
  const auto [of_pipe, of_hole] = draw.of(kSides);
  const double wall = draw.in(3, 12), cover = draw.in(25, 80), phase = draw.in(0, kPi / 12);
  DeepPair pair;
  pair.a = pipe(of_pipe, of_pipe, r, r - wall, phase, -400, 700);
  pair.b = extruded({ring(24, r + cover + r * 0.02, 0.1), ring(of_hole, r, 0)}, -300, 300);
  recipe << "pipe " << r << " wall " << wall << ' ' << of_pipe << " sides in a hole of " << of_hole
         << ", phase " << phase;
  // A corner of the pipe over a flat of the hole, measured square to the flat.
  pair.depth = out_of_step(of_pipe, phase, of_hole, 0, r);
  return pair;
}

DeepBody elbow(Draw& draw) {
  const double r = draw.in(20, 60), bend = r * draw.in(1.5, 3);
  const int sides = 12 + draw.below(9), steps = 8 + draw.below(5);
  DeepBody body;
  const auto n = static_cast<std::uint32_t>(sides);
  for (int i = 0; i <= steps; ++i)
    for (const auto& p : ring(sides, r, 0)) {
      const double t = kPi / 2 * i / steps, out = bend + p[0];
      body.points.push_back({out * std::cos(t) - bend * 0.7, p[1], out * std::sin(t) - bend * 0.7});
    }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(steps); ++i)
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t p = i * n + k, q = i * n + (k + 1) % n;
      body.triangles.push_back({p, p + n, q});
      body.triangles.push_back({q, p + n, q + n});
    }
  const std::uint32_t last = static_cast<std::uint32_t>(steps) * n;
  for (std::uint32_t k = 1; k + 1 < n; ++k) {
    body.triangles.push_back({0, k, k + 1});
    body.triangles.push_back({last, last + k + 1, last + k});
  }
  return body;
}

DeepBody draw_section(Draw& draw, std::ostream& recipe) {
  const double w = draw.in(40, 200), h = draw.in(60, 300), t = draw.in(1, 9), f = draw.in(1, 12);
  const double z = draw.in(200, 600);
  const int kind = draw.below(7);
  constexpr std::array kNames{"I", "L", "U", "tube", "bar", "plate", "elbow"};
  recipe << kNames[static_cast<std::size_t>(kind)] << ' ' << w << 'x' << h << 'x' << t << '/' << f
         << ' ';
  const auto centred = [&](Outline o) {
    for (auto& p : o) {
      p[0] -= w / 2;
      p[1] -= h / 2;
    }
    return o;
  };
  const Outline box = centred({{0, 0}, {w, 0}, {w, h}, {0, h}});
  const double m = w / 2;
  switch (kind) {
    case 0:
      return extruded({centred({{0, 0},
                                {w, 0},
                                {w, f},
                                {m + t / 2, f},
                                {m + t / 2, h - f},
                                {w, h - f},
                                {w, h},
                                {0, h},
                                {0, h - f},
                                {m - t / 2, h - f},
                                {m - t / 2, f},
                                {0, f}})},
                      -z, z);
    case 1:
      return extruded({centred({{0, 0}, {w, 0}, {w, f}, {t, f}, {t, h}, {0, h}})}, -z, z);
    case 2:
      return extruded(
          {centred({{0, 0}, {w, 0}, {w, h}, {w - t, h}, {w - t, f}, {t, f}, {t, h}, {0, h}})}, -z,
          z);
    case 3:
      return extruded({box, centred({{t, t}, {w - t, t}, {w - t, h - t}, {t, h - t}})}, -z, z);
    case 4:
      return extruded({ring(24, w / 4, 0)}, -z, z);
    case 5:
      return extruded({box}, -t, t);
    default:
      return elbow(draw);
  }
}

DeepPair draw_sections(Draw& draw, std::ostream& recipe) {
  DeepPair pair;
  pair.a = draw_section(draw, recipe);
  DeepBody b = draw_section(draw, recipe);
  const int pose = draw.below(4);
  const double angle = pose == 0 ? kPi / 2 : pose == 1 ? 63 * kPi / 180 : draw.in(0.1, 3);
  const Vec3d to{draw.in(-40, 40), draw.in(-40, 40), draw.in(-60, 60)};
  const double c = std::cos(angle), s = std::sin(angle);
  std::array<Vec3d, 3> m{Vec3d{1, 0, 0}, Vec3d{0, c, s}, Vec3d{0, -s, c}};
  if (pose == 3) m = draw_turn(draw);
  recipe << "pose " << pose << ' ' << angle;
  pair.b = placed(std::move(b), turn_about(m, to));
  return pair;
}

DeepPair draw_in_line(Draw& draw, std::ostream& recipe) {
  const double r = draw.in(40, 300), wall = draw.in(2, 15), overlap = draw.in(5, 80);
  constexpr std::array kSides{16, 20, 24, 32, 40};
  const int of_a = draw.of(kSides), of_b = draw.below(2) == 0 ? of_a : draw.of(kSides);
  const double phase = draw.below(2) == 0 ? 0 : draw.in(0, 0.2);
  recipe << "pipes in line " << r << " wall " << wall << " sides " << of_a << ' ' << of_b
         << " phase " << phase << " overlap " << overlap;
  DeepPair pair;
  pair.a = pipe(of_a, of_a, r, r - wall, 0, -500, 0);
  pair.b = pipe(of_b, of_b, r, r - wall, phase, -overlap, 500);
  if (of_a == of_b && phase == 0) pair.depth = std::min(overlap, wall * std::cos(kPi / of_a)) / 2;
  return pair;
}

DeepBody ball(int rings, int sides, double r) {
  DeepBody body;
  const auto n = static_cast<std::uint32_t>(sides);
  for (int i = 1; i < rings; ++i)
    for (const auto& p : ring(sides, r * std::sin(kPi * i / rings), 0))
      body.points.push_back({p[0], p[1], r * std::cos(kPi * i / rings)});
  const auto bands = static_cast<std::uint32_t>(rings - 2);
  for (std::uint32_t i = 0; i < bands; ++i)
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t p = i * n + k, q = i * n + (k + 1) % n;
      body.triangles.push_back({p, p + n, q});
      body.triangles.push_back({q, p + n, q + n});
    }
  const std::uint32_t top = (bands + 1) * n, low = bands * n;
  body.points.push_back({0, 0, r});
  body.points.push_back({0, 0, -r});
  for (std::uint32_t k = 0; k < n; ++k) {
    body.triangles.push_back({top, k, (k + 1) % n});
    body.triangles.push_back({top + 1, low + (k + 1) % n, low + k});
  }
  return body;
}

DeepPair draw_round_convex(Draw& draw, std::ostream& recipe) {
  const double r = draw.in(100, 600);
  const int rings = 12 + draw.below(18), sides = 16 + draw.below(24);
  DeepPair pair;
  pair.a = ball(rings, sides, r);
  const double w = draw.in(50, 800);
  const Vec3d to{draw.in(-1, 1) * r, draw.in(-1, 1) * r, draw.in(-1, 1) * r};
  DeepBody b = draw.below(2) == 0 ? ball(rings + 3, sides + 5, w)
                                  : extruded({ring(sides * 3, w, 0.05)}, -w, w);
  pair.b = placed(std::move(b), turn_about(draw_turn(draw), to));
  recipe << "ball " << r << ' ' << rings << 'x' << sides << " in a round body " << w;
  return pair;
}

/// A wire round z along a helix.
DeepBody spring(double radius, double pitch, double wire, int turns) {
  constexpr int kSides = 8, kSteps = 14;
  DeepBody body;
  const auto n = static_cast<std::uint32_t>(kSides);
  const auto steps = static_cast<std::uint32_t>(turns * kSteps);
  for (std::uint32_t i = 0; i <= steps; ++i) {
    const double t = 2 * kPi * i / kSteps;
    const Vec3d out{std::cos(t), std::sin(t), 0},
        at = out * radius + Vec3d{0, 0, pitch * t / 2 / kPi};
    const Vec3d along = unit({-radius * std::sin(t), radius * std::cos(t), pitch / 2 / kPi});
    const Vec3d up = cross(along, out);
    for (const auto& p : ring(kSides, wire, 0)) body.points.push_back(at + out * p[0] - up * p[1]);
  }
  for (std::uint32_t i = 0; i < steps; ++i)
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t p = i * n + k, q = i * n + (k + 1) % n;
      body.triangles.push_back({p, p + n, q});
      body.triangles.push_back({q, p + n, q + n});
    }
  for (std::uint32_t k = 1; k + 1 < n; ++k) {
    body.triangles.push_back({0, k, k + 1});
    body.triangles.push_back({steps * n, steps * n + k + 1, steps * n + k});
  }
  return body;
}

/// Some rotation, half way up and somewhere along x. Drawn one after the other, not as arguments of
/// one call: compilers differ in which they draw first.
Place draw_place(Draw& draw, double min_x, double max_x, double height) {
  const auto axes = draw_turn(draw);
  const double x = draw.in(min_x, max_x);
  return turn_about(axes, {x, 0, height / 2});
}

DeepPair draw_springs(Draw& draw, std::ostream& recipe) {
  const double radius = draw.in(20, 60), wire = draw.in(2, 6), pitch = wire * draw.in(2.5, 5);
  const int turns = 3 + draw.below(4);
  DeepPair pair;
  pair.a = spring(radius, pitch, wire, turns);
  const double height = pitch * turns;
  const int other = draw.below(3);
  recipe << "spring " << radius << " wire " << wire << " pitch " << pitch << " turns " << turns
         << " other " << other;
  if (other == 0) {
    const double other_radius = radius * draw.in(0.9, 1.1);
    pair.b = placed(spring(other_radius, pitch, wire, turns), draw_place(draw, 0, radius, height));
  } else if (other == 1) {
    pair.b =
        extruded({ring(24, radius * 1.6, 0), ring(24, radius - wire * draw.in(-0.6, 0.6), 0.1)},
                 height * 0.2, height * 0.8);
  } else {
    pair.b = placed(extruded({{{-80, -80}, {80, -80}, {80, 80}, {-80, 80}}}, -wire, wire),
                    draw_place(draw, -10, 10, height));
  }
  return pair;
}

/// Walls whose common part is thin: the one stands a little in the other's face or end.
DeepPair draw_slivers(Draw& draw, std::ostream& recipe) {
  const double t = draw.in(20, 60), thin = draw.in(0.08, 4), w = draw.in(200, 900);
  DeepPair pair;
  pair.a = extruded({{{0, 0}, {w, 0}, {w, t}, {t, t}, {t, w}, {0, w}}}, 0, 300);
  const double at = draw.in(-50, w - 60), top = draw.in(50, 500);
  pair.b = extruded({{{at, t - thin},
                      {at + 120, t - thin},
                      {at + 120, t + 80},
                      {at + 60, t + 80},
                      {at + 60, t + 40},
                      {at, t + 40}}},
                    draw.in(-50, 40), top);
  recipe << "angle " << w << 'x' << t << ", common part " << thin << " thick from " << at;
  return pair;
}

/// A part for the oracle: brute force, in the arithmetic of the C library.
class BruteField {
 public:
  explicit BruteField(const testing::IndexedMesh& mesh) {
    for (const Triangle& t : mesh.triangles)
      faces_.push_back({mesh.vertices[t[0]].as<double>(), mesh.vertices[t[1]].as<double>(),
                        mesh.vertices[t[2]].as<double>()});
  }
  using Face = std::array<Vec3d, 3>;
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }

  /// To the skin; negative outside, by the solid angle.
  [[nodiscard]] double depth(const Vec3d& p) const {
    double least = 1e300, angle = 0;
    for (const Face& f : faces_) {
      least = std::min(least, squared_distance(p, f));
      const Vec3d a = f[0] - p, b = f[1] - p, c = f[2] - p;
      const double la = length(a), lb = length(b), lc = length(c);
      angle += std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return angle > kPi ? std::sqrt(least) : -std::sqrt(least);
  }

 private:
  static double squared_distance(const Vec3d& p, const Face& f) {
    const Vec3d n = cross(f[1] - f[0], f[2] - f[0]);
    bool over = dot(n, n) > 0;
    double best = 1e300;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d &a = f[i], e = f[(i + 1) % 3] - a;
      if (dot(cross(n, e), p - a) < 0) over = false;
      const double t = std::clamp(dot(p - a, e) / std::max(dot(e, e), 1e-300), 0.0, 1.0);
      const Vec3d off = p - (a + e * t);
      best = std::min(best, dot(off, off));
    }
    if (!over) return best;
    const double h = dot(p - f[0], n);
    return h * h / dot(n, n);
  }
  std::vector<Face> faces_;
};

DeepPair drawn_pair(DeepKind kind, Draw& draw, std::ostream& recipe) {
  constexpr std::array kMakers{draw_insulation,   draw_sections, draw_in_line,
                               draw_round_convex, draw_springs,  draw_slivers};
  return kMakers[static_cast<std::size_t>(kind)](draw, recipe);
}

}  // namespace

const char* name(DeepKind kind) {
  constexpr std::array kNames{"insulation",   "sections", "in_line",
                              "round_convex", "springs",  "slivers"};
  return kNames[static_cast<std::size_t>(kind)];
}

DeepPair draw_deep_pair(DeepKind kind, std::uint64_t seed) {
  Draw draw(seed * 977 + static_cast<std::uint64_t>(kind));
  std::ostringstream recipe;
  recipe << name(kind) << " seed " << seed << ": ";
  DeepPair pair = drawn_pair(kind, draw, recipe);
  pair.recipe = recipe.str();
  return pair;
}

DeepPair turned_together(const DeepPair& pair, std::uint64_t seed) {
  Draw draw(seed + 1000003);
  // Not as arguments of one call: compilers differ in which they draw first.
  const auto axes = draw_turn(draw);
  const Place turn = turn_about(axes, {draw.in(-9, 9), draw.in(-9, 9), draw.in(-9, 9)});
  DeepPair turned = pair;
  turned.a = placed(std::move(turned.a), turn);
  turned.b = placed(std::move(turned.b), turn);
  turned.recipe += " turned";
  return turned;
}

testing::IndexedMesh snapped(const DeepBody& body) {
  double volume = 0;
  for (const Triangle& t : body.triangles)
    volume += dot(body.points[t[0]], cross(body.points[t[1]], body.points[t[2]]));
  testing::IndexedMesh mesh;
  for (const Vec3d& p : body.points)
    mesh.vertices.push_back({static_cast<std::int32_t>(std::lround(p.x * 1000)),
                             static_cast<std::int32_t>(std::lround(p.y * 1000)),
                             static_cast<std::int32_t>(std::lround(p.z * 1000))});
  mesh.triangles = body.triangles;
  return volume < 0 ? mesh.flipped() : mesh;
}

DeepPairTest::DeepPairTest(const DeepPair& pair)
    : a_(snapped(pair.a)),
      b_(snapped(pair.b)),
      of_a_(make_face_kdop(a_.part)),
      of_b_(make_face_kdop(b_.part)) {
  geometry::QueryContext work;
  const geometry::MeetingResult meeting = meet(a_.treed(), b_.treed(), work);
  meets_ =
      meeting.meeting != geometry::Meeting::apart && meeting.meeting != geometry::Meeting::touching;
  goal_.threshold = 1000;
  goal_.known_upper = -geometry::kdop_separation({a_.treed(), &of_a_}, {b_.treed(), &of_b_});
  goal_.triangle_a = meeting.triangle_a;
  goal_.triangle_b = meeting.triangle_b;
  goal_.meeting_point = meeting.point;
}

geometry::Depth DeepPairTest::depth() const {
  geometry::QueryContext work;
  return solid_depth({a_.treed(), &of_a_}, {b_.treed(), &of_b_}, goal_, work);
}

double sampled_depth(const testing::IndexedMesh& a, const testing::IndexedMesh& b,
                     std::uint64_t seed, int starts) {
  Draw draw(seed);
  const BruteField fa(a), fb(b);
  const auto depth_at = [&](const Vec3d& p) {
    const double in_a = fa.depth(p);
    if (in_a < 0) return -1.0;
    const double in_b = fb.depth(p);
    return in_b < 0 ? -1.0 : std::max(in_a, in_b);
  };
  double best = -1;
  for (int i = 0; i < starts; ++i) {
    // A point of a skin, a little within.
    const BruteField& of = i % 2 == 0 ? fa : fb;
    const auto& f =
        of.faces()[static_cast<std::size_t>(draw.below(static_cast<int>(of.faces().size())))];
    const double u = draw.in(0, 1), v = draw.in(0, 1) * (1 - u);
    const Vec3d n = unit(cross(f[1] - f[0], f[2] - f[0]));
    double step = std::pow(10.0, draw.in(1, 4.5));
    Vec3d at = f[0] * (1 - u - v) + f[1] * u + f[2] * v - n * (step * draw.in(0, 0.5));
    double depth = depth_at(at);
    if (depth < 0) continue;
    for (int k = 0; k < 160 && step > 0.5; ++k) {
      const Vec3d next = at + Vec3d{draw.in(-1, 1), draw.in(-1, 1), draw.in(-1, 1)} * step;
      const double there = depth_at(next);
      if (there > depth) {
        depth = there;
        at = next;
        step *= 1.6;
      } else {
        step *= 0.88;
      }
    }
    best = std::max(best, depth);
  }
  return best;
}

}  // namespace strake::test
