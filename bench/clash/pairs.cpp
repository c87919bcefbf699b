// SPDX-License-Identifier: Apache-2.0
// bench_clash_pairs [TRIANGLES]...: one pair of large meshes at a time through the whole engine,
// trees and support planes included: CPU microseconds per triangle of the two, one worker, and how
// much faster a team of two is by the clock. A pair with a wrong class or a bracket that misses the
// truth reports an error instead.
#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"
#include "support/revolved_meshes.hpp"

namespace {

using strake::clash::Class;
using strake::geometry::TriangleMesh;
using strake::geometry::Vec3d;
using namespace strake::test;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Truth {
  Class cls;
  double d_mm;      ///< of the smooth bodies
  double slack_mm;  ///< how far that of the meshes may be from it
};

void bench(const std::string& title, TriangleMesh a, TriangleMesh b, const Vec3d& shift,
           const Truth& truth) {
  const auto triangles = static_cast<double>(a.triangles.size() + b.triangles.size());
  ClashModel m;
  m.object("a").body(std::move(a));
  m.object("b").body(std::move(b), {{}, shift});
  const strake::clash::Options options{.tolerances = {.clearance_mm = 25}};
  strake::parallel::Team team(2);
  const double start = cpu_seconds();
  const auto scene =
      strake::model::make_scene(m.model, strake::clash::scene_options(options), {}).value();
  const double placed = cpu_seconds();
  const auto sets = strake::clash::one_set(scene);
  strake::bench::Lap lap;
  const auto report = strake::clash::detect(scene, sets, options, {}).value();
  const double seconds = cpu_seconds() - placed, alone = lap();
  const auto by_two = strake::clash::detect(scene, sets, options, {.team = &team}).value();
  const double speed_up = alone / lap();
  const auto& w = report.counters;
  const strake::clash::Pair pair =
      report.pairs.empty() ? strake::clash::Pair{} : report.pairs.front();
  const bool right = pair.cls == truth.cls && (pair.cls == Class::no_hit ||
                                               (pair.d_lower_mm <= truth.d_mm + truth.slack_mm &&
                                                pair.d_upper_mm >= truth.d_mm - truth.slack_mm));
  fmt::print(
      "{:<34}{:>9.0f} triangles {:>8.3f} us each {:>8.3f} s (place {:.3f} s, two {:.2f}x) {}{} {} "
      "d "
      "{:.4f} "
      "[{:.4f}, {:.4f}] flags {} | {} triangle pairs, {} exact, {} cells\n",
      title, triangles, seconds / triangles * 1e6, seconds, placed - start, speed_up,
      right && by_two.hash == report.hash ? "" : "ERROR: ", name(pair.cls), name(pair.relation),
      pair.d_mm, pair.d_lower_mm, pair.d_upper_mm, pair.flags, w.triangle_pairs, w.exact_fallbacks,
      w.depth_cells);
}

void pairs_of(double triangles) {
  const auto rings = static_cast<std::uint32_t>(std::sqrt(triangles / 4));
  const double r = 1000, sag = r * std::pow(std::acos(-1.0) / rings, 2);
  const TriangleMesh ball = sphere_mesh(r, rings), smaller = sphere_mesh(r - 5, rings);
  bench("spheres concentric", ball, sphere_mesh(r / 2, rings), {}, {Class::hit, -r, sag});
  bench("spheres 5 mm apart inside", ball, smaller, {}, {Class::hit, -r, sag});
  bench("spheres crossing", ball, ball, {900, 300, 100}, {Class::hit, -r, sag});
  bench("spheres barely crossing", ball, ball, {1992, 20, 10}, {Class::hit, -7.87, sag});
  bench("spheres 10 mm apart", ball, ball, {1200, 900, 1337.95},
        {Class::clearance_violation, 10, sag});
  bench("spheres equal", ball, ball, {}, {Class::hit, -r, sag});
  bench("spheres 3 um aside", ball, ball, {0.003, 0, 0}, {Class::hit, -r, sag});
  TriangleMesh otherwise = ball;  // the same sphere, cut into other triangles
  for (Vec3d& v : otherwise.vertices) v = {v.z, v.x, v.y};
  bench("spheres equal, cut otherwise", ball, otherwise, {}, {Class::hit, -r, sag});
  bench("spheres 5 um high, cut otherwise", ball, std::move(otherwise), {0, 0, 0.005},
        {Class::hit, -r, sag});
  const TriangleMesh hills = bumpy_mesh(r, 60, 12, rings);
  bench("hills crossing", hills, hills, {900, 300, 100}, {Class::hit, -950, 60});
  bench("hills barely crossing", hills, hills, {1992, 20, 10}, {Class::hit, -60, 120});
  bench("hills equal", hills, hills, {}, {Class::hit, -r, 60});
  bench("hills 3 um aside", hills, hills, {0.003, 0, 0}, {Class::hit, -950, 60});
  bench("hills inside hills", hills, bumpy_mesh(r - 5, 60, 12, rings), {}, {Class::hit, -r, 60});
  const std::uint32_t bands = rings, sectors = 2 * rings;
  bench("cylinders concentric", cylinder_mesh(500, 2000, bands, sectors),
        cylinder_mesh(499, 1998, bands, sectors), {0, 0, 1}, {Class::hit, -500, 1});
  bench("cylinders beside, 2 mm apart", cylinder_mesh(500, 2000, bands, sectors),
        cylinder_mesh(510, 2000, bands, sectors), {1012, 0, 0},
        {Class::clearance_violation, 2, sag});
}

/// Discs with caps that are fans of needles, straight and askew, over each other and aside.
void fans_of(double triangles) {
  const auto sectors = static_cast<std::uint32_t>(triangles / 8);
  const TriangleMesh plate = cylinder_mesh(500, 10, 1, sectors);
  const TriangleMesh smaller = cylinder_mesh(400, 6, 1, sectors);
  for (const bool askew : {false, true}) {
    const auto stand = [&](TriangleMesh m, double angle, double z) {
      for (Vec3d& v : m.vertices) {
        v = {v.x * std::cos(angle) - v.y * std::sin(angle),
             v.x * std::sin(angle) + v.y * std::cos(angle), v.z + z};
        if (askew) v = {0.6 * v.x + 0.8 * v.z, v.y, 0.6 * v.z - 0.8 * v.x};
      }
      return m;
    };
    const std::string how = askew ? ", askew" : "";
    const double phase = 1.0 / sectors;
    const Vec3d aside = askew ? Vec3d{60, 170, -80} : Vec3d{100, 170, 0};
    bench("fans 3 mm apart" + how, stand(plate, 0, 0), stand(plate, phase, 13), {},
          {Class::clearance_violation, 3, 0.004});
    bench("fans touching" + how, stand(plate, 0, 0), stand(plate, phase, 10), {},
          {Class::contact, 0, 0.004});
    bench("fans aside, 3 mm apart" + how, stand(plate, 0, 0), stand(smaller, phase, 13), aside,
          {Class::clearance_violation, 3, 0.004});
    bench("fans aside, touching" + how, stand(plate, 0, 0), stand(smaller, phase, 10), aside,
          {Class::contact, 0, 0.004});
    bench("fan inside a fan" + how, stand(plate, 0, 0), stand(smaller, phase, 2), {},
          {Class::hit, -5, 0.01});
    bench("fan flush inside a fan" + how, stand(plate, 0, 0), stand(smaller, phase, 0), {},
          {Class::hit, -5, 0.01});
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // each line as it comes, into files and pipes too
  std::vector<double> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atof(argv[i]));
  if (sizes.empty()) sizes = {20'000, 200'000};
  for (const double n : sizes) {
    pairs_of(n);
    fans_of(n);
  }
  return 0;
}
