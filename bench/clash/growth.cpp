// SPDX-License-Identifier: Apache-2.0
// bench_clash_growth [NAME]...: what a pair, or a model, costs as it grows: CPU seconds of the
// whole engine with one worker at several sizes, and the exponent from one size to the next. What
// is found is checked at each size; a wrong class or count reports an error instead.
#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "support/clash_model.hpp"
#include "support/growing_meshes.hpp"

namespace {

using strake::clash::Class;
using strake::clash::Report;
using strake::geometry::TriangleMesh;
using namespace strake::test;

struct Series {
  std::string name, unit;
  std::vector<std::uint32_t> sizes;
  std::function<ClashModel(std::uint32_t)> make;
  std::function<bool(const Report&, std::uint32_t)> right;
  strake::clash::Options options = {};
};

ClashModel pair_of(TriangleMesh a, TriangleMesh b) {
  ClashModel m;
  m.object("a").body(std::move(a));
  m.object("b").body(std::move(b));
  return m;
}

TriangleMesh moved(TriangleMesh mesh, const strake::geometry::Vec3d& by) {
  for (auto& v : mesh.vertices) v = v + by;
  return mesh;
}

std::uint32_t squares_for(std::uint32_t triangles) {
  return static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 2.0)));
}

ClashModel all_rods(std::uint32_t count) {
  ClashModel m;
  for (std::uint32_t i = 0; i < count; ++i)
    m.object(std::to_string(i)).body(diagonal_rod(i, count, 40));
  return m;
}

/// One hit, in so many places at least.
bool is_hit(const Report& report, std::uint64_t places) {
  return report.pairs.size() == 1 && report.pairs.front().cls == Class::hit &&
         report.pairs.front().regions >= places;
}

std::vector<Series> all_series() {
  return {
      {"terrain on terrain",
       "triangles a sheet",
       {3200, 12'800, 45'000, 180'000},
       [](std::uint32_t n) {
         return pair_of(terrain_mesh(squares_for(n), 1), terrain_mesh(squares_for(n), 2));
       },
       [](const Report& r, std::uint32_t n) { return is_hit(r, n / 100); }},
      {"scattered triangles",
       "triangles squared",
       {625, 2500, 10'000, 40'000},
       [](std::uint32_t n) {
         const auto count = static_cast<std::uint32_t>(std::lround(std::sqrt(n)));
         return pair_of(scattered_triangles(count, 1), scattered_triangles(count, 2));
       },
       [](const Report& r, std::uint32_t n) { return is_hit(r, n / 10); }},
      {"coils through each other",
       "triangles a coil",
       {12'500, 25'000, 50'000, 100'000},
       [](std::uint32_t n) { return pair_of(coil_mesh(n), moved(coil_mesh(n), {500, 0, 20})); },
       [](const Report& r, std::uint32_t n) { return is_hit(r, n / 1200); }},
      {"coils in each other",
       "triangles a coil",
       {12'500, 25'000, 50'000, 100'000},
       [](std::uint32_t n) { return pair_of(coil_mesh(n), moved(coil_mesh(n), {0, 0, 100})); },
       [](const Report& r, std::uint32_t /*n*/) { return r.pairs.empty(); }},
      {"corrugated bars",
       "triangles a bar",
       {500, 2000, 8000, 32'000},
       [](std::uint32_t n) { return pair_of(corrugated_bar(n, 0), corrugated_bar(n, 0.7)); },
       [](const Report& r, std::uint32_t /*n*/) { return is_hit(r, 0); }},
      {"diagonal rods, 30 mm apart",
       "rods",
       {1250, 2500, 5000, 10'000, 20'000},
       all_rods,
       [](const Report& r, std::uint32_t /*n*/) { return r.pairs.empty(); },
       {.tolerances = {.clearance_mm = 5}}},
  };
}

void run(const Series& series) {
  double last_s = 0;
  std::uint32_t last = 0;
  for (const std::uint32_t size : series.sizes) {
    const ClashModel m = series.make(size);
    strake::bench::CpuLap lap;
    const Report report = m.detect(series.options);
    const double seconds = lap();
    const auto& w = report.counters;
    fmt::print(
        "{:<28}{:>9} {:<20}{:>9.3f} s{} {}{} pairs, {} places | {} triangle pairs, {} cells\n",
        series.name, size, series.unit, seconds,
        last == 0 ? std::string(15, ' ')
                  : fmt::format("  exponent {:4.2f}",
                                std::log(seconds / last_s) / std::log(1.0 * size / last)),
        series.right(report, size) ? "" : "ERROR: ", report.pairs.size(),
        report.pairs.empty() ? 0 : report.pairs.front().regions, w.triangle_pairs, w.depth_cells);
    last_s = seconds;
    last = size;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // each line as it comes, into files and pipes too
  const std::span<char*> names(argv + 1, static_cast<std::size_t>(argc - 1));
  for (const Series& series : all_series()) {
    bool wanted = names.empty();
    for (const std::string_view name : names)
      wanted = wanted || series.name.find(name) != std::string::npos;
    if (wanted) run(series);
  }
  return 0;
}
