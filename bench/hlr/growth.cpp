// SPDX-License-Identifier: Apache-2.0
// bench_hlr_growth: what the lines of one corner with many faces, and of many equal objects at one
// place, cost as they grow: CPU seconds with one worker at several sizes, and the exponent from one
// size to the next. A wrong number of visible lines reports an error instead.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "clocks.hpp"
#include "strake/hlr/hlr.hpp"
#include "support/scene_builder.hpp"

namespace {

using strake::test::SceneBuilder;

struct Series {
  std::string name;
  std::vector<std::uint32_t> sizes;
  std::function<SceneBuilder(std::uint32_t)> make;
  strake::geometry::Vec3l direction;
  std::uint32_t visible = 0;  ///< pieces, for each of the size
};

/// Needles round a corner, with a crease between each two.
SceneBuilder fan(std::uint32_t count) {
  constexpr double kRadius = 5'000'000;
  strake::test::HandPart part;
  part.vertices.push_back({0, 0, 600'000});
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * i / count;
    part.vertices.push_back({static_cast<std::int32_t>(std::lround(kRadius * std::cos(turn))),
                             static_cast<std::int32_t>(std::lround(kRadius * std::sin(turn))),
                             i % 2 == 0 ? 60'000 : -60'000});
    part.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  SceneBuilder scene;
  scene.object({{.parts = {part}, .origin = {}}});
  return scene;
}

SceneBuilder equal_boxes(std::uint32_t count) {
  SceneBuilder scene;
  scene.object({{.parts = {strake::test::hand_box({0, 0, 0}, {900, 800, 700})}, .origin = {}}});
  for (std::uint32_t i = 1; i < count; ++i) scene.instance(0, {0, 0, 0});
  return scene;
}

void run(const Series& series) {
  double last_s = 0;
  std::uint32_t last = 0;
  for (const std::uint32_t size : series.sizes) {
    const SceneBuilder scene = series.make(size);
    strake::hlr::View view;
    view.direction = series.direction;
    strake::bench::CpuLap lap;
    const auto drawing = strake::hlr::draw(scene.scene(), {}, view, {}, {}).value();
    const double seconds = lap();
    const auto visible = std::ranges::count(drawing.pieces, strake::hlr::State::visible,
                                            &strake::hlr::EdgePiece::state);
    fmt::print("{:<36}{:>7} {:>9.3f} s{} {}{} visible | {} face tests\n", series.name, size,
               seconds,
               last == 0 ? std::string(15, ' ')
                         : fmt::format("  exponent {:4.2f}",
                                       std::log(seconds / last_s) / std::log(1.0 * size / last)),
               visible == std::int64_t{series.visible} * size ? "" : "ERROR: ", visible,
               drawing.counters.face_tests);
    last_s = seconds;
    last = size;
  }
}

}  // namespace

int main() {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // each line as it comes, into files and pipes too
  run({"fan of creases, from above", {3125, 6250, 12'500, 25'000, 50'000}, fan, {0, 0, 1}, 2});
  run({"equal boxes at one place", {250, 500, 1000, 2000}, equal_boxes, {1, -1, 1}, 9});
  return 0;
}
