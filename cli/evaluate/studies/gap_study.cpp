// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "cli/evaluate/placed_model.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "strake/clash/clash.hpp"

namespace strake::cli {

namespace {

constexpr double kSizeMm = 2000, kThickMm = 40, kWaveMm = 30;

/// Returns a slab with a field of waves above or below, of so many squares along each side.
geometry::TriangleMesh wavy_slab(std::uint32_t squares, double z_mm, bool waves_above) {
  geometry::TriangleMesh mesh;
  const std::uint32_t row = squares + 1;
  for (const bool top : {false, true})
    for (std::uint32_t j = 0; j < row; ++j)
      for (std::uint32_t i = 0; i < row; ++i) {
        const double x = kSizeMm * i / squares, y = kSizeMm * j / squares;
        // Whole micrometres.
        const double wave =
            std::round(kWaveMm * std::sin(x / 90) * std::sin(y / 110) * 1000) / 1000;
        const double flat = top ? kThickMm + kWaveMm : -kThickMm - kWaveMm;
        mesh.vertices.push_back({x, y, z_mm + (top == waves_above ? wave : flat)});
      }
  const auto at = [&](bool top, std::uint32_t i, std::uint32_t j) {
    return (top ? row * row : 0) + j * row + i;
  };
  const auto square = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t j = 0; j < squares; ++j)
    for (std::uint32_t i = 0; i < squares; ++i) {
      square(at(true, i, j), at(true, i + 1, j), at(true, i + 1, j + 1), at(true, i, j + 1));
      square(at(false, i, j), at(false, i, j + 1), at(false, i + 1, j + 1), at(false, i + 1, j));
    }
  for (std::uint32_t k = 0; k < squares; ++k) {
    square(at(false, k, 0), at(false, k + 1, 0), at(true, k + 1, 0), at(true, k, 0));
    square(at(false, k + 1, squares), at(false, k, squares), at(true, k, squares),
           at(true, k + 1, squares));
    square(at(false, 0, k + 1), at(false, 0, k), at(true, 0, k), at(true, 0, k + 1));
    square(at(false, squares, k), at(false, squares, k + 1), at(true, squares, k + 1),
           at(true, squares, k));
  }
  return mesh;
}

/// Returns two slabs whose waves lie in each other with a gap.
model::Model two_slabs(std::uint32_t squares, double gap_mm) {
  model::Model model;
  model.files.push_back({"slabs", "generated", "mm", "z", 0, 0});
  for (const bool upper : {false, true}) {
    model::Object object;
    object.id = object.name = upper ? "upper" : "lower";
    object.first_body = upper ? 1 : 0;
    object.body_count = 1;
    model.objects.push_back(std::move(object));
    model::Body body;
    body.shape = model::ShapeId{upper ? 1U : 0U};
    model.bodies.push_back(body);
    model.shapes.emplace_back(wavy_slab(squares, upper ? gap_mm : 0, !upper));
  }
  model::finish(model);
  return model;
}

std::string class_of(const StudyRun& run) {
  if (!run.unfinished.empty()) return "-";
  for (const char* const name : {"hits", "contacts", "clearance violations"})
    if (const auto found = run.computed.counters.find(name);
        found != run.computed.counters.end() && found->second > 0)
      return name;
  return "none";
}

}  // namespace

Status study_gap(const StudyInput& input, StudyRecord& study) {
  constexpr double kClearanceMm = 25;
  const auto squares = static_cast<std::uint32_t>(
      std::lround(std::clamp(150 * std::sqrt(input.settings.scale), 20.0, 150.0)));
  study.columns = {"Gap mm",         "Ours s",         "Spheres s",     "Ours: found",
                   "Spheres: found", "Triangle pairs", "Spheres tested"};
  for (const double gap : {20.0, 10.0, 5.0, 2.5, 1.25}) {
    const clash::Options exact{.tolerances = {.clearance_mm = kClearanceMm}};
    const auto scene =
        place_model(two_slabs(squares, gap), clash::scene_options(exact), input.stop);
    if (!scene) return scene.error();
    clash::Options spheres = exact;
    spheres.engine.narrow_phase = clash::NarrowPhase::sphere_subdivision;
    spheres.engine.max_spheres = std::uint64_t{1} << 40U;  // the limit of time ends it
    std::array<StudyRun, 2> runs;
    for (std::size_t way = 0; way < runs.size(); ++way) {
      input.narrate(fmt::format("gap, {:g} mm: {}", gap, way == 0 ? "ours" : "spheres"));
      Result<StudyRun> run =
          run_for_study(input, clash_contender({}, 1, scene->scene, way == 0 ? exact : spheres));
      if (!run) return run.error();
      runs[way] = std::move(*run);
    }
    study.rows.push_back({fmt::format("{:g}", gap), runs[0].text(), runs[1].text(),
                          class_of(runs[0]), class_of(runs[1]), runs[0].counter("triangle pairs"),
                          runs[1].counter("depth cells")});
  }
  return {};
}

}  // namespace strake::cli
