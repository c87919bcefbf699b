// SPDX-License-Identifier: Apache-2.0
// What one pair of parts costs: CPU nanoseconds of meet() and closest() on the kinds of pairs that
// plants are made of, and on the hard ones. A case with a wrong result reports an error instead.
#include <fmt/core.h>

#include <cmath>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>

#include "strake/geometry/part_pair.hpp"
#include "support/part_builder.hpp"

namespace {

using namespace strake::geometry;
using strake::testing::box_mesh;
using strake::testing::IndexedMesh;
using strake::testing::Subject;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Repeats until half a second is spent; nanoseconds a call.
double nanoseconds(const std::function<void()>& call) {
  for (long n = 1;; n *= 2) {
    const double start = cpu_seconds();
    for (long i = 0; i < n; ++i) call();
    const double seconds = cpu_seconds() - start;
    if (seconds > 0.5) return seconds / static_cast<double>(n) * 1e9;
  }
}

void report(const std::string& name, bool right, double ns, const QueryContext& work) {
  if (right)
    fmt::print("{:<44}{:>14.1f} ns  {:>8} node pairs {:>8} triangle pairs {:>6} exact\n", name, ns,
               work.node_pairs, work.triangle_pairs, work.exact_fallbacks);
  else
    fmt::print("{:<44}  ERROR: wrong result\n", name);
}

void bench_meet(const std::string& name, const Subject& a, const Subject& b, Meeting expected) {
  QueryContext work;
  const bool right = meet(a.treed(), b.treed(), work).meeting == expected;
  QueryContext sink;
  report("meet " + name, right, nanoseconds([&] { (void)meet(a.treed(), b.treed(), sink); }), work);
}

void bench_closest(const std::string& name, const Subject& a, const Subject& b, double limit,
                   double low, double high) {
  QueryContext work;
  const auto r = find_closest_pair(a.treed(), b.treed(), limit, work);
  const bool right = low > limit ? !r : r && r->distance >= low && r->distance <= high;
  QueryContext sink;
  report("closest " + name, right,
         nanoseconds([&] { (void)find_closest_pair(a.treed(), b.treed(), limit, sink); }), work);
}

/// Turned by the Pythagorean triples 3-4-5 and 5-12-13: coordinates that are multiples of 65 stay
/// on the grid, so faces stay exactly plane.
IndexedMesh turned(IndexedMesh m) {
  for (Vec3i& v : m.vertices) {
    const Vec3l p = v.as<std::int64_t>();
    const Vec3l q{(3 * p.x - 4 * p.y) / 5, (4 * p.x + 3 * p.y) / 5, p.z};
    v = Vec3l{q.x, (5 * q.y - 12 * q.z) / 13, (12 * q.y + 5 * q.z) / 13}.as<std::int32_t>();
  }
  return m;
}

/// A closed surface of revolution round z over (radius, z) rings; the ends are poles.
IndexedMesh revolved(int rings, int sectors, const std::function<Vec3d(double)>& profile) {
  IndexedMesh m;
  const auto point = [&](int ring, int sector) {
    const Vec3d p = profile(static_cast<double>(ring) / rings);
    const double angle = 2 * std::numbers::pi * (sector + 0.5 * (ring % 2)) / sectors;
    return Vec3i{static_cast<std::int32_t>(std::lround(p.x * std::cos(angle))),
                 static_cast<std::int32_t>(std::lround(p.x * std::sin(angle))),
                 static_cast<std::int32_t>(std::lround(p.z))};
  };
  for (int ring = 0; ring <= rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) m.vertices.push_back(point(ring, sector));
  const auto at = [&](int ring, int sector) {
    return static_cast<std::uint32_t>(ring * sectors + (sector % sectors));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int s = 0; s < sectors; ++s) {
      const int low = ring % 2 == 0 ? s : s + 1;
      m.triangles.push_back({at(ring, s), at(ring, s + 1), at(ring + 1, low)});
      m.triangles.push_back(
          {at(ring + 1, s), at(ring, ring % 2 == 0 ? s + 1 : s), at(ring + 1, s + 1)});
    }
  return m;
}

IndexedMesh sphere(double radius, int rings) {
  return revolved(rings, 2 * rings, [&](double t) {
    const double angle = std::numbers::pi * (t - 0.5);
    return Vec3d{t <= 0 || t >= 1 ? 0 : radius * std::cos(angle), 0, radius * std::sin(angle)};
  });
}

IndexedMesh cylinder(double radius, double height, int sectors, int rings) {
  return revolved(rings + 2, sectors, [&](double t) {
    const double step = t * (rings + 2);
    const double z = step < 0.5 ? 0 : step > rings + 1.5 ? height : (step - 1) / rings * height;
    return Vec3d{step < 0.5 || step > rings + 1.5 ? 0 : radius, 0, z};
  });
}

void small_pairs() {
  const IndexedMesh plate = box_mesh({0, 0, -6500}, {6500000, 6500000, 0});
  const IndexedMesh box = box_mesh({650000, 650000, 0}, {975000, 845000, 1300000});
  const Subject a(plate), b(box), ta(turned(plate)), tb(turned(box));
  bench_meet("box on plate", a, b, Meeting::touching);
  bench_meet("box on plate, turned", ta, tb, Meeting::touching);
  bench_meet("box flush beside box", Subject(box_mesh({0, 0, 0}, {1000, 1000, 1000})),
             Subject(box_mesh({1000, 0, 0}, {2000, 1000, 1000})), Meeting::touching);
  bench_meet("boxes crossing", a, Subject(box_mesh({6500, 6500, -3000}, {13000, 13000, 9000})),
             Meeting::crossing);
  bench_meet("box inside box", Subject(box_mesh({0, 0, 0}, {1000, 1000, 1000})),
             Subject(box_mesh({100, 100, 100}, {900, 900, 900})), Meeting::b_inside_a);
  const Subject lifted(turned(box_mesh({650000, 650000, 6500}, {975000, 845000, 1300000})));
  bench_meet("box above plate, turned", ta, lifted, Meeting::apart);
  bench_closest("box above plate, turned", ta, lifted, 25000, 6499.9, 6500.1);
  bench_closest("box above plate, beyond the limit", ta, lifted, 5000, 6000, 0);
  bench_closest("box on plate", a, b, 1000, 0, 0);
}

void rotated_plates() {
  for (const std::int32_t gap : {1001, 2000, 10000, 100000}) {
    const IndexedMesh low = turned(box_mesh({0, 0, -13000}, {9999990, 9999990, 0}));
    IndexedMesh high = box_mesh({0, 0, gap}, {9999990, 9999990, gap + 13000});
    for (Vec3i& v : high.vertices)
      v = Vec3l{(4LL * v.x - 3LL * v.y) / 5, (3LL * v.x + 4LL * v.y) / 5, v.z}.as<std::int32_t>();
    bench_closest(fmt::format("rotated 10 m plates, {} um apart", gap), Subject(low),
                  Subject(turned(high)), 200000, gap - 5, gap + 5);
  }
}

void fine_pair(const std::string& name, const IndexedMesh& inner, const IndexedMesh& outer) {
  const Subject a(inner), b(outer);
  const double triangles = static_cast<double>(a.part.triangles.size() + b.part.triangles.size());
  double start = cpu_seconds();
  const TriangleBvh tree_a(a.part), tree_b(b.part);
  const double build = cpu_seconds() - start;
  const PartWithBvh x{{&a.part, {}}, &tree_a}, y{{&b.part, {}}, &tree_b};
  QueryContext work, meet_work;
  start = cpu_seconds();
  const auto near = find_closest_pair(x, y, 1000, work);
  const double query = cpu_seconds() - start;
  start = cpu_seconds();
  const Meeting meeting = meet(x, y, meet_work).meeting;
  const double meeting_time = cpu_seconds() - start;
  if (!near || near->distance > 510 || meeting != Meeting::a_inside_b) {
    fmt::print("{:<44}  ERROR: wrong result\n", name);
    return;
  }
  fmt::print(
      "{:<44}{:>10.0f} triangles: {:.0f} ns a triangle to build trees, {:.0f} closest, {:.0f} meet "
      "({} node pairs, {} triangle pairs, {} exact; {} um)\n",
      name, triangles, build / triangles * 1e9, query / triangles * 1e9,
      meeting_time / triangles * 1e9, work.node_pairs, work.triangle_pairs, work.exact_fallbacks,
      near->distance);
}

void fine_pairs() {
  fine_pair("spheres 0.5 mm apart", sphere(999500, 158), sphere(1000000, 158));
  const auto around = [](const IndexedMesh& m) {
    IndexedMesh r = m;
    for (Vec3i& v : r.vertices) v.z -= 500;
    return r;
  };
  fine_pair("cylinders 0.5 mm apart, square triangles", cylinder(499500, 1999000, 250, 200),
            around(cylinder(500000, 2000000, 250, 200)));
  fine_pair("cylinders 0.5 mm apart, long triangles", cylinder(499500, 1999000, 25000, 1),
            around(cylinder(500000, 2000000, 25000, 1)));
}

}  // namespace

/// bench_part_pair [small|plates|fine]: one group of cases, or all.
int main(int argc, char** argv) {
  const std::string group = argc > 1 ? argv[1] : "";
  if (group.empty() || group == "small") small_pairs();
  if (group.empty() || group == "plates") rotated_plates();
  if (group.empty() || group == "fine") fine_pairs();
  return 0;
}
